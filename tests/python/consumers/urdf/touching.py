"""Obstacles that touch a robot's original geometry by known depths, and which of them a program finds."""

import functools
from typing import NamedTuple

import coal
import numpy as np
import pinocchio
from pinocchio_test import configuration, load
from urdf_truth import Truth

SPHERES = [0.01, 0.015, 0.02, 0.03, 0.05]  #: m; radii of the obstacles
#: m; halves of the sides of the obstacles that are boxes
BOXES = [(0.01, 0.01, 0.01), (0.02, 0.01, 0.005), (0.01, 0.03, 0.02), (0.03, 0.03, 0.01), (0.04, 0.02, 0.03)]
COUNT = len(SPHERES) + len(BOXES)
DEPTHS = (1e-5, 3e-3)  #: m; a touch is as deep as a random number between these, uniform by its logarithm


def farthest(shape, along, random):
    """Return the point of a shape that is farthest along a direction; half of the time, any corner of a mesh."""
    if isinstance(shape, coal.Box):
        return np.copysign(shape.halfSide, along)
    if isinstance(shape, coal.Cylinder):
        flat = np.array([along[0], along[1], 0])
        return shape.radius * flat / np.linalg.norm(flat) + [0, 0, np.copysign(shape.halfLength, along[2])]
    corners = corners_of(shape)
    return corners[np.argmax(corners @ along) if random.random() < 0.5 else random.integers(len(corners))]


@functools.cache
def corners_of(mesh):
    return mesh.vertices().copy()


def turned_to(along, random):
    """Return a random rotation that takes z to a direction."""
    across = np.cross(along, random.normal(size=3))
    across /= np.linalg.norm(across)
    return np.column_stack([across, np.cross(along, across), along])


class Pose(NamedTuple):
    """The values of a robot's joints; by obstacle its place in the frame of the root, and how deep it touches, in m."""

    values: dict
    places: tuple
    depths: tuple


def touch(geometry, placed, i, obstacle, random):
    """Return where obstacle i touches a random element of the original geometry, and how deep."""
    number = int(random.integers(geometry.ngeoms))
    original, at = geometry.geometryObjects[number].geometry, placed.oMg[number]
    along = random.normal(size=3)
    along /= np.linalg.norm(along)
    depth = np.exp(random.uniform(*np.log(DEPTHS)))
    point = at.act(farthest(original, along, random))
    along = at.rotation @ along
    place = np.eye(4)
    place[:3, :3] = turned_to(along, random)
    if i < len(SPHERES):
        place[:3, 3] = point + along * (SPHERES[i] - depth)
    else:  # within half of the side of the box, so that its corners and edges play no part
        half = np.array(BOXES[i - len(SPHERES)])
        beside = random.uniform(-0.5, 0.5, 3) * half * (1, 1, 0)
        place[:3, 3] = point + along * (half[2] - depth) + place[:3, :3] @ beside
    confirmed = coal.collide(
        original, transform(at.homogeneous), obstacle, transform(place), coal.CollisionRequest(), coal.CollisionResult()
    )
    # A mesh may have corners without triangles.
    return (place, depth) if confirmed else touch(geometry, placed, i, obstacle, random)


def poses_of(file, count):
    """Return random poses of a robot. Each obstacle touches the original geometry, which coal confirms."""
    truth, random = Truth(file), np.random.default_rng(3)
    model, geometry = load(file)
    data, placed = model.createData(), pinocchio.GeometryData(geometry)
    found = []
    for _ in range(count):
        values = truth.all_values(truth.random_values(random))
        pinocchio.updateGeometryPlacements(model, data, geometry, placed, configuration(model, values))
        places, depths = zip(
            *(touch(geometry, placed, i, obstacle, random) for i, obstacle in enumerate(obstacles())), strict=True
        )
        found.append(Pose(values, places, depths))
    return found


def obstacles():
    return [coal.Sphere(radius) for radius in SPHERES] + [coal.Box(*(2 * np.array(half))) for half in BOXES]


def transform(matrix):
    return coal.Transform3s(matrix[:3, :3], matrix[:3, 3])


def missed(program, poses):
    """Return the depths of the touches that a program does not find, in m."""
    found = [(pose, program(pose)) for pose in poses]
    return [depth for pose, touched in found for i, depth in enumerate(pose.depths) if i not in touched]
