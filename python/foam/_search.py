"""Elements that cover a mesh or points: foam.cover(), and its names for the usual choices."""

from __future__ import annotations

import operator
from typing import Any, Iterable, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import count_of, limit_of, seed_of
from ._cover import Cover
from ._elements import Element
from ._events import Progress, teller
from ._mesh import mesh_of
from ._regions import region_of
from ._words import Covers, Effort, Kind, Objective


def _covers(
    region: Any,
    counts: list[int],
    kinds: Iterable[Kind] | Kind,
    *,
    effort: Effort,
    objective: Objective,
    seed: int = 0,
    max_vertices: int = 64,
    axis_aligned: bool = False,
    time_limit: float | None = None,
    radii: Any = None,
    covers: Covers = "solid",
    progress: Progress | None = None,
    alone: bool = True,
) -> list[Cover]:
    """Return the covers for each count by one search; `alone`: for the one count, which is quicker with effort fast."""
    given = region_of(region, radii)
    results = _core.cover(
        given._core, counts, alone, [kinds] if isinstance(kinds, str) else list(kinds), effort, objective, seed_of(seed),
        operator.index(max_vertices), bool(axis_aligned), limit_of(time_limit), covers, teller(progress),
    )  # fmt: skip
    return [Cover(*result, given) for result in results]


def cover(
    region: Any,
    elements: int,
    kinds: Iterable[Kind] | Kind = "sphere",
    *,
    radii: Any = None,
    effort: Effort = "normal",
    objective: Objective = "excess",
    seed: int = 0,
    max_vertices: int = 64,
    axis_aligned: bool = False,
    covers: Covers = "solid",
    time_limit: float | None = None,
    progress: Progress | None = None,
) -> Cover:
    """Return at most `elements` convex elements that cover a mesh, or points with radii, proved.

    A closed mesh is covered as a solid, with its inside; of an open one the surface is covered.

    The function is that of C++, `foam::cover()`: the result is the same, bit for bit, on any number of threads.

    Args:
        region: a path, (vertices, faces), or a mesh of foam, trimesh, Open3D, PyVista, manifold3d or coacd: metres,
            any frame; of trimesh in its `units`. With `radii`: points, (n, 3). A point cloud of trimesh, Open3D or
            PyVista without `radii`: its points alone are covered.
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
        progress: is called with a foam.Event about ten times a second, in this thread. An exception of it ends the
            search: so another thread ends it, by a threading.Event that the callback looks at. `done` is known where
            there is a time limit.

    Raises:
        InputError: the mesh cannot be read; its arrays have another shape, numbers that are not finite, indices out
            of range.
        GeometryError: the mesh has no triangle; there is no point.
        UsageError: an option is wrong; there is no such kind.
        KeyboardInterrupt: Ctrl-C ends the search.
    """
    return _covers(
        region, [count_of(elements, "elements")], kinds, radii=radii, effort=effort, objective=objective, seed=seed,
        max_vertices=max_vertices, axis_aligned=axis_aligned, covers=covers, time_limit=time_limit, progress=progress,
    )[0]  # fmt: skip


def spherize(
    mesh: Any,
    spheres: int,
    *,
    effort: Effort = "normal",
    objective: Objective = "excess",
    seed: int = 0,
    time_limit: float | None = None,
    progress: Progress | None = None,
) -> Cover:
    """Return at most `spheres` spheres that cover a mesh, proved: cover() for spheres alone."""
    return _covers(
        mesh,
        [count_of(spheres)],
        "sphere",
        effort=effort,
        objective=objective,
        seed=seed,
        time_limit=time_limit,
        progress=progress,
    )[0]


def spherize_each(
    mesh: Any,
    counts: Iterable[int],
    *,
    effort: Effort = "normal",
    objective: Objective = "excess",
    seed: int = 0,
    time_limit: float | None = None,
    progress: Progress | None = None,
) -> list[Cover]:
    """Return the covers for several counts by one search. Arguments and errors are those of spherize().

    More spheres are never worse by the objective.
    """
    return _covers(
        mesh, [count_of(count) for count in counts], "sphere", effort=effort, objective=objective, seed=seed,
        time_limit=time_limit, progress=progress, alone=False,
    )  # fmt: skip


def approximate(
    mesh: Any,
    elements: int,
    kinds: Iterable[Kind] | Kind = ("sphere", "capsule", "box"),
    *,
    effort: Effort = "normal",
    objective: Objective = "excess",
    max_vertices: int = 64,
    axis_aligned: bool = False,
    time_limit: float | None = None,
    progress: Progress | None = None,
) -> Cover:
    """Return at most `elements` convex elements that cover a mesh, proved: cover() for other kinds."""
    return _covers(
        mesh, [count_of(elements, "elements")], kinds, effort=effort, objective=objective, max_vertices=max_vertices,
        axis_aligned=axis_aligned, time_limit=time_limit, progress=progress,
    )[0]  # fmt: skip


class ProvedElement(NamedTuple):
    """An element around a mesh, and a bound on all elements of its kind around it."""

    element: Element  #: as in Cover.elements
    volume: float  #: of the element, m³
    lower_bound: float  #: m³: no element of the kind that contains the mesh has less volume


def proved_least(mesh: Any, kind: Kind, *, tolerance: float = 1e-3) -> ProvedElement:
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
    return np.asarray(_core.spheres_inside(mesh_of(mesh)._core, count_of(spheres), limit_of(time_limit)))
