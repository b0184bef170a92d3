"""Structures that no text declares: those of `__SYSTEM`, and the types that every TwinCAT project knows."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.symbols import Storage, TypeSymbol, VarSymbol


def structure(name: str, members: Iterable[tuple[str, t.Type, str]]) -> t.Struct:
    """A structure of members given as name, type and comment."""
    struct = t.Struct(name)
    offset = 0
    for member, type_, comment in members:
        offset = _aligned(offset, type_.align)
        ref = ast.NamedType(name=str(type_))
        ref.type = type_
        decl = ast.VarDecl(name=member, type_ref=ref, comment=comment)
        symbol = VarSymbol(
            member,
            comment=comment,
            type=type_,
            storage=Storage.INSTANCE,
            home=Storage.INSTANCE,
            owner=name,
            offset=offset,
            decl=decl,
        )
        decl.symbol = symbol
        struct.members[member.upper()] = t.Member(member, type_, offset, decl=decl)
        struct.align = max(struct.align, type_.align)
        offset += type_.size
    struct.size = _aligned(offset, struct.align)
    return struct


def _aligned(offset: int, align: int) -> int:
    return -(-offset // align) * align


_NET_ID = t.Array(t.BYTE, ((0, 5),))
_AMS_ADDRESS = structure(
    "AMSADDR", [("netId", _NET_ID, "AMS net ID of the device"), ("port", t.WORD, "AMS port")]
)
TWINCAT_TYPES = {
    name: TypeSymbol(name, type=type_)
    for name, type_ in (
        ("HRESULT", t.DINT),
        ("OTCID", t.UDINT),
        ("DCTIME", t.ULINT),
        ("FILETIME", t.ULINT),
        ("PVOID", t.Pointer(t.BYTE)),
        ("AMSNETID", _NET_ID),
        ("AMSADDR", _AMS_ADDRESS),
    )
}
"""Types that TwinCAT knows without a library; whatever a project or a library declares goes first."""
