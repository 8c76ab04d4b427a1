"""Robots in memory as files for foam.load(): URDF texts, mujoco.MjSpec, yourdfpy.URDF, meshes and points."""

from __future__ import annotations

import ctypes
import glob
import os
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple, Optional
from xml.etree import ElementTree

import numpy as np

from . import _mesh
from ._regions import region_of
from .errors import InputError, UsageError

_DIGITS = 17  # of a float64
_lock = threading.Lock()


class Source(NamedTuple):
    """A robot in memory. It can be pickled."""

    name: str  #: that messages have; references of a text that are relative lead from its folder
    text: bytes  #: {0} in the names of meshes stands for the folder of `files`
    files: Optional[dict[str, bytes]] = None  #: meshes by name; None: the text is the user's, and stays as it is

    @contextmanager
    def written(self) -> Iterator[str]:
        """Give the file of the robot, as long as the block lasts."""
        with tempfile.TemporaryDirectory(prefix="foam-") as folder:
            file = Path(folder) / Path(self.name).name
            file.write_bytes(self.text if self.files is None else self.text.replace(b"{0}", folder.encode()))
            for name, content in (self.files or {}).items():
                (Path(folder) / name).write_bytes(content)
            yield str(file)


def source_of(thing: Any, radii: Any) -> Source | None:
    """Return a robot, a mesh or points in memory as a source; None for a path."""
    if isinstance(thing, bytes):
        return Source("robot.urdf", thing)
    if isinstance(thing, str) and thing.lstrip("\ufeff \t\r\n").startswith("<"):
        return Source("robot.urdf", thing.encode())
    if isinstance(thing, (str, os.PathLike)):
        return None
    if hasattr(thing, "worldbody") and hasattr(thing, "to_xml"):
        return _of_spec(thing)
    if hasattr(thing, "write_xml_string") and hasattr(thing, "robot"):
        return _of_yourdfpy(thing)
    if isinstance(thing, (int, float)):
        raise InputError(f"robot: {type(thing).__name__} is none; remedy: a file, a URDF text, or a mesh")
    return source_of_region(region_of(thing, radii))


def source_of_region(region: _mesh.Mesh) -> Source:
    """Return a mesh, or points with radii, as a robot with one link; it has no visual geometry."""
    balls = region._core.balls()
    if balls is not None:
        shapes = [
            f'<origin xyz="{x!r} {y!r} {z!r}"/><geometry><sphere radius="{r!r}"/></geometry>'
            for x, y, z, r in np.asarray(balls).tolist()
        ]
        return Source("points.urdf", _urdf("points", shapes))
    shape = '<geometry><mesh filename="{0}/mesh.ply"/></geometry>'
    return Source("mesh.urdf", _urdf("mesh", [shape]), {"mesh.ply": _mesh._ply(region)})


def _urdf(name: str, shapes: list[str]) -> bytes:
    collisions = "".join(f"    <collision>{shape}</collision>\n" for shape in shapes)
    return f'<robot name="{name}">\n  <link name="{name}">\n{collisions}  </link>\n</robot>\n'.encode()


def _of_yourdfpy(urdf: Any) -> Source:
    """Names of meshes become those that its handler of file names gives."""
    root = ElementTree.fromstring(urdf.write_xml_string())
    for mesh in root.iter("mesh"):
        name = mesh.get("filename", "")
        found = str(urdf._filename_handler(fname=name))
        if os.path.isfile(found):
            mesh.set("filename", os.path.abspath(found))
    return Source("robot.urdf", ElementTree.tostring(root))


def _of_spec(spec: Any) -> Source:
    """The MJCF that MuJoCo makes of a spec, with all digits; meshes of its assets are files."""
    copy = spec.copy()
    try:
        copy.compile()
        with _all_digits(spec):
            text = copy.to_xml()
    except ValueError as error:
        raise UsageError(f"the MjSpec does not compile: {error}; remedy: a spec that does") from None
    root = ElementTree.fromstring(text)
    files: dict[str, bytes] = {}
    folder = os.path.join(spec.modelfiledir, spec.meshdir)
    for number, mesh in enumerate(root.iter("mesh")):
        name = mesh.get("file")
        if name is None:
            continue
        held = spec.assets.get(name, spec.assets.get(os.path.join(spec.meshdir, name)))
        if held is None:
            mesh.set("file", os.path.abspath(os.path.join(folder, name)))
            continue
        own = f"{number}{Path(name).suffix}"
        files[own] = held.encode() if isinstance(held, str) else bytes(held)
        mesh.set("file", f"{{0}}/{own}")
    for compiler in root.iter("compiler"):
        compiler.attrib.pop("meshdir", None)
        compiler.attrib.pop("assetdir", None)
    return Source("spec.xml", ElementTree.tostring(root), files)


@contextmanager
def _all_digits(spec: Any) -> Iterator[None]:
    """Let MuJoCo write numbers with all digits. It writes six by itself: another robot than the one to prove."""
    package = __import__(type(spec).__module__.split(".")[0])
    (file,) = glob.glob(os.path.join(os.path.dirname(package.__file__ or ""), "libmujoco.so*")) or [""]
    library = ctypes.CDLL(file)
    if not hasattr(library, "_mjPRIVATE__set_xml_precision"):
        raise UsageError("this MuJoCo writes a spec with six digits; remedy: foam.load() of the MJCF file")
    with _lock:
        before = library._mjPRIVATE__get_xml_precision()
        library._mjPRIVATE__set_xml_precision(_DIGITS)
        try:
            yield
        finally:
            library._mjPRIVATE__set_xml_precision(before)
