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
from tappet.lang.analysis.adaptation import require, retype
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import clear, value
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.types import Elementary, Kind, Type

Resolve = Callable[[Body, ast.Call, str], None]
OPERATORS: dict[str, Resolve] = {}
_MANY = 1000
_DEFAULT_STRING = t.String(80)
_DEFAULT_WSTRING = t.String(80, wide=True)


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
    expected = str(low) if low == high else f"at least {low}" if high == _MANY else f"{low} to {high}"
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
        _take(e, result, name)

    return resolve


def _take(e: ast.Call, result: ast.Expr, name: str) -> None:
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
        _take(e, result, name)


def _move(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 1, 1)
    if found is not None:
        _take(e, found[0], name)


# -- selection --------------------------------------------------------------------------------------


def common_type(b: Body, found: Sequence[ast.Expr]) -> Type | None:
    """The type all operands meet in; literals adapt to it. None (reported) when there is none."""
    result: Type | None = None
    for operand in found:
        if not operand.untyped:
            result = operand.type if result is None else _pair(result, operand.type)
            if result is None:
                b.report(
                    "E0304", operand.span, op="selection", left=found[0].type, right=operand.type, hint=_SAME
                )
                return None
    if result is None:
        return _common_of_literals(b, found)
    for operand in found:
        if operand.untyped:
            if isinstance(result, t.String) and isinstance(operand.type, t.String):
                if operand.type.wide == result.wide:
                    result = result if result.length >= operand.type.length else operand.type
                    continue
            base = t.value_type(result)
            if isinstance(base, Elementary) and retype(operand, base):
                continue
            wider = _pair(result, operand.type)
            if wider is None:
                b.report("E0304", operand.span, op="selection", left=result, right=operand.type, hint=_SAME)
                return None
            result = wider
    return result


_SAME = "All values must have the same type."


def _pair(left: Type, right: Type | None) -> Type | None:
    if right is None:
        return None
    if left == right:
        return left
    lb, rb = t.value_type(left), t.value_type(right)
    if isinstance(lb, Elementary) and isinstance(rb, Elementary):
        if lb == rb:
            return lb
        meeting = conversion.OPERANDS.get((lb.name, rb.name))
        if meeting is None:
            return None
        if (lb.kind is Kind.SIGNED) != (rb.kind is Kind.SIGNED) and meeting.type.kind is not Kind.REAL:
            # both sides keep their value: 32 bit for the narrow ones
            return meeting.computed if meeting.computed.size >= meeting.type.size else meeting.type
        return meeting.type
    if isinstance(lb, t.String) and isinstance(rb, t.String) and lb.wide == rb.wide:
        return lb if lb.length >= rb.length else rb
    if isinstance(lb, t.Pointer) and isinstance(rb, t.Pointer):
        return lb
    return None


def _common_of_literals(b: Body, found: Sequence[ast.Expr]) -> Type | None:
    first = found[0]
    result = first.type
    for operand in found[1:]:
        wider = _pair(result, operand.type) if result is not None else None
        if wider is None:
            b.report("E0304", operand.span, op="selection", left=first.type, right=operand.type, hint=_SAME)
            return None
        result = wider
    return result


def _choose(e: ast.Call, name: str, lead: Sequence[Type | None], found: list[ast.Expr], type_: Type) -> None:
    """Finishes SEL, MUX, MAX, MIN, LIMIT; folds when every operand is constant."""
    finish(e, name, [*lead, *([type_] * (len(found) - len(lead)))], type_)
    if not all(x.is_constant and x.constant is not None for x in found):
        return
    values = [x.constant for x in found]
    chosen: ast.Constant = None
    if name == "SEL":
        chosen = values[2] if values[0] else values[1]
    elif name == "MUX":
        number = values[0]
        assert isinstance(number, int)
        chosen = values[1 + number] if 0 <= number < len(values) - 1 else values[-1]
    elif name == "LIMIT":
        chosen = _smaller(_larger(values[1], values[0]), values[2])
    else:
        pick = _larger if name == "MAX" else _smaller
        chosen = values[0]
        for other in values[1:]:
            chosen = pick(chosen, other)
    e.is_constant = True
    e.constant = chosen
    e.untyped = all(x.untyped for x in found[len(lead) :])
    if not e.untyped and isinstance(type_, Elementary):
        e.constant = folding.wrap(chosen, type_)


