"""The variables that clients outside may use, and how: attribute 'symbol' (LPRG-44, SYM-10, SYM-11)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from tappet.codegen.symbol_map import SymbolMap

FLAG: Final = "SYMBOL_"
"""Begins the flag of a variable with an access right, e.g. SYMBOL_READ."""
RIGHTS: Final = ("none", "read", "write", "readwrite")


def right_of(attribute: str | None) -> str | None:
    """The access right an attribute 'symbol' gives; readwrite without a value, None for another use of it
    such as 'no-exit' (LPRG-36)."""
    if attribute is None:
        return None
    right = attribute.lower() or "readwrite"
    return right if right in RIGHTS else None


def exported(symbols: SymbolMap) -> dict[str, str]:
    """Access right (read, write or readwrite) of every exported variable by its full path.

    Only variables of programs and global lists are exported; structures and blocks as a whole (SYM-11).
    """
    found: dict[str, str] = {}
    for root in symbols.roots.values():
        for member in symbols.types[root.type].members:
            for flag in member.flags:
                right = flag.removeprefix(FLAG).lower()
                if flag.startswith(FLAG) and right != "none":
                    found[f"{root.name}.{member.name}"] = right
    return found
