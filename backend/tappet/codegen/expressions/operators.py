"""Operators of expressions: the type in which operands meet, and the steps that combine them."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from tappet.codegen.expressions.places import ExpressionError, kind_of
from tappet.codegen.expressions.program import Kind, Op, Step, real_bits
from tappet.codegen.symbol_types import TypeInfo
from tappet.lang import types as t
from tappet.lang.analysis import conversion
from tappet.lang.types import Elementary
from tappet.lang.types import Kind as Family

_COMPARISONS = {
    "=": Op.EQUAL, "<>": Op.NOT_EQUAL, "<": Op.LESS, "<=": Op.LESS_EQUAL, ">": Op.GREATER,
    ">=": Op.GREATER_EQUAL,
}  # fmt: skip
comparison_operators = frozenset(_COMPARISONS)
_ARITHMETIC = {
    "+": Op.ADD, "-": Op.SUBTRACT, "*": Op.MULTIPLY, "/": Op.DIVIDE, "MOD": Op.MODULO, "MIN": Op.MINIMUM,
    "MAX": Op.MAXIMUM,
}  # fmt: skip
_LOGIC = {"AND": Op.BIT_AND, "OR": Op.BIT_OR, "XOR": Op.BIT_XOR}


@dataclass(frozen=True, slots=True)
class Operand:
    """A value and the steps that push it."""

    steps: tuple[Step, ...]
    type: Elementary
    """Its static type, which decides how it meets another operand."""
    literal: int | float | None = None
    """Of a number without a type, which adapts to the other operand."""
    info: TypeInfo | None = None
    """The declared type of a variable."""
    computed: Elementary | None = None
    """In which an operation has computed it, where that is not the static type."""

    @property
    def held(self) -> Elementary:
        """The type that the word on the stack holds."""
        return self.computed or self.type

    @property
    def type_name(self) -> str:
        """As declared."""
        return self.info.name if self.info is not None else self.type.name


def constant(value: float, type_: Elementary | None = None) -> Operand:
    """A literal; without a type it is of the smallest one, and adapts."""
    literal = None if type_ is not None else value
    if type_ is None:
        smallest = t.LREAL if isinstance(value, float) else conversion.smallest_integer(value)
        if smallest is None:
            raise ExpressionError(f"{value} is larger than any integer type")
        type_ = smallest
    if type_.kind is Family.REAL:
        word = real_bits(_in_real(float(value), type_))
    else:
        low, high = conversion.RANGES[type_.name]
        if not isinstance(value, int) or not low <= value <= high:
            raise ExpressionError(f"{value} is outside {low}..{high} of {type_.name}")
        word = _signed(value)
    return Operand((Step(Op.PUSH, a=word),), type_, literal)


def _in_real(value: float, type_: Elementary) -> float:
    """A number as REAL or LREAL holds it."""
    if type_ is t.LREAL or not math.isfinite(value):
        return value
    try:
        single: float = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return single


def _signed(value: int) -> int:
    return value - (1 << 64) if value >= 1 << 63 else value


def converted(operand: Operand, type_: Elementary) -> Operand:
    """The same value in a type that an operation computes in."""
    if operand.literal is not None:
        return replace(constant(operand.literal, type_), info=operand.info)
    held = operand.held
    steps = operand.steps
    if type_.kind is Family.REAL and held.kind is not Family.REAL:
        steps = (*steps, Step(Op.TO_REAL, kind_of(held), a=int(type_ is t.REAL)))
    elif type_.is_integer and type_.size < 8 and kind_of(held) is not kind_of(type_):
        steps = (*steps, *_wrapped(type_))
    return Operand(steps, type_, info=operand.info)


def _wrapped(type_: Elementary) -> tuple[Step, ...]:
    """Cuts an integer to what a type holds."""
    return Step(Op.PUSH, a=0), Step(Op.ADD, kind_of(type_))


def _adapted(left: Operand, right: Operand) -> tuple[Operand, Operand]:
    """A literal takes the type of the other side, if that holds its value."""
    if left.literal is not None and right.literal is None:
        return _retyped(left, right.type), right
    if right.literal is not None and left.literal is None:
        return left, _retyped(right, left.type)
    return left, right


def _retyped(operand: Operand, type_: Elementary) -> Operand:
    value = operand.literal
    assert value is not None
    if type_.kind is Family.REAL:
        return constant(float(value), type_)
    if isinstance(value, int) and type_.is_integer:
        low, high = conversion.RANGES[type_.name]
        if low <= value <= high:
            return constant(value, type_)
    return replace(operand, literal=value)


def _met(op: str, left: Operand, right: Operand) -> tuple[Operand, Operand, conversion.Operands]:
    """Both operands in the type in which two numbers are computed, and that type."""
    left, right = _adapted(left, right)
    meeting = conversion.OPERANDS.get((left.type.name, right.type.name))
    if meeting is None:
        raise _impossible(op, left, right)
    return converted(left, meeting.computed), converted(right, meeting.computed), meeting


def _impossible(op: str, left: Operand, right: Operand) -> ExpressionError:
    return ExpressionError(f"{op} is not possible with {left.type_name} and {right.type_name}")


def combine(op: str, left: Operand, right: Operand) -> Operand:
    """+ - * / MOD, and MIN and MAX."""
    if op not in _ARITHMETIC:
        raise ExpressionError(f"the operator {op} is not possible here")
    if _is_time(left) or _is_time(right):
        return _combine_times(op, left, right)
    if left.literal is not None and right.literal is not None:
        return constant(_folded(op, left.literal, right.literal))
    left, right, meeting = _met(op, left, right)
    if op == "MOD" and meeting.computed.kind is Family.REAL:
        raise ExpressionError("MOD needs integers")
    step = Step(_ARITHMETIC[op], kind_of(meeting.computed))
    return Operand((*left.steps, *right.steps, step), meeting.type, computed=meeting.computed)


def _folded(op: str, a: float, b: float) -> float:
    """What two literals give is a literal again, which adapts to what it meets."""
    simple: dict[str, Callable[[], float]] = {
        "+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "MIN": lambda: min(a, b),
        "MAX": lambda: max(a, b),
    }  # fmt: skip
    if op in simple:
        return simple[op]()
    if b == 0:
        raise ExpressionError(f"{a} {op} 0 has no value")
    if isinstance(a, int) and isinstance(b, int):
        quotient = abs(a) // abs(b) * (-1 if (a < 0) != (b < 0) else 1)
        return quotient if op == "/" else a - quotient * b
    if op == "MOD":
        raise ExpressionError("MOD needs integers")
    return a / b


def _is_time(operand: Operand) -> bool:
    return operand.type.kind in (Family.TIME, Family.DATE)


def _combine_times(op: str, left: Operand, right: Operand) -> Operand:
    """Times of one type added and subtracted, or multiplied with and divided by an integer."""
    same = left.type is right.type
    if op in ("MIN", "MAX") and same:
        step = Step(_ARITHMETIC[op], kind_of(left.type))
        return Operand((*left.steps, *right.steps, step), left.type)
    if op in ("+", "-") and same and left.type.kind is Family.TIME:
        step = Step(_ARITHMETIC[op], kind_of(left.type))
        return Operand((*left.steps, *right.steps, step), left.type)
    if op == "*" and right.type.kind is Family.TIME and left.type.is_integer:
        left, right = right, left
    if op == "*" and left.type.kind is Family.TIME and right.type.is_integer:
        step = Step(Op.MULTIPLY, kind_of(left.type))
        return Operand((*left.steps, *right.steps, step), left.type)
    if op == "/" and left.type.kind is Family.TIME and right.type.is_integer:
        return _divide_time(left, right)
    raise _impossible(op, left, right)


def _divide_time(left: Operand, right: Operand) -> Operand:
    """A time by an unsigned integer; a literal that is not negative is one."""
    if isinstance(right.literal, int) and right.literal >= 0:
        right = constant(right.literal, t.ULINT)
    if right.type.is_signed:
        raise ExpressionError(f"{left.type_name} is divided by an unsigned integer here")
    # in ULINT, as the word of a divisor beyond LINT would be negative in the kind of TIME
    divisor = converted(right, right.type)
    return Operand((*left.steps, *divisor.steps, Step(Op.DIVIDE, Kind.ULINT)), left.type)


def compare(op: str, left: Operand, right: Operand) -> Operand:
    """= <> < <= > >=."""
    step_of = _COMPARISONS[op]
    if left.type is right.type and (_is_time(left) or left.type is t.BOOL):
        if left.type is t.BOOL and op not in ("=", "<>"):
            raise ExpressionError(f"BOOL is compared with = and <>, not with {op}")
        step = Step(step_of, Kind.ULINT)
        return Operand((*left.steps, *right.steps, step), t.BOOL)
    left, right, meeting = _met(op, left, right)
    return Operand((*left.steps, *right.steps, Step(step_of, kind_of(meeting.computed))), t.BOOL)


def logic(op: str, left: Operand, right: Operand) -> Operand:
    """AND, OR, XOR of BOOL or bit by bit."""
    left, right = _bool_literals(*_adapted(left, right))
    result = conversion.BIT_OPERANDS.get((left.type.name, right.type.name))
    if result is None:
        raise _impossible(op, left, right)
    if result is not t.BOOL:
        left, right = converted(left, result), converted(right, result)
    return Operand((*left.steps, *right.steps, Step(_LOGIC[op])), result)


def _bool_literals(left: Operand, right: Operand) -> tuple[Operand, Operand]:
    """0 and 1 beside a BOOL are FALSE and TRUE."""
    if left.type is t.BOOL and right.literal in (0, 1):
        right = constant(int(right.literal), t.BOOL)
    elif right.type is t.BOOL and left.literal in (0, 1):
        left = constant(int(left.literal), t.BOOL)
    return left, right


def short_circuit(op: str, left: Operand, right: Operand) -> Operand:
    """AND_THEN, OR_ELSE: the right side is evaluated only where it decides."""
    if left.type is not t.BOOL or right.type is not t.BOOL:
        raise _impossible(op, left, right)
    skip = Op.SKIP_FALSE if op == "AND_THEN" else Op.SKIP_TRUE
    return Operand((*left.steps, Step(skip, a=len(right.steps)), *right.steps), t.BOOL)


def negated(operand: Operand, *, sign: bool = False) -> Operand:
    """NOT, or with `sign` the minus in front."""
    if not sign:
        if operand.type is t.BOOL:
            return Operand((*operand.steps, Step(Op.FLIP, a=1)), t.BOOL)
        if not operand.type.is_integer:
            raise ExpressionError(f"NOT needs BOOL or a bit string, not {operand.type_name}")
        type_ = operand.type
        mask = -1 if type_.is_signed or type_.size == 8 else (1 << 8 * type_.size) - 1
        return Operand((*converted(operand, type_).steps, Step(Op.FLIP, a=mask)), type_)
    if operand.literal is not None:
        return constant(-operand.literal)
    type_ = operand.type
    if not type_.is_integer and type_.kind is not Family.REAL:
        raise ExpressionError(f"- needs a number, not {operand.type_name}")
    computed = type_
    if type_.is_integer and type_.size < 4:
        computed = t.DINT
    elif type_ in (t.UDINT, t.DWORD):
        computed = t.LINT
    steps = (*converted(operand, computed).steps, Step(Op.NEGATE, kind_of(computed)))
    return Operand(steps, type_, computed=computed)


def numeric_function(name: str, values: Sequence[Operand]) -> Operand:
    """ABS, SQRT, MIN, MAX."""
    first = values[0]
    if name in ("MIN", "MAX"):
        return combine(name, first, values[1])
    if not first.type.is_integer and first.type.kind is not Family.REAL:
        raise ExpressionError(f"{name} needs a number, not {first.type_name}")
    if name == "ABS":
        if first.literal is not None:
            return constant(abs(first.literal))
        value = converted(first, first.type)
        return Operand((*value.steps, Step(Op.ABSOLUTE, kind_of(first.type))), first.type)
    type_ = first.type if first.type.kind is Family.REAL else t.LREAL
    value = converted(first, type_)
    return Operand((*value.steps, Step(Op.ROOT, kind_of(type_))), type_)
