"""The page on convex elements: each robot by each kind, judged by `foam evaluate`, and bounds for the Panda.

convex.py FOAM ROBOTS > convex.md, with the Python package foam (./foam python).
FOAM: the program. ROBOTS: a folder that holds the files named in ROBOTS_OF.
"""
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

import foam

ROBOTS_OF = {
    "Baxter": "baxter/example-robot-data/robots/baxter_description/urdf/baxter.urdf",
    "Fetch": "fetch/fetch_description/robots/fetch.urdf",
    "iiwa": "iiwa/model.urdf",
    "Jaco": "jaco/kinova_description/urdf/j2s7s300.urdf",
    "Panda": "panda/foam_variant/panda.urdf",
    "Stretch": "stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
    "UR5": "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
}
KINDS = ["sphere", "capsule", "cylinder", "box", "swept_box", "hull"]
PER_LINK = [1, 2, 4]
POSES = 300

HEAD = """# Robots by each kind of element

<!-- Made by docs/benchmarks/convex.py; see the end of the page. -->

Each robot is approximated by 1, 2 and 4 elements a link on average, of one kind. Every model is certified on the numbers that are read back from its file.
*Excess* is the volume of the elements outside the links as a share of the volume of the links. *Mean* is the mean protrusion, mm.
*Falsely refused* is the share of 300 random poses in which elements of two links touch, and the geometry of no two links does. *CPU* is the
time of the whole command on one thread, without the cache. [Evaluating sphere models](../guide/evaluation.md) has the definitions.

"""


def links_of(robot):
    return len(foam.load(robot).links_with_geometry)


def made(program, robot, kind, count, folder):
    """Return the model's figures, and the CPU time of the command that made it."""
    model = folder / f"{kind}_{count}.json"
    name = ["spherize"] if kind == "sphere" else ["approximate", "--with", kind]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, *name, robot, "-n", str(count), "-o", model, "--fresh", "-j1", "-q"], check=True, stderr=subprocess.DEVNULL)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    done = subprocess.run([program, "evaluate", robot, model, "--poses", str(POSES), "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout), seconds


def table(program, name, robot, folder):
    links = links_of(robot)
    lines = [f"## {name}: {links} links\n", "| kind | elements | excess | mean, mm | falsely refused | missed | CPU, s | certified |",
             "|---|---|---|---|---|---|---|---|"]
    for kind in KINDS:
        for each in PER_LINK:
            data, seconds = made(program, robot, kind, each * links, folder)
            total, poses = data["total"], data["consequences"]
            lines.append(f"| {kind} | {total['spheres']} | {total['excess']:.3f} | {1000 * total['protrusion_mean_m']:.1f} "
                         f"| {poses['falsely_refused'] / poses['poses']:.1%} | {poses['missed']} | {seconds:.2f} "
                         f"| {'yes' if total['certified'] else 'no'} |")
    return "\n".join(lines) + "\n\n"


def bounds(robot):
    """Return the table of proved bounds for one element a link."""
    text = ("## How far from the best\n\nFor one box, capsule or cylinder around each link of the Panda, branch and bound over orientations proves how little the\n"
            "volume can be (`foam.proved_least()`). No such elements have less excess than the bound.\n\n"
            "| kind | excess of foam's | excess of the least found by the proof | proved bound |\n|---|---|---|---|\n")
    loaded = foam.load(robot)
    meshes = [loaded.collision_mesh(link) for link in loaded.links_with_geometry]
    solid = sum(mesh.volume for mesh in meshes)
    for kind in ["capsule", "cylinder", "box"]:
        ours = sum(foam.approximate(mesh, 1, kind).volume for mesh in meshes)
        found = [foam.proved_least(mesh, kind, tolerance=2e-3) for mesh in meshes]
        least, bound = sum(one.volume for one in found), sum(one.lower_bound for one in found)
        text += f"| {kind} | {ours / solid - 1:.4f} | {least / solid - 1:.4f} | {bound / solid - 1:.4f} |\n"
    return text + "\n"


TAIL = """## Repeating the measurement

<!-- not run: the robots of others are not in this repository -->
```sh
./foam python docs/benchmarks/convex.py ./foam robots > docs/benchmarks/convex.md
```
"""


def main():
    program, robots = sys.argv[1], pathlib.Path(sys.argv[2])
    text = HEAD
    with tempfile.TemporaryDirectory() as folder:
        for name, robot in ROBOTS_OF.items():
            text += table(program, name, str(robots / robot), pathlib.Path(folder))
            print(name, file=sys.stderr)
    print(text + bounds(str(robots / ROBOTS_OF["Panda"])) + TAIL, end="")


if __name__ == "__main__":
    main()
