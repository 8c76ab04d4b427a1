#!/usr/bin/env python3
"""Digests of what foam writes, to compare two builds.

    outputs.py run FOAM TABLE [--only PART] [--jobs N]   runs foam on everything; one line a case in TABLE
    outputs.py compare BEFORE AFTER                      lists the cases that differ; exit code 1 if there are any

Cases: the recipes of configs/, `foam spherize -n 60` on the robots and `-n 8` on the meshes of FOAM_SHARED (default:
../shared beside the repository) with every spherizer. A line: case, exit code, CPU s, excess, excess of one bounding
sphere (meshes), digest of the written spheres or the message of the refusal. Python 3, nothing else.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = pathlib.Path(os.environ.get("FOAM_SHARED", ROOT.parent / "shared")).resolve()
SPHERIZERS = ["cover", "grid", "hubbard", "medial", "octree", "spawn", "voxel"]
LONGEST = 120  # s of a case


def cases():
    for recipe in sorted((ROOT / "configs").glob("*.yaml")):
        yield f"recipe {recipe.stem}", ["run", str(recipe)], None
    for robot in sorted((SHARED / "robots").rglob("*.urdf")):
        yield f"robot {robot.relative_to(SHARED / 'robots')}", ["spherize", str(robot), "-n", "60"], "urdf"
    folder = SHARED / "meshes"
    endings = {".stl", ".obj", ".off", ".ply", ".dae", ".gltf", ".glb"}
    for mesh in sorted(p for p in folder.rglob("*") if p.suffix.lower() in endings):
        for spherizer in SPHERIZERS:
            yield f"mesh {mesh.relative_to(folder)} {spherizer}", ["spherize", str(mesh), "-n", "8", "-m", spherizer], "csv"


def spheres_of(urdf):
    """The spheres of a URDF with the link they are in, without what else the file holds."""
    links = re.findall(r"<link\b.*?</link>|<link\b[^>]*/>", urdf, re.S)
    return "\n".join("\n".join([link.split(">")[0], *re.findall(r"<collision\b.*?</collision>", link, re.S)]) for link in links)


def digest(folder, kind):
    total = hashlib.sha256()
    for file in sorted(folder.rglob("*")):
        if file.suffix in (".urdf", ".csv", ".json", ".yml") and file.name not in ("manifest.json", "summary.json"):
            text = file.read_text(errors="replace")
            text = spheres_of(text) if file.suffix == ".urdf" else text
            total.update(f"{file.relative_to(folder)}\0{text}\0".encode())
    return total.hexdigest()[:16]


def measured(foam, arguments, folder):
    """Exit code, CPU s and both streams."""
    prefix = [sys.executable, "-c", "import resource, subprocess, sys\n"
              "p = subprocess.run(sys.argv[1:])\n"
              "u = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
              "print('cpu', u.ru_utime + u.ru_stime, file=sys.stderr)\n"
              "sys.exit(p.returncode % 256)"]
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}
    done = subprocess.run(prefix + [foam, *arguments], capture_output=True, text=True, errors="replace", cwd=folder,
                          env=environment, timeout=LONGEST)
    lines = done.stderr.strip().splitlines()
    return done.returncode, float(lines[-1].split()[1]), done.stdout, "\n".join(lines[:-1])


def excess_of(folder, stdout):
    try:
        text = (folder / "out" / "manifest.json").read_text()
    except OSError:
        text = stdout
    found = re.findall(r'"excess": ([0-9.eE+-]+)', text)
    return found[-1] if found else "-"


def line_of(foam, case):
    name, arguments, kind = case
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        given = ["--run-dir", "out"] if kind is None else ["-o", f"out/spheres.{kind}", "--json"]
        (folder / "out").mkdir()
        if kind is None:
            (folder / "out").rmdir()
        try:
            code, cpu, stdout, stderr = measured(foam, [*arguments, *given], folder)
        except subprocess.TimeoutExpired:
            return "\t".join([name, "-", f"{LONGEST}", "-", "hangs"])
        what = digest(folder / "out", kind) if code == 0 else " ".join(stderr.split())[-160:]
        return "\t".join([name, str(code), f"{cpu:.2f}", excess_of(folder, stdout), what])


def run(foam, table, only, jobs):
    chosen = [case for case in cases() if only in case[0]]
    foam = str(pathlib.Path(foam).resolve())
    with open(table, "w") as file, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for line in pool.map(lambda case: line_of(foam, case), chosen):
            print(line, file=file, flush=True)


def read(table):
    lines = (line.rstrip("\n").split("\t") for line in open(table))
    return {name: (code, excess, what) for name, code, _, excess, what in lines}


def compare(before, after):
    old, new = read(before), read(after)
    other = [name for name in sorted(old.keys() | new.keys()) if old.get(name) != new.get(name)]
    for name in other:
        print(name, "\n  before", old.get(name), "\n  after ", new.get(name))
    print(f"{len(old)} cases before, {len(new)} after, {len(other)} differ")
    return 1 if other else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("run")
    one.add_argument("foam")
    one.add_argument("table")
    one.add_argument("--only", default="")
    one.add_argument("--jobs", type=int, default=1)
    two = commands.add_parser("compare")
    two.add_argument("before")
    two.add_argument("after")
    given = parser.parse_args()
    if given.command == "compare":
        sys.exit(compare(given.before, given.after))
    run(given.foam, given.table, given.only, given.jobs)


if __name__ == "__main__":
    main()
