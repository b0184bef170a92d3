"""Project folders in zip archives; what comes in is checked first (architecture, decision 16)."""

from __future__ import annotations

import io
import stat
import struct
import unicodedata
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import BinaryIO

from tappet.project.errors import FolderFormatError
from tappet.project.folder.codec import decode, encode
from tappet.project.folder.filenames import stem_of
from tappet.project.model import Project
from tappet.project.naming import name_key, normal_name
from tappet.project.project_file import PROJECT_FILE

_READ_ERRORS = (
    zipfile.BadZipFile,
    IndexError,  # zipfile on some damaged directories
    zlib.error,
    EOFError,
    NotImplementedError,
    RuntimeError,
    OSError,
    ValueError,
    OverflowError,
    struct.error,
)
"""What the zip reader raises on archives that are damaged or made to harm."""

_CHUNK = 1 << 16
_EPOCH = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True, slots=True)
class Limits:
    """What an archive may hold."""

    files: int = 20_000
    file_bytes: int = 64 << 20
    total_bytes: int = 256 << 20
    ratio: int = 200
    """Unpacked to packed bytes, for archives that unpack to more than `ratio_from` bytes."""
    ratio_from: int = 1 << 20
    path_length: int = 1000
    depth: int = 64


DEFAULT_LIMITS = Limits()


def write_zip(project: Project) -> bytes:
    """A project as an archive of its folder. The same project always gives the same bytes."""
    top = stem_of(project.name)
    return zip_files({f"{top}/{path}": content for path, content in encode(project).items()})


def zip_files(files: Mapping[str, bytes]) -> bytes:
    """An archive of files by path; equal files give equal bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            info = zipfile.ZipInfo(path, _EPOCH)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (stat.S_IFREG | 0o644) << 16
            archive.writestr(info, content)
    return buffer.getvalue()


def read_zip(source: bytes | BinaryIO) -> Project:
    """The project of an archive, with its further files; it may stand in a folder of the archive.

    Raises FolderFormatError, also for archives that are too large, packed suspiciously well, damaged or
    encrypted, or hold links, doubled names or paths that lead out of the folder.
    """
    files = unpack(source)
    tops = sorted((path.count("/"), path) for path in files if path.split("/")[-1] == PROJECT_FILE)
    if not tops:
        raise FolderFormatError("archive", f"holds no {PROJECT_FILE}, so it is no Tappet project")
    top = tops[0][1].removesuffix(PROJECT_FILE)
    inside = {path.removeprefix(top): content for path, content in files.items() if path.startswith(top)}
    return decode(inside).project


def unpack(source: bytes | BinaryIO, limits: Limits = DEFAULT_LIMITS) -> dict[str, bytes]:
    """The files of an archive by path. Raises FolderFormatError."""
    stream = io.BytesIO(source) if isinstance(source, bytes) else source
    try:
        with zipfile.ZipFile(stream) as archive:
            return _unpack(archive, limits)
    except FolderFormatError:
        raise
    except _READ_ERRORS as error:
        raise FolderFormatError("archive", f"cannot be read as a zip file ({error})") from error


def _unpack(archive: zipfile.ZipFile, limits: Limits) -> dict[str, bytes]:
    entries = [entry for entry in archive.infolist() if not entry.is_dir()]
    if len(archive.infolist()) > limits.files:
        raise FolderFormatError("archive", f"holds more than {limits.files} files")
    for entry in archive.infolist():
        _check_path(entry.filename.removesuffix("/"), limits)
        _check_kind(entry)
    _check_names([entry.filename for entry in entries])
    files: dict[str, bytes] = {}
    left = limits.total_bytes
    for entry in entries:
        content = _read(archive, entry, min(limits.file_bytes, left), limits)
        left -= len(content)
        files[normal_name(entry.filename)] = content
    return files


def _read(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, allowed: int, limits: Limits) -> bytes:
    """The content of an entry, counted while it unpacks: what the directory says of its size may be a lie."""
    content = bytearray()
    with archive.open(entry) as stream:
        while chunk := stream.read(_CHUNK):
            content += chunk
            if len(content) > allowed:
                raise FolderFormatError(
                    entry.filename,
                    f"the archive unpacks to more than {limits.total_bytes >> 20} MiB, "
                    f"or one of its files to more than {limits.file_bytes >> 20} MiB",
                )
            packed = max(entry.compress_size, 1)
            if len(content) > limits.ratio_from and len(content) > limits.ratio * packed:
                raise FolderFormatError(
                    entry.filename, f"is packed more than {limits.ratio} times smaller than it is"
                )
    return bytes(content)


def _check_path(path: str, limits: Limits) -> None:
    shown = path if len(path) <= 80 else path[:77] + "..."
    shown = "".join(c if c.isprintable() else "?" for c in shown)
    parts = path.split("/")
    if len(path) > limits.path_length or len(parts) > limits.depth:
        raise FolderFormatError(shown, "the path is too long")
    if "\\" in path or path.startswith("/") or any(part in ("", ".", "..") for part in parts):
        raise FolderFormatError(shown, "the path does not stay in the folder of the archive")
    if len(parts[0]) > 1 and parts[0][1] == ":":
        raise FolderFormatError(shown, "the path begins with a drive")
    if any(unicodedata.category(c) in ("Cc", "Cs") for c in path):
        raise FolderFormatError(shown, "the path contains control characters")


def _check_kind(entry: zipfile.ZipInfo) -> None:
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        raise FolderFormatError(entry.filename, "is a link or device; archives may hold only files")
    if entry.flag_bits & 0x1:
        raise FolderFormatError(entry.filename, "is encrypted")
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise FolderFormatError(entry.filename, "is packed by a method other than deflate")


def _check_names(paths: list[str]) -> None:
    """No two files that a case-insensitive file system holds for one, and no file that is a folder too."""
    seen: set[str] = set()
    for path in paths:
        key = name_key(path)
        if key in seen:
            raise FolderFormatError(path, "stands twice in the archive (names differ by more than case)")
        seen.add(key)
    for key in seen:
        folder = key.rpartition("/")[0]
        while folder:
            if folder in seen:
                raise FolderFormatError(key, f"'{folder}' is a file and a folder")
            folder = folder.rpartition("/")[0]
