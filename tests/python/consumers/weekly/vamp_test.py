"""Panda models in VAMP's own collision code: no missed collision, the pairs of the SRDF, single precision, speed."""
import os
import shlex
import subprocess
from pathlib import Path

import numpy as np
import pytest
import urdf_truth
from original import Original
from vamp_struct import Robot

HERE, VAMP = Path(__file__).parent, Path(os.environ["FOAM_TEST_VAMP"])
PANDA = urdf_truth.SOURCE / "configs/robots/panda/panda.urdf"
FINGERS = {"panda_finger_joint1": 0.04, "panda_finger_joint2": 0.04}
POSES = 10000
PADDING = 1e-5  #: m; by what `--pad` has to enlarge spheres for VAMP's single precision
#: What VAMP's own build passes to GCC.
FLAGS = "-std=c++17 -O3 -march=native -mavx2 -w -fno-math-errno -fno-signed-zeros -fno-trapping-math -fno-rounding-math -ffp-contract=fast -fassociative-math"
LEVEL = np.eye(3)
SCENES = {
    "shelf": [
        ("box", (0.7, 0, 0.3), LEVEL, (0.2, 0.5, 0.01)), ("box", (0.7, 0, 0.7), LEVEL, (0.2, 0.5, 0.01)),
        ("box", (0.7, 0.5, 0.5), LEVEL, (0.2, 0.01, 0.5)), ("box", (0.9, 0, 0.5), LEVEL, (0.01, 0.5, 0.5)),
        ("box", (-0.5, 0.1, 0.4), urdf_truth.about((0.6, 0, 0.8), 0.7), (0.1, 0.2, 0.15)),
    ],
    "posts": [
        ("capsule", (0.4, 0.4, 0), (0.4, 0.4, 0.9), 0.04), ("capsule", (-0.5, -0.3, 0.7), (0.5, -0.6, 0.9), 0.03),
        ("sphere", (0.45, -0.1, 0.75), 0.09), ("sphere", (-0.4, 0.5, 0.4), 0.12), ("sphere", (0.1, 0.0, 1.25), 0.06),
    ],
}  # fmt: skip


def line_of(kind, *numbers):
    """Return an obstacle as vamp_check reads it: a box by its centre, Euler angles and half sizes."""
    if kind == "box":
        centre, turn, half = numbers
        angles = np.arctan2(turn[2, 1], turn[2, 2]), -np.arcsin(turn[2, 0]), np.arctan2(turn[1, 0], turn[0, 0])
        numbers = centre, angles, half
    return " ".join([kind, *(repr(float(number)) for part in numbers for number in np.atleast_1d(part))])


class Answers:
    """What vamp_check says of queries."""

    def __init__(self, program, folder, queries, scenes=SCENES):
        queries.astype(np.float32).tofile(folder / "queries")
        for name, scene in scenes.items():
            (folder / name).write_text("\n".join(line_of(*obstacle) for obstacle in scene))
        done = subprocess.run([program, folder / "queries", *(folder / name for name in scenes)], capture_output=True, check=True)
        bits = np.frombuffer(done.stdout, np.uint8, len(queries))
        self.own, self.alone = bits & 1 > 0, bits & 2 > 0
        self.scenes = {name: bits & 4 << k > 0 for k, name in enumerate(scenes)}
        self.centres = np.frombuffer(done.stdout, np.float32, offset=len(queries)).reshape(len(queries), -1, 3).astype(float)
        self.nanoseconds = list(map(float, done.stderr.split()))


def built(folder, name, header):
    """Compile vamp_check for a robot; start it, for others to be compiled beside."""
    words = ["g++", *FLAGS.split(), *shlex.split(os.environ.get("CXXFLAGS", "")), f"-I{VAMP}/src/impl", "-I/usr/include/eigen3"]
    words += [f"-I{HERE}/stubs", f"-I{folder}", f"-DROBOT={name}", f"-DHEADER={header}", HERE / "vamp_check.cpp"]
    return subprocess.Popen([*words, "-o", folder / f"check_{name.split(':')[-1]}"], stderr=subprocess.PIPE, text=True)


@pytest.fixture(scope="module")
def poses():
    random, limits = np.random.default_rng(5), urdf_truth.Truth(PANDA).free_joints()
    low, high = np.array([limits[f"panda_joint{i}"] for i in range(1, 8)]).T
    return random.uniform(low, high, (POSES, 7)).astype(np.float32).astype(float)


@pytest.fixture(scope="module")
def truth(poses):
    """Return what collides on the original geometry: by scene, and by pair of links."""
    original = Original(PANDA)
    rows = original.configurations([f"panda_joint{i}" for i in range(1, 8)], poses, FINGERS)
    original.rows = rows
    original.in_scene = {name: original.touches(rows, scene) for name, scene in SCENES.items()}
    original.pairs, original.touching = original.pairs_that_touch(rows)
    return original


