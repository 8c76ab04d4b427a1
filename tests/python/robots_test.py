"""Robots, sphere models, figures, proofs, recipes: what the command line gives, as Python sees it."""
import json
import os
import pickle
import signal
import subprocess
import threading
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import foam
from shapes import box

PROGRAM = os.environ["FOAM_TEST_BINARY"]
CONFIGS = Path(os.environ["FOAM_TEST_SOURCE"]) / "configs"
PANDA = CONFIGS / "robots/panda/panda.urdf"
TIMES = bool(os.environ.get("FOAM_TEST_TIMES"))
pytestmark = pytest.mark.filterwarnings("ignore:.*(fit small links loosely|no <inertial>)")

ARM = """<robot name="arm">
  <link name="base"><collision><geometry><mesh filename="package://parts/box.stl"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0 0 1.5"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="upper"><collision><geometry><box size="0.1 0.1 0.3"/></geometry></collision></link>
  <joint name="fix" type="fixed"><parent link="upper"/><child link="tip"/><origin xyz="0 0 0.5"/></joint>
  <link name="tip"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
</robot>"""


def command(*arguments, code=0):
    ran = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert ran.returncode == code, ran.stderr
    return ran.stdout


@pytest.fixture
def arm(tmp_path):
    """An arm whose package lies in a folder of another name."""
    (tmp_path / "robot").mkdir()
    (tmp_path / "somewhere").mkdir()
    foam.Mesh(*box()).export(tmp_path / "somewhere/box.stl")
    file = tmp_path / "robot/arm.urdf"
    file.write_text(ARM)
    return foam.load(file, packages={"parts": tmp_path / "somewhere"})


@pytest.fixture(scope="module")
def panda():
    return foam.load(PANDA)


@pytest.fixture(scope="module")
def model(panda):
    return panda.spherize(40, effort="fast")


def test_links_are_kept_skipped_and_weighed(arm):
    assert list(arm.spherize(6, effort="fast", skip="tip")) == ["base", "upper"]
    assert list(arm.spherize(6, effort="fast", keep=["base", "t*"])) == ["base", "tip"]
    assert list(arm.approximate(6, "box", effort="fast", keep="[bu]*", skip=["base"])) == ["upper"]
    light, heavy = (arm.spherize(12, effort="fast", weights={"*": 1, "upper": weight}) for weight in (1e-3, 1e3))
    assert len(light["upper"]) < len(heavy["upper"])
    assert len(arm.spherize(12, effort="fast", weights={"upper": 1e3}, links={"upper": {"weight": 1e-3}})["upper"]) == len(light["upper"])
    for wrong, message in (
        ({"skip": "tpi"}, "skip 'tpi' matches no link of arm.urdf; did you mean 'tip'"),
        ({"keep": ["upr*"]}, "did you mean 'upper'"),
        ({"skip": "*"}, "leave no link"),
        ({"weights": {"upper": 0}}, "weight expects a factor above 0"),
        ({"weights": {"uper": 1}}, "did you mean 'upper'"),
    ):
        with pytest.raises(foam.UsageError, match=message):
            arm.spherize(6, **wrong)


def test_the_tool_frame_of_a_file_is_the_one_tip(arm, panda, model, tmp_path):
    (file,) = arm.spherize(6, effort="fast").save(tmp_path / "arm.xrdf")
    assert "tip" in file.read_text().split("tool_frames:")[1]
    with pytest.raises(foam.UsageError, match="last links of the robot are .*tool_frames="):
        model.save(tmp_path / "panda.xrdf")
    with pytest.raises(foam.UsageError, match="lock_joints: joint 'panda_finger_joint1' moves from 0 to 0.04 m"):
        model.save(tmp_path / "panda.xrdf", tool_frames=["panda_hand"], lock_joints={"panda_finger_joint1": 4})


