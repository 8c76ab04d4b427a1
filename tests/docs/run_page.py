"""Runs the commands of a page as a reader would, and checks its recipes. docs/dev/testing.md says what a page can hold.

run_page.py FOAM REPOSITORY PAGE
"""
import ast
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import markdown

LANGUAGES = {"", "c", "cmake", "cpp", "json", "python", "sh", "text", "yaml"}
# Debian's Python has the modules of Debian's packages.
PYTHON = shutil.which("python3", path="/usr/bin") or sys.executable
FOAM = sys.argv[1] if len(sys.argv) == 4 else ""
EXITS = re.compile(r"#.*\bexits (\d+)\b")
FILE_NAME = re.compile(r"^(?:#|//) *([\w.-]+\.\w+)$")


def is_complete(command):
    """Whether a shell would run this, or wait for more lines."""
    if command.rstrip("\n").endswith("\\"):
        return False
    read = subprocess.run(["bash", "-n"], input=command, capture_output=True, text=True)
    return read.returncode == 0 and "here-document" not in read.stderr


def commands_of(block):
    """(line, command) of every command; a command may go over several lines."""
    commands, command, start = [], "", block.line
    for number, line in enumerate(block.lines, block.line):
        if not command:
            start = number
        command += line + "\n"
        if is_complete(command):
            if command.strip() and not command.lstrip().startswith("#"):
                commands.append((start, command))
            command = ""
    if command:
        commands.append((start, command)) # the shell says what is wrong with it
    return commands


def imported(text):
    """The packages that a Python text imports."""
    names = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names.add(node.module.split(".")[0])
    return names


def package_path():
    """Where Python finds the package foam, if it was built: beside the program."""
    folder = pathlib.Path(FOAM).parent.parent / "python"
    return {"PYTHONPATH": str(folder)} if FOAM and any(folder.glob("foam/_core.*.so")) else {}


def why_not(block):
    """Why a block is not run; empty if it is. Blocks of Python and experiments need modules."""
    needed = imported(block.text) if block.language == "python" else set()
    if block.language == "sh" and any(line.startswith("./foam bench ") for line in block.lines):
        needed = {"foam", "pandas", "matplotlib", "yaml"}
    if block.remark.startswith("not run:") or not needed:
        return block.remark if block.remark.startswith("not run:") else ""
    asked = "import importlib.util, sys; print(*[m for m in sys.argv[1:] if not importlib.util.find_spec(m)])"
    missing = subprocess.run([PYTHON, "-c", asked, *sorted(needed)], capture_output=True, text=True,
                             env=os.environ | package_path())
    return f"not run: no module {missing.stdout.strip().replace(' ', ', ')}" if missing.stdout.strip() else ""


def python_findings(page, name):
    """Syntax of Python, also of what is not run. Prints what is not run."""
    for block in page.blocks:
        if block.language == "python":
            try:
                ast.parse(block.text)
            except SyntaxError as error:
                yield f"{name}:{block.line}: no Python: {error.msg}"
                continue
        if block.language in ("python", "sh") and (why := why_not(block)).startswith("not run: no module"):
            print(f"{name}:{block.line}: {why}")


# Complains on descriptor 9 and stops the shell if the command before it ended otherwise.
EXPECT = """
expect() {
    code=$?
    [ $code = "$1" ] || { printf '%s: exit code %s, expected %s: %s\\n' "$2" $code "$1" "$3" >&9; exit 1; }
}
"""


def script_of(page, name, outputs):
    """All commands of a page for one shell, so that `cd` and variables last. Block n prints to the file n."""
    script = "exec 9>&2" + EXPECT
    for index, block in enumerate(page.blocks):
        if block.language == "python" and not why_not(block):
            script += (f"exec >{shlex.quote(str(outputs / str(index)))} 2>&1\n{PYTHON} -c {shlex.quote(block.text)}\n"
                       f"expect 0 {name}:{block.line} 'this python'\n")
        if block.language != "sh" or why_not(block):
            continue
        script += f"exec >{shlex.quote(str(outputs / str(index)))} 2>&1\n"
        for line, command in commands_of(block):
            wanted = found[1] if (found := EXITS.search(command)) else "0"
            script += f"{command}expect {wanted} {name}:{line} {shlex.quote(command.strip())}\n"
    return script


