"""`python -m tappet` is the same as `tappet`."""

from tappet.cli import main

main()
