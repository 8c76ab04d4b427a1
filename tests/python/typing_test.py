"""Annotations: mypy sees the types of the package in a program, and finds nothing in the package itself."""
import os
import subprocess
from pathlib import Path

import pytest

PACKAGE = Path(os.environ["FOAM_TEST_SOURCE"]) / "python"
MYPY = "/usr/bin/mypy"  # that of the Python whose NumPy has the annotations
pytestmark = pytest.mark.skipif(not os.path.exists(MYPY), reason="no mypy")


def found(*arguments, cwd=PACKAGE, code=0):
    ran = subprocess.run([MYPY, "--strict", "--no-error-summary", "--cache-dir", "/dev/null", *map(str, arguments)],
                         cwd=cwd, capture_output=True, text=True, env=os.environ | {"MYPYPATH": str(PACKAGE)})
    assert ran.returncode == code, ran.stdout + ran.stderr
    return ran.stdout


def test_a_program_sees_the_types(tmp_path):
    (tmp_path / "program.py").write_text(
        "import foam\n"
        "cover = foam.spherize('part.stl', 16)\n"
        "reveal_type(cover.spheres)\n"
        "reveal_type(foam.evaluate('a.urdf', 'b.urdf').total.excess)\n"
        "foam.spherize('part.stl', '16')\n")
    said = found("program.py", cwd=tmp_path, code=1)  # and what it finds in the package
    assert "numpy.ndarray" in said and '"builtins.float"' in said
    assert said.count("error") == 1 and 'program.py:5: error: Argument 2 to "spherize"' in said
