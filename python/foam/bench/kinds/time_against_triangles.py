"""kind: time_against_triangles. CPU time of stages and chains of stages on one mesh in ever more triangles."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from signal import ITIMER_REAL, SIGALRM, setitimer, siginterrupt, signal
from statistics import median
from typing import Any

from ... import _core
from ..._mesh import Mesh
from ..._plugins import registry
from ...errors import Error, error_of
from ...utility import filtered
from ..experiment import Bench, Experiment, Outcome, Section, Source, short, table
from ..findings import in_quotes
from ..growth import growth_text, labelled
from ..inputs import read_candidates
from ..plots import Panel, Plot, Series
from ..references import read_reference_list
from ..sized_mesh import sized
from ..stages import ALL, Chain
from ..values import expect_map, integer, number, required, required_counts, why_no_file_name


class _OverLimit(Exception):
    """A case has used more CPU time than it may."""


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """End the work within by _OverLimit after so many CPU seconds of this process.

    A timer of CPU time would make the clock of CPU time coarse; so a few times a second the clock is looked at.
    """
    end = time.process_time() + seconds

    def look(*_: Any) -> None:
        if time.process_time() > end:
            raise _OverLimit

    before = signal(SIGALRM, look)
    siginterrupt(SIGALRM, False)
    setitimer(ITIMER_REAL, 0.05, 0.05)
    try:
        yield
    finally:
        setitimer(ITIMER_REAL, 0)
        signal(SIGALRM, before)


@dataclass
class _Case:
    """One chain on one mesh."""

    asked: int
    triangles: int
    seconds: list[float] = field(default_factory=list)  #: of each repeat
    left_out: str = ""  #: why there is no time


def _points(cases: list[_Case]) -> list[tuple[float, float]]:
    return [(case.triangles, median(case.seconds)) for case in cases if case.seconds]


class TimeAgainstTriangles(Experiment):
    """CPU times of stages."""

    kind = "time_against_triangles"

    def __init__(self, source: Source) -> None:
        root, findings = source.root, source.findings
        values: Any = source.values(
            [integer("repeats", 3, 1, 1000), number("time_limit", 10, 0.001, 1e6, "s"), integer("spheres", 8, 1, 1e6)],
            ["mesh", "prepare", "triangles", "figures", "references"],
        )
        self.repeats, self.time_limit, self.spheres = values["repeats"], values["time_limit"], values["spheres"]
        self.mesh = read_candidates(required(root, "mesh", "mesh: FILE", findings), "mesh", findings, source.folder)
        self.prepare = source.stages.filters(root.find("prepare"), "prepare")
        self.triangles = required_counts(root, "triangles", "triangles: [500, 1000, 2000]", 4, 1e7, findings)
        self.figures = _read_figures(source)
        self.references = read_reference_list(root.find("references"), findings, source.folder)

    def stages(self) -> set[str]:
        return {name for chains in self.figures.values() for chain in chains for name in chain.names}

    def run(self, bench: Bench) -> Outcome:
        chosen, meshes = self._meshes(bench)
        columns = ["figure", "curve", "triangles_wanted", "triangles", "cpu_seconds", "repeats", "remark"]
        rows = []
        outcome = Outcome(table(columns, []), [Section(text=self._method(chosen, meshes))])
        for name, chains in self.figures.items():
            curves = {chain.label: self._measured(bench, chain, meshes) for chain in chains}
            for label, cases in curves.items():
                for case in cases:
                    seconds = f"{median(case.seconds):.6f}" if case.seconds else ""
                    rows.append([name, label, str(case.asked), str(case.triangles), seconds, str(len(case.seconds)),
                                 case.left_out])  # fmt: skip
            self._add_section(name, curves, outcome)
        outcome.cases = table(columns, rows)
        return outcome

    def _meshes(self, bench: Bench) -> tuple[str, dict[int, Mesh]]:
        """Return the reference that was taken, and its mesh by the numbers of triangles that are wanted."""
        chosen, mesh = self.mesh.mesh()
        for call in self.prepare:
            mesh = filtered(mesh, call.stage, **call.given)
        meshes = {}
        for count in self.triangles:
            meshes[count] = sized(mesh, count)
            bench.tell(f"{self.name}: the mesh in {len(meshes[count].faces)} triangles, {count} wanted")
        return chosen, meshes

    def _measured(self, bench: Bench, chain: Chain, meshes: dict[int, Mesh]) -> list[_Case]:
        cases: list[_Case] = []
        over = False
        for asked, mesh in meshes.items():
            case = _Case(asked, len(mesh.faces), left_out="left out" if over else "")
            if not over:
                self._repeat(bench, chain, mesh, case)
                over = not case.seconds or case.seconds[0] > self.time_limit
                what = f"{short(median(case.seconds))} s" if case.seconds else case.left_out
                bench.tell(f"{self.name}: {chain.label}, {case.triangles} triangles: {what}")
            cases.append(case)
        return cases

    def _repeat(self, bench: Bench, chain: Chain, mesh: Mesh, case: _Case) -> None:
        """Measure as often as the time limit over all repeats allows."""
        while len(case.seconds) < self.repeats and sum(case.seconds) <= self.time_limit:
            try:
                case.seconds.append(self._once(bench.scratch, chain, mesh))
            except _OverLimit:
                case.left_out = "" if case.seconds else f"over {self.time_limit:g} s"
                return
            except Error as error:
                raise error_of(error.code, f"{chain.label}, {case.triangles} triangles: {error}") from None

    def _once(self, scratch: Path, chain: Chain, mesh: Mesh) -> float:
        """Return the CPU seconds of the chain: loaders read a file; a spherizer's time goes from the mesh in memory to
        spheres that are proved to cover it."""
        file = mesh.export(scratch / "mesh.stl") if chain.loader else None
        original = Mesh(mesh.vertices, mesh.faces)._core  # what it knows of its solid is not known to the next one
        with _limited(self.time_limit):
            begin = time.process_time()
            if chain.loader:
                original = _core.loaded(str(file), registry(), chain.loader.stage, chain.loader.given)
            current = original
            for call in chain.filters:
                current = _core.filtered(current, registry(), call.stage, call.given)
            if chain.spherizer:
                call, processed = chain.spherizer, None if current is original else current
                _core.covering(original, processed, registry(), call.stage, call.given, self.spheres)
            return time.process_time() - begin

    def _method(self, chosen: str, meshes: dict[int, Mesh]) -> str:
        prepared = "".join(f", then {call}" for call in self.prepare)
        text = (
            f"The mesh is {chosen}{prepared}; simplify.quadric takes it down to a number of triangles, splitting longest "
            f"edges takes it up. Every stage runs in this process, up to {self.repeats} times; a time is the median, in "
            "CPU seconds of the process, user and system, over all its threads. A case that takes more than "
            f"{self.time_limit:g} s is the last of its curve."
        )
        chains = [chain for chains in self.figures.values() for chain in chains]
        if any(chain.spherizer for chain in chains):
            text += (f" The time of a spherizer goes from the mesh in memory to at most {self.spheres} spheres that are "
                     "proved to cover it.")  # fmt: skip
        text += (" Growth is the exponent of the number of triangles n in the law fitted by least squares to the "
                 "logarithms, over the counts from a tenth of the curve's largest on.")  # fmt: skip
        given = sorted({str(call) for chain in chains for call in chain.calls if call.given})
        text += f" Parameters that are given: {', '.join(given)}." if given else ""
        if any(len(mesh.faces) > asked + 1 for asked, mesh in meshes.items()):
            text += f" The coarsest mesh has {len(next(iter(meshes.values())).faces)} triangles: its shape needs them."
        return text

    def _add_section(self, name: str, curves: dict[str, list[_Case]], outcome: Outcome) -> None:
        title = name if len(self.figures) > 1 else ""
        rows, series, notes = [], [], []
        for label, cases in curves.items():
            points = _points(cases)
            cells = [short(median(case.seconds)) if case.seconds else case.left_out for case in cases]
            rows.append([label, *cells, growth_text(points)])
            series.append(Series(labelled(label, points), points))
        for reference in self.references:
            note, line = reference.drawn()
            notes.append(note)
            series += line
        columns = ["CPU s", *map(str, self.triangles), "growth"]
        outcome.sections.append(Section(title, " ".join(notes), f"{name}.svg", table(columns, rows)))
        outcome.plots[f"{name}.svg"] = Plot(self.title, "triangles", "CPU time, s", [Panel(series)])


def _read_figures(source: Source) -> dict[str, list[Chain]]:
    """Return the curves of each picture, by the name of its file."""
    example, findings = "figures: {repair: [repair.soup]}", source.findings
    value = required(source.root, "figures", example, findings)
    if value is None or not expect_map(value, "figures", example, findings):
        return {}
    for key in value.keys:
        if why := why_no_file_name(key.text):
            findings.error(key.where, "bad-name", f"{in_quotes(key.text)} names the file of a figure, but {why}")
    if not value.keys:
        findings.error(value.where, "wrong-type", "'figures' expects at least one figure")
    return {key.text: source.stages.chains(item, key.text, ALL) for key, item in value.pairs()}
