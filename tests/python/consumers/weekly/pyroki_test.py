"""The guide's example of pyroki: foam's pairs, and distances as Pinocchio places the spheres."""
import os
import re
from pathlib import Path

import jax.numpy as jnp
import numpy as np
import pinocchio
import pyroki
import pytest
import urdf_truth
import yourdfpy

PANDA = urdf_truth.SOURCE / "configs/robots/panda/panda.urdf"
GUIDE = urdf_truth.SOURCE / "docs/guide/using_the_model.md"
SINGLE = 1e-5  #: m; distances of two spheres, each off in single precision


def blocks(title):
    """Return the commands and the program that the guide has below a title."""
    section = GUIDE.read_text().split(f"\n## {title}\n")[1].split("\n## ")[0]
    return [re.search(rf"```{language}\n(.*?)```", section, re.S).group(1) for language in ("sh", "python")]


@pytest.fixture(scope="module")
def guide(tmp_path_factory):
    """Run the guide's blocks as they stand, in a folder as that of the pages' tests; return the names that the program leaves."""
    folder, names = tmp_path_factory.mktemp("guide"), {}
    (folder / "configs").symlink_to(urdf_truth.SOURCE / "configs")
    (folder / "foam").symlink_to(Path(os.environ["FOAM_TEST_BINARY"]).resolve())
    commands, program = blocks("pyroki")
    before = Path.cwd()
    os.chdir(folder)
    try:
        assert os.system(commands.replace("\\\n", " ").replace("\n", " && ").removesuffix(" && ")) == 0
        exec(program, names)  # noqa: S102  the guide's own text
    finally:
        os.chdir(before)
    return names


@pytest.fixture(scope="module")
def robot():
    return pyroki.Robot.from_urdf(yourdfpy.URDF.load(str(PANDA), load_meshes=False))


def test_is_free_in_some_poses(guide, robot):
    random = np.random.default_rng(1)
    low, high = np.array(robot.joints.lower_limits), np.array(robot.joints.upper_limits)
    poses = random.uniform(low, high, (500, len(low)))
    distances = np.array(guide["collision"].compute_self_collision_distance(robot, jnp.array(poses)))
    free = (distances > 0).all(axis=1)
    assert 0.3 < free.mean() < 1


def test_distances(guide, robot):
    collision, spheres = guide["collision"], guide["spheres"]
    model = pinocchio.buildModelFromUrdf(str(PANDA))
    data, random = model.createData(), np.random.default_rng(2)
    low, high = np.array(robot.joints.lower_limits), np.array(robot.joints.upper_limits)
    off = guide["pairs"]
    links = [link for link in collision.link_names if link in spheres]
    of = np.concatenate([[k] * len(spheres[link]["radii"]) for k, link in enumerate(links)])
    radii = np.concatenate([spheres[link]["radii"] for link in links])
    a, b = np.array(collision.active_idx_i), np.array(collision.active_idx_j)
    checked = {frozenset((links[of[i]], links[of[j]])) for i, j in zip(a, b)}
    assert not checked & set(map(frozenset, off))
    for _ in range(20):
        cfg = random.uniform(low, high)
        q = pinocchio.neutral(model)
        for name, value in zip(robot.joints.actuated_names, cfg):
            q[model.joints[model.getJointId(name)].idx_q] = value
        for element in urdf_truth.Truth(PANDA).joints:
            if (mimic := element.find("mimic")) is not None:
                leader = model.joints[model.getJointId(mimic.get("joint"))].idx_q
                q[model.joints[model.getJointId(element.get("name"))].idx_q] = q[leader] * float(mimic.get("multiplier", 1))
        pinocchio.framesForwardKinematics(model, data, q)
        frames = [data.oMf[model.getFrameId(link)] for link in links]
        centres = np.concatenate([np.array(spheres[link]["centers"]) @ frame.rotation.T + frame.translation for link, frame in zip(links, frames)])
        expected = np.linalg.norm(centres[a] - centres[b], axis=1) - radii[a] - radii[b]
        found = np.array(collision.compute_self_collision_distance(robot, jnp.array(cfg)))
        np.testing.assert_allclose(found, expected, atol=SINGLE)
