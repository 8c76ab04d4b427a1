"""A layer of foam over the stage that NVIDIA's urdf-usd-converter makes of the Panda."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import urdf_truth
from pxr import Usd, UsdGeom, UsdPhysics

SINGLE = 3e-6  #: m; USD has single precision


def converted(robot, packages, folder):
    """Return the stage by the converter, whose OpenUSD is not that of the tests: -S hides their packages but NumPy."""
    shared = folder.with_name("shared")
    shared.mkdir()
    for name in ("numpy", "numpy.libs"):
        (shared / name).symlink_to(Path(np.__file__).parents[1] / name)
    words = [sys.executable, "-S", packages / "bin/urdf_usd_converter", robot, folder]
    paths = {"PYTHONPATH": f"{packages}{os.pathsep}{shared}"}
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=os.environ | paths)
    assert done.returncode == 0, done.stderr
    return folder / f"{robot.stem}.usda"


def matrix(prim):
    """Return the place of a prim in the world."""
    return np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)).T


def test_the_spheres_lie_over_the_stage(models, beside, tmp_path, monkeypatch):
    monkeypatch.setenv("FOAM_PYTHON", sys.executable)
    stage_of = converted(models.robots[0], beside("usd_converter"), tmp_path / "stage")
    file = models("sphere")[0]
    layer = tmp_path / "stage/panda_spheres.usda"
    urdf_truth.foam("convert", file, stage_of, "-o", layer)

    stage = Usd.Stage.Open(str(layer))
    assert not stage.GetCompositionErrors()
    alive = {prim.GetPath(): prim for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())}
    overs = []
    stage.GetRootLayer().Traverse("/", lambda path: overs.append(path) if path.IsPrimPath() else None)
    assert overs and set(overs) <= set(alive), "every prim of the layer is alive"
    solid = [prim for prim in alive.values() if prim.HasAPI(UsdPhysics.CollisionAPI)]
    on = [prim for prim in solid if UsdPhysics.CollisionAPI(prim).GetCollisionEnabledAttr().Get()]
    assert len(on) < len(solid) and all(
        prim.IsA(UsdGeom.Sphere) and "/foam_spheres/" in str(prim.GetPath()) for prim in on
    ), "old colliders are off"

    truth = urdf_truth.Truth(file)
    at_rest = {name: 0.0 for name in truth.free_joints()}
    links = truth.link_poses(at_rest)
    bodies = {prim.GetName(): prim for prim in alive.values() if prim.HasAPI(UsdPhysics.RigidBodyAPI)}
    assert set(truth.elements) <= set(bodies) <= set(links)
    for name, prim in bodies.items():
        np.testing.assert_allclose(matrix(prim), links[name], atol=SINGLE, err_msg=name)
    places = truth.element_poses(at_rest)
    expected = sorted(
        (*at[:3, 3], *sizes["radius"])
        for name in places
        for at, (_, sizes, _) in zip(places[name], truth.elements[name], strict=True)
    )
    found = sorted((*matrix(prim)[:3, 3], UsdGeom.Sphere(prim).GetRadiusAttr().Get()) for prim in on)
    np.testing.assert_allclose(found, expected, atol=SINGLE)
