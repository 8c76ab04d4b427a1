"""Pairs of links that foam switches off: none touches on the original meshes in some poses and not in others.

Pinocchio and coal tell what touches.
"""

import collections
import itertools
import xml.etree.ElementTree as ET

import numpy as np
import pinocchio
import pytest
import urdf_truth
from pinocchio_test import configuration, load

POSES = 3000
OF_NEIGHBOURS = 40  #: for two links with one joint between them, whose relative pose is one number: evenly spread


@pytest.mark.parametrize("number", [0, 2])
def test_no_pair_that_is_off_touches_in_some_poses_only(models, in_mujoco, number):
    robot, file = models.robots[number], models("sphere")[number]
    srdf = file.with_suffix("") / "any.srdf"
    pairs = {
        frozenset((pair.get("link1"), pair.get("link2")))
        for pair in ET.parse(srdf).getroot().iter("disable_collisions")
    }
    pairs |= {
        frozenset((pair.get("body1"), pair.get("body2")))
        for pair in ET.parse(in_mujoco(robot.stem, file)).getroot().iter("exclude")
    }
    assert pairs

    truth, random = urdf_truth.Truth(robot), np.random.default_rng(5)
    names, (low, high) = list(truth.free_joints()), np.transpose(list(truth.free_joints().values()))
    spread, drawn = np.linspace(low, high, OF_NEIGHBOURS), random.uniform(low, high, (POSES, len(names)))
    model, geometry = load(robot)
    of_link = {}
    for i, one in enumerate(geometry.geometryObjects):
        of_link.setdefault(one.name.rsplit("_", 1)[0], []).append(i)

    def joints_of(pair):
        return [geometry.geometryObjects[i].parentJoint for i in pair]

    known = [
        pair
        for first, second in map(tuple, pairs)
        for pair in itertools.product(of_link.get(first, []), of_link.get(second, []))
    ]
    known = [pair for pair in known if len(set(joints_of(pair))) > 1]  # else they never move
    near = [pair for pair in known if any(model.parents[a] == b for a, b in itertools.permutations(joints_of(pair)))]
    for poses, some in ((spread, near), (drawn, [pair for pair in known if pair not in near])):
        geometry.removeAllCollisionPairs()
        for pair in some:
            geometry.addCollisionPair(pinocchio.CollisionPair(*pair))
        links = [tuple(geometry.geometryObjects[i].name.rsplit("_", 1)[0] for i in pair) for pair in some]
        data, placed, touched = model.createData(), pinocchio.GeometryData(geometry), collections.Counter()
        for values in poses:
            q = configuration(model, truth.all_values(dict(zip(names, values, strict=True))))
            pinocchio.computeCollisions(model, data, geometry, placed, q, False)
            touched.update(
                {name for name, result in zip(links, placed.collisionResults, strict=True) if result.isCollision()}
            )
        assert not {name: count for name, count in touched.items() if count < len(poses)}
