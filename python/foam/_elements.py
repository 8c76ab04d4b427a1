"""Convex elements: records by kind, and sequences of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, List, Literal, TypedDict, Union, overload

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _arrays, _core
from .errors import InputError, UsageError

if TYPE_CHECKING:
    from ._packages import Trimesh

Vector = List[float]  #: three numbers


class SphereElement(TypedDict):
    """A sphere: metres."""

    kind: Literal["sphere"]
    position: Vector
    radius: float


class _Placed(TypedDict):
    position: Vector  #: of the middle
    rotation: list[Vector]  #: the rows of the matrix from the element's frame to the mesh's or the link's


class CapsuleElement(_Placed):
    """A capsule along z; `length` is that of its axis, without caps: metres."""

    kind: Literal["capsule"]
    length: float
    radius: float


class CylinderElement(_Placed):
    """A cylinder along z: metres."""

    kind: Literal["cylinder"]
    length: float
    radius: float


class BoxElement(_Placed):
    """A box; `size` has the lengths of its edges: metres."""

    kind: Literal["box"]
    size: Vector


class SweptBoxElement(_Placed):
    """A box of `size`, widened by `radius` in all directions: metres."""

    kind: Literal["swept_box"]
    size: Vector
    radius: float


class HullElement(_Placed):
    """The convex hull of `vertices`, which stand in the element's frame: metres."""

    kind: Literal["hull"]
    vertices: list[Vector]


class EllipsoidElement(_Placed):
    """An ellipsoid; `radii` are its half axes: metres."""

    kind: Literal["ellipsoid"]
    radii: Vector


ShapedElement = Union[CapsuleElement, CylinderElement, BoxElement, SweptBoxElement, HullElement, EllipsoidElement]
#: An element of any kind: `element["kind"]` tells which, also to type checkers.
Element = Union[SphereElement, ShapedElement]


class SpheresDict(TypedDict):
    """Spheres as numbers for JSON: what pyroki takes."""

    centers: list[Vector]
    radii: list[float]


class ElementsDict(TypedDict):
    """Elements of any kind as numbers for JSON."""

    elements: list[Element]


class Elements(Sequence[Element]):
    """Elements, spheres first: a sequence of records; where all are spheres, an array of shape (n, 4) as well.

    `np.asarray(elements)` has x, y, z, r of spheres in metres. Equal sequences have equal elements.
    """

    __slots__ = ("_rows", "_others")

    def __init__(self, spheres: Any, others: Iterable[ShapedElement] = ()) -> None:
        rows = np.asarray(spheres, dtype=np.float64)
        if rows.flags.writeable:
            rows = rows.copy()
            rows.flags.writeable = False
        self._rows: NDArray[np.float64] = rows
        self._others: list[ShapedElement] = list(others)

    @property
    def elements(self) -> list[Element]:
        """All elements, spheres first."""
        spheres: list[Element] = [
            {"kind": "sphere", "position": row[:3], "radius": row[3]} for row in self._rows.tolist()
        ]
        return [*spheres, *self._others]

    @property
    def spheres(self) -> NDArray[np.float64]:
        """The spheres: (n, 4) float64, read-only: x, y, z, r in metres.

        Raises UsageError if not all elements are spheres.
        """
        if self._others:
            kinds = Counter(element["kind"] for element in self._others)
            numbers = ", ".join(noun(number, kind) for kind, number in kinds.items())
            raise UsageError(f"not all elements are spheres ({numbers}); remedy: .elements has all of them")
        return self._rows

    @property
    def centers(self) -> NDArray[np.float64]:
        """The centres of the spheres: (n, 3), metres; a view of `spheres`."""
        return self.spheres[:, :3]

    @property
    def radii(self) -> NDArray[np.float64]:
        """The radii of the spheres: (n,), metres; a view of `spheres`."""
        return self.spheres[:, 3]

    def to_dict(self) -> SpheresDict | ElementsDict:
        """Return numbers for JSON: {"centers": …, "radii": …} of spheres, {"elements": …} where there are others."""
        if self._others:
            return {"elements": self.elements}
        return {"centers": self.centers.tolist(), "radii": self.radii.tolist()}

    def to_trimesh(self) -> Trimesh:
        """Return the elements as one trimesh.Trimesh, for pictures: spheres as spheres, meshes around the others."""
        from . import _adapters
        from ._mesh import Mesh

        if self._others:
            return _adapters.trimesh_of(Mesh._of(_core.mesh_of_elements(self.elements)))
        return _adapters.trimesh_of(_adapters.mesh_of_spheres(self._rows))

    def __array__(self, dtype: DTypeLike = None, copy: bool | None = None) -> NDArray[Any]:
        rows = self.spheres
        if copy or (dtype is not None and np.dtype(dtype) != rows.dtype):
            return np.array(rows, dtype=dtype)
        return rows

    def __len__(self) -> int:
        return len(self._rows) + len(self._others)

    def __iter__(self) -> Iterator[Element]:
        return iter(self.elements)

    @overload
    def __getitem__(self, index: int) -> Element: ...
    @overload
    def __getitem__(self, index: slice) -> list[Element]: ...
    def __getitem__(self, index: int | slice) -> Element | list[Element]:
        if isinstance(index, tuple):
            raise UsageError("elements have one index; remedy: .spheres[…] is the array of x, y, z, r")
        return self.elements[index]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Elements):
            return NotImplemented
        return np.array_equal(self._rows, other._rows) and self._others == other._others

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Elements, (np.array(self._rows), self._others)

    def _counts(self) -> str:
        numbers = Counter(["sphere"] * len(self._rows) + [element["kind"] for element in self._others])
        return ", ".join(noun(number, kind) for kind, number in numbers.items())

    def __repr__(self) -> str:
        return f"<foam.Elements: {self._counts()}>"


