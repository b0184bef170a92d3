"""The boot application: the package that a runtime loads and starts when its process begins."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from tappet.codegen.package import CodePackage, PackageError
from tappet.disk_full import is_disk_full
from tappet.runtime.errors import DiskFullError
from tappet.runtime.logbook import Logbook
from tappet.whole_file import PRIVATE, replace_file, replacing_file

FILE = "boot.tappet"


class BootError(RuntimeError):
    """The boot application could not be read."""


@contextmanager
def storing_boot(folder: Path | None, package: bytes, log: Logbook) -> Iterator[None]:
    """Makes `package` the boot application when the block succeeds; its room on the disk is taken before.

    A full disk is a DiskFullError: after a power failure, another application would start than the one that
    was downloaded last. Where a folder cannot be written for other reasons, that is logged.
    """
    with ExitStack() as stack:
        if folder is not None:
            storing = replacing_file(folder / FILE, package, mode=PRIVATE, to_disk=True)
            try:
                stack.enter_context(storing)
            except OSError as error:
                if is_disk_full(error):
                    raise DiskFullError("there is no room for the boot application") from error
                log.add("error", "boot", f"the boot application could not be stored: {error}")
        yield


def create_boot(folder: Path | None, package: CodePackage, log: Logbook) -> None:
    """Makes `package` the boot application. Raises DiskFullError, BootError."""
    if folder is None:
        raise BootError("this runtime has no data folder, so it starts without an application")
    try:
        replace_file(folder / FILE, package.to_bytes(), mode=PRIVATE, to_disk=True)
    except OSError as error:
        if is_disk_full(error):
            raise DiskFullError("there is no room for the boot application") from error
        raise BootError(f"the boot application could not be stored: {error}") from error
    log.add("info", "boot", f"{package.application} is the boot application")


def load_boot(folder: Path) -> CodePackage | None:
    """The boot application; None when there is none, BootError when it is damaged."""
    try:
        data = (folder / FILE).read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise BootError(f"the boot application cannot be read: {error}") from error
    try:
        return CodePackage.from_bytes(data)
    except PackageError as error:
        raise BootError(f"the boot application is damaged: {error}") from error


def remove_boot(folder: Path) -> None:
    """Forget it (reset origin)."""
    (folder / FILE).unlink(missing_ok=True)
