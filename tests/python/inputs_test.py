"""What foam takes from other packages: each kind of object is accepted, with the geometry that it has, or refused with a remedy.

Cases of packages that are not installed are skipped; with FOAM_TEST_ALL_PACKAGES=1, as in the weekly tests, they fail.
"""

import importlib
import os
import pickle
import warnings

import numpy as np
import pytest

import foam
from shapes import box

VOLUME = 0.06 * 0.04 * 0.2
URDF = """<robot name="arm"><link name="base"><collision><geometry><mesh filename="box.stl"/></geometry></collision></link>
<link name="tip"><collision><origin xyz="0 0 0.3333333333333333"/><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="turn" type="fixed"><parent link="base"/><child link="tip"/></joint></robot>"""
MJCF = """<mujoco><asset><mesh name="box" file="box.stl"/></asset><worldbody><body name="base"><geom type="mesh" mesh="box"/>
<body name="tip"><joint axis="0 0 1"/><geom type="sphere" size="0.05" pos="0 0 0.3333333333333333"/></body></body></worldbody></mujoco>"""
pytestmark = pytest.mark.filterwarnings("ignore:.*no <inertial>")


def package(name):
    if os.environ.get("FOAM_TEST_ALL_PACKAGES"):
        return importlib.import_module(name)
    return pytest.importorskip(name)


def points():
    return np.random.default_rng(0).uniform(-0.1, 0.1, (40, 3))


def trimesh_in_millimetres():
    vertices, faces = box()
    mesh = package("trimesh").Trimesh(vertices * 1000, faces, process=False)
    mesh.units = "mm"
    return mesh


def trimesh_scene():
    trimesh = package("trimesh")
    turn = np.eye(4)
    turn[:3, 3] = 10, 0, 0
    scene = trimesh.Scene()
    scene.add_geometry(trimesh_in_millimetres(), transform=turn)
    scene.units = "mm"
    return scene


def open3d_legacy():
    o3d = package("open3d")
    return o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(box()[0]), o3d.utility.Vector3iVector(box()[1]))


def open3d_tensor():
    o3d = package("open3d")
    return o3d.t.geometry.TriangleMesh(o3d.core.Tensor(box()[0]), o3d.core.Tensor(box()[1]))


def pyvista_mesh():
    vertices, faces = box()
    return package("pyvista").PolyData(vertices, np.column_stack([np.full(len(faces), 3), faces]).ravel())


def manifold_mesh():
    m = package("manifold3d")
    return m.Manifold(m.Mesh64(np.array(box()[0]), np.array(box()[1], dtype=np.uint64)))


MESHES = {
    "arrays": box,
    "foam": lambda: foam.Mesh(*box()),
    "trimesh": lambda: package("trimesh").Trimesh(*box(), process=False),
    "trimesh in mm": trimesh_in_millimetres,
    "trimesh scene": trimesh_scene,
    "open3d": open3d_legacy,
    "open3d tensor": open3d_tensor,
    "pyvista": pyvista_mesh,
    "manifold3d": manifold_mesh,
    "manifold3d mesh": lambda: manifold_mesh().to_mesh64(),
    "coacd": lambda: package("coacd").Mesh(*box()),
}


def open3d_points():
    o3d = package("open3d")
    return o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points()))


CLOUDS = {
    "trimesh": lambda: package("trimesh").PointCloud(points()),
    "open3d": open3d_points,
    "open3d tensor": lambda: package("open3d").t.geometry.PointCloud(package("open3d").core.Tensor(points())),
    "pyvista": lambda: package("pyvista").PolyData(points()),
}


def spec_with_assets():
    with open("box.stl", "rb") as file:
        return package("mujoco").MjSpec.from_string(MJCF, assets={"box.stl": file.read()})


def spec_of_file():
    with open("arm.xml", "w") as file:
        file.write(MJCF)
    return package("mujoco").MjSpec.from_file(os.path.abspath("arm.xml"))


def yourdfpy_robot():
    with open("arm.urdf", "w") as file:
        file.write(URDF)
    return package("yourdfpy").URDF.load("arm.urdf")


ROBOTS = {
    "URDF text": lambda: URDF,
    "URDF bytes": lambda: URDF.encode(),
    "MjSpec": spec_with_assets,
    "MjSpec of a file": spec_of_file,
    "yourdfpy": yourdfpy_robot,
}


def polygons():
    return package("pyvista").PolyData(box()[0], np.array([4, 0, 1, 3, 2]))


def unknown_units():
    mesh = trimesh_in_millimetres()
    mesh.units = "wide"
    return mesh


def broken_spec():
    spec = package("mujoco").MjSpec()
    spec.worldbody.add_body(name="empty").add_joint()
    return spec


