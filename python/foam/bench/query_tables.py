"""The tables of collision_queries."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from .engines import LABELS, Report
from .experiment import Outcome, Section, short, table
from .statistics import Comparison, Mean, Missed, compared, missed_by

_NOT_MEASURED = "not measured"
_ENGINES = {
    "fcl": "Dynamic AABB trees over shapes and obstacles. Meshes are surfaces; distances are unsigned, since signed ones "
    "abort.",
    "fcl_pairs": "Every shape against every other, without trees, as Pinocchio does. Otherwise as FCL.",
    "bullet": "A link is a compound shape, a mesh its convex hull, as in PyBullet, without margins. Signed distances.",
    "mujoco": "Meshes are convex hulls, flat ones 0.2 mm thick. There is no query for distances: all contacts within a "
    "margin larger than the scene are asked for; those of hulls and cylinders are not exact.",
}
_DIFFERENT = (
    "Every query is asked for obstacles and for the robot itself. A configuration that collides with both counts in both "
    "columns, so that these may add up to more than the whole. 'only spheres': queries in which the spheres collide and the "
    "original does not."
)


@dataclass
class Robot:
    """What came of asking about a robot."""

    name: str
    chosen: str  #: the reference that was taken
    excess: float
    certified: bool
    sizes: dict[str, Any] = field(default_factory=dict)
    reports: list[Report] = field(default_factory=list)  #: of each engine

    def compared(self) -> list[tuple[Report, Comparison]]:
        """Return the reports with what they say."""
        return [(report, compared(report)) for report in self.reports]

    def exact(self) -> Report | None:
        """Return the report of an engine that knows the original as it is: FCL, of one kind or the other."""
        return next((report for report, c in self.compared() if report.engine.startswith("fcl") and c.queries), None)


@dataclass
class Setup:
    """What was asked, and of which robots."""

    values: dict[str, Any]  #: of the experiment
    distances: dict[str, int]  #: queries that ask for distances too, by engine
    method: str  #: that made spheres; empty: none did
    robots: list[Robot]
    missing: list[str]  #: robots that are not here


def told(setup: Setup) -> Outcome:
    """Return the results."""
    outcome = Outcome(_cases(setup), [
        Section(text=_introduction(setup)),
        Section("Spheres minus original", table=_differences(setup)),
    ])  # fmt: skip
    verdicts = _verdicts(setup)
    if len(verdicts):
        outcome.sections.append(Section("Where verdicts differ", _DIFFERENT, table=verdicts))
    for engine in setup.distances:
        outcome.sections.append(_of_engine(setup, engine))
    missed = _missed(setup)
    if len(missed):
        outcome.sections.append(Section("Collisions that spheres miss", _missed_text(setup), table=missed))
    return outcome


def _ms(mean: Mean) -> str:
    return short(1e3 * mean.value)


def _signed_ms(mean: Mean) -> str:
    """ "-0.0123 ± 0.0004": the sign says which way."""
    sign = "+" if mean.value > 0 else ""
    return f"{sign}{_ms(mean)} ± {short(1e3 * mean.error)}" if mean.size else _NOT_MEASURED


def _percent(part: int, whole: int) -> str:
    return f"{100 * part / whole:.3f}" if whole else "–"


def _signed_percent(share: Mean) -> str:
    return f"{100 * share.value:+.3f} ± {short(100 * share.error)}" if share.size else _NOT_MEASURED


def _differences(setup: Setup) -> Any:
    """As the paper's Table I: for each library the spheres' figures minus the original's."""
    columns = [f"{LABELS[engine]}: {what}" for engine in setup.distances
               for what in ("Δ collision, ms", "Δ distance, ms", "Δ validity, %")]  # fmt: skip
    rows = [[robot.name, *(cell for _, c in robot.compared() for cell in (
        _signed_ms(c.collision.difference), _signed_ms(c.distance.difference), _signed_percent(c.collides.difference)))]
        for robot in setup.robots]  # fmt: skip
    return table(["robot", *columns], rows)


def _verdicts(setup: Setup) -> Any:
    """Whether the verdicts differ by obstacles or by what the robot does to itself."""
    rows = []
    for robot in setup.robots:
        for report, c in robot.compared():
            if c.queries:
                rows.append([robot.name, report.label, _percent(c.collides.original, c.queries),
                             _percent(c.collides.spheres, c.queries), _signed_percent(c.collides.difference),
                             _signed_percent(c.hits_obstacle.difference), _signed_percent(c.hits_itself.difference),
                             str(c.collides.only_spheres), str(c.collides.only_original)])  # fmt: skip
    return table(["robot", "library", "collides, %", "spheres collide, %", "Δ, %", "Δ by obstacles, %", "Δ by itself, %",
                  "only spheres", "only the original"], rows)  # fmt: skip


