"""Sphere models of robots."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _adapters, _arrays, _core
from ._plugins import registry
from ._results import Figures
from ._robot import Robot, load, warn_of
from .errors import InputError, UsageError


class SphereModel(Mapping[str, "NDArray[np.float64]"]):
    """The spheres of a robot's links: a mapping from link names to arrays of shape (n, 4): x, y, z, r.

    Metres, in the frames of the links; the order is that of the URDF. Arrays are read-only.
    """

    def __init__(
        self, spheres: Mapping[str, ArrayLike], robot: Robot | None = None, *, name: str = "model",
        summary: dict[str, Any] | None = None,
    ) -> None:
        given = {link: _rows(value, link) for link, value in spheres.items()}
        if robot is not None:
            unknown = [link for link in given if link not in robot.links]
            if unknown:
                raise InputError(f"{', '.join(unknown)}: no link of {robot.file}; there are: {', '.join(robot.links)}")
            given = {link: given[link] for link in robot.links if link in given}
        self._spheres = given
        self._robot = robot
        self.name = name
        self.summary = summary  #: of the run that made the model, as `foam run --json` prints it; else None
        self.notes: list[str] = []
        self._elements: dict[str, list[dict[str, Any]]] = {}
        self._file: _core.SphereFile | None = None
        self._of_run: _core.Model | None = None
        self._recipes: _core.Recipes | None = None

    @property
    def robot(self) -> Robot | None:
        """The robot that the model is of, if it is known."""
        return self._robot

    def __getitem__(self, link: str) -> NDArray[np.float64]:
        return self._spheres[link]

    def __iter__(self) -> Iterator[str]:
        return iter(self._spheres)

    def __len__(self) -> int:
        return len(self._spheres)

    @property
    def count(self) -> int:
        """The number of all elements; most models have spheres alone."""
        return sum(len(spheres) for spheres in self._spheres.values()) + sum(map(len, self._elements.values()))

    def elements(self, link: str) -> list[dict[str, Any]]:
        """Return all elements of a link as dictionaries, spheres first. The arrays of the mapping have the spheres alone.

        Each has "kind", "position" and what its kind needs by `foam.KINDS`, in metres: "radius"; "length" along z, of the
        axis without caps; "size" of a box, with a radius that of the box within; "vertices"; "radii", the half axes.
        "rotation" has the rows of the matrix from the element's frame to the link's.
        """
        spheres = [{"kind": "sphere", "position": row[:3].tolist(), "radius": float(row[3])} for row in self[link]]
        return spheres + [dict(element) for element in self._elements.get(link, [])]

    def _take_elements(self, file: _core.SphereFile) -> None:
        """Keep the elements of other kinds than sphere; further calls of foam get them from the file."""
        self._elements = dict(file.elements())
        if self._elements:
            self._file = file
            none = np.zeros((0, 4))
            none.flags.writeable = False
            self._spheres |= {link: none for link in self._elements if link not in self._spheres}

    def _require_spheres(self, what: str) -> None:
        if self._elements:
            kinds = sorted({element["kind"] for elements in self._elements.values() for element in elements})
            raise UsageError(f"{what} takes spheres alone, and this model has other elements ({', '.join(kinds)}); "
                             "remedy: a model of spheres, or save() in a format that holds them")

    @property
    def certified(self) -> bool:
        """Whether the run that made the model has proved that the geometry of all links lies inside the spheres.

        False for models from elsewhere: foam.certify() proves them.
        """
        return bool(self.summary and self.summary["certified"])

    @property
    def statement(self) -> str:
        """The verdict of the run that made the model, in words; "" for models from elsewhere."""
        return str(self.summary["proof"]["statement"]) if self.summary else ""

    @property
    def total(self) -> Figures:
        """The figures of the whole robot, of the run that made the model. Others: foam.evaluate()."""
        if self.summary is None:
            raise UsageError("this model was made by no run; remedy: foam.evaluate(robot, model).total")
        return Figures(self.summary["total"])

    def to_dict(self) -> dict[str, dict[str, Any]]:
        """Return {link: {"centers": [[x, y, z], …], "radii": […]}}: numbers for JSON, and for pyroki."""
        self._require_spheres("to_dict()")
        return {
            link: {"centers": spheres[:, :3].tolist(), "radii": spheres[:, 3].tolist()}
            for link, spheres in self._spheres.items()
        }

    @classmethod
    def from_dict(cls, spheres: Mapping[str, Any], robot: Robot | None = None, *, name: str = "model") -> SphereModel:
        """Return the model of such a dictionary; arrays of shape (n, 4) are taken as well."""
        rows = {}
        for link, value in spheres.items():
            if isinstance(value, Mapping):
                if "centers" not in value or "radii" not in value:
                    raise InputError(f"{link}: the keys 'centers' and 'radii' are expected, got {', '.join(value)}")
                centers = _arrays.rows(value["centers"], f"{link}: centers")
                radii = np.asarray(value["radii"], dtype=np.float64).reshape(-1, 1)
                if len(centers) != len(radii):
                    raise InputError(f"{link}: {len(centers)} centers, but {len(radii)} radii")
                value = np.concatenate([centers, radii], axis=1)
            rows[link] = value
        return cls(rows, robot, name=name)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        format: str | None = None,
        into: str | os.PathLike[str] | None = None,
        base_link: str = "",
        tool_frames: Iterable[str] = (),
        lock_joints: Mapping[str, float] | None = None,
        default_pose: Mapping[str, float] | None = None,
        set: Mapping[str, Any] | None = None,
        force: bool = False,
    ) -> list[Path]:
        """Write the model; return the files. It is what `foam spherize -o` and `foam convert` write.

        Args:
            path: the file; its ending selects the format.
            format: urdf, json, curobo, xrdf, srdf, mjcf, pyroki…: `foam formats` lists them.
            into: a file of yours that is copied to `path` with its spheres replaced; it may be `path` itself.
            base_link, tool_frames, lock_joints, default_pose: what formats state of a robot beyond its URDF. Where a
                format needs a tool frame and none is given, it is the tip of the robot, if there is one alone.
            set: parameters of the writer, by name.
            force: replace the robot's own file.

        Raises:
            UsageError: an unknown format or parameter; the file is an input. Error: the file cannot be written.
        """
        target = Path(path)
        source = None if into is None else Path(into)
        if not force and self._robot is not None and _same(target, self._robot.file):
            raise UsageError(f"{target}: it is the robot's own file; remedy: another name, or force=True")
        if source is not None and not source.is_file():
            raise InputError(f"{source}: there is no such file")
        facts = _core.Facts(base_link, list(tool_frames), dict(lock_joints or {}), dict(default_pose or {}))
        files, said = _core.written(
            registry(), self._sphere_file(), None if self._robot is None else self._robot._core, self._of_run, str(target), format or "",
            None if source is None else (str(source), source.read_text()), dict(set or {}), facts,
        )  # fmt: skip
        warn_of(said, str(target))
        main = os.path.realpath(target)
        for file, content in sorted(files, key=lambda one: os.path.realpath(one[0]) == main):  # last the one that names others
            if os.path.realpath(file) != main:
                _make_folder_of(Path(file))
            _write_whole(Path(file), content)
        return [Path(file) for file, _ in files]

    def to_pyroki(self) -> dict[str, dict[str, Any]]:
        """Return the dictionary that pyroki's RobotCollision.create_sphere_collision takes: that of to_dict()."""
        return self.to_dict()

    def to_curobo(
        self, *, tool_frames: Iterable[str] = (), base_link: str = "", lock_joints: Mapping[str, float] | None = None,
        default_pose: Mapping[str, float] | None = None, set: Mapping[str, Any] | None = None,
    ) -> dict[str, Any]:
        """Return a robot file of cuRobo as a dictionary: spheres, ignored pairs, locked joints. Arguments as of save().

        Needs PyYAML, as cuRobo does.
        """
        facts = {"tool_frames": tool_frames, "base_link": base_link, "lock_joints": lock_joints, "default_pose": default_pose}
        text = _adapters.files_of(self, "curobo", f"{self.name}.yml", facts, set)[f"{self.name}.yml"]
        robot: dict[str, Any] = _adapters._module("yaml", "PyYAML").safe_load(text)
        return robot

    def to_vamp(
        self, *, tool_frames: Iterable[str] = (), base_link: str = "", lock_joints: Mapping[str, float] | None = None,
        set: Mapping[str, Any] | None = None,
    ) -> dict[str, str]:
        """Return the files of a robot of VAMP by name: sphere URDF, SRDF, and the job of cricket. Arguments as of save()."""
        facts = {"tool_frames": tool_frames, "base_link": base_link, "lock_joints": lock_joints}
        return _adapters.files_of(self, "vamp", f"{self.name}.urdf", facts, set)

    def to_mujoco(
        self, spec: Any = None, *, bodies: Mapping[str, str] | None = None, group: int = 3, pairs: Any = None
    ) -> Any:
        """Put the elements into the bodies of a mujoco.MjSpec as geoms without mass; return their number.

        Without a spec: return an MJCF text of the robot, without visuals, as these name files. `bodies`: the body of each link, where the names differ.
        `pairs`: pairs of links that are excluded, such as foam.self_collision(…).ignored().

        The geoms take the place of those that have contact: these stay as they look, with contype and conaffinity 0, and
        their masks and friction go to the new ones. A body whose frame differs from its link's gets the elements in its
        own frame. Raises UsageError, and changes nothing, if that frame cannot be known. What is proved of the model is
        proved again on the geoms of the spec.
        """
        if spec is None:
            return _adapters.files_of(self, "mjcf", f"{self.name}.xml", {}, {"visuals": False})[f"{self.name}.xml"]
        return _adapters.to_mujoco(self, spec, bodies, group, pairs)

    def to_trimesh(self) -> dict[str, Any]:
        """Return the spheres of each link as one trimesh.Trimesh, in the frame of the link, for pictures."""
        self._require_spheres("to_trimesh()")
        return {link: _adapters.trimesh_of(_adapters.mesh_of_spheres(rows)) for link, rows in self._spheres.items()}

    def picture(self, width: int = 960, height: int = 720) -> bytes:
        """Return a PNG: the geometry, translucent, over the spheres."""
        return _adapters.picture(self, width, height)

    def show(self, path: str | os.PathLike[str] | None = None, *, browse: bool = True) -> Path:
        """Open a page about the model in the browser; return its file.

        For a model of a run it is the report of that run, which is repeated from the cache. `path`: write a page with
        the table and the picture of Jupyter there instead. browse=False: only write it.
        """
        return _adapters.show(self, path, browse)

    def _repr_html_(self) -> str:
        return _adapters.page_of(self)

    def _sphere_file(self) -> _core.SphereFile:
        if self._file is not None:
            return self._file
        return _core.SphereFile(list(self._spheres.items()), self.name)

    def __reduce__(self) -> tuple[Any, ...]:
        spheres = {link: np.array(rows) for link, rows in self._spheres.items()}
        return _restored, (spheres, self._robot, self.name, self.summary, self.notes, self._elements)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SphereModel):
            return NotImplemented
        same = list(self) == list(other) and all(np.array_equal(self[link], other[link]) for link in self)
        return same and self._elements == other._elements

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        surfaces = len(self.summary["proof"].get("as_surface", [])) if self.summary is not None else 0
        proof = (f", certified, {surfaces} as surfaces" if surfaces else ", certified") if self.certified else ""
        noun = "elements" if self._elements else "spheres"
        return f"<foam.SphereModel '{self.name}': {self.count} {noun} of {len(self)} links{proof}>"


