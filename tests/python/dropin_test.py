"""Programs for the Python foam of Coumar et al. 2025 run with this package: its names, scripts, files and habits."""
import copy
import json
import os
import pickle
import subprocess
import sys
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

import foam
from shapes import box, uncovered, wavy

HERE = Path(__file__).parent
PANDA = Path(os.environ["FOAM_TEST_SOURCE"]) / "configs/robots/panda/panda.urdf"
SCRIPTS = Path(foam.__file__).parent.parent / "bin"

URDF = """<?xml version="1.0"?>
<robot name="two"><!-- a comment -->
  <link name="base">
    <visual><geometry><box size="1 1 1"/></geometry></visual>
    <collision><origin xyz="0.1 0 0" rpy="0 0 1.5"/><geometry><mesh filename="box.stl" scale="2 1 1"/></geometry></collision>
    <collision><geometry><mesh filename="box.stl"/></geometry></collision>
  </link>
  <joint name="j" type="fixed"><parent link="base"/><child link="hand"/></joint>
  <link name="hand">
    <collision><origin xyz="0 0 0.5"/><geometry><sphere radius="0.1"/></geometry></collision>
    <collision><geometry><cylinder radius="0.1" length="0.4"/></geometry></collision>
    <collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
  </link>
</robot>"""


@pytest.fixture
def two(tmp_path):
    foam.Mesh(*box()).export(tmp_path / "box.stl")
    (tmp_path / "two.urdf").write_text(URDF)
    return tmp_path / "two.urdf"


def script(name, *arguments, cwd, code=0):
    ran = subprocess.run([sys.executable, SCRIPTS / name, *map(str, arguments)], cwd=cwd, capture_output=True, text=True)
    assert ran.returncode == code, ran.stdout + ran.stderr
    return ran.stdout + ran.stderr


def test_the_script_with_the_flags_of_published_builds(tmp_path):
    said = script("foam-generate-sphere-urdf", PANDA, "--output", "out.urdf", "--database", "db.json", "--depth", 1, "--branch",
                  8, "--threads", 16, "--method", "medial", "--verify", "False", "--shrinkage", 1.0, "--panda_hand", 2, cwd=tmp_path)
    robot = foam.load(PANDA)
    model = foam.read_spheres(tmp_path / "out.urdf", robot=robot)
    assert list(model) == robot.links_with_geometry and 8 < len(model["panda_hand"]) <= 16
    assert max(len(rows) for link, rows in model.items() if link != "panda_hand") <= 8
    assert foam.certify(robot, model).holds and f"Number of spheres: {model.count}" in said
    # A second run takes what the database has, and changes nothing.
    before = (tmp_path / "db.json").read_bytes()
    script("foam-generate-sphere-urdf", PANDA, "--output=again.urdf", "--database=db.json", "--panda-hand", 2, cwd=tmp_path)
    assert (tmp_path / "again.urdf").read_bytes() == (tmp_path / "out.urdf").read_bytes()
    assert (tmp_path / "db.json").read_bytes() == before


@pytest.mark.parametrize("flags, words", [
    (["--sphere-database", "x.json"], "did you mean --database"), (["--panda_hnd", 2], "did you mean --panda_hand"),
    (["--panda_hand", "much"], "a number above 0"), (["a", "b", 1, 8, "octopus"], "unknown method 'octopus'"),
    (["none.urdf"], "none.urdf: there is no such file")])
def test_wrong_flags_are_errors(tmp_path, flags, words):
    said = script("foam-generate-sphere-urdf", *([] if flags[0] == "none.urdf" else [PANDA]), *flags, cwd=tmp_path,
                  code=1 if flags[0] == "none.urdf" else 2)
    assert words in said and not (tmp_path / "spherized.urdf").exists()


def test_the_script_for_a_mesh(tmp_path):
    foam.Mesh(*box()).export(tmp_path / "part.stl")
    script("foam-generate-spheres", "part.stl", "--depth", 2, "--branch", 3, "--scale", 2.0, cwd=tmp_path)
    levels = json.loads((tmp_path / "part-spheres.json").read_text())
    assert [len(level["spheres"]) <= most for level, most in zip(levels, (1, 3, 9))] == [True] * 3
    assert set(levels[0]) == {"mean", "best", "worst", "spheres"} and set(levels[0]["spheres"][0]) == {"origin", "radius"}
    vertices = 2 * box()[0]
    for level in levels:
        spheres = np.array([[*one["origin"], one["radius"]] for one in level["spheres"]])
        assert len(uncovered(vertices, spheres * [1, 1, 1, 1 + 1e-6])) == 0


