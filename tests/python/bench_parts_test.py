"""What experiments stand on: growth, sized meshes, measured programs, tables, plots, statistics, scenes."""
import math
import xml.etree.ElementTree as ET

import foam
import numpy as np
import pytest
from foam.bench.engines import Report, answer_table
from foam.bench.experiment import short, table
from foam.bench.folder import Folder
from foam.bench.grasp_scene import GraspObject, Setup, grasp_scene, moving
from foam.bench.growth import fitted_power_law, growth_text
from foam.bench.plots import Panel, Plot, Series, to_svg
from foam.bench.programs import run_measured
from foam.bench.report import to_csv, to_markdown
from foam.bench.sized_mesh import refined, sized
from foam.bench.statistics import compared, mean_of, missed_by
from shapes import box, cylinder


def test_a_power_law_is_found_in_the_upper_decade():
    points = [(n, 3e-6 * n**1.5) for n in (1e3, 1e4, 2e4, 5e4, 1e5)]
    law = fitted_power_law([(10, 100), *points])
    assert law.exponent == pytest.approx(1.5) and law.factor == pytest.approx(3e-6)
    assert (law.low, law.high) == (1e4, 1e5)
    assert growth_text(points) == "n^1.50"


@pytest.mark.parametrize("points", [[], [(1, 1), (2, 2)], [(1, 0), (2, 0), (3, 0)], [(2, 1), (2, 2), (2, 3)]])
def test_no_law_of_too_little(points):
    assert fitted_power_law(points) is None and growth_text(points) == "–"


def test_short_numbers():
    assert [short(x) for x in (0, 0.012345, 1.5, 123.4, 12345.6, 1e-9, -0.5)] == [
        "0.00", "0.0123", "1.50", "123", "12346", "0.000000", "-0.500"]
    assert short(math.nan) == "–"


@pytest.mark.parametrize("count", [300, 1000, 1001, 5000])
def test_refined_meshes_keep_the_surface(count):
    mesh = foam.Mesh(*cylinder(0.1, 0.3))
    fine = refined(mesh, count)
    assert count <= len(fine.faces) <= count + 1
    assert fine.is_watertight
    assert fine.volume == pytest.approx(mesh.volume, rel=1e-12) and fine.area == pytest.approx(mesh.area, rel=1e-12)


def test_refined_meshes_have_no_long_edges_and_near_neighbours():
    fine = refined(foam.Mesh(*cylinder(0.1, 0.3)), 20000)
    corners = fine.vertices[fine.faces]
    assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() < 0.02  # at first 0.3 m
    used, first = np.unique(fine.faces, return_index=True)
    assert (np.diff(first) > 0).all() and len(used) == len(fine.vertices)  # in the order of their first use
    steps = np.linalg.norm(np.diff(corners[:, 0], axis=0), axis=1)
    assert steps.mean() < 0.4 * steps.max()


def test_refined_meshes_keep_holes():
    mesh = foam.Mesh(*cylinder(0.1, 0.3))
    fine = refined(foam.Mesh(mesh.vertices, mesh.faces[:-1]), 3000)
    assert len(fine.faces) >= 3000 and not fine.is_watertight
    assert fine.area == pytest.approx(foam.Mesh(mesh.vertices, mesh.faces[:-1]).area, rel=1e-12)
    assert refined(mesh, 10) is mesh


def test_sized_meshes_go_both_ways():
    fine = sized(foam.Mesh(*cylinder(0.1, 0.3)), 4000)
    assert len(fine.faces) in (4000, 4001)
    coarse = sized(fine, 300)
    assert 290 <= len(coarse.faces) <= 300 and coarse.is_watertight


def test_memory_is_that_of_the_program_not_of_the_one_that_measures(tmp_path):
    held = np.ones(300 << 20, np.int8)  # in the memory of this process
    sleeping = run_measured(["/bin/sleep", "0.2"], 10, tmp_path)
    assert sleeping.exit_code == 0 and not sleeping.over_limit
    assert 100e3 < sleeping.memory < 100e6, held[-1]


def test_a_program_ends_at_its_limit(tmp_path):
    busy = run_measured(["/bin/sh", "-c", "while :; do :; done"], 0.5, tmp_path)
    assert busy.over_limit and busy.cpu_seconds > 0.5


def test_tables():
    rows = table(["name", "by a, b", "n"], [["x|y", 'say "a"', "1"], ["", "", "2"]])
    assert to_csv(rows).decode() == 'name,"by a, b",n\nx|y,"say ""a""",1\n,,2\n'
    assert to_markdown(rows) == '| name | by a, b | n |\n|---|---:|---:|\n| x\\|y | say "a" | 1 |\n|  |  | 2 |\n'


def small_plot():
    lines = [Series("a & b", [(1, 1), (10, 5), (100, 40)]), Series("old", [(1, 100), (100, 300)], True)]
    return Plot('Time <of> "all" & $more$', "triangles", "s",
                [Panel(lines, "one"), Panel([Series("a & b", [(2, 3), (0, 7), (20, -1), (50, math.nan)])], "two")])


