"""Steps that are active too long: SFCError and its companions (LSFC-24, LSFC-62..LSFC-71)."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.languages.sfc.build import both, declared, literal, name, negated, number, put, when
from tappet.lang.languages.sfc.chart import Step
from tappet.lang.source import Span

if TYPE_CHECKING:
    from tappet.lang.languages.sfc.context import Context

_TABLE = "SFCErrorAnalyzationTable"


def checks(c: Context) -> list[ast.Stmt]:
    """The time checks of all steps with a maximum time; nothing where SFCError is not declared."""
    timed = [step for step in c.chart.steps if step.maximum is not None]
    if not timed:
        return []
    limit = f"{c.kept}.Limit"
    body = [
        put(limit, negated(name("SFCError")), c.head),
        declared(
            ["SFCEnableLimit"],
            [when(negated(name("SFCEnableLimit")), [put(limit, False, c.head)], c.head)],
            c.head,
        ),
    ]
    body += [_check(c, step, limit) for step in timed]
    return [declared(["SFCError"], body, c.head)]


def _check(c: Context, step: Step, limit: str) -> ast.Stmt:
    assert step.maximum is not None
    span = step.name_span
    late = ast.Binary(
        op=">", left=name(f"{step.name}.t"), right=copy.deepcopy(step.maximum), span=step.maximum.span
    )
    body = [
        put("SFCError", True, span),
        put(limit, False, span),
        declared(["SFCErrorStep"], [put("SFCErrorStep", literal(step.name), span)], span),
        declared(["SFCErrorPOU"], [put("SFCErrorPOU", literal(c.pou), span)], span),
        declared(["SFCErrorAnalyzation"], _listed(c, step), span),
        declared([_TABLE], _table(c, step), span),
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
    found = [put(target, literal(""), step.name_span)]
    for e, blocking in _blockers(c, step):
        found.append(when(_blocks(e, blocking), _append(target, c.lowering.text_of(e.span), e.span), e.span))
    return found


def _append(target: str, shown: str, span: Span) -> list[ast.Stmt]:
    """Appends without a library: the text is put behind the last character."""
    empty = ast.Binary(op="=", left=name(target), right=literal(""))
    first = put(target, literal(shown), span)
    joined = ast.Call(
        callee=name("_SFCAppend"),
        args=[ast.Argument(name=None, value=name(target)), ast.Argument(name=None, value=literal(shown))],
    )
    return [ast.If(branches=[(empty, [first])], otherwise=[put(target, joined, span)], span=span)]


def clear_table(c: Context) -> ast.Stmt:
    """Empties the table, where there is one."""
    cleared = ast.Call(callee=name("_SFCClear"), args=[ast.Argument(name=None, value=name(_TABLE))])
    return declared([_TABLE], [ast.CallStmt(call=cleared, span=c.head)], c.head)


def _table(c: Context, step: Step) -> list[ast.Stmt]:
    """LSFC-71: one entry for each operand that keeps the step active."""
    count = f"{c.kept}.Entries"
    found = [clear_table(c), put(count, number(0), step.name_span)]
    for e, blocking in _blockers(c, step):
        address, comment = literal(""), literal("")
        written = literal(c.lowering.text_of(e.span))
        values = [name(_TABLE), name(count), written, copy.deepcopy(e), address, comment]
        enter = ast.Call(callee=name("_SFCEnter"), args=[ast.Argument(name=None, value=v) for v in values])
        described = ast.WhenDeclared(
            names=[],
            body=[ast.CallStmt(call=enter, span=e.span)],
            otherwise=[],
            span=e.span,
            described=ast.Described(of=copy.deepcopy(e), address=address, comment=comment),
        )
        found.append(when(_blocks(e, blocking), [described], e.span))
    return found
