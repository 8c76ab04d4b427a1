"""No missed collision: what touches the original geometry touches the written model, in each program and by each kind.

In every pose ten obstacles touch a random element each, by 0.01 to 3 mm. A touch that a program misses is as deep as
what the model lacks there.
"""

import coal
import numpy as np
import pinocchio
import pytest
import touching
from pinocchio_test import configuration, load
from urdf_truth import KINDS, Truth

#: Programs and kinds that foam is told of by --for: they change shapes, or have a word for capsules.
FOR = {
    ("coal", "capsule"): "coal",
    ("mujoco", "capsule"): "coal",  # one element, as in MJCF
    ("drake", "capsule"): "drake",
    ("pybullet", "capsule"): "pybullet",
    ("pybullet", "box"): "pybullet",
    ("pybullet", "swept_box"): "pybullet",  # one that is nearly a box is a box
    ("pybullet", "cylinder"): "pybullet",
    ("sapien", "capsule"): "physx",
    ("sapien", "cylinder"): "physx",
}
#: Kinds that foam refuses for a program, which misses some of their contacts, however deep they are.
REFUSED = {("sapien", "swept_box"): "physx", ("sapien", "hull"): "physx"}
SINGLE = 3e-6  #: m; numbers in single precision, and the tolerances of iterations


class Coal:
    """The elements by Pinocchio and coal. Hulls are made convex: of a mesh coal only knows the surface."""

    def __init__(self, robot, file, _):
        self.model, self.geometry = load(file)
        for one in self.geometry.geometryObjects:
            if isinstance(one.geometry, coal.BVHModelBase):
                one.geometry.buildConvexHull(True, "Qt")
                one.geometry = one.geometry.convex
        self.data, self.placed = self.model.createData(), pinocchio.GeometryData(self.geometry)
        self.obstacles = touching.obstacles()
        self.manager = coal.DynamicAABBTreeCollisionManager()
        self.elements = [
            coal.CollisionObject(one.geometry, coal.Transform3s()) for one in self.geometry.geometryObjects
        ]
        self.manager.registerObjects(self.elements)

    def __call__(self, pose):
        pinocchio.updateGeometryPlacements(
            self.model, self.data, self.geometry, self.placed, configuration(self.model, pose.values)
        )
        for element, at in zip(self.elements, self.placed.oMg, strict=True):
            element.setTransform(touching.transform(at.homogeneous))
            element.computeAABB()
        self.manager.update()
        found = set()
        for i, (shape, place) in enumerate(zip(self.obstacles, pose.places, strict=True)):
            hit = coal.CollisionCallBackDefault()
            self.manager.collide(coal.CollisionObject(shape, touching.transform(place)), hit)
            if hit.data.result.isCollision():
                found.add(i)
        return found


class Mujoco:
    """The MJCF by MuJoCo. Obstacles move freely: two bodies that are fixed do not collide, and a root is fixed."""

    def __init__(self, robot, file, in_mujoco):
        self.mujoco = pytest.importorskip("mujoco")
        spec = self.mujoco.MjSpec.from_file(str(in_mujoco(robot, file)))
        kinds = self.mujoco.mjtGeom
        for i in range(touching.COUNT):
            ball = i < len(touching.SPHERES)
            size = [touching.SPHERES[i], 0, 0] if ball else list(touching.BOXES[i - len(touching.SPHERES)])
            body = spec.worldbody.add_body(name=f"obstacle_{i}")
            body.add_freejoint()
            body.add_geom(type=kinds.mjGEOM_SPHERE if ball else kinds.mjGEOM_BOX, size=size, contype=2, conaffinity=1)
        self.model = spec.compile()
        first = self.model.geom_bodyid - self.model.body("obstacle_0").id
        self.obstacle = np.maximum(first, -1)  # by geom: the obstacle's number, or -1
        elements = (first < 0) & (self.model.geom_contype > 0)
        self.model.geom_contype[elements], self.model.geom_conaffinity[elements] = 1, 2
        self.data = self.mujoco.MjData(self.model)

    def __call__(self, pose):
        for name, value in pose.values.items():
            self.data.qpos[self.model.joint(name).qposadr] = value
        for i, place in enumerate(pose.places):
            at = self.data.qpos[len(self.data.qpos) - 7 * (touching.COUNT - i) :][
                :7
            ]  # the obstacles' joints are the last ones
            at[:3] = place[:3, 3]
            self.mujoco.mju_mat2Quat(at[3:], place[:3, :3].ravel())
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_collision(self.model, self.data)
        pairs = self.obstacle[self.data.contact.geom[self.data.contact.dist <= 0]]
        return set(pairs.max(axis=1)) if len(pairs) else set()


