"""Spherization in the manner of Coumar et al. 2025, CoMMALab/foam, by foam's own stages. No external program is run."""

from __future__ import annotations

import atexit
import json
import os
import warnings
import weakref
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures import wait as future_wait
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._mesh import Mesh, mesh_of
from ._plugins import registry
from .errors import Error, InputError, UsageError
from .model import Sphere, SphereDecoder, SphereEncoder, Spherization
from .utility import _like, filtered, load_mesh_file, smooth_mesh

__all__ = [
    "ParallelSpherizer", "SpherizationDatabase", "SpherizationHelper", "check_valid_for_spherization", "compute_spheres",
    "compute_spheres_helper", "manifold", "manifold_plus", "read_spherization_file", "simplify", "simplify_manifold",
    "smooth_manifold", "spherize_mesh",
]  # fmt: skip

METHODS = ("medial", "grid", "octree", "hubbard", "spawn", "cover", "voxel")

#: The parameters of compute_spheres() and their values there; values that differ are handed on.
_DEFAULTS: dict[str, Any] = {
    "testerLevels": 2, "numCover": 5000, "minCover": 5, "initSpheres": 1000, "minSpheres": 200, "erFact": 2,
    "expand": True, "merge": True, "burst": False, "optimise": True, "maxOptLevel": 1, "balExcess": 0.05,
    "verify": False, "num_samples": 500, "min_samples": 1,
}  # fmt: skip
_told: set[str] = set()


def _note(text: str) -> None:
    """Warn once in a process."""
    if text not in _told:
        _told.add(text)
        warnings.warn(text, UserWarning, stacklevel=4)


def _stage(method: str) -> str:
    if not isinstance(method, str):
        raise UsageError(
            f"method: a word is expected, got {type(method).__name__}; remedy: `method` stands before `orientation`: "
            "spherize_mesh(name, mesh, scale, position, method, orientation, …)"
        )
    from ._judge import stages

    if method not in METHODS:
        raise UsageError(f"unknown method '{method}'; there are: {', '.join(METHODS)}")
    if f"spherize.{method}" in stages():
        return f"spherize.{method}"
    _note(f"spherize.{method} is not installed (it is part of the GPL plugins): spherize.cover takes its place")
    return "spherize.cover"


def check_valid_for_spherization(method: str, mesh: Any) -> bool:
    """Return whether foam can spherize the mesh: any mesh with a triangle of some size, whatever the method."""
    _stage(method)
    given = mesh_of(mesh)
    return bool(len(given.faces)) and given.area > 0


def manifold(mesh: Any, leaves: int = 1000) -> Any:
    """Return the mesh repaired to a closed 2-manifold (repair.auto)."""
    return _like(filtered(mesh, "repair.auto", leaves=int(leaves)), mesh)


def manifold_plus(mesh: Any, depth: int = 8) -> Any:
    """Return the mesh repaired to a closed 2-manifold; a depth of 8 is as fine as manifold() with 1000 leaves."""
    return manifold(mesh, max(8, min(10**7, int(1000 * 4.0 ** (depth - 8)))))


def simplify(mesh: Any, ratio: float = 0.5, aggressiveness: float = 7.0) -> Any:
    """Return the mesh with about this share of its triangles (simplify.quadric). `aggressiveness` has no effect."""
    if aggressiveness != 7.0:
        _note("simplify: aggressiveness has no effect")
    return _like(filtered(mesh, "simplify.quadric", ratio=float(ratio), min_triangles=4), mesh)


def simplify_manifold(mesh: Any, ratio: float = 0.5) -> Any:
    """Return simplify(mesh, ratio); a closed 2-manifold stays one."""
    return simplify(mesh, ratio)


def smooth_manifold(mesh: Any, manifold_leaves: int = 1000, ratio: float = 0.2) -> Any:
    """Return the mesh repaired, simplified and smoothed."""
    return smooth_mesh(simplify_manifold(manifold(mesh, manifold_leaves), ratio))


