"""Elements that cover a mesh or points: foam.cover(), and its names for the usual choices."""

from __future__ import annotations

import operator
from collections import Counter
from typing import Any, Iterable, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _core
from ._mesh import Mesh, mesh_of
from .errors import UsageError

_MOST_SPHERES = 1_000_000


class Cover:
    """Convex elements that cover a mesh or points, with the proof.

    Equal covers have equal elements. Covers can be pickled.
    """

    __slots__ = ("spheres", "certified", "volume", "_others", "_region", "_volumes")

    spheres: NDArray[np.float64]  #: the spheres among the elements: (n, 4) float64, read-only: x, y, z, r in metres
    certified: bool  #: whether the mesh is proved to be covered: as a solid, with its inside, if it is closed
    volume: float  #: of the union of the elements, m³

    def __init__(
        self,
        spheres: Any,
        others: list[dict[str, Any]],
        certified: bool,
        volume: float,
        region: Mesh | None,
        volumes: tuple[float, float] | None = None,
    ):
        self.spheres = np.asarray(spheres)
        self.spheres.flags.writeable = False
        self.certified = certified
        self.volume = volume
        self._others = others
        self._region = region
        self._volumes = volumes

    @property
    def elements(self) -> list[dict[str, Any]]:
        """All elements, spheres first; the dictionaries are those of SphereModel.elements()."""
        spheres = [{"kind": "sphere", "position": tuple(row[:3]), "radius": row[3]} for row in self.spheres.tolist()]
        return [*spheres, *self._others]

    @property
    def centers(self) -> NDArray[np.float64]:
        """The centres of the spheres: (n, 3), metres; a view of `spheres`."""
        return self.spheres[:, :3]

    @property
    def radii(self) -> NDArray[np.float64]:
        """The radii of the spheres: (n,), metres; a view of `spheres`."""
        return self.spheres[:, 3]

    @property
    def excess(self) -> float:
        """The volume of the cover outside the mesh / the volume of the mesh; inf for a mesh without inside.

        Computed when it is first read, to about 0.1 % of the volume.
        """
        return self._measured()[0]

    @property
    def missing(self) -> float:
        """The volume of the mesh outside the cover / the volume of the mesh; 0 for a mesh without inside.

        0 for a closed mesh, by the proof; of an open one the surface is covered. Computed when it is first read.
        """
        return self._measured()[1]

    def _measured(self) -> tuple[float, float]:
        if self._volumes is None:
            assert self._region is not None
            if self._others:
                self._volumes = _core.volumes_of_elements(self._region._core, self.elements)
            else:
                self._volumes = _core.volumes_of_spheres(self._region._core, self.spheres, self.volume)
            self._region = None
        return self._volumes

    def to_trimesh(self) -> Any:
        """Return the elements as one trimesh.Trimesh, for pictures: spheres as spheres, meshes around the others."""
        from . import _adapters

        if self._others:
            return _adapters.trimesh_of(Mesh._of(_core.mesh_of_elements(self.elements)))
        return _adapters.trimesh_of(_adapters.mesh_of_spheres(self.spheres))

    def __len__(self) -> int:
        return len(self.spheres) + len(self._others)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Cover):
            return NotImplemented
        return np.array_equal(self.spheres, other.spheres) and self._others == other._others

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Cover, (np.array(self.spheres), self._others, self.certified, self.volume, None, self._measured())

    def __repr__(self) -> str:
        numbers = Counter(["sphere"] * len(self.spheres) + [element["kind"] for element in self._others])
        kinds = ", ".join(_noun(number, kind) for kind, number in numbers.items())
        return f"<foam.Cover: {kinds}, {'certified' if self.certified else 'not certified'}>"


def _noun(number: int, kind: str) -> str:
    noun = kind.replace("_", " ")
    return f"{number} {noun if number == 1 else noun + ('es' if noun.endswith('x') else 's')}"


def _count(elements: Any, what: str = "spheres") -> int:
    count = operator.index(elements)
    if not 1 <= count <= _MOST_SPHERES:
        raise UsageError(f"{what}: 1 to {_MOST_SPHERES} are possible, got {count}")
    return count


def _seed(seed: Any) -> int:
    number = operator.index(seed)
    if not 0 <= number < 2**64:
        raise UsageError(f"seed: 0 to 2**64 - 1 is possible, got {number}")
    return number


def _limit(seconds: Any) -> float | None:
    if seconds is None:
        return None
    limit = float(seconds)
    if not limit > 0:
        raise UsageError(f"time_limit: seconds above 0 are expected, got {seconds}")
    return limit


def _region(region: Any, radii: Any) -> Mesh:
    """Return what is to be covered: a mesh, or points with radii as a mesh around their balls."""
    if radii is None:
        return mesh_of(region).copy()
    points = _arrays.rows(region, "points")
    wide = _arrays.for_each(radii, "radii", len(points), "points")
    return Mesh._of(_core.mesh_of_balls(np.column_stack([points, wide])))


def _covers(
    region: Any,
    counts: list[int],
    kinds: Iterable[str] | str,
    *,
    effort: str,
    objective: str,
    seed: int = 0,
    max_vertices: int = 64,
    axis_aligned: bool = False,
    time_limit: float | None = None,
    radii: Any = None,
    covers: str = "solid",
    alone: bool = True,
) -> list[Cover]:
    """Return the covers for each count by one search; `alone`: for the one count, which is quicker with effort fast."""
    given = _region(region, radii)
    results = _core.cover(
        given._core, counts, alone, [kinds] if isinstance(kinds, str) else list(kinds), effort, objective, _seed(seed),
        operator.index(max_vertices), bool(axis_aligned), _limit(time_limit), covers,
    )  # fmt: skip
    return [Cover(*result, given) for result in results]


