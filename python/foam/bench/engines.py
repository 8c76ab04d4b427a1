"""Collision libraries: their names, what they are asked, and what they answer."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas  # type: ignore

from .findings import Findings, in_quotes, suggestion
from .programs import answers, engine_program
from .tree import Value
from .values import read_texts

#: Labels by name.
LABELS = {"fcl": "FCL", "fcl_pairs": "FCL, pair by pair", "bullet": "Bullet", "mujoco": "MuJoCo"}

ABORTED = 2
_ANSWERED = 1
_COLUMNS = ["state", "hits_obstacle", "hits_itself", "move_s", "collision_s", "distance_s", "distance_m"]


@dataclass
class Report:
    """What an engine says to queries about two models of a robot. Times in CPU s of one thread."""

    engine: str
    version: str = ""
    why_not: str = ""  #: why there are no answers; empty if there are
    aborts: list[str] = field(default_factory=list)  #: how the process ended, once for each that did not end well
    #: Of each query, for the first and for the second model.
    models: tuple[pandas.DataFrame, pandas.DataFrame] = field(default_factory=lambda: (answer_table([]), answer_table([])))

    @property
    def label(self) -> str:
        """The name for people."""
        return LABELS[self.engine]

    def answered(self) -> pandas.DataFrame:
        """Return the queries that both models were asked, with columns of both: state_0, state_1, …."""
        first, second = self.models
        both = first.join(second, lsuffix="_0", rsuffix="_1")
        return both[(both.state_0 == _ANSWERED) & (both.state_1 == _ANSWERED)]

    def all_answers(self) -> pandas.DataFrame:
        """Return the answers about both models, one behind the other."""
        both = pandas.concat(self.models, ignore_index=True)
        return both[both.state == _ANSWERED]


def answer_table(rows: Any) -> pandas.DataFrame:
    """Return the answers of an engine, as it gives them, as a table with conditions."""
    table = pandas.DataFrame(np.asarray(rows, dtype=float).reshape(-1, len(_COLUMNS)), columns=_COLUMNS)
    return table.astype({"state": int, "hits_obstacle": bool, "hits_itself": bool})


def _report_of(answer: dict[str, Any]) -> Report:
    rows = np.fromfile(answer["file"]).reshape(-1, 2, len(_COLUMNS))
    Path(answer["file"]).unlink()
    models = (answer_table(rows[:, 0]), answer_table(rows[:, 1]))
    return Report(answer["engine"], answer["version"], answer["why_not"], answer["aborts"], models)


def ask(request: dict[str, Any], scratch: Path, told: Callable[[dict[str, Any]], None]) -> Iterator[tuple[str, Report]]:
    """Ask the engines; give "queries", "near" or "whole" and the report of each, as soon as it is there.

    Args:
        request: the task "robots" or "elements" with the keys that apps/bench/engines/queries.cpp reads: `urdf` and
            `model`, files; `seed`; `time_limit`, CPU s of an engine. Robots: `distances`, a number of queries that ask for
            distances, by engine; `queries`, `environments`, `obstacles`; `smallest` and `largest` of these, m. Elements:
            `engines`, `poses`, `pairs`, `repeats`.
        told: is called with the sizes of the models, before the reports.
    """
    program = engine_program("foam-engine-queries", "in a clone, run `./foam bench`, which builds it")
    for answer in answers(program, request | {"folder": str(scratch)}):
        if "engine" in answer:
            yield answer["what"], _report_of(answer)
        else:
            told(answer)


def read_engines(value: Value | None, findings: Findings) -> list[str]:
    """Return names of engines, none twice; all where there is no value."""
    known = list(LABELS)
    if value is None:
        return known
    names = read_texts(value, "engines", findings)
    places = [item.where for item in value.as_list()]
    for index, (name, where) in enumerate(zip(names, places)):
        if name not in known:
            findings.error(
                where, "unknown-choice",
                f"'engines' holds {', '.join(known)}, got {in_quotes(name)}{suggestion(name, known)}",
            )  # fmt: skip
        elif name in names[:index]:
            findings.error(where, "twice", f"'engines' holds {in_quotes(name)} twice")
    return names
