"""Robots and meshes of experiments: files by candidates."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import _core
from .._mesh import Mesh, read_mesh
from ..errors import InputError
from .findings import Findings
from .tree import Value
from .values import expect_map, read_texts, required


@dataclass(frozen=True)
class Candidates:
    """A file as one of several references. Relative ones start at the folder of the experiment."""

    references: list[str]
    where: str  #: "file:line:column"
    folder: Path

    def resolve(self, shared: bool = False) -> tuple[str, Path]:
        """Return the first reference that exists, and its file. `shared`: looks in the folder FOAM_SHARED, too.

        Raises InputError that names every place.
        """
        places: list[str] = []
        for reference in self.references:
            for tried in (reference, *_in_shared(reference, shared)):
                file, looked_at = _core.resolve(tried, str(self.folder.absolute()))
                if os.path.isfile(file):
                    return reference, Path(file)
                places += [f"\n  {place}" for place in looked_at]
        raise InputError(
            f"{self.where}: none of the inputs [{', '.join(self.references)}] exists. Looked at:{''.join(places)}\n"
            "remedy: correct the path, or set FOAM_PACKAGE_PATH to the folder that holds the package"
        )

    def mesh(self) -> tuple[str, Mesh]:
        """Return the reference that was taken, and its mesh."""
        reference, file = self.resolve(shared=True)
        return reference, read_mesh(file)


def _in_shared(reference: str, wanted: bool) -> list[str]:
    folder = os.environ.get("FOAM_SHARED", "")
    return [os.path.join(folder, reference)] if wanted and folder and "://" not in reference else []


def read_candidates(value: Value | None, name: str, findings: Findings, folder: Path) -> Candidates:
    """Return a file or a list of candidates; none where there is no value."""
    if value is None:
        return Candidates([], "", folder)
    return Candidates(read_texts(value, name, findings), findings.locate(value.where), folder)


@dataclass(frozen=True)
class NamedRobot:
    """A robot by a name, and the candidates of its URDF."""

    name: str
    candidates: Candidates


def read_robots(root: Value, findings: Findings, folder: Path) -> list[NamedRobot]:
    """Return the map `robots`, which must be there: {NAME: FILE or [FILE, …], …}, at least one."""
    example = "robots: {panda: FILE.urdf}"
    value = required(root, "robots", example, findings)
    if value is None or not expect_map(value, "robots", example, findings):
        return []
    if not value.keys:
        findings.error(value.where, "wrong-type", "'robots' expects at least one robot")
    return [NamedRobot(key.text, read_candidates(item, key.text, findings, folder)) for key, item in value.pairs()]


def for_each_found(
    name: str, robots: Sequence[Any], tell: Callable[[str], None], use: Callable[[Any, str, Path], None]
) -> list[str]:
    """Call use(robot, reference, file) with each robot that is here. Tell of the others, and return their names.

    Raises InputError if no robot is here.
    """
    missing, why = [], ""
    for robot in robots:
        try:
            reference, file = robot.candidates.resolve()
        except InputError as error:
            why = str(error)
            tell(f"warning: {name}: {robot.name} is skipped: {why}")
            missing.append(robot.name)
            continue
        use(robot, reference, file)
    if len(missing) == len(robots):
        raise InputError(f"{name}: none of the robots is here; {why}")
    return missing
