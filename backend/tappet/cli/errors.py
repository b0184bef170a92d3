"""What is wrong with a call of the command line, and how it is said."""

from __future__ import annotations

import sys


class UsageError(Exception):
    """The call is wrong; the message says what would be right. Exit code 2."""


def complain(message: str) -> None:
    """Writes an error for people."""
    print(f"tappet: {message}", file=sys.stderr)
