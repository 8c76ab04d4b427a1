"""The page on convex elements: each robot by each kind, judged by `foam evaluate`, and bounds for the Panda.

convex.py FOAM ROBOTS MESHES > convex.md, with the Python package foam (./foam python).
FOAM: the program. ROBOTS, MESHES: folders that hold the files named in ROBOTS_OF and MESHES_OF.
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
PANDA_OF_MOVEIT = "panda/moveit_resources_panda_description/urdf/panda.urdf"
# Number of hulls, and excess and CPU seconds of CoACD 1.0.13 with as many (threshold 0.05 for the first three).
MESHES_OF = [
    ("bunny_7k.off", 50, 0.040, 38),
    ("rocker-arm.obj", 38, 0.108, 46),
    ("fandisk.obj", 30, 0.036, 36),
    ("fandisk.obj", 8, 0.134, 38),
    ("fandisk.obj", 4, 0.234, 38),
]
VERTICES = [64, 32, 16]
KINDS = ["sphere", "capsule", "cylinder", "box", "swept_box", "hull"]
PER_LINK = [1, 2, 4]
POSES = 300

HEAD = """# Robots by each kind of element

<!-- Made by docs/benchmarks/convex.py; see the end of the page. -->

Each robot is approximated by 1, 2 and 4 elements a link on average, of one kind. Every model is certified on the numbers that are read back from its file.
*Excess* is the volume of the elements outside the links as a share of the volume of the links. *Mean* is the mean protrusion, mm.
*Falsely refused* is the share of 300 random poses in which elements of two links touch, and the geometry of no two links does. *CPU* is the
time of the whole command on one thread, without the cache, of a computer that was busy with other work: compare rows with each other alone. [Evaluating sphere models](../guide/evaluation.md) has the definitions.

"""


def links_of(robot):
    return len(foam.load(robot).links_with_geometry)


def run_timed(*command):
    """Return what the command prints, and its CPU time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([*command, "--fresh", "-j1"], capture_output=True, text=True, check=True)
    return done.stdout, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def timed(program, robot, kind, count, model):
    """Make a model and return the CPU time of the command."""
    name = ["spherize"] if kind == "sphere" else ["approximate", "--with", kind]
    return run_timed(program, *name, robot, "-n", str(count), "-o", model, "-q")[1]


def made(program, robot, kind, count, folder):
    """Return the model's figures, and the CPU time of the command that made it."""
    model = folder / f"{kind}_{count}.json"
    seconds = timed(program, robot, kind, count, model)
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


def pieces(program, meshes, folder):
    """Return the table of convex pieces of meshes, beside those of CoACD."""
    text = ("## Convex pieces of a mesh\n\nThe three meshes are examples of the literature on convex decomposition. foam's pieces have 64 vertices at most, hold all of the surface, and\n"
            "are certified. Those of CoACD 1.0.13 leave 3 to 15 % of the surface outside, by up to 0.006 % of the diagonal; they were made on another computer.\n\n"
            "| mesh | hulls | excess | CPU, s | certified | excess, CoACD | CPU, s, CoACD |\n|---|---|---|---|---|---|---|\n")
    for name, count, excess, seconds in MESHES_OF:
        model = folder / "pieces.json"
        took = timed(program, str(meshes / name), "hull", count, model)
        done = subprocess.run([program, "evaluate", str(meshes / name), model, "--json"], capture_output=True, text=True, check=True)
        total = json.loads(done.stdout)["total"]
        text += f"| {name} | {total['spheres']} | {total['excess']:.3f} | {took:.2f} | {'yes' if total['certified'] else 'no'} | {excess:.3f} | {seconds} |\n"
    text += ("\nA limit of vertices costs little volume. The table shows by how much the volume of one hull around a mesh grows.\n\n| mesh | "
             + " | ".join(f"{most} vertices" for most in VERTICES) + " |\n" + "|---" * (len(VERTICES) + 1) + "|\n")
    for name in dict.fromkeys(row[0] for row in MESHES_OF):
        mesh = foam.read_mesh(meshes / name)
        exact = foam.approximate(mesh, 1, "hull", max_vertices=100_000).volume
        grown = [foam.approximate(mesh, 1, "hull", max_vertices=most).volume / exact - 1 for most in VERTICES]
        text += f"| {name} | " + " | ".join(f"{growth:.2%}" for growth in grown) + " |\n"
    return text + "\n"


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


def links_by(program, robot, count, kind, *options):
    """Return the figures of each covered link, of the whole, and the CPU time."""
    budget = [] if count is None else ["-n", str(count)]
    with tempfile.TemporaryDirectory() as folder:
        printed, seconds = run_timed(program, "approximate", robot, *budget, "--with", kind, "-o", f"{folder}/out.json", "--json", *options)
    data = json.loads(printed)
    return {link["link"]: link for link in data["links"] if not link["skipped"]}, data["total"], seconds


