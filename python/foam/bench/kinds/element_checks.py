"""kind: element_checks. What a check of a pair of elements, and of a whole robot against itself, costs in collision libraries by
the kind of the elements."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from ..._robot import load
from ..engines import LABELS, Report, ask, read_engines
from ..experiment import Bench, Experiment, Outcome, Section, Source, short, table
from ..inputs import NamedRobot, for_each_found, read_robots
from ..models import made
from ..stages import Chain
from ..values import integer, number, required_counts

_VALUES = [
    integer("poses", 1000, 1, 1e6),
    integer("pairs", 32, 1, 1000),
    integer("repeats", 8, 1, 1e6),
    integer("seed", 0, 0, 1e15),
    number("time_limit", 600, 0.01, 1e7, "s"),
]


@dataclass
class _Case:
    """A robot's model by one method, and what engines say of its near pairs and of the whole."""

    robot: str
    method: str
    each: int  #: elements a link, at most
    pairs: int  #: near pairs of one query
    sizes: dict[str, Any] = field(default_factory=dict)
    near: dict[str, Report] = field(default_factory=dict)
    whole: dict[str, Report] = field(default_factory=dict)

    def pair_seconds(self, engine: str) -> float:
        """Return the median time of a check of a near pair."""
        return _median(self.near[engine].all_answers().collision_s) / self.pairs

    def whole_seconds(self, engine: str) -> float:
        """Return the median time of a check of the robot, with the movement of its links."""
        answers = self.whole[engine].all_answers()
        return _median(answers.move_s + answers.collision_s)


def _median(values: Any) -> float:
    return float(values.median()) if len(values) else math.nan