def test_a_robot_has_its_links_joints_and_meshes(arm):
    assert (arm.name, arm.root, arm.links) == ("arm", "base", ["base", "upper", "tip"])
    turn, fix = arm.joints
    assert (turn.kind, turn.parent, turn.child, turn.xyz, turn.axis) == ("revolute", "base", "upper", (0, 0, 0.3), (0, 1, 0))
    assert np.allclose(turn.rotation, [[np.cos(1.5), -np.sin(1.5), 0], [np.sin(1.5), np.cos(1.5), 0], [0, 0, 1]])
    assert (turn.lower, turn.upper, fix.kind) == (-1, 1, "fixed")
    assert arm.collision_mesh("base").volume == pytest.approx(0.06 * 0.04 * 0.2, rel=1e-6)
    with pytest.raises(foam.UsageError, match="no link 'hand'.*base, upper, tip"):
        arm.collision_mesh("hand")
    model = arm.spherize(9)
    assert list(model) == arm.links and model.count <= 9 and model.certified
    assert foam.self_collision(arm).ignored()[0] == ("base", "upper", "Adjacent")


@pytest.mark.parametrize("fate", ["changed", "deleted"])
def test_files_are_read_once(tmp_path, fate):
    """What becomes of the URDF and of a mesh after foam.load() changes nothing."""
    (tmp_path / "parts").mkdir()
    mesh, file = tmp_path / "parts/box.stl", tmp_path / "arm.urdf"
    foam.Mesh(*box()).export(mesh)
    file.write_text(ARM.replace("</robot>", "<!-- mine --></robot>"))

    def results(robot):
        model = robot.spherize(9, effort="fast", fresh=True)
        capsules = robot.approximate(5, "capsule", effort="fast", fresh=True)
        files = model.save(tmp_path / "out.urdf")
        assert foam.certify(robot, model) and foam.certify(robot, capsules)
        figures = foam.evaluate(robot, model).total.excess
        pairs = foam.self_collision(robot, samples=200).pairs
        return model, capsules, [path.read_text() for path in files], figures, pairs, robot.joints

    wanted = results(foam.load(file))
    robot = foam.load(file)
    if fate == "changed":
        file.write_text(ARM.replace("0.1 0.1 0.3", "0.5 0.5 0.5").replace("tip", "hand"))
        foam.Mesh(*box(2, 2, 2)).export(mesh)
    else:
        file.unlink()
        mesh.unlink()
    found = results(robot)
    assert found == wanted and "<!-- mine -->" in found[2][0]
    assert "<html" in robot.spherize(9, effort="fast").show(browse=False).read_text()[:200]


def test_a_mesh_file_is_read_once(tmp_path):
    mesh = foam.Mesh(*box(60, 40, 200)).export(tmp_path / "part.stl")
    wanted = foam.load(mesh, unit="mm").spherize(5)
    part = foam.load(mesh, unit="mm")
    Path(mesh).unlink()
    assert part.spherize(5, fresh=True) == wanted and foam.certify(part, wanted)
    with pytest.raises(foam.UsageError, match="'unit' is of the input"):
        part.spherize(5, set={"unit": "cm"})


def test_chosen_links_alone_are_spherized_and_judged():
    robot = foam.load(PANDA, links=["panda_link[56]", "panda_hand"])
    model = robot.spherize(9, effort="fast")
    assert list(model) == robot.links_with_geometry == ["panda_link5", "panda_link6", "panda_hand"]
    assert foam.certify(robot, model) and list(foam.evaluate(robot, model).links) == list(model)


