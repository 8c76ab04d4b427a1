#!/usr/bin/env python3
"""Read every MJCF below folders with foam and with MuJoCo, and compare them.

    PYTHONPATH=build/release/python python3 apps/bench/mjcf_packages.py FOLDER … [--only WORDS]

Needs MuJoCo (tests/consumers/python/requirements.txt). A file counts as `equal` if both read it and agree: geoms with
contact, their form and place, and world poses at 20 random joint positions; as `both refuse`, `foam refuses`, `MuJoCo
refuses`, or `differs`.
"""
import re
import sys
from pathlib import Path

import mujoco
import packages

import foam

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/python/consumers"))
import mjcf_truth  # noqa: E402


def is_mjcf(file):
    text = re.sub(r"<!--.*?-->|<\?.*?\?>", "", file.read_text(errors="replace"), flags=re.S)
    return text.lstrip("\ufeff \t\r\n").startswith("<mujoco") and not text.lstrip().startswith("<mujocoinclude")


def attempt(read):
    try:
        return read(), None
    except (foam.Error, ValueError, AssertionError) as error:
        return None, str(error)


def verdict(file):
    model, theirs = attempt(lambda: mujoco.MjModel.from_xml_path(str(file)))
    robot, ours = attempt(lambda: foam.load(file))
    if ours and "no link has collision geometry" in ours and model is not None and not mjcf_truth.collides(model):
        return "equal", "no geom with contact"
    if model is None or robot is None:
        return ("foam refuses" if model else "MuJoCo refuses" if robot else "both refuse"), f"{ours} | {theirs}"
    count, why = attempt(lambda: mjcf_truth.compare(robot, model, file.parent))
    return ("differs", why) if why else ("equal", f"{count} geoms")


def main():
    arguments = packages.read_arguments(__doc__)
    for folder in arguments.folders:
        packages.compare(folder, filter(is_mjcf, folder.rglob("*.xml")), verdict, arguments.only)


if __name__ == "__main__":
    main()
