#!/usr/bin/env python3
"""Covers robots by every kind of element, and has each cover judged by code that shares nothing with foam.

    judge_robots.py FOAM JUDGE FOLDER… [--counts 16,64] [--effort fast] [--seed 0] [--seconds 3600] [--out TABLE.tsv]

Takes each *.urdf below the folders, in an order that the seed draws, so that any beginning is a fair sample, until the
time is over. A line of the table: robot, kind, count, verdict. `held`: foam proves all links, and of a million points
inside links that are closed beyond doubt none lies outside the elements. `refused`: `foam info` reads no geometry.
Anything else is printed, and the exit code is 1.
"""
import argparse
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

KINDS = ["sphere", "capsule", "box", "cylinder", "swept_box", "hull", "sphere,capsule,box,hull"]
POINTS = 1_000_000


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, timeout=1800)


def links_with_geometry(foam, robot):
    done = run(foam, "info", "--json", robot)
    links = json.loads(done.stdout)["links"] if done.returncode == 0 else []
    return len(links)


def verdict(foam, judge, robot, kind, count, effort, links):
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / "model.urdf"
        done = run(foam, "approximate", robot, "--with", kind, "-n", count, "--effort", effort, "-o", model)
        if not model.exists():
            return ("failed" if links else "refused"), done.stderr.strip()
        if done.returncode != 0:
            return "not proved", done.stdout.strip().split("\n")[-1]
        judged = run(judge, robot, model, "--solid", max(1000, POINTS // links))
        return ("held", "") if judged.returncode == 0 else ("objection", (judged.stdout + judged.stderr).strip())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("foam", type=Path)
    parser.add_argument("judge", type=Path)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--counts", default="16,64")
    parser.add_argument("--effort", default="fast")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    robots = sorted({file for folder in arguments.folders for file in folder.rglob("*.urdf")})
    jobs = [(robot, kind, int(count)) for robot in robots for kind in KINDS for count in arguments.counts.split(",")]
    random.Random(arguments.seed).shuffle(jobs)
    end = time.monotonic() + arguments.seconds
    links, counts, bad = {}, {}, 0
    table = arguments.out.open("w") if arguments.out else None
    for done, (robot, kind, count) in enumerate(jobs):
        if time.monotonic() > end:
            print(f"{done} of {len(jobs)} before the time was over")
            break
        if robot not in links:
            links[robot] = links_with_geometry(arguments.foam, robot)
        most = max(count, links[robot])  # each link needs one
        what, why = verdict(arguments.foam, arguments.judge, robot, kind, most, arguments.effort, links[robot])
        counts[what] = counts.get(what, 0) + 1
        bad += what not in ("held", "refused")
        if table:
            print(robot, kind, most, what, why.replace("\n", " "), sep="\t", file=table, flush=True)
        if what not in ("held", "refused"):
            print(robot, kind, most, what, why, flush=True)
    print(" ".join(f"{what}: {count}" for what, count in sorted(counts.items())))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
