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

HEAD = """# Published sphere models, evaluated

<!-- Made by docs/benchmarks/reference_models.py FOAM ROBOTS MODELS; see the end of the page. -->

The table shows published sphere models of robots. `foam evaluate` compares each model with the collision geometry of the robot's URDF: its
coverage, gap, excess, missing volume and protrusion. [Evaluating sphere models](../guide/evaluation.md) has the definitions. The figures
include only the links that have spheres; *links* shows how many these are. CoMMALab/foam is the program of Coumar et al. 2025.

The table is not a ranking. Some models are conservative, others fit the geometry (MorphIt), and planners inflate others by a buffer
(cuRobo). Some were made from other meshes than these, or by hand in slightly different frames.

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
    text = "\n## Which geometry\n\n| robot | geometry |\n|---|---|\n"
    for robot, original in sorted({(entry["robot"], entry["original"]) for entry in entries}):
        text += f"| {robot} | `{original}` |\n"
    return text + """
## Repeating the evaluation

[reference_models.csv](reference_models.csv) lists the files, their sources, and the options that match the names of links.
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
