"""URDFs of every kind of element in SAPIEN, and what PhysX makes of hulls."""

import warnings
import xml.etree.ElementTree as ET

import coal
import numpy as np
import pytest
import urdf_truth

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # about Vulkan
    import sapien

SINGLE = 3e-6  #: m; PhysX has single precision
#: m; PhysX leaves out corners that lie closer than 0.7 mm to the hull of those before, or 0.07 % of the size where the
#: file's numbers, before their scale, are larger than 1. Several add up.
DROPPED = 0.9e-3
SHAPES = sapien.physx
NUMBERS = {
    SHAPES.PhysxCollisionShapeSphere: lambda shape: {"radius": [shape.radius]},
    SHAPES.PhysxCollisionShapeCapsule: lambda shape: {"radius": [shape.radius], "length": [2 * shape.half_length]},
    SHAPES.PhysxCollisionShapeCylinder: lambda shape: {"radius": [shape.radius], "length": [2 * shape.half_length]},
    SHAPES.PhysxCollisionShapeBox: lambda shape: {"size": 2 * shape.half_size},
}
ALONG_Z = sapien.Pose(q=[0.5**0.5, 0, -(0.5**0.5), 0])  #: capsules and cylinders of PhysX lie along x


def load(file):
    """Return a scene with the robot. Its visuals are left out: SAPIEN wants a graphics card for their colours."""
    tree = ET.parse(file)
    for link in tree.getroot().findall("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    bare = file.with_name(f"without_visuals_{file.name}")
    tree.write(bare)
    # Contacts that are kept from step to step, as PhysX does by default, miss up to 5 % of touches of cylinders, and
    # fewer of capsules and hulls, however deep they are.
    config = sapien.physx.PhysxSceneConfig()
    config.enable_pcm, config.gravity = False, np.zeros(3)
    sapien.physx.set_scene_config(config)
    scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
    return scene, scene.create_urdf_loader().load(str(bare))


def written_hull(file):
    lines = (line.split() for line in file.read_text().splitlines())
    return np.array([line[1:4] for line in lines if line[:1] == ["v"]], float)


def farthest_outside(points, corners):
    """Return how far the farthest of some points lies from the hull of corners, in m."""
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(0, len(corners))
    mesh.addVertices(corners)
    mesh.endModel()
    mesh.buildConvexHull(True, "Qt")
    request, ball, origin = coal.DistanceRequest(), coal.Sphere(1e-9), coal.Transform3s()
    places = [coal.Transform3s(np.eye(3), point) for point in points]
    return max(coal.distance(mesh.convex, origin, ball, place, request, coal.DistanceResult()) for place in places)


@pytest.mark.parametrize("kind", urdf_truth.KINDS)
def test_places_each_element(models, kind):
    for file in models(kind):
        truth = urdf_truth.Truth(file)
        scene, robot = load(file)  # the robot lives no longer than the scene
        links = {link.name: link for link in robot.links}
        assert sum(len(link.collision_shapes) for link in robot.links) == truth.count()
        for name, elements in truth.elements.items():
            for (word, sizes, _), shape in zip(elements, links[name].collision_shapes, strict=True):
                if word == "mesh":
                    assert isinstance(shape, SHAPES.PhysxCollisionShapeConvexMesh)
                else:
                    for key, value in NUMBERS[type(shape)](shape).items():
                        np.testing.assert_allclose(value, sizes[key], rtol=1e-6)
        names = [joint.name for joint in robot.active_joints]
        round_ones = SHAPES.PhysxCollisionShapeCapsule, SHAPES.PhysxCollisionShapeCylinder
        places = {
            name: [
                shape.local_pose * ALONG_Z if isinstance(shape, round_ones) else shape.local_pose
                for shape in links[name].collision_shapes
            ]
            for name in truth.elements
        }
        for values, expected in urdf_truth.poses(file):
            everything = truth.all_values(values)
            robot.set_qpos([everything[name] for name in names])
            at = {name: links[name].entity_pose for name in expected}
            found = [(at[name] * one).to_transformation_matrix() for name in expected for one in places[name]]
            np.testing.assert_allclose(found, urdf_truth.in_a_row(expected), atol=SINGLE, err_msg=file.name)


@pytest.mark.parametrize("kind", ["swept_box", "hull"])
def test_cooked_hulls_lie_in_the_written_ones_and_lack_little(models, kind):
    lacks = []
    for file in models(kind):
        scene, robot = load(file)
        links = {link.name: link for link in robot.links}
        for link in ET.parse(file).getroot().findall("link"):
            meshes = [mesh.get("filename") for mesh in link.findall("collision/geometry/mesh")]
            shapes = links[link.get("name")].collision_shapes
            hulls = [shape for shape in shapes if isinstance(shape, SHAPES.PhysxCollisionShapeConvexMesh)]
            for filename, shape in zip(meshes, hulls, strict=True):
                written, cooked = written_hull(file.parent / filename), np.asarray(shape.vertices, float)
                assert farthest_outside(cooked, written) <= SINGLE
                lacks.append(farthest_outside(written, cooked))
    print(f"{kind}: {sum(lack > SINGLE for lack in lacks)} of {len(lacks)} hulls lack up to {1e3 * max(lacks):.3f} mm")
    assert max(lacks) <= DROPPED
