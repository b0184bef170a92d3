"""Addresses are taken of what can be changed there, and interfaces are checked before they are called.

Source: coding guidelines of PLCopen, E1 (no pointers), CP25; CODESYS Static Analysis SA0007, SA0046, SA0065,
SA0133, SA0170.

Passes:
    @static
    VAR nA : INT; pA : POINTER TO INT; nB : DINT; END_VAR
    pA := ADR(nA);
    pA := pA + SIZEOF(nA);
    nB := INT_TO_DINT(nA);
Fails:
    @static
    VAR CONSTANT cA : INT := 3; END_VAR
    VAR pA : POINTER TO INT; END_VAR
    pA := ADR(cA);                 (* S1230: the address of a constant *)
Fails:
    @static
    VAR aA : ARRAY[0..9] OF DINT; pA : POINTER TO DINT; END_VAR
    pA := ADR(aA[0]);
    pA := pA + 2;                  (* S1231: bytes, not elements of 4 bytes *)
Fails:
    @static
    INTERFACE I_Drive
    METHOD Start END_METHOD
    END_INTERFACE
    PROGRAM Main
    VAR iDrive : I_Drive; END_VAR
    iDrive.Start();                (* S1232: may be 0 *)
    END_PROGRAM
Fails:
    @static
    FUNCTION_BLOCK FB_Count
    VAR_OUTPUT nValue : INT; END_VAR
    nValue := 1;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbCount : FB_Count; pA : POINTER TO INT; END_VAR
    fbCount();
    pA := ADR(fbCount.nValue);     (* S1233: others could write the output *)
    END_PROGRAM
Fails:
    @static
    VAR nA : INT; nB : DINT; END_VAR
    nA := DINT_TO_INT(nB);         (* S1234: half of the value is lost *)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol, VarSymbol
from tappet.lang.types import Elementary, Interface, Pointer, Type, value_type
from tappet.lang.walk import all_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

_Report = Callable[..., None]
"""Reports a code at a node when it is chosen."""
CODES = ("S1230", "S1231", "S1232", "S1233", "S1234")


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the expressions of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    compared: set[int] = set()

    def say(code: str, e: ast.Node, **fields: object) -> None:
        if code in chosen:
            b.report(code, e.span, **fields)

    for e in all_expressions(b.pou.pou.body):
        if isinstance(e, ast.Binary):
            if e.op in ("=", "<>"):
                compared |= {id(getattr(side, "symbol", None)) for side in (e.left, e.right)}
            step = e.right.constant if e.op in ("+", "-") else None
            base = e.left.type.base if isinstance(e.left.type, Pointer) else None
            counted = isinstance(e.right, ast.Literal) and isinstance(step, int)
            if base is not None and counted and isinstance(step, int) and base.size and step % base.size:
                say("S1231", e, type=base, size=base.size)
        elif isinstance(e, ast.Call):
            if isinstance(e.target, BuiltinSymbol) and e.args and e.args[0].value is not None:
                _operator(e, e.target, e.args[0].value, say)
                compared |= {id(getattr(a.value, "symbol", None)) for a in e.args if _is_query(e.target)}
            elif isinstance(e.callee, ast.Member) and isinstance(e.callee.base.type, Interface):
                base_ = e.callee.base
                symbol = base_.symbol if isinstance(base_, (ast.Name, ast.Member)) else None
                if isinstance(symbol, VarSymbol) and id(symbol) not in compared:
                    say("S1232", base_, name=symbol.name)
                    compared.add(id(symbol))


def _is_query(target: BuiltinSymbol) -> bool:
    return target.name.startswith("__QUERY") or target.name == "__ISVALIDREF"


def _operator(e: ast.Call, target: BuiltinSymbol, operand: ast.Expr, say: _Report) -> None:
    symbol = getattr(operand, "symbol", None)
    if target.name == "ADR" and isinstance(symbol, VarSymbol):
        if "CONSTANT" in symbol.flags:
            say("S1230", e, name=symbol.name)
        elif symbol.section == "VAR_OUTPUT" and isinstance(operand, ast.Member):
            say("S1233", e, name=symbol.name)
    elif target.name == "CONVERT" and operand.type is not None and target.return_type is not None:
        source, result = value_type(operand.type), value_type(target.return_type)
        if not operand.is_constant and _narrows(source, result):
            say("S1234", e, source=source, target=result)


def _narrows(source: Type, result: Type) -> bool:
    same = isinstance(source, Elementary) and isinstance(result, Elementary) and source.kind == result.kind
    return same and source.size > result.size
