"""Operators known without a library, in functional form (spec language_operators.md; LOPR-05).

`OPERATORS` maps a name to the function that resolves a call of it. ADD, AND, GT, MOVE ... become the same
expression in operator form (`Call.expansion`); the others get a `BuiltinSymbol`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, folding, operators
from tappet.lang.analysis.adaptation import retype
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import value
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Elementary, Kind, Type

Resolve = Callable[[Body, ast.Call, str], None]
OPERATORS: dict[str, Resolve] = {}
MANY = 1000


def finish(
    e: ast.Call,
    name: str,
    parameters: Sequence[Type | None],
    result: Type | None,
    constant: ast.Constant = None,
) -> None:
    """Fills the resolved fields of a call of an operator."""
    e.target = BuiltinSymbol(name, parameter_types=tuple(parameters), return_type=result)
    e.type = result
    if constant is not None:
        e.is_constant, e.constant = True, constant


def count_fits(b: Body, e: ast.Call, name: str, low: int, high: int) -> bool:
    """Checks the number of operands and that none is named."""
    args = e.args
    for arg in args:
        if arg.name is not None or arg.value is None or arg.output:
            b.report("E0514", arg.span, name=name)
            return False
    if low <= len(args) <= high:
        return True
    expected = str(low) if low == high else f"at least {low}" if high == MANY else f"{low} to {high}"
    b.report("E0513", e.span, name=name, expected=expected, actual=len(args), hint=_SYNTAX.get(name, ""))
    return False


def operands(b: Body, e: ast.Call, name: str, low: int, high: int) -> list[ast.Expr] | None:
    """Resolves the operands as values; None after an error."""
    fine = count_fits(b, e, name, low, high)
    found: list[ast.Expr] = []
    for arg in e.args:
        if arg.value is not None:
            found.append(arg.value)
            if value(b, arg.value) is None:
                fine = False
    return found if fine else None


_SYNTAX = {
    "SEL": "Write SEL(condition, if_false, if_true).",
    "LIMIT": "Write LIMIT(minimum, value, maximum).",
    "MUX": "Write MUX(number, value0, value1, ...).",
    "SHL": "Write SHL(value, bits).",
    "SHR": "Write SHR(value, bits).",
    "ROL": "Write ROL(value, bits).",
    "ROR": "Write ROR(value, bits).",
    "EXPT": "Write EXPT(base, exponent).",
}


# -- operator form ----------------------------------------------------------------------------------


def _expand(op: str, most: int, negate: bool = False) -> Resolve:
    def resolve(b: Body, e: ast.Call, name: str) -> None:
        found = operands(b, e, name, 2, most)
        if found is None:
            if op in operators.COMPARISONS:
                e.type = t.BOOL
            return
        result = found[0]
        for operand in found[1:]:
            right = operand
            if negate:
                right = ast.Unary(op="NOT", operand=operand, span=operand.span)
                operators.unary(b, right)
            result = ast.Binary(op=op, left=result, right=right, span=e.span)
            operators.binary(b, result)
        take(e, result, name)

    return resolve


def take(e: ast.Call, result: ast.Expr, name: str) -> None:
    """Makes a call of the operator `name` mean the resolved expression `result`."""
    e.expansion = result
    e.type, e.constant, e.is_constant = result.type, result.constant, result.is_constant
    e.untyped = result.untyped
    if isinstance(result, (ast.Binary, ast.Unary)):
        carried = result.operand_type if result.type is not t.BOOL else t.BOOL
    else:
        carried = result.type
    e.target = BuiltinSymbol(name, return_type=carried or result.type)


def _not(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 1, 1)
    if found is not None:
        result = ast.Unary(op="NOT", operand=found[0], span=e.span)
        operators.unary(b, result)
        take(e, result, name)


def _move(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 1, 1)
    if found is not None:
        take(e, found[0], name)


# -- shifts -----------------------------------------------------------------------------------------


def _shift(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 2, 2)
    if found is None:
        return
    operand, count = found
    base, steps = t.value_type(operand.type), t.value_type(count.type)  # type: ignore[arg-type]
    if not isinstance(base, Elementary) or not base.is_integer:
        b.report("E0303", operand.span, op=name, type=operand.type, hint="A bit string or integer is needed.")
        return
    if not isinstance(steps, Elementary) or not steps.is_integer:
        b.report("E0303", count.span, op=name, type=count.type, hint="The number of bits must be an integer.")
        return
    if operand.untyped and isinstance(operand.constant, int):
        # a constant gets the smallest type (LOPR-30)
        base = conversion.smallest_bits(operand.constant) or base
        retype(operand, base)
    if count.untyped:
        retype(count, t.ULINT)
    finish(e, name, [base, t.ULINT], base)
    if operand.is_constant and count.is_constant:
        content, distance = operand.constant, count.constant
        if isinstance(content, int) and isinstance(distance, int):
            e.is_constant = True
            e.constant = _shifted(name, content, folding.wrap_integer(distance, 8, False), base)


def _shifted(name: str, content: int, distance: int, base: Elementary) -> int:
    bits = 8 * base.size
    signed = base.kind is Kind.SIGNED
    pattern = folding.wrap_integer(content, base.size, False)
    if name == "SHL":
        pattern = pattern << distance if distance < bits else 0
    elif name == "SHR":
        pattern = folding.wrap_integer(content, base.size, signed) >> min(distance, bits)
    else:
        distance %= bits
        if name == "ROR":
            distance = (bits - distance) % bits
        pattern = pattern << distance | pattern >> (bits - distance)
    return folding.wrap_integer(pattern, base.size, signed)


# -- mathematics ------------------------------------------------------------------------------------


def _number(b: Body, e: ast.Expr, name: str) -> Elementary | None:
    base = t.value_type(e.type)  # type: ignore[arg-type]
    if isinstance(base, Elementary) and (base.is_integer or base.kind is Kind.REAL):
        return base
    b.report("E0303", e.span, op=name, type=e.type, hint="A number is needed.")
    return None


def _only_number(b: Body, e: ast.Call, name: str) -> tuple[ast.Expr, Elementary] | None:
    """The one operand of a call, which has to be a number, and its type."""
    found = operands(b, e, name, 1, 1)
    base = _number(b, found[0], name) if found is not None else None
    return None if found is None or base is None else (found[0], base)


def _real_of(base: Elementary) -> Elementary:
    """REAL for what REAL holds exactly, else LREAL."""
    return (
        t.REAL if base is t.REAL or (base.is_integer and base.size <= conversion.EXACT_IN_REAL) else t.LREAL
    )


def _mathematics(b: Body, e: ast.Call, name: str) -> None:
    number = _only_number(b, e, name)
    if number is None:
        return
    operand, base = number
    result = t.LREAL if operand.untyped else _real_of(base)
    constant: ast.Constant = None
    if operand.is_constant and isinstance(operand.constant, (int, float)):
        constant = folding.wrap(folding.MATHEMATICS[name](float(operand.constant)), result)
    untyped = operand.untyped
    if untyped:
        retype(operand, result)
    finish(e, name, [result], result, constant)
    e.untyped = untyped


def _atan2(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 2, 2)
    if found is None:
        return
    bases = [_number(b, x, name) for x in found]
    result = t.LREAL
    if all(
        x.untyped or (base is not None and _real_of(base) is t.REAL)
        for x, base in zip(found, bases, strict=True)
    ):
        result = t.REAL
    if None in bases:
        return
    untyped = all(x.untyped for x in found)
    constant: ast.Constant = None
    values = [x.constant for x in found]
    if untyped:
        result = t.LREAL
    if all(x.is_constant for x in found):
        constant = folding.wrap(math.atan2(float(values[0]), float(values[1])), result)  # type: ignore[arg-type]
    for x in found:
        if x.untyped:
            retype(x, result)
    finish(e, name, [result, result], result, constant)
    e.untyped = untyped


def _abs(b: Body, e: ast.Call, name: str) -> None:
    number = _only_number(b, e, name)
    if number is None:
        return
    operand, base = number
    untyped = operand.untyped
    finish(e, name, [base], base)
    if operand.is_constant and isinstance(operand.constant, (int, float)):
        e.is_constant = True
        e.untyped = untyped
        e.constant = abs(operand.constant)
        if not untyped:  # the operand is handed over in its type
            content = folding.wrap(operand.constant, base)
            assert isinstance(content, (int, float))
            e.constant = abs(content)
        if untyped and isinstance(e.constant, int):
            e.type = conversion.smallest_integer(e.constant)
        elif not untyped:
            e.constant = folding.wrap(e.constant, base)


def _trunc(b: Body, e: ast.Call, name: str) -> None:
    number = _only_number(b, e, name)
    if number is None:
        return
    operand, base = number
    result = t.DINT if name == "TRUNC" else t.INT
    constant: ast.Constant = None
    if operand.is_constant and isinstance(operand.constant, (int, float)):
        whole = math.trunc(operand.constant) if math.isfinite(operand.constant) else operand.constant
        constant = folding.saturate(float(whole), result)
    if operand.untyped:
        retype(operand, t.LREAL)
        base = t.LREAL
    finish(e, name, [base], result, constant)


def _time(type_: Elementary) -> Resolve:
    def resolve(b: Body, e: ast.Call, name: str) -> None:
        if count_fits(b, e, name, 0, 0):
            finish(e, name, [], type_)
        else:
            e.type = type_

    return resolve


_FORMS = {"ADD": "+", "MUL": "*", "AND": "AND", "OR": "OR", "XOR": "XOR"}
_PAIRS = {"SUB": "-", "DIV": "/", "MOD": "MOD", "EXPT": "**"}
_COMPARISONS = {"GT": ">", "GE": ">=", "EQ": "=", "NE": "<>", "LE": "<=", "LT": "<"}
_NEGATED = {"ANDN": "AND", "ORN": "OR", "XORN": "XOR"}
OPERATIONS: dict[str, Resolve] = {
    **{name: _expand(op, MANY) for name, op in _FORMS.items()},
    **{name: _expand(op, 2) for name, op in (_PAIRS | _COMPARISONS).items()},
    **{name: _expand(op, MANY, negate=True) for name, op in _NEGATED.items()},
    **dict.fromkeys(folding.MATHEMATICS, _mathematics),
    **dict.fromkeys(("SHL", "SHR", "ROL", "ROR"), _shift),
    "NOT": _not,
    "MOVE": _move,
    "AND_THEN": _expand("AND_THEN", MANY),
    "OR_ELSE": _expand("OR_ELSE", MANY),
    "ATAN2": _atan2,
    "ABS": _abs,
    "TRUNC": _trunc,
    "TRUNC_INT": _trunc,
    "TIME": _time(t.TIME),
    "LTIME": _time(t.LTIME),
}
