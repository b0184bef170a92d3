"""Operands fit their operation.

Source: coding guidelines of PLCopen, CP9, CP25 (data types); CODESYS Static Analysis SA0014, SA0018, SA0025,
SA0058, SA0060, SA0062, SA0081, SA0122.

Passes:
    @static
    TYPE E_Mode : (eOff, eOn); END_TYPE
    PROGRAM Main
    VAR CONSTANT cLast : INT := 4; END_VAR
    VAR eMode : E_Mode; wA : WORD; i : INT; aA : ARRAY[0..4] OF INT; bA : BOOL; END_VAR
    eMode := E_Mode.eOn;
    bA := wA.3 AND eMode = E_Mode.eOn;
    FOR i := 0 TO cLast DO aA[i] := 2 * aA[i]; END_FOR
    END_PROGRAM
Fails:
    @static
    TYPE E_Mode : (eOff, eOn); END_TYPE
    PROGRAM Main
    VAR eMode : E_Mode; END_VAR
    eMode := eOn;                  (* S1223: write E_Mode.eOn *)
    eMode := eMode + 1;            (* S1226: arithmetic on an enumeration *)
    END_PROGRAM
Fails:
    @static
    FUNCTION_BLOCK FB_Count
    VAR n1 : INT; END_VAR
    n1 := n1 + 1;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbA, fbB : FB_Count; END_VAR
    fbA();
    fbB := fbA;                    (* S1224: copies the state of an instance *)
    END_PROGRAM
Fails:
    @static
    VAR nA : INT; bA : BOOL; END_VAR
    bA := nA.15;                   (* S1225: the sign of nA *)
Fails:
    @static
    VAR nA, nB : INT; bA : BOOL; END_VAR
    nA := nB + 0;                  (* S1227: changes nothing *)
    bA := bA AND TRUE;             (* S1227: the same *)
Fails:
    @static
    VAR nA, nLast, i : INT; aA : ARRAY[0..9] OF INT; END_VAR
    nA := aA[nA + nLast];          (* S1228: computed inside the index *)
    FOR i := 0 TO nLast DO         (* S1229: ends at a variable *)
        aA[i] := 0;
    END_FOR
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import EnumValueSymbol
from tappet.lang.types import Elementary, Enum, FunctionBlock, value_type
from tappet.lang.walk import own_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1223", "S1224", "S1225", "S1226", "S1227", "S1228", "S1229")
_ARITHMETIC = frozenset({"+", "-", "*", "/", "MOD"})
_NEUTRAL: dict[str, tuple[object, ...]] = {
    "+": (0,), "-": (0,), "*": (0, 1), "/": (1,), "AND": (True, False), "OR": (True, False),
}  # fmt: skip
"""Constants with which an operation changes nothing, or makes its other operand useless."""


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the statements and expressions of a body."""
    if b.pou is None or b.pou.pou is None:
        return

    def say(code: str, e: ast.Node, **fields: object) -> None:
        if code in chosen:
            b.report(code, e.span, **fields)

    for s in statements(b.pou.pou.body):
        if isinstance(s, ast.Assign) and s.op == ":=" and isinstance(s.target.type, FunctionBlock):
            say("S1224", s, type=s.target.type)
        elif isinstance(s, ast.For) and not s.stop.is_constant:
            say("S1229", s.stop)
        for e in own_expressions(s):
            if isinstance(e, ast.Name) and isinstance(e.symbol, EnumValueSymbol):
                say("S1223", e, name=e.name, type=e.symbol.type)
            elif isinstance(e, ast.Member) and e.bit is not None:
                base = value_type(e.base.type) if e.base.type is not None else None
                if isinstance(base, Elementary) and base.is_signed:
                    say("S1225", e, type=base)
            elif isinstance(e, ast.Binary):
                if e.op in _ARITHMETIC and isinstance(e.left.type, Enum):
                    say("S1226", e, op=e.op, type=e.left.type)
                if not e.is_constant and any(_neutral(e.op, side) for side in _sides(e)):
                    say("S1227", e, op=e.op)
            elif isinstance(e, ast.Index):
                for index in e.indices:
                    if isinstance(index, ast.Binary) and not index.is_constant:
                        say("S1228", index)


def _sides(e: ast.Binary) -> tuple[ast.Expr, ...]:
    return (e.right,) if e.op in ("-", "/") else (e.left, e.right)


def _neutral(op: str, e: ast.Expr) -> bool:
    wanted = _NEUTRAL.get(op, ())
    literal = isinstance(e, ast.Literal) and e.kind in ("int", "bool")
    return literal and any(e.constant is w or (w is not True and w is not False and e.constant == w
                           and not isinstance(e.constant, bool)) for w in wanted)  # fmt: skip