class Drake:
    """The URDF by Drake. Obstacles are bodies beside the robot."""

    def __init__(self, robot, file, _):
        pytest.importorskip("pydrake")
        import drake_test
        import pydrake.geometry
        from pydrake.math import RigidTransform
        from pydrake.multibody.plant import CoulombFriction
        from pydrake.multibody.tree import SpatialInertia, default_model_instance

        self.transform, self.place, self.root = RigidTransform, drake_test.place, Truth(file).root
        geometry = pydrake.geometry
        builder, self.plant, scene = drake_test.parsed(file)
        self.plant.WeldFrames(self.plant.world_frame(), self.plant.GetFrameByName(self.root))
        unit = SpatialInertia.SolidSphereWithMass(1, 1)
        self.bodies = [
            self.plant.AddRigidBody(f"obstacle_{i}", default_model_instance(), unit) for i in range(touching.COUNT)
        ]
        shapes = [geometry.Sphere(r) for r in touching.SPHERES] + [
            geometry.Box(*(2 * np.array(half))) for half in touching.BOXES
        ]
        ids = [
            self.plant.RegisterCollisionGeometry(body, RigidTransform(), shape, "shape", CoulombFriction(1, 1))
            for body, shape in zip(self.bodies, shapes)
        ]
        self.obstacle = {one: i for i, one in enumerate(ids)}
        self.plant.Finalize()
        inspector = scene.model_inspector()
        everything = set(
            inspector.GetGeometryIds(geometry.GeometrySet(inspector.GetAllGeometryIds()), geometry.Role.kProximity)
        )
        for group in (set(ids), everything - set(ids)):
            scene.collision_filter_manager().Apply(
                geometry.CollisionFilterDeclaration().ExcludeWithin(geometry.GeometrySet(list(group)))
            )
        self.diagram = builder.Build()
        whole = self.diagram.CreateDefaultContext()
        self.context = self.plant.GetMyContextFromRoot(whole)
        self.port = self.plant.get_geometry_query_input_port()

    def __call__(self, pose):
        self.place(self.plant, self.context, pose.values)
        for body, place in zip(self.bodies, pose.places, strict=True):
            self.plant.SetFreeBodyPose(self.context, body, self.transform(place))
        pairs = self.port.Eval(self.context).ComputePointPairPenetration()
        return {self.obstacle[one] for pair in pairs for one in (pair.id_A, pair.id_B) if one in self.obstacle}


class Bullet:
    """The URDF by PyBullet, whose cylinders are cylinders."""

    def __init__(self, robot, file, _):
        self.bullet = pytest.importorskip("pybullet")
        import pybullet_test

        if not self.bullet.isConnected():
            self.bullet.connect(self.bullet.DIRECT)
        self.bullet.resetSimulation()
        self.robot = self.bullet.loadURDF(str(file), useFixedBase=True, flags=self.bullet.URDF_USE_IMPLICIT_CYLINDER)
        _, self.joints = pybullet_test.names_of(self.robot)
        made = [self.bullet.createCollisionShape(self.bullet.GEOM_SPHERE, radius=radius) for radius in touching.SPHERES]
        made += [self.bullet.createCollisionShape(self.bullet.GEOM_BOX, halfExtents=half) for half in touching.BOXES]
        self.bodies = [self.bullet.createMultiBody(1, shape) for shape in made]
        # The URDF's root is where its inertia is: PyBullet places that frame.
        self.bullet.resetBasePositionAndOrientation(self.robot, *self.bullet.getDynamicsInfo(self.robot, -1)[3:5])

    def __call__(self, pose):
        for name, value in pose.values.items():
            self.bullet.resetJointState(self.robot, self.joints[name], value)
        for body, place in zip(self.bodies, pose.places, strict=True):
            turned = pinocchio.Quaternion(place[:3, :3]).coeffs()
            self.bullet.resetBasePositionAndOrientation(body, place[:3, 3], turned)
        self.bullet.performCollisionDetection()
        return {
            i
            for i, body in enumerate(self.bodies)
            if any(point[8] <= 0 for point in self.bullet.getContactPoints(self.robot, body))
        }


class Sapien:
    """The URDF by SAPIEN. Contacts are those at the begin of a step."""

    def __init__(self, robot, file, _):
        pytest.importorskip("sapien")
        import sapien_test

        self.sapien = sapien_test.sapien
        self.scene, self.robot = sapien_test.load(file)
        self.names = [joint.name for joint in self.robot.active_joints]
        self.bodies = []
        for i in range(touching.COUNT):
            builder = self.scene.create_actor_builder()
            if i < len(touching.SPHERES):
                builder.add_sphere_collision(radius=touching.SPHERES[i])
            else:
                builder.add_box_collision(half_size=touching.BOXES[i - len(touching.SPHERES)])
            self.bodies.append(builder.build())
        self.obstacle = {body.per_scene_id: i for i, body in enumerate(self.bodies)}

    def __call__(self, pose):
        values = [pose.values[name] for name in self.names]
        self.robot.set_qpos(values)
        self.robot.set_qvel(np.zeros(len(values)))
        for body, place in zip(self.bodies, pose.places, strict=True):
            body.set_pose(self.sapien.Pose(place))
        self.scene.step()
        found = set()
        for contact in self.scene.get_contacts():
            if any(point.separation <= 0 for point in contact.points):
                found |= {self.obstacle.get(body.entity.per_scene_id) for body in contact.bodies} - {None}
        return found


PROGRAMS = {"coal": Coal, "mujoco": Mujoco, "drake": Drake, "pybullet": Bullet, "sapien": Sapien}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", PROGRAMS)
def test_no_collision_is_missed(name, kind, models, touches, in_mujoco):
    """Compare with coal on the original geometry."""
    if (name, kind) in REFUSED:
        assert "foam writes no hulls for PhysX" in models.refused(kind, REFUSED[name, kind])
        return
    deepest = 0.0
    files = models.told(kind, FOR[name, kind]) if (name, kind) in FOR else models(kind)[::2]
    for robot, file in zip(("panda", "walker"), files, strict=True):
        missed = touching.missed(PROGRAMS[name](robot, file, in_mujoco), touches[robot])
        deepest = max([deepest, *missed])
        print(f"{name} {kind} {robot}: {len(missed)} touches missed, the deepest {1e3 * max(missed, default=0):.4f} mm")
    assert deepest <= SINGLE
