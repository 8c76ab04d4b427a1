#!/usr/bin/env python3
"""Compares what foam reads of URDF files with what other readers read.

    robots.py foam-robot-parts FOLDER… [--out TABLE.tsv] [--sample N]

Looks for every *.urdf below the folders. Each reader gets each file in a process of its own. Compared are the names of
links, and of their collision elements the number, kinds, sizes, and poses in the frame of the link. The table has a
line for each file and reader: whether foam and the reader load it, and the differences. Differences with a known cause
are in brackets. Exit code 1 if another reader loads a file that foam refuses, or a difference has no known cause.
Readers that are missing are left out. Needs Python 3, and any of: yourdfpy, pin, pybullet, mujoco, check_urdf.
foam-robot-parts is a program of the target bench.
"""
import argparse
import importlib.util
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

LIMIT = 60  # seconds for a file


def part(kind, sizes, position=None, rotation=None):
    """Returns a collision element as foam-robot-parts prints it."""
    return {"kind": kind, "sizes": [float(size) for size in sizes],
            "xyz": None if position is None else [float(x) for x in position],
            "rotation": None if rotation is None else [[float(x) for x in row] for row in rotation]}


def read_yourdfpy(file):
    """Returns links and collision elements as yourdfpy has them."""
    import numpy
    import yourdfpy
    robot = yourdfpy.URDF.load(file, load_meshes=False, load_collision_meshes=False, build_scene_graph=True)
    if robot.base_link is None:
        raise ValueError("no root link")
    links = {}
    for link in robot.robot.links:
        parts = links.setdefault(link.name, [])
        for collision in link.collisions:
            origin = numpy.eye(4) if collision.origin is None else collision.origin
            shape = collision.geometry
            if shape.box is not None:
                kind, sizes = "box", shape.box.size
            elif shape.sphere is not None:
                kind, sizes = "sphere", [shape.sphere.radius]
            elif shape.cylinder is not None:
                kind, sizes = "cylinder", [shape.cylinder.radius, shape.cylinder.length]
            elif shape.mesh is not None:
                kind, sizes = "mesh", numpy.ones(3) * (1 if shape.mesh.scale is None else shape.mesh.scale)
            else:
                kind, sizes = "nothing", []
            parts.append(part(kind, sizes, origin[:3, 3], origin[:3, :3]))
    return {"links": links}


def read_pinocchio(file):
    """Returns links and collision elements as Pinocchio has them; links alone if it does not load the geometry."""
    import pinocchio
    folders = [str(folder) for folder in Path(file).resolve().parents][:-1]
    model = pinocchio.buildModelFromUrdf(file)
    links = {frame.name: [] for frame in model.frames if frame.type == pinocchio.FrameType.BODY}
    try:
        geometry = pinocchio.buildGeomFromUrdf(model, file, pinocchio.GeometryType.COLLISION, package_dirs=folders)
    except Exception as error:
        return {"links": dict.fromkeys(links), "note": f"no geometry: {error}"}
    for shape in geometry.geometryObjects:
        frame = model.frames[shape.parentFrame]
        pose = frame.placement.inverse() * shape.placement
        form, kind = shape.geometry, type(shape.geometry).__name__
        sizes = {"Box": lambda: 2 * form.halfSide, "Sphere": lambda: [form.radius],
                 "Cylinder": lambda: [form.radius, 2 * form.halfLength],
                 "Capsule": lambda: [form.radius, 2 * form.halfLength]}.get(kind, lambda: shape.meshScale)()
        kind = kind.lower() if kind in ("Box", "Sphere", "Cylinder", "Capsule") else "mesh"
        links[frame.name].append(part(kind, sizes, pose.translation, pose.rotation))
    return {"links": links}


def read_pybullet(file):
    """Returns links and collision elements as PyBullet has them, in single precision."""
    import numpy
    import pybullet
    pybullet.connect(pybullet.DIRECT)
    body = pybullet.loadURDF(file, flags=pybullet.URDF_USE_IMPLICIT_CYLINDER)  # else a mesh
    kinds = {pybullet.GEOM_BOX: "box", pybullet.GEOM_SPHERE: "sphere", pybullet.GEOM_CYLINDER: "cylinder",
             pybullet.GEOM_CAPSULE: "capsule", pybullet.GEOM_MESH: "mesh", pybullet.GEOM_PLANE: "plane"}
    links = {}
    for index in range(-1, pybullet.getNumJoints(body)):
        name = (pybullet.getBodyInfo(body)[0] if index < 0 else pybullet.getJointInfo(body, index)[12])
        parts = links.setdefault(name.decode("utf-8", "replace"), [])
        inertial = pybullet.getDynamicsInfo(body, index)[3:5]
        for shape in pybullet.getCollisionShapeData(body, index):
            kind, size = kinds.get(shape[2], "nothing"), shape[3]
            sizes = {"box": size, "sphere": size[:1], "cylinder": [size[1], size[0]],
                     "capsule": [size[1], size[0]]}.get(kind, size)
            position, turn = pybullet.multiplyTransforms(*inertial, shape[5], shape[6])
            parts.append(part(kind, sizes, position,
                              numpy.reshape(pybullet.getMatrixFromQuaternion(turn), (3, 3))))
    return {"links": links}