def _rows(value: ArrayLike, link: str) -> NDArray[np.float64]:
    rows = _arrays.rows(value, f"spheres of {link}", 4)
    if not np.isfinite(rows).all() or (rows[:, 3] <= 0).any():
        raise InputError(f"spheres of {link}: numbers that are not finite, or a radius that is not above 0")
    if rows.flags.writeable:
        rows = rows.copy()
        rows.flags.writeable = False
    return rows


def _restored(
    spheres: Any, robot: Any, name: str, summary: Any, notes: list[str], elements: Any = None
) -> SphereModel:
    model = SphereModel(spheres, robot, name=name, summary=summary)
    model.notes = notes
    if elements:
        model._take_elements(_core.SphereFile(list(model._spheres.items()), name, list(elements.items())))
    return model


def _same(first: Path, second: Path) -> bool:
    return first.exists() and second.exists() and first.samefile(second)


def _make_folder_of(file: Path) -> None:
    """Make the folder of the meshes beside a file; that of the file itself is to be there."""
    try:
        file.parent.mkdir(exist_ok=True)
    except OSError as error:
        raise UsageError(f"{file.parent}: it cannot be made ({error.strerror}); remedy: check its folder") from None


def _write_whole(file: Path, content: bytes) -> None:
    """In one step, so that a reader never sees half of it. A link stays; a device or a pipe is written to."""
    file = Path(os.path.realpath(file)) if file.is_symlink() else file
    if file.exists() and not file.is_file() and not file.is_dir():
        file.write_bytes(content)
        return
    partial = file.with_name(f"{file.name}.partial-{os.getpid()}")
    try:
        partial.write_bytes(content)
        os.replace(partial, file)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise UsageError(f"{file}: it cannot be written ({error.strerror}); remedy: check that its folder exists") from None


