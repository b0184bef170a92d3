"""What the symbol map knows of types: plain data, without paths and addresses."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Annotated

from msgspec import Meta, Struct

TypeIndex = Annotated[int, Meta(ge=0)]
"""Index into `SymbolMap.types`."""
Size = Annotated[int, Meta(ge=0)]
Bit = Annotated[int, Meta(ge=0, le=7)]


class MemberInfo(Struct, frozen=True, array_like=True):
    """One member of a structure, function block, program or variable list."""

    name: str
    type: TypeIndex
    offset: int
    section: str = "VAR"
    """VAR, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT (a pointer) ..."""
    flags: tuple[str, ...] = ()
    """Sorted, of CONSTANT, RETAIN, PERSISTENT, HIDDEN, DISPLAY_HEX (`display`),
    SYMBOL_READ (`symbol_export`)."""
    bit: Bit | None = None
    """Bit of a BIT member or of a variable at a bit address."""
    absolute: bool = False
    """`offset` counts from the start of the image (variables at addresses, VAR_STAT)."""


class TypeInfo(Struct, frozen=True, array_like=True):
    """One type; `elem` and `base` are indices into `SymbolMap.types`."""

    name: str
    kind: str
    """bool bits int uint real time ltime date tod dt ldate ltod ldt string wstring enum array struct union
    fb program gvl pointer reference interface."""
    size: Size
    elem: TypeIndex | None = None
    """Array element, or target of a pointer or reference."""
    bounds: tuple[tuple[int, int], ...] = ()
    members: tuple[MemberInfo, ...] = ()
    values: tuple[tuple[str, int], ...] = ()
    """Names and numbers of an enumeration."""
    base: str = ""
    """Kind of the integer below an enumeration (`int` or `uint` or `bits`)."""
    length: int = 0
    """Characters of a string."""
    range: tuple[int, int] | None = None
    """Bounds of a subrange."""

    @property
    def leaf(self) -> bool:
        """Whether a value of this type has no parts to open."""
        return self.kind not in ("array", "struct", "union", "fb", "program", "gvl")


def user_members(members: Iterable[MemberInfo]) -> Iterator[MemberInfo]:
    """Members that are variables of their own, and of the user."""
    return (
        member
        for member in members
        if member.section != "VAR_IN_OUT"
        and "HIDDEN" not in member.flags
        and not member.name.startswith("__")
    )
