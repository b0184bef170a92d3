"""Numbers keep to their type: no lost sign or fraction, no shift of a signed value, no value beyond a range.

A difference of unsigned values that is compared at once is computed in 32 bits: it can be negative there,
although its type cannot. An unsigned value that goes into a larger signed type loses nothing.

Source: coding guidelines of PLCopen, CP9, CP25; spec LOPR-03, LTYP-122; CODESYS Static Analysis SA0008,
SA0024, SA0052, SA0057, SA0066, SA0134.

Passes:
    @static
    VAR wA : WORD; uA : USINT; nA, nB : INT; nC : INT(0..9); bA : BOOL; rA : REAL; END_VAR
    wA := SHL(wA, INT#2);
    nA := USINT_TO_INT(uA);
    nC := LIMIT(INT#0, nA, INT#9);
    nC := nB MOD INT#10;
    bA := TO_USINT(uA - USINT#1) = USINT#255;
    rA := INT_TO_REAL(nA) / REAL#2.0;
Fails:
    @static
    VAR nA : INT; END_VAR
    nA := SHR(nA, 2);              (* S1239: what becomes of the sign? *)
Fails:
    @static
    VAR nA : INT; wA : WORD; END_VAR
    wA := INT_TO_WORD(nA);         (* S1240: -1 becomes 65535 *)
Fails:
    @static
    VAR uA : USINT; bA : BOOL; END_VAR
    bA := uA - 1 <> 255;           (* S1241: is TRUE for 0, the difference is -1 *)
Fails:
    @static
    VAR nA : INT; END_VAR
    nA := nA + 3;                  (* S1242: INT#3 *)
Fails:
    @static
    VAR nA : INT; nC : INT(0..9); END_VAR
    nA := nA + 1;
    nC := nA;                      (* S1243: may lie outside 0..9 *)
Fails:
    @static
    VAR nA : INT; rA : REAL; END_VAR
    rA := INT_TO_REAL(nA / 2);     (* S1249: 3 / 2 is 1 *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.intervals import interval
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Elementary, Kind, Subrange, value_type
from tappet.lang.walk import own_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1239", "S1240", "S1241", "S1242", "S1243", "S1249")
SHIFTS = frozenset({"SHL", "SHR", "ROL", "ROR"})
_EQUAL = frozenset({"=", "<>"})
_COMPARING = frozenset({"=", "<>", "<", ">", "<=", ">="})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the statements and expressions of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    for s in statements(b.pou.pou.body):
        indices: set[int] = set()
        if isinstance(s, ast.Assign) and "S1243" in chosen:
            _into_subrange(b, s)
        for e in own_expressions(s):
            if isinstance(e, ast.Call) and isinstance(e.target, BuiltinSymbol) and e.args:
                _operator(b, e, e.target, chosen)
            elif isinstance(e, ast.Binary) and e.op in _COMPARING and "S1241" in chosen:
                for side in (e.left, e.right):
                    if _can_differ(side, e.op):
                        b.report("S1241", side.span, type=side.type)
            elif isinstance(e, ast.Index):
                indices |= {id(index) for index in e.indices}
            elif isinstance(e, ast.Literal) and "S1242" in chosen and id(e) not in indices:
                _literal(b, e)


def _literal(b: Body, e: ast.Literal) -> None:
    type_ = value_type(e.type) if e.type is not None else None
    if e.kind in ("int", "real") and e.prefix is None and isinstance(type_, Elementary):
        b.report("S1242", e.span, text=e.text, type=type_)


def _operator(b: Body, e: ast.Call, target: BuiltinSymbol, chosen: frozenset[str]) -> None:
    operand = e.args[0].value
    if operand is None or operand.type is None or operand.is_constant:
        return
    source = value_type(operand.type)
    if not isinstance(source, Elementary):
        return
    if target.name in SHIFTS and source.kind is Kind.SIGNED and "S1239" in chosen:
        b.report("S1239", e.span, op=target.name, type=source)
    elif target.name == "CONVERT" and target.return_type is not None:
        result = value_type(target.return_type)
        if not isinstance(result, Elementary):
            return
        if "S1240" in chosen and _loses_sign(source, result):
            b.report("S1240", e.span, source=source, target=result)
        divided = isinstance(operand, ast.Binary) and operand.op == "/" and source.is_integer
        if "S1249" in chosen and divided and result.kind is Kind.REAL:
            b.report("S1249", e.span, source=source, target=result)


def _loses_sign(source: Elementary, result: Elementary) -> bool:
    if not source.is_integer or not result.is_integer or source.is_signed == result.is_signed:
        return False
    return source.is_signed or source.size >= result.size


def _can_differ(e: ast.Expr, op: str) -> bool:
    """Whether a result can lie outside its type and the comparison would see that."""
    if not isinstance(e, ast.Binary) or e.is_constant or not isinstance(e.type, Elementary):
        return False
    narrow = e.type.is_integer and not e.type.is_signed and e.type.size < 4
    return narrow and (e.op == "-" or (e.op in ("+", "*") and op in _EQUAL))


def _into_subrange(b: Body, s: ast.Assign) -> None:
    target = s.target.type
    if not isinstance(target, Subrange) or s.value.is_constant or s.value.type is None:
        return
    found = interval(s.value, {}, types=True)
    if found is None or found[0] < target.low or found[1] > target.high:
        b.report("S1243", s.value.span, type=target, low=target.low, high=target.high)
