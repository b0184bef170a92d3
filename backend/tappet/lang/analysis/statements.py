"""Statements: one function per node class, found by `STATEMENTS` (spec language_st.md section 2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, folding
from tappet.lang.analysis.adaptation import require, retype
from tappet.lang.analysis.attempts import assignment_attempt
from tappet.lang.analysis.calls import bind_reference
from tappet.lang.analysis.conditions import condition
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import EXPRESSIONS, Handler, evaluate, place_or_name, text_of, value
from tappet.lang.analysis.places import is_input, note_output, writable
from tappet.lang.analysis.result import carried_type
from tappet.lang.rules import ASSIGN_RULES, LIST_RULES, STATEMENT_RULES
from tappet.lang.source import NOWHERE
from tappet.lang.symbols import PouSymbol, PropertySymbol, VarSymbol
from tappet.lang.types import Elementary, Kind, Type

STATEMENTS: dict[type, Callable[[Body, Any], None]] = {}
_AGGREGATES = (ast.ArrayInit, ast.StructInit)
_TARGETS = frozenset({ast.Name, ast.Member, ast.Index, ast.Deref, ast.Call})


def statements(b: Body, body: list[ast.Stmt]) -> None:
    """Resolves a list of statements."""
    table = STATEMENTS
    rules = STATEMENT_RULES
    for s in body:
        kind = s.__class__
        if s.label is not None:
            _label(b, s)
        handler = table.get(kind)
        if handler is not None:
            handler(b, s)
        checks = rules.get(kind)
        if checks is not None:
            for check in checks:
                check(b, s)
        if kind is ast.Assign:
            assert isinstance(s, ast.Assign)
            checks = ASSIGN_RULES.get(s.value.__class__)
            if checks is not None:
                for check in checks:
                    check(b, s)
    for check in LIST_RULES:
        check(b, body)


def _label(b: Body, s: ast.Stmt) -> None:
    assert s.label is not None
    key = s.label.upper()
    if key in b.labels:
        b.report("E0803", s.span, name=s.label)
    b.labels[key] = s.span


def _assign(b: Body, s: ast.Assign | ast.AssignExpr) -> None:
    target, content = s.target, s.value
    if s.op != ":=":
        _special_assign(b, s)
        return
    type_ = place_or_name(b, target)
    b.assigned = content
    if content.__class__ in _AGGREGATES:
        b.report("E0333", content.span, what=_aggregate_name(content))
    elif value(b, content) is not None and type_ is not None and target.__class__ in _TARGETS:
        require(b, content, type_)
    b.assigned = None
    if target.__class__ is ast.Name and target.symbol.__class__ is VarSymbol:
        symbol = target.symbol
        if "CONSTANT" not in symbol.flags and not is_input(symbol):
            b.session.written.add(id(symbol))
            if symbol.area is not None:
                note_output(b, symbol, target)
            if b.loop_variables and symbol in b.loop_variables:
                b.loop_writes.append((symbol, target.span))
            return
    writable(b, target)


def _aggregate_name(e: ast.Expr) -> str:
    return "An array initialiser" if isinstance(e, ast.ArrayInit) else "A structure initialiser"


def _special_assign(b: Body, s: ast.Assign | ast.AssignExpr) -> None:
    """`REF=`, `S=`, `R=`, `?=`."""
    target, content = s.target, s.value
    if s.op == "?=":
        assignment_attempt(b, target, content)
        return
    type_ = value(b, target)
    if s.op == "REF=":
        own = value(b, content)
        symbol = getattr(target, "symbol", None)
        declared = symbol.type if isinstance(symbol, (VarSymbol, PropertySymbol)) else None
        if type_ is None:
            return
        if not isinstance(declared, t.Reference):
            b.report("E0320", target.span, name=text_of(target), type=type_)
        elif own is not None:
            writable(b, target)
            bind_reference(b, content, declared)
        return
    own = value(b, content)
    if type_ is None or own is None:
        return
    for side, found in ((target, type_), (content, own)):
        if side.untyped:
            retype(side, t.BOOL)
            found = side.type or found
        if t.value_type(found) is not t.BOOL:
            b.report("E0322", side.span, op=s.op, type=found)
            return
    writable(b, target)


def _assign_expr(b: Body, e: ast.AssignExpr) -> None:
    e.type = e.constant = None
    e.is_constant = e.untyped = False
    outer = b.assigned
    _assign(b, e)
    b.assigned = outer
    e.type = e.target.type


def _call_stmt(b: Body, s: ast.CallStmt) -> None:
    handler = EXPRESSIONS.get(s.call.__class__)
    if handler is not None:
        handler(b, s.call)


def _expr_stmt(b: Body, s: ast.ExprStmt) -> None:
    e = s.expr
    type_ = evaluate(b, e)
    s.call = None
    if isinstance(e, (ast.Name, ast.Member, ast.Index)):
        symbol = getattr(e, "symbol", None)
        named = isinstance(symbol, PouSymbol) and symbol.kind in ("ACTION", "PROGRAM")
        if named or isinstance(type_, t.FunctionBlock):
            s.call = ast.Call(span=e.span, callee=e, args=[])
            EXPRESSIONS[ast.Call](b, s.call)
            b.report("W1144", e.span, name=text_of(e))


def _if(b: Body, s: ast.If) -> None:
    for test, body in s.branches:
        condition(b, test)
        statements(b, body)
    if s.otherwise is not None:
        statements(b, s.otherwise)


def _while(b: Body, s: ast.While) -> None:
    condition(b, s.condition)
    b.loops += 1
    statements(b, s.body)
    b.loops -= 1


def _repeat(b: Body, s: ast.RepeatUntil) -> None:
    b.loops += 1
    statements(b, s.body)
    b.loops -= 1
    condition(b, s.condition)


def _for(b: Body, s: ast.For) -> None:
    type_ = value(b, s.variable)
    base = t.value_type(type_) if type_ is not None else None
    for bound in (s.start, s.stop):
        if value(b, bound) is not None and isinstance(base, Elementary) and base.is_integer:
            _bound(b, bound, type_, base)
    if (
        s.step is not None
        and value(b, s.step) is not None
        and isinstance(base, Elementary)
        and base.is_integer
    ):
        _step(b, s.step, base)
    if type_ is not None:
        if not isinstance(base, Elementary) or not base.is_integer:
            b.report("E0807", s.variable.span, type=type_)
        else:
            writable(b, s.variable)
    symbol = getattr(s.variable, "symbol", None)
    b.loops += 1
    if symbol is not None:
        b.loop_variables.append(symbol)
    statements(b, s.body)
    if symbol is not None:
        b.loop_variables.pop()
    b.loops -= 1


def _bound(b: Body, bound: ast.Expr, type_: Type | None, base: Elementary) -> None:
    """A bound of a loop must fit its variable; other integers of a wider type convert with the usual
    message."""
    assert type_ is not None
    if bound.untyped:
        if retype(bound, base):
            return
        b.report("E0808", bound.span, source=bound.type, target=type_)
        return
    require(b, bound, base)


def _step(b: Body, step: ast.Expr, base: Elementary) -> None:
    """The step is added to the variable and keeps its own sign: an unsigned variable may count down."""
    number = step.constant if step.is_constant else None
    if number == 0:
        b.report("E0809", step.span)
        return
    if step.untyped:
        if not _reaches(number, base) or not retype(step, _type_of_step(number, base)):
            b.report("E0808", step.span, source=step.type, target=base)
        return
    own = t.value_type(step.type) if step.type is not None else None
    if isinstance(own, Elementary) and own.kind is Kind.SIGNED:
        if not _reaches(number, base):
            require(b, step, conversion.SIGNED[base.size])
    else:
        require(b, step, base)


def _reaches(number: object, base: Elementary) -> bool:
    """Whether a constant step leads from one value of the variable to another one."""
    if not isinstance(number, int):
        return False
    return folding.fits(abs(number) if base.kind is not Kind.SIGNED else number, base)


def _type_of_step(number: object, base: Elementary) -> Elementary:
    """Type of an untyped step: that of the variable, or a signed one for a step down."""
    found = conversion.smallest_integer(number) if isinstance(number, int) and number < 0 else None
    return base if found is None or base.kind is Kind.SIGNED else found


def _case(b: Body, s: ast.Case) -> None:
    type_ = value(b, s.selector)
    base = t.value_type(type_) if type_ is not None else None
    if type_ is not None and (not isinstance(base, Elementary) or not base.is_integer):
        b.report("E0806", s.selector.span, type=type_)
        type_ = base = None
    if s.selector.untyped and isinstance(base, Elementary):
        retype(s.selector, base)
    ranges: list[tuple[int, int, ast.CaseRange]] = []
    for branch in s.branches:
        for selector in branch.selectors:
            low = _case_label(b, selector.low, type_)
            high = low if selector.high is None else _case_label(b, selector.high, type_)
            if low is None or high is None:
                continue
            if low > high:
                b.report("E0810", selector.span, low=low, high=high)
            else:
                ranges.append((low, high, selector))
        statements(b, branch.body)
    if s.otherwise is not None:
        statements(b, s.otherwise)
    if len(ranges) > 1:
        _check_overlap(b, ranges)


def _case_label(b: Body, e: ast.Expr, type_: Type | None) -> int | None:
    if value(b, e) is None:
        return None
    if not e.is_constant:
        b.report("E0805", e.span)
        return None
    if type_ is not None and not require(b, e, type_):
        return None
    number = e.constant
    return int(number) if isinstance(number, int) else None


def _check_overlap(b: Body, ranges: list[tuple[int, int, ast.CaseRange]]) -> None:
    order = {id(entry[2]): number for number, entry in enumerate(ranges)}
    reach: tuple[int, int, ast.CaseRange] | None = None
    for entry in sorted(ranges, key=lambda r: (r[0], r[1])):
        if reach is not None and entry[0] <= reach[1]:
            later, earlier = (entry, reach) if order[id(entry[2])] > order[id(reach[2])] else (reach, entry)
            if later[0] == later[1]:
                b.report("E0811", later[2].span, value=later[0])
            else:
                b.report(
                    "E0804",
                    later[2].span,
                    range=f"{later[0]} .. {later[1]}",
                    other=f"{earlier[0]} .. {earlier[1]}",
                )
        if reach is None or entry[1] > reach[1]:
            reach = entry


def _exit(b: Body, s: ast.Exit | ast.Continue) -> None:
    if not b.loops:
        b.report("E0801", s.span, name="EXIT" if isinstance(s, ast.Exit) else "CONTINUE")


def _hold(b: Body, s: ast.Hold) -> None:
    """The accumulator of IL is computed; constants stay what they are, so that they adapt to each use."""
    b.held[s.slot] = s.value
    value(b, s.value)


def _when_declared(b: Body, s: ast.WhenDeclared) -> None:
    found = [b.lookup(entry) for entry in s.names]
    s.chosen = s.body if all(isinstance(symbol, VarSymbol) for symbol in found) else s.otherwise
    if s.step is not None and None in found:
        if s.step:
            b.report("E0826", s.span, step=s.step, name=s.names[0], hint=b.suggest(s.names[0]))
        s.chosen = []
    elif s.role is not None and isinstance(found[0], VarSymbol):
        b.report("E0830", s.span, step=s.step, name=s.names[0], role=s.role)
        s.chosen = []
    if s.described is not None:
        _describe(b, s.described)
    messages = b.session.diagnostics
    first = len(messages)
    statements(b, s.chosen)
    for number, message in enumerate(messages[first:], first):
        if message.span == NOWHERE:
            messages[number] = replace(message, span=s.span)


def _describe(b: Body, s: ast.Described) -> None:
    """Address and comment of a variable, where the expression names one."""
    value(b, s.of)
    symbol = getattr(s.of, "symbol", None)
    if not isinstance(symbol, VarSymbol):
        return
    decl = symbol.decl
    address = symbol.name if decl is None and symbol.area is not None else decl and decl.address
    for literal, text in ((s.address, address), (s.comment, (decl and decl.comment) or symbol.comment)):
        literal.value = (text or "").encode("latin-1", "replace")
        literal.text = f"'{text or ''}'"


def _held(b: Body, e: ast.Held) -> None:
    kept = b.held.get(e.slot)
    e.type = e.carried = e.constant = None
    e.is_constant = e.untyped = False
    if kept is None or kept.type is None:
        return
    e.type, e.carried = kept.type, carried_type(kept)
    e.constant, e.is_constant, e.untyped = kept.constant, kept.is_constant, kept.untyped


def _jump(b: Body, s: ast.Jump) -> None:
    b.jumps.append(s)


_EXCEPTION_CODES = (t.DWORD, t.UDINT)
"""What the value of the variable of a __CATCH may be; UDINT is that of __SYSTEM.ExceptionCode."""


def _try(b: Body, s: ast.Try) -> None:
    statements(b, s.body)
    if s.exception is not None:
        value(b, s.exception)
        given = s.exception.type
        if writable(b, s.exception) and given is not None and t.value_type(given) not in _EXCEPTION_CODES:
            b.report("E0831", s.exception.span, given=str(given))
    if not s.caught and not s.final:
        b.report("E0832", s.span)
    statements(b, s.handler)
    statements(b, s.final)


def _blocks(s: ast.Stmt) -> list[list[ast.Stmt]]:
    """The lists of statements inside a statement."""
    found: list[list[ast.Stmt]] = []
    if isinstance(s, ast.If):
        found = [body for _, body in s.branches]
    elif isinstance(s, ast.Case):
        found = [branch.body for branch in s.branches]
    elif isinstance(s, (ast.For, ast.While, ast.RepeatUntil)):
        found = [s.body]
    elif isinstance(s, ast.Try):
        found = [s.body, s.handler, s.final]
    if isinstance(s, (ast.If, ast.Case)) and s.otherwise is not None:
        found.append(s.otherwise)
    return found


def _check_ways(b: Body, body: list[ast.Stmt], around: frozenset[str]) -> None:
    """LST-35: a jump may leave loops and branches but not enter one. `around`: labels it may go to."""
    seen = around | {s.label.upper() for s in body if s.label is not None}
    for s in body:
        if isinstance(s, ast.Jump) and s.target.upper() in b.labels and s.target.upper() not in seen:
            hint = f"'{s.target}' is inside a loop or a branch; a jump can only leave these."
            b.report("E0802", s.span, name=s.target, hint=hint)
        for inner in _blocks(s):
            _check_ways(b, inner, seen)


def check_jumps(b: Body) -> None:
    """Reports jumps to labels that the body does not have; call it after the whole body."""
    if b.jumps and b.labels and b.pou is not None and b.pou.pou is not None:
        _check_ways(b, b.pou.pou.body, frozenset())
    targets = set()
    for jump in b.jumps:
        key = jump.target.upper()
        targets.add(key)
        if key not in b.labels:
            known = ", ".join(sorted(b.labels))
            b.report("E0802", jump.span, name=jump.target, hint=f"Labels here are: {known}." if known else "")
    for key, span in b.labels.items():
        if key not in targets:
            b.report("W1115", span, name=key)


HANDLERS: dict[type, Handler] = {ast.AssignExpr: _assign_expr, ast.Held: _held}
"""Expressions that work like statements."""
STATEMENTS.update(
    {
        ast.Assign: _assign,
        ast.CallStmt: _call_stmt,
        ast.ExprStmt: _expr_stmt,
        ast.If: _if,
        ast.While: _while,
        ast.RepeatUntil: _repeat,
        ast.For: _for,
        ast.Case: _case,
        ast.Exit: _exit,
        ast.Continue: _exit,
        ast.Jump: _jump,
        ast.Hold: _hold,
        ast.WhenDeclared: _when_declared,
        ast.Try: _try,
    }
)
