"""Files of the running application: listed, read, written and deleted, below its folder of files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, ClassVar, TypeVar

from msgspec import Meta

from tappet.runtime.file_access import (
    LARGEST,
    FileRefusedError,
    NoSuchFileError,
    StoredFile,
    delete_file,
    list_files,
    read_file,
    write_file,
)
from tappet.runtime.operations.declaration import Operation, OperationError

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

Found = TypeVar("Found")
Folder = Annotated[str, Meta(max_length=255)]
Name = Annotated[str, Meta(min_length=1, max_length=255)]


class ListFiles(Operation[list[StoredFile]], frozen=True):
    """The files of a folder whose names have an ending."""

    op: ClassVar[str] = "list_files"
    folder: Folder
    ending: Folder = ""

    def run(self, plc: SoftPlc) -> list[StoredFile]:
        """By name; an empty list where there is no such folder."""
        return _below(plc, lambda root: list_files(root, self.folder, self.ending))


class ReadFile(Operation[bytes], frozen=True):
    """The bytes of a file."""

    op: ClassVar[str] = "read_file"
    folder: Folder
    name: Name

    def run(self, plc: SoftPlc) -> bytes:
        """Up to 4 MiB."""
        return _below(plc, lambda root: read_file(root, self.folder, self.name))


class WriteFile(Operation[None], frozen=True):
    """Make or replace a file."""

    op: ClassVar[str] = "write_file"
    folder: Folder
    name: Name
    data: Annotated[bytes, Meta(max_length=LARGEST)]

    def run(self, plc: SoftPlc) -> None:
        """Programs see the old file or the new one."""
        _below(plc, lambda root: write_file(root, self.folder, self.name, self.data))


class DeleteFile(Operation[None], frozen=True):
    """Take a file away."""

    op: ClassVar[str] = "delete_file"
    folder: Folder
    name: Name

    def run(self, plc: SoftPlc) -> None:
        """What programs have open they keep."""
        _below(plc, lambda root: delete_file(root, self.folder, self.name))


def _below(plc: SoftPlc, act: Callable[[Path], Found]) -> Found:
    files = plc.loaded().files
    files.open()
    root = files.folder
    assert root is not None
    try:
        return act(root)
    except NoSuchFileError as error:
        raise OperationError("not_found", str(error)) from error
    except FileRefusedError as error:
        raise OperationError("bad_request", str(error)) from error
