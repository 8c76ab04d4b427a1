"""Python modules of others that foam bench needs."""

from __future__ import annotations

import importlib
import sys


def require(*names: str) -> None:
    """End the program with a message if one of the modules is missing."""
    try:
        for name in names:
            importlib.import_module(name)
    except ModuleNotFoundError as error:
        print(
            f"foam: error: foam bench needs the Python module {error.name}, which {sys.executable} has not; remedy: apt-get "
            "install python3-pandas python3-matplotlib python3-yaml, or pip install 'foam-spheres[bench]', or name another "
            "Python by FOAM_PYTHON",
            file=sys.stderr,
        )
        sys.exit(2)
