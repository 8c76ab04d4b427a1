"""Meshes and URDFs in the manner of Coumar et al. 2025, CoMMALab/foam. The guide "Coming from the Python foam" has the
differences."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _xml
from ._mesh import Mesh, mesh_of, read_mesh
from ._plugins import registry
from .errors import Error, InputError
from .model import Spherization

try:
    from trimesh import Scene, Trimesh  # type: ignore
except ImportError:  # trimesh is optional
    Trimesh = Mesh

    class Scene:  # type: ignore[no-redef]
        """Meshes by name: what scripts use of trimesh's Scene."""

        def __init__(self, geometry: Any = None) -> None:
            self.geometry: dict[str, Any] = {}
            for one in geometry if isinstance(geometry, (list, tuple)) else [geometry] if geometry is not None else []:
                self.add_geometry(one)

        def add_geometry(self, geometry: Any, node_name: str | None = None) -> str:
            """Add a mesh; return its name."""
            name = node_name or f"geometry_{len(self.geometry)}"
            self.geometry[name] = geometry
            return name

        def dump(self, concatenate: bool = False) -> Any:
            """Return the meshes, or all as one."""
            return as_mesh(self) if concatenate else list(self.geometry.values())


__all__ = [
    "Any", "NDArray", "Path", "Scene", "Trimesh", "URDFMesh", "URDFPrimitive", "as_mesh", "fix_mesh", "get_urdf_meshes",
    "get_urdf_primitives", "get_urdf_spheres", "load_mesh_file", "load_urdf", "np", "save_urdf", "set_urdf_spheres",
    "smooth_mesh", "tempmesh",
]  # fmt: skip


@dataclass
class URDFMesh:
    """A mesh of a <collision>: "link::file", the mesh, and its place in the link's frame (metres, radians)."""

    name: str
    mesh: Any
    xyz: NDArray[np.float64]
    rpy: NDArray[np.float64]
    scale: NDArray[np.float64]


@dataclass
class URDFPrimitive:
    """A primitive of a <collision> as a mesh: "link::primitive0"."""

    name: str
    mesh: Any
    xyz: NDArray[np.float64]
    rpy: NDArray[np.float64]
    scale: NDArray[np.float64]


def _like(made: Mesh, mesh: Any) -> Any:
    """A mesh in the caller's class."""
    if isinstance(mesh, Mesh) or Trimesh is Mesh:
        return made
    return Trimesh(vertices=np.array(made.vertices), faces=np.array(made.faces), process=False)


def load_mesh_file(path: Any) -> Any:
    """Return the mesh of a file: a Trimesh if trimesh is installed, else a foam.Mesh."""
    return _like(read_mesh(path), None)


def as_mesh(scene_or_mesh: Any) -> Any:
    """Return the meshes of a scene as one mesh; a mesh as it is."""
    geometry = getattr(scene_or_mesh, "geometry", None)
    if not isinstance(geometry, dict):
        return scene_or_mesh
    if Trimesh is not Mesh and hasattr(scene_or_mesh, "to_mesh"):
        return scene_or_mesh.to_mesh()
    if Trimesh is not Mesh and hasattr(scene_or_mesh, "dump"):  # trimesh before 4.6
        return scene_or_mesh.dump(concatenate=True)
    meshes = [mesh_of(one) for one in geometry.values()]
    if not meshes:
        raise InputError("the scene has no meshes")
    starts = np.cumsum([0] + [len(one.vertices) for one in meshes])
    return _like(Mesh(np.concatenate([one.vertices for one in meshes]),
                      np.concatenate([one.faces.astype(np.int64) + start for one, start in zip(meshes, starts)])), None)  # fmt: skip


def _replace(mesh: Any, made: Mesh) -> Any:
    """Give a mesh another surface, in place."""
    if isinstance(mesh, Mesh):
        mesh._core = made._core
    else:
        mesh.faces = np.zeros((0, 3), dtype=np.int64)
        mesh.vertices = np.array(made.vertices)
        mesh.faces = np.array(made.faces)
    return mesh


def filtered(mesh: Any, stage: str, **parameters: Any) -> Mesh:
    """Return a mesh after a mesh filter of foam."""
    return Mesh._of(_core.filtered(mesh_of(mesh)._core, registry(), stage, parameters))


