"""Tiny experiments of every kind, run as `foam bench` does."""
import contextlib
import csv
import io
import os
import re
import signal
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from foam.bench.command import main
from foam.bench.programs import engine_folder

MESHES = Path(os.environ["FOAM_TEST_SOURCE"]) / "configs/robots/panda/meshes"
TIME = f"""foam_experiment: 1
name: x
title: A title
kind: time_against_triangles
mesh: [not_there.stl, {MESHES}/finger.stl]
triangles: [100, 200, 400]
repeats: 2
spheres: 3
figures:
  fast: [load.mesh, repair.soup]
  slow:
    - [repair.soup, spherize.grid]
"""
QUALITY = """foam_experiment: 1
name: x
kind: quality_against_spheres
robots: {pair: [no.urdf, pair.urdf], none: no.urdf}
filters: repair.soup
methods: [spherize.grid, spherize.octree]
spheres: [1, 4]
"""
QUERIES = """foam_experiment: 1
name: x
kind: collision_queries
robots:
  arm: {urdf: [no.urdf, arm.urdf], spheres: 6}
  other: {urdf: arm.urdf, spheres: spheres.urdf}
  none: {urdf: no.urdf, spheres: 1}
method: [repair.soup, spherize.octree]
queries: 20
distances: 5
environments: 4
obstacles: 3
"""


def has(engine):
    return (engine_folder() / f"foam-engine-{engine}").exists()


needs_fcl = pytest.mark.skipif(not has("fcl"), reason="libfcl-dev is not here")
needs_mujoco = pytest.mark.skipif(not has("mujoco-grasp"), reason="libmujoco-dev is not here")
needs_queries = pytest.mark.skipif(not has("queries"), reason="the target bench is not built")


class Room:
    """A folder with an experiment."""

    def __init__(self, folder):
        self.folder, self.code, self.out, self.err = folder, None, "", ""

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def run(self, text, *options, code=0):
        """Run an experiment as the program does, in this process: it starts slowly."""
        self.write("x.yaml", text)
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            ended = main(["x.yaml", "--run-dir", "out", *options])
        self.out, self.err = out.getvalue(), err.getvalue()
        assert ended == code, self.err
        return self.out

    @property
    def files(self):
        return sorted(path.name for path in (self.folder / "out").iterdir() if path.name != ".foam-run")

    def contents(self, name):
        return (self.folder / "out" / name).read_text()

    def rows(self, *left_out):
        """The rows of results.csv without some columns."""
        rows = list(csv.DictReader(io.StringIO(self.contents("results.csv"))))
        return [{key: value for key, value in row.items() if key not in left_out} for row in rows]


