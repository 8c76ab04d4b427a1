"""MJCF of every kind of element in the oldest and the newest MuJoCo that read it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import urdf_truth


@pytest.mark.parametrize("version", ["3.3.0", "4.0.0"])
def test_loads_places_and_steps(models, in_mujoco, beside, version, tmp_path):
    # A capsule is one element in MJCF: in a URDF it is one for coal, which has a word for it.
    known = [models.told(kind, "coal") if kind == "capsule" else models(kind)[::2] for kind in urdf_truth.KINDS]
    files = [pair for written in known for pair in zip(("panda", "walker"), written, strict=True)]
    files.append(("hand", models("sphere")[1]))  # for its joints
    folder = [] if version == "4.0.0" else [beside("mujoco")]
    paths = [*folder, Path(__file__).parent, os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, paths)), "MUJOCO_GL": "off"}
    program = Path(__file__).with_name("mujoco_models.py")
    words = [sys.executable, program, *(word for robot, file in files for word in (in_mujoco(robot, file), file))]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=environment, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (done.stdout.split(), done.stderr) == ([version], "")
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()
