"""Write a robot as a stage of USD: bodies and joints alone, over which write.usd lays elements."""
import numpy as np
import urdf_truth
from pxr import Gf, Usd, UsdGeom, UsdPhysics


def place(matrix):
    w, *vector = quaternion(matrix)
    return Gf.Vec3f(*map(float, matrix[:3, 3])), Gf.Quatf(w, *vector)


def quaternion(matrix):
    turn = Gf.Matrix3d(*map(float, matrix[:3, :3].T.ravel())).ExtractRotation().GetQuat()
    return [turn.GetReal(), *turn.GetImaginary()]


def towards(axis):
    """Return a rotation that takes x to an axis."""
    turn = Gf.Rotation(Gf.Vec3d(1, 0, 0), Gf.Vec3d(*map(float, axis)))
    return urdf_truth.about(np.array(turn.GetAxis()), np.radians(turn.GetAngle()))


def write(robot, file):
    """Write the robot of a URDF at the zero pose."""
    truth = urdf_truth.Truth(robot)
    top = f"/{urdf_truth.ET.parse(robot).getroot().get('name')}"
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, top).GetPrim())
    UsdPhysics.ArticulationRootAPI.Apply(stage.GetDefaultPrim())
    zero = dict.fromkeys(truth.free_joints(), 0.0)
    for name, pose in truth.link_poses(zero).items():
        body = UsdGeom.Xform.Define(stage, f"{top}/{name}")
        body.AddTransformOp().Set(Gf.Matrix4d(*map(float, pose.T.ravel())))
        UsdPhysics.RigidBodyAPI.Apply(body.GetPrim())
        UsdPhysics.MassAPI.Apply(body.GetPrim()).CreateMassAttr(1.0)
    UsdPhysics.FixedJoint.Define(stage, f"{top}/base").CreateBody1Rel().SetTargets([f"{top}/{truth.root}"])
    for one in truth.joints:
        words = {"revolute": UsdPhysics.RevoluteJoint, "prismatic": UsdPhysics.PrismaticJoint, "fixed": UsdPhysics.FixedJoint}
        joint = words[one.get("type")].Define(stage, f"{top}/{one.get('name')}")
        frame, turn = urdf_truth.pose(one.find("origin")), np.eye(4)
        if one.get("type") != "fixed":
            turn[:3, :3] = towards(urdf_truth.numbers(one.find("axis"), "xyz"))
            joint.CreateAxisAttr("X")
        joint.CreateBody0Rel().SetTargets([f"{top}/{one.find('parent').get('link')}"])
        joint.CreateBody1Rel().SetTargets([f"{top}/{one.find('child').get('link')}"])
        for end, matrix in ((0, frame @ turn), (1, turn)):
            at, rotation = place(matrix)
            getattr(joint, f"CreateLocalPos{end}Attr")(at)
            getattr(joint, f"CreateLocalRot{end}Attr")(rotation)
    stage.Export(str(file))
