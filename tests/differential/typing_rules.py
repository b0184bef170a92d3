"""The typing rules of arithmetic, choices, bit operators, comparisons and assignments; see `typed_tree`."""

from __future__ import annotations

from typed_tree import DINT, LINT, UDINT, ULINT, Enum, Scalar, Text, Type, base_of, derives, same_shape


def signed_of(bits: int) -> Scalar:
    return {32: DINT, 64: LINT}[bits]


def meet(left: Scalar, right: Scalar) -> tuple[Scalar, Scalar]:
    """Static type of the result of an arithmetic operator, and the type both operands are computed in."""
    if "real" in (left.kind, right.kind):
        reals = [x for x in (left, right) if x.kind == "real"]
        result = max(reals, key=lambda x: x.bits)
        return result, result
    signed_left, signed_right = left.kind == "signed", right.kind == "signed"
    if left.bits != right.bits:
        result = left if left.bits > right.bits else right
    elif signed_left or signed_right:
        result = left if signed_left else right
    else:
        result = right if left.kind == "bits" else left
    if result.bits < 32:
        return result, DINT
    if signed_left == signed_right:
        if signed_left:
            return result, signed_of(result.bits)
        return result, (UDINT if result.bits == 32 else ULINT)
    unsigned, signed = (right, left) if signed_left else (left, right)
    if unsigned.bits == 64:
        return result, result
    return result, signed_of(64 if unsigned.bits == 32 or signed.bits == 64 else 32)


def common(left: Scalar, right: Scalar) -> Scalar:
    """Type two values of MIN and MAX are handed over as; their static type is that of arithmetic."""
    if left == right:
        return left
    result, computed = meet(left, right)
    if (left.kind == "signed") != (right.kind == "signed") and result.kind != "real":
        return computed if computed.bits >= result.bits else result
    return result


def bit_type(left: Scalar, right: Scalar) -> Scalar:
    """AND, OR, XOR work in the wider type, of equal width the bit string."""
    if left.bits != right.bits:
        return left if left.bits > right.bits else right
    return left if left.kind == "bits" or right.kind != "bits" else right


def comparable(left: Scalar, right: Scalar) -> Scalar:
    """Type in which two values are compared: nothing is stored, so narrow values are not cut."""
    if left == right and not (left.integer and left.bits < 32):
        return left
    return meet(left, right)[1]


def assignable(source: Type, target: Type) -> bool:
    """Whether the language converts silently or with a warning."""
    if isinstance(source, Text) and isinstance(target, Text):
        return source.wide == target.wide
    if isinstance(target, Enum):
        return source is target
    a, b = base_of(source), base_of(target)
    if not isinstance(a, Scalar) or not isinstance(b, Scalar):
        return same_shape(source, target) or derives(source, target)
    if a == b:
        return True
    if a.integer and b.integer:
        return a.bits <= b.bits
    return b.kind == "real" and (a.integer or a.kind == "real")