REFUSED = {
    "a number": (lambda: 3, "remedy: a path, .*or a mesh of foam"),
    "nothing": (lambda: None, "remedy: a path"),
    "points without radii": (points, "points need radii="),
    "parts of coacd": (lambda: [list(box())] * 3, "list of 3 meshes; remedy: one of them"),
    "two parts of coacd": (lambda: [list(box())] * 2, "list of 2 meshes"),
    "a path of trimesh": (lambda: package("trimesh").load_path(points()), "no mesh"),
    "trimesh in unknown units": (unknown_units, "its units are 'wide'.*remedy: mesh.units = 'mm'"),
    "lines of Open3D": (lambda: package("open3d").geometry.LineSet(), "no mesh"),
    "lines of Open3D's tensors": (lambda: package("open3d").t.geometry.LineSet(), "no mesh"),
    "an empty tensor mesh": (lambda: package("open3d").t.geometry.TriangleMesh(), "it has no positions"),
    "polygons of PyVista": (polygons, r"remedy: mesh.triangulate\(\)"),
    "cells of PyVista": (lambda: package("pyvista").ImageData(dimensions=(2, 2, 2)), r"extract_surface\(\)"),
    "a spec": (spec_of_file, r"remedy: foam.load\(.*\).cover"),
    "yourdfpy": (yourdfpy_robot, r"remedy: foam.load\(.*\).cover"),
}


@pytest.fixture(autouse=True)
def room(tmp_path, monkeypatch):
    foam.Mesh(*box()).export(tmp_path / "box.stl")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", MESHES)
def test_meshes_are_covered_loaded_and_judged(name):
    mesh = MESHES[name]()
    cover = foam.cover(mesh, 4, "capsule", effort="fast")
    assert cover.certified and cover.certificate.holds and foam.certify(mesh, cover).holds
    shift = [0.01, 0, 0] if name == "trimesh scene" else [0, 0, 0]
    assert np.allclose(foam.Mesh(*_arrays(mesh)).bounds - shift, foam.Mesh(*box()).bounds, rtol=0, atol=1e-7)
    robot = foam.load(mesh)
    assert robot.links == ["mesh"] and robot.collision_mesh("mesh").volume == pytest.approx(VOLUME, rel=1e-6)
    model = robot.cover(3, effort="fast")
    figures = foam.evaluate(mesh, model)
    assert figures.certified and figures.total.volume_m3 == pytest.approx(VOLUME, rel=1e-4)
    assert foam.compare(mesh, {"spheres": model, "capsules": cover})["capsules"].total.spheres == len(cover)
    assert pickle.loads(pickle.dumps(robot)).collision_mesh("mesh") == robot.collision_mesh("mesh")


def _arrays(mesh):
    """The arrays that foam took: those of its link."""
    taken = foam.load(mesh).collision_mesh("mesh")
    return taken.vertices, taken.faces


@pytest.mark.parametrize("name", CLOUDS)
def test_point_clouds_go_to_points(name):
    cloud = CLOUDS[name]()
    wide = foam.cover(cloud, 4, radii=0.01, effort="fast")
    assert wide == foam.cover(points(), 4, radii=0.01, effort="fast") and wide.certificate.holds
    tight = foam.cover(cloud, 4, "box", effort="fast")
    assert tight == foam.cover(points(), 4, "box", radii=0, effort="fast") and tight.certificate.holds
    assert foam.certify(cloud, tight).holds and foam.certify(foam.load(cloud, radii=0.01), wide).holds
    assert not foam.certify(foam.load(cloud, radii=0.02), wide).holds


@pytest.mark.parametrize("name", ROBOTS)
def test_robots_in_memory_are_loaded_and_judged(name):
    thing = ROBOTS[name]()
    robot = foam.load(thing)
    os.remove("box.stl")  # what load() read is what is used
    assert robot.links_with_geometry == ["base", "tip"]
    volumes = [robot.collision_mesh(link).volume for link in robot.links_with_geometry]
    assert volumes == pytest.approx([VOLUME, 4 / 3 * np.pi * 0.05**3], rel=1e-5)
    middle = robot.collision_mesh("tip").bounds.mean(axis=0)
    assert np.allclose(middle, [0, 0, 1 / 3], rtol=0, atol=1e-12), "all digits count"
    model = robot.cover(6, ["capsule", "box"], effort="fast")
    assert model.certified and foam.certify(robot, model).holds and model.certificate.holds
    assert foam.certify(robot, model.save(f"again{robot.file.suffix}")[0]).holds
    foam.Mesh(*box()).export("box.stl")
    assert foam.evaluate(thing, model).certified and foam.compare(thing, [model])["A"].certified


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused_names_a_remedy(name):
    make, words = REFUSED[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        thing = make()
    with pytest.raises(foam.Error, match=f"(?s){words}"):
        foam.cover(thing, 3)


def test_specs_that_do_not_compile_are_refused():
    with pytest.raises(foam.UsageError, match="(?s)the MjSpec does not compile: .*remedy"):
        foam.load(broken_spec())


def test_what_is_in_memory_is_in_metres():
    with pytest.raises(foam.UsageError, match="unit, scale: they are of mesh files"):
        foam.load(box(), unit="mm")


def test_mujoco_writes_as_many_digits_as_before():
    mujoco = package("mujoco")
    spec = mujoco.MjSpec.from_string(MJCF, assets={"box.stl": open("box.stl", "rb").read()})
    spec.compile()
    before = spec.to_xml()
    foam.load(spec)
    assert spec.to_xml() == before and '0.333333"' in before