def test_plots_are_well_formed_and_the_same_every_time():
    svg = to_svg(small_plot())
    assert svg == to_svg(small_plot())
    texts = [element.text for element in ET.fromstring(svg).iter() if element.text and element.text.strip()]
    for text in ('Time <of> "all" & $more$', "a & b", "old", "one", "two", "triangles", "s", "100"):
        assert text in texts, text
    assert texts.count("a & b") == 1  # in the legend
    for empty in ([], [Panel([Series("nothing", [])])], [Panel([Series("nothing", [(1, 0)])])]):
        ET.fromstring(to_svg(Plot("", "", "", empty)))


def test_a_folder_of_results_is_put_in_place_at_the_end(tmp_path):
    folder = Folder(tmp_path / "out")
    folder.write({"a.csv": b"1", "b.md": b"2"})
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [".foam-run", "a.csv", "b.md"]
    Folder(tmp_path / "out").write({"c.md": b"3"})
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [".foam-run", "c.md"]
    (tmp_path / "out/letter.txt").write_text("dear")
    with pytest.raises(foam.Error, match="letter.txt in it: not written by the run"):
        Folder(tmp_path / "out")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/letter.txt").write_text("dear")
    with pytest.raises(foam.Error, match="no .foam-run in it"):
        Folder(tmp_path / "mine")
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def report_of(*rows):
    """A report of queries, each with (state, hits an obstacle, hits itself) of both models."""
    models = [answer_table([[*row[m], 0.25, 0.5 + m, 2, 3] for row in rows]) for m in (0, 1)]
    return Report("fcl", models=tuple(models))


def test_means_have_errors():
    assert mean_of([]).size == 0 and math.isnan(mean_of([]).value)
    assert mean_of([2]).value == 2 and math.isnan(mean_of([2]).error)
    assert mean_of([1, 1, 0, -1]) == (4, 0.25, pytest.approx(math.sqrt(11 / 48)))


def test_verdicts_are_split():
    report = report_of([(1, 0, 0), (1, 1, 0)], [(1, 0, 0), (1, 1, 1)], [(1, 0, 1), (1, 1, 1)], [(1, 1, 0), (1, 0, 0)],
                       [(1, 1, 1), (2, 0, 0)], [(1, 0, 0), (0, 0, 0)])
    c = compared(report)
    assert (c.queries, c.aborted, c.not_asked) == (4, (0, 1), 1)
    assert c.collides[:4] == (2, 3, 1, 2)
    assert c.hits_obstacle[:4] == (1, 3, 1, 3)
    assert c.hits_itself[:4] == (1, 2, 0, 1)
    assert c.collides.difference == (4, 0.25, pytest.approx(math.sqrt(11 / 48)))
    assert c.collision.original.value == 0.75 and c.collision.difference.value == pytest.approx(1)
    assert c.distance.original.value == 2.25 and c.metres.original.size == 0
    assert missed_by(report, report) == (1, 1, 1, 0)


ROBOT = """<robot name="r"><link name="a"/>
  <link name="b&lt;"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <link name="c"><collision><geometry><mesh filename="part.stl"/></geometry></collision></link>
  <joint name="j" type="revolute"><parent link="a"/><child link="b&lt;"/><origin xyz="1 2 3"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="k" type="fixed"><parent link="b&lt;"/><child link="c"/></joint></robot>"""


def test_a_scene_has_what_the_robot_has(tmp_path):
    foam.Mesh(*box(0.1, 0.2, 0.3)).export(tmp_path / "part.stl")
    (tmp_path / "r.urdf").write_text(ROBOT)
    robot = foam.load(tmp_path / "r.urdf")
    setup = Setup(GraspObject(), [("a", "b<")], ["b<"], [], 0.004)
    assert [joint.name for joint in moving(robot)] == ["j"]
    scene = ET.fromstring(grasp_scene(robot, {}, setup))
    body = scene.find(".//body[@name='b<']")
    assert body.attrib == {"name": "b<", "pos": "1.0 2.0 3.0", "xyaxes": "1.0 0.0 0.0 0.0 1.0 0.0"}
    inertial = body.find("inertial").attrib  # 4 kg; 4 / 12 · (0.2² + 0.1²) and 4 / 12 · (0.2² + 0.2²)
    assert float(inertial["mass"]) == pytest.approx(4)
    assert [float(x) for x in inertial["diaginertia"].split()] == pytest.approx([0.05 / 3, 0.05 / 3, 0.08 / 3])
    assert body.find("geom").attrib == {"type": "box", "size": "0.1 0.1 0.05", "pos": "0.0 0.0 0.0",
                                        "xyaxes": "1.0 0.0 0.0 0.0 1.0 0.0"}
    assert scene.find(".//body[@name='c']/geom").attrib == {"type": "mesh", "mesh": "m0"}
    assert len(scene.find("asset/mesh").get("vertex").split()) == 24
    assert [exclude.attrib for exclude in scene.iter("exclude")] == [
        {"body1": "a", "body2": "b<"}, {"body1": "b<", "body2": "object"}]
    balls = ET.fromstring(grasp_scene(robot, {"b<": np.array([[0, 0, 0.5, 0.25]])}, setup))
    assert balls.find(".//body[@name='b<']/geom").attrib == {"type": "sphere", "size": "0.25", "pos": "0.0 0.0 0.5"}
    assert balls.find(".//body[@name='b<']/inertial").attrib == inertial
