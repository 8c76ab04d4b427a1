"""Checks the front page's table of programs against the last run of their tests, or makes it again.

    table.py RESULTS README REQUIREMENTS...

RESULTS: a folder with what pytest said of each file or folder of tests, as JUnit XML; run_tests.py writes it. A cell is
yes where all tests of a program that have the kind in their name passed. FOAM_TEST_UPDATE=1 writes the table with the
date of the results; else a row that says something else is an error. Programs without results keep their row. 77: no
results.
"""
import os
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

KINDS = ["sphere", "capsule", "box", "cylinder", "swept_box", "hull"]
BEGIN, END = "<!-- programs -->\n", "<!-- /programs -->\n"
#: Programs by the package that has the version, and a word in the names of their tests; the file that they read, and
#: what a user has to do.
PROGRAMS = {
    "MuJoCo": ("mujoco", r"mujoco", "MJCF", ""),
    "Pinocchio with coal": ("pin", r"pinocchio|\[coal-", "URDF", "folder of hulls: `package_dirs`"),
    "Drake": ("drake", r"drake", "URDF, SDF", "`--for drake`: pairs, ellipsoids"),
    "PyBullet": ("pybullet", r"pybullet", "URDF", "`--for pybullet`: rounded edges"),
    "SAPIEN (PhysX)": ("sapien", r"sapien", "URDF", "`--for physx`: cylinders; no hulls"),
    "yourdfpy": ("yourdfpy", r"yourdfpy", "URDF", ""),
    "usd-core (OpenUSD)": ("usd-core", r"test_usd|usd_test", "USD", ""),
    "OMPL": ("ompl", r"ompl", "poses", "plans on spheres in 300 poses, free for the meshes"),
}


def cases(folder):
    """Return names of tests and whether they passed, and the date."""
    found, date = {}, ""
    for file in sorted(Path(folder).glob("*.xml")):
        for suite in xml.parse(file).getroot().iter("testsuite"):
            date = max(date, suite.get("timestamp", "")[:10])
            for case in suite.iter("testcase"):
                bad = any(case.find(what) is not None for what in ("failure", "error", "skipped"))
                found[f"{case.get('classname')}::{case.get('name')}"] = not bad
    return found, date


def versions(files):
    """Return the pinned versions by package."""
    found = {}
    for file in files:
        found |= dict(re.findall(r"^([\w.-]+)==([\w.]+)", Path(file).read_text(encoding="utf-8"), re.MULTILINE))
    return found


def cell(passed, kind):
    """Return what a cell says of the tests with the kind in their name. Tests that name none are of spheres."""
    def named(name, word):
        return re.search(rf"[\[-]({word})[\]-]", name)

    of_kind = [good for name, good in passed.items() if named(name, kind)]
    if kind == "sphere" and not any(named(name, "|".join(KINDS)) for name in passed):
        of_kind = list(passed.values())
    return ("yes" if all(of_kind) else "**no**") if of_kind else "–"


def refused(program, kind):
    """Return whether foam refuses to write the kind for the program: missed_test has them."""
    return program.startswith("SAPIEN") and kind in ("swept_box", "hull")


def table(found, date, pins):
    lines = [f"Last run: {date}.", "", f"| program | version | reads | {' | '.join(kind.replace('_', ' ') for kind in KINDS)} | option |",
             "|---|---|---|" + "---|" * (len(KINDS) + 1)]
    for program, (package, word, reads, option) in PROGRAMS.items():
        passed = {name: good for name, good in found.items() if re.search(word, name)}
        if passed:
            cells = ["no" if refused(program, kind) else cell(passed, kind) for kind in KINDS]
            lines.append(f"| {program} | {pins[package]} | {reads} | {' | '.join(cells)} | {option} |")
    return "\n".join(lines) + "\n"


def main(results, readme, *requirements):
    found, date = cases(results)
    if not found:
        print("skipped: the tests of the programs have not run")
        return 77
    text = Path(readme).read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    old, after = rest.split(END)
    new = table(found, date, versions(requirements))
    if os.environ.get("FOAM_TEST_UPDATE"):
        Path(readme).write_text(before + BEGIN + new + END + after, encoding="utf-8")
        return 0
    different = [line for line in new.splitlines()[1:] if line not in old.splitlines()]
    if different:
        print("README's table differs from the last run; remedy: FOAM_TEST_UPDATE=1. The last run:", *different, sep="\n")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
