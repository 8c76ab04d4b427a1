"""Spheres of a mesh: foam.spherize() and its relatives."""

from __future__ import annotations

import operator
from collections import Counter
from typing import Any, Iterable, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._mesh import Mesh, mesh_of
from .errors import UsageError

_MOST_SPHERES = 1_000_000


class _Covering:
    """What all covers of a mesh have: the proof and the volumes."""

    __slots__ = ("certified", "volume", "_mesh", "_volumes")

    certified: bool  #: whether the whole surface is proved to be covered
    volume: float  #: of the union of what covers, m³

    def __init__(self, certified: bool, volume: float, mesh: Mesh | None, volumes: tuple[float, float] | None):
        self.certified = certified
        self.volume = volume
        self._mesh = mesh
        self._volumes = volumes

    @property
    def excess(self) -> float:
        """The volume of the cover outside the mesh / the volume of the mesh; inf for a mesh without inside.

        Computed when it is first read, to about 0.1 % of the volume.
        """
        return self._measured()[0]

    @property
    def missing(self) -> float:
        """The volume of the mesh outside the cover / the volume of the mesh; 0 for a mesh without inside.

        Above 0 only the surface is proved to be covered. Computed when it is first read.
        """
        return self._measured()[1]

    def _measured(self) -> tuple[float, float]:
        if self._volumes is None:
            assert self._mesh is not None
            self._volumes = self._volumes_in(self._mesh)
            self._mesh = None
        return self._volumes

    def _volumes_in(self, mesh: Mesh) -> tuple[float, float]:
        raise NotImplementedError

    def _proof(self) -> str:
        return "surface certified" if self.certified else "not certified"


class Cover(_Covering):
    """Spheres that cover a mesh, with the proof.

    Equal covers have equal spheres. Covers can be pickled.
    """

    __slots__ = ("spheres",)

    spheres: NDArray[np.float64]  #: (n, 4) float64, read-only: x, y, z, r in metres, in the mesh's frame

    def __init__(self, spheres: Any, certified: bool, volume: float, mesh: Mesh | None, volumes: tuple[float, float] | None = None):
        self.spheres = np.asarray(spheres)
        self.spheres.flags.writeable = False
        super().__init__(certified, volume, mesh, volumes)

    @property
    def centers(self) -> NDArray[np.float64]:
        """The centres: (n, 3), metres; a view of `spheres`."""
        return self.spheres[:, :3]

    @property
    def radii(self) -> NDArray[np.float64]:
        """The radii: (n,), metres; a view of `spheres`."""
        return self.spheres[:, 3]

    def _volumes_in(self, mesh: Mesh) -> tuple[float, float]:
        return _core.volumes_of_spheres(mesh._core, self.spheres, self.volume)

    def to_trimesh(self) -> Any:
        """Return the spheres as one trimesh.Trimesh, for pictures."""
        from . import _adapters

        return _adapters.trimesh_of(_adapters.mesh_of_spheres(self.spheres))

    def __len__(self) -> int:
        return len(self.spheres)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Cover):
            return NotImplemented
        return np.array_equal(self.spheres, other.spheres)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Cover, (np.array(self.spheres), self.certified, self.volume, None, self._measured())

    def __repr__(self) -> str:
        return f"<foam.Cover: {len(self)} spheres, {self._proof()}>"


class ConvexCover(_Covering):
    """Convex elements that cover a mesh, with the proof.

    Equal covers have equal elements. Covers can be pickled.
    """

    __slots__ = ("elements",)

    elements: list[dict[str, Any]]  #: spheres first; the dictionaries are those of SphereModel.elements()

    def __init__(
        self,
        elements: list[dict[str, Any]],
        certified: bool,
        volume: float,
        mesh: Mesh | None,
        volumes: tuple[float, float] | None = None,
    ):
        self.elements = elements
        super().__init__(certified, volume, mesh, volumes)

    def _volumes_in(self, mesh: Mesh) -> tuple[float, float]:
        return _core.volumes_of_elements(mesh._core, self.elements)

    def to_trimesh(self) -> Any:
        """Return meshes around the elements as one trimesh.Trimesh, for pictures."""
        from . import _adapters

        return _adapters.trimesh_of(Mesh._of(_core.mesh_of_elements(self.elements)))

    def __len__(self) -> int:
        return len(self.elements)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ConvexCover):
            return NotImplemented
        return self.elements == other.elements

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return ConvexCover, (self.elements, self.certified, self.volume, None, self._measured())

    def __repr__(self) -> str:
        numbers = Counter(element["kind"] for element in self.elements)
        kinds = ", ".join(f"{number} {kind}" for kind, number in numbers.items())
        return f"<foam.ConvexCover: {kinds}, {self._proof()}>"


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


