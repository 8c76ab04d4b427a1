"""The command foam: python -m foam …."""

import os
import sys

from ._installation import program
from .errors import UsageError


def main() -> None:
    """Become the program of the same installation."""
    file = program()
    if not file:
        raise UsageError(
            "the program foam is not installed beside the package; remedy: install the package foam"
        )
    os.environ["FOAM_PYTHON"] = sys.executable  # for `foam bench` and for USD
    os.execv(file, ["foam", *sys.argv[1:]])


if __name__ == "__main__":
    main()
