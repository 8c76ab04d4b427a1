"""The walls between foam's modules, as the table in docs/dev/architecture.md has them.

walls.py check ROOT   0: every include is allowed by the table; 1: not, with each file and its remedy
walls.py test         whether `check` would notice

The table is the only list: its first column has the folders, its last the folders that each may use. Headers in `internal/` are
for foam's own libraries and for `apps/bench`. A private header is for its own library, and for tests of that one library.
The text of a robot is for those who read or write URDF: all others ask foam::Robot, which other formats fill as well.
"""
import pathlib
import re
import sys
import tempfile

PAGE = "docs/dev/architecture.md"
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]', re.M)
SOURCES = ("core", "plugins", "apps", "python")
USERS_OF_INTERNALS = ("core/", "apps/bench")
TEXT = re.compile(r"\brobot_?(?:->|\.)source\b")
USERS_OF_TEXT = ("plugins/load_urdf/", "plugins/write_urdf/")


class Table:
    """The modules: their folders, and those that each may use."""

    def __init__(self, page):
        rows = re.findall(r"^\| `([\w/<>]+?)/?` \|.*\| ([^|]*) \|$", page.split("## Modules")[1].split("\n## ")[0], re.M)
        self.uses = {folder: re.findall(r"`([\w/]+)`", used) for folder, used in rows}

    def module_of(self, path):
        """The longest folder of the table that holds the file; None if there is none."""
        holds = [folder for folder in self.uses if re.match(re.sub(r"<\w+>", r"\\w+", folder) + "/", path)]
        return max(holds, key=len, default=None)

    def cycle(self):
        """A module that uses itself, directly or through others; None if there is none."""
        def reached(folder, seen):
            for used in self.uses.get(folder, []):
                if used not in seen:
                    seen.add(used)
                    reached(used, seen)
            return seen
        return next((folder for folder in self.uses if folder in reached(folder, set())), None)


def place_of(root, path, bracket, name):
    """The file of the clone that an include names, relative to its root; None for headers of others."""
    if bracket == "<":
        match = re.match(r"foam/(\w+)/", name)
        if not match:
            return None
        folder = "apps" if match.group(1) == "bench" else "core"
        return f"{folder}/{match.group(1)}/include/{name}"
    own = path.split("/include/")[0].split("/src/")[0]
    for folder in (str(pathlib.PurePosixPath(path).parent), f"{own}/src", "core", "plugins", "apps", "tests"):
        if (root / folder / name).is_file():
            return str((root / folder / name).resolve().relative_to(root.resolve()))
    return None


def problems_of(root, table, path):
    """What is wrong with the includes of a file."""
    module = table.module_of(path)
    if module is None:
        return [f"{path}: it is in no module; remedy: move it, or add its folder to the table in {PAGE}"]
    found = []
    text = (root / path).read_text(errors="replace")
    if TEXT.search(text) and not path.startswith(USERS_OF_TEXT):
        found.append(f"{path}: it reads the robot's URDF; remedy: a field of foam::Robot that load.urdf fills")
    for bracket, name in INCLUDE.findall(text):
        place = place_of(root, path, bracket, name)
        used = place and table.module_of(place)
        if not used or used == module:
            continue
        if used not in table.uses[module]:
            found.append(f"{path}: {module} may not use {used} ({name}); remedy: move the code, or change the table in {PAGE}")
        elif "/internal/" in place and not module.startswith(USERS_OF_INTERNALS):
            found.append(f"{path}: {name} is internal to foam's libraries; remedy: use a public header")
        elif used.startswith("core/") and "/include/" not in place:
            found.append(f"{path}: {name} is private to {used}; remedy: use a public header")
    return found


def problems_of_test(root, path):
    """A test may know the private headers of one library, of those that it tests."""
    rooms = {name.split("/src/")[0] for bracket, name in INCLUDE.findall((root / path).read_text(errors="replace"))
             if bracket == '"' and re.match(r"\w+/src/", name)}
    return [f"{path}: it includes private headers of {' and '.join(sorted(rooms))}; remedy: split the test"] if len(rooms) > 1 else []


def check(root):
    root = pathlib.Path(root)
    table = Table((root / PAGE).read_text())
    problems = [f"{PAGE}: {folder} is not there" for folder in table.uses
                if "<" not in folder and not (root / folder).is_dir()]
    problems += [f"{PAGE}: {folder} may use `{used}`, which is not in the table"
                 for folder, all_used in table.uses.items() for used in all_used if used not in table.uses]
    if table.cycle():
        problems.append(f"{PAGE}: {table.cycle()} uses itself, directly or through others")
    for top in SOURCES:
        for file in sorted((root / top).rglob("*.[ch]pp")):
            problems += problems_of(root, table, file.relative_to(root).as_posix())
    for file in sorted((root / "tests").rglob("*.[ch]pp")):
        problems += problems_of_test(root, file.relative_to(root).as_posix())
    return problems


def test():
    page = ("# A\n\n## Modules\n\n| folder | content | may use |\n|---|---|---|\n| `core/low` | text | – |\n"
            "| `core/high/` | text | `core/low` |\n| `plugins/<name>` | text | `core/low`, `core/high` |\n\n## B\n")
    files = {
        "core/low/include/foam/low/a.hpp": "",
        "core/low/include/foam/low/internal/b.hpp": "",
        "core/low/src/c.hpp": "",
        "core/low/src/c.cpp": '#include "c.hpp"\n#include <foam/low/a.hpp>\n#include <vector>\n',
        "core/high/include/foam/high/d.hpp": "#include <foam/low/internal/b.hpp>\n",
        "plugins/one/plugin.cpp": "#include <foam/high/d.hpp>\n",
    }
    wrong = {
        "core/low/src/up.cpp": ("#include <foam/high/d.hpp>\n", "core/low may not use core/high"),
        "core/high/src/secret.cpp": ('#include "low/src/c.hpp"\n', "private to core/low"),
        "plugins/two/plugin.cpp": ("#include <foam/low/internal/b.hpp>\n", "internal to foam's libraries"),
        "core/nowhere.cpp": ("", "in no module"),
        "core/high/src/colours.cpp": ("xml::parse(model.robot->source)", "it reads the robot's URDF"),
        "tests/x/x_test.cpp": ('#include "low/src/c.hpp"\n#include "high/src/e.hpp"\n', "split the test"),
    }
    failures = []

    def problems(more, text=page):
        with tempfile.TemporaryDirectory() as folder:
            for name, content in {**files, **more, PAGE: text}.items():
                file = pathlib.Path(folder, name)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(content)
            return check(folder)

    if problems({}):
        failures.append(f"a clean tree is refused: {problems({})}")
    for name, (text, wanted) in wrong.items():
        if not any(wanted in problem and name in problem for problem in problems({name: text})):
            failures.append(f"{name} is accepted: {problems({name: text})}")
    if not any("uses itself" in problem for problem in problems({}, page.replace("text | – |", "text | `core/high` |"))):
        failures.append("a cycle is accepted")
    if not any("not in the table" in problem for problem in problems({}, page.replace("text | – |", "text | `core/x` |"))):
        failures.append("an unknown module is accepted")
    return failures


if __name__ == "__main__":
    lines = test() if sys.argv[1] == "test" else check(sys.argv[2])
    print("\n".join(lines) or "as the table has it")
    sys.exit(1 if lines else 0)