def spherize(
    mesh: Any,
    spheres: int,
    *,
    effort: str = "normal",
    objective: str = "excess",
    seed: int = 0,
    time_limit: float | None = None,
) -> Cover:
    """Return at most `spheres` spheres that cover the surface of a mesh, proved.

    The function is that of C++, `foam::spherize()`: the result is the same, bit for bit, on any number of threads.

    Args:
        mesh: a path, (vertices, faces), or an object with vertices and faces (foam.Mesh, trimesh) or triangles
            (Open3D); metres, any frame.
        spheres: the greatest number of spheres, at least 1.
        effort: "fast" (milliseconds), "normal" or "best".
        objective: what is minimised: "excess" (volume outside the mesh), "protrusion" or "radius".
        seed: of the search.
        time_limit: seconds; the best spheres by then, certified like any others, but not the same in each call. The
            first spheres are always waited for: some milliseconds, a second for tens of thousands of spheres.

    Raises:
        InputError: the mesh cannot be read; its arrays have another shape, numbers that are not finite, indices out
            of range.
        GeometryError: the mesh has no triangle.
        UsageError: an option is wrong.
        KeyboardInterrupt: Ctrl-C ends the search.
    """
    given = mesh_of(mesh)
    rows, certified, volume = _core.spherize(
        given._core, _count(spheres), effort, objective, _seed(seed), _limit(time_limit)
    )
    return Cover(rows, certified, volume, given.copy())


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
    given = mesh_of(mesh)
    results = _core.spherize_each(
        given._core, [_count(count) for count in counts], effort, objective, _seed(seed), _limit(time_limit)
    )
    return [Cover(*result, given.copy()) for result in results]


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
) -> ConvexCover:
    """Return at most `elements` convex elements that cover the surface of a mesh, proved.

    The function is that of C++, `foam::approximate()`: the result is the same, bit for bit, on any number of threads.

    Args:
        mesh: as of spherize().
        elements: the greatest number of elements, at least 1.
        kinds: of elements: "sphere", "capsule", "cylinder", "box", "swept_box", "hull", one or several.
        effort: "fast", "normal" or "best".
        objective: what is minimised: "excess" (volume outside the mesh), "mean_protrusion" or "protrusion".
        max_vertices: of a hull, at least 4.
        axis_aligned: boxes have the axes of the mesh's frame.
        time_limit: seconds; the best elements by then, certified like any others, but not the same in each call.

    Raises:
        As spherize(). UsageError: there is no such kind.
    """
    given = mesh_of(mesh)
    return ConvexCover(
        *_core.approximate(
            given._core, _count(elements, "elements"), [kinds] if isinstance(kinds, str) else list(kinds),
            effort, objective, operator.index(max_vertices), bool(axis_aligned), _limit(time_limit),
        ),
        given.copy(),
    )  # fmt: skip


class ProvedElement(NamedTuple):
    """An element around a mesh, and a bound on all elements of its kind around it."""

    element: dict[str, Any]  #: as in ConvexCover.elements
    volume: float  #: of the element, m³
    lower_bound: float  #: m³: no element of the kind that contains the mesh has less volume


def proved_least(mesh: Any, kind: str, *, tolerance: float = 1e-3) -> ProvedElement:
    """Return the element of least volume around a mesh, up to the share `tolerance`, proved by branch and bound.

    The function is that of C++, `foam::proved_least()`. It takes seconds.

    Args:
        mesh: as of spherize().
        kind: "capsule", "cylinder" or "box".
        tolerance: above 0.

    Raises:
        As spherize(). UsageError: another kind or tolerance. GeometryError: a million cells were not enough.
    """
    return ProvedElement(*_core.proved_least(mesh_of(mesh)._core, kind, float(tolerance)))


def spheres_inside(mesh: Any, spheres: int, *, time_limit: float | None = None) -> NDArray[np.float64]:
    """Return at most `spheres` spheres inside a mesh, proved, that contain much of its volume.

    The result has shape (n, 4), read-only: x, y, z, r in metres; n is 0 if no ball fits. Errors as of spherize().
    """
    return np.asarray(_core.spheres_inside(mesh_of(mesh)._core, _count(spheres), _limit(time_limit)))
