"""The models that the tests of all programs read."""

import functools
import os
import sys
from pathlib import Path

import pytest
import touching
import urdf_truth

#: Programs, as --for calls them, whose files of a kind foam writes beside that for any program. Others are converted.
ENGINES = {
    "capsule": ["coal", "physx", "pybullet"],
    "box": ["pybullet"],
    "swept_box": ["pybullet"],
    "cylinder": ["physx", "pybullet"],
}
#: What foam writes beside the spheres' URDF, with pairs of links.
WITH_PAIRS = ["write.srdf: {file: any.srdf}", "write.mjcf: {file: any.xml, visuals: false}"]


@pytest.fixture(scope="session")
def models(tmp_path_factory):
    """Return a function of kind: the three robots' models, each written once.

    More files of a model are in the folder of the same name without its ending.
    """
    folder = tmp_path_factory.mktemp("models")
    robots = urdf_truth.robots(folder)

    @functools.cache
    def written(kind):
        files = []
        for robot in robots:
            engines = ["any", *(ENGINES.get(kind, []) if robot in robots[::2] else [])]
            outputs = [f"write.urdf: {{file: {engine}.urdf, engine: {engine}}}" for engine in engines]
            outputs = f"outputs=[{', '.join(outputs + WITH_PAIRS * (kind == 'sphere'))}]"
            run = folder / f"{robot.stem}_{kind}"
            files.append(urdf_truth.written(robot, kind, folder, "--set", outputs, "--run-dir", run))
        return files

    @functools.cache
    def told(kind, engine):
        """Return the same elements of the Panda and of the walker for a program."""
        files = []
        for robot, file in zip(robots[::2], written(kind)[::2], strict=True):
            files.append(folder / file.stem / f"{engine}.urdf")
            if engine not in ENGINES.get(kind, []):
                urdf_truth.foam("convert", file, robot, "--for", engine, "-o", files[-1])
        return files

    def refused(kind, engine):
        """Return why foam writes no file of the first robot's elements for a program."""
        target = folder / "refused.urdf"
        why = urdf_truth.refused("convert", written(kind)[0], robots[0], "--for", engine, "-o", target)
        assert not target.exists()
        return why

    written.robots, written.told, written.refused = robots, told, refused
    return written


@pytest.fixture(scope="session")
def beside():
    """Return a function of name: the folder of packages whose versions the tests' environment cannot hold as well."""

    def installed(name):
        folder = Path(sys.prefix) / "beside" / name
        if not folder.is_dir():
            pytest.skip(f"tests/consumers/python/beside/{name}.txt is not installed")
        return folder

    return installed


@pytest.fixture(scope="session")
def touches(models):
    """Return poses of the Panda and of the walker, in which obstacles touch their original geometry."""
    panda, _, walker = models.robots
    return {"panda": touching.poses_of(panda, 120), "walker": touching.poses_of(walker, 60)}


@pytest.fixture(scope="session")
def in_mujoco(models):
    """Return a function of robot and written URDF: the MJCF of the same elements.

    That of spheres has pairs; the elements of others are put into it. They were proved as they were written.
    """
    of_spheres = {robot.stem: file.with_suffix("") / "any.xml" for robot, file in zip(models.robots, models("sphere"))}

    @functools.cache
    def written(name, file):
        if file.stem == f"{name}_sphere":
            return of_spheres[name]
        out = file.with_suffix(".xml")
        words = ["--into", of_spheres[name], "--set", "collision=true"]
        urdf_truth.foam("convert", file, "--format", "mjcf", *words, "-o", out)
        return out

    return written


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport():
    return red_in_ci((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report():
    return red_in_ci((yield))


def red_in_ci(report):
    """Make a failure of what is skipped: in continuous integration every program is there."""
    if report.skipped and os.environ.get("CI"):
        report.outcome = "failed"
    return report
