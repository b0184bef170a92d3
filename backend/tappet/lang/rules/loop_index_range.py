"""The index of a loop stays inside the array it indexes.

Elements below a condition inside the loop are left out: the condition may keep the index inside.

Source: spec LTYP-150.

Passes:
    VAR i : INT; a : ARRAY[1..10] OF INT; END_VAR
    FOR i := 1 TO 10 DO a[i] := 0; END_FOR
Passes:
    VAR u : USINT; a : ARRAY[1..10] OF INT; END_VAR
    FOR u := 10 TO 0 BY -3 DO a[u] := 0; END_FOR   (* 10, 7, 4, 1 *)
Fails:
    VAR i : INT; a : ARRAY[1..10] OF INT; END_VAR
    FOR i := 0 TO 10 DO a[i] := 0; END_FOR   (* W1125: 0 is no index of a *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.for_loops import iterations
from tappet.lang.types import Array
from tappet.lang.walk import own_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1125",)
NODES = (ast.For,)
_GUARDS = (ast.If, ast.Case, ast.Try)


def check_statement(b: Body, s: ast.For) -> None:
    """Reports constant bounds of a loop that lie outside the bounds of an array."""
    variable, found = s.variable, iterations(s)
    if not isinstance(variable, ast.Name) or found is None or not found.any:
        return
    low, high = found.interval
    for inner in s.body:
        if isinstance(inner, (*_GUARDS, ast.Exit, ast.Continue, ast.Return)):
            return
        for e in own_expressions(inner):
            if isinstance(e, ast.Index) and isinstance(e.base.type, Array):
                _check(b, e, e.base.type, variable, low, high)


def _check(b: Body, e: ast.Index, array: Array, variable: ast.Name, low: int, high: int) -> None:
    for index, (first, last) in zip(e.indices, array.bounds, strict=False):
        if isinstance(index, ast.Name) and index.symbol is variable.symbol and (low < first or high > last):
            b.report("W1125", index.span, name=variable.name, low=low, high=high, first=first, last=last)
