"""Meshes: foam.Mesh, and everything that is taken for a mesh."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _foreign
from ._plugins import registry
from .errors import InputError, UsageError

if TYPE_CHECKING:
    from ._packages import Trimesh


class Mesh:
    """A triangle mesh: metres, any frame. It may have holes or be inside out.

    `vertices`: (n, 3) numbers; `faces`: (m, 3) indices from 0, counter-clockwise seen from outside. Both are copied.
    Raises InputError for other shapes, for numbers that are not finite, and for indices out of range.
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        self._core = _core.Mesh(_arrays.rows(vertices, "vertices"), _arrays.index_rows(faces, "faces"))

    @classmethod
    def _of(cls, core: _core.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._core = core
        return mesh

    @property
    def vertices(self) -> NDArray[np.float64]:
        """The corners: (n, 3), metres; a read-only view."""
        return np.asarray(self._core.vertices())

    @property
    def faces(self) -> NDArray[np.uint32]:
        """The corner indices of the triangles: (m, 3); a read-only view."""
        return np.asarray(self._core.faces())

    triangles = faces

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The lowest and the highest coordinates of the corners that faces use: (2, 3), metres."""
        used = self.vertices[np.unique(self.faces)]
        if not len(used):
            raise InputError("the mesh has no faces, and so no bounds")
        return np.array([used.min(axis=0), used.max(axis=0)])

    @property
    def volume(self) -> float:
        """The volume of the solid, m³: exact for a closed mesh, otherwise to about 0.1 %."""
        return self._core.volume()

    @property
    def area(self) -> float:
        """The sum of the triangles' areas, m²."""
        return self._core.area()

    @property
    def is_watertight(self) -> bool:
        """Whether the mesh is closed and consistently oriented, vertices at the same place taken as one."""
        return self._core.is_watertight()

    def copy(self) -> Mesh:
        """Return a mesh that apply_… of this one does not change."""
        return Mesh._of(self._core)

    def apply_transform(self, matrix: ArrayLike) -> Mesh:
        """Move the mesh by a (4, 4) or (3, 4) matrix, in place. A mirroring matrix flips the faces. Return the mesh."""
        m = np.asarray(matrix, dtype=np.float64)
        if m.shape not in ((4, 4), (3, 4)):
            raise UsageError(f"matrix: shape (4, 4) or (3, 4) is expected, got {m.shape}")
        faces = self.faces[:, ::-1] if np.linalg.det(m[:3, :3]) < 0 else self.faces
        self._core = Mesh(self.vertices @ m[:3, :3].T + m[:3, 3], faces)._core
        return self

    def apply_scale(self, scale: float | ArrayLike) -> Mesh:
        """Multiply the coordinates by a number or by one number an axis, in place. Return the mesh."""
        factors = np.broadcast_to(np.asarray(scale, dtype=np.float64), (3,))
        return self.apply_transform(np.diag([*factors, 1.0]))

    def export(self, path: str | os.PathLike[str]) -> Path:
        """Write the mesh as .stl (binary), .obj or .ply (binary); return the path. STL has single precision."""
        file = Path(path)
        writer = _WRITERS.get(file.suffix.lower())
        if writer is None:
            raise UsageError(f"{file}: meshes are written as {', '.join(sorted(_WRITERS))}, not as '{file.suffix}'")
        file.write_bytes(writer(self))
        return file

    def to_trimesh(self) -> Trimesh:
        """Return the mesh as a trimesh.Trimesh. Raises UsageError if trimesh is not installed."""
        from . import _adapters

        return _adapters.trimesh_of(self)

    def __iter__(self) -> Iterator[NDArray[Any]]:
        yield self.vertices
        yield self.faces

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh):
            return NotImplemented
        return np.array_equal(self.vertices, other.vertices) and np.array_equal(self.faces, other.faces)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh, (np.array(self.vertices), np.array(self.faces))

    def __repr__(self) -> str:
        return f"<foam.Mesh: {len(self.vertices)} vertices, {len(self.faces)} faces>"


def _stl(mesh: Mesh) -> bytes:
    corners = mesh.vertices[mesh.faces]
    rows = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    rows["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    rows["corners"] = corners
    return b"".join([b"foam".ljust(80), len(corners).to_bytes(4, "little"), rows.tobytes()])


def _obj(mesh: Mesh) -> bytes:
    vertices: Any = mesh.vertices.tolist()  # the annotations of NumPy 2 name no depth of the lists
    faces: Any = mesh.faces.tolist()
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return ("\n".join(lines) + "\n").encode()


def _ply(mesh: Mesh) -> bytes:
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(mesh.vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(mesh.faces)}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(mesh.faces), dtype=[("count", "u1"), ("corners", "<u4", 3)])
    rows["count"] = 3
    rows["corners"] = mesh.faces
    return b"".join([header.encode(), mesh.vertices.astype("<f8").tobytes(), rows.tobytes()])


_WRITERS = {".stl": _stl, ".obj": _obj, ".ply": _ply}


def read_mesh(path: str | os.PathLike[str], *, unit: str | None = None, scale: float = 1.0) -> Mesh:
    """Return the mesh of a file in metres. `unit`: of the file's numbers, if the format states none ("mm", "in"…)."""
    file = Path(path)
    if not file.is_file():
        raise InputError(f"{file}: {'it is no file' if file.exists() else 'there is no such file'}")
    return Mesh._of(_core.load_mesh(str(file), registry(), unit, float(scale)))


def mesh_of(mesh: Any, what: str = "mesh") -> Mesh:
    """Return what the user calls a mesh as a Mesh: a path, (vertices, faces), or a mesh of another package.

    Meshes of trimesh come with their `units`, all others are in metres. Raises InputError for points and for anything
    else.
    """
    if isinstance(mesh, Mesh):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        return read_mesh(mesh)
    if isinstance(mesh, (tuple, list)):
        if mesh and all(map(_is_pair_of_arrays, mesh)):  # coacd.run_coacd()
            raise InputError(f"{what}: it is a list of {len(mesh)} meshes; remedy: one of them, or all as one mesh")
        if len(mesh) == 2:
            return Mesh(mesh[0], mesh[1])
    vertices, faces = _foreign.arrays_of(mesh, what)
    if faces is None:
        raise InputError(f"{what}: {type(mesh).__name__} has points, no faces; remedy: foam.cover(points, n, radii=…)")
    return Mesh(vertices, faces)


def _is_pair_of_arrays(value: Any) -> bool:
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        return False
    return all(isinstance(one, np.ndarray) and one.ndim == 2 for one in value)
