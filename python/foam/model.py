"""Spheres in the manner of Coumar et al. 2025, CoMMALab/foam."""

from __future__ import annotations

from json import JSONDecoder, JSONEncoder
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Sphere", "SphereDecoder", "SphereEncoder", "Spherization"]


class Sphere:
    """A sphere: `origin` (3,), `radius`; metres."""

    __slots__ = ("origin", "radius")

    def __init__(self, x: float, y: float, z: float, r: float, offset: ArrayLike | None = None) -> None:
        self.origin: NDArray[np.float64] = np.array([x, y, z], dtype=np.float64)
        self.radius = r
        if offset is not None:
            self.offset(offset)

    def offset(self, offset: ArrayLike) -> None:
        """Move the sphere, in place."""
        self.origin = self.origin + np.asarray(offset, dtype=np.float64)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sphere):
            return NotImplemented
        return np.array_equal(self.origin, other.origin) and self.radius == other.radius

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Sphere(origin={self.origin!r}, radius={self.radius!r})"


class Spherization:
    """Spheres of a mesh, and how far they protrude from it: mean, least and greatest over the spheres; metres.

    `certified`: whether foam has proved that they cover the mesh.
    """

    __slots__ = ("spheres", "mean_error", "best_error", "worst_error", "certified")

    def __init__(
        self, spheres: list[Sphere], mean_error: float, best_error: float, worst_error: float, certified: bool = False
    ) -> None:
        self.spheres = spheres
        self.mean_error = mean_error
        self.best_error = best_error
        self.worst_error = worst_error
        self.certified = certified

    def __len__(self) -> int:
        return len(self.spheres)

    def __lt__(self, other: Spherization) -> bool:
        return (
            self.mean_error < other.mean_error
            and self.best_error < other.best_error
            and self.worst_error < other.worst_error
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Spherization):
            return NotImplemented
        errors = (self.mean_error, self.best_error, self.worst_error)
        return self.spheres == other.spheres and errors == (other.mean_error, other.best_error, other.worst_error)

    __hash__ = None  # type: ignore[assignment]

    def offset(self, offset: ArrayLike) -> None:
        """Move all spheres, in place."""
        for sphere in self.spheres:
            sphere.offset(offset)

    def __repr__(self) -> str:
        return f"Spherization({len(self)} spheres, mean {self.mean_error:.3g}, worst {self.worst_error:.3g})"


class SphereEncoder(JSONEncoder):
    """Spheres and spherizations as JSON: json.dumps(…, cls=SphereEncoder)."""

    def default(self, o: Any) -> Any:
        if isinstance(o, Sphere):
            return {"origin": o.origin.tolist(), "radius": float(o.radius)}
        if isinstance(o, Spherization):
            return {"mean": o.mean_error, "best": o.best_error, "worst": o.worst_error, "spheres": o.spheres}
        if isinstance(o, (np.ndarray, np.generic)):
            return o.tolist()
        return super().default(o)


class SphereDecoder(JSONDecoder):
    """The same back: json.load(…, cls=SphereDecoder)."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, object_hook=self._made, **options)

    @staticmethod
    def _made(values: dict[str, Any]) -> Any:
        if "origin" in values and "radius" in values:
            x, y, z = values["origin"]
            return Sphere(x, y, z, values["radius"])
        if "spheres" in values and "mean" in values:
            return Spherization(values["spheres"], values["mean"], values["best"], values["worst"])
        return values
