"""Compare what foam reads from an SDF with what Drake reads: links, shapes that collide, world poses at random joint values."""
import logging
import re

import numpy as np
from placed import Shape, compare_shapes, link_poses
from pydrake.geometry import Box, Capsule, Convex, Cylinder, Ellipsoid, HalfSpace, Mesh, Sphere
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.multibody.tree import BodyIndex, JointIndex, PrismaticJoint, RevoluteJoint
from pydrake.systems.framework import DiagramBuilder

import foam

logging.getLogger("drake").setLevel(logging.CRITICAL)


class Drake:
    """An SDF as Drake reads it."""

    def __init__(self, file, folder, packages=()):
        builder = DiagramBuilder()
        self.plant, scene = AddMultibodyPlantSceneGraph(builder, 0.0)
        parser = Parser(self.plant)
        parser.package_map().PopulateFromFolder(str(folder))
        for package in packages:
            parser.package_map().Add(package.name, str(package))
        try:
            parser.AddModels(str(file))
        except RuntimeError as error:  # a package without package.xml: the folder of that name
            unknown = re.search("unknown package '([^']+)'", str(error))
            found = unknown and next((f for f in [*file.parents, *folder.rglob(unknown[1])] if f.name == unknown[1] and f.is_dir()), None)
            if not found or found in packages:
                raise
            self.__init__(file, folder, (*packages, found))
            return
        self.plant.Finalize()
        self.scene = scene.model_inspector()
        self.bodies = {}
        for i in range(1, self.plant.num_bodies()):  # the world is the first
            body = self.plant.get_body(BodyIndex(i))
            self.bodies[body.scoped_name().get_full()] = body

    def shapes(self, body):
        found = []
        for geometry in self.plant.GetCollisionGeometriesForBody(body):
            shape = self.scene.GetShape(geometry)
            if not isinstance(shape, HalfSpace):
                found.append(shape_of(shape, self.scene.GetPoseInFrame(geometry).GetAsMatrix4()))
        return found

    def collides(self):
        return any(self.shapes(body) for body in self.bodies.values())

    def joints(self):
        found = [self.plant.get_joint(JointIndex(i)) for i in range(self.plant.num_joints())]
        return [joint for joint in found if isinstance(joint, (RevoluteJoint, PrismaticJoint))]


def shape_of(shape, pose):
    if isinstance(shape, Sphere):
        return Shape("sphere", pose, {"radius": shape.radius()})
    if isinstance(shape, (Capsule, Cylinder)):
        return Shape(type(shape).__name__.lower(), pose, {"radius": shape.radius(), "length": shape.length()})
    if isinstance(shape, Box):
        return Shape("box", pose, {"size": shape.size()})
    if isinstance(shape, Ellipsoid):
        return Shape("ellipsoid", pose, {"radii": np.array([shape.a(), shape.b(), shape.c()])})
    assert isinstance(shape, (Mesh, Convex)), f"Drake has a {shape}"
    try:
        hull = shape.GetConvexHull()
        points = np.array([hull.vertex(i) for i in range(hull.num_vertices())])
    except RuntimeError:  # a format that Drake does not read
        points = np.asarray(foam.load(shape.source().path()).vertices) * shape.scale3()
    return Shape("mesh", points=points @ pose[:3, :3].T + pose[:3, 3])


def names_in_foam(drake, robot):
    """Return foam's link by Drake's name: without its model where the file has one model alone."""
    return {name: name if name in robot.links else name.split("::", 1)[-1] for name in drake.bodies}


def compare(robot, drake, poses=5):
    """Raise AssertionError where foam and Drake differ. Return the number of shapes."""
    names = names_in_foam(drake, robot)
    made = set(robot.links) - set(names.values())
    assert set(names.values()) <= set(robot.links), f"links: {set(names.values()) - set(robot.links)}"
    moved = {joint.child for joint in robot.joints if joint.child.endswith(f"_{joint.name.split('::')[-1]}")}
    assert made <= moved | {"world"}, f"links that Drake has not: {made - moved}"
    count = compare_shapes(robot, {names[name]: drake.shapes(body) for name, body in drake.bodies.items()})
    context, random = drake.plant.CreateDefaultContext(), np.random.default_rng(0)
    below = {joint.child: joint for joint in robot.joints}
    for pose in range(poses):
        values = {}
        for joint in drake.joints():
            own = below.get(names[joint.child_body().scoped_name().get_full()])
            if own and own.kind == "fixed":  # behind a joint that turns about another point
                own = below.get(own.parent)
            if own and own.name.split("::")[-1] == joint.name() and own.kind != "floating":
                low, high = (-np.pi, np.pi) if own.kind == "continuous" else (own.lower, own.upper)
                values[own.name] = random.uniform(low, high) if pose else 0.0
                (joint.set_angle if isinstance(joint, RevoluteJoint) else joint.set_translation)(context, values[own.name])
        check_poses(robot, drake, names, link_poses(robot, values), context)
    return count


def check_poses(robot, drake, names, found, context):
    theirs = {names[name]: drake.plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4() for name, body in drake.bodies.items()}
    size = max(1.0, *(np.abs(pose[:3, 3]).max() for pose in theirs.values()))
    base = np.eye(4) if robot.root == "world" and "world" not in theirs else theirs[robot.root]
    for link, pose in theirs.items():
        np.testing.assert_allclose((base @ found[link])[:3, 3], pose[:3, 3], rtol=0, atol=1e-9 * size, err_msg=f"link {link}")
        np.testing.assert_allclose((base @ found[link])[:3, :3], pose[:3, :3], rtol=0, atol=1e-9, err_msg=f"link {link}")