def read_spheres(
    path: str | os.PathLike[str], *, robot: Robot | str | os.PathLike[str] | None = None, reader: str = "",
    rename: Mapping[str, str] | None = None,
) -> SphereModel:
    """Return the spheres of a file of any program that foam reads; its content selects the format.

    Args:
        path: the file: URDF, cuRobo, XRDF, Lula, MorphIt, pyroki, MJCF, CSV….
        robot: the robot that they belong to.
        reader: the stage that reads the file, such as "read.curobo", if its content does not tell.
        rename: old and new names of links, or beginnings of names; "" is the link of a format without names.

    Raises:
        InputError: the file cannot be read; the message names the line and the remedy.
    """
    file = Path(path)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    read = _core.read_spheres(str(file), registry(), reader, list((rename or {}).items()))
    spheres = {link: np.asarray(rows) for link, rows in read.links() if len(np.asarray(rows))}
    of = load(robot) if isinstance(robot, (str, os.PathLike)) else robot
    if of is not None:  # links that only carry spheres of others, and links of another robot, stay
        spheres = {link: spheres[link] for link in sorted(spheres, key=_order_of(of.links))}
    model = SphereModel(spheres, name=file.stem)
    model._robot = of
    model._take_elements(read)
    model._file = read
    model.notes = read.notes()
    return model


def _order_of(links: list[str]) -> Any:
    places = {link: place for place, link in enumerate(links)}
    return lambda link: places.get(link, len(places))


def model_of(spheres: Any, robot: Robot) -> SphereModel:
    """Return what the user calls a sphere model as one."""
    from ._cover import Cover

    if isinstance(spheres, SphereModel):
        return spheres
    if isinstance(spheres, (str, os.PathLike)):
        return read_spheres(spheres)
    if isinstance(spheres, Mapping):
        return SphereModel.from_dict(spheres)
    rows = spheres.spheres if isinstance(spheres, Cover) else spheres
    links = robot.links_with_geometry
    if len(links) != 1:
        raise InputError(f"{robot.file} has {len(links)} links with geometry; remedy: spheres by link, {{link: rows}}")
    return SphereModel({links[0]: rows})
