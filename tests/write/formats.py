#!/usr/bin/env python3
"""Every robot in every format: the same spheres come back, and are proved on the file.

    formats.py FOAM PAGE SHARED

Robots: the Panda of configs/ and the seven robots of SHARED. One run writes a robot by all writers; `foam convert` reads
each file back to a table, which must be byte for byte that of write.csv, and prints that what it read is proved. For the
Panda of configs/ `foam certify` proves each file as well: it makes the same proof as `foam convert`. The page has the
results; FOAM_TEST_UPDATE=1 writes it. Formats of one body are tested with a mesh. Exit code 77: no SHARED.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
ONE_BODY = {"curobo_scene", "morphit", "vamp_world"}
NO_SPHERES_ALONE = {"gltf"}  # pictures
PROVED = re.compile(r"^Proved: the collision geometry of (\d+) of \1 links lies inside their spheres, (?:\d+ )?as (?:a )?(?:solid|surface)s?(?:, \d+ as (?:a )?surfaces?)?(?:; as a surface: .*)?\.$", re.M)
MADE = "<!-- Made by tests/write/formats.py: FOAM_TEST_UPDATE=1 ./foam test -R write.formats -->\n"
ROBOTS = [("Panda (configs)", ROOT / "configs/robots/panda/panda.urdf")]
SHARED_ROBOTS = [
    ("Panda", "panda/foam_variant/panda.urdf"), ("UR5", "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf"),
    ("Fetch", "fetch/fetch_description/fetch_foam.urdf"), ("iiwa", "iiwa/model.urdf"),
    ("Jaco", "jaco/kinova_description/urdf/j2s7s300.urdf"), ("Stretch", "stretch/foam_variant/stretch/stretch.urdf"),
    ("Baxter", "baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf")]


def foam(program, *arguments, cwd=None):
    clean = {name: value for name, value in os.environ.items() if not name.startswith("FOAM_")}
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=clean, cwd=cwd)


def tool_of(urdf):
    """A link without children: the last of the file."""
    joints = xml.etree.ElementTree.parse(urdf).getroot().findall("joint")
    parents = {joint.find("parent").get("link") for joint in joints}
    return [joint.find("child").get("link") for joint in joints if joint.find("child").get("link") not in parents][-1]


def locked(urdf):
    """Joints that others follow: a planner that does not know mimic joints holds them."""
    joints = xml.etree.ElementTree.parse(urdf).getroot().findall("joint")
    followed = {joint.find("mimic").get("joint") for joint in joints if joint.find("mimic") is not None}
    moving = {joint.get("name") for joint in joints if joint.get("type") != "fixed"}
    return {name: 0.01 for name in sorted(followed & moving)}


def parameters_of(name, urdf):
    """What a writer needs beyond the facts of the robot."""
    if name != "gpmp2":
        return ""
    links = [link.get("name") for link in xml.etree.ElementTree.parse(urdf).getroot().findall("link")]
    return ", frames: " + json.dumps("; ".join(f"{link} {i} 0 0 0 0 0 0" for i, link in enumerate(links)))


def recipe(urdf, formats):
    lines = ["foam: 1", "name: all", f"robot: {{urdf: [{json.dumps(str(urdf))}], tool_frames: [{json.dumps(tool_of(urdf))}], "
             f"lock_joints: {json.dumps(locked(urdf))}}}",
             "stages: [{spherize.cover: {effort: fast}}]", "budget: {spheres: 60}", "outputs:"]
    lines += [f"  - write.{f['format']}: {{file: {f['format']}/model.{f['extensions'][0]}{parameters_of(f['format'], urdf)}}}"
              for f in formats]
    return "\n".join(lines) + "\n"


def results_of(program, urdf, formats, folder):
    """By format: "yes", or what is wrong."""
    (folder / "all.yaml").write_text(recipe(urdf, formats))
    run = foam(program, "run", folder / "all.yaml", "--run-dir", folder / "run")
    if run.returncode:
        return {f["format"]: run.stderr.strip() for f in formats}
    table = next((folder / "run/csv").iterdir()).read_text()
    results = {}
    for entry in formats:
        file = folder / "run" / entry["format"] / f"model.{entry['extensions'][0]}"
        if entry["format"] in NO_SPHERES_ALONE:
            results[entry["format"]] = "written"  # the run itself has read it back and proved it
            continue
        back = foam(program, "convert", file, urdf, "-o", folder / "back.csv", "--force")
        if back.returncode:
            results[entry["format"]] = back.stderr.strip()
        elif (folder / "back.csv").read_text() != table:
            results[entry["format"]] = "other spheres come back"
        elif not PROVED.search(back.stdout + back.stderr) or (urdf == ROBOTS[0][1] and foam(program, "certify", urdf, file).returncode):
            results[entry["format"]] = "not certified"
        else:
            results[entry["format"]] = "yes"
    return results


def one_body(program, name, folder):
    """A mesh in a format of one body."""
    mesh = ROOT / "configs/robots/panda/meshes/link5.obj"
    out = folder / f"part.{name}"
    made = foam(program, "spherize", mesh, "-n", 6, "--format", name, "-o", out)
    return made.returncode == 0 and foam(program, "certify", mesh, out).returncode == 0


def page_of(rows, formats):
    names = [f["format"] for f in formats]
    page = f"# Formats and robots\n\n{MADE}\n" + (
        "Each robot was covered by 60 spheres, and written in each format by one run. *yes*: `foam convert` reads the same\n"
        "numbers back, and proves them. *written*: the run has read it back and proved it; `foam evaluate`\n"
        "does not read the format. Formats of one body (" + ", ".join(f"`{name}`" for name in sorted(ONE_BODY)) +
        ") are tested with a mesh.\n\n")
    page += "| robot | " + " | ".join(f"`{n}`" for n in names) + " |\n|---|" + "---|" * len(names) + "\n"
    for robot, results in rows:
        page += f"| {robot} | " + " | ".join(results[n] for n in names) + " |\n"
    return page


def main():
    program, page, shared = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    everything = json.loads(foam(program, "formats", "--json").stdout)
    formats = [f for f in everything if f["writes"] and f["format"] not in ONE_BODY]
    there = (shared / "robots").is_dir()
    robots = ROBOTS + ([(name, shared / "robots" / path) for name, path in SHARED_ROBOTS] if there else [])
    rows, bad = [], []
    for robot, urdf in robots:
        with tempfile.TemporaryDirectory() as folder:
            rows.append((robot, results_of(program, urdf, formats, pathlib.Path(folder))))
        bad += [f"{robot}, {name}: {result}" for name, result in rows[-1][1].items() if result not in ("yes", "written")]
    with tempfile.TemporaryDirectory() as folder:
        bad += [f"{f['format']}: a mesh does not come back certified" for f in everything
                if f["writes"] and f["format"] in ONE_BODY and not one_body(program, f["format"], pathlib.Path(folder))]
    if bad:
        sys.exit("\n".join(bad))
    if not there:
        print("skipped: the robots of FOAM_SHARED are missing; the Panda of configs passed")
        sys.exit(77)
    text = page_of(rows, formats)
    if os.environ.get("FOAM_TEST_UPDATE"):
        page.write_text(text)
    elif page.read_text() != text:
        sys.exit(f"{page} is not what this test finds; remedy: FOAM_TEST_UPDATE=1 ./foam test -R write.formats")


if __name__ == "__main__":
    main()