def furnish(room, foam, repository, page):
    """What a page may count on: ./foam, configs/, robot.urdf, part.stl, and the files that its own blocks show."""
    program = room / "foam"
    program.write_text(f'#!/bin/sh\nexport FOAM_PYTHON={shlex.quote(PYTHON)}\nexec {shlex.quote(foam)} "$@"\n')
    program.chmod(0o755)
    (room / "configs").symlink_to(repository / "configs")
    for file in (repository / "tests/docs/room").iterdir():
        (room / file.name).write_bytes(file.read_bytes())
    for block in page.blocks:
        if block.lines and (name := FILE_NAME.match(block.lines[0])):
            (room / name[1]).write_text(block.text)


def environment(room):
    """Nothing of the person's own settings and robots, and a home of its own."""
    own = ("FOAM_", "XDG_", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(own)}
    python = str(pathlib.Path(sys.executable).parent)
    return kept | package_path() | {"HOME": str(room), "PATH": os.pathsep.join([str(room), python, kept.get("PATH", os.defpath)])}


def recipes_findings(page, name, room):
    """`foam check` on every block that is a whole recipe."""
    for block in page.blocks:
        content = [line for line in block.lines if not line.startswith("#")]
        if block.language != "yaml" or not content or not content[0].startswith("foam:"):
            continue
        if block.remark.startswith("not checked:"):
            continue
        file = room / f"recipe_of_line_{block.line}.yaml"
        file.write_text(block.text)
        check = subprocess.run([room / "foam", "check", file.name], cwd=room, env=environment(room), text=True,
                               capture_output=True)
        if check.returncode != 0:
            yield f"{name}:{block.line}: this recipe is wrong:\n{check.stderr}"


def pattern_of(line, any_numbers):
    """What a printed line must match: … stands for anything, spaces for any number of them."""
    pattern = ".*".join(re.escape(part) for part in " ".join(line.split()).split("…"))
    return re.compile(re.sub(r"\d+(\\\.\d+)?", r"[\\d.]+(e-?\\d+)?", pattern) if any_numbers else pattern)


def missing_line(lines, output, any_numbers):
    """The first of the lines that does not follow in the output."""
    printed = iter(" ".join(line.split()) for line in output.splitlines())
    for line in lines:
        pattern = pattern_of(line, any_numbers)
        if line.strip() and not any(pattern.fullmatch(candidate) for candidate in printed):
            return line
    return None


def output_findings(page, name, outputs):
    """A block after `<!-- output -->` shows lines of what the commands before it print."""
    ran = None
    for index, block in enumerate(page.blocks):
        if (outputs / str(index)).exists():
            ran = (outputs / str(index)).read_text()
        elif block.remark in ("output", "output, other numbers"):
            missing = missing_line(block.lines, ran or "", block.remark != "output")
            if missing is not None:
                yield f"{name}:{block.line}: the commands do not print this line: {missing}\nThey print:\n{ran}"


def quote_findings(page, name, repository):
    """A block after `<!-- from: FILE -->` is a part of that file of the repository; `<!-- all of: FILE -->`: the whole."""
    for block in page.blocks:
        if block.remark.startswith("all of:"):
            file = block.remark.removeprefix("all of:").strip()
            if block.text != (repository / file).read_text():
                yield f"{name}:{block.line}: this is not all of {file}"
        if block.remark.startswith("from:"):
            file = block.remark.removeprefix("from:").strip()
            if block.text not in (repository / file).read_text():
                yield f"{name}:{block.line}: this is not what {file} holds"


def language_findings(page, name):
    """Commands in a block of another language would not be run."""
    for block in page.blocks:
        if block.language not in LANGUAGES:
            yield f"{name}:{block.line}: a block of '{block.language}'; known are {', '.join(sorted(LANGUAGES - {''}))}"


def run(foam, repository, path):
    name = str(path.relative_to(repository))
    page = markdown.read(path)
    if wrong := list(python_findings(page, name)):
        print("\n".join(wrong))
        return 1
    with tempfile.TemporaryDirectory() as folder:
        room, outputs = pathlib.Path(folder, "room"), pathlib.Path(folder, "outputs")
        room.mkdir()
        outputs.mkdir()
        furnish(room, foam, repository, page)
        shell = subprocess.run(["bash", "-c", script_of(page, name, outputs)], cwd=room, env=environment(room),
                               stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        findings = [shell.stderr] if shell.returncode else []
        if findings:
            last = max(outputs.iterdir(), key=lambda file: int(file.name))
            findings.append(last.read_text())
        else:
            findings += output_findings(page, name, outputs)
        findings += recipes_findings(page, name, room)
        findings += quote_findings(page, name, repository)
        findings += language_findings(page, name)
    print("\n".join(findings) or f"{name}: as written")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()))
