// The kinds of elements of a model. An element is {kind, row: numbers in the link's frame, pinned}. A new kind adds itself
// here, and a way to draw it in drawing.js.

const KINDS = {
  sphere: {
    text: "sphere",
    numbers: [["x", 0], ["y", 1], ["z", 2], ["radius", 3]],
    centre: (row) => row.slice(0, 3),
    radius: (row) => row[3],   // of the least ball around it
    /// Returns where a ray (origin, unit direction) first meets it; null if it does not. `pose`: of its link.
    hit: (row, pose, origin, direction) => {
      const c = moved(pose, row), d = c.map((x, i) => x - origin[i]), along = Vector.dot(d, direction);
      const rest = row[3] * row[3] - (Vector.dot(d, d) - along * along);
      return rest >= 0 ? along - Math.sqrt(rest) : null;
    },
    withCentre: (row, centre) => [...centre, row[3]],
    withSize: (row, radius) => [...row.slice(0, 3), radius],
  },
};