def fix_mesh(mesh: Any) -> Any:
    """Repair a mesh in place: seams, holes, orientation. Return it."""
    return _replace(mesh, filtered(mesh, "repair.auto"))


def smooth_mesh(mesh: Any) -> Any:
    """Smooth a mesh in place (Humphrey, 100 iterations at most). Return it."""
    return _replace(mesh, filtered(mesh, "smooth.humphrey", iterations=100))


@contextmanager
def tempmesh() -> Iterator[tuple[Any, Path]]:
    """Give a temporary .obj file and its path."""
    with NamedTemporaryFile(suffix=".obj") as file:
        yield file, Path(file.name)


def load_urdf(urdf_path: Any) -> dict[str, Any]:
    """Return a URDF as dictionaries, like the package xmltodict; `["robot"]["@path"]` is the file."""
    path = Path(urdf_path)
    if not path.is_file():
        raise InputError(f"{path}: there is no such file")
    tree = _xml.parse(path.read_bytes(), str(path))
    if not isinstance(tree.get("robot"), dict):
        raise InputError(f"{path}: it is no URDF: there is no <robot>")
    tree["robot"]["link"] = _list(tree["robot"].get("link"))
    tree["robot"]["@path"] = path
    return tree


def save_urdf(urdf: dict[str, Any], filename: Any) -> None:
    """Write a URDF of load_urdf()."""
    robot = {key: value for key, value in urdf["robot"].items() if key != "@path"}
    Path(filename).write_text(_xml.unparse({**urdf, "robot": robot}))


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [] if value is None else [value]


def _numbers(text: str | None, default: tuple[float, ...], what: str) -> NDArray[np.float64]:
    try:
        numbers = np.array(text.split() if text else default, dtype=np.float64)
    except ValueError:
        raise InputError(f"{what}: '{text}' are no numbers") from None
    if numbers.shape != np.shape(default):
        raise InputError(f"{what}: {len(default)} numbers are expected, got '{text}'")
    return numbers


def _collisions(urdf: dict[str, Any]) -> Iterator[tuple[str, str, dict[str, Any]]]:
    """The name of each <collision> in the manner of the original, its link, and its tree."""
    for link in _list(urdf["robot"].get("link")):
        taken: dict[str, int] = {}
        primitives = 0
        for collision in _list(link.get("collision")):
            geometry = (collision or {}).get("geometry") or {}
            if "mesh" in geometry:
                name = f"{link['@name']}::{geometry['mesh']['@filename']}"
                taken[name] = taken.get(name, 0) + 1
                name += f"#{taken[name]}" if taken[name] > 1 else ""
            else:
                name = f"{link['@name']}::primitive{primitives}"
                primitives += 1
            yield name, link["@name"], collision


