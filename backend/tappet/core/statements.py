"""Statements of the textual languages."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tappet.core import assign, calls, guarded, ir, places, type_queries
from tappet.core.body import PLACES, VALUES, Body
from tappet.core.guard import Guard
from tappet.core.scalars import convert, require_scalar, scalar_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import carried_type
from tappet.lang.walk import statements as every_statement


def lower_statements(b: Body, statements: Sequence[ast.Stmt]) -> None:
    """Append the code of statements."""
    for statement in statements:
        if statement.label is not None:
            b.emit(ir.Label(statement.label.upper()))
            b.function.labels += 1
        handler = _STATEMENTS.get(statement.__class__)
        if handler is not None:
            if b.halt_points and not isinstance(statement, ast.HaltPoint):
                b.line(statement)
            else:
                b.statement(statement)
            handler(b, statement)


def body_of(b: Body, statements: Sequence[ast.Stmt]) -> list[ir.Stmt]:
    """The code of statements as a list of its own."""
    with b.block_of() as out:
        lower_statements(b, statements)
    return out


def _loop_body(b: Body, statements: Sequence[ast.Stmt]) -> list[ir.Stmt]:
    """The body of a loop, which EXIT and CONTINUE inside are of."""
    b.function.loops = True
    with guarded.loop(b):
        return body_of(b, statements)


def _assign(b: Body, s: ast.Assign) -> None:
    if s.op == "?=":
        type_queries.attempt(b, s.target, s.value)
    else:
        assign.assign(b, s.op, s.target, s.value)


def _call(b: Body, s: ast.CallStmt) -> None:
    calls.call_statement(b, s.call)


def _expression(b: Body, s: ast.ExprStmt) -> None:
    e = s.call or s.expr
    if isinstance(e, ast.AssignExpr):
        assign.assign(b, e.op, e.target, e.value)
    elif isinstance(e, ast.Call):
        calls.call_statement(b, e)
    # anything else has no effect


def _if(b: Body, s: ast.If) -> None:
    otherwise: list[ir.Stmt] = body_of(b, s.otherwise) if s.otherwise else []
    for number in range(len(s.branches) - 1, -1, -1):
        condition, body = s.branches[number]
        then = body_of(b, body)
        test = b.value(condition)
        if number == 0:
            b.emit(ir.If(test, then, otherwise))
        else:
            otherwise = [_place_of(condition), ir.If(test, then, otherwise)]


def _place_of(condition: ast.Expr) -> ir.Line:
    """Of a condition that is looked at apart from the statement that it belongs to."""
    span = condition.span
    return ir.Line(span[0] + 1, span[1], True, span[2] + 1)


def _case(b: Body, s: ast.Case) -> None:
    selector = b.value(s.selector)
    if not selector.type.integer:
        selector = convert(selector, ir.I64)
    cases = []
    for branch in s.branches:
        ranges = []
        for item in branch.selectors:
            low = item.low.constant
            high = item.high.constant if item.high is not None else low
            assert isinstance(low, int)
            assert isinstance(high, int)
            ranges.append((int(low), int(high)))
        cases.append(ir.SwitchCase(ranges, body_of(b, branch.body)))
    b.emit(ir.Switch(selector, cases, body_of(b, s.otherwise) if s.otherwise else []))


def _for(b: Body, s: ast.For) -> None:
    type_ = s.variable.type
    scalar = require_scalar(type_)
    if isinstance(type_, t.Subrange) and b.check_function(_range_check(scalar)) is not None:
        _checked_for(b, s, scalar)
        return
    counter = places.freeze(b, b.place(s.variable), b.out)
    b.touch(counter)
    start, stop = convert(b.value(s.start), scalar), convert(b.value(s.stop), scalar)
    step = _step(b, s, scalar)
    body = _loop_body(b, s.body)
    b.emit(ir.For(counter, scalar, start, stop, step, body, s.span[0] + 1))


def _step(b: Body, s: ast.For, counter: ir.Scalar) -> int | ir.Expr:
    """The step of a loop, which keeps its sign where the counter has none."""
    if s.step is None:
        return 1
    amount = b.value(s.step)
    if isinstance(amount, ir.Const):
        return int(amount.value)
    signed, unsigned = _WIDTHS[counter.bits]
    return convert(amount, signed if amount.type.signed else unsigned)


_WIDTHS = {8: (ir.I8, ir.U8), 16: (ir.I16, ir.U16), 32: (ir.I32, ir.U32), 64: (ir.I64, ir.U64)}
"""Signed and unsigned integers by their bits."""


def _range_check(scalar: ir.Scalar) -> str:
    width = "CheckLRange" if scalar.bits == 64 else "CheckRange"
    return width + ("Signed" if scalar.signed else "Unsigned")


def _checked_for(b: Body, s: ast.For, scalar: ir.Scalar) -> None:
    """A counter of a subrange type whose every assignment passes the check function (LTYP-125)."""
    counter = places.freeze(b, b.place(s.variable), b.out)
    b.touch(counter)
    read = ir.Load(scalar, counter)
    step = _step(b, s, scalar)
    amount = ir.Const(scalar, step) if isinstance(step, int) else convert(step, scalar)
    start = assign.range_checked(b, convert(b.value(s.start), scalar), s.variable.type)
    b.emit(ir.Store(counter, start))
    stop = convert(b.value(s.stop), scalar)
    if isinstance(step, int) or not step.type.signed:
        falling = isinstance(step, int) and step < 0
        test: ir.Expr = ir.Compare(ir.BOOL, "ge" if falling else "le", read, stop)
    else:
        bound = b.temp(scalar)
        rising = ir.Compare(ir.BOOL, "ge", step, ir.Const(step.type, 0))
        reached = ir.Load(scalar, ir.Place(bound))
        up, down = (ir.Compare(ir.BOOL, order, read, reached) for order in ("le", "ge"))
        test = ir.Sequence(ir.BOOL, [ir.Store(ir.Place(bound), stop)], ir.Select(ir.BOOL, rising, up, down))
    advance = assign.range_checked(b, ir.Binary(scalar, "add", read, amount), s.variable.type)
    first = b.temp(ir.BOOL, once=False)
    b.emit(ir.Store(ir.Place(first), ir.Const(ir.BOOL, 1)))
    running = ir.Load(ir.BOOL, ir.Place(first))
    head: list[ir.Stmt] = [
        ir.If(running, [ir.Store(ir.Place(first), ir.Const(ir.BOOL, 0))], [ir.Store(counter, advance)]),
        ir.If(test, [], [ir.Break()]),
    ]
    b.emit(ir.While(ir.Const(ir.BOOL, 1), [*head, *_loop_body(b, s.body)], s.span[0] + 1))


def _while(b: Body, s: ast.While) -> None:
    b.emit(ir.While(b.value(s.condition), _loop_body(b, s.body), s.span[0] + 1))


def _repeat(b: Body, s: ast.RepeatUntil) -> None:
    b.emit(ir.Repeat(_loop_body(b, s.body), b.value(s.condition), _place_of(s.condition)))


def _exit(b: Body, s: ast.Exit) -> None:
    guarded.leave_loop(b, ir.Break())


def _continue(b: Body, s: ast.Continue) -> None:
    guarded.leave_loop(b, ir.Continue())


def _return(b: Body, s: ast.Return) -> None:
    def leave() -> None:
        if b.leave is not None:
            b.leave()
        b.emit(ir.Return())

    guarded.leave(b, b.guards, leave)


def _hold(b: Body, s: ast.Hold) -> None:
    """Keep the accumulator of IL in a local of its own."""
    e = s.value
    type_ = e.type
    assert type_ is not None
    scalar = scalar_of(carried_type(e))
    if scalar is not None:
        place = ir.Place(b.temp(scalar, once=False))
        b.emit(ir.Store(place, b.value(e)))
    else:
        place = ir.Place(b.space(type_.size, type_.align))
        assign.copy_value(b, place, type_, e)
    b.held[s.slot] = place


def _when_declared(b: Body, s: ast.WhenDeclared) -> None:
    lower_statements(b, s.chosen)


def _halt_point(b: Body, s: ast.HaltPoint) -> None:
    """Its place is all there is of it."""


def _held_value(b: Body, e: ast.Held) -> ir.Expr:
    return ir.Load(require_scalar(carried_type(e)), b.held[e.slot])


def _held_place(b: Body, e: ast.Held) -> ir.Place:
    return b.held[e.slot]


def _jump(b: Body, s: ast.Jump) -> None:
    guarded.leave_by_jump(b, s.target.upper())


def _try(b: Body, s: ast.Try) -> None:
    def caught(_: Guard, fault: ir.Local) -> None:
        if s.exception is not None:
            code = convert(guarded.exception_code(fault), require_scalar(s.exception.type))
            assign.store_scalar(b, s.exception, code)
        lower_statements(b, s.handler)

    def attempt() -> None:
        if s.caught:
            guarded.guarded(b, labels_of(s.body), lambda: lower_statements(b, s.body), caught)
        else:
            lower_statements(b, s.body)

    if not s.final:
        attempt()
        return
    guarded.guarded(
        b,
        labels_of([*s.body, *s.handler]),
        attempt,
        lambda guard, fault: guarded.pass_on(b, guard, fault),
        lambda: lower_statements(b, s.final),
    )


def labels_of(body: Sequence[ast.Stmt]) -> frozenset[str]:
    """Labels of statements and of all inside them."""
    return frozenset(s.label.upper() for s in every_statement(body) if s.label is not None)


_STATEMENTS: dict[type, Callable[..., None]] = {
    ast.Assign: _assign,
    ast.CallStmt: _call,
    ast.ExprStmt: _expression,
    ast.If: _if,
    ast.Case: _case,
    ast.For: _for,
    ast.While: _while,
    ast.RepeatUntil: _repeat,
    ast.Exit: _exit,
    ast.Continue: _continue,
    ast.Return: _return,
    ast.Jump: _jump,
    ast.Hold: _hold,
    ast.HaltPoint: _halt_point,
    ast.WhenDeclared: _when_declared,
    ast.Try: _try,
}
VALUES[ast.Held] = _held_value
PLACES[ast.Held] = _held_place
