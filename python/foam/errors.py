"""The exceptions of foam. Messages name the file, link or array, the reason and the remedy."""

from __future__ import annotations

__all__ = ["Error", "InputError", "GeometryError", "UsageError", "Cancelled"]


class Error(ValueError, RuntimeError):
    """The base of all errors of foam.

    `code` is the kind of failure: usage, recipe, plugin, input, geometry, output, internal or cancelled.
    """

    code = "internal"


class InputError(Error):
    """A file or an array cannot be read, or has other contents than expected."""

    code = "input"


class GeometryError(Error):
    """A stage cannot do its work on this geometry."""

    code = "geometry"


class UsageError(Error):
    """An argument or a recipe is wrong."""

    code = "usage"


class Cancelled(Error):
    """The work was stopped, e.g. by a callback."""

    code = "cancelled"


_KINDS = {
    "usage": UsageError,
    "recipe": UsageError,
    "input": InputError,
    "geometry": GeometryError,
    "cancelled": Cancelled,
}


def error_of(code: str, message: str) -> Error:
    """Return the exception for an error of the C++ libraries."""
    error = _KINDS.get(code, Error)(message)
    error.code = code
    return error
