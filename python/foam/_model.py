"""Sphere models of robots."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from . import _adapters, _core
from ._elements import Element, Elements, ElementsDict, SpheresDict, elements_of
from ._files import make_folder_of, same_file, write_whole
from ._plugins import registry
from ._results import Certificate, Figures
from ._robot import Robot, robot_of, warn_of
from .errors import InputError, UsageError

if TYPE_CHECKING:
    from ._packages import MjSpec, Trimesh


class SphereModel(Mapping[str, Elements]):
    """The elements of a robot's links: a mapping from link names to foam.Elements.

    Metres, in the frames of the links; the order is that of the URDF.
    """

    def __init__(
        self, elements: Mapping[str, Any], robot: Robot | None = None, *, name: str = "model",
        summary: dict[str, Any] | None = None,
    ) -> None:
        given = {link: elements_of(value, f"spheres of {link}") for link, value in elements.items()}
        if robot is not None:
            unknown = [link for link in given if link not in robot.links]
            if unknown:
                raise InputError(f"{', '.join(unknown)}: no link of {robot.file}; there are: {', '.join(robot.links)}")
            given = {link: given[link] for link in robot.links if link in given}
        self._links = given
        self._robot = robot
        self.name = name
        self.summary = summary  #: of the run that made the model, as `foam run --json` prints it; else None
        self.notes: list[str] = []
        self._certificate: Certificate | None = None
        self._file: _core.SphereFile | None = None
        self._of_run: _core.Model | None = None
        self._recipes: _core.Recipes | None = None

    @classmethod
    def _of_file(
        cls, file: _core.SphereFile, robot: Robot | None, name: str, summary: dict[str, Any] | None
    ) -> SphereModel:
        """Return the model of what C++ holds; links without elements are left out."""
        model = cls({}, name=name, summary=summary)
        others = dict(file.elements())
        found = {link: Elements(rows, others.get(link, ())) for link, rows in file.links()}
        found = {link: elements for link, elements in found.items() if elements}
        if robot is not None:  # links that only carry spheres of others, and links of another robot, stay
            found = {link: found[link] for link in sorted(found, key=_order_of(robot.links))}
        model._links = found
        model._robot = robot
        model._file = file
        return model

    @property
    def robot(self) -> Robot | None:
        """The robot that the model is of, if it is known."""
        return self._robot

    def __getitem__(self, link: str) -> Elements:
        return self._links[link]

    def __iter__(self) -> Iterator[str]:
        return iter(self._links)

    def __len__(self) -> int:
        return len(self._links)

    @property
    def count(self) -> int:
        """The number of all elements."""
        return sum(map(len, self._links.values()))

    def elements(self, link: str) -> list[Element]:
        """Return all elements of a link as records, spheres first.

        Each has "kind", "position" and what its kind needs by `foam.KINDS`, in metres: "radius"; "length" along z, of the
        axis without caps; "size" of a box, with a radius that of the box within; "vertices"; "radii", the half axes.
        "rotation" has the rows of the matrix from the element's frame to the link's.
        """
        return self[link].elements

    @property
    def certificate(self) -> Certificate:
        """The proof as foam.certify() gives it: what is proved, or where it fails. Made when it is first read.

        Raises UsageError for a model without robot.
        """
        if self._robot is None:
            raise UsageError("the robot of this model is not known; remedy: foam.certify(robot, model)")
        if self._certificate is None:
            from ._judge import certify

            self._certificate = certify(self._robot, self)
        return self._certificate

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

    def to_dict(self) -> dict[str, SpheresDict | ElementsDict]:
        """Return {link: {"centers": [[x, y, z], …], "radii": […]}}, numbers for JSON.

        A link with elements of other kinds has {"elements": […]}.
        """
        return {link: elements.to_dict() for link, elements in self._links.items()}

    @classmethod
    def from_dict(cls, elements: Mapping[str, Any], robot: Robot | None = None, *, name: str = "model") -> SphereModel:
        """Return the model of such a dictionary; arrays of shape (n, 4) are taken as well."""
        return cls(elements, robot, name=name)

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
            format: urdf, json, curobo, xrdf, srdf, mjcf, pyroki…: foam.formats() lists them.
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
        if not force and self._robot is not None and same_file(target, self._robot.file):
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
                make_folder_of(Path(file))
            write_whole(Path(file), content)
        return [Path(file) for file, _ in files]

    def to_pyroki(self) -> dict[str, SpheresDict]:
        """Return the dictionary that pyroki's RobotCollision.create_sphere_collision takes.

        Raises UsageError if not all elements are spheres.
        """
        return {
            link: {"centers": elements.centers.tolist(), "radii": elements.radii.tolist()}
            for link, elements in self._links.items()
        }

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

    @overload
    def to_mujoco(self) -> str: ...
    @overload
    def to_mujoco(
        self, spec: MjSpec, *, bodies: Mapping[str, str] | None = None, group: int = 3,
        pairs: Iterable[Any] | None = None,
    ) -> int: ...  # fmt: skip
    def to_mujoco(
        self, spec: Any = None, *, bodies: Mapping[str, str] | None = None, group: int = 3, pairs: Any = None
    ) -> Any:
        """Put the elements into the bodies of a mujoco.MjSpec as geoms without mass; return their number.

        Without a spec: return an MJCF text of the robot, without visuals, as these name files. `bodies`: the body of
        each link, where the names differ. `pairs`: pairs of links that are excluded, such as
        foam.self_collision(…).ignored().

        The geoms take the place of those that have contact: these stay as they look, with contype and conaffinity 0, and
        their masks and friction go to the new ones. A body whose frame differs from its link's gets the elements in its
        own frame. Raises UsageError, and changes nothing, if that frame cannot be known. What is proved of the model is
        proved again on the geoms of the spec.
        """
        if spec is None:
            return _adapters.files_of(self, "mjcf", f"{self.name}.xml", {}, {"visuals": False})[f"{self.name}.xml"]
        return _adapters.to_mujoco(self, spec, bodies, group, pairs)

    def to_trimesh(self) -> dict[str, Trimesh]:
        """Return the elements of each link as one trimesh.Trimesh, in the frame of the link, for pictures."""
        return {link: elements.to_trimesh() for link, elements in self._links.items()}

    def picture(self, width: int = 960, height: int = 720) -> bytes:
        """Return a PNG: the geometry, translucent, over the spheres."""
        return _adapters.picture(self, width, height)

    def show(self, path: str | os.PathLike[str] | None = None, *, browse: bool = True) -> Path:
        """Open a page about the model in the browser; return its file.

        For a model of a run it is the report of that run, which is repeated from the cache. `path`: write a page with
        the table and the picture of Jupyter there instead. browse=False: only write it.
        """
        return _adapters.show(self, path, browse, self.certified)

    def _repr_html_(self) -> str:
        return _adapters.page_of(self, self.certified)

    def _sphere_file(self) -> _core.SphereFile:
        """Return the elements as C++ holds them."""
        if self._file is None:
            spheres = [(link, elements._rows) for link, elements in self._links.items()]
            others = [(link, elements._others) for link, elements in self._links.items() if elements._others]
            self._file = _core.SphereFile(spheres, self.name, others)
        return self._file

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._links, self._robot, self.name, self.summary, self.notes)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SphereModel):
            return NotImplemented
        return list(self) == list(other) and all(self[link] == other[link] for link in self)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        surfaces = len(self.summary["proof"].get("as_surface", [])) if self.summary is not None else 0
        proof = (f", certified, {surfaces} as surfaces" if surfaces else ", certified") if self.certified else ""
        noun = "elements" if any(elements._others for elements in self._links.values()) else "spheres"
        return f"<foam.SphereModel '{self.name}': {self.count} {noun} of {len(self)} links{proof}>"


def _restored(links: Any, robot: Any, name: str, summary: Any, notes: list[str]) -> SphereModel:
    model = SphereModel(links, name=name, summary=summary)
    model._robot = robot
    model.notes = notes
    return model


def read_spheres(
    path: str | os.PathLike[str], *, robot: Any = None, reader: str = "",
    rename: Mapping[str, str] | None = None,
) -> SphereModel:
    """Return the elements of a file of any program that foam reads; its content selects the format.

    Args:
        path: the file: URDF, cuRobo, XRDF, Lula, MorphIt, pyroki, MJCF, CSV….
        robot: the robot that they belong to: a Robot, or what foam.load() takes.
        reader: the stage that reads the file, such as "read.curobo", if its content does not tell.
        rename: old and new names of links, or beginnings of names; "" is the link of a format without names.

    Raises:
        InputError: the file cannot be read; the message names the line and the remedy.
    """
    file = Path(path)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    read = _core.read_spheres(str(file), registry(), reader, list((rename or {}).items()))
    model = SphereModel._of_file(read, None if robot is None else robot_of(robot), file.stem, None)
    model.notes = read.notes()
    return model


def _order_of(links: list[str]) -> Any:
    places = {link: place for place, link in enumerate(links)}
    return lambda link: places.get(link, len(places))


def model_of(model: Any, robot: Robot) -> SphereModel:
    """Return what the user calls a sphere model as one."""
    if isinstance(model, SphereModel):
        return model
    if isinstance(model, (str, os.PathLike)):
        return read_spheres(model)
    if isinstance(model, Mapping):
        return SphereModel.from_dict(model)
    links = robot.links_with_geometry
    if len(links) != 1:
        raise InputError(f"{robot.file} has {len(links)} links with geometry; remedy: {{link: elements}}")
    return SphereModel({links[0]: model})
