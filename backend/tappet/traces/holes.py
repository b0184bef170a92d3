"""Gives the room of the first bytes of a file back to the disk, while the places of all others stay."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path

_KEEP_SIZE, _PUNCH_HOLE = 1, 2
"""Of `linux/falloc.h`."""


def punch_hole(path: Path, length: int) -> bool:
    """The first `length` bytes take no room from now on; False where the system cannot do it."""
    if not sys.platform.startswith("linux"):
        return False
    fallocate = ctypes.CDLL(None, use_errno=True).fallocate
    fallocate.argtypes = [ctypes.c_int, ctypes.c_int, ctypes.c_int64, ctypes.c_int64]
    handle = os.open(path, os.O_RDWR)
    try:
        return bool(fallocate(handle, _PUNCH_HOLE | _KEEP_SIZE, 0, length) == 0)
    finally:
        os.close(handle)
