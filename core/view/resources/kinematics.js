// From joint positions to the poses of links. A pose is 3 rows of 4 numbers.

const UNMOVED = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/// Returns the pose of b after a: p -> a (b p).
const composed = (a, b) => {
  const result = new Array(12);
  for (let r = 0; r < 12; r += 4) {
    for (let c = 0; c < 4; ++c) {
      result[r + c] = a[r] * b[c] + a[r + 1] * b[4 + c] + a[r + 2] * b[8 + c] + (c === 3 ? a[r + 3] : 0);
    }
  }
  return result;
};

/// Returns p in the frame of the pose.
const insideOf = (pose, p) => {
  const d = [p[0] - pose[3], p[1] - pose[7], p[2] - pose[11]];
  return [0, 1, 2].map((c) => pose[c] * d[0] + pose[4 + c] * d[1] + pose[8 + c] * d[2]);
};

/// Returns the motion of a joint by its value, rad or m (Rodrigues' rotation formula).
const motionOf = (joint, value) => {
  const [x, y, z] = joint.axis;
  if (joint.kind === "prismatic") {
    return [1, 0, 0, value * x, 0, 1, 0, value * y, 0, 0, 1, value * z];
  }
  if (joint.kind !== "revolute" && joint.kind !== "continuous") {
    return UNMOVED;
  }
  const c = Math.cos(value), s = Math.sin(value), t = 1 - c;
  return [c + x * x * t, x * y * t - z * s, x * z * t + y * s, 0, y * x * t + z * s, c + y * y * t, y * z * t - x * s, 0,
    z * x * t - y * s, z * y * t + x * s, c + z * z * t, 0];
};

/// Returns the value of each joint: mimic joints follow theirs.
const jointValues = (robot, configuration) => robot.joints.map((joint) => (joint.freedom === null ? joint.offset
  : joint.multiplier * configuration[joint.freedom] + joint.offset));

/// Returns the pose of each link in the root link's frame.
const linkPoses = (robot, configuration) => {
  const values = jointValues(robot, configuration), poses = new Array(robot.links.length).fill(null);
  const above = new Map(robot.joints.map((joint, j) => [joint.child, j]));
  const poseOf = (link) => {
    const chain = [];   // joints up to a link whose pose is known: chains may be long
    let at = link;
    for (; !poses[at] && above.has(at); at = robot.joints[chain.at(-1)].parent) {
      chain.push(above.get(at));
    }
    poses[at] ??= UNMOVED;
    for (const j of chain.reverse()) {
      const joint = robot.joints[j];
      poses[joint.child] = composed(composed(poses[joint.parent], joint.origin), motionOf(joint, values[j]));
    }
  };
  robot.links.forEach((_, l) => poseOf(l));
  return poses;
};
