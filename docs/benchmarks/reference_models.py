"""The page on sphere models that others have published: each judged by `foam evaluate`.

reference_models.py FOAM ROBOTS MODELS > reference_models.md
FOAM: the program. ROBOTS, MODELS: folders that hold the files named in reference_models.csv as `original` and `model`; its
columns `source` and `commit` say where the models are from.
"""
import csv
import json
import pathlib
import subprocess
import sys

HEAD = """# Published sphere models, judged

<!-- Made by docs/benchmarks/reference_models.py FOAM ROBOTS MODELS; see the end of the page. -->

Sphere models of robots as others have published them, each judged by `foam evaluate` against the collision geometry of the
robot's URDF: what it covers, how far the geometry sticks out, and what it claims too much. The definitions are on
[the page on evaluation](../guide/evaluation.md). The figures are over the links that have spheres; *links* says of how many.

It is no ranking. Some models are meant to be conservative, others to fit (MorphIt) or to be inflated by a buffer of the planner
(cuRobo); some were made from other meshes than these, or by hand in frames that differ a little.

| robot | model | made by | links | spheres | covered % | gap mm | excess | missing | out, mean mm | certified |
|---|---|---|---|---|---|---|---|---|---|---|
"""


def figure(value, digits, factor=1):
    return "∞" if value is None else f"{factor * value:.{digits}f}"


def row(foam, robots, models, entry):
    command = [foam, "evaluate", str(robots / entry["original"]), str(models / entry["model"]), "--json"]
    done = subprocess.run(command + entry["options"].split(), capture_output=True, text=True, check=True)
    data = json.loads(done.stdout)
    total = data["with_spheres"]
    links = sum(link["spheres"] > 0 for link in data["links"])
    repository, path = entry["source"].split(":", 1)
    source = f"https://github.com/{repository}/blob/{entry['commit']}/{path}"
    name = pathlib.PurePosixPath(path).name
    return (f"| {entry['robot']} | [{name}]({source}) `{entry['commit']}` | {entry['made_by']} "
            f"| {links} of {len(data['links'])} | {total['spheres']} | {figure(total['covered'], 2, 100)} "
            f"| {figure(total['gap_m'], 1, 1000)} | {figure(total['excess'], 3)} | {figure(total['missing'], 3)} "
            f"| {figure(total['protrusion_mean_m'], 1, 1000)} | {'yes' if total['certified'] else 'no'} |")


def tail(entries):
    text = "\n## Which geometry\n\n| robot | judged by |\n|---|---|\n"
    for robot, original in sorted({(entry["robot"], entry["original"]) for entry in entries}):
        text += f"| {robot} | `{original}` |\n"
    return text + """
## Repeating it

[reference_models.csv](reference_models.csv) names the files, where they are from, and the options that bring the names of links together.
With the robots in one folder and the models in another:

<!-- not run: the robots and models of others are not in this repository -->
```sh
python3 docs/benchmarks/reference_models.py ./foam robots models > docs/benchmarks/reference_models.md
./foam evaluate robots/iiwa/model.urdf models/drake/iiwa14_spheres_collision.urdf --rename iiwa_link_=lbr_iiwa_link_   # one of them
```
"""


def main():
    foam, robots, models = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    with open(pathlib.Path(__file__).with_suffix(".csv"), newline="", encoding="utf-8") as table:
        entries = list(csv.DictReader(table))
    lines = [row(foam, robots, models, entry) for entry in entries]
    print(HEAD + "\n".join(lines) + "\n" + tail(entries), end="")


if __name__ == "__main__":
    main()
