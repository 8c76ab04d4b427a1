"""How times grow with sizes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class PowerLaw(NamedTuple):
    """y = factor · x^exponent, from x = `low` to x = `high`."""

    exponent: float
    factor: float
    low: float
    high: float


def fitted_power_law(points: Sequence[tuple[float, float]]) -> PowerLaw | None:
    """Return the least-squares fit to the logarithms, over the sizes from a tenth of the largest on.

    Points that are not above 0 do not count. None for fewer than three points or equal sizes.
    """
    counted = np.array([point for point in points if point[0] > 0 and point[1] > 0])
    if len(counted) == 0:
        return None
    high = counted[:, 0].max()
    counted = counted[counted[:, 0] >= high / 10]
    x, y = np.log(counted).T
    if len(counted) < 3 or np.ptp(x) == 0:
        return None
    exponent = float(((x - x.mean()) * (y - y.mean())).sum() / ((x - x.mean()) ** 2).sum())
    return PowerLaw(exponent, float(np.exp(y.mean() - exponent * x.mean())), float(counted[:, 0].min()), float(high))


def growth_text(points: Sequence[tuple[float, float]]) -> str:
    """Return "n^1.23"; "–" if there is no law."""
    law = fitted_power_law(points)
    return f"n^{law.exponent:.2f}" if law else "–"


def labelled(label: str, points: Sequence[tuple[float, float]]) -> str:
    """Return the label of a curve with its growth, if there is one."""
    return f"{label}, {growth_text(points)}" if fitted_power_law(points) else label
