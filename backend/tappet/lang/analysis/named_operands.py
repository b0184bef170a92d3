"""Formal names of operators, `ADD(IN1 := a, IN2 := b)`, and EN and ENO where they are not declared.

IEC 61131-3 names the operands of its standard functions, and gives every function and block EN and ENO;
Beremiz and OpenPLC write both. The call means another one with the operands in order, under the condition EN;
where an instance is not called, its inputs and what its outputs are fetched into stay as they are.
"""

from __future__ import annotations

import re

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.conditions import condition
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import value
from tappet.lang.analysis.result import carried_type
from tappet.lang.symbols import BuiltinSymbol, PouSymbol

_NAMES = {
    "SEL": ("G", "IN0", "IN1"),
    "LIMIT": ("MN", "IN", "MX"),
    "SHL": ("IN", "N"),
    "SHR": ("IN", "N"),
    "ROL": ("IN", "N"),
    "ROR": ("IN", "N"),
}
_ANY_NUMBER = re.compile(r"IN(\d{1,3})$")
_ENABLING = ("EN", "ENO")
_WITH_ENABLE = ("FUNCTION", "FUNCTION_BLOCK", "PROGRAM")


def enabled(e: ast.Call, target: PouSymbol | None) -> bool:
    """Whether EN or ENO is given to an operator (`target` None), or to a function, a program or an instance
    that declares neither."""
    if not any(arg.name is not None and arg.name.upper() in _ENABLING for arg in e.args):
        return False
    if target is None:
        return True
    own = {p.name.upper() for p in target.parameters}
    gives_nothing = target.kind == "FUNCTION" and target.return_type is None
    return target.kind in _WITH_ENABLE and not gives_nothing and not own & set(_ENABLING)


def ordered(b: Body, e: ast.Call, name: str) -> list[ast.Argument] | None:
    """The operands of an operator without their names, in order; None after an error."""
    places: dict[int, ast.Argument] = {}
    for arg in e.args:
        key = arg.name.upper() if arg.name is not None else ""
        position = _position(name, key)
        if position is None or arg.output or arg.value is None:
            b.report("E0514", arg.span, name=name)
            return None
        if position in places:
            b.report("E0509", arg.span, name=arg.name)
            return None
        places[position] = arg
    return [ast.Argument(span=arg.span, name=None, value=arg.value) for _, arg in sorted(places.items())]


def _position(name: str, key: str) -> int | None:
    fixed = _NAMES.get(name)
    if fixed is not None:
        return fixed.index(key) if key in fixed else None
    number = _ANY_NUMBER.match(key)
    if name == "MUX":
        return 0 if key == "K" else int(number[1]) + 1 if number else None
    if number:
        return int(number[1])
    return 0 if key == "IN" else None


def without_enable(e: ast.Call) -> list[ast.Argument]:
    """The arguments without EN and ENO."""
    return [arg for arg in e.args if arg.name is None or arg.name.upper() not in _ENABLING]


def gate(b: Body, e: ast.Call) -> ast.Expr:
    """The condition under which a call is made: EN, whose value ENO gets."""
    given: dict[str, ast.Expr | None] = {}
    for arg in e.args:
        key = arg.name.upper() if arg.name is not None else ""
        if key in _ENABLING:
            arg.parameter = None
            if key in given:
                b.report("E0509", arg.span, name=arg.name)
            if arg.output != (key == "ENO"):
                b.report("E0510" if key == "ENO" else "E0511", arg.span, name=arg.name)
            given[key] = arg.value
    found = given.get("EN") or ast.Literal(span=e.span, text="TRUE", kind="bool", value=True)
    success = given.get("ENO")
    if success is None:
        condition(b, found)
        return found
    found = ast.AssignExpr(span=e.span, op=":=", target=success, value=found)
    before = len(b.session.diagnostics)
    type_ = value(b, found)
    reported = any(message.severity == "error" for message in b.session.diagnostics[before:])
    if type_ is not None and t.value_type(type_) is not t.BOOL and not reported:
        b.report("E0307", success.span, source=type_)
    return found


def when_enabled(b: Body, e: ast.Call, inner: ast.Call) -> None:
    """Makes `e` mean the resolved `inner` where EN is TRUE, else 0; ENO gets the value of EN."""
    decides = gate(b, e)
    type_ = carried_type(inner)
    if type_ is None or inner.type is None:
        return
    inner.untyped = False
    empty: ast.Constant = 0
    if isinstance(type_, t.String):
        empty = "" if type_.wide else b""
    nothing = _constant(e, type_, empty)
    args = [ast.Argument(span=e.span, name=None, value=x) for x in (decides, nothing, inner)]
    choice = ast.Call(span=e.span, callee=e.callee, args=args)
    choice.target = BuiltinSymbol("SEL", parameter_types=(t.BOOL, type_, type_), return_type=type_)
    choice.type = e.type = inner.type
    e.expansion = choice
    e.target = choice.target


def _constant(e: ast.Expr, type_: t.Type, content: ast.Constant) -> ast.Literal:
    literal = ast.Literal(span=e.span, text="", kind="int")
    literal.type, literal.constant, literal.is_constant = type_, content, True
    return literal


def mean(e: ast.Call, inner: ast.Call) -> None:
    """Makes `e` mean the resolved call `inner`."""
    e.expansion = inner
    e.type, e.constant, e.is_constant, e.untyped = (
        inner.type,
        inner.constant,
        inner.is_constant,
        inner.untyped,
    )
    target = inner.target
    if isinstance(target, BuiltinSymbol):
        e.target = BuiltinSymbol(target.name, return_type=target.return_type)
