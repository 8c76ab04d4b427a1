"""Figures, proofs and pairs of links: foam.evaluate() and its relatives."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from . import _core
from ._arguments import seed_of
from ._model import model_of
from ._plugins import registry
from ._results import Certificate, Comparison, Evaluation, SelfCollision
from ._robot import Robot, robot_of
from ._words import Proof
from .errors import UsageError


def _judged(text: str, robot: Robot) -> dict[str, Any]:
    """Return the JSON of a judgement; a robot in memory has the name that foam.load() gave it."""
    values: dict[str, Any] = json.loads(text)
    return values if robot._file_is_own else {**values, "original": str(robot.file)}


def evaluate(robot: Any, model: Any, *, seed: int = 0, rename: Mapping[str, str] | None = None) -> Evaluation:
    """Return the figures of a sphere model of any program, as `foam evaluate` does.

    Args:
        robot: a Robot, or whatever foam.load() takes: a file, a mesh, points, a URDF text, a mujoco.MjSpec….
        model: a SphereModel, a file that foam reads, {link: elements}, or for one link a Cover, or rows of x, y, z, r.
        seed: of the samples.
        rename: old and new names (or beginnings of names) of links.
    """
    of = robot_of(robot)
    file = model_of(model, of)._sphere_file()
    return Evaluation(_judged(_core.evaluate(of._core, file, list((rename or {}).items()), seed_of(seed)), of))


def certify(
    robot: Any, model: Any, *, guarantee: Proof = "outer", rename: Mapping[str, str] | None = None
) -> Certificate:
    """Return the proof that the geometry lies inside the elements ("outer"), or they inside it ("inner").

    Arguments as of evaluate().
    """
    if guarantee not in ("outer", "inner"):
        raise UsageError(f"guarantee: outer or inner is expected, got '{guarantee}'")
    of = robot_of(robot)
    file = model_of(model, of)._sphere_file()
    outer = guarantee == "outer"
    return Certificate(_judged(_core.certify(of._core, file, list((rename or {}).items()), outer), of))


def compare(
    robot: Any, models: Mapping[str, Any] | Iterable[Any], *, seed: int = 0, rename: Mapping[str, str] | None = None
) -> Comparison:
    """Return the figures of several models of one robot side by side, as `foam compare` does.

    Args:
        models: each as of evaluate(), by names of yours, or without names: these are then A, B, C….

    The other arguments are those of evaluate().
    """
    of = robot_of(robot)
    named = models if isinstance(models, Mapping) else {_label(i): model for i, model in enumerate(models)}
    if not named:
        raise UsageError("models: there is none; remedy: one or more")
    return Comparison({name: evaluate(of, model, seed=seed, rename=rename) for name, model in named.items()})


def _label(i: int) -> str:
    """A, B, …, Z, then 27, 28, …."""
    return chr(ord("A") + i) if i < 26 else str(i + 1)


def self_collision(
    robot: Any,
    spheres: Any = None,
    *,
    samples: int = 100_000,
    confidence: float = 0.95,
    seed: int = 0,
    pose: Mapping[str, float] | None = None,
    proof_boxes: int = 20_000,
    spheres_per_link: int = 32,
) -> SelfCollision:
    """Return the pairs of links that never need a collision check, proved or with a confidence bound.

    Args:
        robot: as of evaluate().
        spheres: a model as of evaluate(); None: collision spheres of the URDF as they are, and for other geometry
            certified models of at most `spheres_per_link` spheres.
        samples: random configurations for pairs without a proof.
        confidence: of the bound for pairs that no sample found in contact; above 0, below 1.
        seed: of the samples.
        pose: joint positions of the reference pose, rad or m.
        proof_boxes: boxes of joint positions in the proof for a pair; 0: no proofs.
        spheres_per_link: see `spheres`.
    """
    of = robot_of(robot)
    if not 1 <= spheres_per_link <= 1000:
        raise UsageError(f"spheres_per_link: 1 to 1000 are possible, got {spheres_per_link}")
    file = None if spheres is None else model_of(spheres, of)._sphere_file()
    words = "the given spheres" if file is not None else f"certified models of at most {spheres_per_link} spheres"
    text, srdf, curobo = _core.self_collision(
        of._core, file, spheres_per_link, words, dict(pose or {}), samples, confidence, seed_of(seed), proof_boxes
    )
    return SelfCollision(json.loads(text), srdf, curobo)


def stages() -> dict[str, dict[str, Any]]:
    """Return all stages by name, as `foam stages --json` prints them."""
    return {stage["name"]: stage for stage in json.loads(_core.stages(registry()))}


def describe(stage: str) -> dict[str, Any]:
    """Return a stage: its summary, its parameters with types, defaults and their source. Raises UsageError."""
    known = stages()
    if stage not in known:
        import difflib

        near = difflib.get_close_matches(stage, known, 1)
        raise UsageError(
            f"unknown stage '{stage}'" + (f"; did you mean '{near[0]}'?" if near else "; see foam.stages()")
        )
    return known[stage]


class Format(NamedTuple):
    """A format of sphere models."""

    name: str  #: SphereModel.save(format=…)
    reads: bool
    writes: bool
    extensions: list[str]  #: of files that are written in it
    summary: str


def formats() -> dict[str, Format]:
    """Return the formats of sphere models that are read and written, by name."""
    found: dict[str, Format] = {}
    known = stages()
    for name, stage in known.items():
        kind, format = name.partition(".")[::2]
        if kind in ("write", "read") and stage["kind"] in ("writer", "model reader"):
            writer = known.get(f"write.{format}")
            found[format] = Format(
                format,
                f"read.{format}" in known,
                writer is not None,
                writer["extensions"] if writer else [],
                stage["summary"],
            )
    return dict(sorted(found.items()))


def plugins() -> list[dict[str, Any]]:
    """Return the plugin files: name, version, license, stages, and why one was refused."""
    found: list[dict[str, Any]] = json.loads(_core.plugins(registry()))
    return found
