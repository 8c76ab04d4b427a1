"""What lies beside the package: the program foam, and examples."""

from __future__ import annotations

import difflib
import shutil
from pathlib import Path

from . import _core
from .errors import InputError, UsageError

#: The files of foam.example(), in the folder of robots.
_EXAMPLES = {
    "panda": "panda/panda.urdf",
    "panda_mjcf": "panda/panda.xml",
    "forearm": "panda/meshes/link5.obj",
    "hand": "panda/meshes/hand.obj",
}


def program() -> str:
    """Return the file of the program of the same installation; "" if there is none."""
    plugins = Path(_core.plugin_folders()[-1])
    for folder in (*list(plugins.parents)[1:4], Path(__file__).parent):
        if (folder / "bin" / "foam").is_file():
            return str(folder / "bin" / "foam")
    return shutil.which("foam") or ""


def example(name: str) -> Path:
    """Return a file to try foam with: "panda" (URDF), "panda_mjcf", or a mesh of it, "forearm" or "hand".

    The arm is drawn by foam's authors after the overall sizes of Franka's Panda, with its kinematics and link names. It
    is not the manufacturer's model; do not take dimensions from it.

    Raises:
        UsageError: there is no such example; the message names those that there are. InputError: foam is installed
        without them.
    """
    if name not in _EXAMPLES:
        near = difflib.get_close_matches(name, _EXAMPLES, 1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise UsageError(f"there is no example '{name}'; there are: {', '.join(_EXAMPLES)}{hint}")
    file = Path(program()).parent.parent / "share/foam/configs/robots" / _EXAMPLES[name]
    if not file.is_file():
        raise InputError(f"{file}: there is no such file; remedy: install foam with its share/foam")
    return file
