"""The boot application: the package that a runtime loads and starts when its process begins."""

from __future__ import annotations

from pathlib import Path

from tappet.codegen.package import CodePackage, PackageError
from tappet.runtime.retain import write_atomically

FILE = "boot.tappet"


class BootError(RuntimeError):
    """The boot application could not be read or written."""


def store_boot(folder: Path, package: bytes) -> None:
    """Make `package` the boot application; after a crash the old or the new one is there."""
    try:
        write_atomically(folder / FILE, package)
    except OSError as error:
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
