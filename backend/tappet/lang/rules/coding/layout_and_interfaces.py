"""Packed data are packed inside as well, and an interface is not referred to once more.

Members of a structure with 'pack_mode' follow each other without gaps; a structure inside keeps its own gaps
unless it is packed too, and other devices then read shifted data. A variable of an interface is a reference
already: REFERENCE TO it, and VAR_IN_OUT, let others exchange what it refers to.

Source: coding guidelines of PLCopen, CP25; spec LTYP-105, LPRG-40; CODESYS Static Analysis SA0044, SA0161.

Passes:
    @static
    {attribute 'pack_mode' := '1'}
    TYPE ST_Head : STRUCT nKind : BYTE; nLength : DINT; END_STRUCT END_TYPE
    {attribute 'pack_mode' := '1'}
    TYPE ST_Frame : STRUCT nStart : BYTE; stHead : ST_Head; END_STRUCT END_TYPE
    INTERFACE I_Drive
    METHOD Start END_METHOD
    END_INTERFACE
    FUNCTION_BLOCK FB_Line
    VAR_INPUT iDrive : I_Drive; END_VAR
    IF iDrive <> 0 THEN iDrive.Start(); END_IF
    END_FUNCTION_BLOCK
Fails:
    @static
    TYPE ST_Head : STRUCT nKind : BYTE; nLength : DINT; END_STRUCT END_TYPE
    {attribute 'pack_mode' := '1'}
    TYPE ST_Frame : STRUCT nStart : BYTE; stHead : ST_Head; END_STRUCT END_TYPE   (* S1118: 3 bytes of gap *)
Fails:
    @static
    INTERFACE I_Drive
    METHOD Start END_METHOD
    END_INTERFACE
    FUNCTION_BLOCK FB_Line
    VAR_IN_OUT iDrive : I_Drive; END_VAR   (* S1119: a reference to a reference *)
    IF iDrive <> 0 THEN iDrive.Start(); END_IF
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.parts import innermost
from tappet.lang.types import FunctionBlock, Interface, Reference, Struct

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body, Session

CODES = ("S1118", "S1119")


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports references to interfaces."""
    if "S1119" not in chosen or b.pou is None or b.pou.pou is None:
        return
    for block in b.pou.pou.blocks:
        for decl in block.variables:
            type_ = getattr(decl.symbol, "type", None)
            twice = isinstance(type_, Reference) and isinstance(type_.base, Interface)
            if twice or (block.section == "VAR_IN_OUT" and isinstance(type_, Interface)):
                b.report("S1119", decl.name_span, name=decl.name)


def check_unit(session: Session, unit: ast.Unit) -> None:
    """Reports members of packed structures that need more alignment: no other structure has less."""
    if "S1118" not in session.options.static.codes:
        return
    for decl in unit.declarations:
        struct = decl.type if isinstance(decl, ast.TypeDecl) else None
        if not isinstance(struct, Struct):
            continue
        for member in struct.members.values():
            inner = innermost(member.type)
            aligned = not isinstance(inner, (Struct, FunctionBlock)) or inner.align <= struct.align
            if not aligned and member.decl is not None:
                place = member.decl.name_span if _is_own(decl, member.decl) else decl.name_span
                session.report(
                    "S1118", unit.source.uri, place, name=decl.name, member=member.name, type=inner
                )


def _is_own(decl: ast.Declaration, member: ast.VarDecl) -> bool:
    """Whether a member is declared here and not in a base structure."""
    ref = decl.type_ref if isinstance(decl, ast.TypeDecl) else None
    return isinstance(ref, ast.StructType) and any(own is member for own in ref.members)
