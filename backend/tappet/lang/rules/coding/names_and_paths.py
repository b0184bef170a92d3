"""A name means one thing, and a thing is reached by one name.

Source: coding guidelines of PLCopen, N4, N5, N9; CODESYS Static Analysis SA0027, SA0042.

Passes:
    @static
    @source GVL_Data
    VAR_GLOBAL nTotal : INT; END_VAR
    @source Main
    TYPE E_Mode : (eOff, eOn); END_TYPE
    PROGRAM Main
    VAR nA : INT; END_VAR
    nA := GVL_Data.nTotal;
    GVL_Data.nTotal := nA + 1;
    END_PROGRAM
Fails:
    @static
    @source GVL_Data
    VAR_GLOBAL nTotal : INT; END_VAR
    @source Main
    PROGRAM Main
    VAR nA : INT; END_VAR
    nA := GVL_Data.nTotal;
    nTotal := nA + 1;              (* S1423: the same variable by another path *)
    END_PROGRAM
Fails:
    @static
    TYPE E_Mode : (eOff, eOn); END_TYPE
    TYPE E_Valve : (eShut, eOn); END_TYPE   (* S1010: eOn is a value of E_Mode as well *)
Fails:
    @static
    FUNCTION_BLOCK Motor
    VAR nA : INT; END_VAR
    nA := nA + 1;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR Motor : Motor; END_VAR     (* S1010: the name of its type *)
    Motor();
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.diagnostics import Related
from tappet.lang.named_symbols import is_own, named_in, with_parts
from tappet.lang.symbols import (
    GvlSymbol,
    InterfaceSymbol,
    PouSymbol,
    Symbol,
    TypeSymbol,
)
from tappet.lang.types import Enum

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body, Session

CODES = ("S1010", "S1423")
_OBJECTS = (PouSymbol, TypeSymbol, GvlSymbol, InterfaceSymbol)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports variables that have the name of an object of the project."""
    if "S1010" not in chosen or b.pou is None or b.pou.pou is None:
        return
    for block in b.pou.pou.blocks:
        if block.section == "VAR_EXTERNAL":
            continue
        for decl in block.variables:
            other = b.names.get(decl.name.upper())
            if isinstance(other, _OBJECTS) and is_own(other.source):
                b.report("S1010", decl.name_span, name=decl.name, other=_what(other))


def check_program(session: Session, chosen: frozenset[str]) -> None:
    """Reports values of several enumerations with one name, and variables with several paths."""
    if "S1010" in chosen:
        _values(session)
    if "S1423" in chosen:
        _paths(session)


def _what(symbol: Symbol) -> str:
    """An object as its declaration begins."""
    if isinstance(symbol, PouSymbol):
        return f"{symbol.kind} {symbol.name}"
    keyword = {GvlSymbol: "VAR_GLOBAL", InterfaceSymbol: "INTERFACE"}.get(type(symbol), "TYPE")
    return f"{keyword} {symbol.name}"


def _values(session: Session) -> None:
    first: dict[str, Enum] = {}
    for enum in session.analysis.types.values():
        decl = enum.decl if isinstance(enum, Enum) else None
        ref = decl.type_ref if decl is not None else None
        if not isinstance(enum, Enum) or decl is None or enum.qualified_only or not is_own(decl.source):
            continue
        for entry in ref.values if isinstance(ref, ast.EnumType) else ():
            other = first.setdefault(entry.name.upper(), enum)
            if other is not enum and decl.source is not None:
                qualified = f"{other.name}.{entry.name}"
                session.report("S1010", decl.source.uri, entry.span, name=entry.name, other=qualified)


def _paths(session: Session) -> None:
    plain: dict[int, tuple[ast.Name, str]] = {}
    qualified: dict[int, tuple[ast.Member, str]] = {}
    for body in with_parts(session):
        if body.source is None or not is_own(body.source):
            continue
        found = named_in(session, body)
        for key, name in found.plain.items():
            plain.setdefault(key, (name, body.source.uri))
        for key, member in found.qualified.items():
            qualified.setdefault(key, (member, body.source.uri))
    for key, (place, place_uri) in plain.items():
        if key in qualified and place.symbol is not None:
            other, other_uri = qualified[key]
            related = [Related("by its list or library here", other_uri, other.span)]
            session.report("S1423", place_uri, place.span, related, name=place.symbol.name)
