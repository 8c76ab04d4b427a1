"""Compare collision shapes that foam reads with those of another reader, each in the frame of its link."""
import numpy as np

import foam

#: How much of an orientation a kind has: nothing, an axis, or all.
TURNED = {"sphere": [], "capsule": [2], "cylinder": [2], "box": [0, 1, 2], "ellipsoid": [0, 1, 2]}
NUMBERS = {"sphere": ["radius"], "capsule": ["radius", "length"], "cylinder": ["radius", "length"], "box": ["size"], "ellipsoid": ["radii"]}
DIRECTIONS = np.random.default_rng(1).normal(size=(200, 3))
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1)[:, None]


class Shape:
    """What collides: a primitive (`numbers`, `pose`), or `points` with the triangles `faces`, or with their hull.

    `slack`: by how much of its size foam's shape may be larger, where it is a mesh that holds another shape.
    """

    def __init__(self, kind, pose=None, numbers=None, points=None, faces=None, slack=0.0):
        self.kind, self.pose, self.numbers, self.points, self.faces, self.slack = kind, pose, numbers, points, faces, slack
        self.reached = None if points is None else reached(points)


def about(axis, angle):
    """Return the rotation about a unit axis, by the formula of Rodrigues."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def rigid(rotation, move):
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = rotation, move
    return result


def joint_pose(joint, value=0.0):
    """Return the pose of the child of one of foam's joints in its parent."""
    pose = rigid(joint.rotation, joint.xyz)
    if joint.kind in ("revolute", "continuous"):
        return pose @ rigid(about(joint.axis, value), np.zeros(3))
    return pose @ rigid(np.eye(3), np.array(joint.axis) * value if joint.kind == "prismatic" else np.zeros(3))


def link_poses(robot, values):
    """Return the pose of each link of foam's robot in its root."""
    poses, left = {robot.root: np.eye(4)}, list(robot.joints)
    while left:
        ready = [joint for joint in left if joint.parent in poses]
        assert ready, f"no way leads from the root to {left[0].child}"
        for joint in ready:
            poses[joint.child] = poses[joint.parent] @ joint_pose(joint, values.get(joint.name, 0.0))
            left.remove(joint)
    return poses


def enclosed(points, faces):
    """Return the area of triangles, and six times the volume within."""
    a, b, c = (points[np.asarray(faces)[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    return np.linalg.norm(across, axis=1).sum() / 2, np.einsum("ij,ij->", a, across)


def reached(points):
    """Return how far points extend along many directions: equal hulls extend as far."""
    return (np.asarray(points) @ DIRECTIONS.T).max(axis=0)


def mesh_fault(part, shape, size, tolerance):
    mesh = foam.Mesh._of(part["mesh"])
    gaps = part["reached"] - shape.reached
    if gaps.min() < -tolerance * size or gaps.max() > (tolerance + shape.slack) * size:
        return f"hulls differ by {gaps.min():.3g} to {gaps.max():.3g}"
    if shape.faces is not None:
        for ours, theirs, power in zip(enclosed(np.asarray(mesh.vertices), mesh.triangles), enclosed(shape.points, shape.faces), (2, 3)):
            if abs(ours - theirs) > 100 * tolerance * size**power:
                return f"area or volume differ: {ours}, {theirs}"
    return None


def fault(part, shape, size, tolerance):
    """Return how a part of foam's and a shape differ; None where they agree."""
    if part["kind"] != shape.kind:
        return f"{part['kind']}, not {shape.kind}"
    if shape.kind == "mesh":
        return mesh_fault(part, shape, size, tolerance)
    pairs = [(part[key], shape.numbers[key], size, key) for key in NUMBERS[shape.kind]]
    turned = np.array(part["rotation"]).reshape(3, 3) if TURNED[shape.kind] else None
    pairs += [(part["position"], shape.pose[:3, 3], size, "place")]
    pairs += [(turned[:, k], shape.pose[:3, k], 1, "turn") for k in TURNED[shape.kind]]
    for ours, theirs, scale, what in pairs:
        gap = np.abs(np.subtract(ours, theirs)).max()
        if gap > tolerance * scale:
            return f"{shape.kind}: {what} differs by {gap:.3g}"
    return None


def reach(shape):
    if shape.points is not None:
        return np.abs(shape.points).max()
    return np.abs(shape.pose[:3, 3]).max() + np.sum([np.max(number) for number in shape.numbers.values()])


def compare_shapes(robot, theirs, tolerance=1e-9):
    """Raise AssertionError where shapes by link differ. Return their number."""
    ours = {link: list(robot._core.parts(link)) for link in robot.links_with_geometry}
    counts = [{link: len(shapes) for link, shapes in of.items() if shapes} for of in (ours, theirs)]
    assert counts[0] == counts[1], f"shapes by link: {set(counts[0].items()) ^ set(counts[1].items())}"
    for link, parts in ours.items():
        for part in parts:
            part["reached"] = reached(foam.Mesh._of(part["mesh"]).vertices) if part["kind"] == "mesh" else None
        size = max(reach(shape) for shape in theirs[link])
        for shape in theirs[link]:
            faults = []  # shapes are in the same order, but for a few
            while len(faults) < len(parts) and (not faults or faults[-1]):
                faults.append(fault(parts[len(faults)], shape, size, tolerance))
            assert not faults[-1], f"link {link}: a {shape.kind}: {faults[0]}"
            del parts[len(faults) - 1]
    return sum(counts[1].values())
