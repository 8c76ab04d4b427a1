"""Spheres around robots and objects, with a proof that the geometry is inside.

    cover = foam.spherize("part.stl", 16)
    cover.spheres      # (n, 4): x, y, z, r in metres

Submodules are imported when they are first used, and NumPy with them.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

try:
    from . import _core
except ImportError as error:
    raise ImportError(
        f"foam's module _core cannot be loaded from {__path__[0]} ({error}); remedy: in a clone, start Python by "
        "`./foam python`; otherwise check that the package was built for this Python"
    ) from error

from .errors import Cancelled, Error, GeometryError, InputError, UsageError

if TYPE_CHECKING:
    from ._adapters import from_trimesh
    from ._batch import BatchEntry, read_batch
    from ._cover import Cover, ProvedElement, approximate, cover, proved_least, spheres_inside, spherize, spherize_each
    from ._judge import certify, describe, evaluate, plugins, self_collision, stages
    from ._mesh import Mesh, read_mesh
    from ._model import SphereModel, read_spheres
    from ._own_stages import Budget, Shape, spherizer
    from ._results import Certificate, Evaluation, Figures, SelfCollision
    from ._robot import Joint, Robot, load
    from ._runs import Event, Finding, Run, check, run
    from ._threads import set_threads, thread_count, threads

__version__: str = _core.version()

#: The kinds of elements, each with the names of its numbers; "position" and "rotation" are those of all.
KINDS: Mapping[str, tuple[str, ...]] = MappingProxyType(_core.KINDS)

#: The module of each public name.
_HOMES = {
    "Budget": "_own_stages",
    "Shape": "_own_stages",
    "spherizer": "_own_stages",
    "from_trimesh": "_adapters",
    "BatchEntry": "_batch",
    "Certificate": "_results",
    "Cover": "_cover",
    "Evaluation": "_results",
    "Event": "_runs",
    "Figures": "_results",
    "Finding": "_runs",
    "Joint": "_robot",
    "Mesh": "_mesh",
    "Robot": "_robot",
    "Run": "_runs",
    "SelfCollision": "_results",
    "SphereModel": "_model",
    "approximate": "_cover",
    "cover": "_cover",
    "certify": "_judge",
    "check": "_runs",
    "describe": "_judge",
    "evaluate": "_judge",
    "load": "_robot",
    "plugins": "_judge",
    "ProvedElement": "_cover",
    "proved_least": "_cover",
    "read_batch": "_batch",
    "read_mesh": "_mesh",
    "read_spheres": "_model",
    "run": "_runs",
    "self_collision": "_judge",
    "set_threads": "_threads",
    "spheres_inside": "_cover",
    "spherize": "_cover",
    "spherize_each": "_cover",
    "stages": "_judge",
    "thread_count": "_threads",
    "threads": "_threads",
}

#: The names of CoMMALab/foam, which scripts get by `from foam import *`.
_OLD = {
    "model": [
        "Sphere",
        "SphereDecoder",
        "SphereEncoder",
        "Spherization",
    ],
    "utility": [
        "Any",
        "NDArray",
        "Path",
        "Scene",
        "Trimesh",
        "URDFMesh",
        "URDFPrimitive",
        "as_mesh",
        "fix_mesh",
        "get_urdf_meshes",
        "get_urdf_primitives",
        "get_urdf_spheres",
        "load_mesh_file",
        "load_urdf",
        "np",
        "save_urdf",
        "set_urdf_spheres",
        "smooth_mesh",
        "tempmesh",
    ],
    "external": [
        "ParallelSpherizer",
        "SpherizationDatabase",
        "SpherizationHelper",
        "check_valid_for_spherization",
        "compute_spheres",
        "compute_spheres_helper",
        "manifold",
        "manifold_plus",
        "read_spherization_file",
        "simplify",
        "simplify_manifold",
        "smooth_manifold",
        "spherize_mesh",
    ],
}
_HOMES.update({name: home for home, names in _OLD.items() for name in names})

__all__ = [
    "Budget",
    "Shape",
    "spherizer",
    "from_trimesh",
    "BatchEntry",
    "Cancelled",
    "Certificate",
    "Cover",
    "Error",
    "Evaluation",
    "Event",
    "Figures",
    "Finding",
    "GeometryError",
    "InputError",
    "Joint",
    "Mesh",
    "Robot",
    "Run",
    "SelfCollision",
    "SphereModel",
    "UsageError",
    "approximate",
    "cover",
    "ProvedElement",
    "proved_least",
    "certify",
    "check",
    "describe",
    "evaluate",
    "load",
    "plugins",
    "read_batch",
    "read_mesh",
    "read_spheres",
    "run",
    "self_collision",
    "set_threads",
    "spheres_inside",
    "spherize",
    "spherize_each",
    "stages",
    "thread_count",
    "threads",
]
__all__ += [name for names in _OLD.values() for name in names]


def __getattr__(name: str) -> Any:
    if name in ("model", "utility", "external"):
        return importlib.import_module(f"foam.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'foam' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"foam.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
