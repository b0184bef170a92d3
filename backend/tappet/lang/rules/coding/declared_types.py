"""Types are chosen so that data stay clear: no list of one, no variable of kilobytes, no second name.

Source: coding guidelines of PLCopen, E1..E3, CP25; CODESYS Static Analysis SA0010, SA0011, SA0100,
SA0112, SA0115, SA0171.

Passes:
    @static
    {attribute 'strict'}
    TYPE E_Mode : (eOff, eOn); END_TYPE
    PROGRAM Main
    VAR eMode : E_Mode; aA : ARRAY[0..4] OF INT; END_VAR
    aA[0] := SEL(eMode = E_Mode.eOn, 1, 2);
    END_PROGRAM
Fails:
    @static
    VAR aA : ARRAY[1..1] OF INT; END_VAR   (* S1109: one element *)
    aA[1] := 1;
Fails:
    @static
    VAR aA : ARRAY[0..999] OF LREAL; END_VAR   (* S1110: 8000 bytes *)
    aA[1] := 1;
Fails:
    @static
    VAR rA : REFERENCE TO INT; nA : INT; END_VAR   (* S1111: a second name for data *)
    rA REF= nA;
    rA := 1;
Fails:
    @static
    TYPE U_Data : UNION nA : DINT; rA : REAL; END_UNION END_TYPE   (* S1112: several types in one place *)
    TYPE E_Mode : (eOff, eOn); END_TYPE   (* S1113: takes any integer *)
    TYPE ST_One : STRUCT nA : INT; END_STRUCT END_TYPE   (* S1109: one member *)
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.attributes import attribute
from tappet.lang.types import Array, Reference

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body, Session

CODES = ("S1109", "S1110", "S1111", "S1112", "S1113")
_LARGE = 4096
"""Bytes of a variable from which it is named."""


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the variables of a POU."""
    if b.pou is None or b.pou.pou is None:
        return
    for block in b.pou.pou.blocks:
        for decl in block.variables:
            type_ = getattr(decl.symbol, "type", None)
            for code in _of_variable(type_):
                if code in chosen:
                    size = type_.size if type_ is not None else 0
                    b.report(code, decl.name_span, name=decl.name, type=type_, size=size)


def _of_variable(type_: object) -> Iterator[str]:
    if isinstance(type_, Array) and not type_.open_dims:
        if type_.count == 1:
            yield "S1109"
        if type_.size > _LARGE:
            yield "S1110"
    elif isinstance(type_, Reference):
        yield "S1111"


def check_unit(session: Session, unit: ast.Unit) -> None:
    """Reports the types of a text."""
    chosen = session.options.static.codes
    for decl in unit.declarations:
        if not isinstance(decl, ast.TypeDecl):
            continue
        ref = decl.type_ref
        codes: list[str] = []
        if isinstance(ref, ast.StructType):
            if ref.union:
                codes.append("S1112")
            elif len(ref.members) == 1 and not decl.extends:
                codes.append("S1109")
        elif isinstance(ref, ast.EnumType):
            if len(ref.values) == 1:
                codes.append("S1109")
            if attribute(decl.attributes, "strict") is None:
                codes.append("S1113")
        for code in codes:
            if code in chosen:
                uri = unit.source.uri
                session.report(code, uri, decl.name_span, name=decl.name, type=decl.name, size=0)
