"""schemas/ and what runs write.

schemas.py files PROGRAM SOURCE   PROGRAM prints those that are built into it, and all shipped recipes name theirs
schemas.py runs PROGRAM SOURCE    manifests and sphere databases of runs follow them (needs python3-jsonschema)
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROBOT = """<robot name="two">
  <link name="base"><collision><geometry><box size="1 0.4 0.2"/></geometry></collision></link>
  <link name="tip"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="j" type="fixed"><parent link="base"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>
"""
RECIPE = """foam: 1
robot: {urdf: robot.urdf}
stages: [repair.auto, spherize.grid]
budget: {spheres: 5}
outputs: [write.json: {file: spheres.json}]
debug: {meshes: true}
variants:
  plain: {seed: 0}
  skipped: {links.tip.skip: true}
  padded: {pad: 1cm}
  sheet: {links.base.skip: true, budget.spheres: 1}
"""


def schema(program, what):
    return subprocess.run([program, "schema", what], check=True, capture_output=True, text=True, encoding="utf-8").stdout


def check_files(program, source):
    failures = 0
    for what in ("manifest", "spheres"):
        file, text = source / "schemas" / f"{what}.schema.json", schema(program, what)
        if file.read_text(encoding="utf-8") != text:
            print(f"{file.relative_to(source)} is not what `foam schema {what}` prints; remedy: build foam again")
            failures += 1
    recipes = [file for folder in ("configs", "apps", "docs/examples") for file in sorted((source / folder).rglob("*.yaml"))
               if file.parent.name != "ci"]  # files of other programs
    recipes = [file for file in recipes if "\nfoam_experiment: " not in file.read_text(encoding="utf-8")] # these have no schema
    assert len(recipes) > 10, recipes
    for recipe in recipes:
        if not recipe.read_text(encoding="utf-8").startswith("# yaml-language-server: $schema="):
            print(f"{recipe.relative_to(source)} does not begin with the line by which editors find the schema")
            failures += 1
    return failures


def problems(document, what, program, jsonschema):
    validator_class = jsonschema.Draft202012Validator
    rules = json.loads(schema(program, what))
    validator_class.check_schema(rules)
    return [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in validator_class(rules).iter_errors(document)]


def check_runs(program):
    try:
        import jsonschema
        jsonschema.Draft202012Validator
    except (ImportError, AttributeError) as error:
        print(f"skipped: {error}; package: python3-jsonschema")
        return 77
    found = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "robot.urdf").write_text(ROBOT)
        (folder / "recipe.yaml").write_text(RECIPE)
        subprocess.run([program, "run", "recipe.yaml", "--variant", "*", "--fresh"], check=True, cwd=folder, capture_output=True)
        manifests = sorted(folder.glob("runs/*/manifest.json"))
        assert len(manifests) == 4, manifests
        for manifest in manifests:
            document = json.loads(manifest.read_text(encoding="utf-8"))
            spheres = json.loads((manifest.parent / "spheres.json").read_text(encoding="utf-8"))
            found += [f"{manifest.parent.name}/manifest.json: {p}" for p in problems(document, "manifest", program, jsonschema)]
            found += [f"{manifest.parent.name}/spheres.json: {p}" for p in problems(spheres, "spheres", program, jsonschema)]
            del document["outputs"]  # the check can fail
            document["surprise"] = 1
            assert len(problems(document, "manifest", program, jsonschema)) == 2
    print("\n".join(found))
    return len(found)


if __name__ == "__main__":
    task, program, source = sys.argv[1], os.path.abspath(sys.argv[2]), pathlib.Path(sys.argv[3])
    result = check_files(program, source) if task == "files" else check_runs(program)
    sys.exit(77 if result == 77 else min(result, 1))
