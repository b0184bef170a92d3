"""Steps that are active too long: SFCError and its companions (LSFC-24, LSFC-62..LSFC-71)."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.sfc.build import both, declared, name, negated, number, put, text, when
from tappet.lang.sfc.chart import Step
from tappet.lang.source import Span

if TYPE_CHECKING:
    from tappet.lang.sfc.translate import Context

MAX_ENTRIES = 16
"""Entries of SFCErrorAnalyzationTable (LSFC-71)."""
_TABLE = "SFCErrorAnalyzationTable"


def checks(c: Context, chart: str) -> list[ast.Stmt]:
    """The time checks of all steps with a maximum time; nothing where SFCError is not declared."""
    timed = [step for step in c.chart.steps if step.maximum is not None]
    if not timed:
        return []
    limit = f"{chart}.Limit"
    body = [
        put(limit, negated(name("SFCError")), c.head),
        declared(
            ["SFCEnableLimit"],
            [when(negated(name("SFCEnableLimit")), [put(limit, False, c.head)], c.head)],
            c.head,
        ),
    ]
    body += [_check(c, step, chart, limit) for step in timed]
    return [declared(["SFCError"], body, c.head)]


def _check(c: Context, step: Step, chart: str, limit: str) -> ast.Stmt:
    assert step.maximum is not None
    span = step.name_span
    late = ast.Binary(
        op=">", left=name(f"{step.name}.t"), right=copy.deepcopy(step.maximum), span=step.maximum.span
    )
    body = [
        put("SFCError", True, span),
        put(limit, False, span),
        declared(["SFCErrorStep"], [put("SFCErrorStep", text(step.name), span)], span),
        declared(["SFCErrorPOU"], [put("SFCErrorPOU", text(c.pou), span)], span),
        declared(["SFCErrorAnalyzation"], _listed(c, step), span),
        declared([_TABLE], _table(c, step, chart), span),
    ]
    return when(both(name(f"{step.name}.x"), name(limit), late), body, span)


def _blockers(c: Context, step: Step) -> list[tuple[ast.Expr, bool]]:
    """Operands of the transitions behind a step, and the value with which each keeps the step active."""
    found: list[tuple[ast.Expr, bool]] = []
    for transition in c.chart.in_order():
        if any(source.upper() == step.name.upper() for source, _ in transition.sources):
            _operands(transition.condition, False, found)
    return found


def _operands(e: ast.Expr, blocking: bool, found: list[tuple[ast.Expr, bool]]) -> None:
    if isinstance(e, ast.Binary) and e.op in ("AND", "OR", "AND_THEN", "OR_ELSE"):
        _operands(e.left, blocking, found)
        _operands(e.right, blocking, found)
    elif isinstance(e, ast.Unary) and e.op == "NOT":
        _operands(e.operand, not blocking, found)
    else:
        found.append((e, blocking))


def _blocks(e: ast.Expr, blocking: bool) -> ast.Expr:
    value = copy.deepcopy(e)
    return value if blocking else negated(value)


def _listed(c: Context, step: Step) -> list[ast.Stmt]:
    """LSFC-70: the operands in one text, separated by commas."""
    target = "SFCErrorAnalyzation"
    found = [put(target, text(""), step.name_span)]
    for e, blocking in _blockers(c, step):
        found.append(when(_blocks(e, blocking), _append(target, c.slice(e.span), e.span), e.span))
    return found


def _append(target: str, shown: str, span: Span) -> list[ast.Stmt]:
    """Appends without a library: the text is put behind the last character."""
    empty = ast.Binary(op="=", left=name(target), right=text(""))
    first = put(target, text(shown), span)
    joined = ast.Call(
        callee=name("_SFCAppend"),
        args=[ast.Argument(name=None, value=name(target)), ast.Argument(name=None, value=text(shown))],
    )
    return [ast.If(branches=[(empty, [first])], otherwise=[put(target, joined, span)], span=span)]


def _table(c: Context, step: Step, chart: str) -> list[ast.Stmt]:
    """LSFC-71: one entry for each operand that keeps the step active."""
    span = step.name_span
    count = f"{chart}.Entries"
    found = [put(count, number(0), span)]
    for e, blocking in _blockers(c, step):
        entry = ast.Index(base=name(_TABLE), indices=[name(count)])
        more = ast.Binary(op="+", left=name(count), right=number(1))
        address = e.name if isinstance(e, ast.Name) and e.name.startswith("%") else ""
        write: list[ast.Stmt] = [
            _set(entry, "name", text(c.slice(e.span)), e.span),
            _set(entry, "address", text(address), e.span),
            _set(entry, "value", copy.deepcopy(e), e.span),
            put(count, more, e.span),
        ]
        fits = ast.Binary(op="<", left=name(count), right=number(MAX_ENTRIES))
        found.append(when(both(fits, _blocks(e, blocking)), write, e.span))
    return found


def _set(entry: ast.Index, member: str, value: ast.Expr, span: Span) -> ast.Stmt:
    target = ast.Member(base=copy.deepcopy(entry), name=member)
    return ast.Assign(op=":=", target=target, value=value, span=span)
