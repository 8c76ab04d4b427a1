"""Models of robots by methods of an experiment."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._judge import certify, evaluate
from .._robot import load
from .._runs import Run, run
from .stages import Chain


def made(urdf: Path, method: Chain, count: int, out: Path | None = None, seed: int = 0, fresh: bool = False) -> Run:
    """Run a method on a robot with a budget of so many elements over the whole robot. `out`: the run's folder, which gets
    the model as model.json."""
    recipe: dict[str, Any] = {"foam": 1, "name": "robot", "seed": seed, "robot": {"urdf": str(urdf)},
                              "stages": method.of_recipe(), "budget": {"spheres": count}}  # fmt: skip
    if out is not None:
        recipe["outputs"] = [{"write.json": {"file": "model.json"}}]
    result: Run = run(recipe, out=out, fresh=fresh)
    return result


@dataclass
class JudgedFile:
    """A file of a model, and what is known of it."""

    file: Path
    excess: float
    certified: bool


def model_by(urdf: Path, method: Chain, count: int, out: Path, seed: int) -> JudgedFile:
    """Return a model that a run makes and judges."""
    done = made(urdf, method, count, out, seed)
    return JudgedFile(out / "model.json", done.total.excess, done.certified)


def given_model(urdf: Path, file: Path) -> JudgedFile:
    """Return a model of a file, judged. Links without elements do not count."""
    robot = load(urdf)
    evaluation, proof = evaluate(robot, file), certify(robot, file)
    with_elements = [link for link, figures in evaluation.links.items() if figures.spheres > 0]
    certified = all(proof.links[link] for link in with_elements)
    return JudgedFile(file, evaluation.with_spheres.excess, certified)