def compute_spheres(
    mesh: Any, depth: int = 1, branch: int = 8, method: str = "medial", testerLevels: int = 2, numCover: int = 5000,
    minCover: int = 5, initSpheres: int = 1000, minSpheres: int = 200, erFact: int = 2, expand: bool = True,
    merge: bool = True, burst: bool = False, optimise: bool = True, maxOptLevel: int = 1, balExcess: float = 0.05,
    verify: bool = False, num_samples: int = 500, min_samples: int = 1,
) -> list[Spherization]:  # fmt: skip
    """Return depth + 1 spherizations of a mesh: one sphere, at most `branch`, at most branch², …. All are proved to cover
    the mesh. The other parameters are those of spherize.medial; what a method does not have is noted once."""
    given = {name: value for name, value in locals().items() if name in _DEFAULTS and value != _DEFAULTS[name]}
    return _levels(mesh_of(mesh), None, depth, branch, method, given)


def _levels(
    mesh: Mesh, processed: Mesh | None, depth: int, branch: int, method: str, given: dict[str, Any]
) -> list[Spherization]:
    from ._judge import describe

    depth, branch = int(depth), max(1, int(branch))
    if not 0 <= depth <= 6 or branch**depth > 100_000:
        raise UsageError(f"depth {depth} and branch {branch}: depths of 0 to 6 and 100000 spheres are possible")
    stage = _stage(method)
    declared = {parameter["name"]: parameter["type"] for parameter in describe(stage)["parameters"]}
    types: dict[str, Any] = {"integer": int, "number": float, "boolean": bool}
    parameters = {name: types[declared[name]](value) for name, value in given.items() if name in declared}
    for name in given:
        if name not in declared:
            _note(f"{name} has no effect on {stage}; its spheres are proved, not tested by samples")
    counts = [] if stage == "spherize.medial" and depth >= 2 else [branch**level for level in range(depth + 1)]
    if not counts:
        parameters |= {"depth": depth, "branch": branch}
    levels = _core.levels_by(mesh._core, None if processed is None else processed._core, registry(), stage, parameters, counts, 0)
    return [_spherization(*level) for level in levels]


def _spherization(rows: Any, certified: bool, mean: float, best: float, worst: float) -> Spherization:
    return Spherization([Sphere(x, y, z, r) for x, y, z, r in np.asarray(rows).tolist()], mean, best, worst, certified)


def compute_spheres_helper(mesh: Any, command: Any, method: str) -> list[Spherization]:
    """Raise UsageError: the external programs do not exist here."""
    raise UsageError("compute_spheres_helper ran a program of the sphere-tree toolkit; remedy: compute_spheres()")


def read_spherization_file(filename: Any, offset: ArrayLike = (0.0, 0.0, 0.0)) -> list[Spherization]:
    """Return the levels of a .sph file of the sphere-tree toolkit. Its spheres are not proved. Raises InputError."""
    file = Path(filename)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    lines = file.read_text(errors="replace").splitlines()
    try:
        levels, branch = (int(word) for word in lines[0].split()[:2])
        counts = [branch**level for level in range(levels)]
        if not 1 <= levels <= 16 or sum(counts) >= len(lines):
            raise ValueError("fewer lines than its first line states")
        numbers = [[float(word) for word in line.split()[:5]] for line in lines[1 : 1 + sum(counts)]]
        result, at = [], 0
        for count in counts:
            rows = [row for row in numbers[at : at + count] if row[3] > 0]
            errors = [row[4] for row in rows if len(row) > 4] or [0.0]
            spheres = [Sphere(row[0], row[1], row[2], row[3], offset) for row in rows]
            result.append(Spherization(spheres, float(np.mean(errors)), min(errors), max(errors)))
            at += count
        return result
    except (ValueError, IndexError) as error:
        raise InputError(f"{file}: it is no .sph file ({error})") from None


