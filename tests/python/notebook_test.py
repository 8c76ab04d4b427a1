"""The cells of the notebook run, one after the other, and end in what Jupyter shows."""
import ast
import json
import os
import shutil
from pathlib import Path

import pytest

ROOT = Path(os.environ["FOAM_TEST_SOURCE"])


@pytest.mark.filterwarnings("ignore:.*fit small links loosely")
def test_the_notebook(tmp_path, monkeypatch):
    for file in (ROOT / "tests/docs/room").iterdir():
        shutil.copy(file, tmp_path)
    monkeypatch.chdir(tmp_path)
    notebook = json.loads((ROOT / "docs/examples/python/robot.ipynb").read_text())
    space, shown = {}, []
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == []
            tree = ast.parse("".join(cell["source"]))
            last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
            exec(compile(tree, "notebook", "exec"), space)
            if last is not None:
                shown.append(eval(compile(ast.Expression(last.value), "notebook", "eval"), space))
    assert "<table>" in shown[1]._repr_html_() and (tmp_path / "robot_spheres.urdf").exists()
