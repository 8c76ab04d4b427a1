"""`python3 -m foam.bench`."""

import sys

from foam.bench.modules import require

require("pandas", "yaml")

from foam.bench.command import main  # noqa: E402

sys.exit(main())
