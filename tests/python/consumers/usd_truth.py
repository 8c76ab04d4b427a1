"""Compare what foam reads from USD with what OpenUSD says: bodies, shapes that collide, joints.

Which prims collide, which joints there are and which bodies they join is what OpenUSD's own parser of physics says
(UsdPhysics.LoadUsdPhysicsFromRange); poses and sizes are taken from the prims, as its numbers are of single precision.
"""
import math

import numpy as np
from placed import Shape, about, compare_shapes, joint_pose, rigid
from pxr import Gf, Usd, UsdGeom, UsdPhysics

TYPES = UsdPhysics.ObjectType
SHAPES = [getattr(TYPES, f"{name}Shape") for name in ("Sphere", "Cube", "Capsule", "Capsule1", "Cylinder", "Cylinder1", "Cone", "Mesh", "Custom")]
JOINTS = [getattr(TYPES, f"{name}Joint") for name in ("Fixed", "Revolute", "Prismatic", "Spherical", "Distance", "D6", "Custom")]
HULLS = ("convexHull", "boundingSphere", "boundingCube")
#: How much larger than round shapes the meshes are that hold them, by their size.
ROUND = 1 / math.cos(math.pi / 48) ** 2 - 1


class Stage:
    """A file of USD as OpenUSD reads it."""

    def __init__(self, file, folder=None):
        stage = self.stage = Usd.Stage.Open(str(file))
        if stage.GetCompositionErrors():
            raise ValueError(str(stage.GetCompositionErrors()[0]))
        self.cache = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
        self.metre = UsdGeom.GetStageMetersPerUnit(stage)
        self.up = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]) if UsdGeom.GetStageUpAxis(stage) == "Y" else np.eye(3)
        told = UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"])
        self.bodies = [str(path) for path, one in pairs(told, [TYPES.RigidBody]) if one.rigidBodyEnabled]
        self.colliders = [(str(path), str(one.rigidBody)) for path, one in pairs(told, SHAPES) if one.collisionEnabled]
        self.planes = len(list(pairs(told, [TYPES.PlaneShape])))
        self.joints = [one for _, one in pairs(told, JOINTS) if one.jointEnabled]

    def collides(self):
        return bool(self.colliders)

    def world(self, path):
        """Return the 4x4 matrix that takes points of a prim, as columns, to metres in a world whose z is up."""
        matrix = np.array(self.cache.GetLocalToWorldTransform(self.stage.GetPrimAtPath(path))).T if path else np.eye(4)
        turned = np.eye(4)
        turned[:3, :3] = self.up * self.metre
        return turned @ matrix

    def body(self, path):
        """Return the pose of a body, of the orientation nearest to its matrix."""
        matrix = self.world(path)
        left, _, right = np.linalg.svd(matrix[:3, :3])
        turned = left @ right
        return rigid(turned * np.sign(np.linalg.det(turned)), matrix[:3, 3]) if path else np.eye(4)

    def shape(self, path, body):
        """Return a shape in the frame of its body."""
        prim, place = self.stage.GetPrimAtPath(path), np.linalg.inv(self.body(body)) @ self.world(path)
        kind = prim.GetTypeName()
        stated = {name: attribute.Get(Usd.TimeCode.EarliestTime()) for name in ("size", "radius", "height", "axis") if (attribute := prim.GetAttribute(name))}
        scale = np.linalg.norm(place[:3, :3], axis=0)
        turned = place[:3, :3] / scale
        if kind == "Mesh":
            return self.mesh(prim, place)
        square = np.abs(turned.T @ turned - np.eye(3)).max() < 3e-6
        along = "XYZ".index(stated.get("axis", "Z"))
        across = np.delete(scale, along)
        even = np.ptp(across) <= 3e-6 * across.max()
        pose = np.eye(4)
        pose[:3, 3] = place[:3, 3]
        pose[:3, :3] = np.roll(turned, 2 - along, axis=1)  # the axis last
        if np.linalg.det(pose[:3, :3]) < 0:
            pose[:3, 0] *= -1
        if square and kind == "Cube":
            return Shape("box", pose, {"size": stated["size"] * np.roll(scale, 2 - along)})
        if square and kind == "Sphere":
            radii = stated["radius"] * scale
            same = np.ptp(radii) <= 3e-6 * radii.max()
            return Shape("sphere", pose, {"radius": radii.max()}) if same else Shape("ellipsoid", pose, {"radii": radii})
        if square and even and (kind == "Cylinder" or (kind == "Capsule" and np.ptp(scale) <= 3e-6 * scale.max())):
            return Shape(kind.lower(), pose, {"radius": stated["radius"] * across.max(), "length": stated["height"] * scale[along]})
        points = dense(prim, kind, stated, along)
        return Shape("mesh", points=points @ place[:3, :3].T + place[:3, 3], slack=ROUND if kind != "Cube" else 0)

    def mesh(self, prim, place):
        mesh, time = UsdGeom.Mesh(prim), Usd.TimeCode.EarliestTime()
        points = np.array(mesh.GetPointsAttr().Get(time), float) @ place[:3, :3].T + place[:3, 3]
        approximation = prim.GetAttribute("physics:approximation")
        faces, begin, corners = [], 0, list(mesh.GetFaceVertexIndicesAttr().Get(time))
        if approximation and approximation.Get() in HULLS:
            return Shape("mesh", points=points)
        for count in mesh.GetFaceVertexCountsAttr().Get(time):
            faces += [(corners[begin], corners[begin + k], corners[begin + k + 1]) for k in range(1, count - 1)]
            begin += count
        flipped = (np.linalg.det(place[:3, :3]) < 0) != (mesh.GetOrientationAttr().Get() == "leftHanded")
        return Shape("mesh", points=points, faces=[face[::-1] for face in faces] if flipped else faces)

    def joint_frame(self, body, position, turn):
        """Return the pose of a joint's end in its body, in metres; OpenUSD has scaled the position with the body."""
        frame = rigid(np.array(Gf.Matrix3d(Gf.Quatd(turn))).T, np.array(position, float) * self.metre)
        return frame if body else rigid(self.up, np.zeros(3)) @ frame


