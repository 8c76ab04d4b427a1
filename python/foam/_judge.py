"""Figures, proofs and pairs of links: foam.evaluate() and its relatives."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from . import _core
from ._cover import _seed
from ._model import model_of
from ._plugins import registry
from ._results import Certificate, Evaluation, SelfCollision
from ._robot import Robot, load
from .errors import UsageError


def robot_of(robot: Any) -> Robot:
    """Return a robot, or that of a file."""
    return robot if isinstance(robot, Robot) else load(robot)


def evaluate(robot: Any, spheres: Any, *, seed: int = 0, rename: Mapping[str, str] | None = None) -> Evaluation:
    """Return the figures of a sphere model of any program, as `foam evaluate` does.

    Args:
        robot: a Robot, or the file of a robot or a mesh.
        spheres: a SphereModel, a file that foam reads, {link: rows}, or for one link rows of x, y, z, r or a Cover.
        seed: of the samples.
        rename: old and new names (or beginnings of names) of links.
    """
    of = robot_of(robot)
    file = model_of(spheres, of)._sphere_file()
    return Evaluation(json.loads(_core.evaluate(of._core, file, list((rename or {}).items()), _seed(seed))))


def certify(
    robot: Any, spheres: Any, *, guarantee: str = "outer", rename: Mapping[str, str] | None = None
) -> Certificate:
    """Return the proof that the geometry lies inside the spheres ("outer"), or they inside it ("inner").

    Arguments as of evaluate().
    """
    if guarantee not in ("outer", "inner"):
        raise UsageError(f"guarantee: outer or inner is expected, got '{guarantee}'")
    of = robot_of(robot)
    file = model_of(spheres, of)._sphere_file()
    return Certificate(json.loads(_core.certify(of._core, file, list((rename or {}).items()), guarantee == "outer")))


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
        robot: a Robot, or its URDF.
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
        of._core, file, spheres_per_link, words, dict(pose or {}), samples, confidence, _seed(seed), proof_boxes
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
        raise UsageError(f"unknown stage '{stage}'" + (f"; did you mean '{near[0]}'?" if near else "; see foam.stages()"))
    return known[stage]


def plugins() -> list[dict[str, Any]]:
    """Return the plugin files: name, version, license, stages, and why one was refused."""
    found: list[dict[str, Any]] = json.loads(_core.plugins(registry()))
    return found