def protrusions(program, panda):
    """Return the table of the largest protrusion of one element, link by link."""
    text = ("## One element a link\n\nThe largest protrusion of one element around each link of the Panda (MoveIt's collision meshes), mm, where that is the objective. A swept box\n"
            "contains boxes and capsules as special cases. Others' figures are published ones, of robosuite's meshes of the same links.\n\n"
            "| kind | link 1 | 2 | 3 | 4 | 5 | 6 | 7 |\n|---|---|---|---|---|---|---|---|\n")
    for kind in ["box", "swept_box", "capsule"]:
        links = links_by(program, panda, links_of(panda), kind, "--objective", "protrusion")[0]
        text += f"| {kind} | " + " | ".join(f"{1000 * links[f'panda_link{i}']['protrusion_max_m']:.0f}" for i in range(1, 8)) + " |\n"
    return text + ("| box, others | 53 | 45 | 74 | 76 | 44 | 50 | 27 |\n| swept box, others | 45 | 25 | 21 | 19 | 27 | 36 | 17 |\n"
                   "| capsule by principal axes, others | 112 | 108 | 100 | 100 | 104 | 96 | 55 |\n\n")


def capsules(program, robots):
    """Return the tables of capsules for whole robots and an arm."""
    text = ("Capsules of least volume, one, two and three a link on average. *Volume / hull* compares the volume of a link's capsules\n"
            "with that of its hull. *Largest* is the largest protrusion of a link. Both are means over the links. Published figures for one capsule a link: UR5e 1.78 and 28 mm, UR10e 1.76 and 34 mm,\n"
            "Panda 1.84 and 38 mm; the links and meshes that were used are not stated.\n\n"
            "| robot | capsules | volume / hull | largest, mm |\n|---|---|---|---|\n")
    for name, robot in robots.items():
        hulls = links_by(program, robot, links_of(robot), "hull", "--set", "stages.approximate.hulls.max_vertices=100000")[0]
        volume = {link: data["volume_m3"] * (1 + data["excess"]) for link, data in hulls.items()}
        for each in [1, 2, 3]:
            links, total, _ = links_by(program, robot, each * len(hulls), "capsule")
            shares = [data["volume_m3"] * (1 + data["excess"]) / volume[link] for link, data in links.items()]
            largest = [data["protrusion_max_m"] for data in links.values()]
            text += f"| {name} | {total['spheres']} | {sum(shares) / len(shares):.2f} | {1000 * sum(largest) / len(largest):.0f} |\n"
    text += ("\nThe eight links of the Panda's arm by capsules. Another tool's capsules of the FR3's arm leave gaps of 6.7, 2.3 and 1.3 mm with 8, 10 and 39 capsules,\n"
             "and take 12.7, 21.8 and 56.8 s. Choosing the number for each link takes most of the time. In the last row foam does not choose: each link may have five.\n\n"
             "| capsules allowed | used | effort | gap, mm | excess | largest, mm | CPU, s |\n|---|---|---|---|---|---|---|\n")
    arm = ["--set", "links={panda_hand: {skip: true}, panda_leftfinger: {skip: true}, panda_rightfinger: {skip: true}}"]
    five = ["--set", "stages.approximate.capsules.elements=5"]
    for count, effort, more in [(8, "normal", []), (10, "normal", []), (39, "normal", []), (39, "fast", []), (None, "fast", five)]:
        _, total, took = links_by(program, robots["Panda"], count, "capsule", "--effort", effort, *arm, *more)
        text += (f"| {count or '5 a link'} | {total['spheres']} | {effort} | {1000 * total['gap_m']:.1f} | {total['excess']:.3f} "
                 f"| {1000 * total['protrusion_max_m']:.0f} | {took:.2f} |\n")
    return text + "\n"


TAIL = """## Repeating the measurement

<!-- not run: the robots and meshes of others are not in this repository -->
```sh
./foam python docs/benchmarks/convex.py ./foam robots meshes > docs/benchmarks/convex.md
```
"""


def main():
    program, robots, meshes = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])

    def put(text):  # what was measured is not lost
        print(text, end="", flush=True)

    put(HEAD)
    with tempfile.TemporaryDirectory() as folder:
        for name, robot in ROBOTS_OF.items():
            put(table(program, name, str(robots / robot), pathlib.Path(folder)))
        put(pieces(program, meshes, pathlib.Path(folder)))
    panda = str(robots / PANDA_OF_MOVEIT)
    put(protrusions(program, panda))
    put(capsules(program, {"Panda": panda, "UR5": str(robots / ROBOTS_OF["UR5"])}))
    put(bounds(str(robots / ROBOTS_OF["Panda"])))
    put(TAIL)


if __name__ == "__main__":
    main()
