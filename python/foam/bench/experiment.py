"""What an experiment is, what it may use while it runs, and what it hands back."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

import pandas  # type: ignore

from .findings import Findings
from .plots import Plot
from .stages import Reader
from .tree import Value
from .values import Parameter, read_values

#: The keys that all kinds share.
SHARED_KEYS = ["foam_experiment", "name", "title", "kind"]


@dataclass
class Source:
    """The text of an experiment while it is read."""

    root: Value
    stages: Reader
    findings: Findings
    folder: Path  #: relative references start here

    def values(self, declared: list[Parameter], structures: list[str]) -> dict[str, object]:
        """Return the plain values of a kind, with their defaults; a finding for each key that is neither among them, nor
        among `structures`, nor shared."""
        given = read_values(self.root, declared, "", [*structures, *SHARED_KEYS], self.findings)
        return {parameter.name: given.get(parameter.name, parameter.default) for parameter in declared}


@dataclass
class Bench:
    """Belongs to one run of an experiment. Experiments measure one thing at a time."""

    tell: Callable[[str], None]  #: a line for people who wait
    scratch: Path  #: a folder for files that measurements need; gone at the end


@dataclass
class Section:
    """A part of results.md; what is empty is left out."""

    title: str = ""
    text: str = ""
    figure: str = ""  #: file name
    table: pandas.DataFrame | None = None  #: of texts


@dataclass
class Outcome:
    """The results."""

    cases: pandas.DataFrame  #: results.csv: a row for each measurement
    sections: list[Section] = field(default_factory=list)
    plots: dict[str, Plot] = field(default_factory=dict)  #: by file name
    pictures: dict[str, bytes] = field(default_factory=dict)  #: other figures, encoded


class Experiment(ABC):
    """A checked experiment, ready to run. Each kind derives from it."""

    kind: ClassVar[str]

    file: Path
    source: str  #: its text
    name: str
    title: str

    @abstractmethod
    def __init__(self, source: Source) -> None:
        """Read the keys of the kind. What is wrong is a finding; the experiment is then not used."""

    @abstractmethod
    def stages(self) -> set[str]:
        """Return the names of all stages that it measures."""

    @abstractmethod
    def run(self, bench: Bench) -> Outcome:
        """Run the measurements. Raises Error naming stage and input."""


def short(value: float) -> str:
    """Return "0.0123": three digits that count, at most six behind the point; "–" for what is not finite."""
    if not math.isfinite(value):
        return "–"
    magnitude = 0 if value == 0 else math.floor(math.log10(abs(value)))
    return f"{value:.{min(max(2 - magnitude, 0), 6)}f}"


def table(columns: list[str], rows: list[list[str]]) -> pandas.DataFrame:
    """Return a table of texts."""
    return pandas.DataFrame(rows, columns=columns, dtype=str)
