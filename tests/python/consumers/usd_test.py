"""load.usd and write.usd with the real OpenUSD: what is read of a stage, and a layer over it whose prims are all alive."""
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdUtils

import foam

os.environ["FOAM_PYTHON"] = sys.executable


def body(stage, path, place=(0, 0, 0), turn=0.0, scale=(1, 1, 1)):
    """Returns a rigid body."""
    xform = UsdGeom.Xform.Define(stage, path)
    xform.AddTranslateOp().Set(Gf.Vec3d(*place))
    xform.AddRotateZOp().Set(turn)
    xform.AddScaleOp().Set(Gf.Vec3f(*scale))
    UsdPhysics.RigidBodyAPI.Apply(xform.GetPrim())
    return xform


def collides(prim, approximation=None):
    UsdPhysics.CollisionAPI.Apply(prim.GetPrim())
    if approximation:
        UsdPhysics.MeshCollisionAPI.Apply(prim.GetPrim()).CreateApproximationAttr(approximation)
    return prim


def hinge(stage, path, parent, child, at=(0, 0, 0), of_child=(0, 0, 0), turn=(1, 0, 0, 0), axis="Z", limits=(-90, 45), kind=UsdPhysics.RevoluteJoint):
    joint = kind.Define(stage, path)
    if parent:
        joint.CreateBody0Rel().SetTargets([parent])
    joint.CreateBody1Rel().SetTargets([child])
    joint.CreateLocalPos0Attr(Gf.Vec3f(*at))
    joint.CreateLocalPos1Attr(Gf.Vec3f(*of_child))
    joint.CreateLocalRot0Attr(Gf.Quatf(*turn))
    joint.CreateLocalRot1Attr(Gf.Quatf(*turn))
    joint.CreateAxisAttr(axis)
    if limits:
        joint.CreateLowerLimitAttr(limits[0])
        joint.CreateUpperLimitAttr(limits[1])
    return joint


CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def mesh(stage, path, size=1.0, flipped=False):
    made = UsdGeom.Mesh.Define(stage, path)
    made.CreatePointsAttr([Gf.Vec3f(*(size * c for c in p)) for p in CORNERS])
    made.CreateFaceVertexCountsAttr([4] * 6)
    made.CreateFaceVertexIndicesAttr([c for side in SIDES for c in (side[::-1] if flipped else side)])
    if flipped:
        made.CreateOrientationAttr("leftHanded")
    return made