def _of_engine(setup: Setup, engine: str) -> Section:
    """Original and spheres of one library side by side."""
    rows, remarks, version = [], [], ""
    for robot in setup.robots:
        report, c = next(one for one in robot.compared() if one[0].engine == engine)
        version = version or report.version
        figures = [_NOT_MEASURED, *[""] * 6]
        if c.queries:
            figures = [_ms(c.collision.original), _ms(c.collision.spheres), str(c.distance.original.size),
                       _ms(c.distance.original), _ms(c.distance.spheres), *map(str, c.aborted)]  # fmt: skip
        rows.append([robot.name, str(robot.sizes["shapes"]), str(robot.sizes["spheres"]), str(c.queries), *figures])
        if report.why_not:
            remarks.append(f"{robot.name}: {report.why_not}")
        elif c.not_asked:
            remarks.append(f"{robot.name}: {c.not_asked} queries were not asked, the time was up")
        if report.aborts:
            remarks.append(f"{robot.name}: {len(report.aborts)} queries ended the process ({report.aborts[0]})")
    columns = ["robot", "shapes", "spheres", "queries", "collision, ms", "by spheres, ms", "distances", "distance, ms",
               "by spheres, ms", "aborted", "aborted by spheres"]  # fmt: skip
    text = _ENGINES[engine] + (f" {'; '.join(remarks)}." if remarks else "")
    title = f"{LABELS[engine]} ({version})" if version else LABELS[engine]
    return Section(title, text, table=table(columns, rows))


def _missed(setup: Setup) -> Any:
    rows = []
    for robot in setup.robots:
        exact = robot.exact()
        for report, c in robot.compared():
            if exact is not None and c.queries:
                rows.append([robot.name, report.label, *map(str, missed_by(report, exact))])
    return table(["robot", "library", "original hits an obstacle", "missed by spheres", "original hits itself",
                  "missed by spheres"], rows)  # fmt: skip


def _missed_text(setup: Setup) -> str:
    total = Missed()
    for robot in setup.robots:
        exact = robot.exact()
        for report in robot.reports if exact is not None and robot.certified else []:
            assert exact is not None
            total = total.plus(missed_by(report, exact))
    certified = sum(robot.certified for robot in setup.robots)
    return (
        "Spheres that are certified hold the whole surface of the original. Where that touches an obstacle, or another link, "
        "a sphere does too: they miss no collision of the original's surface as FCL finds it on the meshes themselves. Of "
        f"{len(setup.robots)} models {certified} are certified; of {total.obstacle_hits} such hits of obstacles, over all "
        f"libraries, their spheres missed {total.obstacles}, of {total.self_hits} hits of other links {total.selves}. A "
        "library that takes hulls for meshes finds collisions where the original has none; spheres may miss those ('only the "
        "original', above)."
    )


def _introduction(setup: Setup) -> str:
    values = setup.values
    text = " ".join(
        f"{robot.name} is {robot.chosen}: {robot.sizes['links']} links, {robot.sizes['spheres']} spheres, excess "
        f"{short(robot.excess)}, {'certified' if robot.certified else 'not certified'}; {robot.sizes['pairs']} pairs of "
        f"links are tested, {robot.sizes['ignored_pairs']} ignored."
        for robot in setup.robots
    )
    text += f" Left out, as no candidate is here: {', '.join(setup.missing)}." if setup.missing else ""
    text += f" Spheres by {setup.method}." if setup.method else ""
    distances = "; ".join(f"{count} in {LABELS[engine]}" for engine, count in setup.distances.items())
    return text + (
        f" {values['queries']} configurations, uniform within the limits of the joints, in {values['environments']} "
        f"environments of {values['obstacles']} obstacles: boxes and spheres in turn, edges and diameters from "
        f"{values['smallest']:g} to {values['largest']:g} m, anywhere in the box that the robot reaches, clear of the links "
        "that do not move. The same for both models and all libraries. Pairs of links that a self-collision matrix of the "
        "spheres leaves out (neighbours, and what touches in the zero configuration, or in all or none of 10000 random ones), "
        "and those that touch in most, are not tested against each other, in either model.\n\n"
        "A time is the CPU time of the one thread that asks, in milliseconds, and has in it to bring the geometry to the poses "
        "of the links. A collision check stops at the first collision where the library can, obstacles before the robot "
        "itself. Some of the queries, evenly among all, ask for the distance too, to obstacles and of the robot to itself: "
        f"{distances}. The two models are asked in turn, in one process. Δ: spheres minus original, so that a negative time "
        "says that spheres are faster and a positive validity that more configurations collide with spheres; ± its standard "
        "error."
    )


def _number(value: float, factor: float = 1) -> str:
    return f"{factor * value:.6g}" if math.isfinite(value) else ""


def _cases(setup: Setup) -> Any:
    columns = ["robot", "engine", "version", "model", "shapes", "queries", "aborted", "move_ms", "collision_ms",
               "collision_ms_error", "collision_ms_difference", "collision_ms_difference_error", "distances", "distance_ms",
               "distance_ms_error", "distance_ms_difference", "distance_ms_difference_error", "mean_distance_m", "collides",
               "collides_alone", "hits_obstacle", "hits_itself", "remark"]  # fmt: skip
    rows = []
    for robot in setup.robots:
        for report, c in robot.compared():
            for m, name in enumerate(("original", "spheres")):
                times = [cell for paired in (c.collision, c.distance) for mean in (paired[m], paired.difference)
                         for cell in (_number(mean.value, 1e3), _number(mean.error, 1e3))]  # fmt: skip
                rows.append([
                    robot.name, report.engine, report.version, name, str(robot.sizes["spheres" if m else "shapes"]),
                    str(c.queries), str(c.aborted[m]), _number(c.move[m].value, 1e3), *times[:4],
                    str(c.distance.original.size), *times[4:], _number(c.metres[m].value), str(c.collides[m]),
                    str(c.collides.only_spheres if m else c.collides.only_original), str(c.hits_obstacle[m]),
                    str(c.hits_itself[m]), report.why_not,
                ])  # fmt: skip
    return table(columns, rows)
