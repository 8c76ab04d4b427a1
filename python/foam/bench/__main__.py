"""`python3 -m foam.bench`."""

import sys

try:
    import matplotlib  # type: ignore # noqa: F401
    import pandas  # type: ignore # noqa: F401
    import yaml  # type: ignore # noqa: F401
except ModuleNotFoundError as error:
    print(
        f"foam: error: foam bench needs the Python module {error.name}, which {sys.executable} has not; remedy: apt-get "
        "install python3-pandas python3-matplotlib python3-yaml, or pip install 'foam-spheres[bench]', or name another Python "
        "by FOAM_PYTHON",
        file=sys.stderr,
    )
    sys.exit(2)

from foam.bench.command import main

sys.exit(main())
