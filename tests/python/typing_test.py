"""Annotations: mypy and pyright see the types of the package in a program, and find nothing in the package and in the guide."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(os.environ["FOAM_TEST_SOURCE"])
PACKAGE = SOURCE / "python"
MYPY = "/usr/bin/mypy"  # that of the Python whose NumPy has the annotations
#: Of a Python with packages of PyPI; mypy is for the other.
PYRIGHT = importlib.util.find_spec("pyright") is not None

MISSPELT = [
    "foam.spherise('part.stl', 3)",
    "foam.cover('part.stl', 3).sphere",
    "foam.cover('part.stl', 3, efort='fast')",
    "foam.cover('part.stl', 3, effort='fsat')",
    "foam.cover('part.stl', 3, 'capsul')",
    "foam.cover('part.stl', 3, ['box', 'capsul'])",
    "foam.cover('part.stl', 3, objective='exces')",
    "foam.cover('part.stl', 3)[0]['positon']",
    "foam.cover('part.stl', 3).certificate.hold",
    "foam.load('a.urdf').cover(3, effort='slow')",
    "foam.load('a.urdf').spherize(3).total.exces",
    "foam.load('a.urdf').approximate(3, 'bok')",
    "foam.load('a.urdf', geometry='visul')",
    "foam.load('a.urdf').cover(3)['base'].sphere",
    "foam.evaluate('a.urdf', 'b.urdf').links['base'].gap",
    "foam.certify('a.urdf', 'b.urdf', guarantee='both')",
    "foam.compare('a.urdf', ['b.urdf'])['A'].totl",
    "foam.self_collision('a.urdf').pairs[0]['link']",
    "foam.run('recipe.yaml').modl",
]


def by_mypy(folder):
    """The lines of the programs of a folder with errors, and what mypy says of them and of the package."""
    if not os.path.exists(MYPY):
        pytest.skip("no mypy")
    names = sorted(file.name for file in folder.glob("*.py"))
    command = [MYPY, "--strict", "--no-error-summary", "--show-error-codes", "--cache-dir", "/dev/null", *names]
    ran = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, env=os.environ | {"MYPYPATH": str(PACKAGE)}
    )
    assert ran.returncode in (0, 1), ran.stderr
    elsewhere = [
        line for line in ran.stdout.splitlines() if ": error: " in line and line.partition(":")[0] not in names
    ]
    assert not elsewhere, elsewhere
    return {(name, int(line)) for name, line in re.findall(r"^(\w+\.py):(\d+): error", ran.stdout, re.M)}, ran.stdout


def by_pyright(folder):
    (folder / "pyrightconfig.json").write_text(json.dumps({"extraPaths": [str(PACKAGE)]}))
    command = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable]
    ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ | {"PYTHONPATH": ""})
    if ran.returncode not in (0, 1):
        pytest.skip(f"pyright does not run: {ran.stderr}")
    found = json.loads(ran.stdout)["generalDiagnostics"]
    errors = [one for one in found if one["severity"] == "error"]
    return {(Path(one["file"]).name, one["range"]["start"]["line"] + 1) for one in errors}, json.dumps(found, indent=1)


CHECKERS = pytest.mark.parametrize("check", [by_pyright if PYRIGHT else by_mypy])


@CHECKERS
def test_a_program_sees_the_types(tmp_path, check):
    file = tmp_path / "program.py"
    file.write_text(
        "import foam\n"
        "cover = foam.cover('part.stl', 16)\n"
        "reveal_type(cover.spheres)\n"
        "reveal_type(foam.evaluate('a.urdf', 'b.urdf').total.excess)\n"
        "reveal_type(foam.load('a.urdf').spherize(3))\n"
        "foam.spherize('part.stl', '16')\n"
        "for element in cover:\n"
        "    if element['kind'] == 'capsule':\n"
        "        reveal_type(element['length'])\n"
    )
    lines, said = check(tmp_path)
    assert lines == {("program.py", 6)}, said
    assert (
        re.search("ndarray|NDArray", said) and said.count("float") >= 2 and "SphereModel" in said and 'Any"' not in said
    )


@CHECKERS
def test_misspelt_words_are_found(tmp_path, check):
    file = tmp_path / "program.py"
    file.write_text("import foam\n" + "".join(f"print({line})\n" for line in MISSPELT))
    lines, said = check(tmp_path)
    assert lines == {("program.py", line) for line in range(2, len(MISSPELT) + 2)}, said


@CHECKERS
def test_nothing_is_found_in_the_guide(tmp_path, check):
    blocks = []
    for page in ("python.md", "elements.md"):
        text = (SOURCE / "docs/guide" / page).read_text("utf-8")
        blocks += re.findall(r"(?<!-->\n)```python\n(.*?)```", text, re.S)
    assert len(blocks) > 8
    for i, block in enumerate(blocks):
        if "def " not in block:  # functions of examples have no annotations
            (tmp_path / f"block_{i}.py").write_text(block, "utf-8")
    lines, said = check(tmp_path)
    assert not lines, said
