"""Which persistent variables a download cannot keep (PERS-05)."""

from __future__ import annotations

from tappet.codegen.package import CodePackage
from tappet.server.builds.shapes import PersistentChange


def persistent_changes(old: bytes, new: bytes) -> list[PersistentChange]:
    """Persistent variables of the loaded package whose values find no place in the new one, in their order.

    Values follow path and type; what is declared in addition does not touch the others.
    """
    after = {
        variable.path.upper(): variable.type_signature for variable in CodePackage.from_bytes(new).persistent
    }
    changes: list[PersistentChange] = []
    for variable in CodePackage.from_bytes(old).persistent:
        signature = after.get(variable.path.upper())
        if signature is None:
            changes.append(PersistentChange(path=variable.path, reason="removed"))
        elif signature != variable.type_signature:
            changes.append(PersistentChange(path=variable.path, reason="type_changed"))
    return changes
