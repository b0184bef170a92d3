"""`python -m tappet.manual [DIR]` writes the manual to DIR, by default docs/motion, and removes old pages."""

from __future__ import annotations

import sys
from pathlib import Path

from tappet.manual.written import write

if __name__ == "__main__":
    write(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/motion"))
