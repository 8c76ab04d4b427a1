"""The figures of README.md that foam itself makes, and its table of published models of the Panda.

readme.py FOAM ROBOTS MODELS
FOAM: the program. ROBOTS, MODELS: folders as for reference_models.py. CPU times are those of the whole command on one
thread, without the cache.
"""
import csv
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

# Published models of the Panda, by the repository and path that reference_models.csv has.
PUBLISHED = [
    ("cuRobo", "NVlabs/curobo:curobo/content/configs/robot/franka.yml"),
    ("VAMP", "KavrakiLab/vamp:resources/panda/panda_spherized.urdf"),
    ("Isaac Sim", "franka_conservative_spheres_robot_description.yaml"),
    ("MorphIt", "HIRO-group/MorphIt-1:web/examples/panda.spherical.urdf"),
    ("CoMMALab/foam", "CoMMALab/foam:spherized.urdf"),
]
PANDA = "panda/moveit_resources_panda_description/urdf/panda.urdf"
ROBOTS_OF = {
    "Baxter": "baxter/example-robot-data/robots/baxter_description/urdf/baxter.urdf",
    "Fetch": "fetch/fetch_description/robots/fetch.urdf",
    "iiwa": "iiwa/model.urdf",
    "Jaco": "jaco/kinova_description/urdf/j2s7s300.urdf",
    "Panda": PANDA,
    "Stretch": "stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
    "UR5": "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
}


def spherized(foam, robot, count, *options, threads=1):
    """The totals of a model, its CPU seconds and its seconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        command = [foam, "spherize", str(robot), "-n", str(count), "-o", f"{folder}/spheres.csv", "--json", "--fresh", f"-j{threads}", *options]
        told = subprocess.run(command, capture_output=True, text=True, check=True)
    after, seconds = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic() - start
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    total = json.loads(told.stdout)["total"]
    assert total["certified"], (robot, count)
    return total, cpu, seconds


def published(foam, robots, models):
    with open(pathlib.Path(__file__).with_name("reference_models.csv"), encoding="utf-8") as file:
        entries = [entry for entry in csv.DictReader(file) if entry["robot"] == "panda"]
    print("| model | spheres | covered | farthest point outside | excess | excess of foam with as many spheres, all covered |")
    print("|---|---|---|---|---|---|")
    for name, source in PUBLISHED:
        entry = [entry for entry in entries if entry["source"].endswith(source)][-1]
        original = robots / entry["original"]
        told = subprocess.run([foam, "evaluate", str(original), str(models / entry["model"]), "--json", *entry["options"].split()],
                              capture_output=True, text=True, check=True)
        total = json.loads(told.stdout)["with_spheres"]
        ours = spherized(foam, original, total["spheres"])[0]
        print(f"| {name} | {total['spheres']} | {100 * total['covered']:.1f} % | {1000 * total['gap_m']:.1f} mm | {total['excess']:.2f} | {ours['excess']:.2f} |", flush=True)


def main():
    foam, robots, models = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    published(foam, robots, models)
    print("\n| spheres | excess | CPU time |\n|---|---|---|")
    for count in (22, 30, 92, 316):
        total, cpu, _ = spherized(foam, robots / PANDA, count)
        print(f"| {count} | {total['excess']:.2f} | {cpu:.2g} s |", flush=True)
    total, cpu, _ = spherized(foam, robots / PANDA, 22, "--effort", "fast")
    print(f"\neffort fast, 22 spheres: excess {total['excess']:.2f}, {cpu:.2g} s")
    for count in (22, 30, 92, 316):
        total, cpu, _ = spherized(foam, robots / PANDA, count, "--method", "medial")
        print(f"medial, {count} spheres: excess {total['excess']:.2f}, {cpu:.2g} s", flush=True)
    for name, robot in ROBOTS_OF.items():
        _, _, seconds = spherized(foam, robots / robot, 60, threads=2)
        print(f"{name}, 60 spheres, two threads: {seconds:.1f} s", flush=True)


main()
