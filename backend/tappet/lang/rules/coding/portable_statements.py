"""Statements that other systems of IEC 61131-3 read as well.

In the standard tasks call programs, a POU names the global variables it uses in VAR_EXTERNAL, bits belong to
bit strings, and there are no addresses. Switch these rules on for code that has to be moved.

Source: coding guidelines of PLCopen, CP18, E2; CODESYS Static Analysis SA0120, SA0121, SA0123, SA0147,
SA0148.

Passes:
    @static
    @source GVL_Data
    VAR_GLOBAL nTotal : INT; END_VAR
    @source Main
    PROGRAM Main
    VAR_EXTERNAL nTotal : INT; END_VAR
    VAR wA : WORD; bA : BOOL; END_VAR
    wA := SHL(wA, 2);
    bA := wA.3;
    nTotal := SEL(bA, 1, 2);
    END_PROGRAM
Fails:
    @static
    @source GVL_Data
    VAR_GLOBAL nTotal : INT; END_VAR
    @source Main
    PROGRAM Main
    VAR uA : UINT; bA : BOOL; pA : POINTER TO UINT; END_VAR
    nTotal := 2;                   (* S1610: without VAR_EXTERNAL *)
    pA := ADR(uA);                 (* S1611: an address *)
    uA := SHL(uA, 2);              (* S1612: a number is shifted *)
    bA := uA.3;                    (* S1613: a bit of a number *)
    Other();                       (* S1609: calls a program *)
    END_PROGRAM
    PROGRAM Other
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.rules.coding.number_types import SHIFTS
from tappet.lang.symbols import BuiltinSymbol, PouSymbol, Storage, VarSymbol
from tappet.lang.types import Elementary, Kind, value_type
from tappet.lang.walk import all_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1609", "S1610", "S1611", "S1612", "S1613")
_ADDRESSES = frozenset({"ADR", "XADR", "BITADR", "INI"})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the expressions of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    declared = {id(symbol) for symbol in b.pou.locals.values()}

    def say(code: str, e: ast.Node, **fields: object) -> None:
        if code in chosen:
            b.report(code, e.span, **fields)

    for e in all_expressions(b.pou.pou.body):
        if isinstance(e, ast.Call):
            if isinstance(e.target, PouSymbol) and e.target.kind == "PROGRAM":
                say("S1609", e, name=e.target.name)
            elif isinstance(e.target, BuiltinSymbol):
                if e.target.name in _ADDRESSES:
                    say("S1611", e, op=e.target.name)
                elif e.target.name in SHIFTS and e.args:
                    type_ = _number(e.args[0].value, "S1239" in chosen)
                    if type_ is not None:
                        say("S1612", e, op=e.target.name, type=type_)
        elif isinstance(e, ast.Member) and e.bit is not None:
            type_ = _number(e.base, "S1225" in chosen)
            if type_ is not None:
                say("S1613", e, type=type_)
        elif isinstance(e, (ast.Name, ast.Member)) and isinstance(e.symbol, VarSymbol):
            symbol = e.symbol
            if (
                symbol.home is Storage.GLOBAL
                and symbol.section == "VAR_GLOBAL"
                and id(symbol) not in declared
            ):
                declared.add(id(symbol))
                say("S1610", e, name=symbol.name)


def _number(e: ast.Expr | None, signed_reported: bool) -> Elementary | None:
    """The type of an integer that is no bit string; a signed one only if no other rule reports it."""
    if e is None or e.type is None or e.is_constant:
        return None
    type_ = value_type(e.type)
    if not isinstance(type_, Elementary) or type_.kind not in (Kind.SIGNED, Kind.UNSIGNED):
        return None
    return None if type_.kind is Kind.SIGNED and signed_reported else type_