def arm(folder, metre=1.0, up="Z"):
    """Writes a robot with nested bodies, scaled ones, instances, primitives and meshes; returns its file."""
    stage = Usd.Stage.CreateNew(str(folder / "arm.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, metre)
    UsdGeom.SetStageUpAxis(stage, up)
    u = 1 / metre
    root = UsdGeom.Xform.Define(stage, "/World/arm")
    stage.SetDefaultPrim(stage.GetPrimAtPath("/World"))
    UsdPhysics.ArticulationRootAPI.Apply(root.GetPrim())
    body(stage, "/World/arm/base", (0.1 * u, 0, 0), 30)
    cube = collides(UsdGeom.Cube.Define(stage, "/World/arm/base/box"))
    cube.CreateSizeAttr(0.2 * u)
    cube.AddScaleOp().Set(Gf.Vec3f(1, 2, 0.5))
    # The body within another one, and scaled.
    body(stage, "/World/arm/base/upper", (0, 0, 0.3 * u), 0, (2, 2, 2))
    rod = collides(UsdGeom.Capsule.Define(stage, "/World/arm/base/upper/rod"))
    rod.CreateRadiusAttr(0.02 * u)
    rod.CreateHeightAttr(0.1 * u)
    rod.CreateAxisAttr("X")
    rod.AddTranslateOp().Set(Gf.Vec3d(0.05 * u, 0, 0))
    look = UsdGeom.Sphere.Define(stage, "/World/arm/base/upper/look")
    look.CreateRadiusAttr(0.01 * u)
    # An instance, below the prim with the collision.
    stage.CreateClassPrim("/Parts")
    UsdGeom.Xform.Define(stage, "/Parts/pad")
    mesh(stage, "/Parts/pad/hull", 0.05 * u, flipped=True)
    body(stage, "/World/arm/hand", (0.1 * u, 0, 0.6 * u), 0)
    shared = UsdGeom.Xform.Define(stage, "/World/arm/hand/pad")
    shared.GetPrim().GetReferences().AddInternalReference("/Parts/pad")
    shared.GetPrim().SetInstanceable(True)
    shared.AddTranslateOp().Set(Gf.Vec3d(0, 0.02 * u, 0))
    collides(shared)
    ellipsoid = collides(UsdGeom.Sphere.Define(stage, "/World/arm/hand/egg"))
    ellipsoid.CreateRadiusAttr(0.1 * u)
    ellipsoid.AddScaleOp().Set(Gf.Vec3f(1, 0.5, 0.25))
    hinge(stage, "/World/arm/shoulder", "/World/arm/base", "/World/arm/base/upper", (0, 0, 0.3 * u))
    hinge(stage, "/World/arm/wrist", "/World/arm/base/upper", "/World/arm/hand", (0, 0.05 * u, 0.15 * u), (0.01 * u, 0, 0), (0.8, 0.6, 0, 0), "Y")
    stage.Save()
    return folder / "arm.usda"


def told(file):
    """Returns what robot_of_usd.py prints."""
    program = os.path.join(os.environ["FOAM_TEST_SOURCE"], "plugins/load_usd/robot_of_usd.py")
    done = subprocess.run([sys.executable, program, str(file)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_units_do_not_matter(tmp_path):
    volumes = []
    for name, metre in (("m", 1.0), ("cm", 0.01), ("mm", 0.001)):
        (tmp_path / name).mkdir()
        robot = foam.load(arm(tmp_path / name, metre))
        volumes.append([robot.collision_mesh(link).volume for link in robot.links_with_geometry])
        assert [link for link in robot.links_with_geometry] == ["base", "upper", "hand"]
    np.testing.assert_allclose(volumes[1:], [volumes[0]] * 2, rtol=1e-5)  # single precision in the file
    expected_base, expected_rod = 0.2**3, np.pi * 0.04**2 * 0.2 + 4 / 3 * np.pi * 0.04**3
    np.testing.assert_allclose(volumes[0][:2], [expected_base, expected_rod], rtol=3e-3)  # rods are measured as meshes


@pytest.mark.parametrize("up", ["Z", "Y"])
def test_the_joints_keep_frames_together(up, tmp_path):
    data = told(arm(tmp_path, up=up))
    kinds = {joint["name"]: joint["kind"] for joint in data["joints"]}
    assert kinds == {"shoulder": "revolute", "wrist": "revolute", "wrist_fixed": "fixed"}
    assert data["root"] == "base"
    shoulder = next(joint for joint in data["joints"] if joint["name"] == "shoulder")
    np.testing.assert_allclose([row[3] for row in shoulder["pose"]], [0, 0, 0.3], atol=1e-7)
    np.testing.assert_allclose([shoulder["lower"], shoulder["upper"]], [-np.pi / 2, np.pi / 4], rtol=1e-6)
    assert shoulder["axis"] == [0, 0, 1]


def test_a_turn_about_a_point_beside_the_origin_is_kept(tmp_path):
    """The frame of a child moves as the equations of USD physics say."""
    data = told(arm(tmp_path))
    angle = 0.4
    joints = {joint["name"]: joint for joint in data["joints"]}
    wrist, fixed = (np.vstack([joints[name]["pose"], [0, 0, 0, 1]]) for name in ("wrist", "wrist_fixed"))
    turned = np.eye(4)
    turned[:3, :3] = np.array(Gf.Matrix3d(Gf.Rotation(Gf.Vec3d(*joints["wrist"]["axis"]), np.degrees(angle)))).T
    scale = 2.0  # of the body upper: positions of a frame are scaled with it
    quaternion = Gf.Rotation(Gf.Quatd(0.8, 0.6, 0, 0))
    first = Gf.Matrix4d().SetRotate(quaternion).SetTranslateOnly(Gf.Vec3d(0, 0.05 * scale, 0.15 * scale))
    second = Gf.Matrix4d().SetRotate(quaternion).SetTranslateOnly(Gf.Vec3d(0.01, 0, 0))
    motion = Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d(0, 1, 0), np.degrees(angle)))
    expected = np.array(second.GetInverse() * motion * first).T @ np.eye(4)
    np.testing.assert_allclose(wrist @ turned @ fixed, expected, atol=1e-6)  # single precision in the file
    assert data["name"] == "World"


@pytest.mark.parametrize("metre, up", [(1.0, "Z"), (0.01, "Z"), (0.01, "Y")])
@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "hull"])
def test_the_layer_lies_over_the_stage(kind, metre, up, tmp_path):
    file = arm(tmp_path, metre, up)
    robot = foam.load(file)
    model = robot.spherize(20, effort="fast") if kind == "sphere" else robot.approximate(8, kinds=[kind], effort="fast")
    out = tmp_path / "out" / "arm_elements.usda"
    out.parent.mkdir()
    model.save(out)
    stage = Usd.Stage.Open(str(out))
    assert not stage.GetCompositionErrors()
    assert stage.GetDefaultPrim().GetPath() == "/World"
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)) == (metre, up)
    alive = [prim for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())]
    own = stage.GetRootLayer()
    overs = []
    own.Traverse("/", lambda path: overs.append(path) if path.IsPrimPath() else None)
    assert set(overs) <= {prim.GetPath() for prim in alive}, "every over is alive"
    on = {str(prim.GetPath()) for prim in alive if prim.HasAPI(UsdPhysics.CollisionAPI) and UsdPhysics.CollisionAPI(prim).GetCollisionEnabledAttr().Get()}
    assert on and all("/foam_spheres/" in path for path in on), "the old colliders are off"
    # What OpenUSD composes is what was proved: the layer's elements in metres, by link.
    model.save(tmp_path / "model.json")
    made = json.loads((tmp_path / "model.json").read_text())["links"]
    links = {link["name"]: link["collisions"] for link in told(out)["links"] if link["collisions"]}
    assert set(links) == {"base", "upper", "hand"}
    for name, shapes in links.items():
        assert {shape["kind"] for shape in shapes} == {"mesh" if kind == "hull" else kind}
        if kind == "sphere":
            found = sorted([*(row[3] for row in shape["pose"]), shape["size"][0]] for shape in shapes)
            wanted = sorted(made[name]["spheres"])
            np.testing.assert_allclose(found, wanted, atol=2e-7)
    composed = foam.load(out)
    for link in links:
        inner, outer = (np.asarray(one.collision_mesh(link).vertices) for one in (robot, composed))
        assert (outer.min(axis=0) <= inner.min(axis=0) + 1e-6).all() and (outer.max(axis=0) >= inner.max(axis=0) - 1e-6).all()
    done = subprocess.run([os.environ["FOAM_TEST_BINARY"], "certify", file, out], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_packages_and_binary_layers_are_read(tmp_path):
    file = arm(tmp_path)
    Usd.Stage.Open(str(file)).Export(str(tmp_path / "arm.usdc"))
    UsdUtils.CreateNewUsdzPackage(str(tmp_path / "arm.usdc"), str(tmp_path / "arm.usdz"))
    volumes = [foam.load(tmp_path / f"arm.{ending}").collision_mesh("hand").volume for ending in ("usda", "usdc", "usdz")]
    assert volumes[0] == volumes[1] == volumes[2]


def test_what_is_not_there_is_an_error(tmp_path):
    (tmp_path / "gone.usda").write_text('#usda 1.0\ndef Xform "r" (references = @./none.usd@) {}\n')
    with pytest.raises(foam.InputError, match="refers to what is not there"):
        foam.load(tmp_path / "gone.usda")
    (tmp_path / "bare.usda").write_text('#usda 1.0\ndef Xform "r" {}\n')
    with pytest.raises(foam.InputError, match="no prim has PhysicsRigidBodyAPI"):
        foam.load(tmp_path / "bare.usda")
    (tmp_path / "points.usda").write_text(  # copies by points
        '#usda 1.0\ndef PointInstancer "p"\n{\n    def Sphere "s" (\n        prepend apiSchemas = ["PhysicsCollisionAPI"]\n    )\n    {\n    }\n}\n'
    )
    with pytest.raises(foam.InputError, match="PointInstancer"):
        foam.load(tmp_path / "points.usda")
    (tmp_path / "broken.usda").write_text('#usda 1.0\ndef Xform "r" {')
    with pytest.raises(foam.InputError, match=r"broken.usda:\d+:\d+: "):
        foam.load(tmp_path / "broken.usda")


def test_loops_and_several_robots(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "two.usda"))
    for number, name in enumerate("abcd"):
        body(stage, f"/{name}", (number, 0, 0))
        collides(UsdGeom.Sphere.Define(stage, f"/{name}/ball"))
    for parent, child in (("a", "b"), ("b", "c"), ("c", "a")):
        hinge(stage, f"/{parent}_{child}", f"/{parent}", f"/{child}")
    stage.Save()
    data = told(tmp_path / "two.usda")
    assert data["root"] == "world"
    assert [(j["kind"], j["parent"], j["child"]) for j in data["joints"] if j["kind"] == "floating"] == [("floating", "world", "a"), ("floating", "world", "d")]
    assert "close a loop" in data["warnings"][0]


