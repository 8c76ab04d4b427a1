"""A path that OMPL plans for the Panda's spheres is free for its original meshes."""

import coal
import numpy as np
import ompl.base
import ompl.geometric
import ompl.util
import pinocchio
import touching
import urdf_truth
from pinocchio_test import load

#: In the frame of the root, in m: balls by radius, boxes by the halves of their sides.
BALLS = [((0.45, 0.15, 0.75), 0.08), ((0.65, -0.1, 0.55), 0.08)]
BOXES = [((0.55, 0, 0.1), (0.25, 0.02, 0.3)), ((0.5, 0, -0.05), (0.3, 0.6, 0.02))]
START, GOAL = ([side * 0.9, 0.5, 0, -1.9, 0, 2.4, 0.8] for side in (-1, 1))  #: rad; with a wall in between


def gaps_to_obstacles(centres):
    """Return the distance of each point to the nearest obstacle, in m."""
    gaps = [np.linalg.norm(centres - at, axis=1) - radius for at, radius in BALLS]
    gaps += [np.linalg.norm(np.maximum(np.abs(centres - at) - half, 0), axis=1) for at, half in BOXES]
    return np.min(gaps, axis=0)


def test_a_path_for_the_spheres_is_free_for_the_meshes(models, tmp_path):
    robot = models.robots[0]
    file = tmp_path / "panda.urdf"
    urdf_truth.foam("spherize", robot, "-n", 60, "--effort", "fast", "-o", file)
    model, spheres = load(file)
    data, placed = model.createData(), pinocchio.GeometryData(spheres)
    radii = np.array([one.geometry.radius for one in spheres.geometryObjects])
    base = [i for i, one in enumerate(spheres.geometryObjects) if one.parentJoint == 0]

    def configuration(arm):
        return np.concatenate([np.fromiter(arm, float, 7), [0.02, 0.02]])

    def free(arm):
        pinocchio.updateGeometryPlacements(model, data, spheres, placed, configuration(arm))
        inside = gaps_to_obstacles(np.array([at.translation for at in placed.oMg])) <= radii
        inside[base] = False  # it stands on the table
        return not inside.any()

    space = ompl.base.RealVectorStateSpace(7)
    bounds = ompl.base.RealVectorBounds(7)
    for i in range(7):
        bounds.setLow(i, model.lowerPositionLimit[i])
        bounds.setHigh(i, model.upperPositionLimit[i])
    space.setBounds(bounds)
    ompl.util.setLogLevel(ompl.util.LOG_WARN)
    ompl.util.RNG.setSeed(1)
    setup = ompl.geometric.SimpleSetup(space)
    setup.setStateValidityChecker(lambda state: free([state[i] for i in range(7)]))
    ends = [space.allocState() for _ in range(2)]
    for end, values in zip(ends, (START, GOAL), strict=True):
        for i in range(7):
            end[i] = values[i]
    setup.setStartAndGoalStates(*ends)
    setup.setPlanner(ompl.geometric.RRTConnect(setup.getSpaceInformation()))
    setup.getSpaceInformation().setStateValidityCheckingResolution(0.005)
    left = iter(range(100_000))
    assert (
        setup.solve(ompl.base.PlannerTerminationCondition(lambda: next(left, None) is None))
        and setup.haveExactSolutionPath()
    )
    setup.simplifySolution()  # shortcuts lead close to the obstacles
    path = setup.getSolutionPath()
    path.interpolate(300)
    poses = [[state[i] for i in range(7)] for state in path.getStates()]
    assert len(poses) >= 300

    original, meshes = load(robot)
    data_of, at = original.createData(), pinocchio.GeometryData(meshes)
    obstacles = [(coal.Sphere(radius), place) for place, radius in BALLS] + [
        (coal.Box(*(2 * np.array(half))), place) for place, half in BOXES
    ]

    def touched(arm):
        pinocchio.updateGeometryPlacements(original, data_of, meshes, at, configuration(arm))
        return [
            one.name
            for one, where in zip(meshes.geometryObjects, at.oMg, strict=True)
            for shape, place in obstacles
            if one.parentJoint and coal.collide(
                one.geometry, touching.transform(where.homogeneous), shape,
                coal.Transform3s(np.eye(3), np.array(place)), coal.CollisionRequest(), coal.CollisionResult(),
            )
        ]  # fmt: skip

    assert any(touched(np.array(START) + share * np.subtract(GOAL, START)) for share in np.linspace(0, 1, 20)), (
        "the straight way is barred"
    )
    assert not [links for links in map(touched, poses) if links]
