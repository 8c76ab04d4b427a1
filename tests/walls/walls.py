"""The walls between foam's modules, as the table in docs/dev/architecture.md has them.

walls.py check ROOT   0: every include is allowed by the table; 1: not, with each file and its remedy
walls.py private ROOT the tests of private headers, with their lines, and their share of all lines of tests
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
USERS_OF_TEXT = ("plugins/load_urdf/", "plugins/write_urdf/", "plugins/load_mjcf/plugin.cpp", "plugins/xml_models/mjcf.cpp",
                 "plugins/load_sdf/model.cpp", "plugins/write_sdf/edit.cpp")


# Tests of private headers hinder changes that nobody would notice. This share of the lines of tests may be in such files.
MOST_PRIVATE = 0.08


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
        found.append(f"{path}: it reads the text of the robot's file; remedy: a field of foam::Robot that its loader fills")
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


def private_headers_of(root, path):
    """The private headers of libraries and plugins that a test includes."""
    found = []
    for bracket, name in INCLUDE.findall((root / path).read_text(errors="replace")):
        if bracket == "<" or (root / path).parent.joinpath(name).is_file() or (root / "tests" / name).is_file():
            continue
        found += [place for place in (root / "core" / name, root / "plugins" / name, *root.glob(f"core/*/src/{name}")) if place.is_file()]
    return found


def private_tests(root):
    """The lines of tests in C++, C and Python: of each file that includes private headers, and of all files."""
    files = [file for file in sorted((root / "tests").rglob("*")) if file.suffix in (".cpp", ".hpp", ".c", ".h", ".py")]
    lines = {file.relative_to(root).as_posix(): len(file.read_text(errors="replace").splitlines()) for file in files}
    return {path: count for path, count in lines.items() if not path.endswith(".py") and private_headers_of(root, path)}, sum(lines.values())


def problems_of_share(root):
    private, lines = private_tests(root)
    share = sum(private.values()) / max(lines, 1)
    return [f"tests: {share:.1%} of their lines are in files that include private headers, {MOST_PRIVATE:.0%} may be; remedy: test through "
            "a public header; walls.py private lists the files"] if share > MOST_PRIVATE else []


def told_of_private(root):
    """Lines for people: the files, the longest first, and the share."""
    private, lines = private_tests(pathlib.Path(root))
    told = [f"{count:5} {path}" for path, count in sorted(private.items(), key=lambda item: -item[1])]
    return told + [f"{sum(private.values())} of {lines} lines: {sum(private.values()) / lines:.1%}"]


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
    return problems + problems_of_share(root)


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
        "plugins/one/reader.hpp": "",
        "tests/x/public_test.cpp": "#include <foam/low/a.hpp>\n" + 30 * "\n",
        "tests/x/script.py": 30 * "\n",
    }
    wrong = {
        "core/low/src/up.cpp": ("#include <foam/high/d.hpp>\n", "core/low may not use core/high"),
        "core/high/src/secret.cpp": ('#include "low/src/c.hpp"\n', "private to core/low"),
        "plugins/two/plugin.cpp": ("#include <foam/low/internal/b.hpp>\n", "internal to foam's libraries"),
        "core/nowhere.cpp": ("", "in no module"),
        "core/high/src/colours.cpp": ("xml::parse(model.robot->source)", "it reads the text of the robot's file"),
        "tests/x/x_test.cpp": ('#include "low/src/c.hpp"\n#include "high/src/e.hpp"\n', "split the test"),
    }
    shares = {  # of 60 lines and its own
        "tests/x/c_test.cpp": ('#include "low/src/c.hpp"\n', 40 * "\n"),
        "tests/x/bare_test.cpp": ('#include "c.hpp"\n', 40 * "\n"),
        "tests/x/reader_test.cpp": ('#include "one/reader.hpp"\n', 40 * "\n"),
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
    for name, (text, more) in shares.items():
        if problems({name: text}):
            failures.append(f"{name} is refused: {problems({name: text})}")
        if not any("private headers" in problem for problem in problems({name: text + more})):
            failures.append(f"{name} is accepted with {len(more)} lines")
    if not any("uses itself" in problem for problem in problems({}, page.replace("text | – |", "text | `core/high` |"))):
        failures.append("a cycle is accepted")
    if not any("not in the table" in problem for problem in problems({}, page.replace("text | – |", "text | `core/x` |"))):
        failures.append("an unknown module is accepted")
    return failures


if __name__ == "__main__":
    if sys.argv[1] == "private":
        print("\n".join(told_of_private(sys.argv[2])))
        sys.exit()
    lines = test() if sys.argv[1] == "test" else check(sys.argv[2])
    print("\n".join(lines) or "as the table has it")
    sys.exit(1 if lines else 0)