def _matrix(scale: Any, position: Any, orientation: Any) -> NDArray[np.float64]:
    """p -> R (scale p) + position; orientation: roll, pitch, yaw about fixed axes, as in URDF."""
    roll, pitch, yaw = np.zeros(3) if orientation is None else np.asarray(orientation, dtype=np.float64)
    (cr, sr), (cp, sp), (cy, sy) = ((np.cos(angle), np.sin(angle)) for angle in (roll, pitch, yaw))
    turn = np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]])  # fmt: skip
    matrix = np.eye(4)
    matrix[:3, :3] = turn * (1.0 if scale is None else np.broadcast_to(np.asarray(scale, dtype=np.float64), 3))
    matrix[:3, 3] = 0.0 if position is None else np.asarray(position, dtype=np.float64)
    return matrix


def spherize_mesh(
    name: Any, mesh: Any = None, scale: Any = None, position: Any = None, orientation: Any = None,
    spherization_kwargs: dict[str, Any] = {}, process_kwargs: dict[str, Any] = {},
) -> list[Spherization]:  # fmt: skip
    """Return depth + 1 spherizations of a mesh that is scaled, then turned and moved.

    Args:
        name: for messages; revisions without it, which begin with the mesh, are understood.
        mesh: a mesh or a path. scale, position, orientation: (3,) each; roll, pitch, yaw as in URDF.
        spherization_kwargs: those of compute_spheres(); "method" is required.
        process_kwargs: manifold_leaves and ratio, of the repair and simplification that the spherizer works on.

    Raises: Error, a RuntimeError, naming the mesh.
    """
    if not isinstance(name, str) or (mesh is None and isinstance(name, str)):
        if mesh is not None:
            scale, position, orientation = mesh, scale, position
        name, mesh = "mesh", name
    given = dict(spherization_kwargs)
    if "method" not in given:
        raise UsageError(f"{name}: spherization_kwargs needs 'method'; there are: {', '.join(METHODS)}")
    method, depth, branch = given.pop("method"), given.pop("depth", 1), given.pop("branch", 8)
    if unknown := [key for key in given if key not in _DEFAULTS]:
        raise UsageError(f"{name}: spherization_kwargs: unknown: {', '.join(unknown)}; there are: {', '.join(_DEFAULTS)}")
    changed = {key: value for key, value in given.items() if value != _DEFAULTS[key] and key != "verify"}
    try:
        whole = mesh_of(load_mesh_file(mesh) if isinstance(mesh, (str, os.PathLike)) else mesh).copy()
        whole.apply_transform(_matrix(scale, position, orientation))
        processed = None
        if _stage(method) in ("spherize.medial", "spherize.hubbard"):  # others look at the original alone
            leaves, ratio = process_kwargs.get("manifold_leaves", 1000), process_kwargs.get("ratio", 0.2)
            processed = filtered(whole, "repair.auto", leaves=int(leaves))
            processed = filtered(processed, "simplify.quadric", ratio=float(ratio))
            processed = filtered(processed, "smooth.humphrey")
        return _levels(whole, processed, depth, branch, method, changed)
    except Error as error:
        raise type(error)(f"Failed to process {name}: {error}") from None


class ParallelSpherizer:
    """Spherizations in threads."""

    def __init__(self, threads: int = 4) -> None:
        self.executor = ThreadPoolExecutor(max_workers=threads)
        self.waiting: dict[str, Future[list[Spherization]]] = {}

    def spherize_mesh(
        self, name: str, mesh: Any, scale: Any = None, position: Any = None, orientation: Any = None,
        spherization_kwargs: dict[str, Any] = {}, process_kwargs: dict[str, Any] = {},
    ) -> Future[list[Spherization]]:  # fmt: skip
        """Start spherize_mesh() and return its future."""
        arguments = (name, mesh, scale, position, orientation, spherization_kwargs, process_kwargs)
        future = self.executor.submit(spherize_mesh, *arguments)
        self.waiting[name] = future
        return future

    def wait(self) -> None:
        """Wait until all are done."""
        future_wait(self.waiting.values())

    def get(self, name: str) -> list[Spherization]:
        """Wait for one and return it."""
        return self.waiting[name].result()


