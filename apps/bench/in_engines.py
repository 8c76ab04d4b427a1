#!/usr/bin/env python3
"""Measures collision checks and simulation steps per second: original meshes and foam's models in the programs of PyPI.

    in_engines.py FOAM PYTHON OUT [--shared FOLDER] [--poses 1000] [--robots panda,ur5] [--vamp FILE]

PYTHON has the packages of tests/consumers/python/requirements.txt. OUT gets results.csv, results.md and two plots. A check
is one random pose of the robot: its links are placed, and compared with each other, but for pairs that need no check,
and with ten obstacles. A step is one of simulation: the robot falls, and ten bodies fall on it. CPU time of one thread.
"""
import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from pathlib import Path

ROBOTS = {
    "panda": "panda/moveit_resources_panda_description/urdf/panda.urdf",
    "ur5": "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
    "iiwa": "iiwa/model.urdf",
    "fetch": "fetch/fetch_description/robots/fetch.urdf",
    "stretch": "stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
}
#: Elements a link with geometry.
KINDS = {"sphere": 5, "capsule": 2, "box": 2, "hull": 2}
PLURALS = {"sphere": "spheres", "capsule": "capsules", "cylinder": "cylinders", "box": "boxes", "hull": "hulls"}
PROGRAMS = {"coal": "coal", "mujoco": "MuJoCo", "pybullet": "Bullet"}
SPHERES, BOXES = 5, 5  #: obstacles
STEPS = 500
REPEATS = 3


# What runs in PYTHON: one program, one model.


def obstacles(seed):
    """Return radii, half edges and places of ten obstacles around the robot, m."""
    import numpy as np

    random = np.random.default_rng(seed)
    places = random.normal(size=(SPHERES + BOXES, 3))
    places *= random.uniform(0.4, 0.9, (len(places), 1)) / np.linalg.norm(places, axis=1, keepdims=True)
    places[:, 2] = abs(places[:, 2])
    return random.uniform(0.03, 0.1, SPHERES), random.uniform(0.03, 0.1, (BOXES, 3)), places


def clock():
    return time.clock_gettime(time.CLOCK_PROCESS_CPUTIME_ID)


def in_coal(file, pairs, poses):
    import coal
    import numpy as np
    import pinocchio

    folders = [str(Path(file).parent)]
    model = pinocchio.buildModelFromUrdf(str(file))
    geometry = pinocchio.buildGeomFromUrdf(model, str(file), pinocchio.GeometryType.COLLISION, package_dirs=folders)
    for one in geometry.geometryObjects:  # of a mesh file coal knows the surface; foam's are hulls
        if isinstance(one.geometry, coal.BVHModelBase) and "_hulls/" in one.meshPath:
            one.geometry.buildConvexHull(True, "Qt")
            one.geometry = one.geometry.convex
    links = [model.frames[one.parentFrame].name for one in geometry.geometryObjects]
    ignored = {frozenset(pair) for pair in pairs}
    count = len(links)
    radii, halves, places = obstacles(0)
    shapes = [coal.Sphere(r) for r in radii] + [coal.Box(*(2 * half)) for half in halves]
    for i, (shape, place) in enumerate(zip(shapes, places, strict=True)):
        at = pinocchio.SE3(np.eye(3), place)
        geometry.addGeometryObject(pinocchio.GeometryObject(f"obstacle_{i}", 0, 0, at, shape))
        for k in range(count):
            geometry.addCollisionPair(pinocchio.CollisionPair(k, count + i))
    for i in range(count):
        for k in range(i):
            if links[i] != links[k] and frozenset((links[i], links[k])) not in ignored:
                geometry.addCollisionPair(pinocchio.CollisionPair(k, i))
    data, placed = model.createData(), pinocchio.GeometryData(geometry)
    pinocchio.seed(1)
    low, high = np.maximum(model.lowerPositionLimit, -3), np.minimum(model.upperPositionLimit, 3)
    used = 0
    for _ in range(poses):
        q = pinocchio.randomConfiguration(model, low, high)  # a continuous joint has two numbers, of any angle
        start = clock()
        pinocchio.computeCollisions(model, data, geometry, placed, q, False)
        used += clock() - start
    return {"checks": poses / used, "shapes": count}


