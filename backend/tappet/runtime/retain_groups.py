"""Which remanent variables an application has, and which task keeps which of them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from tappet.codegen.package import CodePackage
from tappet.disk_full import is_disk_full
from tappet.runtime.errors import DiskFullError
from tappet.runtime.retain import LIVE, Remanent, check_retain_room
from tappet.runtime.tasks import TaskOwnership


def remanent_of(package: CodePackage) -> list[Remanent]:
    """All RETAIN and PERSISTENT variables."""
    return [Remanent(r, False) for r in package.retain] + [Remanent(r, True) for r in package.persistent]


def by_task(variables: Sequence[Remanent], ownership: TaskOwnership) -> dict[int | None, list[Remanent]]:
    """The variables of each task; those under None belong to none."""
    groups: dict[int | None, list[Remanent]] = {}
    for r in variables:
        groups.setdefault(ownership.of(r.variable.offset), []).append(r)
    return groups


def remanent_by_task(package: CodePackage) -> dict[int | None, list[Remanent]]:
    """Which task of a package keeps which variables."""
    return by_task(remanent_of(package), TaskOwnership(package))


def check_room(folder: Path | None, package: CodePackage) -> None:
    """Raises DiskFullError when the remanent variables of a package would not be kept in `folder`."""
    groups = remanent_by_task(package)
    if not groups or folder is None:
        return
    try:
        check_retain_room(folder / LIVE, list(groups.values()))
    except OSError as error:  # others are noted when the file is opened
        if is_disk_full(error):
            raise DiskFullError("there is no room for the remanent variables") from error
