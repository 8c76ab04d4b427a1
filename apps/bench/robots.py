#!/usr/bin/env python3
"""Compares which URDF files foam loads with what other readers load.

    robots.py FOAM FOLDER… [--out TABLE.tsv]

Looks for every *.urdf below the folders. Each reader gets each file in a process of its own. The table has one line a
file: the readers that load it, foam's exit code, its links and collision elements, and the first line of its message.
Exit code 1 if another reader loads a file that foam refuses. Readers whose packages are missing are left out.
Needs Python 3, and any of: yourdfpy, pin, pybullet, mujoco.
"""
import argparse
import importlib.util
import json
import subprocess
import sys
from pathlib import Path

READERS = {
    "yourdfpy": ("yourdfpy", """
import yourdfpy
robot = yourdfpy.URDF.load(FILE, load_meshes=True, load_collision_meshes=True, build_scene_graph=True,
                           build_collision_scene_graph=True)
print(len(robot.robot.links), sum(len(link.collisions) for link in robot.robot.links))
"""),
    "pinocchio": ("pinocchio", """
import pinocchio, pathlib
folders = [str(folder) for folder in pathlib.Path(FILE).resolve().parents][:-1]
model = pinocchio.buildModelFromUrdf(FILE)
geometry = pinocchio.buildGeomFromUrdf(model, FILE, pinocchio.GeometryType.COLLISION, folders)
print(sum(frame.type == pinocchio.FrameType.BODY for frame in model.frames), geometry.ngeoms)
"""),
    "pybullet": ("pybullet", """
import pybullet
pybullet.connect(pybullet.DIRECT)
body = pybullet.loadURDF(FILE)
print(pybullet.getNumJoints(body) + 1,
      sum(len(pybullet.getCollisionShapeData(body, link)) for link in range(-1, pybullet.getNumJoints(body))))
"""),
    "mujoco": ("mujoco", """
import mujoco
model = mujoco.MjModel.from_xml_path(FILE)
print(model.nbody - 1, model.ngeom)
"""),
}


def read(reader, file):
    """Returns what the reader counted, or None if it refuses the file or does not end."""
    code = f"FILE = {str(file)!r}\n" + READERS[reader][1]
    try:
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    except subprocess.TimeoutExpired:
        return None
    return done.stdout.split("\n")[-2] if done.returncode == 0 and done.stdout.count("\n") else None


def foam_reads(foam, file):
    """Returns foam's exit code, its counts, and the first line of its message."""
    done = subprocess.run([foam, "info", "--json", str(file)], capture_output=True, text=True, timeout=600, check=False)
    counts = ""
    if done.returncode == 0:
        info = json.loads(done.stdout)
        counts = f"{len(info.get('links', []))}"
    message = next((line for line in done.stderr.splitlines() if done.returncode == 0 or "warning" not in line), "")
    return done.returncode, counts, message


def main():
    """Writes the table, and counts on standard error."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("foam")
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--out", type=argparse.FileType("w"), default=sys.stdout)
    arguments = parser.parse_args()
    readers = [name for name, (module, _) in READERS.items() if importlib.util.find_spec(module)]
    worse = 0
    for folder in arguments.folders:
        files = sorted(folder.rglob("*.urdf"))
        loaded = elsewhere = 0
        for file in files:
            code, counts, message = foam_reads(arguments.foam, file)
            others = [reader for reader in readers if code != 0 and read(reader, file) is not None]
            loaded += code == 0
            elsewhere += bool(others)
            print(file.relative_to(folder.parent), code, counts, ",".join(others), message, sep="\t",
                  file=arguments.out, flush=True)
        print(f"{folder.name}: {len(files)} files, {loaded} loaded by foam, {elsewhere} of the others by another reader",
              file=sys.stderr)
        worse += elsewhere
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
