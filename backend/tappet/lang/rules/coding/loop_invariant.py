"""A loop computes what changes with its turns; its counter is not kept between the calls.

An assignment is named when every turn makes it, with the same value each time: what it reads is not written
inside the loop and cannot be changed by a call there. Global variables and addresses may change at any time.

Source: coding guidelines of PLCopen, CP28, L14; CODESYS Static Analysis SA0041, SA0073.

Passes:
    @static
    FUNCTION_BLOCK FB_Sum
    VAR nSum : INT; aA : ARRAY[0..9] OF INT; END_VAR
    VAR_TEMP i, nTwice : INT; END_VAR
    nSum := 0;
    FOR i := 0 TO 9 DO
        nTwice := 2 * aA[i];
        nSum := nSum + nTwice;
    END_FOR
    END_FUNCTION_BLOCK
Fails:
    @static
    FUNCTION_BLOCK FB_Sum
    VAR nSum, nScale, nFactor, i : INT; aA : ARRAY[0..9] OF INT; END_VAR
    nScale := nScale + 1;
    FOR i := 0 TO 9 DO             (* S1245: i is kept with the instance *)
        nFactor := 2 * nScale;     (* S1244: the same in each turn *)
        nSum := nSum + nFactor * aA[i];
    END_FOR
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.flow import handed_over
from tappet.lang.symbols import BuiltinSymbol, PouSymbol, Storage, VarSymbol
from tappet.lang.types import Elementary, Enum, Reference, Subrange
from tappet.lang.walk import bodies, expressions, own_expressions, root, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1244", "S1245")
_LOOPS = (ast.For, ast.While, ast.RepeatUntil)
_LEAVING = (ast.Exit, ast.Continue, ast.Return, ast.Jump)
_SIMPLE = (Elementary, Enum, Subrange)
_OWN = frozenset({Storage.LOCAL, Storage.PARAMETER, Storage.RESULT})
_HELD = frozenset({Storage.INSTANCE, Storage.PROGRAM})
_KEPT = _HELD | {Storage.GLOBAL}
_CHANGING = frozenset({"ADR", "XADR", "BITADR", "TIME", "LTIME"})
"""Operators that give what may change, or give it away."""
_UNSTEADY = (ast.Deref, ast.AssignExpr, ast.Held, ast.This, ast.Super)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the loops of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    for s in statements(b.pou.pou.body):
        if not isinstance(s, _LOOPS):
            continue
        counter = s.variable if isinstance(s, ast.For) else None
        symbol = counter.symbol if isinstance(counter, ast.Name) else None
        if (
            "S1245" in chosen
            and isinstance(symbol, VarSymbol)
            and symbol.home in _KEPT
            and counter is not None
        ):
            b.report("S1245", counter.span, name=symbol.name)
        if "S1244" in chosen:
            _invariants(b, s)


def _invariants(b: Body, s: ast.For | ast.While | ast.RepeatUntil) -> None:
    inside = list(statements(s.body))
    written: Counter[int] = Counter()
    calls = False
    for inner in inside:
        for target in _targets(inner):
            place = root(target)
            if not isinstance(place, ast.Name):
                return  # through a pointer: any variable
            written[id(place.symbol)] += 1
        calls = calls or any(
            isinstance(e, ast.Call) and not isinstance(e.target, BuiltinSymbol)
            for e in own_expressions(inner)
        )
    if isinstance(s, ast.For) and isinstance(s.variable, ast.Name):
        written[id(s.variable.symbol)] += 1
    steady = _OWN if calls else _OWN | _HELD
    read = {id(e.symbol) for e in expressions(*_controls(s)) if isinstance(e, ast.Name)}
    for one in s.body:
        if isinstance(one, _LEAVING) or any(isinstance(e, _LEAVING) for e in _inside(one)):
            return
        if isinstance(one, ast.Assign) and one.op == ":=" and isinstance(one.target, ast.Name):
            key = id(one.target.symbol)
            constant = _same_each_turn(one.value, written, steady)
            if constant and written[key] == 1 and key not in read and _plain(one.target, steady):
                b.report("S1244", one.span, name=one.target.name)
        read |= {id(e.symbol) for inner in statements([one]) for e in own_expressions(inner)
                 if isinstance(e, ast.Name)}  # fmt: skip


def _targets(s: ast.Stmt) -> Iterator[ast.Expr]:
    """What a statement may write: by assignment, output, VAR_IN_OUT, address, or call of an instance."""
    if isinstance(s, (ast.Assign, ast.For)):
        yield s.target if isinstance(s, ast.Assign) else s.variable
    for e in own_expressions(s):
        yield from handed_over(e)
        if isinstance(e, ast.Call) and isinstance(e.target, PouSymbol) and e.target.kind == "FUNCTION_BLOCK":
            yield e.callee


def _inside(s: ast.Stmt) -> list[ast.Stmt]:
    """All statements inside a statement, itself not included."""
    return [inner for part in bodies(s) for inner in statements(part)]


def _controls(s: ast.For | ast.While | ast.RepeatUntil) -> list[ast.Expr]:
    if isinstance(s, ast.For):
        return [e for e in (s.start, s.stop, s.step) if e is not None]
    return [s.condition]


def _plain(e: ast.Name, steady: frozenset[Storage]) -> bool:
    symbol = e.symbol
    return (
        isinstance(symbol, VarSymbol)
        and isinstance(symbol.type, _SIMPLE)
        and symbol.home in steady
        and symbol.section not in ("VAR_IN_OUT", "VAR_EXTERNAL")
        and (symbol.decl is None or symbol.decl.address is None)
    )


def _same_each_turn(e: ast.Expr, written: Counter[int], steady: frozenset[Storage]) -> bool:
    operators: set[int] = set()
    for part in expressions(e):
        if isinstance(part, ast.Call):
            if not _is_pure(part):
                return False
            operators.add(id(part.callee))
        elif isinstance(part, _UNSTEADY):
            return False
        elif isinstance(part, ast.Name) and isinstance(part.symbol, VarSymbol) and not part.is_constant:
            symbol = part.symbol
            passed_on = isinstance(symbol.type, Reference) or symbol.section in ("VAR_IN_OUT", "VAR_EXTERNAL")
            at_address = symbol.decl is not None and symbol.decl.address is not None
            if id(symbol) in written or passed_on or at_address or symbol.home not in steady:
                return False
        elif isinstance(part, (ast.Name, ast.Member)) and id(part) not in operators and not _is_known(part):
            return False
    return True


def _is_known(e: ast.Name | ast.Member) -> bool:
    """Whether a name is a variable, a constant or a bit, and not a property."""
    bit = isinstance(e, ast.Member) and e.bit is not None
    return bit or e.is_constant or isinstance(e.symbol, VarSymbol)


def _is_pure(e: ast.Call) -> bool:
    """Whether a call is an operator that depends on its operands only."""
    name = e.target.name if isinstance(e.target, BuiltinSymbol) else "__"
    return not name.startswith("__") and name not in _CHANGING
