#!/usr/bin/env python3
"""Runs many generated meshes through one worker, and watches its memory and file descriptors.

    soak.py FOAM [MESHES]

Prints the worker's resident memory and open files at each tenth of the work. Exit code 1 if the memory at the end is
more than a tenth above that at the first tenth, or if more files are open. By hand: it takes minutes.
"""
import io
import json
import math
import pathlib
import random
import subprocess
import sys
import tarfile
import tempfile
import time


def blob(numbers):
    """Returns a closed surface of 112 triangles as OBJ: a sphere of 7 × 8 quadrilaterals with uneven radii."""
    rows, columns, lines = 8, 8, []
    a, b, c = (numbers.uniform(0.3, 1) for _ in range(3))
    for i in range(1, rows):
        for k in range(columns):
            r, up, around = numbers.uniform(0.8, 1), math.pi * i / rows, 2 * math.pi * k / columns
            lines.append("v %.5f %.5f %.5f" % (a * r * math.sin(up) * math.cos(around),
                                               b * r * math.sin(up) * math.sin(around), c * r * math.cos(up)))
    lines += ["v 0 0 %.5f" % c, "v 0 0 %.5f" % -c]
    top, bottom = len(lines) - 1, len(lines)
    for k in range(columns):
        following = (k + 1) % columns
        lines.append(f"f {top} {k + 1} {following + 1}")
        lines.append(f"f {bottom} {(rows - 2) * columns + following + 1} {(rows - 2) * columns + k + 1}")
        for i in range(rows - 2):
            p, q = i * columns + k + 1, i * columns + following + 1
            lines += [f"f {p} {p + columns} {q}", f"f {q} {p + columns} {q + columns}"]
    return "\n".join(lines).encode()


def write_archive(file, count):
    numbers = random.Random(7)
    with tarfile.open(file, "w") as archive:
        for i in range(count):
            data = blob(numbers) if i % 100 != 99 else b"f 1 2 3\n"  # every hundredth is broken
            entry = tarfile.TarInfo(f"{i:06}.obj")
            entry.size = len(data)
            archive.addfile(entry, io.BytesIO(data))


def worker_of(process):
    """Returns the folder of the worker in /proc, or nothing."""
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    try:
        for child in children.read_text().split():
            if b"batch-worker" in pathlib.Path(f"/proc/{child}/cmdline").read_bytes():
                return pathlib.Path(f"/proc/{child}")
    except OSError:
        pass
    return None


def memory_and_files(worker):
    status = (worker / "status").read_text()
    resident = int(status.split("VmRSS:")[1].split()[0]) / 1024
    return resident, len(list((worker / "fd").iterdir()))


def main():
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 100_000
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        write_archive(folder / "set.tar", count)
        begin = time.monotonic()
        process = subprocess.Popen([program, "batch", "set.tar", "-n", "4", "--run-dir", "out", "-j", "1", "--set",
                                    "stages.spherize.cover.effort=fast"], cwd=folder, stdout=subprocess.PIPE)
        samples, workers = [], set()
        while process.poll() is None:
            time.sleep(1)
            worker = worker_of(process)
            try:
                if worker:
                    samples.append(memory_and_files(worker))
                    workers.add(worker.name)
            except (OSError, IndexError):
                continue
        seconds = time.monotonic() - begin
        print(process.stdout.read().decode().strip())
        status = json.loads(subprocess.run([program, "batch", "status", "out", "--json"], cwd=folder,
                                           capture_output=True, check=True).stdout)
    print(f"{count} meshes in {seconds:.0f} s: {count / seconds:.0f} a second with one worker "
          f"({1000 * status['cpu_seconds'] / count:.2f} CPU ms a mesh in it); {len(workers)} process")
    tenths = [samples[len(samples) * i // 10] for i in range(1, 10)] + [samples[-1]]
    for i, (resident, files) in enumerate(tenths):
        print(f"{10 * (i + 1):4} %  {resident:7.1f} MB  {files} files open")
    good = tenths[-1][0] <= 1.1 * tenths[0][0] and tenths[-1][1] <= tenths[0][1] and len(workers) == 1
    print("memory and files stay flat" if good else "memory or files grow")
    return 0 if good else 1


sys.exit(main())
