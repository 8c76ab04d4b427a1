"""Prints a robot in USD as JSON: links, joints, geometry; metres, kilograms, radians, column vectors.

robot_of_usd.py FILE   exit status 3: the package usd-core is missing; 2: the file cannot be used, with the reason in the last line

What the properties mean: https://openusd.org/release/api/usd_physics_page_front.html
"""
import sys

sys.path[:] = [folder for folder in sys.path if folder]  # not from the folder that foam runs in
import json  # noqa: E402
import math  # noqa: E402
import os  # noqa: E402
import re  # noqa: E402

try:
    from pxr import Gf, Tf, Usd, UsdGeom, UsdPhysics
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(3)

TIME = Usd.TimeCode.EarliestTime()
AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}
#: Images of x, y, z that turn z to the axis.
TURNS = {"X": ((0, 0, -1), (0, 1, 0), (1, 0, 0)), "Y": ((1, 0, 0), (0, 0, -1), (0, 1, 0)), "Z": ((1, 0, 0), (0, 1, 0), (0, 0, 1))}
#: Approximations of a mesh within which its convex hull lies.
CONVEX = ("convexHull", "boundingSphere", "boundingCube")
SIDES = 48
#: How far a primitive may be from the shape that its scale makes of it: scales and turns are often in single precision.
ROUNDING = 3e-6


class Refused(Exception):
    """Says why a file cannot be used."""


def value(attribute, default=None):
    """Returns what an attribute says; the default if it says nothing."""
    found = attribute.Get(TIME) if attribute else None
    return default if found is None else found


def plain(array):
    """Returns the numbers of an array, or lists of three for points."""
    return memoryview(array).tolist() if len(array) else []


def rigid(matrix):
    """Returns the matrix without scale and shear."""
    result = matrix.RemoveScaleShear()
    return Gf.Matrix4d().SetRotate(result.ExtractRotation()).SetTranslateOnly(matrix.ExtractTranslation())


def name_of(path, others):
    """Returns the last part of a path, or more of it where another has the same."""
    parts = str(path).strip("/").split("/")
    for count in range(1, len(parts) + 1):
        name = "_".join(parts[-count:])
        if name not in others:
            return name
    return name + "_2"