def near_pairs_in_coal(file, _, count):
    """Return the time of a pair of elements, ns: the boxes around them overlap, they do not touch."""
    import coal
    import numpy as np
    import pinocchio

    model = pinocchio.buildModelFromUrdf(str(file))
    folders = [str(Path(file).parent)]
    given = pinocchio.buildGeomFromUrdf(model, str(file), pinocchio.GeometryType.COLLISION, package_dirs=folders)
    shapes = []
    for one in given.geometryObjects:
        if isinstance(one.geometry, coal.BVHModelBase):
            one.geometry.buildConvexHull(True, "Qt")
            one.geometry = one.geometry.convex
        shapes.append(one.geometry)
    random = np.random.default_rng(0)
    geometry = pinocchio.GeometryModel()
    empty = pinocchio.Model()
    while geometry.ngeoms < 2 * count:
        pair = [shapes[i] for i in random.integers(len(shapes), size=2)]
        at = [pinocchio.SE3.Random() for _ in pair]
        for place in at:
            place.translation = np.zeros(3)
        boxes = [around(shape, place) for shape, place in zip(pair, at, strict=True)]
        low, high = boxes[0].min_ - boxes[1].max_, boxes[0].max_ - boxes[1].min_
        at[1].translation = random.uniform(low, high)
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        distance = coal.distance(pair[0], coal.Transform3s(at[0].rotation, at[0].translation), pair[1],
                                 coal.Transform3s(at[1].rotation, at[1].translation), request, result)
        if distance > 1e-4:
            number = geometry.ngeoms
            for k in range(2):
                geometry.addGeometryObject(pinocchio.GeometryObject(f"{number + k}", 0, 0, at[k], pair[k]))
            geometry.addCollisionPair(pinocchio.CollisionPair(number, number + 1))
    data, placed = empty.createData(), pinocchio.GeometryData(geometry)
    q = pinocchio.neutral(empty)
    pinocchio.updateGeometryPlacements(empty, data, geometry, placed, q)
    times = []
    for _ in range(30):
        start = clock()
        pinocchio.computeCollisions(geometry, placed, False)
        times.append((clock() - start) / count * 1e9)
    return {"pair": statistics.median(times)}


def around(shape, at):
    """Return the axis-aligned box around a turned shape."""
    import coal

    moved = coal.CollisionObject(shape, coal.Transform3s(at.rotation, at.translation))
    moved.computeAABB()
    return moved.getAABB()


def in_mujoco(file, pairs, poses):
    import mujoco
    import numpy as np

    spec = mujoco.MjSpec.from_file(str(file))
    radii, halves, places = obstacles(0)
    for i, place in enumerate(places):
        body = spec.worldbody.add_body(name=f"obstacle_{i}", pos=place)
        body.add_freejoint()
        ball = i < SPHERES
        size = [radii[i], 0, 0] if ball else list(halves[i - SPHERES])
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE if ball else mujoco.mjtGeom.mjGEOM_BOX, size=size)
    bodies = {body.name for body in spec.bodies}
    if not spec.excludes:
        for one, other in pairs:
            if {one, other} <= bodies:
                spec.add_exclude(bodyname1=one, bodyname2=other)
    model = spec.compile()
    data = mujoco.MjData(model)
    random = np.random.default_rng(1)
    hinges = [j for j in range(model.njnt) if model.jnt_type[j] in (2, 3)]
    start_q, used = data.qpos.copy(), 0
    for _ in range(poses):
        for j in hinges:
            low, high = model.jnt_range[j] if model.jnt_limited[j] else (-3, 3)
            data.qpos[model.jnt_qposadr[j]] = random.uniform(low, high)
        start = clock()
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        used += clock() - start
    mujoco.mj_resetData(model, data)
    data.qpos[:] = start_q
    start = clock()
    mujoco.mj_step(model, data, STEPS)
    steps = STEPS / (clock() - start)
    robot = sum((model.geom_contype > 0) | (model.geom_conaffinity > 0)) - SPHERES - BOXES
    return {"checks": poses / used, "steps": steps, "shapes": int(robot)}


