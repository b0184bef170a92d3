"""`python -m tappet` is the same as `tappet`."""

import sys

from tappet.cli import main

sys.exit(main())