class Robot:
    """The links and joints of a stage."""

    def __init__(self, file):
        self.stage = opened(file)
        self.file = file
        self.metre = UsdGeom.GetStageMetersPerUnit(self.stage)
        self.kilogram = UsdPhysics.GetStageKilogramsPerUnit(self.stage)
        self.cache = UsdGeom.XformCache(TIME)
        up = Gf.Rotation(Gf.Vec3d(1, 0, 0), 90) if UsdGeom.GetStageUpAxis(self.stage) == "Y" else Gf.Rotation(Gf.Vec3d(1, 0, 0), 0)
        self.up = Gf.Matrix4d().SetRotate(up)
        self.notes, self.warnings = [], []
        prims = list(Usd.PrimRange(self.stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
        self.instances = [str(prim.GetPath()) for prim in prims if prim.IsInstance()]  # whose contents are shared with others
        self.bodies = {prim.GetPath(): prim for prim in prims if is_body(prim)}
        if not self.bodies and not any(prim.HasAPI(UsdPhysics.CollisionAPI) for prim in prims):
            raise Refused("no prim has PhysicsRigidBodyAPI or PhysicsCollisionAPI; remedy: a stage with physics, as converters of URDF and MJCF write it")
        self.names, self.links = {}, {}
        for path in self.bodies:
            self.names[path] = name_of(path, self.links)
            self.links[self.names[path]] = self.link(self.names[path], self.bodies[path], self.pose(path), self.inertial(path))
        self.world = name_of("world", self.links)
        self.add_geometry(prims)
        self.joints = Joints(self, prims).tree()

    def pose(self, path):
        """Returns the pose of a prim in the world, without scale."""
        return rigid(self.matrix(self.stage.GetPrimAtPath(path)))

    def matrix(self, prim):
        return self.cache.GetLocalToWorldTransform(prim) * self.up

    def body_of(self, prim):
        """Returns the path of the body that a prim belongs to; None of the world."""
        while prim and not prim.IsPseudoRoot():
            if prim.GetPath() in self.bodies:
                return prim.GetPath()
            prim = prim.GetParent()
        return None

    def link_of(self, path):
        """Returns the link of a body, or that of the world."""
        if path is not None:
            return self.links[self.names[path]]
        return self.links.setdefault(self.world, self.link(self.world, self.stage.GetDefaultPrim(), Gf.Matrix4d(1), None))

    def link(self, name, prim, pose, inertial):
        """Returns an empty link: the path of its prim, and what takes its points, in metres, to those of the prim."""
        place = Gf.Matrix4d(1)
        if prim:
            metres = Gf.Matrix4d().SetScale(1 / self.metre)
            place = metres * pose * self.matrix(prim).GetInverse()
        near = Gf.IsClose(place, Gf.Matrix4d(1), 1e-12)
        numbers = [float(i == k) if near else place[i][k] for i in range(4) for k in range(4)]
        return {"name": name, "path": str(prim.GetPath()) if prim else "", "from_metres": numbers,
                "collisions": [], "visuals": [], "colliders": [], "inertial": inertial}  # fmt: skip

    def pose_numbers(self, matrix):
        """Returns rows of rotation and translation in metres, of a matrix for row vectors."""
        turned, move = matrix.ExtractRotationMatrix().GetTranspose(), matrix.ExtractTranslation() * self.metre
        return [[*turned[row], move[row]] for row in range(3)]

    def inertial(self, path):
        """Returns the mass that a body states; None if it states none."""
        prim = self.bodies[path]
        if not prim.HasAPI(UsdPhysics.MassAPI):
            return None
        api = UsdPhysics.MassAPI(prim)
        mass = float(value(api.GetMassAttr(), 0))
        if mass <= 0:
            return None
        centre = value(api.GetCenterOfMassAttr(), Gf.Vec3f(0))
        centre = Gf.Vec3d(centre) if all(map(math.isfinite, centre)) else Gf.Vec3d(0)
        scale = self.matrix(prim) * self.pose(path).GetInverse()
        turn = value(api.GetPrincipalAxesAttr(), Gf.Quatf(0, 0, 0, 0))
        turn = Gf.Quatd(turn) if turn.GetLength() > 0 else Gf.Quatd(1)
        place = Gf.Matrix4d().SetRotate(turn).SetTranslateOnly(scale.Transform(centre))
        moments = [float(m) * self.kilogram * self.metre**2 for m in value(api.GetDiagonalInertiaAttr(), Gf.Vec3f(0))]
        return {"mass": mass * self.kilogram, "moments": moments if min(moments) > 0 else None, "pose": self.pose_numbers(place)}

    def add_geometry(self, prims):
        """Adds shapes to the links: those with collision, and those that are seen alone."""
        for prim in prims:
            if not prim.IsA(UsdGeom.Gprim):
                continue
            path = self.body_of(prim)
            collider = collider_of(prim, path)
            if collider is not None:
                refuse_scattered(prim)
                if prim.IsA(UsdGeom.Plane):
                    self.notes.append(f"{prim.GetPath()}: no elements cover a plane")
                elif enabled(collider):
                    link = self.link_of(path)
                    link["collisions"].append(self.shape(prim, path, collider))
                    link["colliders"] += [str(collider.GetPath())] if str(collider.GetPath()) not in link["colliders"] else []
            elif path is not None and seen(prim):
                try:
                    self.links[self.names[path]]["visuals"].append(self.shape(prim, path, None))
                except Refused as why:
                    self.notes.append(f"{why}; it is left out of pictures")

    def shape(self, prim, path, collider):
        """Returns a shape in the frame of its link."""
        place = self.matrix(prim) * (self.pose(path).GetInverse() if path is not None else Gf.Matrix4d(1))
        result = {"path": str(prim.GetPath()), "name": prim.GetName()}
        colours = value(UsdGeom.Gprim(prim).GetDisplayColorAttr(), [])
        if len(colours) == 1:
            result["rgba"] = [*map(float, colours[0]), 1]
        if prim.IsA(UsdGeom.Mesh):
            return result | self.mesh(prim, place, self.approximation(prim, collider))
        exact = self.primitive(prim, place)
        if exact:
            return result | exact
        corners = corners_of(prim)
        if corners is None:
            raise Refused(f"{prim.GetPath()}: foam knows no {prim.GetTypeName()}; remedy: a mesh, sphere, cube, capsule, cylinder or cone, or physics:collisionEnabled = 0")
        return result | {"kind": "mesh", "hull": True, "points": self.moved(corners, place), "triangles": []}

    def moved(self, points, place):
        """Returns the coordinates of points in metres, in plain numbers: an object of Gf for each takes a hundred times as long."""
        (a, b, c), (d, e, f), (g, h, i), (u, v, w) = [[place[row][k] * self.metre for k in range(3)] for row in range(4)]
        moved = []
        for x, y, z in points:
            moved += (a * x + d * y + g * z + u, b * x + e * y + h * z + v, c * x + f * y + i * z + w)
        return moved

    def approximation(self, prim, collider):
        """Returns how a mesh collides."""
        if collider is None:
            return "none"
        for one in (prim, collider):
            if one.HasAPI(UsdPhysics.MeshCollisionAPI):
                found = value(UsdPhysics.MeshCollisionAPI(one).GetApproximationAttr(), "none")
                if found in ("boundingSphere", "boundingCube"):
                    self.notes.append(f"{prim.GetPath()}: its convex hull is covered; the engine takes a {found} around it")
                return found
        return "none"

    def mesh(self, prim, place, approximation):
        """Returns the triangles of a mesh. Those of a mirrored one are flipped."""
        mesh = UsdGeom.Mesh(prim)
        points, counts, corners = (plain(value(a, [])) for a in (mesh.GetPointsAttr(), mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr()))
        if not points or (counts and sum(counts) != len(corners)) or any(not 0 <= c < len(points) for c in corners):
            raise Refused(f"{prim.GetPath()}: the mesh has no points, or faces of corners that are not there; remedy: mend it, or remove it")
        mirrored = (place.GetDeterminant() < 0) != (value(mesh.GetOrientationAttr(), "rightHanded") == "leftHanded")
        triangles, begin = [], 0
        for count in counts:
            face = corners[begin : begin + count]
            begin += count
            for k in range(1, count - 1):
                triangles += [face[0], face[k + 1], face[k]] if mirrored else [face[0], face[k], face[k + 1]]
        return {"kind": "mesh", "hull": approximation in CONVEX, "points": self.moved(points, place), "triangles": triangles}

    def primitive(self, prim, place):
        """Returns a primitive that its scale leaves one; None for another shape."""
        rows = [Gf.Vec3d(*place.GetRow3(i)) for i in range(3)]
        scale = [row.GetLength() for row in rows]
        if min(scale) <= 0:
            raise Refused(f"{prim.GetPath()}: its scale is 0; remedy: remove it, or scale it otherwise")
        shear = max(abs(Gf.Dot(rows[i], rows[j])) / (scale[i] * scale[j]) for i, j in ((0, 1), (1, 2), (2, 0)))
        if shear > ROUNDING:
            return None
        turned = Gf.Matrix3d(1)
        for i in range(3):
            turned.SetRow(i, rows[i] / scale[i])
        if shear > 1e-12:
            turned.Orthonormalize()
        if turned.GetDeterminant() < 0:  # they are their own mirror images
            turned.SetRow(2, -turned.GetRow(2))
        scale = [s * self.metre for s in scale]
        kind = prim.GetTypeName()
        same = lambda *of: max(of) - min(of) <= ROUNDING * max(of)  # noqa: E731
        if kind == "Cube":
            size = float(value(UsdGeom.Cube(prim).GetSizeAttr(), 2))
            return {"kind": "box", "size": [size * s for s in scale], "pose": self.placed(turned, place)}
        if kind == "Sphere":
            radius = float(value(UsdGeom.Sphere(prim).GetRadiusAttr(), 1))
            size = [radius * s for s in sorted(scale, reverse=True)] if same(*scale) else [radius * s for s in scale]
            return {"kind": "sphere" if same(*scale) else "ellipsoid", "size": size, "pose": self.placed(turned, place)}
        if kind not in ("Capsule", "Cylinder", "Capsule_1", "Cylinder_1"):
            return None
        radii, height, axis = lengths_of(prim)
        along = "XYZ".index(axis)
        across = [scale[i] for i in range(3) if i != along]
        if not same(*radii) or not same(*across) or (kind.startswith("Capsule") and not same(*scale)):
            return None
        turn = Gf.Matrix3d(*(c for row in TURNS[axis] for c in row))
        return {"kind": kind.split("_")[0].lower(), "size": [max(radii) * max(across), height * scale[along]], "pose": self.placed(turn * turned, place)}

    def placed(self, turned, place):
        return self.pose_numbers(Gf.Matrix4d().SetRotate(turned).SetTranslateOnly(place.ExtractTranslation()))


def opened(file):
    """Returns the stage of a file, of which nothing is missing."""
    try:
        stage = Usd.Stage.Open(file)
    except Tf.ErrorException as error:
        said = re.findall(r"in file \S+ : '(.*?)\s*'(?=\n\tError|\s*$)", str(error), re.DOTALL)
        raise Refused(f"it cannot be opened: {'; '.join(said) or error}") from error
    for error in stage.GetCompositionErrors():
        raise Refused(f"it refers to what is not there: {' '.join(str(error).split())}")
    return stage


def is_body(prim):
    return prim.HasAPI(UsdPhysics.RigidBodyAPI) and bool(value(UsdPhysics.RigidBodyAPI(prim).GetRigidBodyEnabledAttr(), True))


def collider_of(prim, body):
    """Returns the prim that makes a shape collide: itself, or one around it that is no shape; None if there is none."""
    while prim and not prim.IsPseudoRoot():
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            return prim
        if prim.GetPath() == body:
            return None
        prim = prim.GetParent()
        if prim and prim.IsA(UsdGeom.Gprim):
            return None
    return None


def refuse_scattered(prim):
    """Refuses shapes that a PointInstancer copies."""
    above = prim.GetParent()
    while above and not above.IsA(UsdGeom.PointInstancer):
        above = above.GetParent()
    if above:
        raise Refused(f"{prim.GetPath()}: foam does not read shapes that a PointInstancer copies; remedy: instances, or copies")


def enabled(collider):
    return bool(value(UsdPhysics.CollisionAPI(collider).GetCollisionEnabledAttr(), True))


def seen(prim):
    image = UsdGeom.Imageable(prim)
    return image.ComputePurpose() in ("default", "render") and image.ComputeVisibility(TIME) != "invisible"


def lengths_of(prim):
    """Returns the radii at both ends, height and axis of a capsule, cylinder or cone."""
    kind = prim.GetTypeName()
    shape = getattr(UsdGeom, kind)(prim)
    height, axis = float(value(shape.GetHeightAttr())), str(value(shape.GetAxisAttr(), "Z"))
    if kind.endswith("_1"):
        return [float(value(shape.GetRadiusBottomAttr())), float(value(shape.GetRadiusTopAttr()))], height, axis
    radius = float(value(shape.GetRadiusAttr()))
    return [radius, 0.0 if kind == "Cone" else radius], height, axis


def corners_of(prim):
    """Returns corners whose hull holds a convex shape; None for others."""
    kind = prim.GetTypeName()
    wider = 1 / math.cos(math.pi / SIDES)
    ring = [(math.cos(2 * math.pi * i / SIDES), math.sin(2 * math.pi * i / SIDES)) for i in range(SIDES)]
    ball = [(wider**2 * c * math.sin(a), wider**2 * s * math.sin(a), wider**2 * math.cos(a))
            for a in (math.pi * k / (SIDES // 2) for k in range(SIDES // 2 + 1)) for c, s in ring]  # fmt: skip
    if kind == "Cube":
        half = float(value(UsdGeom.Cube(prim).GetSizeAttr(), 2)) / 2
        return [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    if kind == "Sphere":
        radius = float(value(UsdGeom.Sphere(prim).GetRadiusAttr(), 1))
        return [tuple(radius * c for c in p) for p in ball]
    if kind not in ("Capsule", "Cylinder", "Cone", "Capsule_1", "Cylinder_1"):
        return None
    radii, height, axis = lengths_of(prim)
    corners = []
    for radius, end in zip(radii, (-height / 2, height / 2), strict=True):
        if kind.startswith("Capsule"):
            corners += [(radius * x, radius * y, end + radius * z) for x, y, z in ball]
        else:
            corners += [(radius * wider * c, radius * wider * s, end) for c, s in ring]
    turn = TURNS[axis]
    return [tuple(sum(p[i] * turn[i][k] for i in range(3)) for k in range(3)) for p in corners]


class Joints:
    """The joints of a robot as a tree."""

    def __init__(self, robot, prims):
        self.robot = robot
        self.edges, self.taken, self.made, self.loops, self.free = [], set(), [], [], []
        for prim in prims:
            if prim.IsA(UsdPhysics.Joint) and value(UsdPhysics.Joint(prim).GetJointEnabledAttr(), True):
                self.add(prim)

    def add(self, prim):
        joint = UsdPhysics.Joint(prim)
        ends = []
        for number in (0, 1):
            relation, position, turn = (getattr(joint, f"Get{what}{number}{kind}")()
                                        for what, kind in (("Body", "Rel"), ("LocalPos", "Attr"), ("LocalRot", "Attr")))  # fmt: skip
            targets = relation.GetTargets()
            target = self.robot.stage.GetPrimAtPath(targets[0]) if targets else None
            if targets and not target:
                raise Refused(f"{prim.GetPath()}: physics:body{number} is {targets[0]}, which is not there; remedy: correct it")
            body = self.robot.body_of(target) if target else None
            frame = Gf.Matrix4d().SetRotate(Gf.Quatd(value(turn, Gf.Quatf(1)))).SetTranslateOnly(Gf.Vec3d(value(position, Gf.Vec3f(0))))
            world = frame * self.robot.matrix(target) if target else frame * self.robot.up
            ends.append((body, rigid(world) * (self.robot.pose(body).GetInverse() if body is not None else Gf.Matrix4d(1))))
        if ends[0][0] != ends[1][0]:
            if value(joint.GetExcludeFromArticulationAttr(), False):
                self.loops.append(str(prim.GetPath()))
            else:
                self.edges.append((prim, ends))

    def tree(self):
        """Returns the joints from the root on; sets the root."""
        robot, reached = self.robot, set()
        parts = self.parts()
        with_world = None in parts[0] if parts else False
        alone = len(parts) == 1 and not with_world and robot.world not in robot.links
        roots = [self.root_of(part) for part in parts]
        robot.root = robot.names[roots[0]] if alone else robot.link_of(None)["name"]
        for part, root in zip(parts, roots, strict=True):
            if not alone and root is not None:
                self.connect("floating", name_of(f"{robot.names[root]}_free", self.taken), None, root, robot.pose(root))
            self.grow(root, reached)
        warn(robot, self.loops, "these joints close a loop; foam has trees, and leaves them out of the robot")
        warn(robot, self.free, "joints of several freedoms, and slides without limits, are read as floating, where the file has them")
        return self.made

    def parts(self):
        """Returns the sets of bodies that joints connect; None is the world, in the first one."""
        groups = {body: {body} for body in [None, *self.robot.bodies]}
        for _, ends in self.edges:
            one, other = groups[ends[0][0]], groups[ends[1][0]]
            if one is not other:
                one |= other
                groups.update(dict.fromkeys(other, one))
        found = []
        for body in [None, *self.robot.bodies]:
            if groups[body] not in found and groups[body] != {None}:
                found.append(groups[body])
        return found

    def root_of(self, part):
        """Returns the world, the root of an articulation, or the first body that no joint leads to."""
        if None in part:
            return None
        ordered = [body for body in self.robot.bodies if body in part]
        led_to = {ends[1][0] for _, ends in self.edges}
        for wanted in (lambda b: self.robot.bodies[b].HasAPI(UsdPhysics.ArticulationRootAPI), lambda b: b not in led_to, lambda b: True):
            for body in ordered:
                if wanted(body):
                    return body

    def grow(self, root, reached):
        """Adds the joints below a body, nearest first."""
        reached.add(root)
        queue, used = [root], set()
        while queue:
            at = queue.pop(0)
            for index, (prim, ends) in enumerate(self.edges):
                near = [k for k in (0, 1) if ends[k][0] == at]
                if not near or index in used:
                    continue
                used.add(index)
                below = ends[1 - near[0]][0]
                if below in reached:
                    self.loops.append(str(prim.GetPath()))
                    continue
                self.put(prim, ends[near[0]], ends[1 - near[0]], near[0] == 1)
                reached.add(below)
                queue.append(below)

    def put(self, prim, above, below, reverse):
        """Adds a joint between two frames, each in that of its body. It turns the other way if it leads to its first body."""
        name = name_of(prim.GetPath(), self.taken)
        motion = motion_of(prim, self.robot)
        (parent, first), (child, second) = above, below
        if motion["kind"] == "floating":
            self.free.append(str(prim.GetPath()))
            poses = [self.robot.pose(body) if body is not None else Gf.Matrix4d(1) for body in (parent, child)]
            self.connect("floating", name, parent, child, poses[1] * poses[0].GetInverse())
            return
        direction = second.TransformDir(Gf.Vec3d(*motion.pop("axis", (1, 0, 0)))) * (-1 if reverse else 1)
        arm = second.ExtractTranslation()
        beside = (arm - direction * Gf.Dot(arm, direction)).GetLength()
        if motion["kind"] in ("revolute", "continuous") and beside > 1e-12 * (1 + arm.GetLength()):
            turn = Gf.Matrix4d().SetRotate(second.ExtractRotation())
            middle = self.robot.link(name_of(f"{self.robot.names[child]}_{name}", self.robot.links), None, None, None)
            self.robot.links[middle["name"]] = middle
            self.connect(motion.pop("kind"), name, parent, middle["name"], turn.GetInverse() * first, axis=list(direction), **motion)
            self.connect("fixed", name_of(f"{name}_fixed", self.taken), middle["name"], child, Gf.Matrix4d().SetTranslate(-arm))
        else:
            self.connect(motion.pop("kind"), name, parent, child, second.GetInverse() * first, axis=list(direction), **motion)

    def connect(self, kind, name, parent, child, pose, **more):
        link = lambda end: end if isinstance(end, str) else self.robot.link_of(end)["name"]  # noqa: E731
        self.taken.add(name)
        self.made.append({"name": name, "kind": kind, "parent": link(parent), "child": link(child), "pose": self.robot.pose_numbers(pose), **more})


def motion_of(prim, robot):
    """Returns kind, axis, limits and effort of a joint."""
    kind = prim.GetTypeName()
    if kind == "PhysicsFixedJoint":
        return {"kind": "fixed"}
    if kind in ("PhysicsRevoluteJoint", "PhysicsPrismaticJoint"):
        joint = (UsdPhysics.RevoluteJoint if kind == "PhysicsRevoluteJoint" else UsdPhysics.PrismaticJoint)(prim)
        low, high = (float(value(a, default)) for a, default in ((joint.GetLowerLimitAttr(), -math.inf), (joint.GetUpperLimitAttr(), math.inf)))
        return limited(prim, kind == "PhysicsRevoluteJoint", AXES[str(value(joint.GetAxisAttr(), "X"))], low, high, robot)
    if kind != "PhysicsJoint":
        return {"kind": "floating"}
    free = {}
    for freedom in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ"):
        limit = UsdPhysics.LimitAPI.Get(prim, freedom)
        low, high = (float(value(a, d)) for a, d in ((limit.GetLowAttr(), -math.inf), (limit.GetHighAttr(), math.inf))) \
            if prim.HasAPI(UsdPhysics.LimitAPI, freedom) else (-math.inf, math.inf)  # fmt: skip
        if low < high:
            free[freedom] = (low, high)
    if not free:
        return {"kind": "fixed"}
    if len(free) > 1:
        return {"kind": "floating"}
    (freedom, (low, high)), = free.items()
    return limited(prim, freedom.startswith("rot"), AXES[freedom[-1]], low, high, robot)


def limited(prim, turns, axis, low, high, robot):
    """Returns the motion about or along an axis. One limit alone does not bound an angle."""
    unit = math.pi / 180 if turns else robot.metre
    bounded = math.isfinite(low) and math.isfinite(high)
    if not bounded:
        return {"kind": "continuous", "axis": axis} if turns else {"kind": "floating"}
    if low > high:  # USD: locked
        return {"kind": "fixed"}
    motion = {"kind": "revolute" if turns else "prismatic", "axis": axis, "lower": low * unit, "upper": high * unit}
    drive = "angular" if turns else "linear"
    if prim.HasAPI(UsdPhysics.DriveAPI, drive):
        force = float(value(UsdPhysics.DriveAPI.Get(prim, drive).GetMaxForceAttr(), math.inf))
        if 0 < force < 1e30:
            motion["effort"] = force * robot.kilogram * robot.metre ** (2 if turns else 1)
    speed = value(prim.GetAttribute("physxJoint:maxJointVelocity"), math.inf)
    if 0 < speed < 1e30:
        motion["velocity"] = float(speed) * unit
    return motion


def warn(robot, paths, what):
    if paths:
        robot.warnings.append(f"{what}: {', '.join(paths[:5])}{' …' if len(paths) > 5 else ''}")


def main():
    file = sys.argv[1]
    try:
        robot = Robot(file)
    except Refused as why:
        print(why, file=sys.stderr)
        sys.exit(2)
    default = robot.stage.GetDefaultPrim()
    name = default.GetName() if default else os.path.splitext(os.path.basename(file))[0]
    layers = sorted(layer.realPath for layer in robot.stage.GetUsedLayers() if os.path.isfile(layer.realPath))
    json.dump({"name": name, "root": robot.root, "default_prim": default.GetName() if default else "", "up_axis": str(UsdGeom.GetStageUpAxis(robot.stage)),
               "metres_per_unit": robot.metre, "instances": robot.instances, "layers": layers,
               "links": list(robot.links.values()), "joints": robot.joints,
               "notes": robot.notes, "warnings": robot.warnings}, sys.stdout)  # fmt: skip


if __name__ == "__main__":
    main()
