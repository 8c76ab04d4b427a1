"""Small data sets, and calls of foam batch."""
import json
import os
import pathlib
import random
import subprocess
import sys

FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
         (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def box_text(a, b, c):
    corners = [(x, y, z) for x in (0, a) for y in (0, b) for z in (0, c)]
    return "".join("v %g %g %g\n" % corner for corner in corners) + \
        "".join("f %d %d %d\n" % tuple(i + 1 for i in face) for face in FACES)


def write_boxes(folder, count, seed=1):
    """Boxes of different sizes, and every sixth file is broken."""
    folder.mkdir()
    numbers = random.Random(seed)
    for i in range(count):
        text = box_text(*[round(numbers.uniform(0.1, 1), 3) for _ in range(3)])
        (folder / f"box{i:03}.obj").write_text(text if i % 6 != 5 else "f 1 2 3\n")


class Foam:
    """Runs foam batch in a folder."""

    def __init__(self, program, folder, plugin=None):
        self.command = [program] + (["--plugin", plugin] if plugin else []) + ["batch"]
        self.folder = folder

    def start(self, *arguments, env=None):
        return subprocess.Popen([*self.command, *map(str, arguments)], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **(env or {})})

    def __call__(self, *arguments, code=0, env=None):
        """Returns stdout and stderr; ends the test if the exit code is another one."""
        process = self.start(*arguments, env=env)
        out, err = process.communicate(timeout=300)
        expect(process.returncode == code, f"batch {arguments}: exit code {process.returncode}, not {code}\n{out}{err}")
        return out, err

    def table(self, results):
        """Returns the bytes of the table without times."""
        out = pathlib.Path(self.folder, "table.jsonl")
        failed = subprocess.run([*self.command, "collect", results, "-o", out, "--no-times"], cwd=self.folder,
                                capture_output=True, text=True)
        expect(failed.returncode == 0, failed.stderr)
        return out.read_bytes()

    def results(self, results):
        """Returns the results by id."""
        return {line["id"]: line for line in map(json.loads, self.table(results).splitlines())}


def expect(condition, message):
    if not condition:
        sys.exit(f"failed: {message}")


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)