class Checked:
    """A model of the Panda, and the answers to queries about it."""

    def __init__(self, count, folder):
        self.folder, file = folder, folder / f"panda{count}.urdf"
        words = ["spherize", PANDA, "-n", count, "--effort", "fast", "--format", "vamp", "-o", file]
        words += ["--tool-frame", "panda_hand", "--lock", "panda_finger_joint1=0.04"]
        subprocess.run([os.environ["FOAM_TEST_BINARY"], *map(str, words)], capture_output=True, check=True)
        self.name = f"Panda{count}"
        self.robot = Robot(self.name, file, file.with_suffix(".srdf"))
        (folder / f"{self.name}.hh").write_text(self.robot.text)
        self.making = built(folder, self.name, f'"{self.name}.hh"')

    def ask(self, poses, original):
        assert self.making.wait() == 0, self.making.stderr.read()
        frames = original.frames(original.rows, list(self.robot.spheres))
        self.centres = np.concatenate(
            [frames[:, k, None, :3, 3] + centres @ frames[:, k, :3, :3].transpose(0, 2, 1) for k, (centres, _) in enumerate(self.robot.spheres.values())],
            axis=1,
        )  # fmt: skip
        self.radii = np.concatenate([radii for _, radii in self.robot.spheres.values()])
        self.own = self.obstacles()
        self.answers = Answers(self.folder / f"check_{self.name}", self.folder, np.hstack([poses, self.own]))

    def obstacles(self):
        """Return a sphere for each pose that touches one of the robot's, by at most 5 µm."""
        random = np.random.default_rng(6)
        which = random.integers(len(self.radii), size=POSES)
        away = random.normal(size=(POSES, 3))
        away /= np.linalg.norm(away, axis=1)[:, None]
        sizes = random.uniform(0.002, 0.1, POSES)
        reach = self.radii[which] + sizes - random.uniform(0, 5e-6, POSES)
        return np.hstack([self.centres[range(POSES), which] + away * reach[:, None], sizes[:, None]]).astype(np.float32).astype(float)


@pytest.fixture(scope="module")
def models(tmp_path_factory, poses, truth):
    found = {count: Checked(count, tmp_path_factory.mktemp(f"panda{count}")) for count in (22, 59, 92)}
    for model in found.values():
        model.ask(poses, truth)
    return found


@pytest.mark.parametrize("count", (22, 59, 92))
def test_misses_no_collision(models, truth, count):
    model = models[count]
    assert model.robot.count == count
    apart = ~truth.touching.all(axis=0)
    collides = truth.touching[:, apart].any(axis=1)
    assert POSES / 100 < collides.sum() < POSES / 2
    missed = np.flatnonzero(collides & ~model.answers.alone)
    pairs = {pair for pair, touches in zip(truth.pairs, truth.touching.T) if touches[missed].any()}
    assert not missed.size, f"{missed.size} of {collides.sum()} poses: {pairs}"
    for name, found in model.answers.scenes.items():
        in_scene = truth.in_scene[name]
        assert POSES / 20 < in_scene.sum() < POSES * 0.8, name
        assert not (in_scene & ~found).any(), f"{name}: {(in_scene & ~found).sum()} of {in_scene.sum()} poses"


@pytest.mark.parametrize("count", (22, 59, 92))
def test_checks_the_pairs_of_the_srdf(models, count):
    model = models[count]
    begins = dict(zip(model.robot.spheres, np.cumsum([0] + [len(radii) for _, radii in model.robot.spheres.values()])))
    gaps = np.full(POSES, np.inf)
    for a, b in model.robot.pairs:
        one, other = (slice(begins[link], begins[link] + len(model.robot.spheres[link][1])) for link in (a, b))
        apart = np.linalg.norm(model.centres[:, one, None] - model.centres[:, None, other], axis=3)
        gaps = np.minimum(gaps, (apart - model.radii[one, None] - model.radii[None, other]).min(axis=(1, 2)))
    clear = abs(gaps) > 1e-5
    assert clear.mean() > 0.99 and (gaps < 0).any() and (gaps > 0).any()
    np.testing.assert_array_equal(model.answers.alone[clear], gaps[clear] < 0)


@pytest.mark.parametrize("count", (22, 59, 92))
def test_rounds_to_single_precision(models, figure, count):
    model = models[count]
    off = np.linalg.norm(model.answers.centres - model.centres, axis=2).max()
    gaps = np.linalg.norm(model.centres - model.own[:, None, :3], axis=2) - model.radii - model.own[:, None, 3]
    depths = -gaps.min(axis=1)
    missed = (depths > 0) & ~model.answers.own & ~model.answers.alone
    deepest = depths[missed].max(initial=0)
    figure(f"VAMP, Panda by {count} spheres: centres are off by up to {off * 1e6:.2f} µm; missed contacts are up to {deepest * 1e6:.2f} µm deep")
    assert 0 < off < PADDING
    assert (depths[~model.answers.alone] > 0).mean() > 0.5
    assert deepest < PADDING


def test_is_as_fast_as_vamps_own(models, poses, figure, tmp_path):
    making = built(tmp_path, "vamp::robots::Panda", "<vamp/robots/panda.hh>")
    assert making.wait() == 0, making.stderr.read()
    own = Answers(tmp_path / "check_Panda", tmp_path, np.hstack([poses, np.full((POSES, 4), 9.0)]))
    for count, model in models.items():
        ratios = [f"{theirs / ours:.2f} ({name})" for name, ours, theirs in zip(SCENES, model.answers.nanoseconds, own.nanoseconds)]
        figure(f"VAMP, Panda by {count} spheres: checks per second of free poses, beside VAMP's own 59: {', '.join(ratios)}")
        assert all(time > 0 for time in model.answers.nanoseconds)
