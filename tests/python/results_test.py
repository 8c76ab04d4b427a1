"""Covers and models as Python's containers: sequences, arrays, proofs, files, pictures; progress, examples, the program."""

import base64
import json
import os
import pickle
import re
import struct
import subprocess
import sys
import threading
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

import foam
from shapes import box, wavy

PROGRAM = os.environ["FOAM_TEST_BINARY"]
ROOM = Path(os.environ["FOAM_TEST_SOURCE"]) / "tests/docs/room"
pytestmark = pytest.mark.filterwarnings("ignore:.*(no <inertial>|are used)")


@pytest.fixture(scope="module")
def spheres():
    return foam.cover(wavy(300), 4, kinds="sphere", effort="fast")


@pytest.fixture(scope="module")
def mixed():
    return foam.cover(wavy(300), 2, kinds=["capsule"], effort="fast")


@pytest.fixture(scope="module")
def robot():
    return foam.load(ROOM / "robot.urdf")


def test_a_cover_is_a_sequence_of_records(spheres, mixed):
    for cover, kind in ((spheres, "sphere"), (mixed, "capsule")):
        assert type(cover) is foam.Cover and len(cover) == len(list(cover)) == len(cover.elements) >= 1
        assert cover[0] == cover.elements[0] and cover[-1] == cover.elements[-1] and cover[:1] == cover.elements[:1]
        assert {element["kind"] for element in cover} == {kind} and cover[0] in cover
        assert set(cover[0]) - {"kind", "position", "rotation"} == set(foam.KINDS[kind])
        with pytest.raises(IndexError):
            cover[len(cover)]
    assert spheres[0] == {"kind": "sphere", "position": spheres.centers[0].tolist(), "radius": spheres.radii[0]}


def test_spheres_are_an_array_and_others_are_not(spheres, mixed):
    assert np.array_equal(np.asarray(spheres), spheres.spheres) and np.asarray(spheres).shape == (len(spheres), 4)
    assert np.asarray(spheres, dtype=np.float32).dtype == np.float32
    assert np.array(spheres).flags.writeable and not spheres.spheres.flags.writeable
    for what in (lambda: mixed.spheres, lambda: mixed.radii, lambda: np.asarray(mixed)):
        with pytest.raises(foam.UsageError, match=r"not all elements are spheres \(\d capsules?\); remedy: .elements"):
            what()
    with pytest.raises(foam.UsageError, match=r"remedy: .spheres\[…\]"):
        spheres[:, 3]


def test_the_certificate_is_that_of_certify(spheres, mixed):
    for cover in (spheres, mixed, foam.cover([[0, 0, 0], [1, 0, 0]], 2, "capsule", radii=[0.1, 0.2], effort="fast")):
        assert cover.certificate.holds and cover.certificate.witnesses == {} and "proved" in cover.certificate.statement
    smaller = foam.certify(wavy(300), spheres.spheres * [1, 1, 1, 0.8])
    (witness,) = smaller.witnesses.values()
    assert not smaller and (np.linalg.norm(spheres.centers - witness, axis=1) > 0.8 * spheres.radii).all()


@pytest.mark.parametrize("name", ["spheres", "mixed"])
def test_a_cover_is_saved_and_read_back(request, tmp_path, name):
    cover = request.getfixturevalue(name)
    for ending in ("urdf", "json"):
        (file,) = cover.save(tmp_path / f"cover.{ending}")
        read = foam.read_spheres(file)
        assert read.count == len(cover) and foam.certify(wavy(300), read).holds
    numbers = json.loads(json.dumps(cover.to_dict()))
    assert foam.SphereModel.from_dict({"mesh": numbers})["mesh"] == foam.Elements(cover._rows, cover._others)
    assert foam.certify(wavy(300), {"mesh": numbers}).holds
    assert "<mujoco" in cover.to_mujoco()
    again = pickle.loads(pickle.dumps(cover))
    assert again == cover and again.certificate.holds and again.excess == cover.excess


def test_a_cover_is_shown(mixed, tmp_path):
    page = mixed._repr_html_()
    assert "data:image/png;base64," in page and "2 capsules" in page and "proved to cover" in page
    assert mixed.picture(64, 48).startswith(b"\x89PNG")
    assert "data:image/png" in mixed.show(tmp_path / "page.html", browse=False).read_text("utf-8")


def test_a_model_has_elements_of_every_kind(robot):
    model = robot.cover(6, ["capsule", "box"], effort="fast")
    for link, elements in model.items():
        assert type(elements) is foam.Elements and len(elements) >= 1, link
        assert model.elements(link) == elements.elements
    assert model.count == sum(map(len, model.values())) and model.certificate.holds
    assert foam.SphereModel.from_dict(json.loads(json.dumps(model.to_dict())), robot) == model
    with pytest.raises(foam.UsageError, match="not all elements are spheres"):
        model.to_pyroki()
    assert robot.cover(6, effort="fast") == robot.spherize(6, effort="fast")
    assert robot.cover(6, "box", effort="fast") == robot.approximate(6, ["box"], effort="fast")
    with pytest.raises(foam.UsageError, match=r"foam.certify\(robot, model\)"):
        foam.SphereModel({"a": [[0, 0, 0, 1]]}).certificate


