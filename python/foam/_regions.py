"""Regions: what is to be covered, a mesh or points with radii."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _core, _foreign
from ._mesh import Mesh, mesh_of


class Balls(Mesh):
    """The union of the balls around points, and a mesh around it."""

    __slots__ = ("balls",)

    def __init__(self, balls: NDArray[np.float64]) -> None:
        self._core = _core.mesh_of_balls(balls)
        self.balls = balls  #: (n, 4): x, y, z, r in metres

    def __reduce__(self) -> tuple[Any, ...]:
        return Balls, (self.balls,)


def region_of(region: Any, radii: Any) -> Mesh:
    """Return a region: a mesh, or points with radii. A point cloud of another package without radii has radii of 0."""
    points = _foreign.points_of(region) if radii is None else None
    if points is None and radii is None:
        return mesh_of(region).copy()
    if points is None:
        cloud = _foreign.points_of(region)
        points = _arrays.rows(region if cloud is None else cloud, "points")
    wide = _arrays.for_each(0.0 if radii is None else radii, "radii", len(points), "points")
    return Balls(np.column_stack([points, wide]))