def read_mujoco(file):
    """Returns the collision elements as MuJoCo has them: links that do not move are one body, so names are lost."""
    import mujoco
    model = mujoco.MjModel.from_xml_path(file)
    kinds = {mujoco.mjtGeom.mjGEOM_BOX: ("box", lambda s: 2 * s),
             mujoco.mjtGeom.mjGEOM_SPHERE: ("sphere", lambda s: s[:1]),
             mujoco.mjtGeom.mjGEOM_CYLINDER: ("cylinder", lambda s: [s[0], 2 * s[1]]),
             mujoco.mjtGeom.mjGEOM_CAPSULE: ("capsule", lambda s: [s[0], 2 * s[1]])}
    parts = []
    for geom in range(model.ngeom):
        if model.geom_contype[geom] or model.geom_conaffinity[geom]:
            kind, sizes = kinds.get(int(model.geom_type[geom]), ("mesh", lambda s: [1, 1, 1]))
            parts.append(part(kind, sizes(model.geom_size[geom])))
    return {"parts": parts}


def read_urdfdom(file):
    """Returns nothing but that urdfdom loads the file."""
    subprocess.run(["check_urdf", file], capture_output=True, check=True)
    return {}


READERS = {"yourdfpy": read_yourdfpy, "pinocchio": read_pinocchio, "pybullet": read_pybullet, "mujoco": read_mujoco,
           "urdfdom": read_urdfdom}


def serve(reader):
    """Reads the files that standard input names; answers with a line of JSON each. Each in a child process."""
    if reader != "urdfdom":
        importlib.import_module(reader)
    answers = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    os.dup2(1, 2)
    for line in sys.stdin:
        source, target = os.pipe()
        child = os.fork()
        if child == 0:
            signal.alarm(LIMIT)
            try:
                answer = READERS[reader](line.rstrip("\n"))
            except BaseException as error:
                answer = {"error": f"{type(error).__name__}: {error}"[:300]}
            with os.fdopen(target, "w") as stream:
                json.dump(answer, stream)
            os._exit(0)
        os.close(target)
        with os.fdopen(source) as stream:
            answer = stream.read()
        os.waitpid(child, 0)
        os.write(answers, (answer or '{"error": "it crashes, or does not end"}').encode() + b"\n")


def asked(command, files):
    """Returns a program's answers, one for each file. It runs in a folder of its own: MuJoCo leaves a log."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(command, input="".join(f"{file}\n" for file in files), stdout=subprocess.PIPE, text=True,
                              check=True, cwd=folder)
    return [json.loads(line) for line in done.stdout.splitlines()]


def close(first, second, tolerance):
    """Returns whether numbers are equal."""
    return len(first) == len(second) and all(abs(a - b) <= tolerance * max(1, abs(a)) for a, b in zip(first, second))


def numbers_of(one):
    """Returns the numbers of a pose."""
    return one["xyz"] + [number for row in one["rotation"] for number in row]


def is_nothing(one):
    """Returns whether a part has no size, which foam leaves out with a warning."""
    return one["kind"] == "nothing" or (one["kind"] != "mesh" and not any(one["sizes"]))


def known_cause(reader, name, ours, theirs, warnings):
    """Returns why a reader has fewer collision elements of a link; nothing if no cause is known."""
    stop = f"Could not parse inertial element for Link [{name}]"
    if reader == "pinocchio" and any(stop in text for text in warnings):
        return "urdfdom stops reading a link at a wrong inertial"
    for kind, cause in (("capsule", "urdfdom reads no capsules in version 1.0"), ("mesh", "a mesh is not found")):
        others = [one["kind"] for one in ours if one["kind"] != kind]
        if len(others) < len(ours) and others == [one["kind"] for one in theirs]:
            return cause
    return None


def differences_of_parts(reader, name, ours, theirs, warnings):
    """Returns the differences of a link's collision elements, with the known ones in brackets."""
    tolerance = 1e-5 if reader == "pybullet" else 1e-9
    result = []
    nothing = [one for one in theirs if is_nothing(one)]
    if nothing:
        result.append(f"[{name}: {len(nothing)} placeholders without size]")
        theirs = [one for one in theirs if not is_nothing(one)]
    planes = [one for one in theirs if one["kind"] == "plane"]
    if planes:
        result.append(f"[{name}: a plane]")
        theirs = [one for one in theirs if one["kind"] != "plane"]
    if len(ours) != len(theirs):
        cause = known_cause(reader, name, ours, theirs, warnings)
        return [*result, f"[{name}: {cause}]" if cause else f"{name}: {len(ours)} parts against {len(theirs)}"]
    for index, (one, other) in enumerate(zip(ours, theirs)):
        place = f"{name}/{index}"
        if reader == "pinocchio" and [one["kind"], other["kind"]] == ["cylinder", "capsule"]:
            result.append(f"[{place}: a cylinder that <collision_checking> makes a capsule]")
            continue
        if one["kind"] != other["kind"]:
            result.append(f"{place}: {one['kind']} against {other['kind']}")
            continue
        if not close(one["sizes"], other["sizes"], tolerance):
            flat = close(one["sizes"], [size or 1e-6 for size in other["sizes"]], tolerance)
            result.append(f"[{place}: flat]" if flat else f"{place}: sizes {one['sizes']} against {other['sizes']}")
        if not close(numbers_of(one), numbers_of(other), tolerance):
            result.append(f"{place}: pose {one['xyz']} against {other['xyz']}")
    return result


