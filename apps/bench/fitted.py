#!/usr/bin/env python3
"""The page on fitted spheres: foam and MorphIt-rs on the same meshes, judged by `foam evaluate`.

fitted.py FOAM SHARED > fitted.md, with the Python packages foam (./foam python) and morphit-rs (PyPI).
FOAM: the program. SHARED: the folder that holds the files named in MESHES. Each mesh is scaled to a diagonal of 1 m, since
the figures of MorphIt-rs depend on the size, and both programs read the same file. They take turns, each on one thread.
"""
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version

import foam
import morphit_rs
import numpy as np

MESHES = {
    "armadillo": "meshes/real/armadillo.obj",
    "bunny": "meshes/real/bunny_7k.off",
    "fandisk": "meshes/real/fandisk.obj",
    "rocker arm": "meshes/real/rocker-arm.obj",
    "spot": "meshes/real/spot.obj",
    "three holes": "meshes/real/3holes.off",
    "featuretype": "meshes/real/featuretype.STL",
    "idler riser": "meshes/real/idler_riser.STL",
    "cloth": "meshes/real/self_intersectA.obj",
    "plate with holes": "meshes/real/plate_holes.STL",
    "tray": "meshes/real/1002_tray_bottom.STL",
    "Panda link 1, visual": "robots/panda/moveit_resources_panda_description/meshes/visual/link1.dae",
    "Panda link 5": "robots/panda/foam_variant/meshes/collision/link5.obj",
    "Jaco hand": "robots/jaco/kinova_description/meshes/hand_3finger.dae",
    "Jaco forearm": "robots/jaco/kinova_description/meshes/forearm.dae",
    "Fetch bellows": "robots/fetch/fetch_description/meshes/bellows_link.STL",
    "Fetch shoulder": "robots/fetch/fetch_description/meshes/shoulder_pan_link_collision.STL",
    "Stretch fingertip": "robots/stretch/RE1V0/meshes/link_gripper_fingertip_left.STL",
    "Stretch arm": "robots/stretch/RE1V0/meshes/link_arm_l4.STL",
    "UR5 forearm": "robots/ur5/example-robot-data/robots/ur_description/meshes/ur5/collision/forearm.stl",
}
COUNTS = [8, 32, 128]
FIGURES = {"gap": "gap", "mean": "mean distance", "volumes": "excess + missing"}
SURFACE_POINTS = 50_000

HEAD = """# Fitted spheres beside MorphIt-rs

<!-- Made by apps/bench/fitted.py; see the end of the page. -->

Twenty meshes by 8, 32 and 128 spheres: `foam spherize` with `guarantee: fitted` and nothing else, and MorphIt-rs {version} with its
default preset MorphIt-B, 300 iterations, seed 0. *Gap*, and *excess + missing*, are figures of `foam evaluate` for both
([evaluating sphere models](../guide/evaluation.md)). *Mean distance* is the mean distance of {points:,} points of the mesh from the surface of
the spheres; for a point inside, its depth in the sphere that it is deepest in. Each mesh is scaled to a diagonal of 1 m.

A number is the geometric mean, over the meshes, of MorphIt-rs's figure / foam's: above 1, foam is closer. *Behind* counts the meshes where
foam's figure is the larger one. Times are CPU seconds on one thread, the sum over the meshes: of foam from the start of the program to its
written file, of MorphIt-rs from the mesh in memory to the spheres.

"""

TAIL = """
## Repeating the measurement

<!-- not run: needs morphit-rs, and the meshes of others are not in this repository -->
```sh
pip install morphit-rs=={version}
./foam python apps/bench/fitted.py ./foam shared > docs/benchmarks/fitted.md
```
"""


def corners_of(file):
    """Return the corners of a mesh's triangles, about the origin, with a diagonal of 1."""
    mesh = foam.read_mesh(file)
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.faces)]
    low, high = corners.min((0, 1)), corners.max((0, 1))
    return (corners - (low + high) / 2) / np.linalg.norm(high - low)


def write_stl(corners, file):
    """Write triangles as binary STL."""
    rows = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows["corners"] = corners
    file.write_bytes(bytes(80) + len(rows).to_bytes(4, "little") + rows.tobytes())


