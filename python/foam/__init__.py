"""Spheres around robots and objects, with a proof that the geometry is inside.

    cover = foam.cover("part.stl", 16)
    cover.spheres      # (n, 4): x, y, z, r in metres

Submodules are imported when they are first used, and NumPy with them.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any



def _no_core(error: ImportError) -> str:
    """Return why the module _core cannot be loaded, and what to do."""
    import re
    import sys
    from pathlib import Path

    files = [file.name for file in Path(__path__[0]).glob("_core.*")]
    minors = sorted(int(found[1]) for found in (re.search(r"\.cpython-3(\d+)-", name) for name in files) if found)
    if minors and sys.version_info.minor not in minors:
        versions = ", ".join(f"3.{minor}" for minor in minors)
        return (
            f"this foam is for CPython {versions}, and this is {sys.version.split()[0]}; remedy: one of these, or "
            "`pip install .` in a clone"
        )
    return (
        f"foam's module _core cannot be loaded from {__path__[0]} ({error}); remedy: in a clone, start Python by "
        "`./foam python`; otherwise check that the package was built for this Python"
    )


try:
    from . import _core
except ImportError as error:
    raise ImportError(_no_core(error)) from error

from .errors import Cancelled, Error, GeometryError, InputError, UsageError

if TYPE_CHECKING:
    from ._adapters import from_trimesh
    from ._batch import BatchEntry, read_batch
    from ._cover import Cover
    from ._elements import Element as Element
    from ._elements import (
        BoxElement,
        CapsuleElement,
        CylinderElement,
        Elements,
        EllipsoidElement,
        HullElement,
        SphereElement,
        SweptBoxElement,
    )
    from ._events import Event
    from ._installation import example
    from ._judge import Format, certify, compare, describe, evaluate, formats, plugins, self_collision, stages
    from ._mesh import Mesh, read_mesh
    from ._model import SphereModel, read_spheres
    from ._own_stages import Budget, Shape, spherizer
    from ._results import Certificate, Comparison, Evaluation, Figures, Pair, SelfCollision
    from ._robot import Joint, Robot, load
    from ._runs import Finding, Run, check, run, run_each
    from ._search import ProvedElement, approximate, cover, proved_least, spheres_inside, spherize, spherize_each
    from ._threads import set_threads, thread_count, threads
    from ._words import Effort as Effort
    from ._words import Geometry as Geometry
    from ._words import Kind as Kind
    from ._words import Objective as Objective
    from .external import *
    from .model import *
    from .utility import *

__version__: str = _core.version()

#: The kinds of elements, each with the names of its numbers; "position" and "rotation" are those of all.
KINDS: Mapping[Kind, tuple[str, ...]] = MappingProxyType(_core.KINDS)

#: The module of each public name.
_HOMES = {
    "approximate": "_search",
    "BatchEntry": "_batch",
    "BoxElement": "_elements",
    "Budget": "_own_stages",
    "CapsuleElement": "_elements",
    "Certificate": "_results",
    "certify": "_judge",
    "check": "_runs",
    "compare": "_judge",
    "Comparison": "_results",
    "Cover": "_cover",
    "cover": "_search",
    "CylinderElement": "_elements",
    "describe": "_judge",
    "Effort": "_words",
    "Element": "_elements",
    "Elements": "_elements",
    "EllipsoidElement": "_elements",
    "evaluate": "_judge",
    "Evaluation": "_results",
    "Event": "_events",
    "example": "_installation",
    "Figures": "_results",
    "Finding": "_runs",
    "Format": "_judge",
    "formats": "_judge",
    "from_trimesh": "_adapters",
    "Geometry": "_words",
    "HullElement": "_elements",
    "Joint": "_robot",
    "Kind": "_words",
    "load": "_robot",
    "Mesh": "_mesh",
    "Objective": "_words",
    "Pair": "_results",
    "plugins": "_judge",
    "proved_least": "_search",
    "ProvedElement": "_search",
    "read_batch": "_batch",
    "read_mesh": "_mesh",
    "read_spheres": "_model",
    "Robot": "_robot",
    "Run": "_runs",
    "run": "_runs",
    "run_each": "_runs",
    "self_collision": "_judge",
    "SelfCollision": "_results",
    "set_threads": "_threads",
    "Shape": "_own_stages",
    "SphereElement": "_elements",
    "SphereModel": "_model",
    "spheres_inside": "_search",
    "spherize": "_search",
    "spherize_each": "_search",
    "spherizer": "_own_stages",
    "stages": "_judge",
    "SweptBoxElement": "_elements",
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
    "approximate",
    "BatchEntry",
    "BoxElement",
    "Budget",
    "Cancelled",
    "CapsuleElement",
    "Certificate",
    "certify",
    "check",
    "compare",
    "Comparison",
    "Cover",
    "cover",
    "CylinderElement",
    "describe",
    "Elements",
    "EllipsoidElement",
    "Error",
    "evaluate",
    "Evaluation",
    "Event",
    "example",
    "Figures",
    "Finding",
    "Format",
    "formats",
    "from_trimesh",
    "GeometryError",
    "HullElement",
    "InputError",
    "Joint",
    "load",
    "Mesh",
    "Pair",
    "plugins",
    "proved_least",
    "ProvedElement",
    "read_batch",
    "read_mesh",
    "read_spheres",
    "Robot",
    "run",
    "Run",
    "run_each",
    "self_collision",
    "SelfCollision",
    "set_threads",
    "Shape",
    "SphereElement",
    "SphereModel",
    "spheres_inside",
    "spherize",
    "spherize_each",
    "spherizer",
    "stages",
    "SweptBoxElement",
    "thread_count",
    "threads",
    "UsageError",
]
__all__ += [name for names in _OLD.values() for name in names]


def _old(name: str) -> Any:
    """Return a module with the names of CoMMALab/foam, which are a wheel of their own."""
    try:
        return importlib.import_module(f"foam.{name}")
    except ModuleNotFoundError as error:
        if error.name != f"foam.{name}":
            raise
        raise ImportError(
            "the names of CoMMALab/foam are not installed; remedy: pip install foam-spheres-commalab"
        ) from error


if not TYPE_CHECKING:  # so that checkers know the names above, and no others

    def __getattr__(name: str) -> Any:
        if name in _OLD:
            return _old(name)
        if name not in _HOMES:
            raise AttributeError(f"module 'foam' has no attribute '{name}'")
        home = _HOMES[name]
        value = getattr(_old(home) if home in _OLD else importlib.import_module(f"foam.{home}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
