"""Files of an application as clients read and write them: no path leaves its folder, no link is followed."""

from __future__ import annotations

import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

LARGEST = 4 << 20
"""Bytes of a file that a client reads or writes."""
MOST_LISTED = 10_000


class FileRefusedError(ValueError):
    """The name is none of a file here, or the file is too large."""


class NoSuchFileError(FileRefusedError):
    """There is no such file."""


@dataclass(frozen=True, slots=True)
class StoredFile:
    """A file of a folder."""

    name: str
    size: int
    modified_ns: int
    """Unix time."""


def list_files(root: Path, folder: str, ending: str) -> list[StoredFile]:
    """The files of a folder whose names end so, by name; none where the folder is not there."""
    found: list[StoredFile] = []
    try:
        with _opened(root, folder) as place, os.scandir(place) as entries:
            for entry in entries:
                if len(found) == MOST_LISTED:
                    break
                if entry.name.endswith(ending) and entry.is_file(follow_symlinks=False):
                    facts = entry.stat(follow_symlinks=False)
                    found.append(StoredFile(entry.name, facts.st_size, facts.st_mtime_ns))
    except NoSuchFileError:
        return []
    return sorted(found, key=lambda file: file.name)


def read_file(root: Path, folder: str, name: str) -> bytes:
    """The bytes of a file."""
    checked = _file_name(name)
    with _opened(root, folder) as place:
        try:
            descriptor = os.open(checked, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK, dir_fd=place)
        except OSError as error:
            _refuse(name, error)
        facts = os.fstat(descriptor)
        if not stat.S_ISREG(facts.st_mode):
            os.close(descriptor)
            raise FileRefusedError(f"'{name}' is no file that can be used")
        with os.fdopen(descriptor, "rb") as file:
            if facts.st_size > LARGEST:
                raise FileRefusedError(f"'{name}' has {facts.st_size} bytes; at most {LARGEST} are read")
            return file.read(LARGEST)


def write_file(root: Path, folder: str, name: str, data: bytes) -> None:
    """Replaces a file as a whole, or makes it; readers see the old one or the new one."""
    checked = _file_name(name)
    if len(data) > LARGEST:
        raise FileRefusedError(f"'{name}' has {len(data)} bytes; at most {LARGEST} are written")
    with _opened(root, folder, make=True) as place:
        arriving = f".{secrets.token_hex(8)}.arriving"
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW
        try:
            with os.fdopen(os.open(arriving, flags, 0o640, dir_fd=place), "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.rename(arriving, checked, src_dir_fd=place, dst_dir_fd=place)
        except IsADirectoryError as error:
            _refuse(name, error)
        finally:
            with suppress(FileNotFoundError):
                os.unlink(arriving, dir_fd=place)
        os.fsync(place)


def delete_file(root: Path, folder: str, name: str) -> None:
    """Takes a file away."""
    checked = _file_name(name)
    with _opened(root, folder) as place:
        try:
            os.unlink(checked, dir_fd=place)
        except OSError as error:
            _refuse(name, error)


def _refuse(name: str, error: OSError) -> NoReturn:
    if isinstance(error, FileNotFoundError):
        raise NoSuchFileError(f"there is no file '{name}'") from error
    if isinstance(error, IsADirectoryError | PermissionError) or error.errno == 40:  # ELOOP: a link
        raise FileRefusedError(f"'{name}' is no file that can be used") from error
    raise error


def _file_name(name: str) -> str:
    if name in ("", ".", "..") or "/" in name or "\0" in name or len(os.fsencode(name)) > 255:
        raise FileRefusedError(f"'{name}' is no name of a file; a name has no '/' and at most 255 bytes")
    return name


@contextmanager
def _opened(root: Path, folder: str, *, make: bool = False) -> Iterator[int]:
    """A descriptor of a folder below the root."""
    parts = [part for part in folder.split("/") if part]
    if ".." in parts or "." in parts or "\0" in folder:
        raise FileRefusedError(f"the folder '{folder}' leads out of the files of the application")
    flags = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
    try:
        if make:
            root.mkdir(mode=0o750, parents=True, exist_ok=True)
        place = os.open(root, flags)
        for part in parts:
            with closing(_Descriptor(place)):
                if make:
                    with suppress(FileExistsError):
                        os.mkdir(part, 0o750, dir_fd=place)
                place = os.open(part, flags, dir_fd=place)
    except FileNotFoundError as error:
        raise NoSuchFileError(f"there is no folder '{folder}'") from error
    except NotADirectoryError as error:
        raise FileRefusedError(f"'{folder}' is no folder that can be used") from error
    try:
        yield place
    finally:
        os.close(place)


@dataclass(frozen=True, slots=True)
class _Descriptor:
    number: int

    def close(self) -> None:
        os.close(self.number)