def points_on(corners):
    """Return points of the surface, even by area."""
    random = np.random.default_rng(0)
    a, b, c = corners.transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    on = random.choice(len(corners), SURFACE_POINTS, p=areas / areas.sum())
    u, v = random.random((2, SURFACE_POINTS, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[on] + u * (b - a)[on] + v * (c - a)[on]


def by_foam(program, mesh, count, model):
    """Make a model and return the CPU time of the command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "spherize", mesh, "-n", str(count), "--set", "guarantee=fitted", "-o", model, "--fresh", "-j1", "-q"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def by_morphit(mesh, count, model):
    """Make a model and return the CPU time of the search."""
    loaded = morphit_rs.Mesh.load(mesh)
    config = morphit_rs.Config.preset("MorphIt-B", num_spheres=count, seed=0)
    before = time.process_time()
    result = morphit_rs.pack(loaded, config)
    seconds = time.process_time() - before
    model.write_text(json.dumps({"centers": result.centers.tolist(), "radii": result.radii.tolist()}))
    return seconds


def spheres_of(model):
    """Return the rows x, y, z, radius of either program's file."""
    if "centers" in model:
        return [[*center, radius] for center, radius in zip(model["centers"], model["radii"])]
    return [sphere for link in model["links"].values() for sphere in link["spheres"]]


def judged(program, mesh, model, points):
    """Return the figures of a model, by name, and its number of spheres."""
    done = subprocess.run([program, "evaluate", mesh, model, "--json"], capture_output=True, text=True, check=True)
    total = json.loads(done.stdout)["total"]
    nearest = np.full(len(points), np.inf)
    for *center, radius in spheres_of(json.loads(model.read_text())):
        nearest = np.minimum(nearest, np.linalg.norm(points - center, axis=1) - radius)
    return {"gap": total["gap_m"], "mean": np.abs(nearest).mean(), "volumes": total["excess"] + total["missing"], "spheres": total["spheres"]}


def measured(program, shared, folder):
    """Return both programs' figures and times, by count and mesh."""
    rows = {}
    for name, file in MESHES.items():
        corners = corners_of(shared / file)
        mesh = folder / "mesh.stl"
        write_stl(corners, mesh)
        points = points_on(corners)
        for count in COUNTS:
            ours, theirs = folder / "ours.json", folder / "theirs.json"
            times = by_foam(program, mesh, count, ours), by_morphit(mesh, count, theirs)
            rows[count, name] = [judged(program, mesh, model, points) | {"time": t} for model, t in zip((ours, theirs), times)]
        print(name, file=sys.stderr)
    return rows


def summary(rows):
    """Return the table of geometric means."""
    text = "| spheres | " + " | ".join(f"{name} | behind" for name in FIGURES.values()) + " | CPU s, foam | MorphIt-rs |\n"
    text += "|---:" * (3 + 2 * len(FIGURES)) + "|\n"
    for count in COUNTS:
        pairs = [rows[count, name] for name in MESHES]
        text += f"| {count} "
        for figure in FIGURES:
            ratios = [theirs[figure] / ours[figure] for ours, theirs in pairs]
            mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
            text += f"| {mean:.2f} | {sum(ratio < 1 for ratio in ratios)} of {len(ratios)} "
        text += "| " + " | ".join(f"{sum(pair[i]['time'] for pair in pairs):.1f}" for i in range(2)) + " |\n"
    return text


def details(rows):
    """Return the tables of all meshes."""
    text = ""
    for count in COUNTS:
        text += f"\n## {count} spheres\n\nGap and mean distance as shares of the diagonal, foam / MorphIt-rs. *Used*: spheres that MorphIt-rs kept.\n\n"
        text += "| mesh | gap, % | mean distance, % | excess + missing | used | CPU s |\n|---|---|---|---|---:|---|\n"
        for name in MESHES:
            ours, theirs = rows[count, name]
            cells = [f"{factor * ours[figure]:.{digits}f} / {factor * theirs[figure]:.{digits}f}"
                     for figure, factor, digits in (("gap", 100, 2), ("mean", 100, 2), ("volumes", 1, 3), ("time", 1, 2))]
            text += f"| {name} | {cells[0]} | {cells[1]} | {cells[2]} | {theirs['spheres']} | {cells[3]} |\n"
    return text


def main():
    program, shared = sys.argv[1], pathlib.Path(sys.argv[2])
    morphit_rs.set_num_threads(1)
    of_morphit = version("morphit-rs")
    with tempfile.TemporaryDirectory() as folder:
        rows = measured(program, shared, pathlib.Path(folder))
    print(HEAD.format(version=of_morphit, points=SURFACE_POINTS) + summary(rows) + details(rows) + TAIL.format(version=of_morphit), end="")


if __name__ == "__main__":
    main()
