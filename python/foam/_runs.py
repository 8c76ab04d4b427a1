"""Recipes: foam.run() and foam.check()."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, cast

import numpy as np

from . import _core
from ._arguments import limit_of
from ._events import Progress, teller
from ._installation import program
from ._model import SphereModel
from ._plugins import registry
from ._results import Figures
from ._robot import Robot, warn_of
from ._words import Severity
from .errors import InputError, UsageError


class Finding(NamedTuple):
    """A finding of foam.check()."""

    severity: Severity  #: error or warning
    file: str
    line: int
    column: int
    message: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.severity}: {self.message}"


class Run:
    """A run of a recipe."""

    def __init__(self, summary: dict[str, Any], model: SphereModel, out: Path | None) -> None:
        self.name: str = summary["name"]
        self.summary = summary  #: as `foam run --json` prints it
        self.model = model
        self.directory = out  #: the run directory; None: nothing was written

    @property
    def certified(self) -> bool:
        """Whether the guarantee is proved for all links."""
        return bool(self.summary["certified"])

    @property
    def statement(self) -> str:
        """The verdict in words, as the command line says it and files have it in their headers."""
        return str(self.summary["proof"]["statement"])

    @property
    def total(self) -> Figures:
        """The figures of the whole robot."""
        return Figures(self.summary["total"])

    @property
    def outputs(self) -> list[Path]:
        """The files of the run."""
        return [] if self.directory is None else [self.directory / file for file in self.summary["files"]]

    @property
    def manifest(self) -> dict[str, Any]:
        """The content of manifest.json. Raises UsageError if nothing was written."""
        if self.directory is None:
            raise UsageError("this run has written nothing; remedy: foam.run(…, out=\"folder\")")
        manifest: dict[str, Any] = json.loads((self.directory / "manifest.json").read_text())
        return manifest

    def __repr__(self) -> str:
        return f"<foam.Run '{self.name}': {self.model!r}>"


def settings_of(values: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return settings as texts of YAML, as --set takes them."""
    return [(key, value if isinstance(value, str) else json.dumps(_plain(value))) for key, value in values.items()]


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def run_all(
    recipes: _core.Recipes,
    out: Path | None,
    fresh: bool,
    time_limit: float | None,
    progress: Progress | None,
    cache: Path | None,
    robot: Robot | None = None,
) -> list[Run]:
    """Run checked recipes one after the other; on a robot that was read, or on what they name."""
    told = teller(progress)
    names, runs = recipes.names(), []
    for index, name in enumerate(names):
        folder = out if out is None or len(names) == 1 else out / name
        text, held = recipes.run(
            index, None if folder is None else str(folder), fresh, time_limit, program(),
            None if cache is None else str(cache), told, None if robot is None else robot._core,
        )  # fmt: skip
        summary = json.loads(text)
        warn_of(
            [f["message"] for f in summary["findings"] if f["severity"] in ("warning", "error")],
            summary["input"]["file"] if robot is None or robot._file_is_own else str(robot.file),
        )
        model = SphereModel._of_file(held.spheres(), None, name, summary)
        model._of_run = held
        model._recipes = recipes if len(names) == 1 else None
        runs.append(Run(summary, model, folder))
    return runs


def _source(recipe: Any) -> tuple[str | None, str]:
    """A recipe's file, or its text."""
    if isinstance(recipe, Mapping):
        return None, json.dumps(_plain(recipe))
    if isinstance(recipe, str) and "\n" in recipe:
        return None, recipe
    if not Path(recipe).is_file():
        raise InputError(f"{recipe}: there is no such file")
    return str(recipe), ""


def run_each(
    recipe: Any,
    *,
    set: Mapping[str, Any] | None = None,
    variants: Sequence[str] = (),
    out: str | os.PathLike[str] | None = None,
    fresh: bool = False,
    time_limit: float | None = None,
    progress: Progress | None = None,
    cache: str | os.PathLike[str] | None = None,
) -> list[Run]:
    """Run a recipe, as `foam run` does; return the run of each variant and of each value of its sweep.

    Args:
        recipe: a YAML file, its text (several lines), or a dictionary of the same keys.
        set: values to change, by key: {"budget.spheres": 60}.
        variants: names of variants.
        out: the run directory, for a sweep the folder of these; None: nothing is written, `.model` is the result.
        fresh: neither read nor write the cache.
        time_limit: seconds.
        progress: is called with each foam.Event, in this thread; an exception of it ends the run.
        cache: the folder of the cache.

    Raises:
        UsageError: all errors of the recipe, each with file, line and column. Error: a stage failed.
        KeyboardInterrupt: Ctrl-C; nothing is written.
    """
    file, text = _source(recipe)
    recipes = _core.Recipes(registry(), file, text, "recipe.yaml", settings_of(set or {}), list(variants))
    return run_all(
        recipes, None if out is None else Path(out), fresh, limit_of(time_limit), progress,
        None if cache is None else Path(cache),
    )  # fmt: skip


def run(
    recipe: Any,
    *,
    set: Mapping[str, Any] | None = None,
    variants: Sequence[str] = (),
    out: str | os.PathLike[str] | None = None,
    fresh: bool = False,
    time_limit: float | None = None,
    progress: Progress | None = None,
    cache: str | os.PathLike[str] | None = None,
) -> Run:
    """Run a recipe, as `foam run` does; return the run. Arguments and errors are those of run_each().

    For a sweep or several variants it returns a list, which type checkers do not know of: run_each() is for these.
    """
    runs = run_each(
        recipe, set=set, variants=variants, out=out, fresh=fresh, time_limit=time_limit, progress=progress, cache=cache
    )
    return runs[0] if len(runs) == 1 else cast(Run, runs)


def check(recipe: Any, *, set: Mapping[str, Any] | None = None, variants: Sequence[str] = ()) -> list[Finding]:
    """Return all findings of a recipe, as `foam check` lists them; none: it is right. Arguments as of run()."""
    file, text = _source(recipe)
    found = json.loads(_core.check(registry(), file, text, settings_of(set or {}), list(variants)))
    return [Finding(f["severity"], f["file"], f["line"], f["column"], f["message"]) for f in found["findings"]]
