"""Robots and meshes from files: foam.load()."""

from __future__ import annotations

import os
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _core
from ._cover import _count, _limit, _seed
from ._mesh import Mesh
from ._plugins import registry
from .errors import InputError, UsageError

#: Keys of recipes about what foam.load() reads.
_OF_LOAD = {"mesh", "robot", "robot.urdf", "unit", "scale", "package_path", "loaders"}


@dataclass(frozen=True)
class Joint:
    """A joint as the URDF has it: metres, radians."""

    name: str
    kind: str  #: fixed, revolute, continuous, prismatic, planar or floating
    parent: str  #: link
    child: str  #: link
    xyz: tuple[float, float, float]  #: of the origin, in the parent's frame
    rotation: tuple[tuple[float, float, float], ...]  #: of the origin, a row-major (3, 3) matrix
    axis: tuple[float, float, float]  #: unit, in the joint's frame
    lower: float
    upper: float


class _Packages:
    """Folders with packages, as foam searches them; a package in a folder of another name gets a link."""

    def __init__(self, packages: Any) -> None:
        self.folders: list[str] = []
        if packages is None:
            return
        if not isinstance(packages, Mapping):
            self.folders = [os.path.abspath(folder) for folder in packages]
            return
        self._links: tempfile.TemporaryDirectory[str] | None = None
        for name, folder in packages.items():
            path = Path(folder).resolve()
            if not path.is_dir():
                raise InputError(f"packages: {name}: {path} is no folder")
            if path.name == name:
                self.folders.append(str(path))
                continue
            if self._links is None:
                self._links = tempfile.TemporaryDirectory(prefix="foam-packages-")
                self.folders.insert(0, self._links.name)
            os.symlink(path, os.path.join(self._links.name, name))


