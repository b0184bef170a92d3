"""What becomes of remanent variables when a package takes the place of another one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from tappet.codegen.package import CodePackage, RemanentRange
from tappet.server.builds.shapes import PersistentChange


@dataclass(frozen=True)
class RemanentChanges:
    """What differs in the remanent variables of two packages."""

    persistent: list[PersistentChange]
    """Those that a download cannot keep (PERS-05), in the order of the loaded package."""
    layout: bool
    """Whether one is there no more, is new, or has another place or type: the retain file is written anew."""


def remanent_changes(old: bytes, new: bytes) -> RemanentChanges:
    """Compares the loaded package with the one that is to replace it."""
    before, after = CodePackage.from_bytes(old), CodePackage.from_bytes(new)
    return RemanentChanges(
        persistent=list(_not_kept(before, after)),
        layout=_layout(before.retain, before.persistent) != _layout(after.retain, after.persistent),
    )


def _not_kept(before: CodePackage, after: CodePackage) -> Iterator[PersistentChange]:
    """Values follow path and type; what is declared in addition does not touch the others."""
    signatures = {variable.path.upper(): variable.type_signature for variable in after.persistent}
    for variable in before.persistent:
        signature = signatures.get(variable.path.upper())
        if signature is None:
            yield PersistentChange(path=variable.path, reason="removed")
        elif signature != variable.type_signature:
            yield PersistentChange(path=variable.path, reason="type_changed")


def _layout(*kinds: list[RemanentRange]) -> list[set[tuple[str, int, int, str]]]:
    """Which variables are RETAIN and which PERSISTENT, where they lie and how they are made."""
    return [{(v.path.upper(), v.offset, v.size, v.type_signature) for v in kind} for kind in kinds]