def noun(number: int, kind: str) -> str:
    """Return "1 box", "2 swept boxes"."""
    word = kind.replace("_", " ")
    return f"{number} {word if number == 1 else word + ('es' if word.endswith('x') else 's')}"


def elements_of(value: Any, what: str) -> Elements:
    """Return what the user calls elements: Elements, rows of x, y, z, r, what to_dict() gives, or a list of records.

    Raises InputError for other shapes, for numbers that are not finite, and for a radius that is not above 0.
    """
    if isinstance(value, Elements):
        return value if type(value) is Elements else Elements(value._rows, value._others)
    if isinstance(value, dict):
        if "elements" not in value and not {"centers", "radii"} <= set(value):
            raise InputError(
                f"{what}: the keys 'centers' and 'radii', or 'elements', are expected, got {', '.join(value)}"
            )
        value = value["elements"] if "elements" in value else _rows_of_dict(value, what)
    if isinstance(value, (list, tuple)) and value and isinstance(value[0], dict):
        balls = [[*one["position"], one["radius"]] for one in value if one.get("kind") == "sphere"]
        return Elements(
            sphere_rows(np.reshape(balls, (-1, 4)), what), [one for one in value if one.get("kind") != "sphere"]
        )
    return Elements(sphere_rows(value, what))


def _rows_of_dict(value: dict[str, Any], what: str) -> NDArray[np.float64]:
    centers = _arrays.rows(value["centers"], f"{what}: centers")
    radii = np.asarray(value["radii"], dtype=np.float64).reshape(-1, 1)
    if len(centers) != len(radii):
        raise InputError(f"{what}: {len(centers)} centers, but {len(radii)} radii")
    return np.concatenate([centers, radii], axis=1)


def sphere_rows(value: ArrayLike, what: str) -> NDArray[np.float64]:
    """Return spheres as rows of x, y, z, r. Raises InputError for what are none."""
    rows = _arrays.rows(value, what, 4)
    if not np.isfinite(rows).all() or (rows[:, 3] <= 0).any():
        raise InputError(f"{what}: numbers that are not finite, or a radius that is not above 0")
    return rows
