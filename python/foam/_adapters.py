"""Sphere models in the objects of other packages, which are imported only when they are asked for."""

from __future__ import annotations

import base64
import html
import importlib
import struct
import sys
import tempfile
import warnings
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._elements import noun
from ._installation import program
from ._mesh import Mesh, mesh_of
from ._plugins import registry
from .errors import Error, UsageError

if TYPE_CHECKING:
    from ._model import SphereModel
    from ._packages import Trimesh


def _module(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise UsageError(f"the package {package} is not installed; remedy: pip install {package}") from None


def files_of(model: SphereModel, format: str, name: str, facts: dict[str, Any], set: Mapping[str, Any] | None) -> dict[str, str]:
    """Return the texts of a writer by file name; nothing is written."""
    made = _core.Facts(
        facts.get("base_link") or "", list(facts.get("tool_frames") or ()), dict(facts.get("lock_joints") or {}),
        dict(facts.get("default_pose") or {}),
    )  # fmt: skip
    files, said = _core.written(
        registry(), model._sphere_file(), None if model._robot is None else model._robot._core, model._of_run, name, format, None,
        dict(set or {}), made,
    )  # fmt: skip
    from ._robot import warn_of

    warn_of(said, name)
    return {Path(file).name: content.decode() for file, content in files}


def to_mujoco(model: SphereModel, spec: Any, bodies: Mapping[str, str] | None, group: int, pairs: Any) -> int:
    """Add the elements to the bodies of an MjSpec."""
    mujoco = _module(type(spec).__module__.split(".")[0], "mujoco")
    names = {link: (bodies or {}).get(link, link) for link in model}
    known = {body.name: body for body in spec.bodies}
    missing = [link for link, body in names.items() if body not in known]
    if missing:
        raise UsageError(f"the MjSpec has no body for {', '.join(missing)}; there are: {', '.join(known)}; remedy: bodies={{…}}")
    from ._mujoco import add_to_spec

    with warnings.catch_warnings():  # of masses, which stay those of the spec
        warnings.simplefilter("ignore")
        made = files_of(model, "mjcf", f"{model.name}.xml", {}, {"visuals": False}) if model._robot is not None else {}
        text = next(iter(made.values()), None)
    return add_to_spec(mujoco, model, text, spec, names, group, pairs)


def _ball(subdivisions: int = 2) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A subdivided octahedron of radius 1."""
    points = [np.array(p, float) for p in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(subdivisions):
        middles: dict[tuple[int, int], int] = {}

        def middle(a: int, b: int) -> int:
            key = (min(a, b), max(a, b))
            if key not in middles:
                point = points[a] + points[b]
                points.append(point / np.linalg.norm(point))
                middles[key] = len(points) - 1
            return middles[key]

        faces = [t for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                 for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]  # fmt: skip
    return np.array(points), np.array(faces)


def mesh_of_spheres(rows: ArrayLike) -> Mesh:
    """Return spheres as one mesh of 128 triangles each, for pictures."""
    spheres = np.asarray(rows, dtype=np.float64).reshape(-1, 4)
    points, faces = _ball()
    vertices = spheres[:, None, :3] + points[None] * spheres[:, None, 3:]
    all_faces = faces[None] + (np.arange(len(spheres)) * len(points))[:, None, None]
    return Mesh(vertices.reshape(-1, 3), all_faces.reshape(-1, 3))


def trimesh_of(mesh: Mesh) -> Trimesh:
    """Return a foam.Mesh as a trimesh.Trimesh."""
    made: Trimesh = _module("trimesh", "trimesh").Trimesh(
        vertices=np.array(mesh.vertices), faces=np.array(mesh.faces), process=False
    )
    return made


def from_trimesh(mesh: Any) -> Mesh:
    """Return a foam.Mesh, in metres, of a Trimesh or a Scene of trimesh, or of anything that foam takes for a mesh."""
    return mesh_of(mesh)


def picture(model: SphereModel, width: int = 480, height: int = 360) -> bytes:
    """Return a PNG of the geometry over the elements: by the painter of snapshots, or without its graphics libraries."""
    robot = None if model._robot is None else model._robot._core
    try:
        return _core.picture(registry(), model._sphere_file(), robot, "", width, height)
    except Error:  # the painter is a wheel of its own
        return _png_of(_core.plain_pixels(model._sphere_file(), robot, width, height), width, height)


def _png_of(pixels: bytes, width: int, height: int) -> bytes:
    """Return red, green and blue of each pixel as PNG (ISO/IEC 15948)."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + pixels[y * 3 * width : (y + 1) * 3 * width] for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def page_of(model: SphereModel, certified: bool) -> str:
    """A small table and a picture, as HTML."""
    figures = {one["link"]: one for one in (model.summary or {}).get("links", [])}
    head = "<tr><th style='text-align:left'>link</th><th>elements</th>" + ("<th>excess</th>" if figures else "")
    rows = []
    for link, elements in model.items():
        excess = figures.get(link, {}).get("excess")
        cell = f"<td>{'' if excess is None else f'{excess:.2f}'}</td>" if figures else ""
        rows.append(f"<tr><td style='text-align:left'>{html.escape(link)}</td><td>{elements._counts()}</td>{cell}</tr>")
    surfaces = len((model.summary or {}).get("proof", {}).get("as_surface", []))
    proof = f"; proved to cover the geometry{f', {surfaces} as surfaces' if surfaces else ''}" if certified else ""
    words = f"<b>{html.escape(model.name)}</b>: {noun(model.count, 'element')} of {noun(len(model), 'link')}{proof}"
    image = base64.b64encode(picture(model)).decode()
    drawn = f"<img alt='the elements' src='data:image/png;base64,{image}' width='480'>"
    return f"<div><p>{words}</p><table>{head}</tr>{''.join(rows)}</table>{drawn}</div>"


def show(model: SphereModel, path: Any, browse: bool, certified: bool) -> Path:
    """Write the page of a model; open it."""
    import webbrowser

    if model._recipes is not None and path is None:
        folder = Path(tempfile.mkdtemp(prefix="foam-"))
        robot = None if model._robot is None else model._robot._core
        model._recipes.run(0, str(folder / "run"), False, None, program(), None, None, robot)
        page = folder / "run" / "report.html"
    else:
        page = Path(path) if path is not None else Path(tempfile.mkdtemp(prefix="foam-")) / "model.html"
        title = html.escape(model.name)
        head = f"<!doctype html><meta charset='utf-8'><title>{title}</title>"
        page.write_text(f"{head}{page_of(model, certified)}\n", "utf-8")
    if browse:
        webbrowser.open(page.absolute().as_uri())
    else:
        print(page, file=sys.stderr)
    return page
