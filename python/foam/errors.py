"""The exceptions of foam. Messages name the file, link or array, the reason and the remedy."""

from __future__ import annotations

import re

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


#: Words of the command line in messages, and what they are in Python.
_IN_PYTHON = [
    (r"--rename =(\w+)", r'rename={"": "\1"}'),
    (r"--rename (\w+)=(\w+)", r'rename={"\1": "\2"}'),
    (r"--package ([^\s=]+)=(\w+)", r'packages={"\1": "\2"}'),
    (
        r"set FOAM_PACKAGE_PATH to the folder that holds the package( here)?",
        "packages=[the folder that holds the package]",
    ),
    (r"FOAM_PACKAGE_PATH=([^\s,]+)", r'packages=["\1"]'),
    (r"GZ_SIM_RESOURCE_PATH=(\w+)", r'packages=["\1"]'),
    (r"--tool-frame (\w+)", r'tool_frames=["\1"]'),
    (r"--reader (\w+)", r'reader="\1"'),
    (r"--(format|geometry|unit|method) ([\w.-]+)", r'\1="\2"'),
    (r"--scale ([\w.+-]+)", r"scale=\1"),
    (r"--set (\S+)=(\S+?)(?=[\s);]|$)", r'set={"\1": \2}'),
    (r"--set:(\d+):1", r"set, entry \1"),
    (r"--run-dir\b", "out="),
    (r"--variant\b", "variants="),
    (r"--tool-frame\b", "tool_frames="),
    (r"--weight\b", "weights="),
    (r"--lock\b", "lock_joints="),
    (r"--time-limit\b", "time_limit="),
    (r"--(set|keep|skip|rename|reader|method|objective|format|unit|scale|geometry)\b", r"\1="),
    (r"`foam (formats|stages|plugins)( --why)?`", r"foam.\1()"),
]


def in_python(message: str) -> str:
    """Return a message of the C++ libraries with names of arguments in place of the command line's options."""
    for option, argument in _IN_PYTHON:
        message = re.sub(option, argument, message)
    return message


def error_of(code: str, message: str) -> Error:
    """Return the exception for an error of the C++ libraries."""
    error = _KINDS.get(code, Error)(in_python(message))
    error.code = code
    return error
