"""Files that are written as a whole or not at all. May be imported by every room."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

PRIVATE = 0o600
SHARED = 0o666
"""As the user's mask has it."""
UNFINISHED = ".part"
"""How the names of files end that are being written."""


def replace_file(path: Path, data: bytes, *, mode: int = SHARED, to_disk: bool = False) -> None:
    """Makes `data` the content of `path`: after an error or a crash the old file or the new one is there.

    With `to_disk` it returns when the disk has it. Raises OSError; nothing is left behind then.
    """
    with replacing_file(path, data, mode=mode, to_disk=to_disk):
        pass


@contextmanager
def replacing_file(path: Path, data: bytes, *, mode: int = SHARED, to_disk: bool = False) -> Iterator[None]:
    """Has `data` on the disk before the block, and in `path` after it; `path` stays when the block raises."""
    temporary = path.with_name(f".{path.name[:100]}.{os.urandom(6).hex()}{UNFINISHED}")
    fd = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, mode)
    try:
        with os.fdopen(fd, "wb") as file:
            file.write(data)
            file.flush()
            if to_disk:
                os.fsync(file.fileno())
        yield
        os.replace(temporary, path)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    if to_disk:
        sync_folder(path.parent)


def remove_unfinished(folder: Path) -> None:
    """Removes what a killed process has left half-written in `folder`; only while nobody writes there."""
    for path in folder.glob(f".*{UNFINISHED}"):
        with suppress(OSError):
            path.unlink()


def write_output(path: Path, data: bytes) -> None:
    """Writes what a user asked for to where they said: a link is followed, a pipe or device written to.

    Raises OSError with the name of the file.
    """
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(data)
        else:
            replace_file(path.resolve(), data)
    except OSError as error:
        error.filename = str(path)
        raise


def sync_folder(folder: Path) -> None:
    """Brings the names in a folder to the disk."""
    fd = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)
