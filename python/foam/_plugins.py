"""The plugins, loaded when they are first needed."""

from __future__ import annotations

import threading

from . import _core

_lock = threading.Lock()
_registry: _core.Registry | None = None


def registry() -> _core.Registry:
    """Return the registry of all stages."""
    global _registry
    with _lock:
        if _registry is None:
            _registry = _core.Registry([])
        return _registry


def forget() -> None:
    """Make the next use of the registry a new one, with the stages of this process."""
    global _registry
    with _lock:
        _registry = None