def shapes_of(folder, define):
    """Returns the collision geometry of the one link that `define` makes shapes in."""
    stage = Usd.Stage.CreateNew(str(folder / "shapes.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    body(stage, "/link")
    define(stage)
    stage.Save()
    return foam.load(folder / "shapes.usda").collision_mesh("link"), told(folder / "shapes.usda")["links"][0]["collisions"]


def test_cylinders_lie_along_their_axis(tmp_path):
    def define(stage):
        for axis, place in (("X", 0), ("Y", 5), ("Z", 10)):
            cylinder = collides(UsdGeom.Cylinder.Define(stage, f"/link/{axis}"))
            cylinder.CreateAxisAttr(axis)
            cylinder.CreateRadiusAttr(0.1)
            cylinder.CreateHeightAttr(2)
            cylinder.AddTranslateOp().Set(Gf.Vec3d(place, place, place))

    _, shapes = shapes_of(tmp_path, define)
    assert [shape["size"] for shape in shapes] == [[0.1, 2]] * 3
    for shape, axis in zip(shapes, np.eye(3), strict=True):
        np.testing.assert_allclose([row[2] for row in shape["pose"]], axis, atol=1e-12)


def cone(stage):
    made = UsdGeom.Cone.Define(stage, "/link/cone")
    made.CreateRadiusAttr(0.5)
    made.CreateHeightAttr(2)
    made.CreateAxisAttr("X")
    return made, np.pi * 0.5**2 * 2 / 3


def sheared(stage):
    made = UsdGeom.Cube.Define(stage, "/link/cube")
    made.CreateSizeAttr(1)
    made.AddTransformOp().Set(Gf.Matrix4d(1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1))
    return made, 1.0


def flat_capsule(stage):
    made = UsdGeom.Capsule.Define(stage, "/link/capsule")
    made.CreateRadiusAttr(0.5)
    made.CreateHeightAttr(1)
    made.AddScaleOp().Set(Gf.Vec3f(1, 1, 0.5))
    return made, (np.pi * 0.5**2 + 4 / 3 * np.pi * 0.5**3) / 2


def frustum(stage):
    made = UsdGeom.Cylinder_1.Define(stage, "/link/frustum")
    made.CreateRadiusBottomAttr(0.5)
    made.CreateRadiusTopAttr(0.25)
    made.CreateHeightAttr(1)
    return made, np.pi * (0.5**2 + 0.5 * 0.25 + 0.25**2) / 3


@pytest.mark.parametrize("define", [cone, sheared, flat_capsule, frustum])
def test_other_convex_shapes_become_meshes_that_hold_them(define, tmp_path):
    made = []
    mesh_made, shapes = shapes_of(tmp_path, lambda stage: made.append(define(stage)) or collides(made[0][0]))
    assert shapes[0]["kind"] == "mesh"
    assert 1 - 1e-9 <= mesh_made.volume / made[0][1] < 1.02


@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (-1, -2, -1)])
@pytest.mark.parametrize("flipped", [False, True])
def test_meshes_are_seen_from_outside(flipped, scale, tmp_path):
    def define(stage):
        collides(mesh(stage, "/link/mesh", 0.5, flipped)).AddScaleOp().Set(Gf.Vec3f(*scale))

    made, _ = shapes_of(tmp_path, define)
    assert made.volume == pytest.approx(abs(np.prod(scale)))


def test_approximations_say_what_collides(tmp_path):
    def define(stage):
        for number, approximation in enumerate((None, "none", "convexHull", "boundingCube", "convexDecomposition")):
            collides(mesh(stage, f"/link/m{number}", 0.5), approximation)
        off = collides(UsdGeom.Sphere.Define(stage, "/link/off"))
        UsdPhysics.CollisionAPI(off.GetPrim()).CreateCollisionEnabledAttr(False)
        collides(UsdGeom.Plane.Define(stage, "/link/ground"))

    _, shapes = shapes_of(tmp_path, define)
    assert [shape["hull"] for shape in shapes] == [False, False, True, True, False]
