"""kind: program_against_size. CPU time and memory of whole runs of `foam spherize` against triangles or spheres."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from ...errors import GeometryError
from ..experiment import Bench, Experiment, Outcome, Section, Source, short, table
from ..growth import growth_text, labelled
from ..inputs import read_candidates
from ..plots import Panel, Plot, Series
from ..programs import Measured, foam_program, run_measured
from ..references import read_reference_list
from ..sized_mesh import sized
from ..values import expect_map, integer, number, read_counts, required, required_counts


@dataclass
class _Run:
    """One mesh by one call with one number of spheres."""

    triangles: int
    spheres: int
    repeats: list[Measured] = field(default_factory=list)
    excess: float = 0
    certified: bool = False
    left_out: str = ""  #: why it was not measured

    def median(self, quantity: Callable[[Measured], float]) -> float:
        """Return the median over the repeats."""
        return median(map(quantity, self.repeats))


def _seconds(run: Measured) -> float:
    return run.cpu_seconds


def _megabytes(run: Measured) -> float:
    return 1e-6 * run.memory


class ProgramAgainstSize(Experiment):
    """CPU times and memory of runs."""

    kind = "program_against_size"

    def __init__(self, source: Source) -> None:
        root, findings = source.root, source.findings
        values: Any = source.values(
            [integer("repeats", 3, 1, 1000), number("time_limit", 60, 0.001, 1e6, "s")],
            ["mesh", "triangles", "spheres", "curves", "references"],
        )
        self.repeats, self.time_limit = values["repeats"], values["time_limit"]
        self.mesh = read_candidates(required(root, "mesh", "mesh: FILE", findings), "mesh", findings, source.folder)
        triangles = root.find("triangles")
        #: One of the two has one number; no triangles: the mesh as it is.
        self.triangles = [] if triangles is None else read_counts(triangles, "triangles", 4, 2e7, findings)
        self.spheres = required_counts(root, "spheres", "spheres: [8]", 1, 1e6, findings)
        spheres = root.find("spheres")
        if spheres is not None and len(self.spheres) > 1 and len(self.triangles) > 1:
            findings.error(
                spheres.where, "conflict",
                "several numbers of triangles and of spheres; remedy: two experiments, each with one of them",
            )  # fmt: skip
        self.curves = _read_curves(source)
        self.references = read_reference_list(root.find("references"), findings, source.folder)

    def stages(self) -> set[str]:
        return set()

    def run(self, bench: Bench) -> Outcome:
        chosen, sizes = self._write_meshes(bench)
        curves = {label: self._measured(bench, label, settings, sizes) for label, settings in self.curves.items()}
        outcome = Outcome(_cases(curves), [Section(text=self._method(chosen))])
        self._add_section("CPU time", "CPU s", "time.svg", _seconds, curves, outcome)
        self._add_section("Memory", "MB", "memory.svg", _megabytes, curves, outcome)
        rows = [[label, *(f"{run.excess:.3f}{'' if run.certified else ' (not certified)'}" if run.repeats else run.left_out
                          for run in runs)] for label, runs in curves.items()]  # fmt: skip
        text = "All are certified, unless a number says otherwise."
        outcome.sections.append(Section("Excess", text, table=table(self._columns("excess", curves), rows)))
        return outcome

    def _write_meshes(self, bench: Bench) -> tuple[str, list[int]]:
        """Write the mesh in each number of triangles; return the reference that was taken, and the numbers."""
        chosen, mesh = self.mesh.mesh()
        sizes = []
        for count in self.triangles or [len(mesh.faces)]:
            made = sized(mesh, count) if self.triangles else mesh
            made.export(_file_of(bench, len(made.faces)))
            sizes.append(len(made.faces))
        return chosen, sizes

    def _measured(self, bench: Bench, label: str, settings: list[str], sizes: list[int]) -> list[_Run]:
        runs: list[_Run] = []
        over = False
        for run in [_Run(triangles, spheres) for triangles in sizes for spheres in self.spheres]:
            runs.append(run)
            if over:
                run.left_out = "left out"
                continue
            self._repeat(bench, label, settings, run)
            over = not run.repeats or run.repeats[0].cpu_seconds > self.time_limit
            what = f"{short(run.median(_seconds))} s" if run.repeats else run.left_out
            bench.tell(f"{self.name}: {label}, {run.triangles} triangles, {run.spheres} spheres: {what}")
        return runs

    def _repeat(self, bench: Bench, label: str, settings: list[str], run: _Run) -> None:
        """Measure as often as the time limit over all repeats allows."""
        command = [foam_program(), "spherize", str(_file_of(bench, run.triangles)), "-n", str(run.spheres), "-j", "1",
                   "--fresh", "--json", "-o", str(bench.scratch / "spheres.json"), "--force"]  # fmt: skip
        command += [word for setting in settings for word in ("--set", setting)]
        while len(run.repeats) < self.repeats and sum(map(_seconds, run.repeats)) <= self.time_limit:
            done = run_measured(command, self.time_limit, bench.scratch)
            if done.over_limit:
                run.left_out = "" if run.repeats else f"over {self.time_limit:g} s"
                return
            if done.exit_code != 0:
                raise GeometryError(f"{label}, {run.triangles} triangles, {run.spheres} spheres: exit code "
                                    f"{done.exit_code}: {done.errors}")  # fmt: skip
            summary = json.loads(done.output)
            run.excess, run.certified = summary["total"]["excess"], summary["certified"]
            run.repeats.append(done)

    def _method(self, chosen: str) -> str:
        taken = ("; simplify.quadric takes it down to a number of triangles, splitting longest edges takes it up"
                 if self.triangles else "")  # fmt: skip
        text = (
            f"The mesh is {chosen}{taken}. Each measurement is a process `foam spherize` of its own, from the start to the "
            "written file, with its proof, on one thread and without the cache, up to "
            f"{self.repeats} times: the median of its CPU seconds, user and system, and of the most memory that was "
            f"resident. A case that takes more than {self.time_limit:g} s is the last of its curve. Growth is the exponent "
            "of n in the law fitted by least squares to the logarithms, over the sizes from a tenth of the curve's largest "
            "on."
        )
        return text + "".join(f" {label}: {', '.join(given) or 'as it is'}." for label, given in self.curves.items())

    def _size(self, run: _Run) -> int:
        return run.spheres if len(self.spheres) > 1 else run.triangles

    def _columns(self, first: str, curves: dict[str, list[_Run]]) -> list[str]:
        return [first, *(str(self._size(run)) for run in next(iter(curves.values())))]

    def _add_section(
        self, title: str, unit: str, figure: str, quantity: Callable[[Measured], float], curves: dict[str, list[_Run]],
        outcome: Outcome,
    ) -> None:  # fmt: skip
        rows, series, notes = [], [], []
        for label, runs in curves.items():
            points = [(float(self._size(run)), run.median(quantity)) for run in runs if run.repeats]
            cells = [short(run.median(quantity)) if run.repeats else run.left_out for run in runs]
            rows.append([label, *cells, growth_text(points)])
            series.append(Series(labelled(label, points), points))
        for reference in self.references if quantity is _seconds else []:
            note, line = reference.drawn()
            notes.append(note)
            series += line
        columns = [*self._columns(unit, curves), "growth"]
        outcome.sections.append(Section(title, " ".join(notes), figure, table(columns, rows)))
        x = "spheres" if len(self.spheres) > 1 else "triangles"
        outcome.plots[figure] = Plot(self.title, x, f"{title}, {unit}", [Panel(series)])


def _file_of(bench: Bench, triangles: int) -> Path:
    return bench.scratch / f"mesh_{triangles}.stl"


def _cases(curves: dict[str, list[_Run]]) -> Any:
    rows = []
    for label, runs in curves.items():
        for run in runs:
            figures = ["", "", "", ""]
            if run.repeats:
                figures = [f"{run.median(_seconds):.3f}", f"{run.median(_megabytes):.1f}", f"{run.excess:.4f}",
                           "yes" if run.certified else "no"]  # fmt: skip
            rows.append([label, str(run.triangles), str(run.spheres), *figures, str(len(run.repeats)), run.left_out])
    return table(["curve", "triangles", "spheres", "cpu_seconds", "memory_mb", "excess", "certified", "repeats", "remark"],
                 rows)  # fmt: skip


def _read_curves(source: Source) -> dict[str, list[str]]:
    """Return the settings of each curve, as --set takes them, from {LABEL: {key.path: value, …}}."""
    example, findings = "curves: {normal: {}, fast: {stages.spherize.cover.effort: fast}}", source.findings
    value = required(source.root, "curves", "curves: {normal: {}}", findings)
    if value is None or not expect_map(value, "curves", example, findings):
        return {}
    if not value.keys:
        findings.error(value.where, "wrong-type", "'curves' expects at least one curve")
    curves = {}
    for key, settings in value.pairs():
        if expect_map(settings, key.text, "fast: {stages.spherize.cover.effort: fast}", findings):
            curves[key.text] = [f"{name.text}={item.text}" for name, item in settings.pairs()]
    return curves