def test_a_wrapper_around_the_helper(two, tmp_path):
    """The order of calls and arguments in published wrappers and optimisers over budgets."""
    helper = foam.SpherizationHelper(tmp_path / "db.json", 4)
    urdf = foam.load_urdf(Path(two))
    meshes = foam.get_urdf_meshes(urdf, 1.0)
    assert [mesh.name for mesh in meshes] == ["base::box.stl", "base::box.stl#2"]
    for budget in (2, 4):
        for mesh in meshes:
            helper.spherize_mesh(mesh.name, mesh.mesh, mesh.scale, mesh.xyz, "grid", mesh.rpy, depth=1, branch=budget,
                                 manifold_leaves=100, simplification_ratio=0.5)
    found = {mesh.name: helper.get_spherization(mesh.name, 1, 4) for mesh in meshes}
    for one in found.values():
        assert 1 <= len(one) <= 4 and one.spheres[0].radius > 0 and isinstance(one.spheres[0].origin[0], float)
        assert one.best_error <= one.mean_error <= one.worst_error
    changed = copy.deepcopy(urdf)
    foam.set_urdf_spheres(changed, found)
    assert sum("sphere" in c["geometry"] for c in changed["robot"]["link"][0]["collision"]) == sum(map(len, found.values()))
    assert "sphere" not in str(urdf["robot"]["link"][0])
    xmltodict = pytest.importorskip("xmltodict")
    assert xmltodict.unparse(changed).count("<sphere ") == sum(map(len, found.values())) + 1
    foam.save_urdf(changed, tmp_path / "out.urdf")
    assert "@path" not in (tmp_path / "out.urdf").read_text() and "path=" not in (tmp_path / "out.urdf").read_text()
    assert len(list(foam.get_urdf_spheres(foam.load_urdf(tmp_path / "out.urdf")))) == sum(map(len, found.values())) + 1
    # Scale first, then the pose: the corners of the mesh lie in the spheres.
    x, y, z = box()[0].T
    corners = np.stack([2 * np.cos(1.5) * x - np.sin(1.5) * y + 0.1, 2 * np.sin(1.5) * x + np.cos(1.5) * y, z], axis=1)
    rows = np.array([[*one.origin, one.radius * (1 + 1e-6)] for one in found["base::box.stl"].spheres])
    assert len(uncovered(corners, rows)) == 0


def test_a_result_is_found_by_its_name_whatever_its_budget(two, tmp_path):
    """The original's script asks for `branch` where it has started a smaller budget, also of 0."""
    helper = foam.SpherizationHelper(tmp_path / "db.json")
    (mesh, *_) = foam.get_urdf_meshes(foam.load_urdf(two))
    for budget in (0, 3):
        helper.spherize_mesh(mesh.name, mesh.mesh, mesh.scale, mesh.xyz, "octree", mesh.rpy, depth=1, branch=budget)
    assert 1 <= len(helper.get_spherization(mesh.name, 1, 8)) <= 3
    assert helper.db.exists(mesh.name, 8, 0) and helper.db.exists(mesh.name, 8, 1)
    with pytest.raises(foam.Error, match="other: there is no spherization of branch 8 and depth 1"):
        helper.get_spherization("other")


def test_an_older_order_of_arguments_is_explained(tmp_path):
    helper = foam.SpherizationHelper(tmp_path / "db.json")
    with pytest.raises(foam.UsageError, match="`method` stands before `orientation`"):
        helper.spherize_mesh("a", foam.Mesh(*box()), np.ones(3), np.zeros(3), np.zeros(3), 1, 8)
    levels = foam.spherize_mesh(foam.Mesh(*box()), np.ones(3), spherization_kwargs={"method": "octree", "branch": 5})
    assert [len(level) <= most for level, most in zip(levels, (1, 5))] == [True, True]
    with pytest.raises(foam.UsageError, match="needs 'method'"):
        foam.spherize_mesh("a", foam.Mesh(*box()))


def test_meshes_are_those_of_trimesh_where_it_is_there(two):
    code = """
import sys
from foam import *
from trimesh.nsphere import minimum_nsphere
urdf = load_urdf(Path(sys.argv[1]))
for mesh in get_urdf_meshes(urdf) + get_urdf_primitives(urdf):
    assert type(mesh.mesh) is Trimesh and Trimesh.__module__ == "trimesh"
    center, radius = minimum_nsphere(mesh.mesh.vertices)
    ratio = 4 / 3 * np.pi * radius**3 / mesh.mesh.volume
    assert 1 < ratio < 100, ratio
levels = spherize_mesh(mesh.name, as_mesh(Scene([mesh.mesh, mesh.mesh.copy()])), spherization_kwargs={"method": "medial", "depth": 1})
print(len(levels), levels[1].certified, len(smooth_manifold(mesh.mesh).vertices) > 3, isinstance(simplify(mesh.mesh, 0.5), Trimesh))
"""
    path = os.pathsep.join([os.environ["PYTHONPATH"], str(HERE / "standins")])
    said = subprocess.run([sys.executable, "-c", code, two], capture_output=True, text=True, env=os.environ | {"PYTHONPATH": path})
    assert said.stdout == "2 True True True\n", said.stderr


def test_names_can_be_patched_where_they_were():
    with patch("foam.manifold") as stand_in:
        foam.manifold("a")
        stand_in.assert_called_once_with("a")
    for name in ("foam.model.Sphere", "foam.utility.load_urdf", "foam.external.compute_spheres", "foam.simplify_manifold"):
        with patch(name):
            pass


