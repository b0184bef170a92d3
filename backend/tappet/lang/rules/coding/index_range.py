"""The indices of a loop stay inside its array, and do not stop one short of its ends.

What an index can be is known from constant bounds of the loop, subranges, MOD, AND, LIMIT; behind a condition
inside the loop (IF, AND_THEN, SEL) nothing is said of the loop variable, as the condition may keep the index
inside. W1125 reports the plain loop variable.

Source: spec LTYP-150; coding guidelines of PLCopen, L10; CODESYS Static Analysis SA0172, SA0180.

Passes:
    @static
    VAR i : INT; nPlace : INT(0..9); aA, aB : ARRAY[0..9] OF INT; END_VAR
    FOR i := 0 TO 9 DO aA[i] := aB[9 - i]; END_FOR
    FOR i := 1 TO 9 DO aA[i - 1] := aA[i]; END_FOR
    aA[nPlace] := aB[i MOD 10];
Fails:
    @static
    VAR i : INT; aA : ARRAY[0..9] OF INT; END_VAR
    FOR i := 0 TO 9 DO
        aA[i] := aA[i + 1];        (* S1246: i + 1 becomes 10 *)
    END_FOR
Fails:
    @static
    VAR nPlace : INT(1..10); aA : ARRAY[0..9] OF INT; END_VAR
    aA[nPlace] := 2;               (* S1246: 10 is no index *)
Fails:
    @static
    VAR i : INT; aA : ARRAY[0..9] OF INT; END_VAR
    FOR i := 1 TO 9 DO
        aA[i] := 0;                (* S1247: aA[0] is left out *)
    END_FOR
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.for_loops import iterations
from tappet.lang.dataflow.intervals import Interval, interval
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Array
from tappet.lang.walk import bodies, expressions, own_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1246", "S1247")
_LEAVING = (ast.Exit, ast.Continue, ast.Return, ast.Jump)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the indices of a body."""
    if b.pou is not None and b.pou.pou is not None:
        _body(b, chosen, b.pou.pou.body, {})


def _body(b: Body, chosen: frozenset[str], body: list[ast.Stmt], known: Mapping[int, Interval]) -> None:
    for s in body:
        if "S1246" in chosen:
            found = list(own_expressions(s))
            guarded = {id(inner) for e in found for inner in expressions(*_guarded(e))}
            for e in found:
                if isinstance(e, ast.Index) and isinstance(e.base.type, Array):
                    _check(b, e, e.base.type, {} if id(e) in guarded else known)
        if isinstance(s, ast.For):
            values = _values(s)
            if values is not None and "S1247" in chosen:
                _left_out(b, s, values)
            leaves = any(isinstance(inner, _LEAVING) for inner in statements(s.body))
            inside = {} if leaves or values is None else {**known, id(_counter(s)): values}
            _body(b, chosen, s.body, inside)
        else:
            for part in bodies(s):
                _body(b, chosen, part, {})


def _guarded(e: ast.Expr) -> list[ast.Expr]:
    """What is evaluated only if the rest of an expression wants it: that may ask if the index is inside."""
    if isinstance(e, ast.Binary) and e.op in ("AND_THEN", "OR_ELSE"):
        return [e.right]
    if isinstance(e, ast.Call) and isinstance(e.target, BuiltinSymbol) and e.target.name in ("SEL", "MUX"):
        return [arg.value for arg in e.args[1:] if arg.value is not None]
    return []


def _counter(s: ast.For) -> object:
    return s.variable.symbol if isinstance(s.variable, ast.Name) else None


def _values(s: ast.For) -> Interval | None:
    """First and last value of the counter, smaller one first; None when they are not constant."""
    found = iterations(s)
    if found is None or not found.any or _counter(s) is None or _is_written(s):
        return None
    return found.interval


def _is_written(s: ast.For) -> bool:
    """Whether the body assigns the counter itself."""
    counter = _counter(s)
    targets = (inner.target for inner in statements(s.body) if isinstance(inner, ast.Assign))
    return any(isinstance(target, ast.Name) and target.symbol is counter for target in targets)


def _check(b: Body, e: ast.Index, array: Array, known: Mapping[int, Interval]) -> None:
    for index, (first, last) in zip(e.indices, array.bounds, strict=False):
        reported_elsewhere = isinstance(index, ast.Name) and id(index.symbol) in known
        found = None if index.is_constant or reported_elsewhere else interval(index, known)
        if found is not None and (found[0] < first or found[1] > last):
            b.report("S1246", index.span, low=found[0], high=found[1], first=first, last=last)


def _left_out(b: Body, s: ast.For, values: Interval) -> None:
    """Arrays that the loop indexes by its counter only, and all but their first or last element."""
    if s.step is not None and s.step.constant not in (1, -1):
        return
    if any(isinstance(inner, _LEAVING) for inner in statements(s.body)):
        return
    uses: dict[int, list[ast.Index]] = {}
    for inner in statements(s.body):
        for e in own_expressions(inner):
            if isinstance(e, ast.Index) and isinstance(e.base, (ast.Name, ast.Member)):
                uses.setdefault(id(e.base.symbol), []).append(e)
    counter = _counter(s)
    for found in uses.values():
        array = found[0].base.type
        plain = all(isinstance(e.indices[0], ast.Name) and e.indices[0].symbol is counter for e in found)
        if plain and isinstance(array, Array) and len(array.bounds) == 1:
            first, last = array.bounds[0]
            missed = (values[0] - first, last - values[1])
            if missed != (0, 0) and all(0 <= count <= 1 for count in missed):
                b.report("S1247", found[0].span, low=values[0], high=values[1], first=first, last=last)