def in_pybullet(file, pairs, poses):
    import numpy as np
    import pybullet as bullet

    bullet.connect(bullet.DIRECT)
    bullet.setGravity(0, 0, -9.81)
    robot = bullet.loadURDF(str(file), useFixedBase=True, flags=bullet.URDF_USE_SELF_COLLISION)
    infos = [bullet.getJointInfo(robot, j) for j in range(bullet.getNumJoints(robot))]
    links = {info[12].decode(): info[0] for info in infos} | {bullet.getBodyInfo(robot)[0].decode(): -1}
    for one, other in pairs:
        if one in links and other in links:
            bullet.setCollisionFilterPair(robot, robot, links[one], links[other], 0)
    radii, halves, places = obstacles(0)
    for i, place in enumerate(places):
        shape = (bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=radii[i]) if i < SPHERES
                 else bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=halves[i - SPHERES]))
        bullet.createMultiBody(0.5, shape, basePosition=place)
    random = np.random.default_rng(1)
    movable = [info for info in infos if info[2] in (bullet.JOINT_REVOLUTE, bullet.JOINT_PRISMATIC)]
    for info in movable:
        bullet.setJointMotorControl2(robot, info[0], bullet.VELOCITY_CONTROL, force=0)
    used = 0
    for _ in range(poses):
        for info in movable:
            low, high = info[8:10] if info[8] < info[9] else (-3, 3)
            bullet.resetJointState(robot, info[0], random.uniform(max(low, -3), min(high, 3)))
        start = clock()
        bullet.performCollisionDetection()
        used += clock() - start
    for info in movable:
        bullet.resetJointState(robot, info[0], 0)
    start = clock()
    for _ in range(STEPS):
        bullet.stepSimulation()
    steps = STEPS / (clock() - start)
    shapes = sum(len(bullet.getCollisionShapeData(robot, number)) for number in links.values())
    return {"checks": poses / used, "steps": steps, "shapes": shapes}


def meshes_alone(file, target):
    """Write the URDF with its collision meshes as STL, which all programs read, and without visuals."""
    import trimesh

    file, folder = Path(file).resolve(), Path(target).parent
    packages = file.parents[:7]
    tree = xml.parse(file)
    root = tree.getroot()
    for link in root.findall("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    root.insert(0, xml.fromstring('<mujoco><compiler discardvisual="true" fusestatic="false" strippath="false" '
                                  f'balanceinertia="true" boundmass="1e-4" boundinertia="1e-7" meshdir="{folder}"/></mujoco>'))
    for i, mesh in enumerate(root.iter("mesh")):
        path = mesh.get("filename")
        if path.startswith("package://"):
            path = next(str(place / path[10:]) for place in packages if (place / path[10:]).exists())
        loaded = trimesh.load(file.parent / path, force="mesh")
        loaded.apply_scale([float(x) for x in mesh.attrib.pop("scale", "1 1 1").split()])
        loaded.export(folder / f"mesh_{i}.stl")
        mesh.set("filename", f"mesh_{i}.stl")
    tree.write(target)


def measure(arguments):
    """Measure one program on one model; print the figures as JSON. Or write the meshes."""
    if arguments[0] == "meshes":
        meshes_alone(*arguments[1:])
        return
    program, file, pairs, poses = arguments
    function = {"coal": in_coal, "near": near_pairs_in_coal, "mujoco": in_mujoco, "pybullet": in_pybullet}[program]
    print("\n" + json.dumps(function(file, json.loads(pairs), int(poses))), flush=True)


# What runs in this Python: models, tables, plots.