def test_star_import_gives_what_scripts_lean_on():
    space = {}
    exec("from foam import *", space)
    for name in ("Path", "np", "NDArray", "Scene", "Trimesh", "Any", "Sphere", "SphereEncoder", "ParallelSpherizer", "tempmesh"):
        assert name in space
    assert space["np"] is np and space["Path"] is Path


def test_primitives_stay_at_their_origins_and_are_enclosed(two):
    sphere, cylinder, cuboid = foam.get_urdf_primitives(foam.load_urdf(two))
    assert [one.name for one in (sphere, cylinder, cuboid)] == [f"hand::primitive{i}" for i in range(3)]
    assert np.array_equal(sphere.xyz, [0, 0, 0.5])
    for part, volume in ((sphere, 4 / 3 * np.pi * 0.001), (cylinder, np.pi * 0.004), (cuboid, 0.006)):
        assert part.mesh.is_watertight and volume <= part.mesh.volume <= 1.05 * volume
    directions = np.random.default_rng(0).normal(size=(500, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    corners = sphere.mesh.vertices[sphere.mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    assert (np.einsum("ij,ij->i", normals, corners[:, 0])[lengths > 1e-12] / lengths[lengths > 1e-12] >= 0.1 - 1e-12).all()


def test_trees_are_those_of_xmltodict(two):
    xmltodict = pytest.importorskip("xmltodict")
    for file in (two, PANDA):
        ours, theirs = foam.load_urdf(file), xmltodict.parse(file.read_bytes())
        assert ours["robot"].pop("@path") == file
        assert ours == json.loads(json.dumps(theirs))
        assert xmltodict.parse(foam.utility._xml.unparse(ours)) == theirs


def test_files_are_read_by_either_side(tmp_path):
    one = foam.Spherization([foam.Sphere(1, 2, 3, 0.5, [1, 0, 0])], 0.1, 0.05, 0.2)
    text = json.dumps({"a": {8: {1: one}}}, cls=foam.SphereEncoder)
    assert json.loads(text) == {"a": {"8": {"1": {"mean": 0.1, "best": 0.05, "worst": 0.2,
                                                  "spheres": [{"origin": [2.0, 2.0, 3.0], "radius": 0.5}]}}}}
    assert json.loads(text, cls=foam.SphereDecoder)["a"]["8"]["1"] == one
    assert pickle.loads(pickle.dumps(one)) == one
    better = foam.Spherization(one.spheres, 0.01, 0.005, 0.02)
    assert better < one and not one < better and not foam.Spherization([], 0.01, 0.2, 0.01) < one
    (tmp_path / "db.json").write_text(text)
    database = foam.SpherizationDatabase(tmp_path / "db.json")
    assert database.get("a", 8, 1) == one and database.exists("a", 8, 1) and not database.exists("a", 8, 2)
    database.add("a", 8, 1, better)
    del database
    assert foam.SpherizationDatabase(tmp_path / "db.json").get("a", 8, 1) == better
    (tmp_path / "bad.json").write_text("[")
    with pytest.raises(foam.InputError, match="bad.json: it is no database"):
        foam.SpherizationDatabase(tmp_path / "bad.json")
    assert (tmp_path / "bad.json").read_text() == "["


def test_files_of_the_sphere_tree_toolkit_are_read(tmp_path):
    (tmp_path / "a.sph").write_text("2 2\n0 0 0 1 0.5\n0 0 1 0.5 0.1\n0 0 0 -1 0\n0.1\n")
    first, second = foam.read_spherization_file(tmp_path / "a.sph", [1, 0, 0])
    assert len(first) == len(second) == 1 and np.array_equal(second.spheres[0].origin, [1, 0, 1])
    (tmp_path / "b.sph").write_text("9 9\n")
    with pytest.raises(foam.InputError, match="b.sph"):
        foam.read_spherization_file(tmp_path / "b.sph")


def test_every_method_gives_certified_levels():
    mesh = foam.Mesh(*wavy(400))
    for method in ("medial", "grid", "octree", "hubbard", "spawn", "cover", "voxel"):
        levels = foam.compute_spheres(mesh, 1, 6, method)
        assert [one.certified for one in levels] == [True, True], method
        assert len(levels[0]) == 1 and 1 <= len(levels[1]) <= 6, method
    assert len(foam.compute_spheres(mesh, 2, 3)) == 3


def test_errors_name_link_and_file(two):
    two.write_text(URDF.replace("box.stl", "none.stl"))
    with pytest.raises(RuntimeError, match="link 'base': the mesh none.stl is not found"):
        foam.get_urdf_meshes(foam.load_urdf(two))
    two.write_text("<robot><link></robot>")
    with pytest.raises(foam.InputError, match=r"two.urdf:1:\d+: XML: mismatched tag"):
        foam.load_urdf(two)
    with pytest.raises(RuntimeError, match="Failed to process a:"):
        foam.spherize_mesh("a", (np.zeros((3, 3)), np.zeros((0, 3), int)), spherization_kwargs={"method": "medial"})
    urdf = {"robot": {"link": {"@name": "a"}}}
    with pytest.raises(foam.Error, match="b::x: no <collision>"):
        foam.set_urdf_spheres(urdf, {"b::x": foam.Spherization([], 0, 0, 0)})
