"""Expressions are simple, and numbers in them have names.

Source: coding guidelines of PLCopen, CP6 (no magic numbers), CP8, CP9 (comparison with TRUE and FALSE),
CP21 (pointers), CP25 (type conversions are explicit), CP28 (time and physical units).

Passes:
    @static
    VAR CONSTANT MAX_SPEED : INT := 1500; END_VAR
    VAR bFast : BOOL; nSpeed : INT; END_VAR
    bFast := nSpeed > MAX_SPEED;
    bFast := (bFast AND (nSpeed > 0)) OR NOT bFast;
Fails:
    @static
    VAR bFast : BOOL; nSpeed : INT; END_VAR
    bFast := nSpeed > 1437;        (* S1211: 1437 has no name *)
Fails:
    @static
    VAR bFast, bSlow : BOOL; END_VAR
    bSlow := bFast = FALSE;        (* S1212: NOT bFast *)
Fails:
    @static
    VAR n1, n2, n3 : INT; END_VAR
    n1 := n1 + n2 - n3 * n1 + n2 - n3 * n1 + n2 - n3 * n1 + n2;   (* S1213: too many operators *)
Fails:
    @static
    VAR nA : INT; pA : POINTER TO INT; END_VAR
    pA := ADR(nA) + 2;             (* S1214: arithmetic with a pointer *)
    nA := pA^;                     (* S1215: not compared with 0 *)
Fails:
    @static
    VAR bA, bB : BOOL; nB : INT; nC : DINT; END_VAR
    bB := bA AND nB > 3 OR bA;     (* S1216: AND and OR without parentheses *)
    nC := nB;                      (* S1217: converted without saying so *)
Fails:
    @static
    VAR nA, nB : INT; END_VAR
    nA := nB := 2;                 (* S1218: two assignments in one *)
Fails:
    @static
    VAR bA : BOOL; END_VAR
    bA := %IX3.1;                  (* S1219: an address instead of a name *)
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.types import Elementary, Pointer
from tappet.lang.walk import own_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1211", "S1212", "S1213", "S1214", "S1215", "S1216", "S1217", "S1218", "S1219")
_NAMELESS = frozenset({0, 1, -1, 2, 10, 100, 1000})
"""Numbers that need no name."""


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports the expressions of a body."""
    if b.pou is None or b.pou.pou is None:
        return
    compared: set[int] = set()
    limit = b.session.options.static.settings.operators
    for s in statements(b.pou.pou.body):
        operators = 0
        for e in own_expressions(s):
            operators += isinstance(e, ast.Binary)
            for code, fields in _faults(e, s, compared):
                if code in chosen:
                    b.report(code, e.span, **fields)
        if operators > limit and "S1213" in chosen:
            b.report("S1213", s.span, count=operators, limit=limit)
        if isinstance(s, ast.Assign) and "S1217" in chosen:
            _conversion(b, s)


def _faults(e: ast.Expr, s: ast.Stmt, compared: set[int]) -> Iterator[tuple[str, dict[str, object]]]:
    if isinstance(e, ast.Literal):
        if e.kind in ("int", "real") and e.value not in _NAMELESS and not isinstance(s, (ast.Case, ast.For)):
            yield "S1211", {"value": e.text}
    elif isinstance(e, ast.Binary):
        for side in (e.left, e.right):
            if e.op in ("=", "<>") and isinstance(side, ast.Literal) and side.kind == "bool":
                yield "S1212", {"value": side.text}
            if e.op in _COMPARING and isinstance(side, ast.Name) and isinstance(side.type, Pointer):
                compared.add(id(side.symbol))
            inner = {"AND": "OR", "OR": "AND"}.get(e.op)
            if isinstance(side, ast.Binary) and side.op == inner and _bare(e, side):
                yield "S1216", {"inner": side.op, "outer": e.op}
        if e.op in ("+", "-") and isinstance(e.type, Pointer):
            yield "S1214", {}
    elif isinstance(e, ast.Deref) and isinstance(e.base, ast.Name) and id(e.base.symbol) not in compared:
        yield "S1215", {"name": e.base.name}
    elif isinstance(e, ast.AssignExpr):
        yield "S1218", {}
    elif isinstance(e, ast.Name) and e.name.startswith("%"):
        yield "S1219", {"address": e.name}


_COMPARING = frozenset({"=", "<>"})


def _bare(outer: ast.Binary, inner: ast.Binary) -> bool:
    """Whether no parenthesis stands around the inner operation; its span shows it."""
    if inner is outer.left:
        return outer.span[:2] == inner.span[:2]
    return outer.span[2:] == inner.span[2:]


def _conversion(b: Body, s: ast.Assign) -> None:
    target, source = s.target.type, s.value.type
    if s.value.is_constant or not isinstance(target, Elementary) or not isinstance(source, Elementary):
        return
    if source.name != target.name:
        b.report("S1217", s.value.span, source=source, target=target)
