"""Implicit conversions and common operand types (spec language_operators.md section 1, LOPR-01..LOPR-03).

Decision on LOPR-03: integers narrower than 32 bit are computed in DINT, which holds all their values;
operands of
different sign are computed in the smallest signed type that holds both, so that `-1 < udi` is TRUE. The
static
type of the result is that of the larger operand (of equal size: the signed one), which decides the messages.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from tappet.lang import types as t
from tappet.lang.heritage import is_unknown_at_heart
from tappet.lang.types import Elementary, Kind, Type

SIGN_TO_UNSIGNED = "W1001"
UNSIGNED_TO_SIGN = "W1002"
PRECISION = "W1003"
POINTER_IN_INTEGER = "W1302"
ENUM_MISMATCH = "W1005"
ERROR = "E0301"
OK = ""

NUMBERS: tuple[Elementary, ...] = (
    t.SINT, t.USINT, t.BYTE, t.INT, t.UINT, t.WORD, t.DINT, t.UDINT, t.DWORD, t.LINT, t.ULINT, t.LWORD,
    t.REAL, t.LREAL,
)  # fmt: skip
INTEGERS = NUMBERS[:12]
SIGNED = {n.size: n for n in INTEGERS if n.kind is Kind.SIGNED}
"""Signed integers by their size in bytes."""
EXACT_IN_REAL = 2
"""Largest integer size in bytes whose values REAL holds exactly; LREAL holds twice as much."""


def _number_verdict(source: Elementary, target: Elementary) -> str:
    if source is target:
        return OK
    if source.kind is Kind.REAL:
        if target.kind is not Kind.REAL:
            return ERROR
        return OK if target.size > source.size else PRECISION
    if target.kind is Kind.REAL:
        exact = EXACT_IN_REAL if target is t.REAL else 2 * EXACT_IN_REAL
        return OK if source.size <= exact else PRECISION
    if target.size < source.size:
        return ERROR
    if source.kind is Kind.SIGNED:
        return OK if target.kind is Kind.SIGNED else SIGN_TO_UNSIGNED
    if target.kind is Kind.SIGNED and target.size == source.size:
        return UNSIGNED_TO_SIGN
    return OK


_VERDICTS: dict[tuple[str, str], str] = {
    (source.name, target.name): _number_verdict(source, target) for source in NUMBERS for target in NUMBERS
}


def implements(block: t.FunctionBlock, interface: t.Interface) -> bool:
    """Whether a function block, or a base of it, implements the interface or one that extends it."""
    if is_unknown_at_heart(block):
        return True
    walk: t.FunctionBlock | None = block
    while walk is not None:
        if walk.pou is not None:
            symbol = walk.pou.symbol
            for found in getattr(symbol, "interfaces", ()):
                if extends(found.type, interface):
                    return True
        walk = walk.base
    return False


def extends(derived: t.Interface | None, base: t.Interface) -> bool:
    """Whether an interface is another one or extends it."""
    if derived is None:
        return False
    if is_unknown_at_heart(derived):
        return True
    todo = [derived]
    seen: set[int] = set()
    while todo:
        current = todo.pop()
        if current is base:
            return True
        if id(current) in seen or current.pou is None:
            continue
        seen.add(id(current))
        todo += [b.type for b in getattr(current.pou.symbol, "bases", ()) if b.type is not None]
    return False


def derives(block: t.FunctionBlock, base: t.FunctionBlock) -> bool:
    """Whether a function block is another one or extends it."""
    return refers(block, base)


def refers(source: Type | None, target: Type | None) -> bool:
    """Whether what refers to `target` may refer to a variable of type `source`: one that begins like it."""
    if source == target:
        return True
    if not isinstance(source, (t.FunctionBlock, t.Struct)):
        return False
    walk = source.base
    while walk is not None:
        if walk is target:
            return True
        walk = walk.base
    return is_unknown_at_heart(source) and source.__class__ is target.__class__


def verdict(source: Type, target: Type) -> str:
    """'' when a value of `source` may be assigned to `target` silently, else the code of the message."""
    if source is target:
        return OK
    if source.__class__ is Elementary and target.__class__ is Elementary:
        if source == target:
            return OK
        return _VERDICTS.get((source.name, target.name), ERROR)
    check = _BY_TARGET.get(target.__class__)
    return check(source, target) if check is not None else ERROR


def _to_elementary(source: Type, target: Elementary) -> str:
    base = t.value_type(source)
    if isinstance(base, Elementary):
        return OK if base == target else _VERDICTS.get((base.name, target.name), ERROR)
    if isinstance(base, t.Pointer) and target.is_integer:
        if target.size == 8:
            return OK
        return POINTER_IN_INTEGER if target.size == 4 else ERROR
    return ERROR


def _to_string(source: Type, target: t.String) -> str:
    return OK if isinstance(source, t.String) and source.wide == target.wide else ERROR


def _to_enum(source: Type, target: t.Enum) -> str:
    if isinstance(source, t.Enum):
        return ENUM_MISMATCH if not target.strict else ERROR
    if target.strict:
        return ERROR
    return _to_elementary(source, target.base)


def _to_subrange(source: Type, target: t.Subrange) -> str:
    return _to_elementary(source, target.base)


def _to_pointer(source: Type, target: t.Pointer) -> str:
    base = t.value_type(source)
    if target.ref_to:
        return OK if isinstance(base, t.Pointer) and refers(base.base, target.base) else ERROR
    if isinstance(base, t.Pointer):
        return OK
    if isinstance(base, Elementary) and base.is_integer and base.size >= 4:
        return OK
    return ERROR


def _to_interface(source: Type, target: t.Interface) -> str:
    if isinstance(source, t.FunctionBlock):
        return OK if implements(source, target) else ERROR
    if isinstance(source, t.Interface):
        return OK if extends(source, target) else ERROR
    return ERROR


def _to_array(source: Type, target: t.Array) -> str:
    return OK if same_shape(source, target) else ERROR


def _to_struct(source: Type, target: t.Struct) -> str:
    """A derived structure gives the part that its base has."""
    return OK if refers(source, target) else ERROR


def same_shape(source: Type, target: Type) -> bool:
    """Whether two arrays have the same elements in the same order, whatever their bounds are."""
    if not isinstance(source, t.Array) or not isinstance(target, t.Array):
        return source == target
    if source.open_dims or target.open_dims:
        return source == target
    lengths = [tuple(high - low for low, high in array.bounds) for array in (source, target)]
    return lengths[0] == lengths[1] and same_shape(source.element, target.element)


def _to_block(source: Type, target: t.FunctionBlock) -> str:
    return OK if isinstance(source, t.FunctionBlock) and derives(source, target) else ERROR


_BY_TARGET: dict[type, Callable[[Any, Any], str]] = {
    Elementary: _to_elementary,
    t.String: _to_string,
    t.Enum: _to_enum,
    t.Subrange: _to_subrange,
    t.Pointer: _to_pointer,
    t.Interface: _to_interface,
    t.Array: _to_array,
    t.Struct: _to_struct,
    t.FunctionBlock: _to_block,
}


@dataclass(frozen=True, slots=True)
class Operands:
    """How two numbers meet in an operation."""

    type: Elementary
    """Static type of the result."""
    computed: Elementary
    """Type both operands are converted to."""
    warnings: tuple[str, str]
    """Message for the conversion of the left and of the right operand, '' for none."""


def _holds(signed: bool, size: int) -> Elementary:
    return {4: t.DINT, 8: t.LINT}[size] if signed else {4: t.UDINT, 8: t.ULINT}[size]


def _meet(left: Elementary, right: Elementary) -> Operands:
    if left.kind is Kind.REAL or right.kind is Kind.REAL:
        if left.kind is Kind.REAL and right.kind is Kind.REAL:
            result = left if left.size >= right.size else right
            return Operands(result, result, (OK, OK))
        result = left if left.kind is Kind.REAL else right
        return Operands(result, result, (_number_verdict(left, result), _number_verdict(right, result)))
    if left.size != right.size:
        result = left if left.size > right.size else right
    elif Kind.SIGNED in (left.kind, right.kind):
        result = left if left.kind is Kind.SIGNED else right
    else:
        result = right if left.kind is Kind.BITS else left
    if result.size < 4:
        return Operands(result, t.DINT, (OK, OK))
    left_signed, right_signed = left.kind is Kind.SIGNED, right.kind is Kind.SIGNED
    if left_signed == right_signed:
        computed = result if result.kind is Kind.BITS else _holds(left_signed, result.size)
        return Operands(result, computed, (OK, OK))
    unsigned = right if left_signed else left
    if unsigned.size < 8:
        signed_size = (left if left_signed else right).size
        size = 8 if unsigned.size >= 4 else max(4, signed_size)
        return Operands(result, _holds(True, size), (OK, OK))
    warning = UNSIGNED_TO_SIGN if result.kind is Kind.SIGNED else SIGN_TO_UNSIGNED
    warned_left = left_signed if warning == SIGN_TO_UNSIGNED else not left_signed
    return Operands(result, result, (warning, OK) if warned_left else (OK, warning))


OPERANDS: dict[tuple[str, str], Operands] = {
    (left.name, right.name): _meet(left, right) for left in NUMBERS for right in NUMBERS
}
"""By the names of the two operand types."""


def _meet_bits(left: Elementary, right: Elementary) -> Elementary:
    if left.size != right.size:
        return left if left.size > right.size else right
    return left if left.kind is Kind.BITS or right.kind is not Kind.BITS else right


BIT_OPERANDS: dict[tuple[str, str], Elementary] = {
    (left.name, right.name): _meet_bits(left, right) for left in INTEGERS for right in INTEGERS
} | {("BOOL", "BOOL"): t.BOOL}
"""Type of AND, OR, XOR by the names of the operand types: the wider one, of equal width the bit string."""

RANGES: dict[str, tuple[int, int]] = {
    e.name: (-(1 << (8 * e.size - 1)), (1 << (8 * e.size - 1)) - 1)
    if e.kind is Kind.SIGNED
    else (0, (1 << (8 * e.size)) - 1)
    for e in (*INTEGERS, t.TIME, t.LTIME, t.DATE, t.TOD, t.DT, t.LDATE, t.LTOD, t.LDT)
} | {"BOOL": (0, 1)}
"""Smallest and largest value of the integer, time and date types by name."""

_SMALLEST = (t.SINT, t.USINT, t.INT, t.UINT, t.DINT, t.UDINT, t.LINT, t.ULINT)
_SMALLEST_BITS = (t.BYTE, t.WORD, t.DWORD, t.LWORD)


def smallest_integer(value: int) -> Elementary | None:
    """The smallest integer type that holds a literal (LTYP-31), None beyond 64 bit."""
    return smallest_of((value,))


def smallest_of(values: Sequence[int]) -> Elementary | None:
    """The smallest integer type that holds all of these literals; None when no type does."""
    least, most = min(values), max(values)
    for candidate in _SMALLEST:
        low, high = RANGES[candidate.name]
        if low <= least and most <= high:
            return candidate
    return None


def smallest_bits(value: int) -> Elementary | None:
    """The smallest bit string that holds a literal, None for negative values and beyond 64 bit."""
    for candidate in _SMALLEST_BITS:
        if 0 <= value <= RANGES[candidate.name][1]:
            return candidate
    return None