def differences(reader, ours, theirs):
    """Returns how the robot of foam differs from that of a reader."""
    if "parts" in theirs:  # MuJoCo: only the elements of the whole robot
        kinds = [sorted(one["kind"] for one in parts if not is_nothing(one)) for parts in (
            [one for parts in ours["links"].values() for one in parts], theirs["parts"])]
        return [] if kinds[0] == kinds[1] else [f"elements {counted(kinds[0])} against {counted(kinds[1])}"]
    if "links" not in theirs:
        return []
    result = []
    mine, others = ours["links"], theirs["links"]
    for name in [name for name in mine if name not in others]:
        result.append(f"[{name}: implicit]" if name == "world" else f"link {name} only in foam")
    result += [f"link {name} only in {reader}" for name in others if name not in mine]
    for name in mine:
        if others.get(name) is not None:
            result += differences_of_parts(reader, name, mine[name], others[name], ours["warnings"])
    return result


def counted(kinds):
    """Returns how many there are of each."""
    return ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds))) or "none"


def files_below(folder, sample):
    """Returns the files, in their order; of a folder with more than `sample`, so many at random, always the same."""
    by_folder = {}
    for file in sorted(folder.rglob("*.urdf")):
        by_folder.setdefault(file.parent.parent, []).append(file)
    chosen = random.Random(1)
    return sorted(file for files in by_folder.values()
                  for file in (files if len(files) <= sample else chosen.sample(files, sample)))


def main():
    """Writes the table, and counts on standard error."""
    if sys.argv[1:2] == ["--reader"]:
        return serve(sys.argv[2])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", help="the program foam-robot-parts")
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--out", type=argparse.FileType("w"), default=sys.stdout)
    parser.add_argument("--sample", type=int, default=1 << 30, help="most files of one folder of folders")
    arguments = parser.parse_args()
    readers = [name for name in READERS
               if (shutil.which("check_urdf") if name == "urdfdom" else importlib.util.find_spec(name))]
    files = [file for folder in arguments.folders for file in files_below(folder.resolve(), arguments.sample)]
    ours = asked([str(Path(arguments.parts).resolve())], files)
    loaded = sum("error" not in one for one in ours)
    print(f"foam loads {loaded} of {len(files)}", file=sys.stderr)
    worse = 0
    for name in readers:
        refused = known = unknown = 0
        theirs = asked([sys.executable, Path(__file__).resolve(), "--reader", name], files)
        for file, one, other in zip(files, ours, theirs):
            found = [] if "error" in one or "error" in other else differences(name, one, other)
            strange = [text for text in found if not text.startswith("[")]
            refused += "error" in one and "error" not in other
            unknown += bool(strange)
            known += bool(found) and not strange
            print(file, name, one.get("error", "loaded").replace("\n", " "),
                  other.get("error", other.get("note", "loaded")).replace("\n", " "),
                  "; ".join(strange + [text for text in found if text.startswith("[")]), sep="\t",
                  file=arguments.out, flush=True)
        worse += refused + unknown
        print(f"{name} loads {sum('error' not in other for other in theirs)}: {refused} that foam refuses, "
              f"{known} with known differences, {unknown} with others", file=sys.stderr)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
