#!/usr/bin/env python3
"""Files that foam writes, in the parsers of those who read them.

    consumers.py CONSUMER FOAM PLACED_SPHERES NODE_FOLDER SHARED

Makes a sphere model of each robot, lets `foam convert` write it in the formats of the consumer, and lets the consumer
read the files: in Python here, or by the script of its name in NODE_FOLDER. Exit code 77: the consumer is not there.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "write"))
from formats import ROBOTS, SHARED_ROBOTS, foam, tool_of  # noqa: E402

FORMATS = {"dart": ["urdf"], "ros": ["markers"], "pyyaml": ["curobo", "xrdf", "lula", "bubblify", "plainmp", "markers"],
           "yaml": ["curobo", "xrdf", "lula", "bubblify", "plainmp", "markers"], "mujoco": ["mjcf"], "tinyusdz": ["usd"],
           "gltf": ["gltf"]}
SETTINGS = {"mjcf": ["--set", "visuals=false"]}  # the parser gets the text without the files that visuals are
IN_PYTHON = {"dart", "ros", "pyyaml"}
FEW_ROBOTS = {"pyyaml", "yaml", "tinyusdz"}  # of which the texts have little, and take seconds each for the pairs


def make(folder, robot, urdf, formats, program, placed_spheres):
    """Writes truth.json and model.FORMAT for a robot into a new folder."""
    folder.mkdir()
    truth = subprocess.run([placed_spheres, urdf, folder / "model.csv"], capture_output=True, text=True)
    if truth.returncode:
        sys.exit(f"{robot}: {truth.stderr}")
    (folder / "truth.json").write_text(truth.stdout)
    first = json.loads(truth.stdout)["positions"][0]["joints"]  # that of the files that place links
    pose = [f"--pose={joint}={value}" for joint, value in list(first.items())[:1]]
    for name in formats:
        made = foam(program, "convert", folder / "model.csv", urdf, "--format", name, "-o", folder / f"model.{name}",
                    "--tool-frame", tool_of(urdf), *pose, *SETTINGS.get(name, []))
        if made.returncode:
            sys.exit(f"{robot}, {name}: {made.stderr}")


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def node_check(consumer, node_folder):
    """Returns a function that lets a script of node judge a folder."""
    try:
        version = subprocess.run(["node", "--version"], capture_output=True, text=True).stdout
    except FileNotFoundError:
        skip("node is not there")
    if int(version.lstrip("v").split(".")[0] or 0) < 20:
        skip(f"node {version.strip()} is older than 20")
    script = pathlib.Path(node_folder) / f"{consumer}.mjs"
    if not (script.parent / "node_modules").is_dir():
        skip(f"npm packages are missing; remedy: npm ci --ignore-scripts --prefix {script.parent}")

    def check(folder):
        done = subprocess.run(["node", script, folder], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{folder.name}: {done.stdout[-3000:]}{done.stderr[-3000:]}")
        return done.stdout.strip()
    return check


def python_check(consumer):
    try:
        module = __import__(f"read_by_{consumer}")
    except ImportError as error:
        skip(f"{error}; dependencies.txt has the Debian package")

    def check(folder):
        return module.check(folder, json.loads((folder / "truth.json").read_text()))
    return check


def main():
    consumer, program, placed_spheres, node_folder, shared = sys.argv[1:]
    check = python_check(consumer) if consumer in IN_PYTHON else node_check(consumer, node_folder)
    there = (pathlib.Path(shared) / "robots").is_dir() if shared else False
    robots = list(ROBOTS)
    if there and consumer not in FEW_ROBOTS:
        robots += [(name + " of others", pathlib.Path(shared) / "robots" / path) for name, path in SHARED_ROBOTS]
    with tempfile.TemporaryDirectory() as room:
        for number, (robot, urdf) in enumerate(robots):
            folder = pathlib.Path(room) / f"{number} {robot}"
            make(folder, robot, urdf, FORMATS[consumer], program, placed_spheres)
            print(f"{robot}: {check(folder)}", flush=True)


if __name__ == "__main__":
    main()