def cover(
    region: Any,
    elements: int,
    kinds: Iterable[str] | str = "sphere",
    *,
    radii: Any = None,
    effort: str = "normal",
    objective: str = "excess",
    seed: int = 0,
    max_vertices: int = 64,
    axis_aligned: bool = False,
    covers: str = "solid",
    time_limit: float | None = None,
) -> Cover:
    """Return at most `elements` convex elements that cover a mesh, or points with radii, proved.

    A closed mesh is covered as a solid, with its inside; of an open one the surface is covered.

    The function is that of C++, `foam::cover()`: the result is the same, bit for bit, on any number of threads.

    Args:
        region: a path, (vertices, faces), or an object with vertices and faces (foam.Mesh, trimesh) or triangles
            (Open3D); metres, any frame. With `radii`: points, (n, 3).
        elements: the greatest number of elements, at least 1.
        kinds: of elements, one or several of `foam.KINDS`, such as "capsule".
        radii: of the points, (n,) or one number, metres: the union of their balls is covered. 0: a millionth of the
            size of all points.
        effort: "fast" (milliseconds), "normal" or "best".
        objective: what is minimised: "excess" (volume outside the region), "protrusion", "mean_protrusion", or for
            spheres alone "radius".
        seed: of the search for spheres.
        max_vertices: of a hull, at least 4.
        axis_aligned: boxes have the axes of the region's frame.
        covers: "solid", or "surface": the surface alone, and maybe nothing inside.
        time_limit: seconds; the best elements by then, certified like any others, but not the same in each call. The
            first elements are always waited for: some milliseconds, a second for tens of thousands of spheres.

    Raises:
        InputError: the mesh cannot be read; its arrays have another shape, numbers that are not finite, indices out
            of range.
        GeometryError: the mesh has no triangle; there is no point.
        UsageError: an option is wrong; there is no such kind.
        KeyboardInterrupt: Ctrl-C ends the search.
    """
    return _covers(
        region, [_count(elements, "elements")], kinds, radii=radii, effort=effort, objective=objective, seed=seed,
        max_vertices=max_vertices, axis_aligned=axis_aligned, covers=covers, time_limit=time_limit,
    )[0]  # fmt: skip


def spherize(
    mesh: Any,
    spheres: int,
    *,
    effort: str = "normal",
    objective: str = "excess",
    seed: int = 0,
    time_limit: float | None = None,
) -> Cover:
    """Return at most `spheres` spheres that cover a mesh, proved: cover() for spheres alone."""
    return _covers(
        mesh, [_count(spheres)], "sphere", effort=effort, objective=objective, seed=seed, time_limit=time_limit
    )[0]


def spherize_each(
    mesh: Any,
    counts: Iterable[int],
    *,
    effort: str = "normal",
    objective: str = "excess",
    seed: int = 0,
    time_limit: float | None = None,
) -> list[Cover]:
    """Return the covers for several counts by one search. Arguments and errors are those of spherize().

    More spheres are never worse by the objective.
    """
    return _covers(
        mesh, [_count(count) for count in counts], "sphere", effort=effort, objective=objective, seed=seed,
        time_limit=time_limit, alone=False,
    )  # fmt: skip


def approximate(
    mesh: Any,
    elements: int,
    kinds: Iterable[str] | str = ("sphere", "capsule", "box"),
    *,
    effort: str = "normal",
    objective: str = "excess",
    max_vertices: int = 64,
    axis_aligned: bool = False,
    time_limit: float | None = None,
) -> Cover:
    """Return at most `elements` convex elements that cover a mesh, proved: cover() for other kinds."""
    return _covers(
        mesh, [_count(elements, "elements")], kinds, effort=effort, objective=objective, max_vertices=max_vertices,
        axis_aligned=axis_aligned, time_limit=time_limit,
    )[0]  # fmt: skip


class ProvedElement(NamedTuple):
    """An element around a mesh, and a bound on all elements of its kind around it."""

    element: dict[str, Any]  #: as in Cover.elements
    volume: float  #: of the element, m³
    lower_bound: float  #: m³: no element of the kind that contains the mesh has less volume


def proved_least(mesh: Any, kind: str, *, tolerance: float = 1e-3) -> ProvedElement:
    """Return the element of least volume around a mesh, up to the share `tolerance`, proved by branch and bound.

    The function is that of C++, `foam::proved_least()`. It takes seconds.

    Args:
        mesh: as of cover().
        kind: "capsule", "cylinder" or "box".
        tolerance: above 0.

    Raises:
        As cover(). UsageError: another kind or tolerance. GeometryError: a million cells were not enough.
    """
    return ProvedElement(*_core.proved_least(mesh_of(mesh)._core, kind, float(tolerance)))


def spheres_inside(mesh: Any, spheres: int, *, time_limit: float | None = None) -> NDArray[np.float64]:
    """Return at most `spheres` spheres inside a mesh, proved, that contain much of its volume.

    The result has shape (n, 4), read-only: x, y, z, r in metres; n is 0 if no ball fits. Errors as of cover().
    """
    return np.asarray(_core.spheres_inside(mesh_of(mesh)._core, _count(spheres), _limit(time_limit)))
