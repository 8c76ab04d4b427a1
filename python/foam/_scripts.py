"""The scripts of Coumar et al. 2025, CoMMALab/foam: foam-generate-sphere-urdf and foam-generate-spheres."""

from __future__ import annotations

import ast
import inspect
import json
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .errors import Error, UsageError


def _value(text: str) -> Any:
    """A value as Google Fire reads it."""
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return text


def parsed(words: Sequence[str], main: Callable[..., Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the arguments of a function from words as Google Fire reads them, and the flags that it does not have.

    --flag value, --flag=value, --flag (true), --noflag (false); "-" and "_" are alike; others are positional.
    """
    names = [p.name for p in inspect.signature(main).parameters.values() if p.kind is p.POSITIONAL_OR_KEYWORD]
    values: dict[str, Any] = {}
    others: dict[str, Any] = {}
    free = [name for name in names]
    rest = list(words)
    while rest:
        word = rest.pop(0)
        if not word.startswith("--"):
            if not free:
                raise UsageError(f"'{word}' is one argument too many")
            values[free.pop(0)] = word if isinstance(_value(word), str) else _value(word)
            continue
        flag, _, text = word[2:].partition("=")
        name = flag.replace("-", "_")
        if name not in names and name.startswith("no") and name[2:] in names and "=" not in word:
            name, value = name[2:], False
        elif "=" in word:
            value = _value(text)
        elif rest and not rest[0].startswith("--"):
            value = _value(rest.pop(0))
        else:
            value = True
        if name in names:
            values[name] = value
            free = [one for one in free if one != name]
        else:
            others[flag] = value
    return values, others


def _run(main: Callable[..., Any], usage: str) -> int:
    words = sys.argv[1:]
    if any(word in ("-h", "--help") for word in words):
        print(usage)
        return 0
    try:
        values, others = parsed(words, main)
        if "_flags" in inspect.signature(main).parameters:
            values["_flags"] = others
        elif others:
            raise UsageError(f"unknown flag --{next(iter(others))}; --help lists the flags")
        missing = [
            p.name for p in inspect.signature(main).parameters.values() if p.default is p.empty and p.name not in values
        ]
        if missing:
            raise UsageError(f"{', '.join(missing)} is missing; --help lists the arguments")
        main(**values)
    except Error as error:
        print(f"foam: {error}", file=sys.stderr)
        return 2 if isinstance(error, UsageError) else 1
    return 0


def generate_sphere_urdf(
    filename: str = "assets/panda/panda.urdf", output: str = "spherized.urdf", database: str = "sphere_database.json",
    depth: int = 1, branch: int = 8, method: str = "medial", testerLevels: int = 2, numCover: int = 5000,
    minCover: int = 5, initSpheres: int = 1000, minSpheres: int = 200, erFact: int = 2, expand: bool = True,
    merge: bool = True, burst: bool = False, optimise: bool = True, maxOptLevel: int = 1, balExcess: float = 0.05,
    verify: bool = True, num_samples: int = 500, min_samples: int = 1, use_volume_heuristic: bool = False,
    volume_heuristic_ratio: float = 0.7, manifold_leaves: int = 1000, simplification_ratio: float = 0.2,
    threads: int = 16, shrinkage: float = 1.0, *, _flags: dict[str, Any] = {},
) -> None:  # fmt: skip
    """Write a URDF with spheres for its collision geometry; `_flags`: multipliers of the budget by link."""
    given = {key: value for key, value in locals().items() if key in _search_flags()}
    from .external import SpherizationHelper
    from .utility import get_urdf_meshes, get_urdf_primitives, load_urdf, save_urdf, set_urdf_spheres

    start = time.time()
    urdf = load_urdf(filename)
    factors = _factors(_flags, [link["@name"] for link in urdf["robot"]["link"]], filename)
    helper = SpherizationHelper(database, int(threads))
    parts: list[Any] = [*get_urdf_meshes(urdf, shrinkage), *get_urdf_primitives(urdf, shrinkage)]
    budgets: dict[str, int] = {}
    for part in parts:
        budget = float(branch)
        if use_volume_heuristic:
            budget = max(part.mesh.volume * 10000 * volume_heuristic_ratio, budget)
        budgets[part.name] = max(1, int(budget * factors.get(part.name.split("::")[0], 1)))
        helper.spherize_mesh(
            part.name, part.mesh, part.scale, part.xyz, method, part.rpy, branch=budgets[part.name], **given
        )
    spheres = {part.name: helper.get_spherization(part.name, depth, budgets[part.name]) for part in parts}
    helper.db.save()
    set_urdf_spheres(urdf, spheres)
    save_urdf(urdf, output)
    proved = sum(one.certified for one in spheres.values())
    print(f"Generated spheres in {time.time() - start:.6f} seconds")
    print(f"Certified in this run: {proved} of {len(spheres)} collision elements; others are from the database")
    print(f"Written: {output}")


def _search_flags() -> set[str]:
    from .external import _DEFAULTS

    return {*_DEFAULTS, "depth", "manifold_leaves", "simplification_ratio"}


def _factors(flags: dict[str, Any], links: list[str], filename: str) -> dict[str, float]:
    """The multipliers by link. A flag that is neither an option nor a link is an error."""
    import difflib

    by_word = {link.replace("-", "_"): link for link in links}
    factors: dict[str, float] = {}
    for flag, value in flags.items():
        link = by_word.get(flag.replace("-", "_"))
        if link is None:
            options = list(inspect.signature(generate_sphere_urdf).parameters)
            near = difflib.get_close_matches(flag.replace("-", "_"), [*options, *by_word], 1)
            raise UsageError(
                f"--{flag} is no option and no link of {filename}" + (f"; did you mean --{near[0]}?" if near else "")
            )
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0:
            raise UsageError(f"--{flag}: the multiplier of a link's budget is expected, a number above 0, got '{value}'")
        factors[link] = float(value)
    return factors


def generate_spheres(
    mesh: str, output: str | None = None, depth: int = 1, branch: int = 8, method: str = "medial", scale: float = 1.0,
    manifold_leaves: int = 1000, simplify_ratio: float = 0.2, testerLevels: int = 2, numCover: int = 5000,
    minCover: int = 5, initSpheres: int = 1000, minSpheres: int = 200, erFact: int = 2, expand: bool = True,
    merge: bool = True, burst: bool = False, optimise: bool = True, maxOptLevel: int = 1, balExcess: float = 0.05,
    verify: bool = True, eval: bool = False, num_samples: int = 500, min_samples: int = 1,
) -> None:  # fmt: skip
    """Write the spheres of a mesh as JSON, one entry a level."""
    from .external import _DEFAULTS, spherize_mesh
    from .model import SphereEncoder

    given = {key: value for key, value in locals().items() if key in _DEFAULTS}
    start = time.time()
    levels = spherize_mesh(
        mesh, Path(mesh), np.full(3, float(scale)), None, None,
        {"method": method, "depth": depth, "branch": branch, **given},
        {"manifold_leaves": manifold_leaves, "ratio": simplify_ratio},
    )  # fmt: skip
    target = Path(output or f"{Path(mesh).stem}-spheres.json")
    target.write_text(json.dumps(levels, indent=4, cls=SphereEncoder))
    print(f"Generated spheres in {time.time() - start:.6f} seconds")
    print(f"Total number of spheres: {sum(map(len, levels))}")
    print(f"Written: {target}")


def _usage(name: str, main: Callable[..., Any]) -> str:
    lines = [f"usage: {name} [FLAGS]", main.__doc__ or "", "", "flags and their defaults:"]
    for p in inspect.signature(main).parameters.values():
        if not p.name.startswith("_"):
            lines.append(f"  --{p.name}" + ("" if p.default is p.empty else f" {p.default}"))
    if "_flags" in inspect.signature(main).parameters:
        lines.append("  --LINK FACTOR   multiplies the budget of a link")
    return "\n".join(lines)


def main_sphere_urdf() -> int:
    """foam-generate-sphere-urdf."""
    return _run(generate_sphere_urdf, _usage("foam-generate-sphere-urdf", generate_sphere_urdf))


def main_spheres() -> int:
    """foam-generate-spheres."""
    return _run(generate_spheres, _usage("foam-generate-spheres", generate_spheres))


if __name__ == "__main__":  # python -m foam._scripts generate-spheres …
    script = sys.argv.pop(1) if len(sys.argv) > 1 else ""
    known = {"generate-sphere-urdf": main_sphere_urdf, "generate-spheres": main_spheres}
    if script not in known:
        sys.exit(f"foam: a script is expected: {', '.join(known)}")
    sys.exit(known[script]())
