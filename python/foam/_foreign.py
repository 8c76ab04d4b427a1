"""Meshes and point clouds of other packages as arrays. What objects have tells what they are; nothing is imported."""

from __future__ import annotations

import importlib
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from .errors import InputError

REMEDY = (
    "remedy: a path, (vertices, faces), or a mesh of foam, trimesh, Open3D, PyVista, manifold3d or coacd; "
    "points need radii="
)


class Arrays(NamedTuple):
    """What an object has, in metres; faces of None: points."""

    vertices: Any
    faces: Optional[Any]


def arrays_of(thing: Any, what: str) -> Arrays:
    """Return the arrays of a mesh or a point cloud of another package. Raises InputError for anything else."""
    for read in (_manifold, _tensor, _pyvista, _trimesh_scene, _vertices):
        found = read(thing, what)
        if found is not None:
            return found
    if hasattr(thing, "worldbody") or hasattr(thing, "write_xml_string"):
        raise InputError(f"{what}: {type(thing).__name__} is a robot; remedy: foam.load({what}).cover(…)")
    raise InputError(f"{what}: {type(thing).__name__} is no mesh; {REMEDY}")


def _manifold(thing: Any, what: str) -> Arrays | None:
    """manifold3d: a Manifold, or the Mesh that it is made of."""
    if hasattr(thing, "to_mesh64"):
        thing = thing.to_mesh64()
    if not hasattr(thing, "vert_properties"):
        return None
    return Arrays(np.asarray(thing.vert_properties)[:, :3], np.asarray(thing.tri_verts, dtype=np.int64))


def _tensor(thing: Any, what: str) -> Arrays | None:
    """Open3D's tensors, which may lie on another device."""
    if not type(thing).__module__.startswith("open3d") or hasattr(thing, "line"):
        return None
    if hasattr(thing, "point"):
        return Arrays(_tensor_of(thing.point, "positions", what), None)
    if hasattr(thing, "vertex") and hasattr(thing, "triangle"):
        return Arrays(_tensor_of(thing.vertex, "positions", what), _tensor_of(thing.triangle, "indices", what))
    return None


def _tensor_of(values: Any, key: str, what: str) -> NDArray[Any]:
    if key not in values:
        raise InputError(f"{what}: it has no {key}; remedy: set them")
    return np.asarray(values[key].cpu().numpy())


def _pyvista(thing: Any, what: str) -> Arrays | None:
    """PyVista, whose faces are 3, a, b, c, 3, …."""
    points, faces = getattr(thing, "points", None), getattr(thing, "faces", None)
    if points is None or hasattr(thing, "vertices"):
        return None
    if faces is None:
        if hasattr(thing, "extract_surface"):
            raise InputError(f"{what}: {type(thing).__name__} is no surface; remedy: .extract_surface().triangulate()")
        return Arrays(np.asarray(points), None) if type(thing).__name__ == "PointCloud" else None  # Open3D
    array = np.asarray(faces)
    if not array.size:
        return Arrays(np.asarray(points), None)
    if array.ndim == 2:
        return Arrays(np.asarray(points), array)
    if array.ndim != 1 or array.size % 4 or (array.reshape(-1, 4)[:, 0] != 3).any():
        raise InputError(f"{what}: not all faces are triangles; remedy: mesh.triangulate()")
    return Arrays(np.asarray(points), array.reshape(-1, 4)[:, 1:])


def _trimesh_scene(thing: Any, what: str) -> Arrays | None:
    """A scene of trimesh: its meshes where they stand."""
    if not isinstance(getattr(thing, "geometry", None), dict):
        return None
    from .utility import as_mesh

    whole = as_mesh(thing)
    return Arrays(np.asarray(whole.vertices) * _metres(thing, what), whole.faces)


def _vertices(thing: Any, what: str) -> Arrays | None:
    """trimesh, Open3D and coacd: vertices, and faces, triangles or indices."""
    vertices = getattr(thing, "vertices", None)
    if vertices is None:
        return None
    faces = next(
        (found for name in ("faces", "triangles", "indices") if (found := getattr(thing, name, None)) is not None), None
    )
    if faces is None and type(thing).__name__ != "PointCloud":  # trimesh has one
        return None
    unit = _metres(thing, what)
    return Arrays(vertices if unit == 1 else np.asarray(vertices, dtype=np.float64) * unit, faces)


def _metres(thing: Any, what: str) -> float:
    """Return the metres of a unit of an object of trimesh; 1 where it names none."""
    units = getattr(thing, "units", None)
    if not isinstance(units, str) or not type(thing).__module__.startswith("trimesh"):
        return 1.0
    try:
        return float(importlib.import_module("trimesh.units").unit_conversion(units, "meters"))
    except (KeyError, ValueError):
        raise InputError(
            f"{what}: its units are '{units}', which trimesh does not know; remedy: mesh.units = 'mm'"
        ) from None


def points_of(thing: Any) -> NDArray[np.float64] | None:
    """Return the points of a point cloud of another package, metres; None for anything else."""
    if isinstance(thing, (str, bytes, tuple, list, np.ndarray)):
        return None
    try:
        found = arrays_of(thing, "points")
    except InputError:
        return None
    return np.asarray(found.vertices, dtype=np.float64) if found.faces is None else None
