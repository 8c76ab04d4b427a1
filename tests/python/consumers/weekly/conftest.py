"""What the tests of the weekly set share."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "urdf"))


@pytest.fixture
def figure():
    """Return a function that prints a line, and adds it to the file FOAM_TEST_FIGURES."""

    def told(line):
        print(line)
        if file := os.environ.get("FOAM_TEST_FIGURES"):
            with open(file, "a", encoding="utf-8") as out:
                out.write(f"{line}\n")

    return told


def run_foam(*words):
    done = subprocess.run([os.environ["FOAM_TEST_BINARY"], *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done


@pytest.fixture
def foam():
    return run_foam


@pytest.fixture(scope="session")
def models(tmp_path_factory):
    """Return a function of kind and ending: for each of three robots its file, the model as URDF, and that in another format."""
    import stage
    import urdf_truth

    folder = tmp_path_factory.mktemp("models")
    robots, known = urdf_truth.robots(folder), {}

    def written(kind, ending="urdf", capsules="element"):
        for robot in robots:
            place = folder / f"{kind}_{capsules}"
            if (kind, capsules, robot) not in known:
                words = ["--set", f"outputs.write.urdf.capsules={capsules}"] if kind == "capsule" else []
                known[kind, capsules, robot] = urdf_truth.written(robot, kind, place, *words)
            file = known[kind, capsules, robot]
            other = file.with_suffix(f".{ending}")
            if other != file:
                words = []
                if ending == "usda":
                    stage.write(robot, place / f"{robot.stem}.usda")
                    words = ["--set", f"sublayer=./{robot.stem}.usda"]
                run_foam("convert", file, robot, "-o", other, *words)
            yield robot, file, other

    return written
