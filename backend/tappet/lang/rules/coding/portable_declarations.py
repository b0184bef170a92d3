"""Declarations that other systems of IEC 61131-3 read as well.

Object orientation, WSTRING and LTIME came with the third edition or stayed optional; BIT, expressions as
bounds and initial values that are computed are extensions. Switch these rules on for code that has to be
moved to a system without them.

Source: coding guidelines of PLCopen, CP3, CP18, E1..E3; CODESYS Static Analysis SA0113, SA0114, SA0117,
SA0118, SA0119, SA0122, SA0124, SA0125.

Passes:
    @static
    TYPE ST_Flags : STRUCT bA : BOOL; nB : INT; END_STRUCT END_TYPE
    FUNCTION_BLOCK FB_Plain
    VAR CONSTANT MAX_PLACE : INT := 9; END_VAR
    VAR sA : STRING; tA : TIME; stA : ST_Flags := (nB := 2); aA : ARRAY[0..MAX_PLACE] OF INT; END_VAR
    aA[0] := LEN_OF(sA) + stA.nB + TIME_TO_INT(tA);
    END_FUNCTION_BLOCK
    FUNCTION LEN_OF : INT
    VAR_INPUT sA : STRING; END_VAR
    LEN_OF := SEL(sA = '', 1, 0);
    END_FUNCTION
Fails:
    @static
    VAR wsA : WSTRING; END_VAR     (* S1601: WSTRING *)
    VAR ltA : LTIME; END_VAR       (* S1602: LTIME *)
    wsA := "a"; ltA := LTIME#1S;
Fails:
    @static
    TYPE ST_Flags : STRUCT bA, bB : BIT; END_STRUCT END_TYPE   (* S1603: BIT *)
Fails:
    @static
    INTERFACE I_Drive              (* S1604: an interface *)
    METHOD Start END_METHOD        (* S1604: a method *)
    END_INTERFACE
    FUNCTION_BLOCK FB_Drive IMPLEMENTS I_Drive   (* S1604: IMPLEMENTS *)
    METHOD Start END_METHOD
    END_FUNCTION_BLOCK
Fails:
    @static
    VAR CONSTANT cLast : INT := 9; END_VAR
    VAR aA : ARRAY[0..cLast - 1] OF INT; END_VAR   (* S1605: computed *)
    aA[0] := 2;
Fails:
    @static
    FUNCTION_BLOCK FB_Data
    VAR_INPUT pA : POINTER TO INT; rA : REFERENCE TO INT; nA : INT; END_VAR
    VAR_TEMP nB : INT := pA^; END_VAR   (* S1606: through a pointer *)
    VAR_TEMP nC : INT := rA; END_VAR   (* S1607: of a reference *)
    VAR_TEMP nD : INT := nA; END_VAR   (* S1608: of a variable *)
    nA := nB + nC + nD;
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.source import Span
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import LTIME, Array, Pointer, Reference, String
from tappet.lang.walk import expressions, variables

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("S1601", "S1602", "S1603", "S1604", "S1605", "S1606", "S1607", "S1608")
_Found = Iterator[tuple[str, Span, str]]
"""Code, place, and the name in the message."""


def check_unit(session: Session, unit: ast.Unit) -> None:
    """Reports what a text declares."""
    chosen = session.options.static.codes
    for decl in variables(unit):
        for code, span, name in (*_type(decl), *_initial(decl)):
            if code in chosen:
                session.report(code, unit.source.uri, span, name=name)
    if "S1604" in chosen:
        for declaration in unit.declarations:
            for code, span, name in _objects(declaration):
                session.report(code, unit.source.uri, span, name=name)


def _type(decl: ast.VarDecl) -> _Found:
    type_: object = getattr(decl.symbol, "type", None) or decl.type_ref.type
    ref: ast.TypeRef = decl.type_ref
    while isinstance(type_, (Array, Pointer, Reference)):
        type_ = type_.element if isinstance(type_, Array) else type_.base
    if isinstance(type_, String) and type_.wide:
        yield "S1601", decl.name_span, decl.name
    elif type_ == LTIME:
        yield "S1602", decl.name_span, decl.name
    while isinstance(ref, ast.ArrayType):
        for bound in (bound for pair in ref.bounds for bound in pair):
            if isinstance(bound, (ast.Binary, ast.Call)):
                yield "S1605", bound.span, decl.name
        ref = ref.element
    if isinstance(ref, ast.NamedType) and ref.name.upper() == "BIT":
        yield "S1603", decl.name_span, decl.name


def _initial(decl: ast.VarDecl) -> _Found:
    if decl.initial is None or decl.initial_ref:
        return
    for e in expressions(decl.initial):
        if isinstance(e, ast.Deref):
            yield "S1606", e.span, decl.name
            return
        symbol = e.symbol if isinstance(e, ast.Name) else None
        if isinstance(symbol, VarSymbol) and isinstance(symbol.type, Reference):
            yield "S1607", e.span, decl.name
            return
    for e in expressions(decl.initial):
        computed = isinstance(e, ast.Call) or (isinstance(e, ast.Name) and isinstance(e.symbol, VarSymbol))
        if computed and not e.is_constant:
            yield "S1608", e.span, decl.name
            return


def _objects(declaration: ast.Declaration) -> _Found:
    """Interfaces, methods, properties and heads with EXTENDS or IMPLEMENTS."""
    head = isinstance(declaration, ast.Pou) and bool(declaration.extends or declaration.implements)
    method = isinstance(declaration, ast.Pou) and declaration.kind == "METHOD"
    if head or method or isinstance(declaration, (ast.Interface, ast.Property)):
        yield "S1604", declaration.name_span, declaration.name
    if isinstance(declaration, (ast.Interface, ast.Pou)):
        for part in (*declaration.methods, *declaration.properties):
            yield from _objects(part)