class Bench:
    """The robots' models and what was measured of them."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.rows = []
        self.environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}

    def foam(self, *words):
        done = subprocess.run([self.arguments.foam, *map(str, words)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"foam {' '.join(map(str, words))}: {done.stderr}")
        return done.stdout

    def in_python(self, *words):
        words = [self.arguments.python, __file__, "--measure", *words]
        return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, env=self.environment)

    def add(self, robot, jobs, pairs):
        """Measure each model in turn, REPEATS times; add the medians."""
        found = {}
        for _ in range(REPEATS):
            for model, program, file, excess in jobs:
                if figures := self.figures(robot, model, program, file, pairs):
                    found.setdefault((model, program, excess), []).append(figures)
        for (model, program, excess), repeats in found.items():
            medians = {key: statistics.median(one[key] for one in repeats) for key in repeats[0]}
            self.rows.append({"robot": robot, "model": model, "program": program, "excess": excess, **medians})
            print(self.rows[-1], flush=True)

    def figures(self, robot, model, program, file, pairs):
        """Return what one program makes of one model; nothing, with a line about it, where it cannot."""
        done = self.in_python(program, file, json.dumps(pairs), self.arguments.poses)
        if done.returncode != 0:
            print(f"{robot} {model} {program}: {done.stderr.strip().splitlines()[-1]}", flush=True)
            return None
        return json.loads([line for line in done.stdout.splitlines() if line.startswith("{")][-1])  # PyBullet prints, too

    def measure(self, robot, folder):
        file = self.arguments.shared / "robots" / ROBOTS[robot]
        links = sum(1 for link in json.loads(self.foam("info", "--json", file))["links"])
        jobs, pairs = [], []
        for kind, each in KINDS.items():
            for program in PROGRAMS:
                if program == "mujoco":
                    target, more = folder / f"{kind}.xml", ["--set", "outputs.write.mjcf.visuals=false"]
                else:
                    target, more = folder / f"{program}_{kind}.urdf", []
                told = self.foam("approximate", file, "--with", kind, "-n", each * links, "--effort", "fast", "--for", program,
                                 "-o", target, "--json", *more)
                excess = json.loads(told)["total"]["excess"]
                if not pairs:
                    self.foam("convert", target, file, "-o", folder / "pairs.srdf")
                    pairs = [(one.get("link1"), one.get("link2"))
                             for one in xml.parse(folder / "pairs.srdf").getroot().iter("disable_collisions")]
                jobs.append((kind, program, target, excess))
        original = folder / "meshes.urdf"
        self.in_python("meshes", file, original).check_returncode()
        jobs += [("meshes", program, original, 0) for program in PROGRAMS]
        self.add(robot, jobs, pairs)

    def median_ratio(self, model, program, figure):
        """Return how many times as many as of the original meshes, the median over robots; nothing without any."""
        def of(robot, which):
            found = [row for row in self.rows if (row["robot"], row["model"], row["program"]) == (robot, which, program)]
            return found[0].get(figure) if found else None

        ratios = [of(robot, model) / of(robot, "meshes") for robot in ROBOTS if of(robot, model) and of(robot, "meshes")]
        return statistics.median(ratios) if ratios else None


HEAD = """# Original meshes and models in the programs that use them

Checks and steps per second, in multiples of the original collision meshes: medians over {robots}. Above 1 the model is faster.

- A check is one of {poses} random poses: the links are placed, and compared with each other, but for pairs that need no check, and with
  ten balls and boxes.
- A step is one of {steps} of simulation: the robot falls, and ten bodies fall on it. More shapes in contact make steps slower.
- Times are CPU times of one thread, on a busy machine: medians of three, the models in turn. Before that two runs differed by up to a
  factor of two: read the figures to one digit, and small differences not at all.
- The models have five spheres, two capsules, two boxes or two hulls for each link with geometry: `--effort fast`, `--for` the program.
- The meshes are not the same for all. MuJoCo and Bullet take the convex hull of each, which forbids what the mesh leaves free. coal takes
  the triangles, which are hollow. Models are solid.
- Programs: Pinocchio {pin} with coal, MuJoCo {mujoco}, PyBullet {pybullet}.