def _placed(collision: dict[str, Any], what: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    origin = collision.get("origin") or {}
    zero = (0.0, 0.0, 0.0)
    return _numbers(origin.get("@xyz"), zero, f"{what}: xyz"), _numbers(origin.get("@rpy"), zero, f"{what}: rpy")


def get_urdf_meshes(urdf: dict[str, Any], shrinkage: float = 1.0) -> list[URDFMesh]:
    """Return the collision meshes of a URDF. `shrinkage` multiplies their scales. The second use of a file in a link is
    called "link::file#2". Raises InputError naming the link and the file."""
    meshes = []
    base = Path(urdf["robot"]["@path"]).absolute().parent
    for name, link, collision in _collisions(urdf):
        mesh = collision["geometry"].get("mesh") if collision.get("geometry") else None
        if mesh is None:
            continue
        found, tried = _core.resolve(mesh["@filename"], str(base))
        if not str(found) or str(found) == ".":
            raise InputError(
                f"link '{link}': the mesh {mesh['@filename']} is not found. Looked at:\n  "
                + "\n  ".join(map(str, tried))
                + "\nremedy: set FOAM_PACKAGE_PATH to the folder that holds the package"
            )
        scale = _numbers(mesh.get("@scale"), (1.0, 1.0, 1.0), f"{name}: scale") * shrinkage
        meshes.append(URDFMesh(name, load_mesh_file(found), *_placed(collision, name), scale))
    return meshes


def get_urdf_primitives(urdf: dict[str, Any], shrinkage: float = 1.0) -> list[URDFPrimitive]:
    """Return the collision primitives of a URDF as meshes. Round ones are polyhedra around them."""
    primitives = []
    for name, _, collision in _collisions(urdf):
        geometry = collision.get("geometry") or {}
        shape = next((key for key in ("box", "cylinder", "sphere", "capsule") if key in geometry), None)
        if shape is not None:
            vertices, faces = _primitive(shape, geometry[shape], name)
            scale = np.full(3, float(shrinkage))
            primitives.append(URDFPrimitive(name, _like(Mesh(vertices, faces), None), *_placed(collision, name), scale))
    return primitives


def _primitive(shape: str, values: dict[str, str], name: str) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    def number(key: str) -> float:
        return float(_numbers(values.get(f"@{key}"), (0.0,), f"{name}: {key}")[0])

    if shape == "box":
        half = _numbers(values.get("@size"), (0.0, 0.0, 0.0), f"{name}: size") / 2
        corners = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2 - 1
        quads = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
        return corners * half, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    radius, length = number("radius"), 0.0 if shape == "sphere" else number("length")
    # Points on rings about the axis, on a polyhedron around the shape.
    heights: NDArray[Any]
    poles: NDArray[Any]
    widths: NDArray[Any]
    around, rows = 48, 2 if shape == "cylinder" else 24
    turn = np.linspace(0, 2 * np.pi, around, endpoint=False)
    if shape == "cylinder":
        wide = 1 / np.cos(np.pi / around)
        heights = poles = np.array([-length / 2, length / 2])
        widths = np.full(2, radius)
    else:
        polar = (np.arange(rows) + 0.5) / rows * np.pi
        wide = 1 / (np.cos(np.pi / around) * np.cos(np.pi / rows / 2))
        heights = -np.cos(polar) * radius * wide + np.where(polar < np.pi / 2, -1, 1) * length / 2
        widths, poles = np.sin(polar) * radius, np.array([-1, 1]) * (radius * wide + length / 2)
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = np.concatenate(
        [np.concatenate([ring * (w * wide), np.full((around, 1), h)], axis=1) for w, h in zip(widths, heights)]
        + [[[0, 0, poles[0]]], [[0, 0, poles[1]]]]
    )
    faces = []
    for j in range(around):
        k, last = (j + 1) % around, (rows - 1) * around
        faces += [[rows * around, k, j], [rows * around + 1, last + j, last + k]]
        for row in range(rows - 1):
            a, b = row * around + j, row * around + k
            faces += [[a, b, a + around], [b, b + around, a + around]]
    return points, np.array(faces)


def get_urdf_spheres(urdf: dict[str, Any]) -> Iterator[tuple[float, float, float, float]]:
    """Give the collision spheres of a URDF as (x, y, z, r) in the frames of their links."""
    for name, _, collision in _collisions(urdf):
        sphere = (collision.get("geometry") or {}).get("sphere")
        if sphere is not None:
            xyz, _rpy = _placed(collision, name)
            x, y, z = map(float, xyz)
            yield x, y, z, float(sphere["@radius"])


def set_urdf_spheres(urdf: dict[str, Any], spheres: dict[str, Spherization]) -> None:
    """Replace collision elements by their spheres, in place, and print the number of spheres.

    The keys are the names of URDFMesh and URDFPrimitive; other elements stay. Raises Error for a name that is none.
    """
    known = {name for name, _, _ in _collisions(urdf)}
    if unknown := [name for name in spheres if name not in known]:
        raise Error(f"{', '.join(unknown)}: no <collision> of the robot; there are: {', '.join(sorted(known))}")
    named = {id(collision): name for name, _, collision in _collisions(urdf)}
    total = 0
    for link in _list(urdf["robot"].get("link")):
        elements: list[Any] = []
        for collision in _list(link.get("collision")):
            model = spheres.get(named[id(collision)])
            if model is None:
                elements.append(collision)
                continue
            for sphere in model.spheres:
                x, y, z = map(float, sphere.origin)
                elements.append({
                    "geometry": {"sphere": {"@radius": repr(float(sphere.radius))}},
                    "origin": {"@xyz": f"{x!r} {y!r} {z!r}", "@rpy": "0 0 0"},
                })  # fmt: skip
            total += len(model.spheres)
        if elements:
            link["collision"] = elements
    print(f"Number of spheres: {total}")
