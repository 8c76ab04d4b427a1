"""One mesh at many scales, as ACRONYM has them: one search, each scale proved on its own, the same bytes however it is worked on."""
import json
import math
import pathlib
import random
import sys
import tempfile

from data_set import Foam, expect

SCALES = [0.001, 0.0123, 0.3, 1, 2.5, 25.4, 1000]


def blob(seed, rows=9, columns=12):
    """A closed surface with uneven radii, so that no search ends the same by symmetry."""
    numbers, lines = random.Random(seed), []
    for i in range(1, rows):
        for k in range(columns):
            r, up, around = numbers.uniform(0.7, 1), math.pi * i / rows, 2 * math.pi * k / columns
            lines.append("v %.5f %.5f %.5f" % (r * math.sin(up) * math.cos(around), 0.6 * r * math.sin(up) * math.sin(around),
                                               0.4 * r * math.cos(up)))
    lines += ["v 0 0 .4", "v 0 0 -.4"]
    top, bottom = len(lines) - 1, len(lines)
    for k in range(columns):
        following = (k + 1) % columns
        lines.append(f"f {top} {k + 1} {following + 1}")
        lines.append(f"f {bottom} {(rows - 2) * columns + following + 1} {(rows - 2) * columns + k + 1}")
        for i in range(rows - 2):
            p, q = i * columns + k + 1, i * columns + following + 1
            lines += [f"f {p} {p + columns} {q}", f"f {q} {p + columns} {q + columns}"]
    return "\n".join(lines) + "\n"


def main():
    with tempfile.TemporaryDirectory() as scratch:
        foam, folder = Foam(sys.argv[1], scratch), pathlib.Path(scratch)
        lines = []
        for name in "abc":
            (folder / f"{name}.obj").write_text(blob(name))
            lines += [{"id": f"{name} {scale:g}", "path": f"{name}.obj", "scale": scale} for scale in SCALES]
        lines.append({"id": "alone", "path": "a.obj", "scale": 2.5, "spheres": 3})
        lines.append({"id": "broken 1", "path": "gone.obj", "scale": 1})
        lines.append({"id": "broken 2", "path": "gone.obj", "scale": 2})
        random.Random(1).shuffle(lines)
        (folder / "list.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
        for shards, workers in ((1, 1), (1, 3), (2, 2), (5, 1)):
            foam("list.jsonl", "-n", 6, "--run-dir", f"of{shards}{workers}", "--shards", shards, "-j", workers, code=4)
            expect(foam.table(f"of{shards}{workers}") == foam.table("of11"), f"{shards} shards, {workers} workers")
        results = foam.results("of11")
        for name in "abc":
            unit = results[f"{name} 1"]
            for scale in SCALES:
                line = results[f"{name} {scale:g}"]
                expect(line["certified"] and len(line["spheres"]) == 6, line)
                for ours, theirs in zip(line["spheres"], unit["spheres"]):
                    expect(all(abs(a - scale * b) < 3e-6 * scale for a, b in zip(ours, theirs)), f"{name} {scale}")
                expect(abs(line["excess"] - unit["excess"]) < 1e-3, f"{name} {scale}: {line['excess']} {unit['excess']}")
        expect(len(results["alone"]["spheres"]) == 3, "a count of its own")
        expect(all("error" in results[f"broken {i}"] for i in (1, 2)), "failures of each scale")

        # A recipe with a length: each scale is another problem, and has a search of its own.
        (folder / "grid.yaml").write_text("foam: 1\nname: grid\nmesh: a.obj\nbudget: {spheres: 6}\npad: 1cm\n"
                                          "stages: [spherize.cover]\n")
        foam("list.jsonl", "--recipe", "grid.yaml", "--run-dir", "padded", code=4)
        padded = foam.results("padded")
        for scale in (0.001, 1000):
            expect(all(abs(ours[3] - scale * theirs[3]) > 1e-3 for ours, theirs in
                       zip(padded[f"a {scale:g}"]["spheres"], padded["a 1"]["spheres"])), "a padding does not scale")

        # The search is most of the work: seven scales of three meshes take less than the same as seven meshes each.
        for i, line in enumerate(lines):
            source = folder / line["path"]
            if source.exists():  # another path, so that nothing is shared
                copy = folder / f"copy{i}.obj"
                copy.write_text(source.read_text() + f"# {i}\n")
                line["path"] = copy.name
        (folder / "apart.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
        foam("apart.jsonl", "-n", 6, "--run-dir", "apart", code=4)
        cpu = [json.loads(foam("status", out, "--json")[0])["cpu_seconds"] for out in ("of11", "apart")]
        print(f"{len(lines)} lines, {len(SCALES)} scales: {cpu[0]:.2f} CPU s, and {cpu[1]:.2f} with a search each")


main()
