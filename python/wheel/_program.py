"""The command `foam` of a wheel: the program that lies in the package."""

import os
import pathlib
import sys


def main() -> None:
    program = pathlib.Path(__file__).parent / "bin" / "foam"
    os.environ["FOAM_PYTHON"] = sys.executable  # for `foam bench`
    os.execv(program, ["foam", *sys.argv[1:]])
