"""One soft PLC a folder: two would overwrite the remanent values, and drive the outputs, of each other."""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PATIENCE_S = 20.0
"""One that is just ending (its server was killed) saves its values first."""
_POLL_S = 0.05


@contextmanager
def owned(folder: Path, patience_s: float = PATIENCE_S) -> Iterator[None]:
    """The folder is this process's own meanwhile; OSError when another one keeps it. The kernel gives it back
    when the process ends, however that happens."""
    fd = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        end = time.monotonic() + patience_s
        while not _locked(fd):
            if time.monotonic() > end:
                text = "is used by another soft PLC; end that one, or choose another folder with --data"
                raise OSError(f"the folder {folder} {text}")
            time.sleep(_POLL_S)
        yield
    finally:
        os.close(fd)


def _locked(fd: int) -> bool:
    try:
        fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
