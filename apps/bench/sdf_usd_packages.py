#!/usr/bin/env python3
"""Read every SDF and USD below folders with foam and with another reader, and compare them.

    PYTHONPATH=build/release/python python3 apps/bench/sdf_usd_packages.py FOLDER … [--only WORDS]

Needs Drake (pip install drake) for SDF, and usd-core for USD; files of a reader that is missing are left out. A file counts as
`equal` if both read it and agree: links, shapes with contact, their form and place, and poses at random joint values; as
`both refuse`, `foam refuses`, `the other refuses`, or `differs`.
"""
import importlib.util
import os
import re
import sys
from pathlib import Path

import foam
import packages

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/python/consumers"))
os.environ.setdefault("FOAM_PYTHON", sys.executable)


def is_sdf(file):
    text = re.sub(r"<!--.*?-->|<\?.*?\?>", "", file.read_text(errors="replace"), flags=re.S)
    return re.match(r"[\ufeff\s]*<sdf[\s>]", text) is not None


def attempt(read):
    try:
        return read(), None
    except (foam.Error, ValueError, AssertionError, RuntimeError, MemoryError) as error:
        return None, str(error) or repr(error)


def sdf_reader():
    import sdf_truth

    return ("*.sdf", "*.world"), is_sdf, sdf_truth.Drake, sdf_truth.compare


def usd_reader():
    import usd_truth

    return ("*.usd", "*.usda", "*.usdc", "*.usdz"), lambda _: True, usd_truth.Stage, usd_truth.compare


def verdict(file, folder, read, compare):
    robot, ours = attempt(lambda: foam.load(file))
    other, theirs = attempt(lambda: read(file, folder))
    if ours and re.search("no link has collision geometry|no prim has PhysicsRigidBodyAPI", ours) and other and not other.collides():
        return "equal", "nothing collides"
    if robot is None or other is None:
        return ("foam refuses" if other else "the other refuses" if robot else "both refuse"), f"{ours} | {theirs}"
    count, why = attempt(lambda: compare(robot, other))
    return ("differs", why) if why else ("equal", f"{count} shapes")


def main():
    arguments = packages.read_arguments(__doc__)
    readers = [reader for module, reader in (("pydrake", sdf_reader), ("pxr", usd_reader)) if importlib.util.find_spec(module)]
    for patterns, accepted, read, compare in [reader() for reader in readers]:
        for folder in arguments.folders:
            files = [file for pattern in patterns for file in folder.rglob(pattern) if accepted(file)]
            packages.compare(folder, files, lambda file: verdict(file, folder, read, compare), arguments.only)  # noqa: B023


if __name__ == "__main__":
    main()
