"""Stages that are functions of Python: @foam.spherizer."""

from __future__ import annotations

import inspect
import re
import secrets
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Optional, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _core
from ._mesh import Mesh
from .errors import UsageError

Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class Shape:
    """What a spherizer gets: a link or a mesh, metres."""

    name: str
    original: Mesh  #: the geometry that the spheres must cover
    processed: Mesh  #: what the mesh filters of the recipe made of it

    @property
    def vertices(self) -> NDArray[np.float64]:
        """The corners of the original: (n, 3)."""
        return self.original.vertices

    @property
    def faces(self) -> NDArray[np.uint32]:
        """The triangles of the original: (m, 3)."""
        return self.original.faces


@dataclass(frozen=True)
class Budget:
    """How many spheres a spherizer may return, and what they must achieve."""

    max_spheres: Optional[int]  #: None: the spherizer decides
    max_protrusion: Optional[float]  #: metres; a goal, as far as max_spheres allows
    guarantee: str  #: outer, inner or fitted
    seed: int  #: for random numbers: of the run, the stage and the shape


def spherizer(
    name: str, *, summary: str = "", original_only: bool = False, revision: int | None = None
) -> Callable[[Function], Function]:
    """Make a function a stage "spherize.NAME" of this process, for robot.spherize(method=…) and recipes.

        @foam.spherizer("spherize.mine")
        def mine(shape, budget, margin=0.0):
            return np.array([[0, 0, 0, 1.0]])      # (n, 4): x, y, z, r

    The function gets a Shape and a Budget, and returns at most budget.max_spheres spheres. foam grows them until they
    cover the shape, and proves it. Keyword parameters with defaults (bool, int, float or str) are parameters of the stage. foam
    calls the function from its own threads, one call at a time. What it raises ends the link with its traceback.

    Args:
        name: "spherize." and a word of lower-case letters, digits and "_".
        summary: a sentence; default: the first line of the docstring.
        original_only: whether it looks at shape.original alone, so that mesh filters before it are left out.
        revision: of the function. With it, results of other processes are taken from the cache; change it with the
            function. Without it, only this process uses them.

    Raises UsageError for a name that is taken by a plugin, and for other parameters.
    """
    if not re.fullmatch(r"spherize\.[a-z][a-z0-9_]*", name):
        raise UsageError(f"'{name}': 'spherize.' and a word of a-z, 0-9 and _ is expected")

    def declare(function: Function) -> Function:
        from . import _plugins
        from ._judge import stages

        if name not in _core.own_stages() and name in stages():
            raise UsageError(f"{name} is a stage of the plugin {stages()[name]['plugin']}; remedy: another name")
        words = (function.__doc__ or function.__name__).strip().splitlines()
        parameters = _parameters(name, function)
        number = secrets.randbelow(2**30) + 1 if revision is None else revision
        _core.declare_spherizer(name, summary or words[0], function, original_only, number, parameters)
        _plugins.forget()
        return function

    return declare


def _parameters(name: str, function: Callable[..., Any]) -> dict[str, Any]:
    declared = list(inspect.signature(function).parameters.values())
    if len(declared) < 2:
        raise UsageError(f"{name}: a function of (shape, budget) is expected")
    for parameter in declared[2:]:
        if not isinstance(parameter.default, (bool, int, float, str)):
            raise UsageError(f"{name}: the parameter '{parameter.name}' needs a default, a bool, int, float or str")
    return {parameter.name: parameter.default for parameter in declared[2:]}


def call(
    function: Callable[..., Any], name: str, original: Any, processed: Any, most: int | None, protrusion: float | None,
    guarantee: str, seed: int, parameters: dict[str, Any],
) -> NDArray[np.float64]:  # fmt: skip
    """Call a spherizer of Python for C++."""
    shape = Shape(name, Mesh._of(original), Mesh._of(processed))
    rows = _arrays.rows(function(shape, Budget(most, protrusion, guarantee, seed), **parameters), "the spheres", 4)
    if not len(rows) or not np.isfinite(rows).all() or (rows[:, 3] <= 0).any():
        raise ValueError(f"{function.__name__}: at least one sphere is expected, finite and with radii above 0")
    if most is not None and len(rows) > most:
        raise ValueError(f"{function.__name__}: {len(rows)} spheres, but the budget is {most}")
    return rows
