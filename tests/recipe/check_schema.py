"""Checks the JSON Schema of recipes with another implementation: python3-jsonschema.

check_schema.py SCHEMA_PROGRAM RECIPES PLUGIN...
Every good recipe is valid; a bad one is not, unless a schema cannot see what is wrong with it (INVISIBLE).
Exit code 77: skipped.
"""
import json
import pathlib
import re
import subprocess
import sys

try:
    import jsonschema
    import yaml
except ImportError as error:
    print(f"skipped: {error}; packages: python3-jsonschema python3-yaml")
    sys.exit(77)

# What is wrong with these no schema can see. The YAML parser loses it:
INVISIBLE = {"anchor", "duplicate_keys"}
# It needs counting:
INVISIBLE |= {"sweep_too_large", "variants_too_many"}
# It is in another file, or is only wrong together with one:
INVISIBLE |= {"extends_missing", "extends_folder", "extends_circle", "extends_itself", "extends_list",
              "extends_no_version", "extends_unclosed", "extends_missing_plugin", "extends_two_inputs",
              "extends_without_stages", "extends_wrong_override"}
# It is the value at a path, or it contradicts another value:
INVISIBLE |= {"guarantee_inner", "idle_limits", "idle_weight", "clip_inner", "inner_pad", "unit_of_robot", "variants_wrong_values",
              "variants_swept", "variants_same_name", "budget_for", "budget_for_variants"}


class CoreLoader(yaml.SafeLoader):
    """YAML 1.2 core schema instead of YAML 1.1."""


CoreLoader.yaml_implicit_resolvers = {}
for tag, pattern, first in [
    ("null", r"^(~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("bool", r"^(true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    ("int", r"^([-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+)$", list("-+0123456789")),
    ("float", r"^([-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN))$",
     list("-+.0123456789")),
]:
    CoreLoader.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(pattern), first)


def core_int(loader, node):
    text = node.value.lstrip("+")
    base = 16 if text.startswith("0x") else 8 if text.startswith("0o") else 10
    return int(text, base)


CoreLoader.add_constructor("tag:yaml.org,2002:int", core_int)


def problems(validator, path):
    """What is wrong with a recipe as far as another YAML parser and the schema see it."""
    try:
        tree = yaml.load(path.read_bytes(), CoreLoader)
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        return [str(error)]
    return [error.message for error in validator.iter_errors(tree)]


def main():
    program, recipes, *plugins = sys.argv[1:]
    schema = json.loads(subprocess.run([program, *plugins], check=True, capture_output=True, text=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failures = []
    for path in sorted(pathlib.Path(recipes, "good").glob("*.yaml")):
        failures += [f"{path.name}: good, but the schema says: {what}" for what in problems(validator, path)]
    for path in sorted(pathlib.Path(recipes, "bad").glob("*.yaml")):
        found = problems(validator, path)
        if bool(found) == (path.stem in INVISIBLE):
            failures.append(f"{path.name}: " + (f"listed as invisible, but: {found[0]}" if found else "bad, but valid"))
    print("\n".join(failures) or "all recipes agree with the schema")
    return 1 if failures else 0


sys.exit(main())
