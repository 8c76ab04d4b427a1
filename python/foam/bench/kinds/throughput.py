"""kind: throughput. Many simulations of a robot that grasps an object, original geometry against spheres, in MuJoCo: Table II of
Coumar et al., "Foam: A Tool for Spherical Approximation of Robot Geometry" (2025)."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._judge import self_collision
from ..._robot import Robot, load
from ...errors import Error, InputError, error_of
from ..experiment import Bench, Experiment, Outcome, Section, Source, table
from ..findings import Findings
from ..grasp_scene import GraspObject, Setup, grasp_scene, moving
from ..inputs import read_candidates
from ..models import made
from ..programs import answers, engine_program
from ..statistics import Mean, mean_of
from ..tree import Value
from ..values import expect_list, expect_map, integer, number, read_texts, read_value, read_values, required, required_counts

_VALUES = [
    integer("simulations", 300, 1, 1e5),
    integer("repeats", 5, 1, 1e4),
    integer("threads", 0, 0, 1024),
    number("timestep", 0.004, 1e-5, 0.1, "s"),
    number("spread", 0.003, 0, 1, "m"),
    number("lift", 0.05, 0, 10, "m"),
]
_MOTION = "motion: [{time: 0, joints: {elbow: 0}}, {time: 1, joints: {elbow: 1}}]"


@dataclass
class _Moment:
    """Values of joints at a time, s; those that are not named stay where they were."""

    time: float
    joints: dict[str, float] = field(default_factory=dict)


@dataclass
class _Model:
    """The robot with one kind of geometry."""

    label: str
    spheres: Mapping[str, NDArray[Any]]  #: by link; empty: the original
    scene: str = ""

    @property
    def count(self) -> int:
        """The number of spheres."""
        return sum(map(len, self.spheres.values()))


@dataclass
class _Measurement:
    """One run of all simulations of a model."""

    steps: int
    wall: float  #: s
    cpu: float  #: s
    contacts: float  #: a step
    gripped: int  #: simulations
    lifted: int  #: simulations
    lift: float  #: m; mean


class Throughput(Experiment):
    """Steps a second of simulations."""

    kind = "throughput"

    def __init__(self, source: Source) -> None:
        root, findings = source.root, source.findings
        structures = ["robot", "method", "spheres", "object", "fingers", "object_ignores", "motion"]
        self.values: Any = source.values(_VALUES, structures)
        robot = required(root, "robot", "robot: FILE.urdf", findings)
        self.robot = read_candidates(robot, "robot", findings, source.folder)
        self.spheres = required_counts(root, "spheres", "spheres: [11, 22]", 1, 1e5, findings)
        self.method = source.stages.method(root)
        given = root.find("object")
        self.object = GraspObject() if given is None else _read_object(given, findings)
        fingers = required(root, "fingers", "fingers: [left, right]", findings)
        self.fingers = [] if fingers is None else read_texts(fingers, "fingers", findings)
        ignores = root.find("object_ignores")
        self.object_ignores = [] if ignores is None else read_texts(ignores, "object_ignores", findings)
        motion = required(root, "motion", _MOTION, findings)
        self.motion = [] if motion is None else _read_motion(motion, findings)

    def stages(self) -> set[str]:
        return self.method.names if self.method else set()

    @property
    def threads(self) -> int:
        """The threads that simulations run on."""
        return self.values["threads"] or os.cpu_count() or 1

    def run(self, bench: Bench) -> Outcome:
        program = engine_program(
            "foam-engine-mujoco-grasp", "apt-get install libmujoco-dev, then configure and build foam again"
        )
        chosen, urdf = self.robot.resolve()
        robot = load(urdf)
        for link in [*self.object_ignores, *self.fingers]:
            if link not in robot.links:
                raise InputError(f"{urdf}: there is no link '{link}'")
        request = self._request(robot)
        models = self._models(robot, urdf)
        excluded = self._excluded(robot, models)
        setup = Setup(self.object, excluded, self.object_ignores, self.fingers, self.values["timestep"])
        for model in models:
            model.scene = grasp_scene(robot, model.spheres, setup)
        results: list[list[_Measurement]] = [[] for _ in models]
        version = ""
        for repeat in range(self.values["repeats"]):
            for model, done in zip(models, results):
                version, measured = self._measured(program, request | {"scene": model.scene}, model)
                done.append(measured)
                bench.tell(f"{self.name}: {model.label}, {repeat + 1} of {self.values['repeats']}: "
                           f"{measured.steps / measured.wall:.0f} steps a second, {measured.steps / measured.cpu:.0f} a CPU "
                           f"second; {measured.lifted} of {self.values['simulations']} lifted")  # fmt: skip
        sections = [Section(text=self._text(version, chosen, len(excluded))), Section(table=self._summary(models, results))]
        return Outcome(self._cases(models, results), sections)

    def _models(self, robot: Robot, urdf: Path) -> list[_Model]:
        assert self.method is not None
        models = [_Model("original", {})]
        for budget in self.spheres:
            model = made(urdf, self.method, budget, fresh=True).model
            models.append(_Model("", {link: elements.spheres for link, elements in model.items()}))
            models[-1].label = f"{models[-1].count} spheres"
        return models

    def _excluded(self, robot: Robot, models: list[_Model]) -> list[tuple[str, str]]:
        """The pairs that the self-collision matrix of any of the sphere models leaves out: the same for all models."""
        pairs = set()
        for model in models[1:]:
            matrix = self_collision(robot, model.spheres, samples=10000, proof_boxes=2000, pose=self.motion[0].joints)
            pairs |= {(first, second) for first, second, _ in matrix.ignored()}
        return sorted(pairs)

    def _request(self, robot: Robot) -> dict[str, Any]:
        """Return what the program is asked, but for the scene."""
        controls = moving(robot)
        moments: list[dict[str, Any]] = []
        values: dict[str, float] = {}
        for moment in self.motion:
            values |= moment.joints
            by_name = dict(zip((joint.name for joint in robot.joints), robot._core.joint_values(values)))
            moments.append({"time": moment.time, "controls": [by_name[joint.name] for joint in controls]})
        spread = self.values["spread"]
        offsets = np.random.default_rng(0).uniform(-spread, spread, (self.values["simulations"], 2))
        return {
            "object": "object", "fingers": self.fingers, "motion": moments,
            "steps": round(self.motion[-1].time / self.values["timestep"]),
            "start": [*moments[0]["controls"], *self.object.center, 1, 0, 0, 0],
            "offsets": offsets.tolist(), "threads": self.threads,
        }  # fmt: skip

    def _measured(self, program: Path, request: dict[str, Any], model: _Model) -> tuple[str, _Measurement]:
        try:
            (answer,) = answers(program, request)
        except Error as error:
            raise error_of(error.code, f"the model '{model.label}': {error}") from None
        simulations = answer["simulations"]
        lifts = [one["lift_m"] for one in simulations]
        warnings = sum(one["warnings"] for one in simulations)
        if warnings:
            raise InputError(f"the model '{model.label}': MuJoCo warns {warnings} times of a simulation that is not valid: "
                             "too many contacts, or one that goes to pieces")  # fmt: skip
        return answer["version"], _Measurement(
            answer["steps"], answer["wall_s"], answer["cpu_s"],
            sum(one["contacts"] for one in simulations) / answer["steps"],
            sum(one["both_fingers"] for one in simulations), sum(lift >= self.values["lift"] for lift in lifts),
            sum(lifts) / len(lifts),
        )  # fmt: skip

    def _cases(self, models: list[_Model], results: list[list[_Measurement]]) -> Any:
        rows = [[model.label, str(model.count), str(repeat), str(one.steps), f"{one.wall:.4f}", f"{one.cpu:.4f}",
                 f"{one.steps / one.wall:.1f}", f"{one.steps / one.cpu:.1f}", f"{one.contacts:.3f}", str(one.gripped),
                 str(one.lifted), f"{one.lift:.4f}"]
                for model, done in zip(models, results) for repeat, one in enumerate(done, 1)]  # fmt: skip
        return table(["model", "spheres", "repeat", "steps", "wall_seconds", "cpu_seconds", "steps_per_s", "steps_per_cpu_s",
                      "contacts_per_step", "gripped", "lifted", "mean_lift_m"], rows)  # fmt: skip

    def _summary(self, models: list[_Model], results: list[list[_Measurement]]) -> Any:
        speeds = [(mean_of([one.steps / one.wall for one in done]), mean_of([one.steps / one.cpu for one in done]))
                  for done in results]  # fmt: skip
        rows = []
        for model, done, means in zip(models, results, speeds):
            last = done[-1]
            compared = [cell for mean, first in zip(means, speeds[0]) for cell in (
                _with_error(mean), f"{100 * (mean.value / first.value - 1):+.0f} %")]  # fmt: skip
            rows.append([model.label, *compared, f"{last.contacts:.1f}",
                         *(f"{count} of {self.values['simulations']}" for count in (last.gripped, last.lifted))])  # fmt: skip
        return table(["model", "steps a second", "of the original's", "steps a CPU second", "of the original's",
                      "contacts a step", "gripped", "lifted"], rows)  # fmt: skip

    def _text(self, version: str, chosen: str, excluded: int) -> str:
        values, box = self.values, self.object
        ignored = (f" No contact between the box and {', '.join(self.object_ignores)}, whose spheres reach to the fingertips in "
                   "coarse models." if self.object_ignores else "")  # fmt: skip
        size = " x ".join(f"{1e3 * edge:g}" for edge in box.size)
        return (
            f"{version} on {self.threads} threads. The robot is {chosen}. {values['simulations']} simulations of "
            f"{self.motion[-1].time:g} s in steps of {1e3 * values['timestep']:g} ms, side by side, each with memory of its own "
            f"for one model; {values['repeats']} repeat{'' if values['repeats'] == 1 else 's'}, the models in turn. Every "
            f"model follows the same position commands: it opens the fingers around a box of {size} mm and {box.mass:g} kg on "
            f"a plane, closes them and lifts. The box begins up to {1e3 * values['spread']:g} mm beside its place, at random, "
            f"the same for all models. Masses and inertias are the same for all. {excluded} pairs of links are not checked "
            f"against each other, in any model: those that the self-collision matrix of one of them leaves out.{ignored} "
            f"MuJoCo takes meshes as their convex hulls. Spheres by {self.method.label if self.method else ''}, grown to cover "
            "the original geometry. ± is the standard error of the mean. Steps a second go by the wall clock; where other "
            "programs ran beside, steps a CPU second tell more. Gripped: both fingers touch the box at the end; lifted: by at "
            f"least {1e3 * values['lift']:g} mm."
        )


def _with_error(mean: Mean) -> str:
    return f"{mean.value:.0f} ± {mean.error if mean.size > 1 else 0:.0f}"


def _read_vector(value: Value, key: str, low: float, findings: Findings) -> list[float] | None:
    """Return a list of three numbers; None after a finding."""
    example = f"{key}: [0.1, 0.1, 0.1]"
    if not expect_list(value, key, example, findings):
        return None
    if len(value.items) != 3:
        findings.error(
            value.where, "wrong-type", f"'{key}' expects three numbers, got {len(value.items)}; remedy: write {example}"
        )
        return None
    return [read_value(item, number(key, 0.1, low, 100, "m"), "", findings) or 0.0 for item in value.items]


def _read_object(value: Value, findings: Findings) -> GraspObject:
    result = GraspObject()
    if expect_map(value, "object", "object: {size: [0.03, 0.03, 0.1], position: [0.5, 0, 0], mass: 0.1}", findings):
        given = read_values(value, [number("mass", 0.1, 1e-6, 1e3, "kg")], "object", ["size", "position"], findings)
        result.mass = given.get("mass", result.mass)
        size, position = value.find("size"), value.find("position")
        result.size = (size and _read_vector(size, "size", 1e-4, findings)) or result.size
        result.position = (position and _read_vector(position, "position", -100, findings)) or result.position
    return result


def _read_motion(value: Value, findings: Findings) -> list[_Moment]:
    motion: list[_Moment] = []
    if not expect_list(value, "motion", _MOTION, findings):
        return motion
    for item in value.items:
        if not expect_map(item, "motion", "{time: 1, joints: {elbow: 0.5}}", findings):
            continue
        given = read_values(item, [number("time", 0, 0, 1e4, "s")], "motion", ["joints"], findings)
        moment = _Moment(given.get("time", 0.0))
        joints = item.find("joints")
        if joints is not None and expect_map(joints, "joints", "joints: {elbow: 0.5}", findings):
            for key, joint in joints.pairs():
                moment.joints[key.text] = read_value(joint, number(key.text, 0, -1e3, 1e3), "joints", findings) or 0.0
        if motion and moment.time <= motion[-1].time:
            findings.error(
                item.where, "out-of-order",
                f"'motion' expects ascending times, got {moment.time:g} after {motion[-1].time:g}",
            )  # fmt: skip
        motion.append(moment)
    if len(value.items) < 2:
        findings.error(value.where, "wrong-type", "'motion' expects at least two moments")
    return motion