@pytest.fixture
def room(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("FOAM_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "FOAM_SHARED"):
        monkeypatch.delenv(name, raising=False)
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    with warnings.catch_warnings():
        yield Room(tmp_path)
    for number, handler in handlers.items():
        signal.signal(number, handler)


def test_time_against_triangles(room):
    assert room.run(TIME) == room.contents("results.md")
    assert [tuple(row.values()) for row in room.rows("cpu_seconds")] == [
        (figure, curve, count, count, "2", "")
        for figure, curve in (("fast", "load.mesh"), ("fast", "repair.soup"), ("slow", "repair.soup + spherize.grid"))
        for count in ("100", "200", "400")]
    assert all(0 < float(row["cpu_seconds"]) < 10 for row in room.rows())
    assert room.files == ["fast.svg", "measured_on.csv", "results.csv", "results.md", "slow.svg"]
    for name, value in list(csv.reader(io.StringIO(room.contents("measured_on.csv"))))[1:]:
        assert f"| {name} | {value} |\n" in room.out
    assert "repair.soup + spherize.grid, n^" in room.contents("slow.svg")
    for part in ("# A title\n", "![fast](fast.svg)", "at most 3 spheres", "| processor |", "| compiler |",
                 "| experiment | x.yaml, digest ", "| CPU s | 100 | 200 | 400 | growth |"):
        assert part in room.out
    before = room.rows("cpu_seconds")
    room.run(TIME + "prepare: {repair.soup: {largest_hole: 3}}\n")  # replaces its own folder
    assert "finger.stl, then repair.soup (largest_hole: 3); " in room.out
    assert [row["triangles"] for row in room.rows()] == [row["triangles"] for row in before]


def test_a_time_limit_ends_a_curve(room):
    room.run(TIME.replace("repeats: 2", "time_limit: 0.001"))
    assert {"curve": "repair.soup + spherize.grid", "triangles": "200", "repeats": "0", "remark": "left out"}.items() <= (
        room.rows()[-2].items())
    assert "| left out | left out | – |" in room.out


def test_work_that_takes_too_long_is_ended(room):
    room.run(TIME.replace("repeats: 2", "time_limit: 0.3").replace("[100, 200, 400]", "[100000]")
             .replace("spheres: 3", "spheres: 300").replace("[repair.soup, spherize.grid]", "spherize.cover"))
    assert room.rows()[-1]["remark"] == "over 0.3 s"


def test_reference_curves(room):
    reference = "references: [{label: Other, file: other.csv, where: {step: b}, x: n, y: s}]\n"
    room.run(TIME + reference)
    assert "Left out, its file is not here: Other (other.csv)." in room.out
    room.write("other.csv", "n,step,s\n100,a,7\n100,b,1\n400,b,16\n200,b,4\n")
    room.run(TIME + reference)
    assert "Other: 3 published times, growth n^2.00." in room.out
    assert "Other, n^2.00" in room.contents("slow.svg")
    room.write("other.csv", "n,step,z\n100,b,1\n")
    room.run(TIME + reference, code=1)
    assert f"foam: error: {room.folder}/other.csv: there is no column 's'; did you mean 'n'?\n" in room.err
    room.write("other.csv", "n,step,s\n100,b,soon\n")
    room.run(TIME + reference, code=1)
    assert "other.csv: column 's' holds 'soon', no number" in room.err


def test_a_stage_that_fails_is_named(room):
    room.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    room.run("foam_experiment: 1\nname: x\nkind: time_against_triangles\nmesh: open.obj\ntriangles: [4]\n"
             "figures: {a: [repair.soup]}\n", code=1)
    assert re.search("foam: error: repair.soup, 4 triangles: .", room.err)
    assert not (room.folder / "out").exists()


def test_program_against_size(room):
    room.run(f"foam_experiment: 1\nname: x\nkind: program_against_size\nmesh: {MESHES}/finger.stl\nspheres: [1, 2]\n"
             "repeats: 1\ncurves: {fast: {stages.spherize.cover.effort: fast}, normal: {}}\n")
    assert room.files == ["measured_on.csv", "memory.svg", "results.csv", "results.md", "time.svg"]
    rows = room.rows()
    assert [(row["curve"], row["spheres"], row["certified"]) for row in rows] == [
        ("fast", "1", "yes"), ("fast", "2", "yes"), ("normal", "1", "yes"), ("normal", "2", "yes")]
    assert all(float(row["cpu_seconds"]) > 0 and 1 < float(row["memory_mb"]) < 1000 for row in rows)
    assert "fast: stages.spherize.cover.effort=fast. normal: as it is." in room.out
    for part in ("| CPU s | 1 | 2 | growth |", "| MB | 1 | 2 | growth |", "| excess | 1 | 2 |"):
        assert part in room.out


def test_a_wrong_setting_of_a_program_is_told(room):
    room.run(f"foam_experiment: 1\nname: x\nkind: program_against_size\nmesh: {MESHES}/finger.stl\nspheres: [1]\n"
             "triangles: [300]\ncurves: {odd: {stages.spherize.cover.efort: fast}}\n", code=1)
    assert "foam: error: odd, 300 triangles, 1 spheres: exit code 2: " in room.err and "efort" in room.err


PAIR = f"""<robot name='pair'>
  <link name='a'><visual><geometry><sphere radius='1'/></geometry></visual>
    <collision><geometry><box size='1 1 1'/></geometry></collision></link>
  <link name='b'><collision><geometry><mesh filename='{MESHES}/finger.stl'/></geometry></collision></link>
  <joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>"""


def test_quality_against_spheres(room):
    room.write("pair.urdf", PAIR)
    room.run(QUALITY)
    assert room.files == ["cpu.svg", "excess.svg", "measured_on.csv", "protrusion.svg", "results.csv", "results.md"]
    rows = room.rows()
    assert [(row["method"], row["spheres_per_link"]) for row in rows] == [
        (method, count) for method in ("spherize.grid", "spherize.octree") for count in ("1", "4")]
    # A unit cube in its circumscribed ball is most of the volume: excess = √3 π / 2 − 1.
    assert rows[2]["spheres"] == "2" and rows[2]["excess"].startswith("1.7")
    for part in ("Of the 4 models 4 are certified, the largest gap is 0.00 m.", "Before every method: repair.soup.",
                 "Left out, as no candidate is here: none.", "| pair: excess | 1 | 4 |"):
        assert part in room.out
    assert "foam: warning: x: none is skipped: " in room.err
    room.run(QUALITY)
    assert room.rows("cpu_seconds") == [{k: v for k, v in row.items() if k != "cpu_seconds"} for row in rows]


def test_no_robot_is_there(room):
    room.run(QUALITY, code=1)
    assert "foam: error: x: none of the robots is here; x.yaml:4:" in room.err
    assert not (room.folder / "out").exists()


def test_fidelity(room):
    room.write("pair.urdf", PAIR)
    room.run("foam_experiment: 1\nname: x\nkind: fidelity\nrobot: [no.urdf, pair.urdf]\nmethod: spherize.octree\n"
             "spheres: [2, 4]\nsnapshots: {size: [400, 200], pose: {j: 1}}\n")
    assert room.files == ["fidelity.png", "measured_on.csv", "results.csv", "results.md"]
    png = (room.folder / "out/fidelity.png").read_bytes()
    assert png.startswith(b"\x89PNG") and png[16:24] == bytes([0, 0, 1, 144, 0, 0, 0, 200])
    assert "![x](fidelity.png)" in room.out
    assert ("| spheres | made | excess | excess error | mean protrusion, mm | largest protrusion, mm | certified |"
            in room.out)
    assert [(row["spheres"], row["made"]) for row in room.rows()] == [("2", "2"), ("4", "3")]


def arm(tip, base):
    """A base, and an arm on two joints."""
    def link(name, shape):
        return f"<link name='{name}'><collision><geometry>{shape}</geometry></collision></link>"

    def joint(parent, child, axis):
        return (f"<joint name='to_{child}' type='continuous'><parent link='{parent}'/><child link='{child}'/>"
                f"<origin xyz='0.4 0 0.2'/><axis xyz='{axis}'/></joint>")

    return ("<robot name='arm'>" + link("base", base) + link("upper", base) + link("tip", tip)
            + joint("base", "upper", "0 0 1") + joint("upper", "tip", "0 1 0") + "</robot>")


@pytest.fixture
def arms(room):
    room.write("arm.urdf", arm(f"<mesh filename='{MESHES}/finger.stl'/>", "<box size='0.1 0.1 0.3'/>"))
    room.write("spheres.urdf", arm("<sphere radius='0.1'/>", "<sphere radius='0.2'/>"))
    return room


@needs_queries
def test_collision_queries(arms):
    arms.run(QUERIES)
    assert arms.files == ["measured_on.csv", "results.csv", "results.md"]
    assert ("| robot | FCL: Δ collision, ms | FCL: Δ distance, ms | FCL: Δ validity, % | FCL, pair by pair: Δ collision, ms "
            "| FCL, pair by pair: Δ distance, ms | FCL, pair by pair: Δ validity, % | Bullet: Δ collision, ms | Bullet: Δ "
            "distance, ms | Bullet: Δ validity, % | MuJoCo: Δ collision, ms | MuJoCo: Δ distance, ms | MuJoCo: Δ validity, % "
            "|") in arms.out
    assert ("| robot | shapes | spheres | queries | collision, ms | by spheres, ms | distances | distance, ms "
            "| by spheres, ms | aborted | aborted by spheres |") in arms.out
    for part in ("Left out, as no candidate is here: none.", "arm is arm.urdf: 3 links, 6 spheres, ",
                 "other is arm.urdf: 3 links, 3 spheres, "):
        assert part in arms.out
    rows = arms.rows()
    assert len(rows) == 16  # 2 robots, 4 engines, 2 models
    for row in rows:
        here = has(row["engine"].partition("_")[0])
        assert row["queries"] == ("20" if here else "0") and row["distances"] == ("5" if here else "0")
        assert (row["remark"] == "") == here
        assert here or "is not built; remedy: apt-get install" in row["remark"]
        alone, by_obstacle, itself = (int(row[key]) for key in ("collides", "hits_obstacle", "hits_itself"))
        assert max(by_obstacle, itself) <= alone <= by_obstacle + itself


@needs_fcl
def test_certified_spheres_miss_nothing_and_verdicts_are_the_same_every_time(arms):
    text = QUERIES.replace("distances: 5", "distances: {fcl: 7, fcl_pairs: 7}") + "engines: [fcl, fcl_pairs]\nseed: 3\n"
    arms.run(text)
    assert re.search("certified; of [1-9][0-9]* such hits of obstacles, over all libraries, their spheres missed 0, of ",
                     arms.out)
    assert "to itself: 7 in FCL; 7 in FCL, pair by pair. The two models" in arms.out
    same = ("shapes", "queries", "aborted", "collides", "collides_alone", "hits_obstacle", "hits_itself", "distances",
            "mean_distance_m")
    first = [[row[key] for key in same] for row in arms.rows()]
    assert [first[i] for i in (0, 1, 4, 5)] == [first[i] for i in (2, 3, 6, 7)]  # with trees and without
    arms.run(text)
    assert [[row[key] for key in same] for row in arms.rows()] == first


@needs_fcl
def test_an_engine_has_only_so_much_time(arms):
    arms.run(QUERIES.replace("queries: 20", "queries: 100000").replace("environments: 4", "environments: 1")
             + "engines: fcl\ntime_limit: 0.02\n")
    assert re.search("arm: [1-9][0-9]* queries were not asked, the time was up", arms.out)


@needs_queries
def test_spheres_that_are_not_there(arms):
    arms.run(QUERIES.replace("spheres.urdf", "no_spheres.urdf"), code=1)
    assert "no_spheres.urdf" in arms.err


@needs_queries
def test_element_checks(arms):
    arms.run("foam_experiment: 1\nname: x\nkind: element_checks\nrobots: {arm: arm.urdf, none: no.urdf}\n"
             "methods: [spherize.octree, spherize.grid]\nelements: [1, 2]\nposes: 5\npairs: 3\nrepeats: 2\n")
    assert "| method | cost by default | FCL | FCL, pair by pair | Bullet | MuJoCo |" in arms.out
    assert "Left out, as no candidate is here: none." in arms.out
    rows = arms.rows()
    assert len(rows) == 16  # 2 counts, 2 methods, 4 engines
    for row in rows:
        here = has(row["engine"].partition("_")[0])
        assert (row["near_pair_ns"] != "") == (row["robot_us"] != "") == (row["remark"] == "") == here
        assert row["mean_cost"] == "1"  # spheres
        if here:
            assert row["near_pairs_in_contact"] == "0"
        if here and row["method"] == "spherize.octree":
            assert row["robot_ratio"] == "1"
    # One sphere a link: base and tip alone are no neighbours.
    assert (rows[0]["elements"], rows[0]["pairs"]) == ("3", "1")


GRIPPER = """<robot name="gripper">
  <link name="base"/>
  <link name="palm"><collision><geometry><box size="0.02 0.02 0.02"/></geometry></collision></link>
  <link name="left"><collision><origin xyz="0 0.01 0"/><geometry><box size="0.03 0.02 0.04"/></geometry></collision></link>
  <link name="right"><collision><origin xyz="0 -0.01 0"/><geometry><box size="0.03 0.02 0.04"/></geometry></collision></link>
  <joint name="up" type="prismatic"><parent link="base"/><child link="palm"/><origin xyz="0.5 0 0.3"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/></joint>
  <joint name="open" type="prismatic"><parent link="palm"/><child link="left"/><origin xyz="0 0 -0.24"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.06" effort="1" velocity="1"/></joint>
  <joint name="open_too" type="prismatic"><parent link="palm"/><child link="right"/><origin xyz="0 0 -0.24"/>
    <axis xyz="0 -1 0"/><mimic joint="open"/><limit lower="0" upper="0.06" effort="1" velocity="1"/></joint>
</robot>"""
THROUGHPUT = """foam_experiment: 1
name: x
kind: throughput
robot: gripper.urdf
spheres: [3]
method: spherize.grid
fingers: [left, right]
simulations: 2
repeats: 2
threads: 1
motion: [{time: 0, joints: {open: 0.06}}, {time: 0.5, joints: {open: 0}}, {time: 1, joints: {up: 0.1}}]
"""


@needs_mujoco
def test_a_gripper_lifts_a_box(room):
    room.write("gripper.urdf", GRIPPER)
    room.run(THROUGHPUT)
    rows = room.rows()
    assert [(row["model"], row["repeat"]) for row in rows] == [
        ("original", "1"), ("original", "2"), ("3 spheres", "1"), ("3 spheres", "2")]
    for row in rows:
        assert (row["steps"], row["gripped"], row["lifted"]) == ("500", "2", "2")  # two simulations of 250 steps
        assert float(row["mean_lift_m"]) == pytest.approx(0.1, abs=0.02)
    assert "| original |" in room.out
    room.run(THROUGHPUT.replace("{open: 0}", "{open: 0.06}"))
    assert all(row["gripped"] == row["lifted"] == "0" for row in room.rows())


@needs_mujoco
def test_what_mujoco_refuses_is_told_with_the_model(room):
    room.write("gripper.urdf", GRIPPER.replace('name="base"', 'name="world"').replace('link="base"', 'link="world"'))
    room.run(THROUGHPUT, code=1)
    assert "foam: error: the model 'original': " in room.err and "world" in room.err


@needs_mujoco
def test_names_that_the_robot_lacks(room):
    room.write("gripper.urdf", GRIPPER)
    room.run(THROUGHPUT.replace("[left, right]", "[left, thumb]"), code=1)
    assert "gripper.urdf: there is no link 'thumb'" in room.err
    room.run(THROUGHPUT.replace("{up: 0.1}", "{down: 0.1}"), code=2)
    assert "a value is given for joint 'down', but robot 'gripper' has no such joint" in room.err


def test_a_missing_mujoco_is_named(room):
    if has("mujoco-grasp"):
        pytest.skip("libmujoco-dev is here")
    room.write("gripper.urdf", GRIPPER)
    room.run(THROUGHPUT, code=3)
    assert ("the program foam-engine-mujoco-grasp is not built; remedy: apt-get install libmujoco-dev, then configure and "
            "build foam again") in room.err


def test_ctrl_c_leaves_nothing(room):
    room.write("x.yaml", TIME.replace("repeats: 2", "repeats: 1000"))
    process = subprocess.Popen([sys.executable, "-m", "foam.bench", "x.yaml"], stderr=subprocess.PIPE, text=True)
    process.stderr.readline()  # it measures
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert process.returncode == -signal.SIGINT
    assert err.endswith("foam: error: cancelled; nothing was written\n")
    assert [path.name for path in room.folder.iterdir()] == ["x.yaml"]


def test_foreign_folders_are_left_alone(room):
    (room.folder / "out").mkdir()
    (room.folder / "out/letter.txt").write_text("dear")
    room.run(TIME, code=1)
    assert "no .foam-run in it" in room.err
    assert room.contents("letter.txt") == "dear"
    room.run(TIME, "--run-dir", ".", code=2)
    assert "the run would replace this folder, in which the input x.yaml lies" in room.err


def test_check_measures_nothing(room):
    room.run(TIME, "--check")
    assert room.err == "foam: x.yaml: good\n" and not (room.folder / "out").exists()
    room.run(TIME + "repeat: 3\n", "--check", code=2)
    assert room.err == ("x.yaml:13:1: error[unknown-key]: unknown key 'repeat'; did you mean 'repeats'?\n"
                        "foam: error: x.yaml: nothing was measured\n")


def test_the_program_foam_starts_it(room):
    room.write("x.yaml", TIME)
    ran = subprocess.run([os.environ["FOAM_TEST_BINARY"], "bench", "x.yaml", "--check"], cwd=room.folder, capture_output=True,
                         text=True, env=os.environ | {"FOAM_PYTHON": sys.executable})
    assert (ran.returncode, ran.stderr) == (0, "foam: x.yaml: good\n")


@pytest.mark.parametrize("module", ["pandas", "matplotlib"])
def test_a_missing_module_is_named(room, module):
    room.write("x.yaml", TIME)
    (room.folder / f"{module}.py").write_text(f"raise ModuleNotFoundError('No module named {module}', name='{module}')\n")
    ran = subprocess.run([sys.executable, "-m", "foam.bench", "x.yaml"], cwd=room.folder, capture_output=True, text=True)
    assert ran.returncode == 2
    assert ran.stderr == (
        f"foam: error: foam bench needs the Python module {module}, which {sys.executable} has not; remedy: apt-get install "
        "python3-pandas python3-matplotlib python3-yaml, or pip install 'foam-spheres[bench]', or name another Python by FOAM_PYTHON\n")
    assert not (room.folder / "out").exists()


def test_a_check_needs_no_plots(room):
    room.write("x.yaml", TIME)
    (room.folder / "matplotlib.py").write_text("raise ModuleNotFoundError('No module named matplotlib', name='matplotlib')\n")
    ran = subprocess.run([sys.executable, "-m", "foam.bench", "x.yaml", "--check"], cwd=room.folder, capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, "foam: x.yaml: good\n")