def _larger(left: ast.Constant, right: ast.Constant) -> ast.Constant:
    return left if folding.compare(">", left, right) else right


def _smaller(left: ast.Constant, right: ast.Constant) -> ast.Constant:
    return left if folding.compare("<", left, right) else right


def _sel(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 3, 3)
    if found is None or not require(b, found[0], t.BOOL):
        return
    type_ = common_type(b, found[1:])
    if type_ is not None:
        _choose(e, name, [t.BOOL], found, type_)


def _mux(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 2, _MANY)
    if found is None:
        return
    number = t.value_type(found[0].type)  # type: ignore[arg-type]
    if not isinstance(number, Elementary) or not number.is_integer:
        b.report("E0303", found[0].span, op=name, type=found[0].type, hint="The number must be an integer.")
        return
    type_ = common_type(b, found[1:])
    if type_ is not None:
        _choose(e, name, [number], found, type_)


def _extreme(b: Body, e: ast.Call, name: str) -> None:
    low, high = (3, 3) if name == "LIMIT" else (2, _MANY)
    found = operands(b, e, name, low, high)
    if found is None:
        return
    type_ = common_type(b, found)
    if type_ is None:
        return
    if not isinstance(t.value_type(type_), (Elementary, t.String)):
        b.report("E0303", e.span, op=name, type=type_, hint="Values of this type have no order.")
        return
    _choose(e, name, [], found, type_)


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


def _real_of(base: Elementary) -> Elementary:
    """REAL for what REAL holds exactly, else LREAL."""
    return (
        t.REAL if base is t.REAL or (base.is_integer and base.size <= conversion.EXACT_IN_REAL) else t.LREAL
    )


def _mathematics(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 1, 1)
    if found is None:
        return
    operand = found[0]
    base = _number(b, operand, name)
    if base is None:
        return
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
    found = operands(b, e, name, 1, 1)
    if found is None:
        return
    operand = found[0]
    base = _number(b, operand, name)
    if base is None:
        return
    untyped = operand.untyped
    finish(e, name, [base], base)
    if operand.is_constant and isinstance(operand.constant, (int, float)):
        e.is_constant = True
        e.untyped = untyped
        e.constant = abs(operand.constant)
        if untyped and isinstance(e.constant, int):
            e.type = conversion.smallest_integer(e.constant)
        elif not untyped:
            e.constant = folding.wrap(e.constant, base)


def _trunc(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 1, 1)
    if found is None:
        return
    operand = found[0]
    base = _number(b, operand, name)
    if base is None:
        return
    result = t.DINT if name == "TRUNC" else t.INT
    constant: ast.Constant = None
    if operand.is_constant and isinstance(operand.constant, (int, float)):
        whole = math.trunc(operand.constant) if math.isfinite(operand.constant) else operand.constant
        constant = folding.saturate(float(whole), result)
    if operand.untyped:
        retype(operand, t.LREAL)
        base = t.LREAL
    finish(e, name, [base], result, constant)


# -- conversions ------------------------------------------------------------------------------------

_GENERIC = frozenset(
    {
        "ANY",
        "ANY_NUM",
        "ANY_INT",
        "ANY_REAL",
        "ANY_BIT",
        "ANY_DATE",
        "ANY_STRING",
        "ANY_MAGNITUDE",
        "ANY_ELEMENTARY",
    }
)


def _conversion_type(name: str) -> Type | None:
    if name == "STRING":
        return _DEFAULT_STRING
    if name == "WSTRING":
        return _DEFAULT_WSTRING
    return t.ELEMENTARY.get(name)