def warn_of(notes: Iterable[str], where: str) -> None:
    """Warn as the command line does, at the line of the caller of foam."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and frame.f_globals.get("__name__", "").split(".")[0] == "foam":
        frame, level = frame.f_back, level + 1
    for note in notes:
        warnings.warn(f"{where}: {note}", UserWarning, stacklevel=level)


class Robot:
    """A robot, or a mesh as a robot with one link. Make it by foam.load(), which reads its files.

    Files that change or vanish later change nothing. It can be pickled: the files are then read again.
    """

    def __init__(
        self, file: str | os.PathLike[str], unit: str | None, scale: float, geometry: str, links: tuple[str, ...],
        packages: Any,
    ) -> None:
        self._arguments = (os.path.abspath(file), unit, scale, geometry, links, packages)
        if not os.path.isfile(file):
            raise InputError(f"{file}: {'it is no file' if os.path.exists(file) else 'there is no such file'}")
        self._packages = _Packages(packages)
        self.file = Path(file)  #: as it was given
        self._core = _core.Robot(
            self._arguments[0], registry(), unit, float(scale), geometry, list(links), self._packages.folders
        )
        warn_of(self._core.notes(), str(file))

    def __reduce__(self) -> tuple[Any, ...]:
        return Robot, self._arguments

    @property
    def name(self) -> str:
        """The name in the URDF."""
        return self._core.name()

    @property
    def root(self) -> str:
        """The name of the root link."""
        return self._core.root()

    @property
    def links(self) -> list[str]:
        """The names of all links, in the order of the URDF."""
        return self._core.links(False)

    @property
    def links_with_geometry(self) -> list[str]:
        """The names of the links that have geometry to cover, in the order of the URDF."""
        return self._core.links(True)

    @property
    def joints(self) -> list[Joint]:
        """All joints, in the order of the URDF."""
        return [Joint(*joint) for joint in self._core.joints()]

    def collision_mesh(self, link: str) -> Mesh:
        """Return the geometry of a link to cover: metres, in the link's frame. Round primitives are polyhedra around
        them. Raises UsageError for a link without it."""
        return Mesh._of(self._core.mesh(link))

    def spherize(
        self,
        spheres: int | None = None,
        *,
        method: str = "cover",
        excess: float | None = None,
        max_protrusion: float | None = None,
        effort: str | None = None,
        objective: str | None = None,
        keep: Iterable[str] | str = (),
        skip: Iterable[str] | str = (),
        weights: Mapping[str, float] | None = None,
        links: Mapping[str, Mapping[str, Any]] | None = None,
        set: Mapping[str, Any] | None = None,
        seed: int | None = None,
        time_limit: float | None = None,
        fresh: bool = False,
        progress: Callable[[Any], object] | None = None,
    ) -> Any:
        """Return a SphereModel: the spheres of all links, proved to cover them. It is `foam spherize`.

        Args:
            spheres: the greatest number of spheres of the whole robot.
            method: a spherizer, with or without "spherize.".
            excess: the fewest spheres with at most this excess.
            max_protrusion: metres; how far spheres may extend beyond their link, as far as their number allows.
            effort, objective: parameters of the method, if it has them.
            keep: names or globs of the links that get spheres; none: all. The others keep their geometry.
            skip: names or globs of links that get none, of those that are kept.
            weights: by name or glob of links, the factor of their excess volume in the allocation: with more they get
                more spheres.
            links: settings of single links, by name or glob, as in a recipe: {"hand": {"weight": 2}}.
            set: other values of the recipe, by key: {"guarantee": "inner"}.
            seed: of the run.
            time_limit: seconds.
            fresh: neither read nor write the cache.
            progress: is called with each foam.Event of the run, in this thread.

        Raises:
            UsageError: an argument is wrong. GeometryError, Error: a link failed. KeyboardInterrupt: Ctrl-C.
        """
        return self._made(
            method, None, spheres, excess, max_protrusion, None, {}, effort, objective,
            self._links(keep, skip, weights, links), set, seed, time_limit, fresh, progress,
        )  # fmt: skip

    def approximate(
        self,
        elements: int | None = None,
        kinds: Iterable[str] | str = ("sphere", "capsule", "box"),
        *,
        cost: float | None = None,
        costs: Mapping[str, float] | None = None,
        excess: float | None = None,
        max_protrusion: float | None = None,
        effort: str | None = None,
        objective: str | None = None,
        keep: Iterable[str] | str = (),
        skip: Iterable[str] | str = (),
        weights: Mapping[str, float] | None = None,
        links: Mapping[str, Mapping[str, Any]] | None = None,
        set: Mapping[str, Any] | None = None,
        seed: int | None = None,
        time_limit: float | None = None,
        fresh: bool = False,
        progress: Callable[[Any], object] | None = None,
    ) -> Any:
        """Return a SphereModel of convex elements: those of all links, proved to cover them. It is `foam approximate`.

        Args:
            elements: the greatest number of elements of the whole robot.
            kinds: of elements, one or several of `foam.KINDS`, such as "capsule".
            cost: the greatest cost of checking all elements, instead of their number.
            costs: of a check by kind: {"capsule": 2, "hull_vertex": 0.1}; only with `cost`.
            objective: what is minimised: "excess", "mean_protrusion" or "protrusion".

        The other arguments, and the errors, are those of spherize().
        """
        words = [kinds] if isinstance(kinds, str) else list(kinds)
        return self._made(
            "", words, elements, excess, max_protrusion, cost, costs or {}, effort, objective,
            self._links(keep, skip, weights, links), set, seed, time_limit, fresh, progress,
        )  # fmt: skip

    def _links(
        self, keep: Iterable[str] | str, skip: Iterable[str] | str, weights: Mapping[str, float] | None,
        links: Mapping[str, Mapping[str, Any]] | None,
    ) -> dict[str, dict[str, Any]]:  # fmt: skip
        """Return the settings of single links: of the globs first, so that those of `links` have precedence."""
        kept, skipped = ([globs] if isinstance(globs, str) else list(globs) for globs in (keep, skip))
        factors = [(glob, float(weight)) for glob, weight in (weights or {}).items()]
        settings: dict[str, dict[str, Any]] = {}
        for name, chosen, weight in self._core.chosen_links(kept, skipped, factors):
            if not chosen:
                settings[name] = {"skip": True}
            elif weight is not None:
                settings[name] = {"weight": weight}
        for name, values in (links or {}).items():
            settings[name] = {**settings.pop(name, {}), **values}
        return settings

    def _made(
        self, method: str, kinds: list[str] | None, count: int | None, excess: float | None,
        max_protrusion: float | None, cost: float | None, costs: Mapping[str, float], effort: str | None,
        objective: str | None, links: dict[str, dict[str, Any]], set: Mapping[str, Any] | None,
        seed: int | None, time_limit: float | None, fresh: bool, progress: Callable[[Any], object] | None,
    ) -> Any:  # fmt: skip
        """Return the model that the recipe for these arguments makes; `kinds`: None for spheres alone."""
        from . import _runs

        for key in set or {}:
            if key in _OF_LOAD or key.startswith("loaders."):
                raise UsageError(f"set: '{key}' is of the input, which foam.load() has read; remedy: foam.load(…)")
        _, unit, scale, geometry, globs, _ = self._arguments
        name, text, left_out, stage = _core.quick_recipe(
            self._arguments[0], method, kinds, None if count is None else _count(count), excess, max_protrusion,
            None if cost is None else float(cost), costs, objective or "" if kinds is not None else "", unit, scale,
            geometry, registry(),
        )  # fmt: skip
        warn_of([f"no plugin offers {missing}; it is skipped" for missing in left_out], str(self.file))
        settings: dict[str, Any] = {}
        if seed is not None:
            settings["seed"] = _seed(seed)
        if effort is not None:
            settings[f"stages.{stage}.effort"] = effort
        if objective is not None and kinds is None:
            settings[f"stages.{stage}.objective"] = objective
        own = dict(links)
        if globs:  # of load(): the other links keep their geometry
            chosen = self.links_with_geometry
            own |= {link: {"skip": True} for link in self.links if link not in chosen}
        if own:
            settings["links"] = own
        settings.update(set or {})
        recipes = _core.Recipes(registry(), None, text, f"{name}.yaml", _runs.settings_of(settings), [])
        (run,) = _runs.run_all(recipes, None, fresh, _limit(time_limit), progress, None, self)
        run.model._robot = self
        return run.model

    def __repr__(self) -> str:
        return f"<foam.Robot '{self.name}': {len(self.links)} links, {len(self.links_with_geometry)} with geometry>"


def load(
    path: str | os.PathLike[str],
    *,
    packages: Any = None,
    unit: str | None = None,
    scale: float = 1.0,
    geometry: str = "collision",
    links: Iterable[str] = (),
) -> Robot:
    """Return the robot of a file (URDF, MJCF, SDF, USD), or a mesh file as a robot with one link. USD needs usd-core.

    Args:
        path: the file. It and its meshes are read once, here.
        packages: folders of ROS packages by name ({"my_robot": "…"}), or folders that contain packages. Others are
            searched as FOAM_PACKAGE_PATH and ROS_PACKAGE_PATH say, and around the URDF.
        unit, scale: of a mesh whose format states no unit ("mm", "in"…).
        geometry: what spheres are to cover and are judged by: "collision", "visual", "both", or
            "collision-or-visual": that of a link without collision geometry is its visual geometry.
        links: globs of the links to read, to spherize and to judge; none: all.

    Raises:
        InputError: the file or a mesh of it cannot be read; the message names it, and where it was searched.
    """
    os.environ.setdefault("FOAM_PYTHON", sys.executable)  # which reads USD
    return Robot(path, unit, scale, geometry, tuple(links), packages)
