"""kind: quality_against_spheres. What spherizers make of whole robots with ever more spheres a link, judged by the figures
of the run on the original geometry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..._results import Figures
from ..._runs import Run, run
from ..experiment import Bench, Experiment, Outcome, Section, Source, short, table
from ..inputs import NamedRobot, for_each_found, read_robots
from ..plots import Panel, Plot, Series
from ..stages import Chain
from ..values import number, required_counts

#: From the files to covering spheres.
_PHASES = {"reading", "filters", "spheres", "growth"}


@dataclass
class _Case:
    """One method on one robot at one number of spheres."""

    per_link: int
    figures: Figures
    seconds: float  #: CPU


@dataclass
class _Result:
    robot: NamedRobot
    chosen: str  #: the reference that was taken
    curves: dict[str, list[_Case]]  #: by the label of the method

    def cases(self) -> list[_Case]:
        """Return the cases of all methods."""
        return [case for cases in self.curves.values() for case in cases]


_QUANTITIES: dict[str, tuple[str, Callable[[_Case], float]]] = {
    "excess.svg": ("excess", lambda case: case.figures.excess),
    "protrusion.svg": ("mean protrusion, mm", lambda case: 1e3 * float(case.figures.protrusion_mean_m)),
    "cpu.svg": ("CPU time, s", lambda case: case.seconds),
}


def _seconds(done: Run) -> float:
    phases = done.manifest["execution"]["phases"]
    return sum(float(phase["cpu_seconds"]) for phase in phases if phase["phase"] in _PHASES)


class QualityAgainstSpheres(Experiment):
    """Excess, protrusion and CPU times of models."""

    kind = "quality_against_spheres"

    def __init__(self, source: Source) -> None:
        values: Any = source.values(
            [number("time_limit", 60, 0.001, 1e6, "s")], ["robots", "filters", "methods", "spheres"]
        )
        self.time_limit = values["time_limit"]
        self.robots = read_robots(source.root, source.findings, source.folder)
        self.filters = source.stages.filters(source.root.find("filters"), "filters")
        self.methods = source.stages.methods(source.root, "methods: [spherize.grid]")
        self.spheres = required_counts(source.root, "spheres", "spheres: [1, 2, 4, 8]", 1, 1e5, source.findings)

    def stages(self) -> set[str]:
        return {call.stage for call in self.filters} | {name for method in self.methods for name in method.names}

    def run(self, bench: Bench) -> Outcome:
        results: list[_Result] = []

        def use(robot: NamedRobot, chosen: str, file: Path) -> None:
            curves = {method.label: self._measured(bench, robot, file, method) for method in self.methods}
            results.append(_Result(robot, chosen, curves))

        missing = for_each_found(self.name, self.robots, bench.tell, use)
        outcome = Outcome(_cases(results), [Section(text=self._method(results, missing))])
        for file_name, (label, quantity) in _QUANTITIES.items():
            panels = [Panel([Series(method, [(case.per_link, quantity(case)) for case in cases])
                             for method, cases in result.curves.items()], result.robot.name)
                      for result in results]  # fmt: skip
            outcome.plots[file_name] = Plot(self.title, "spheres a link, at most", label, panels, self.spheres)
            for first, result in enumerate(results):
                outcome.sections.append(Section(
                    "" if first else label, figure="" if first else file_name,
                    table=self._table(label, quantity, result),
                ))  # fmt: skip
        return outcome

    def _measured(self, bench: Bench, robot: NamedRobot, file: Path, method: Chain) -> list[_Case]:
        stages = [{call.stage: call.given} for call in self.filters] + method.of_recipe()
        cases: list[_Case] = []
        for count in self.spheres:
            recipe = {"foam": 1, "name": "robot", "robot": {"urdf": str(file)}, "stages": stages,
                      "links": {"*": {"max_spheres": count}}}  # fmt: skip
            done = run(recipe, out=bench.scratch / "run", fresh=True)
            cases.append(_Case(count, done.total, _seconds(done)))
            bench.tell(f"{self.name}: {robot.name}, {method.label}, {count} a link: {done.total.spheres} spheres, excess "
                       f"{short(done.total.excess)}, {short(cases[-1].seconds)} s")  # fmt: skip
            if cases[-1].seconds > self.time_limit:
                break
        return cases

    def _table(self, label: str, quantity: Callable[[_Case], float], result: _Result) -> Any:
        rows = []
        for method, cases in result.curves.items():
            cells = [short(quantity(case)) for case in cases]
            rows.append([method, *cells, *["left out"] * (len(self.spheres) - len(cells))])
        return table([f"{result.robot.name}: {label}", *map(str, self.spheres)], rows)

    def _method(self, results: list[_Result], missing: list[str]) -> str:
        all_cases = [case for result in results for case in result.cases()]
        certified = sum(case.figures.certified for case in all_cases)
        gap = max(case.figures.gap_m for case in all_cases)
        text = " ".join(f"{result.robot.name} is {result.chosen}." for result in results)
        text += f" Left out, as no candidate is here: {', '.join(missing)}." if missing else ""
        text += (" Every link gets at most the number of spheres that stands on the axis, and spheres are grown to cover "
                 "the original geometry.")  # fmt: skip
        text += f" Before every method: {', '.join(map(str, self.filters))}." if self.filters else ""
        return text + (
            f" Of the {len(all_cases)} models {certified} are certified, the largest gap is {short(gap)} m. Excess is the "
            "volume of the spheres outside the robot in units of the robot's; protrusion is the distance of the spheres' "
            "exposed surface from the robot. Times are CPU seconds of the process, user and system, over all its threads, "
            "from the files to covering spheres, without measuring; a case that takes more than "
            f"{self.time_limit:g} s is the last of its curve."
        )


def _cases(results: list[_Result]) -> Any:
    rows = []
    for result in results:
        for method, cases in result.curves.items():
            for case in cases:
                f = case.figures
                figures = [f.excess, f.excess_standard_error, f.protrusion_max_m, f.protrusion_mean_m, f.gap_m, f.covered]
                rows.append([result.robot.name, method, str(case.per_link), str(f.spheres),
                             *(f"{figure:.6g}" for figure in figures), "yes" if f.certified else "no",
                             f"{case.seconds:.4f}"])  # fmt: skip
    return table(["robot", "method", "spheres_per_link", "spheres", "excess", "excess_standard_error", "protrusion_max_m",
                  "protrusion_mean_m", "gap_m", "covered", "certified", "cpu_seconds"], rows)  # fmt: skip
