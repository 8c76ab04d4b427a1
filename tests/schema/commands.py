"""What commands print with --json, and the schemas of schemas/commands.

commands.py names PROGRAM SOURCE    every command with --json has a schema, PROGRAM prints it, names of quantities have their unit
commands.py output PROGRAM SOURCE   outputs follow their schemas, and show every property of them (needs python3-jsonschema)
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import inputs

OWN = {"recipe", "manifest", "spheres"}  # schemas that are of no command
UNITS = {"m": "m", "m2": "m²", "m3": "m³", "seconds": "s", "second": "1/s", "bytes": "bytes", "mib": "MiB"}
DIMENSIONLESS = {"covered", "covered_standard_error", "excess", "excess_standard_error", "excess_unpadded", "missing",
                 "missing_standard_error", "volume_ratio", "volume_change", "confidence", "rate_bound", "joint_rate_bound", "normal", "revision"}
UNIT_ELSEWHERE = {"default", "low", "high", "value",  # in the property `unit` beside it
                  "parameters", "cost",               # as the recipe gives them
                  "reference_pose"}                   # rad or m, by the kind of joint


def run(program, *arguments, folder=None, expected=0):
    done = subprocess.run([program, *map(str, arguments)], cwd=folder, capture_output=True, text=True, encoding="utf-8")
    assert done.returncode == expected, f"{arguments}: exit code {done.returncode}, not {expected}\n{done.stderr}"
    return done.stdout


def commands_with_json(program):
    names = re.findall(r"^  (\S+) ", run(program, "help").split("Subcommands:")[1].split("\n\n")[0], re.MULTILINE)
    assert len(names) > 20, names
    return [name for name in names if re.search(r"^  --json ", run(program, "help", name), re.MULTILINE)]


def properties(rules, place):
    """Place, name and rules of each property, those of $defs among them."""
    for name, rule in rules.get("properties", {}).items():
        yield f"{place}/{name}", name, rule
        yield from properties(rule, f"{place}/{name}")
    for part in ("items", "additionalProperties"):
        if isinstance(rules.get(part), dict):
            yield from properties(rules[part], place)
    for name, rule in rules.get("$defs", {}).items():
        yield from properties(rule, f"$defs/{name}")


def numeric(rule, rules):
    """Whether the property is a number, or holds numbers; counts do not matter."""
    if "$ref" in rule:
        name = rule["$ref"].removeprefix("#/$defs/")
        return name in rules["$defs"] and name != "count" and numeric(rules["$defs"][name], rules)
    kinds = [rule["type"]] if isinstance(rule.get("type"), str) else rule.get("type", [])
    parts = [rule[part] for part in ("items", "additionalProperties") if isinstance(rule.get(part), dict)]
    return not {"number", "integer"}.isdisjoint(kinds) or any(numeric(part, rules) for part in parts)


def wrong_names(rules, described=True):
    """`described`: descriptions say the unit, too."""
    for place, name, rule in properties(rules, ""):
        units = [UNITS[word] for word in name.split("_") if word in UNITS]
        if described and units and not re.search(rf"(^|\W){re.escape(units[-1])}(\W|$)", rule.get("description", "")):
            yield f"{place}: its description does not say the unit {units[-1]}"
        if not units and numeric(rule, rules) and name not in DIMENSIONLESS | UNIT_ELSEWHERE:
            yield f"{place}: its name has no unit; if it has none, it belongs to DIMENSIONLESS"


def check_names(program, source):
    found, shared = [], {}
    with_json = set(commands_with_json(program))
    files = {file.name.removesuffix(".schema.json") for file in (source / "schemas/commands").iterdir()}
    found += [f"foam {name} has --json and no schema: write schemas/commands/{name}.schema.json" for name in with_json - files]
    found += [f"schemas/commands/{name}.schema.json: there is no `foam {name} --json`" for name in files - with_json]
    for name in sorted(files & with_json):
        text = (source / f"schemas/commands/{name}.schema.json").read_text(encoding="utf-8")
        if run(program, "schema", name) != text:
            found.append(f"{name}: `foam schema {name}` prints another one; remedy: build foam again")
        rules = json.loads(text)
        found += [f"{name}: {problem}" for problem in wrong_names(rules)]
        for part, rule in rules.get("$defs", {}).items():
            if shared.setdefault(part, rule) != rule:
                found.append(f"{name}: $defs/{part} is another one than in the files before")
    found += [f"manifest: {problem}" for problem in wrong_names(json.loads(run(program, "schema", "manifest")), described=False)]
    for what in ("manifest", "spheres"):  # the lengths of the latter are in metres, as its `units` says
        rules = json.loads(run(program, "schema", what))
        found += [f"{what}: other figures"] if rules["$defs"]["measures"]["required"] != shared["measures"]["required"] else []
    listed = subprocess.run([program, "schema", "nonsense"], capture_output=True, text=True, encoding="utf-8")
    found += [f"`foam schema nonsense` does not name '{name}'" for name in files | OWN if f" {name}" not in listed.stderr]
    assert len(list(wrong_names({"properties": {"length": {"type": "number"}, "width_m": {"type": "number"}}}))) == 2, "the check can fail"
    print("\n".join(found))
    return len(found)


def shown(document, rules, root, place):
    """Places of the properties that the document has."""
    if rules.get("$ref", "").startswith("#/$defs/"):
        name = rules["$ref"].removeprefix("#/$defs/")
        yield from shown(document, root["$defs"][name], root, f"$defs/{name}")
    if isinstance(document, list):
        for item in document:
            yield from shown(item, rules.get("items", {}), root, place)
    elif isinstance(document, dict):
        for name, value in document.items():
            if name in rules.get("properties", {}):
                yield f"{place}/{name}"
                yield from shown(value, rules["properties"][name], root, f"{place}/{name}")
            elif isinstance(rules.get("additionalProperties"), dict):
                yield from shown(value, rules["additionalProperties"], root, place)


def check_output(program):
    try:
        import jsonschema
        validator_class = jsonschema.Draft202012Validator
    except (ImportError, AttributeError) as error:
        print(f"skipped: {error}; package: python3-jsonschema")
        return 77
    found, have, seen = [], set(), set()
    rules = {name: json.loads(run(program, "schema", name)) for name in commands_with_json(program)}
    with tempfile.TemporaryDirectory() as folder:
        inputs.write(pathlib.Path(folder))
        os.environ.update(HOME=folder, XDG_CACHE_HOME=folder + "/cache")
        for expected, line in inputs.COMMANDS:
            words = line.split()
            output = run(program, *words, folder=folder, expected=expected)
            if "--json" not in words:
                continue
            name, document = words[0], json.loads(output)
            found += [f"foam {line}: {'/'.join(map(str, e.absolute_path))}: {e.message[:300]}"
                      for e in validator_class(rules[name]).iter_errors(document)]
            seen |= set(shown(document, rules[name], rules[name], name))
            if isinstance(document, dict):  # the check can fail
                assert name == "schema" or list(validator_class(rules[name]).iter_errors(document | {"surprise": 1})), name
    for name, rule in rules.items():
        validator_class.check_schema(rule)
        have |= {place for place, _, _ in properties(rule, name)}
    found += [f"{place}: no command of inputs.py prints it" for place in sorted(have - seen)]
    print("\n".join(found))
    return len(found)


if __name__ == "__main__":
    task, program, source = sys.argv[1], os.path.abspath(sys.argv[2]), pathlib.Path(sys.argv[3])
    result = check_names(program, source) if task == "names" else check_output(program)
    sys.exit(77 if result == 77 else min(result, 1))
