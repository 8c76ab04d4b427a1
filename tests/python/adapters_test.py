"""Objects of other packages, pictures, and stages that are functions of Python."""
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import foam
from shapes import box, wavy

HERE = Path(__file__).parent
PANDA = Path(os.environ["FOAM_TEST_SOURCE"]) / "configs/robots/panda/panda.urdf"
pytestmark = pytest.mark.filterwarnings("ignore:.*(fit small links loosely|no <inertial>)")


@pytest.fixture(scope="module")
def panda():
    return foam.load(PANDA)


@pytest.fixture(scope="module")
def model(panda):
    return panda.spherize(22, effort="fast")


@pytest.fixture
def part(tmp_path):
    return foam.Mesh(*box()).export(tmp_path / "part.stl")


def test_curobo_gets_a_whole_robot_file(model):
    pytest.importorskip("yaml")
    robot = model.to_curobo(tool_frames=["panda_hand"], lock_joints={"panda_finger_joint1": 0.04})
    text = str(robot)
    assert "panda_hand" in text and "self_collision_ignore" in text and "panda_finger_joint1" in text
    found = []

    def look(value):
        if isinstance(value, dict):
            if set(value) == {"center", "radius"}:
                found.append([*value["center"], value["radius"]])
            for one in value.values():
                look(one)
        elif isinstance(value, list):
            for one in value:
                look(one)

    look(robot)
    assert np.array_equal(np.array(found), np.concatenate(list(model.values())))


def test_pyroki_and_vamp(model):
    spheres = model.to_pyroki()
    assert list(spheres) == list(model) and np.array_equal(spheres["panda_hand"]["centers"], model["panda_hand"].centers)
    files = model.to_vamp(tool_frames=["panda_hand"], lock_joints={"panda_finger_joint1": 0.04})
    assert sorted(Path(name).suffix for name in files) == [".json", ".srdf", ".urdf"]


def test_an_mjcf_text_without_a_spec(model):
    assert model.to_mujoco().startswith("<") and "mujoco" in model.to_mujoco()


def test_meshes_of_other_packages(part):
    vertices, faces = box()

    class PolyData:  # PyVista
        points = vertices
        faces = np.concatenate([np.full((12, 1), 3), box()[1]], axis=1).ravel()

    assert foam.spherize(PolyData(), 3) == foam.spherize((vertices, faces), 3)
    PolyData.faces = np.array([4, 0, 1, 2, 3])
    with pytest.raises(foam.InputError, match="triangulate"):
        foam.spherize(PolyData(), 3)
    if "trimesh" not in sys.modules:
        code = ("import foam, trimesh; mesh = foam.read_mesh(__import__('sys').argv[1]); t = mesh.to_trimesh()\n"
                "assert type(t) is trimesh.Trimesh and foam.from_trimesh(t) == mesh\n"
                "assert foam.from_trimesh(trimesh.Scene([t])).volume == mesh.volume\n"
                "cover = foam.spherize(mesh, 3); assert len(cover.to_trimesh().faces) == 128 * len(cover)\n"
                "ball = 4 / 3 * 3.14159 * cover.radii**3; assert 0.9 < cover.to_trimesh().volume / ball.sum() < 1")
        path = os.pathsep.join([os.environ["PYTHONPATH"], str(HERE / "standins")])
        subprocess.run([sys.executable, "-c", code, part], check=True, env=os.environ | {"PYTHONPATH": path})


def test_what_is_not_installed_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(foam.UsageError, match="pip install trimesh"):
        foam.Mesh(*box()).to_trimesh()


def test_jupyter_shows_a_table_and_a_picture(model, tmp_path):
    page = model._repr_html_()
    assert "panda_link5" in page and "data:image/png;base64," in page and "proved" in page
    assert model.picture(64, 48).startswith(b"\x89PNG")
    assert foam.SphereModel({"<b>": [[0, 0, 0, 1]]})._repr_html_().count("&lt;b&gt;") == 1
    report = model.show(browse=False)
    assert report.name == "report.html" and "panda_link5" in report.read_text()
    again = foam.SphereModel(dict(model), model.robot).show(tmp_path / "model.html", browse=False)
    assert "data:image/png" in again.read_text()


def test_a_function_is_a_spherizer(part):
    seen = []

    @foam.spherizer("spherize.mine", original_only=True)
    def mine(shape, budget, margin=0.0, label="x"):
        """One ball around the middle."""
        seen.append((shape.name, budget.max_spheres, budget.guarantee, margin, label))
        middle = shape.original.bounds.mean(axis=0)
        return [[*middle, np.linalg.norm(shape.vertices - middle, axis=1).max() / 2 + margin]]  # foam grows it

    assert foam.describe("spherize.mine")["summary"] == "One ball around the middle."
    model = foam.load(part).spherize(4, method="mine", set={"stages.spherize.mine.margin": 0.001})
    assert model.count >= 1 and model.certified
    assert ("part", "outer", 0.001, "x") in [(name, guarantee, m, label) for name, _, guarantee, m, label in seen]
    recipe = {"foam": 1, "mesh": [part], "stages": [{"spherize.mine": {}}], "budget": {"spheres": 1}}
    assert foam.run(recipe).model["part"].radii[0] == pytest.approx(np.linalg.norm([0.03, 0.02, 0.1]), rel=1e-3)

    calls = []

    @foam.spherizer("spherize.mine")
    def better(shape, budget):
        calls.append(shape.name)
        return foam.spherize(shape.original, budget.max_spheres or 2).spheres

    assert foam.run(recipe).certified and calls  # the new one, not the cache's


def test_errors_of_a_function_name_the_stage_and_the_line(part):
    @foam.spherizer("spherize.broken")
    def broken(shape, budget):
        raise KeyError("nothing here")

    @foam.spherizer("spherize.many")
    def many(shape, budget):
        return np.ones((9, 4))

    for method, words in (("broken", "nothing here.*adapters_test.py"), ("many", "9 spheres, but the budget is")):
        with pytest.raises(foam.Error, match=f"(?s)spherize.{method}.*{words}"):
            foam.load(part).spherize(2, method=method)


def test_names_and_parameters_of_functions_are_checked():
    for name, words in (("mine", "'spherize.'"), ("spherize.cover", "a stage of the plugin"), ("spherize.A", "a-z")):
        with pytest.raises(foam.UsageError, match=words):
            foam.spherizer(name)(lambda shape, budget: None)
    with pytest.raises(foam.UsageError, match="'x' needs a default"):
        foam.spherizer("spherize.x")(lambda shape, budget, x: None)
    with pytest.raises(foam.UsageError, match=r"\(shape, budget\)"):
        foam.spherizer("spherize.x")(lambda: None)


def test_a_function_serves_many_links(panda):
    @foam.spherizer("spherize.bounding")
    def bounding(shape, budget):
        cover = foam.spherize(shape.original, 1, effort="fast")  # foam calls foam
        return cover.spheres

    model = panda.spherize(method="bounding")
    assert model.count == len(panda.links_with_geometry) and model.certified