def test_comparisons_are_those_of_the_command_line(robot, tmp_path):
    for count in (4, 9):
        robot.cover(count, effort="fast").save(tmp_path / f"{count}.csv")
    files = [tmp_path / "4.csv", tmp_path / "9.csv"]
    ran = subprocess.run(
        [PROGRAM, "compare", ROOM / "robot.urdf", *files, "--json"], capture_output=True, text=True, check=True
    )
    compared = foam.compare(robot, files)
    assert list(compared) == ["A", "B"] and {**compared.to_dict(), "original": 0} == {
        **json.loads(ran.stdout),
        "original": 0,
    }
    assert compared["B"].total.spheres > compared["A"].total.spheres and "excess" in repr(compared)
    assert "<td>few</td>" in foam.compare(robot, {"few": files[0]})._repr_html_()
    with pytest.raises(foam.UsageError, match="models: there is none"):
        foam.compare(robot, [])


def test_progress_of_a_search():
    events = []
    cover = foam.cover(wavy(3000), 60, effort="best", time_limit=0.3, progress=events.append)
    assert cover.certified and len(events) > 2 and [event.kind for event in events[-2:]] == ["progress", "run_finished"]
    done = [event.done for event in events]
    assert done == sorted(done) and 0 <= done[0] < done[-1] == 1 and events[0].seconds_left > 0
    assert foam.cover(wavy(300), 4, effort="fast", progress=print) == foam.cover(wavy(300), 4, effort="fast")
    assert [len(one) for one in foam.spherize_each(wavy(300), [1, 3], progress=events.append)] == [1, 3]


@pytest.mark.parametrize("call", [
    lambda progress: foam.cover(wavy(20000), 500, effort="best", progress=progress),
    lambda progress: foam.approximate(wavy(20000), 500, "hull", effort="best", progress=progress),
    lambda progress: foam.load(wavy(20000)).cover(500, effort="best", fresh=True, progress=progress),
], ids=["cover", "approximate", "model"])  # fmt: skip
def test_another_thread_cancels(call):
    stop = threading.Event()
    stopped = []

    def watch(event):
        if stop.is_set():
            raise foam.Cancelled("no longer wanted")

    def cancel():
        stopped.append(time.perf_counter())
        stop.set()

    timer = threading.Timer(0.3, cancel)
    timer.start()
    with pytest.raises(foam.Cancelled, match="no longer wanted"):
        call(watch)
    assert time.perf_counter() - stopped[0] < 5  # times are measured with FOAM_TEST_TIMES, in processes_test.py


def test_formats_are_those_of_the_command_line():
    ran = subprocess.run([PROGRAM, "formats", "--json"], capture_output=True, text=True, check=True)
    for one in json.loads(ran.stdout):
        ours = foam.formats()[one["format"]]
        assert (ours.reads, ours.writes, ours.extensions) == (one["reads"], one["writes"], one.get("extensions", []))
    assert len(foam.formats()) == len(json.loads(ran.stdout))


def test_examples_are_there():
    for name in ("panda", "panda_mjcf"):
        assert "panda_hand" in foam.load(foam.example(name)).links
    for name in ("forearm", "hand"):
        assert foam.read_mesh(foam.example(name)).volume > 0
    with pytest.raises(foam.UsageError, match="no example 'pandda'; there are: panda, .*did you mean 'panda'"):
        foam.example("pandda")


def test_python_runs_the_program():
    ran = subprocess.run([sys.executable, "-m", "foam", "version"], capture_output=True, text=True, check=True)
    assert foam.__version__ in ran.stdout
    assert subprocess.run([sys.executable, "-m", "foam", "no-such"], capture_output=True).returncode == 2


@pytest.mark.parametrize("call, words", [
    (lambda: foam.load(ROOM / "robot.urdf").spherize(4, set={"budget.sheres": 3}), "set, entry .*did you mean 'spheres'"),
    (lambda: foam.load('<robot name="a"><link name="b"><collision><geometry><mesh filename="package://p/x.stl"/></geometry>'
                       "</collision></link></robot>"), r"""packages=\{"p": "FOLDER"\}.*packages=\["FOLDER"\]"""),
    (lambda: foam.certify(ROOM / "robot.urdf", {"tip": [[0, 0, 0, 1]]}), r'remedy: .*rename=\{"OLD": "NEW"\}'),
    (lambda: foam.read_spheres(ROOM / "part.stl"), r"foam.formats\(\).*reader="),
    (lambda: foam.load(ROOM / "robot.urdf").approximate(4, "box", objective="radius"), "objective"),
])  # fmt: skip
def test_messages_name_arguments_of_python(call, words):
    with pytest.raises(foam.Error, match=f"(?s){words}") as caught:
        call()
    assert "--" not in str(caught.value) and "FOAM_PACKAGE_PATH" not in str(caught.value)


def test_figures_have_the_names_of_their_type():
    figures = foam.evaluate(box(), foam.cover(box(), 2, effort="fast")).total
    assert set(figures.to_dict()) == set(foam.Figures.__annotations__)


def test_a_picture_without_the_painter(monkeypatch):
    def no_painter(*arguments):
        raise foam.InputError("no painter")

    monkeypatch.setattr(foam._core, "picture", no_painter)
    page = foam.cover(box(), 3, effort="fast")._repr_html_()
    png = base64.b64decode(re.search("data:image/png;base64,([^']+)", page)[1])
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    length = struct.unpack(">I", png[33:37])[0]
    rows = np.frombuffer(zlib.decompress(png[41:41 + length]), np.uint8).reshape(360, 1 + 3 * 480)[:, 1:]
    drawn = (rows.reshape(360, 480, 3) < 250).any(axis=2)
    assert 0.1 < drawn.mean() < 0.9 and not drawn[0].any() and not drawn[:, 0].any()
