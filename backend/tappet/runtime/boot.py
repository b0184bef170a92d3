"""The boot application: the package that a runtime starts when its process begins, and what it keeps."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from tappet.codegen.package import CodePackage, PackageError
from tappet.disk_full import is_disk_full
from tappet.runtime.application import LoadedApplication
from tappet.runtime.errors import DiskFullError
from tappet.runtime.logbook import Logbook
from tappet.runtime.retain import Kept, load_retain
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


def create_boot(folder: Path, package: bytes) -> None:
    """Makes `package` the boot application. Raises DiskFullError, BootError."""
    try:
        replace_file(folder / FILE, package, mode=PRIVATE, to_disk=True)
    except OSError as error:
        if is_disk_full(error):
            raise DiskFullError("there is no room for the boot application") from error
        raise BootError(f"the boot application could not be stored: {error}") from error


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


def persistent_of(old: LoadedApplication | None, package: CodePackage, folder: Path | None) -> Kept:
    """Persistent values survive a download of the application of the same name (PERS-05); ends its tasks."""
    if old is not None:
        if old.package.application != package.application:
            return {}
        old.tasks.stop()
        return old.kept_values(retain=False)
    if folder is None:
        return {}
    kept, _ = load_retain(folder)  # left by a boot application that could not be loaded
    return {path: value for path, value in kept.items() if value.persistent}