def test_packages_are_named_in_errors(tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(ARM)
    with pytest.raises(foam.InputError, match="box.stl"):
        foam.load(file)
    with pytest.raises(foam.InputError, match="no folder"):
        foam.load(file, packages={"parts": tmp_path / "none"})
    with pytest.raises(foam.InputError, match="there is no such file"):
        foam.load(tmp_path / "none.urdf")


@pytest.mark.parametrize("ending", ["urdf", "json", "csv", "ply"])
def test_a_saved_model_has_the_bytes_of_the_command_line(tmp_path, model, ending):
    command("spherize", PANDA, "-n", 40, "--set", "stages.spherize.cover.effort=fast", "-o", tmp_path / f"program.{ending}")
    assert model.save(tmp_path / f"python.{ending}") == [tmp_path / f"python.{ending}"]
    assert (tmp_path / f"python.{ending}").read_bytes() == (tmp_path / f"program.{ending}").read_bytes()


def test_elements_have_the_bytes_of_the_command_line(tmp_path, panda):
    made = panda.approximate(11, "capsule", effort="fast", fresh=True)
    assert made.certified and made.count == 11
    assert {element["kind"] for link in made for element in made.elements(link)} == {"capsule"}
    made.save(tmp_path / "ours.json")
    command("approximate", PANDA, "-n", 11, "--with", "capsule", "--set", "stages.approximate.capsules.effort=fast",
            "-o", tmp_path / "theirs.json", "--fresh")  # fmt: skip
    assert (tmp_path / "ours.json").read_bytes() == (tmp_path / "theirs.json").read_bytes()
    with pytest.raises(foam.UsageError, match="no kind 'ball'"):
        panda.approximate(11, "ball")


def test_elements_by_cost(panda):
    made = panda.approximate(kinds=["sphere", "capsule"], cost=30, costs={"capsule": 3}, effort="fast")
    words = [element["kind"] for link in made for element in made.elements(link)]
    assert made.certified and sum({"sphere": 1, "capsule": 3}[word] for word in words) <= 30


def test_a_mesh_is_a_robot_of_one_link(tmp_path):
    mesh = foam.Mesh(*box(60, 40, 200)).export(tmp_path / "part.stl")
    model = foam.load(mesh, unit="mm").spherize(5)
    command("spherize", mesh, "--unit", "mm", "-n", 5, "-o", tmp_path / "program.json")
    model.save(tmp_path / "python.json")
    assert list(model) == ["part"]
    assert (tmp_path / "python.json").read_bytes() == (tmp_path / "program.json").read_bytes()
    assert foam.evaluate(mesh, model["part"].spheres * 1000).certified
    assert foam.evaluate(mesh, foam.spherize(mesh, 4)).certified


@pytest.mark.parametrize("format, name", [("curobo", "a.yml"), ("xrdf", "a.xrdf"), ("pyroki", "a.json"), ("srdf", "a.srdf")])
def test_formats_of_other_programs(tmp_path, panda, model, format, name):
    facts = {} if format in ("pyroki", "srdf") else {"tool_frames": ["panda_hand"]}
    (file,) = model.save(tmp_path / name, format=format, **facts)
    read = foam.read_spheres(file, robot=panda)
    assert read == model
    assert foam.certify(panda, read).holds
    model.save(tmp_path / "model.csv")
    tools = ["--tool-frame", "panda_hand"] if facts else []
    command("convert", tmp_path / "model.csv", PANDA, "-o", tmp_path / "program", "--format", format, *tools)
    without = [line for line in file.read_text().splitlines() if "model" not in line and "foam " not in line]
    assert without == [line for line in (tmp_path / "program").read_text().splitlines()
                       if "model" not in line and "foam " not in line]


def test_spheres_are_replaced_in_a_file_of_the_user(tmp_path, panda, model):
    (file,) = model.save(tmp_path / "mine.yml", format="curobo", tool_frames=["panda_hand"])
    file.write_text(file.read_text() + "# mine\n")
    smaller = panda.spherize(22, effort="fast")
    smaller.save(file, format="curobo", into=file, tool_frames=["panda_hand"])
    assert file.read_text().endswith("# mine\n") and foam.read_spheres(file, robot=panda) == smaller


def test_figures_are_those_of_the_command_line(tmp_path, panda, model):
    model.save(tmp_path / "model.csv")
    program = json.loads(command("evaluate", PANDA, tmp_path / "model.csv", "--json", "--seed", 3))
    evaluation = foam.evaluate(panda, tmp_path / "model.csv", seed=3)
    assert {**evaluation.to_dict(), "model": 0} == {**program, "model": 0}
    assert evaluation.total.excess == program["total"]["excess"]
    assert evaluation.links["panda_link5"].gap_m == 0 and evaluation.certified
    assert foam.evaluate(PANDA, dict(model), seed=3).total == evaluation.total
    with pytest.raises(AttributeError, match="there are: spheres"):
        evaluation.total.beauty
    assert pickle.loads(pickle.dumps(evaluation)).to_dict() == evaluation.to_dict()


def test_proofs_are_those_of_the_command_line(tmp_path, panda, model):
    assert foam.certify(panda, model) and foam.certify(panda, model).witnesses == {}
    smaller = {link: e.spheres * [1, 1, 1, 0.9 if link == "panda_link3" else 1] for link, e in model.items()}
    proof = foam.certify(panda, smaller)
    assert not proof.holds and list(proof.witnesses) == ["panda_link3"]
    centers, radii = smaller["panda_link3"][:, :3], smaller["panda_link3"][:, 3]
    assert (np.linalg.norm(centers - proof.witnesses["panda_link3"], axis=1) > radii).all()
    foam.SphereModel(smaller, panda).save(tmp_path / "smaller.csv")
    program = json.loads(command("certify", PANDA, tmp_path / "smaller.csv", "--json", code=1))
    assert proof.to_dict()["links"] == program["links"]
    assert not foam.certify(panda, model, guarantee="inner")


def test_fitted_spheres_keep_a_largest_gap(panda):
    model = panda.spherize(30, set={"guarantee": "fitted", "stages.refine.fit.max_gap": 0.02})
    assert not model.certified and 0 < foam.evaluate(panda, model).total.gap_m <= 0.02
    with pytest.raises(foam.UsageError, match="'objective' of spherize.cover .* no effect with guarantee: fitted"):
        panda.spherize(30, objective="protrusion", set={"guarantee": "fitted"})


def test_pairs_are_those_of_the_command_line(tmp_path, panda, model):
    model.save(tmp_path / "model.csv")
    program = json.loads(command("self-collision", PANDA, "--model", tmp_path / "model.csv", "--samples", 500, "--json",
                                 "--srdf", tmp_path / "a.srdf", "--curobo", tmp_path / "a.yml"))
    pairs = foam.self_collision(panda, model, samples=500)
    assert pairs.pairs == program["pairs"]
    assert (pairs.to_srdf(), pairs.to_curobo()) == ((tmp_path / "a.srdf").read_text(), (tmp_path / "a.yml").read_text())
    assert len(pairs.ignored()) + len(pairs.checked()) == len(pairs.pairs)
    assert sum(map(len, pairs.to_xrdf()["ignore"].values())) == len(pairs.ignored())


def test_a_model_is_a_mapping_that_goes_through_json(panda, model):
    again = foam.SphereModel.from_dict(json.loads(json.dumps(model.to_dict())), panda)
    assert again == model and not again.certified and model["panda_link5"].spheres.shape[1] == 4
    assert not model["panda_link5"].spheres.flags.writeable
    assert foam.SphereModel(dict(reversed(list(model.items()))), panda) == model  # the URDF's order
    with pytest.raises(foam.InputError, match="hand: no link of"):
        foam.SphereModel({"hand": [[0, 0, 0, 1]]}, panda)
    for rows in ([[0, 0, 0, 0]], [[0, 0, np.nan, 1]], [[0, 0, 0]], "a"):
        with pytest.raises(foam.InputError, match="spheres of panda_hand"):
            foam.SphereModel({"panda_hand": rows}, panda)
    with pytest.raises(foam.InputError, match="2 centers, but 1 radii"):
        foam.SphereModel.from_dict({"a": {"centers": [[0, 0, 0]] * 2, "radii": [1]}})


def test_models_and_robots_are_pickled(panda, model, tmp_path):
    again = pickle.loads(pickle.dumps(model))
    assert again == model and again.certified and again.total == model.total
    assert again.robot.links == panda.links
    again.save(tmp_path / "again.urdf")
    assert foam.certify(panda, tmp_path / "again.urdf")


def test_settings_of_links_and_of_the_recipe(panda):
    model = panda.spherize(30, links={"panda_link5": {"spheres": 5}, "*finger": {"skip": True}}, effort="fast", seed=3,
                           set={"budget.share": "even"})
    assert len(model["panda_link5"]) == 5 and "panda_leftfinger" not in model
    with pytest.raises(foam.UsageError, match="efort"):
        panda.spherize(30, set={"stages.spherize.cover.efort": "fast"})
    with pytest.raises(foam.UsageError, match="did you mean 'cover'"):
        panda.spherize(30, method="covr")


def test_a_robot_s_own_file_is_kept(arm):
    model = arm.spherize(6, effort="fast")
    with pytest.raises(foam.UsageError, match="force=True"):
        model.save(arm.file)
    assert arm.file.read_text() == ARM
    with pytest.raises(foam.UsageError, match="cannot be written"):
        model.save(arm.file.parent / "none/x.urdf")
    with pytest.raises(foam.UsageError, match="no parameter 'versoin'"):
        model.save(arm.file.parent / "x.xrdf", set={"versoin": 2})
    with pytest.raises(foam.UsageError, match="did you mean 'curobo'"):
        model.save(arm.file.parent / "x", format="curob")


def test_a_recipe_runs_as_by_the_command_line(tmp_path):
    recipe = CONFIGS / "panda_22.yaml"
    changes = {"budget.spheres": 20, "outputs": [{"write.json": {"file": "model.json"}}], "snapshots": False, "debug.meshes": False, "debug.snapshots": False}
    events = []
    run = foam.run(recipe, set=changes, out=tmp_path / "python", progress=events.append)
    settings = [f"--set={key}={json.dumps(value)}" for key, value in changes.items()]
    command("run", recipe, *settings, "--run-dir", tmp_path / "program")
    assert (tmp_path / "python/model.json").read_bytes() == (tmp_path / "program/model.json").read_bytes()
    assert run.certified and run.model.count <= 20 and tmp_path / "python/model.json" in run.outputs
    assert run.manifest["certified"] is True and run.total.excess == run.summary["total"]["excess"]
    assert events[-1].kind == "run_finished" and events[-1].done == 1 and "100 %" in str(events[-1])


def test_recipes_may_be_dictionaries_and_texts(tmp_path):
    mesh = foam.Mesh(*box()).export(tmp_path / "part.stl")
    recipe = {"foam": 1, "mesh": [mesh], "stages": [{"spherize.cover": {}}], "budget": {"spheres": 4}}
    run = foam.run(recipe)
    assert run.model.count <= 4 and run.directory is None and run.outputs == []
    text = f"foam: 1\nmesh: ['{mesh}']\nstages: [{{spherize.cover: {{}}}}]\nsweep: {{budget.spheres: [1, 2]}}\n"
    assert [one.model.count for one in foam.run(text)] == [1, 2]
    assert foam.check(recipe) == []
    recipe["stages"] = [{"spherize.covr": {}}]
    (finding,) = foam.check(recipe)
    assert finding.severity == "error" and "did you mean 'spherize.cover'" in str(finding)
    with pytest.raises(foam.UsageError, match="did you mean 'spherize.cover'"):
        foam.run(recipe)
    with pytest.raises(foam.UsageError, match="out="):
        run.manifest


def test_an_exception_of_a_callback_ends_a_run(panda):
    def stop(event):
        raise ZeroDivisionError("enough")

    with pytest.raises(ZeroDivisionError, match="enough"):
        panda.spherize(200, fresh=True, progress=stop)


def test_ctrl_c_ends_a_run(panda):
    times = []
    for _ in range(6):  # others may use the machine
        sent = []

        def interrupt():
            time.sleep(0.4)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with pytest.raises(KeyboardInterrupt):
            panda.spherize(2000, effort="best", fresh=True)
        times.append(time.perf_counter() - sent[0])
        thread.join()
        if times[-1] <= 0.1 or not TIMES:
            return
    pytest.fail(f"ended after {times} s")


def test_stages_and_plugins():
    stages = foam.stages()
    assert json.dumps(stages["spherize.cover"]) == json.dumps(json.loads(command("describe", "spherize.cover", "--json")))
    assert foam.describe("spherize.cover")["kind"] == "spherizer"
    with pytest.raises(foam.UsageError, match="did you mean 'spherize.cover'"):
        foam.describe("spherize.covr")
    assert all(plugin["loaded"] for plugin in foam.plugins())


def test_results_of_data_sets_are_read(tmp_path):
    (tmp_path / "meshes").mkdir()
    foam.Mesh(*box()).export(tmp_path / "meshes/box.stl")
    (tmp_path / "meshes/broken\u2028.stl").write_text("no mesh")  # a line end to str.splitlines()
    command("batch", tmp_path / "meshes", "-n", 3, "--run-dir", tmp_path / "out", code=4)
    good, bad = foam.read_batch(tmp_path / "out")
    assert good.id == "box.stl" and good.certified and good.spheres.shape == (3, 4) and good.error is None
    assert bad.error and len(bad.spheres) == 0
    command("batch", "collect", tmp_path / "out", "-o", tmp_path / "table.jsonl")
    command("batch", "collect", tmp_path / "out", "-o", tmp_path / "table.jsonl.zst")
    for table in "table.jsonl", "table.jsonl.zst":
        assert [entry.values for entry in foam.read_batch(tmp_path / table)] == [good.values, bad.values]
    with pytest.raises(foam.InputError, match="collect"):
        foam.read_batch(tmp_path / "meshes/box.stl")


def test_warnings_point_at_the_caller(panda):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        panda.spherize(22, effort="fast")
    assert caught and all(warning.filename == __file__ for warning in caught)
