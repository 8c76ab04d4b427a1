"""Spheres around robots and objects, with a proof that the geometry is inside.

    cover = foam.spherize("part.stl", 16)
    cover.spheres      # (n, 4): x, y, z, r in metres

Submodules are imported when they are first used, and NumPy with them.
"""

from __future__ import annotations

import importlib
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
    from ._cover import Cover, spheres_inside, spherize, spherize_each
    from ._mesh import Mesh, read_mesh
    from ._threads import set_threads, thread_count, threads

__version__: str = _core.version()

#: The module of each public name.
_HOMES = {
    "Cover": "_cover",
    "Mesh": "_mesh",
    "read_mesh": "_mesh",
    "set_threads": "_threads",
    "spheres_inside": "_cover",
    "spherize": "_cover",
    "spherize_each": "_cover",
    "thread_count": "_threads",
    "threads": "_threads",
}

__all__ = [
    "Cancelled",
    "Cover",
    "Error",
    "GeometryError",
    "InputError",
    "Mesh",
    "UsageError",
    "read_mesh",
    "set_threads",
    "spheres_inside",
    "spherize",
    "spherize_each",
    "thread_count",
    "threads",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'foam' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"foam.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
