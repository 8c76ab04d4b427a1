"""docs/reference: pages made from what the program says of its stages and commands, and from the sources of the Python
package and of foam.h.

reference.py FOAM REPOSITORY
Compares the committed pages with the program; with FOAM_TEST_UPDATE=1 writes them. Exit code 77: a build without some
of the stages cannot tell.
"""
import difflib
import json
import os
import pathlib
import re
import subprocess
import sys

import c_reference
import python_reference
import recipe_reference

KINDS = {"robot loader": "Robot loaders", "mesh loader": "Mesh loaders", "mesh filter": "Mesh filters",
         "spherizer": "Spherizers", "refiner": "Refiners", "writer": "Writers", "renderer": "Renderers", "model reader": "Readers of sphere models"}
MADE = "<!-- Made from the program by tests/docs/reference.py: FOAM_TEST_UPDATE=1 ./foam test -R docs.reference -->\n"
MADE_FROM_SOURCES = MADE.replace("the program", "the sources")


def output_of(*command):
    clean = {name: value for name, value in os.environ.items() if not name.startswith("FOAM_")}
    return subprocess.run(command, check=True, capture_output=True, text=True, env=clean).stdout


def number(value):
    """A bound as people write it."""
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        value = int(value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def literal(value):
    """A default as a recipe writes it."""
    if isinstance(value, str):
        return value or '""'
    return json.dumps(value) if isinstance(value, bool) else number(value)


def cell(text):
    return text.replace("|", "\\|").replace("\n", " ")


def sentence(text):
    return text if text.endswith((".", "!", "?")) else text + "."


def values(parameter):
    """Type and bounds."""
    if "choices" in parameter:
        return ", ".join(f"`{choice}`" for choice in parameter["choices"])
    low, high = parameter.get("low"), parameter.get("high")
    if low is None and high is None:
        return parameter["type"]
    if high is None:
        return f"{parameter['type']}, ≥ {number(low)}"
    if low is None:
        return f"{parameter['type']}, ≤ {number(high)}"
    return f"{parameter['type']}, {number(low)} … {number(high)}"


def row(parameter):
    unit = parameter.get("unit", "")
    text = sentence(parameter["doc"])
    if "source" in parameter:
        text += f" *Default from:* {sentence(parameter['source'])}"
    if not parameter["affects_output"]:
        text += " Does not change the result."
    return (f"| `{parameter['name']}` | {cell(values(parameter))} | {'' if unit == '1' else cell(unit)} "
            f"| `{cell(literal(parameter['default']))}` | {cell(text)} |\n")


def picture_of(stage):
    """The stage's picture, where one was made."""
    image = f"images/stages/{stage['name']}.png"
    if not (pathlib.Path(sys.argv[2]) / "docs" / image).exists():
        return ""
    return f"![A link of the embedded Panda by {stage['name']}](../../{image})\n\n"


def stage_page(stage):
    page = f"# {stage['name']}\n\n{MADE}\n{sentence(stage['summary'])}\n\n"
    page += picture_of(stage)
    page += f"- kind: {stage['kind']}\n"
    page += f"- plugin: `{stage['plugin']}` {stage['plugin_version']}, licence {stage['license']}\n"
    if stage["extensions"]:
        page += f"- files: {', '.join('`.' + extension + '`' for extension in stage['extensions'])}"
        if stage["companions"]:
            page += f", and under the same name {', '.join('`.' + ending + '`' for ending in stage['companions'])}"
        page += "\n"
    if stage["last_resort"]:
        page += "- reads those that no other loader reads, or all if `loaders: {prefer: …}` names it\n"
    if stage["isolation"]:
        keys = {"isolate": "isolate", "time_limit_seconds": "time_limit", "memory_limit_mib": "memory_limit"}
        wishes = ", ".join(f"`{keys[name]}: {literal(value)}`" for name, value in stage["isolation"].items())
        page += f"- unless the recipe says otherwise: {wishes}\n"
    if stage["original_only"]:
        page += "- uses only the original geometry: mesh filters before it have no effect\n"
    if stage["objective_parameter"]:
        page += f"- what is to be least: parameter `{stage['objective_parameter']}`\n"
    if stage["reference"]:
        page += f"- after: {sentence(stage['reference'])}\n"
    if not stage["parameters"]:
        return page + "\nNo parameters.\n"
    page += "\n| parameter | values | unit | default | what it does |\n|---|---|---|---|---|\n"
    return page + "".join(row(parameter) for parameter in stage["parameters"])


def stages_page(stages):
    page = f"# Stages\n\n{MADE}\nWhat recipes are made of. `foam describe STAGE` prints the same.\n"
    for kind, title in KINDS.items():
        page += f"\n## {title}\n\n| stage | what it does |\n|---|---|\n"
        page += "".join(f"| [{stage['name']}](stages/{stage['name']}.md) | {cell(sentence(stage['summary']))} |\n"
                        for stage in stages if stage["kind"] == kind)
    return page


def command_line_page(foam):
    top = output_of(foam, "--help")
    commands = re.findall(r"^  (\S+) ", top.split("Subcommands:")[1].split("\n\n")[0], re.MULTILINE)
    page = f"# Command line\n\n{MADE}\n```text\n{top}```\n"
    for command in commands:
        page += f"\n## foam {command}\n\n```text\n{output_of(foam, command, '--help')}```\n"
    return page


def pages_of(foam, repository):
    """File name → text of every page of docs/reference."""
    header = (repository / "core/c/include/foam.h").read_text(encoding="utf-8")
    stages = json.loads(output_of(foam, "stages", "--json"))
    unknown = {stage["kind"] for stage in stages} - KINDS.keys()
    if unknown:
        sys.exit(f"add to KINDS: {unknown}")
    pages = {f"stages/{stage['name']}.md": stage_page(stage) for stage in stages}
    schema = json.loads(output_of(foam, "schema"))
    return pages | {"stages.md": stages_page(stages), "command_line.md": command_line_page(foam),
                    "recipe.md": recipe_reference.page_of(schema, MADE),
                    "python.md": python_reference.page_of(repository / "python/foam", MADE_FROM_SOURCES),
                    "c.md": c_reference.page_of(header, MADE_FROM_SOURCES)}


def update(folder, pages, vanished):
    for name in vanished:
        (folder / name).unlink()
    for name, text in pages.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def differences(folder, pages):
    for name, text in pages.items():
        committed = (folder / name).read_text() if (folder / name).exists() else ""
        yield from difflib.unified_diff(committed.splitlines(True), text.splitlines(True), f"docs/reference/{name}",
                                        "what it is made from says")


def main():
    foam, repository = sys.argv[1], pathlib.Path(sys.argv[2])
    folder = repository / "docs/reference"
    pages = pages_of(foam, repository)
    committed = {str(file.relative_to(folder)) for file in folder.glob("**/*.md")}
    vanished = committed - pages.keys()
    if os.environ.get("FOAM_TEST_UPDATE"):
        update(folder, pages, vanished)
    elif vanished:
        print(f"skipped: this build does not have {', '.join(sorted(vanished))}")
        return 77
    text = "".join(differences(folder, pages))
    print(text + "remedy: FOAM_TEST_UPDATE=1 ./foam test -R docs.reference" if text else f"{len(pages)} pages are true")
    return 1 if text else 0


if __name__ == "__main__":
    sys.exit(main())