def pairs(told, types):
    for kind in types:
        if kind in told:
            yield from zip(*told[kind], strict=True)


def dense(prim, kind, stated, along):
    """Return points of the surface of a primitive, close enough for its hull."""
    if kind == "Cube":
        return np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * stated["size"] / 2
    angles = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    ring = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    levels = np.linspace(0, np.pi, 121)
    ball = np.concatenate([ring * np.sin(level) + (0, 0, np.cos(level)) for level in levels])
    if kind == "Sphere":
        return ball * stated["radius"]
    up = np.array([0, 0, stated["height"] / 2])
    radii = [prim.GetAttribute(f"radius{end}").Get() for end in ("Bottom", "Top")] if kind.endswith("_1") else [stated["radius"]] * 2
    if kind == "Cone":
        radii[1] = 0
    whole = ball if kind.startswith("Capsule") else ring
    points = np.concatenate([radii[0] * whole - up, radii[1] * whole + up])
    return np.roll(points, along - 2, axis=1)


def links_of(paths, links):
    """Return foam's link by path: as much of the end of the path as it takes to be the only one."""
    found = {}
    for path in paths:
        parts = path.strip("/").split("/")
        names = ["_".join(parts[-count:]) for count in range(1, len(parts) + 1)]
        name = next((n for n in names if n in links and n not in found.values()), None)
        assert name, f"no link of the body {path}"
        found[path] = name
    return found


def compare(robot, stage, tolerance=1e-9):
    """Raise AssertionError where foam and OpenUSD differ. Return the number of shapes."""
    names = links_of(stage.bodies, robot.links)
    theirs = {}
    for path, body in stage.colliders:
        body = body if body in names else ""
        theirs.setdefault(names.get(body, "world"), []).append(stage.shape(path, body))
    more = [link for link in robot.links if link not in names.values()]
    made = {joint.child for joint in robot.joints if any(other.name == f"{joint.name}_fixed" for other in robot.joints)}
    assert set(more) <= made | {"world"}, f"links that are no bodies: {more}"
    count = compare_shapes(robot, theirs, tolerance)
    check_joints(robot, stage, names, 3e-6)
    return count


def check_joints(robot, stage, names, tolerance):
    """Check, at random values, the pose of each joint's child; joints that close loops are left out of foam's robot."""
    below = {joint.child: joint for joint in robot.joints}
    tree, random = 0, np.random.default_rng(0)
    for joint in stage.joints:
        ends = [str(path) if str(path) in names else "" for path in (joint.body0, joint.body1)]
        if ends[0] == ends[1]:
            continue
        links = [names.get(end, "world") for end in ends]
        for reverse, (above, child) in enumerate((links, links[::-1])):
            chain = [below[child]] if child in below else []
            if chain and chain[0].parent not in links and chain[0].parent in below:
                chain.insert(0, below[chain[0].parent])
            if chain and chain[0].parent == above and str(joint.primPath).replace("/", "_").endswith(chain[0].name):
                break
        else:
            continue
        tree += 1
        frames = [stage.joint_frame(ends[0], joint.localPose0Position, joint.localPose0Orientation),
                  stage.joint_frame(ends[1], joint.localPose1Position, joint.localPose1Orientation)]  # fmt: skip
        if chain[0].kind == "floating":
            continue
        moving = chain[0].kind in ("revolute", "continuous", "prismatic")
        amount = random.uniform(-1, 1) if moving else 0.0
        axis = np.eye(3)["XYZ".index(str(joint.axis))] if moving and joint.type != TYPES.D6Joint else None
        if axis is None and moving:
            continue
        motion = joint_pose_of(chain[0].kind, axis, amount) if moving else np.eye(4)
        expected = frames[0] @ motion @ np.linalg.inv(frames[1])
        found = np.eye(4)
        for one in chain:
            found = found @ joint_pose(one, amount if one is chain[0] else 0.0)
        if reverse:
            expected = np.linalg.inv(expected)
        size = max(1.0, *(np.abs(frame[:3, 3]).max() for frame in frames))
        gap = np.abs(found - expected).max()
        assert gap <= tolerance * size, f"joint {joint.primPath}: the child's pose differs by {gap:.3g}"
    reached = len([joint for joint in robot.joints if joint.child in names.values()]) - sum(joint.name.endswith("_free") for joint in robot.joints)
    assert tree >= reached, f"joints of the tree: {reached}, not {tree}"


def joint_pose_of(kind, axis, amount):
    return rigid(np.eye(3), axis * amount) if kind == "prismatic" else rigid(about(axis, amount), np.zeros(3))