class ElementChecks(Experiment):
    """Times of collision checks by kind of element."""

    kind = "element_checks"

    def __init__(self, source: Source) -> None:
        self.values: Any = source.values(_VALUES, ["robots", "methods", "elements", "engines"])
        self.engines = read_engines(source.root.find("engines"), source.findings)
        self.robots = read_robots(source.root, source.findings, source.folder)
        #: The first is what the others are compared with.
        self.methods = source.stages.methods(source.root, "methods: [spherize.cover, approximate.capsules]")
        self.elements = required_counts(source.root, "elements", "elements: [1, 2]", 1, 1e4, source.findings)

    def stages(self) -> set[str]:
        return {name for method in self.methods for name in method.names}

    def run(self, bench: Bench) -> Outcome:
        cases: list[_Case] = []

        def use(robot: NamedRobot, _: str, urdf: Path) -> None:
            cases.extend(self._measured(bench, robot, urdf, method, each) for each in self.elements for method in self.methods)

        missing = for_each_found(self.name, self.robots, bench.tell, use)
        return self._told(_Times(cases), missing)

    def _measured(self, bench: Bench, robot: NamedRobot, urdf: Path, method: Chain, each: int) -> _Case:
        case = _Case(robot.name, method.label, each, self.values["pairs"])
        out = bench.scratch / "model"
        made(urdf, method, each * len(load(urdf).links_with_geometry), out, self.values["seed"])
        request = self.values | {"task": "elements", "urdf": str(urdf), "model": str(out / "model.json"),
                                 "engines": self.engines}  # fmt: skip
        for what, report in ask(request, bench.scratch, case.sizes.update):
            (case.near if what == "near" else case.whole)[report.engine] = report
            if what == "whole":
                bench.tell(f"{self.name}: {case.robot}, {case.method}, {case.sizes['elements']} elements, {report.engine}: "
                           f"{short(1e9 * case.pair_seconds(report.engine))} ns a near pair, "
                           f"{short(1e6 * case.whole_seconds(report.engine))} µs the robot")  # fmt: skip
        return case

    def _told(self, times: _Times, missing: list[str]) -> Outcome:
        first = times.cases[0].method
        return Outcome(self._cases(times), [
            Section(text=self._introduction(times, missing)),
            Section("A near pair", f"In multiples of {first}; median over robots and numbers of elements.",
                    table=self._summary(times, times.pair_ratio)),
            Section("The robot against itself", f"In multiples of {first} with as many elements a link.",
                    table=self._summary(times, times.whole_ratio)),
            Section("All times", table=self._all(times)),
        ])  # fmt: skip

    def _summary(self, times: _Times, ratio: Callable[[_Case, str], float]) -> Any:
        """The median of a ratio over all robots and numbers of elements, by method and engine."""
        rows = []
        for method in self.methods:
            cases = [case for case in times.cases if case.method == method.label]
            price = median(case.sizes["price"] for case in cases)
            rows.append([method.label, short(price), *(short(median(ratio(case, engine) for case in cases))
                                                       for engine in self.engines)])  # fmt: skip
        return table(["method", "cost by default", *(LABELS[engine] for engine in self.engines)], rows)

    def _all(self, times: _Times) -> Any:
        columns = [f"{LABELS[engine]}: {what}" for engine in self.engines for what in ("a near pair, ns", "the robot, µs")]
        rows = [[case.robot, case.method, str(case.sizes["elements"]), str(case.sizes["shape_pairs"]),
                 *(cell for engine in self.engines for cell in (
                     short(1e9 * case.pair_seconds(engine)), short(1e6 * case.whole_seconds(engine))))]
                for case in times.cases]  # fmt: skip
        return table(["robot", "method", "elements", "pairs", *columns], rows)

    def _cases(self, times: _Times) -> Any:
        rows = []
        for case in times.cases:
            for engine in self.engines:
                near, whole = case.near[engine], case.whole[engine]
                figures = [1e9 * case.pair_seconds(engine), times.pair_ratio(case, engine),
                           1e6 * case.whole_seconds(engine), times.whole_ratio(case, engine),
                           near.all_answers().hits_itself.mean(), whole.all_answers().hits_itself.mean()]  # fmt: skip
                rows.append([case.robot, case.method, str(case.each), str(case.sizes["elements"]),
                             str(case.sizes["shape_pairs"]), _number(case.sizes["price"]), engine, near.version,
                             *map(_number, figures), near.why_not or whole.why_not])  # fmt: skip
        return table(["robot", "method", "elements_per_link", "elements", "pairs", "mean_cost", "engine", "version",
                      "near_pair_ns", "near_pair_ratio", "robot_us", "robot_ratio", "near_pairs_in_contact",
                      "poses_in_contact", "remark"], rows)  # fmt: skip

    def _introduction(self, times: _Times, missing: list[str]) -> str:
        pairs, poses = self.values["pairs"], self.values["poses"]
        text = (
            "A *near pair* is two elements of the model in random poses: they do not touch, but the axis-aligned boxes around "
            f"them overlap, so that no broad phase drops them. {pairs} such pairs are checked at once, in {poses} "
            "arrangements. The check of *the robot* looks at every pair of links but neighbours, in "
            f"{poses} random configurations, does not stop at the first contact, and includes the movement of the links. All "
            "times are medians of CPU time on one thread, and include what the library does around the test of two shapes. "
            "Libraries know no swept boxes: they check the hull that foam writes for them; FCL takes hulls as its convex "
            "shapes. The cost by default is what `--cost` counts for such elements."
        )
        text += f" Left out, as no candidate is here: {', '.join(missing)}." if missing else ""
        for engine, report in times.cases[0].near.items():
            text += f" {LABELS[engine]} is not measured: {report.why_not}." if report.why_not else ""
        return text


@dataclass
class _Times:
    """All cases, and their times in multiples of the first method's with as many elements a link on the same robot."""

    cases: list[_Case]

    def _first(self, case: _Case) -> _Case:
        return next(other for other in self.cases if (other.robot, other.each) == (case.robot, case.each))

    def pair_ratio(self, case: _Case, engine: str) -> float:
        """Return that of a near pair."""
        return case.pair_seconds(engine) / self._first(case).pair_seconds(engine)

    def whole_ratio(self, case: _Case, engine: str) -> float:
        """Return that of the robot."""
        return case.whole_seconds(engine) / self._first(case).whole_seconds(engine)


def _number(value: float) -> str:
    return f"{value:.4g}" if math.isfinite(value) else ""
