"""load.usd against what OpenUSD says of physics, on files that use each feature together."""
import os
import sys
import warnings
from pathlib import Path

import pytest
from pxr import Usd, UsdUtils

import foam

sys.path.insert(0, str(Path(__file__).parent))
import usd_truth  # noqa: E402

os.environ["FOAM_PYTHON"] = sys.executable
FOLDER = Path(__file__).parent / "usd"
#: Links with shapes, and shapes, of each file.
COUNTS = {"nested": (2, 3), "composed": (4, 5), "shapes": (1, 15), "meshes": (1, 9), "joints": (9, 9), "standing": (4, 4), "mimic": (3, 3), "rounded": (1, 2)}


def check(file, counts):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what foam leaves out
        robot = foam.load(file)
    assert usd_truth.compare(robot, usd_truth.Stage(file)) == counts[1]
    assert len(robot.links_with_geometry) == counts[0]


@pytest.mark.parametrize("name", COUNTS)
def test_foam_reads_what_openusd_says(name):
    check(FOLDER / f"{name}.usda", COUNTS[name])


def test_shapes_that_foam_does_not_know_are_errors(tmp_path):
    (tmp_path / "curve.usda").write_text('#usda 1.0\ndef BasisCurves "c" (prepend apiSchemas = ["PhysicsCollisionAPI"])\n{\n}\n')
    with pytest.raises(foam.InputError, match="/c: foam knows no BasisCurves; remedy: .*collisionEnabled = 0"):
        foam.load(tmp_path / "curve.usda")


def test_binary_files_and_packages_are_no_different(tmp_path):
    Usd.Stage.Open(str(FOLDER / "nested.usda")).Export(str(tmp_path / "nested.usdc"))
    check(tmp_path / "nested.usdc", COUNTS["nested"])
    UsdUtils.CreateNewUsdzPackage(str(FOLDER / "composed.usda"), str(tmp_path / "composed.usdz"))
    check(tmp_path / "composed.usdz", COUNTS["composed"])
