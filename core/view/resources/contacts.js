// Distances between the elements of links: who touches, and who is nearest.

/// Returns the elements of each link as balls in the root link's frame, with a ball around each link.
const placedBalls = (links, poses) => links.map((elements, l) => {
  const balls = elements.map(({ kind, row }) => [...moved(poses[l], KINDS[kind].centre(row)), KINDS[kind].radius(row)]);
  const middle = [0, 1, 2].map((i) => balls.reduce((sum, b) => sum + b[i], 0) / (balls.length || 1));
  const around = balls.reduce((r, b) => Math.max(r, Math.hypot(b[0] - middle[0], b[1] - middle[1], b[2] - middle[2]) + b[3]), 0);
  return { balls, middle, around };
});

/// Returns the distance of the surfaces of two balls, negative where they overlap.
const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) - a[3] - b[3];

/// Returns {touching: [{a, b, distance, elements: [[i, j], …]}, …], nearest: {a, b, i, j, distance} or null} for pairs of
/// links that are not `ignored` (Set of a * links + b). Pairs whose balls are farther than the nearest pair are not looked
/// into.
const contactsOf = (links, poses, ignored) => {
  const placed = placedBalls(links, poses), pairs = [];
  for (let a = 0; a < placed.length; ++a) {
    for (let b = a + 1; b < placed.length; ++b) {
      if (placed[a].balls.length > 0 && placed[b].balls.length > 0 && !ignored.has(a * placed.length + b)) {
        pairs.push([apart([...placed[a].middle, placed[a].around], [...placed[b].middle, placed[b].around]), a, b]);
      }
    }
  }
  pairs.sort((p, q) => p[0] - q[0]);
  let nearest = null;
  const touching = [];
  for (const [bound, a, b] of pairs) {
    if (nearest && bound > Math.max(nearest.distance, 0)) {
      break;
    }
    const found = nearestOf(placed[a], placed[b]);
    if (found.elements.length > 0) {
      touching.push({ a, b, distance: found.distance, elements: found.elements });
    }
    if (!nearest || found.distance < nearest.distance) {
      nearest = { a, b, i: found.i, j: found.j, distance: found.distance, from: placed[a].balls[found.i],
        to: placed[b].balls[found.j] };
    }
  }
  touching.sort((p, q) => p.distance - q.distance);
  return { touching, nearest };
};

const nearestOf = (a, b) => {
  let distance = Infinity, best = [0, 0];
  const elements = [];
  a.balls.forEach((ball, i) => {
    if (apart(ball, [...b.middle, b.around]) > Math.max(distance, 0)) {
      return;
    }
    b.balls.forEach((other, j) => {
      const d = apart(ball, other);
      if (d < distance) {
        distance = d;
        best = [i, j];
      }
      if (d < 0) {
        elements.push([i, j]);
      }
    });
  });
  return { distance, i: best[0], j: best[1], elements };
};