class SpherizationDatabase:
    """Spherizations by mesh, branch and depth, in a JSON file that is read at the start. It is written by save(), at the
    exit of Python, and when the object goes; a good file is never replaced by an empty one."""

    def __init__(self, path: Any) -> None:
        self.path = Path(path)
        self.db: dict[str, dict[int, dict[int, Spherization]]] = {}
        self._changed = False
        if self.path.is_file() and self.path.stat().st_size:
            try:
                read = json.loads(self.path.read_text(), cls=SphereDecoder)
                self.db = {
                    mesh: {int(b): {int(d): one for d, one in depths.items()} for b, depths in branches.items()}
                    for mesh, branches in read.items()
                }
            except (ValueError, AttributeError) as error:
                raise InputError(f"{self.path}: it is no database of spheres ({error}); remedy: another name") from None
        _open_databases.add(self)

    def __del__(self) -> None:
        try:
            self.save()
        except Exception:  # the interpreter may be going
            pass

    def save(self) -> None:
        """Write the file if something was added."""
        if not getattr(self, "_changed", False):
            return
        partial = self.path.with_name(f"{self.path.name}.partial-{os.getpid()}")
        partial.write_text(json.dumps(self.db, indent=4, cls=SphereEncoder))
        os.replace(partial, self.path)
        self._changed = False

    def add(self, mesh: str, branch: int, depth: int, spherization: Spherization) -> None:
        """Add a spherization; of two the better one is kept."""
        depths = self.db.setdefault(mesh, {}).setdefault(branch, {})
        if depth not in depths or spherization < depths[depth]:
            depths[depth] = spherization
            self._changed = True

    def get(self, mesh: str, branch: int, depth: int) -> Spherization:
        """Return a spherization. Raises KeyError."""
        return self.db[mesh][branch][depth]

    def exists(self, mesh: str, branch: int, depth: int) -> bool:
        """Return whether there is one."""
        return depth in self.db.get(mesh, {}).get(branch, {})


_open_databases: weakref.WeakSet[SpherizationDatabase] = weakref.WeakSet()


@atexit.register
def _save_all() -> None:
    for database in list(_open_databases):
        database.save()


class SpherizationHelper:
    """Spherizations in threads, kept in a database."""

    def __init__(self, database: Any, threads: int = 8) -> None:
        self.ps = ParallelSpherizer(threads)
        self.db = SpherizationDatabase(database)

    def spherize_mesh(
        self, name: str, mesh: Any, scale: Any = None, position: Any = None, method: str = "medial",
        orientation: Any = None, depth: int = 1, branch: int = 8, testerLevels: int = 2, numCover: int = 5000,
        minCover: int = 5, initSpheres: int = 1000, minSpheres: int = 200, erFact: int = 2, expand: bool = True,
        merge: bool = True, burst: bool = False, optimise: bool = True, maxOptLevel: int = 1, balExcess: float = 0.05,
        verify: bool = True, eval: bool = False, num_samples: int = 500, min_samples: int = 1,
        manifold_leaves: int = 1000, simplification_ratio: float = 0.2,
    ) -> None:  # fmt: skip
        """Start spherize_mesh(), unless the database has the result. A branch below 1 counts as 1."""
        given = {key: value for key, value in locals().items() if key in _DEFAULTS}
        _stage(method)
        branch = max(1, int(branch))
        if not self.db.exists(name, branch, depth):
            self.ps.spherize_mesh(
                name, mesh, scale, position, orientation,
                {"method": method, "depth": depth, "branch": branch, **given},
                {"manifold_leaves": manifold_leaves, "ratio": simplification_ratio},
            )  # fmt: skip

    def get_spherization(self, name: str, depth: int = 1, branch: int = 8, cache: bool = True) -> Spherization:
        """Wait for a spherization and return its level `depth`. Raises Error naming the mesh."""
        if self.db.exists(name, branch, depth):
            return self.db.get(name, branch, depth)
        if name not in self.ps.waiting:
            raise Error(f"{name}: there is no spherization of branch {branch} and depth {depth}; remedy: spherize_mesh()")
        levels = self.ps.get(name)
        if cache:
            for level, spherization in enumerate(levels):
                self.db.add(name, branch, level, spherization)
        return levels[min(depth, len(levels) - 1)]
