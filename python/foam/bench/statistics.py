"""Two models of a robot compared query by query."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from .engines import ABORTED, Report


class Mean(NamedTuple):
    """The mean of some values, and its standard error. Not a number: of nothing; the error, of fewer than two."""

    size: int
    value: float
    error: float


def mean_of(values: Any) -> Mean:
    """Return the mean of an array."""
    array = np.asarray(values, dtype=float)
    if not len(array):
        return Mean(0, math.nan, math.nan)
    error = array.std(ddof=1) / math.sqrt(len(array)) if len(array) > 1 else math.nan
    return Mean(len(array), float(array.mean()), float(error))


class Paired(NamedTuple):
    """A quantity of the original, of the spheres, and the spheres' minus the original's, over the same queries."""

    original: Mean
    spheres: Mean
    difference: Mean


class Verdicts(NamedTuple):
    """In which queries a condition holds."""

    original: int
    spheres: int
    only_original: int
    only_spheres: int
    difference: Mean  #: of the share of queries, spheres minus original


@dataclass
class Comparison:
    """What an engine says of the original and of the spheres, over the queries that it answered for both."""

    queries: int
    aborted: tuple[int, int]  #: by model
    not_asked: int
    move: Paired  #: CPU s
    collision: Paired  #: CPU s
    distance: Paired  #: CPU s
    metres: Paired  #: the distance itself, where neither model collides
    collides: Verdicts  #: with an obstacle, or with itself
    hits_obstacle: Verdicts
    hits_itself: Verdicts


def _paired(original: Any, spheres: Any) -> Paired:
    return Paired(mean_of(original), mean_of(spheres), mean_of(spheres - original))


def _verdicts(original: Any, spheres: Any) -> Verdicts:
    difference = mean_of(spheres.astype(int) - original.astype(int))
    return Verdicts(
        int(original.sum()), int(spheres.sum()), int((original & ~spheres).sum()), int((spheres & ~original).sum()),
        difference,
    )  # fmt: skip


def compared(report: Report) -> Comparison:
    """Return what a report says."""
    first, second = report.models
    both = report.answered()
    collides = [both[f"hits_obstacle_{m}"] | both[f"hits_itself_{m}"] for m in (0, 1)]
    measured = both[both.distance_m_0.notna() & both.distance_m_1.notna()]
    apart = measured[~(collides[0] | collides[1])[measured.index] & np.isfinite(measured.distance_m_0 + measured.distance_m_1)]
    return Comparison(
        len(both),
        (int((first.state == ABORTED).sum()), int((second.state == ABORTED).sum())),
        int(((first.state == 0) | (second.state == 0)).sum()),
        _paired(both.move_s_0, both.move_s_1),
        _paired(both.move_s_0 + both.collision_s_0, both.move_s_1 + both.collision_s_1),
        _paired(measured.move_s_0 + measured.distance_s_0, measured.move_s_1 + measured.distance_s_1),
        _paired(apart.distance_m_0, apart.distance_m_1),
        _verdicts(*collides),
        _verdicts(both.hits_obstacle_0, both.hits_obstacle_1),
        _verdicts(both.hits_itself_0, both.hits_itself_1),
    )


class Missed(NamedTuple):
    """Of the queries where the exact original hits an obstacle (itself): those in which the spheres of an engine do not."""

    obstacle_hits: int = 0
    obstacles: int = 0
    self_hits: int = 0
    selves: int = 0

    def plus(self, other: Missed) -> Missed:
        """Return the sums."""
        return Missed(*(a + b for a, b in zip(self, other)))


def missed_by(report: Report, exact: Report) -> Missed:
    """Return what the spheres of a report miss. `exact`: the report whose original counts."""
    both = exact.models[0].join(report.models[1], lsuffix="_0", rsuffix="_1", how="inner")
    both = both[(both.state_0 == 1) & (both.state_1 == 1)]
    return Missed(
        int(both.hits_obstacle_0.sum()), int((both.hits_obstacle_0 & ~both.hits_obstacle_1).sum()),
        int(both.hits_itself_0.sum()), int((both.hits_itself_0 & ~both.hits_itself_1).sum()),
    )  # fmt: skip
