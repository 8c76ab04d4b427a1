"""kind: collision_queries. Collision checks and distances of whole robots among random obstacles, original geometry against
spheres, in several collision libraries: Table I of Coumar et al., "Foam: A Tool for Spherical Approximation of Robot
Geometry" (2025)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..engines import ask, read_engines
from ..experiment import Bench, Experiment, Outcome, Source, short
from ..findings import START, in_quotes, suggestion
from ..inputs import Candidates, for_each_found, read_candidates
from ..models import given_model, model_by
from ..query_tables import Robot, Setup, told
from ..statistics import compared
from ..tree import Value
from ..values import expect_map, integer, number, read_value, refuse_unknown_keys, required

_VALUES = [
    integer("queries", 100000, 1, 1e8),
    integer("environments", 100, 1, 1e5),
    integer("obstacles", 16, 1, 1e4),
    number("smallest", 0.05, 1e-4, 10, "m"),
    number("largest", 0.3, 1e-4, 10, "m"),
    integer("seed", 0, 0, 1e15),
    number("time_limit", 3600, 0.01, 1e7, "s"),
]


@dataclass(frozen=True)
class _RobotSource:
    """A robot, and its spheres: a number over the whole robot, or a file."""

    name: str
    candidates: Candidates
    count: int | None
    file: str


class CollisionQueries(Experiment):
    """Times and verdicts of collision libraries."""

    kind = "collision_queries"

    def __init__(self, source: Source) -> None:
        root, findings = source.root, source.findings
        self.values: Any = source.values(_VALUES, ["robots", "method", "engines", "distances"])
        smallest, largest = self.values["smallest"], self.values["largest"]
        if smallest > largest:
            findings.error(
                START, "out-of-order",
                f"'smallest' is {smallest:g} m and 'largest' {largest:g} m; remedy: the other way round",
            )  # fmt: skip
        self.values["environments"] = min(self.values["environments"], self.values["queries"])
        engines = read_engines(root.find("engines"), findings)
        asked = _read_distances(source, engines)
        self.distances = {engine: min(count, self.values["queries"]) for engine, count in asked.items()}
        self.method = source.stages.method(root, must=False)
        self.folder = source.folder
        self.robots = _read_robots(source)

    def stages(self) -> set[str]:
        return self.method.names if self.method else set()

    def run(self, bench: Bench) -> Outcome:
        robots: list[Robot] = []
        missing = for_each_found(self.name, self.robots, bench.tell,
                                 lambda *found: robots.append(self._measured(bench, *found)))  # fmt: skip
        return told(Setup(self.values, self.distances, self.method.label if self.method else "", robots, missing))

    def _measured(self, bench: Bench, robot: _RobotSource, chosen: str, urdf: Path) -> Robot:
        if robot.count is not None:
            assert self.method is not None
            model = model_by(urdf, self.method, robot.count, bench.scratch / "model", self.values["seed"])
        else:
            model = given_model(urdf, self.folder.absolute() / robot.file)
        result = Robot(robot.name, chosen, model.excess, model.certified)

        def sized(sizes: dict[str, Any]) -> None:
            result.sizes = sizes
            bench.tell(f"{self.name}: {robot.name}: {sizes['links']} links, {sizes['spheres']} spheres, "
                       f"{sizes['pairs']} pairs of links")  # fmt: skip

        request = self.values | {"task": "robots", "urdf": str(urdf), "model": str(model.file), "distances": self.distances}
        for _, report in ask(request, bench.scratch, sized):
            result.reports.append(report)
            where = f"{self.name}: {robot.name}, {report.engine}"
            if report.why_not:
                bench.tell(f"warning: {where}: {report.why_not}")
                continue
            times = compared(report)
            bench.tell(f"{where}: {times.queries} queries, collision {short(1e3 * times.collision.original.value)} ms, "
                       f"spheres {short(1e3 * times.collision.spheres.value)} ms")  # fmt: skip
        order = list(self.distances)
        result.reports.sort(key=lambda report: order.index(report.engine))
        return result


def _read_robots(source: Source) -> list[_RobotSource]:
    example, findings = "robots: {panda: {urdf: FILE.urdf, spheres: 60}}", source.findings
    value = required(source.root, "robots", example, findings)
    if value is None or not expect_map(value, "robots", example, findings):
        return []
    if not value.keys:
        findings.error(value.where, "wrong-type", "'robots' expects at least one robot")
    robots = [_read_robot(item, key.text, source) for key, item in value.pairs()]
    for robot, item in zip(robots, value.items):
        if robot.count is not None and source.root.find("method") is None:
            findings.error(
                item.where, "missing-key",
                f"{in_quotes(robot.name)} is to get {robot.count} spheres, but 'method' is missing; remedy: write method: "
                "spherize.medial",
            )  # fmt: skip
    return robots


def _read_robot(value: Value, name: str, source: Source) -> _RobotSource:
    """Return {urdf: FILE or [FILE, …], spheres: NUMBER or FILE}."""
    example, findings = f"{name}: {{urdf: FILE.urdf, spheres: 60}}", source.findings
    count, file = None, ""
    urdf = spheres = None
    if expect_map(value, name, example, findings):
        refuse_unknown_keys(value, name, ["urdf", "spheres"], findings)
        urdf, spheres = value.find("urdf"), value.find("spheres")
        for key, there, what in (("urdf", urdf, ""), ("spheres", spheres, ", how many or a file of them")):
            if there is None:
                findings.error(
                    value.where, "missing-key", f"{in_quotes(name)} needs '{key}'{what}; remedy: write {example}"
                )
    if spheres is not None and spheres.kind == "text":
        file = spheres.text
    elif spheres is not None:
        count = read_value(spheres, integer("spheres", 60, 1, 1e5), name, findings)
    candidates = Candidates(read_candidates(urdf, "urdf", findings, source.folder).references,
                            findings.locate(value.where), source.folder)  # fmt: skip
    return _RobotSource(name, candidates, count, file)


def _read_distances(source: Source, engines: list[str]) -> dict[str, int]:
    """Return a number for all engines, or {ENGINE: NUMBER, …}; those that are not named ask for none."""
    value, findings = source.root.find("distances"), source.findings
    declared = integer("distances", 100000, 0, 1e8)
    if value is None or value.kind != "map":
        count = 100000 if value is None else read_value(value, declared, "", findings) or 0
        return dict.fromkeys(engines, count)
    result = dict.fromkeys(engines, 0)
    for key, item in value.pairs():
        if key.text not in engines:
            findings.error(
                key.where, "unknown-choice",
                f"'distances' names {in_quotes(key.text)}, which 'engines' has not{suggestion(key.text, engines)}",
            )  # fmt: skip
        else:
            result[key.text] = read_value(item, declared, "", findings) or 0
    return result
