"""Two builds of foam beside each other: CPU time and excess of many spheres and many triangles.

two_programs.py BEFORE AFTER ROBOTS MESHES
BEFORE, AFTER: programs, or commands that run them. ROBOTS, MESHES: folders that hold the files of CASES. Each case is a
process `foam spherize` of its own, from the start to the written file, with its proof, on one thread and without the
cache. The programs take turns, three times; medians of user and system time.
"""
import json
import os
import pathlib
import shlex
import signal
import statistics
import subprocess
import sys
import tempfile

import numpy as np

PANDA, BUNNY, ROCKER = "panda/foam_variant/panda.urdf", "real/stanford-bunny.obj", "real/rocker-arm.obj"
CASES = (
    [(PANDA, count, "normal") for count in (22, 92, 316)]
    + [(BUNNY, count, "fast") for count in (16, 64, 256, 1000)]
    + [(BUNNY, count, "normal") for count in (16, 64, 256, 1000)]
    + [(ROCKER, count, "normal") for count in (16, 32, 64)]
    + [("fine.stl", 8, "fast"), ("fine.stl", 8, "normal")]
)
LONG = 60  # seconds: such a case runs once
LONGEST = 300  # seconds of a process


def write_fine(mesh, file):
    """The mesh with each triangle divided into four, twice, as binary STL."""
    lines = [line.split() for line in mesh.read_text().splitlines()]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], float)
    faces = np.array([[corner.split("/")[0] for corner in line[1:4]] for line in lines if line[:1] == ["f"]], int) - 1
    triangles = vertices[faces]
    for _ in range(2):
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        triangles = np.concatenate([np.stack(corners, 1) for corners in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    rows = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows["corners"] = triangles
    file.write_bytes(bytes(80) + len(rows).to_bytes(4, "little") + rows.tobytes())


def measured(program, input_file, count, effort, folder):
    """(CPU seconds, excess, largest resident MB); None: it takes too long."""
    command = ["/usr/bin/time", "-f", "%U %S %M", "-o", str(folder / "time"), *shlex.split(program), "spherize", str(input_file), "-n", str(count),
               "--fresh", "-j1", "--json", "-o", str(folder / "out.json"), "--set", f"stages.spherize.cover.effort={effort}"]
    # A group of its own: with the process that measures, the program ends too.
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        output, _ = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None
    assert process.returncode == 0, command
    user, system, size = (folder / "time").read_text().split()[-3:]
    total = json.loads(output)["total"]
    assert total["certified"], command
    return float(user) + float(system), total["excess"], int(size) / 1000


def main():
    programs, robots, meshes = sys.argv[1:3], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
    print("| | spheres | effort | CPU s before | now | ratio | excess before | now | MB before | now |\n|---|---:|---|---:|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_fine(meshes / BUNNY, folder / "fine.stl")
        for file, count, effort in CASES:
            place = folder if file == "fine.stl" else robots if file.endswith(".urdf") else meshes
            runs = [[], []]
            for _ in range(3):
                for program, run in zip(programs, runs):
                    if not run or (run[0] and run[0][0] < LONG):
                        run.append(measured(program, place / file, count, effort, folder))
            before, now = ([statistics.median(values) for values in zip(*run)] if run[0] else None for run in runs)
            text = [f"{a:.{digits}f} | {b:.{digits}f}" if (a := before and before[i]) else f"over {LONGEST} | {b:.{digits}f}" if i == 0 else f"| {b:.{digits}f}"
                    for i, (b, digits) in enumerate(zip(now, (2, 3, 0)))]
            ratio = f"{now[0] / before[0]:.2f}" if before else ""
            print(f"| {pathlib.Path(file).stem} | {count} | {effort} | {text[0]} | {ratio} | {text[1]} | {text[2]} |", flush=True)


if __name__ == "__main__":
    main()