def find(name: str) -> Resolve | None:
    """What resolves a call of the operator `name` (upper case), None if it is none."""
    resolve = OPERATORS.get(name)
    if resolve is not None:
        return resolve
    source, found, target = name.rpartition("_TO_")
    if not found:
        if not name.startswith("TO_"):
            return None
        source, target = "ANY", name[3:]
    result = _conversion_type(target)
    if result is None or (source not in _GENERIC and _conversion_type(source) is None):
        return None
    resolve = _convert(None if source in _GENERIC else _conversion_type(source), result)
    OPERATORS[name] = resolve
    return resolve


def _convert(source: Type | None, target: Type) -> Resolve:
    def resolve(b: Body, e: ast.Call, name: str) -> None:
        found = operands(b, e, name, 1, 1)
        if found is None:
            e.type = target
            return
        operand = found[0]
        own = t.value_type(operand.type)  # type: ignore[arg-type]
        if source is None:
            if not isinstance(own, (Elementary, t.String, t.Pointer)):
                b.report(
                    "E0303",
                    operand.span,
                    op=name,
                    type=operand.type,
                    hint="Only simple types can be converted.",
                )
                return
            from_: Type = own
            if operand.untyped and isinstance(own, Elementary):
                retype(operand, own)
        elif isinstance(source, t.String):
            if not isinstance(own, t.String) or own.wide != source.wide:
                require(b, operand, source)
                return
            from_ = own
        else:
            if isinstance(own, t.Pointer) and isinstance(source, Elementary) and source.is_integer:
                from_ = own
            elif not require(b, operand, source):
                e.type = target
                return
            else:
                from_ = source
        finish(e, "CONVERT", [from_], target)
        if operand.is_constant and isinstance(from_, Elementary) and isinstance(target, Elementary):
            _fold_conversion(e, operand.constant, from_, target)

    return resolve


def _fold_conversion(e: ast.Call, content: ast.Constant, source: Elementary, target: Elementary) -> None:
    clock = (Kind.TIME, Kind.DATE)
    if source.kind in clock and target.kind in clock and source is not target:
        return  # units differ: lowering computes it
    if not isinstance(content, (int, float)):
        return
    content = folding.wrap(content, source)
    e.is_constant = True
    e.constant = folding.wrap(content, target)


def _time(type_: Elementary) -> Resolve:
    def resolve(b: Body, e: ast.Call, name: str) -> None:
        if count_fits(b, e, name, 0, 0):
            finish(e, name, [], type_)
        else:
            e.type = type_

    return resolve


for _name, _op in (("ADD", "+"), ("MUL", "*"), ("AND", "AND"), ("OR", "OR"), ("XOR", "XOR")):
    OPERATORS[_name] = _expand(_op, _MANY)
for _name, _op in (("SUB", "-"), ("DIV", "/"), ("MOD", "MOD"), ("EXPT", "**")):
    OPERATORS[_name] = _expand(_op, 2)
for _name, _op in (("GT", ">"), ("GE", ">="), ("EQ", "="), ("NE", "<>"), ("LE", "<="), ("LT", "<")):
    OPERATORS[_name] = _expand(_op, 2)
for _name, _op in (("ANDN", "AND"), ("ORN", "OR"), ("XORN", "XOR")):
    OPERATORS[_name] = _expand(_op, _MANY, negate=True)
for _name in folding.MATHEMATICS:
    OPERATORS[_name] = _mathematics
for _name in ("SHL", "SHR", "ROL", "ROR"):
    OPERATORS[_name] = _shift
for _name in ("MAX", "MIN", "LIMIT"):
    OPERATORS[_name] = _extreme
OPERATORS |= {
    "NOT": _not,
    "MOVE": _move,
    "AND_THEN": _expand("AND_THEN", _MANY),
    "OR_ELSE": _expand("OR_ELSE", _MANY),
    "SEL": _sel,
    "MUX": _mux,
    "ATAN2": _atan2,
    "ABS": _abs,
    "TRUNC": _trunc,
    "TRUNC_INT": _trunc,
    "TIME": _time(t.TIME),
    "LTIME": _time(t.LTIME),
}

__all__ = ["OPERATORS", "clear", "common_type", "count_fits", "find", "finish", "operands"]
