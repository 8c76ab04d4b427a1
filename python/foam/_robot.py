"""Robots and meshes from files: foam.load()."""

from __future__ import annotations

import os
import sys
import tempfile
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._arguments import count_of, limit_of, seed_of
from ._events import Progress
from ._memory import Source, source_of
from ._mesh import Mesh
from ._plugins import registry
from ._words import Effort, Geometry, JointKind, Kind, Objective
from .errors import InputError, UsageError, in_python

if TYPE_CHECKING:
    from ._model import SphereModel

#: Keys of recipes about what foam.load() reads.
_OF_LOAD = {"mesh", "robot", "robot.urdf", "unit", "scale", "package_path", "loaders"}


@dataclass(frozen=True)
class Joint:
    """A joint as the URDF has it: metres, radians."""

    name: str
    kind: JointKind
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
        warnings.warn(in_python(f"{where}: {note}"), UserWarning, stacklevel=level)


class Robot:
    """A robot, or a mesh as a robot with one link. Make it by foam.load(), which reads its files.

    Files that change or vanish later change nothing. It can be pickled: files are then read again.
    """

    def __init__(
        self, given: str | os.PathLike[str] | Source, unit: str | None, scale: float, geometry: Geometry,
        links: tuple[str, ...], packages: Any,
    ) -> None:  # fmt: skip
        own = given if isinstance(given, Source) else os.path.abspath(given)
        self._arguments = (own, unit, scale, geometry, links, packages)
        self._packages = _Packages(packages)
        if isinstance(given, Source):
            self.file = Path(given.name)  #: as it was given; of a robot in memory its name
            with given.written() as file:
                self._core = self._read(file, given.name)
        else:
            if not os.path.isfile(given):
                raise InputError(f"{given}: {'it is no file' if os.path.exists(given) else 'there is no such file'}")
            self.file = Path(given)
            self._core = self._read(os.path.abspath(given), "")
        warn_of(self._core.notes(), str(self.file))

    def _read(self, file: str, name: str) -> _core.Robot:
        _, unit, scale, geometry, links, _ = self._arguments
        return _core.Robot(file, registry(), unit, float(scale), geometry, list(links), self._packages.folders, name)

    @property
    def _file_is_own(self) -> bool:
        return not isinstance(self._arguments[0], Source)

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
        effort: Effort | None = None,
        objective: Objective | None = None,
        keep: Iterable[str] | str = (),
        skip: Iterable[str] | str = (),
        weights: Mapping[str, float] | None = None,
        links: Mapping[str, Mapping[str, Any]] | None = None,
        set: Mapping[str, Any] | None = None,
        seed: int | None = None,
        time_limit: float | None = None,
        fresh: bool = False,
        progress: Progress | None = None,
    ) -> SphereModel:
        """Return the model: the spheres of all links, proved to cover them. It is `foam spherize`.

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
        kinds: Iterable[Kind] | Kind = ("sphere", "capsule", "box"),
        *,
        cost: float | None = None,
        costs: Mapping[str, float] | None = None,
        excess: float | None = None,
        max_protrusion: float | None = None,
        effort: Effort | None = None,
        objective: Objective | None = None,
        keep: Iterable[str] | str = (),
        skip: Iterable[str] | str = (),
        weights: Mapping[str, float] | None = None,
        links: Mapping[str, Mapping[str, Any]] | None = None,
        set: Mapping[str, Any] | None = None,
        seed: int | None = None,
        time_limit: float | None = None,
        fresh: bool = False,
        progress: Progress | None = None,
    ) -> SphereModel:
        """Return the model of convex elements: those of all links, proved to cover them. It is `foam approximate`.

        Args:
            elements: the greatest number of elements of the whole robot.
            kinds: of elements, one or several of `foam.KINDS`, such as "capsule".
            cost: the greatest cost of checking all elements, instead of their number.
            costs: of a check by kind: {"capsule": 2, "hull_vertex": 0.1}; only with `cost`.
            objective: what is minimised: "excess", "mean_protrusion" or "protrusion".

        The other arguments, and the errors, are those of spherize().
        """
        words: list[Kind] = [kinds] if isinstance(kinds, str) else list(kinds)
        return self._made(
            "", words, elements, excess, max_protrusion, cost, costs or {}, effort, objective,
            self._links(keep, skip, weights, links), set, seed, time_limit, fresh, progress,
        )  # fmt: skip

    def cover(
        self,
        elements: int | None = None,
        kinds: Iterable[Kind] | Kind = "sphere",
        *,
        excess: float | None = None,
        max_protrusion: float | None = None,
        effort: Effort | None = None,
        objective: Objective | None = None,
        keep: Iterable[str] | str = (),
        skip: Iterable[str] | str = (),
        weights: Mapping[str, float] | None = None,
        links: Mapping[str, Mapping[str, Any]] | None = None,
        set: Mapping[str, Any] | None = None,
        seed: int | None = None,
        time_limit: float | None = None,
        fresh: bool = False,
        progress: Progress | None = None,
    ) -> SphereModel:
        """Return a model of at most `elements` elements of the kinds: what foam.cover() is for a mesh.

        It is spherize() where the one kind is "sphere", else approximate(); arguments and errors are theirs.
        """
        words: list[Kind] = [kinds] if isinstance(kinds, str) else list(kinds)
        method, chosen = ("cover", None) if words == ["sphere"] else ("", words)
        return self._made(
            method, chosen, elements, excess, max_protrusion, None, {}, effort, objective,
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
        self, method: str, kinds: list[Kind] | None, count: int | None, excess: float | None,
        max_protrusion: float | None, cost: float | None, costs: Mapping[str, float], effort: Effort | None,
        objective: Objective | None, links: dict[str, dict[str, Any]], set: Mapping[str, Any] | None,
        seed: int | None, time_limit: float | None, fresh: bool, progress: Progress | None,
    ) -> SphereModel:  # fmt: skip
        """Return the model that the recipe for these arguments makes; `kinds`: None for spheres alone."""
        from . import _runs

        for key in set or {}:
            if key in _OF_LOAD or key.startswith("loaders."):
                raise UsageError(f"set: '{key}' is of the input, which foam.load() has read; remedy: foam.load(…)")
        given, unit, scale, geometry, globs, _ = self._arguments
        name, text, left_out, stage = _core.quick_recipe(
            given if isinstance(given, str) else str(self.file), method, kinds,
            None if count is None else count_of(count), excess, max_protrusion,
            None if cost is None else float(cost), costs, objective or "" if kinds is not None else "", unit, scale,
            geometry, registry(),
        )  # fmt: skip
        warn_of([f"no plugin offers {missing}; it is skipped" for missing in left_out], str(self.file))
        settings: dict[str, Any] = {}
        if seed is not None:
            settings["seed"] = seed_of(seed)
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
        (run,) = _runs.run_all(recipes, None, fresh, limit_of(time_limit), progress, None, self)
        run.model._robot = self
        return run.model

    def __repr__(self) -> str:
        return f"<foam.Robot '{self.name}': {len(self.links)} links, {len(self.links_with_geometry)} with geometry>"


def load(
    robot: Any,
    *,
    packages: Any = None,
    unit: str | None = None,
    scale: float = 1.0,
    geometry: Geometry = "collision",
    links: Iterable[str] = (),
    radii: Any = None,
) -> Robot:
    """Return the robot of a file (URDF, MJCF, SDF, USD) or in memory, or a mesh as a robot with one link.

    What it reads is what is used, whatever happens to the files later. USD needs usd-core.

    Args:
        robot: a file; the text of a URDF, whose relative references lead from the current folder; a mujoco.MjSpec; a
            yourdfpy.URDF; or a mesh or points as of foam.cover(), the link is then "mesh" or "points".
        packages: folders of ROS packages by name ({"my_robot": "…"}), or folders that contain packages. Others are
            searched as FOAM_PACKAGE_PATH and ROS_PACKAGE_PATH say, and around the URDF.
        unit, scale: of a mesh file whose format states no unit ("mm", "in"…).
        geometry: what spheres are to cover and are judged by: "collision", "visual", "both", or
            "collision-or-visual": that of a link without collision geometry is its visual geometry.
        links: globs of the links to read, to spherize and to judge; none: all.
        radii: of points, as of foam.cover().

    Raises:
        InputError: the file or a mesh of it cannot be read; the message names it, and where it was searched.
        UsageError: `unit` or `scale` of what is in memory, and so in metres.
    """
    os.environ.setdefault("FOAM_PYTHON", sys.executable)  # which reads USD
    source = source_of(robot, radii)
    if source is not None and (unit is not None or scale != 1):
        raise UsageError("unit, scale: they are of mesh files; remedy: give what is in memory in metres")
    return Robot(robot if source is None else source, unit, scale, geometry, tuple(links), packages)


def robot_of(robot: Any) -> Robot:
    """Return a robot, or that of what load() takes."""
    return robot if isinstance(robot, Robot) else load(robot)
