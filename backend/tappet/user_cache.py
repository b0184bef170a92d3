"""The folder of what this user's processes work out once: compiled objects, indexes of libraries.

What lies there is trusted like the program itself: a folder that somebody else owns or may write is not used.
May be imported by every room.
"""

from __future__ import annotations

import hashlib
import os
import stat
from contextlib import suppress
from functools import cache
from pathlib import Path

from tappet.whole_file import PRIVATE, replace_file

_COMPILER = ("lang", "core", "codegen")
_ROOT = Path(__file__).parent


def cache_folder(name: str) -> Path | None:
    """`$XDG_CACHE_HOME/tappet/<name>`, made when it is missing; None where there can be none that is safe."""
    base = os.environ.get("XDG_CACHE_HOME")
    try:
        top = (Path(base) if base else Path.home() / ".cache") / "tappet"
        folder = top / name
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        return folder if _is_safe(top) and _is_safe(folder) else None
    except (OSError, RuntimeError):  # RuntimeError: there is no home
        return None


def _is_safe(folder: Path) -> bool:
    status = folder.stat()
    return status.st_uid == os.getuid() and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


@cache
def compiler_stamp() -> str:
    """Changes with the compiler's own files: what an earlier compiler has left is made again."""
    stamp = hashlib.blake2b(digest_size=8)
    for room in _COMPILER:
        for folder, folders, files in os.walk(_ROOT / room):
            folders.sort()
            for name in sorted(files):
                if not name.endswith(".pyc"):
                    status = os.stat(os.path.join(folder, name))
                    stamp.update(f"{name}:{status.st_size}:{status.st_mtime_ns};".encode())
    return stamp.hexdigest()


def store(path: Path, data: bytes) -> None:
    """Writes a file that other processes may read and write at the same time; a full disk is no error."""
    with suppress(OSError):
        replace_file(path, data, mode=PRIVATE)