<!-- not run: takes minutes, and needs the robots of FOAM_SHARED -->
```sh
python3 apps/bench/in_engines.py build/bin/foam build/tests/consumers/python/bin/python docs/benchmarks/in_engines
```

"""


def table(bench, figure, title):
    """Return a table: robots' medians by program and kind, in multiples of the original meshes."""
    programs = {key: name for key, name in PROGRAMS.items() if any(row["program"] == key and figure in row for row in bench.rows)}
    text = f"## {title}\n\n| model | {' | '.join(programs.values())} |\n|---|{'---:|' * len(programs)}\n"
    for kind in KINDS:
        cells = [bench.median_ratio(kind, program, figure) for program in programs]
        text += f"| {PLURALS[kind]} | {' | '.join('–' if cell is None else f'{cell:.2g}' for cell in cells)} |\n"
    absolute = [row[figure] for row in bench.rows if row["model"] == "meshes" and figure in row]
    return text + f"\n![{title}]({figure}.svg)\n\nThe original meshes: {min(absolute):.0f} to {max(absolute):.0f} per second.\n\n"


def table_of_excess(bench):
    """Return a table: excess volume of the models, which the checks pay for in motions that they forbid."""
    robots = [robot for robot in ROBOTS if any(row["robot"] == robot for row in bench.rows)]
    text = f"## Excess of the models\n\n| model | {' | '.join(robots)} |\n|---|{'---:|' * len(robots)}\n"
    for kind in KINDS:
        found = [next((row["excess"] for row in bench.rows if (row["robot"], row["model"]) == (robot, kind)), None) for robot in robots]
        text += f"| {PLURALS[kind]} | {' | '.join('–' if one is None else f'{one:.2f}' for one in found)} |\n"
    return text


def page(bench):
    import re

    pins = (Path(__file__).parents[2] / "tests/consumers/python/requirements.txt").read_text()
    versions = dict(re.findall(r"^(pin|mujoco|pybullet)==([\w.]+)", pins, re.MULTILINE))
    robots = ", ".join(robot for robot in ROBOTS if any(row["robot"] == robot for row in bench.rows))
    head = HEAD.format(robots=robots, poses=bench.arguments.poses, steps=STEPS, **versions)
    return head + table(bench, "checks", "Checks") + table(bench, "steps", "Steps") + table_of_excess(bench)


def plot(bench, figure, file):
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    plt.rcParams["svg.hashsalt"] = "foam"
    _, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
    models = ["meshes", *KINDS]
    for k, (program, title) in enumerate(PROGRAMS.items()):
        values = [1 if model == "meshes" else bench.median_ratio(model, program, figure) or 0 for model in models]
        if not any(values[1:]):
            continue
        axes.bar([i + 0.25 * (k - 1) for i in range(len(models))], values, 0.23, label=title)
    axes.set_xticks(range(len(models)), models)
    axes.set_ylabel(f"{figure} per second,\nmultiples of the meshes")
    axes.axhline(1, color="grey", linewidth=0.5)
    axes.legend()
    plt.savefig(file, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("foam", type=Path)
    parser.add_argument("python", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--shared", type=Path, default=Path("../shared"))
    parser.add_argument("--poses", type=int, default=1000)
    parser.add_argument("--robots", default=",".join(ROBOTS))
    arguments = parser.parse_args()
    bench = Bench(arguments)
    for robot in arguments.robots.split(","):
        with tempfile.TemporaryDirectory() as folder:
            bench.measure(robot, Path(folder))
    arguments.out.mkdir(parents=True, exist_ok=True)
    with (arguments.out / "results.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, ["robot", "model", "program", "shapes", "excess", "checks", "steps"])
        writer.writeheader()
        writer.writerows(bench.rows)
    (arguments.out / "results.md").write_text(page(bench))
    for figure in ("checks", "steps"):
        plot(bench, figure, arguments.out / f"{figure}.svg")


if __name__ == "__main__":
    measure(sys.argv[2:]) if sys.argv[1:2] == ["--measure"] else main()
