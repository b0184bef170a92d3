"""Assignments of numbers as C, for a second reference: `gcc -O2 -fwrapv`, every conversion written out."""

from __future__ import annotations

import math
from typing import Any

import typed_tree as tree
from typed_tree import Literal, Scalar, base_of

PRELUDE = """#include <stdint.h>
#include <math.h>
#define DIVISION(T, name) static T div_##name(T a, T b) { return b == (T)-1 ? (T)(0 - a) : a / b; } \\
    static T rem_##name(T a, T b) { return b == (T)-1 ? 0 : a % b; }
#define UDIVISION(T, name) static T div_##name(T a, T b) { return a / b; } \\
    static T rem_##name(T a, T b) { return a % b; }
DIVISION(int32_t, i32) DIVISION(int64_t, i64) UDIVISION(uint32_t, u32) UDIVISION(uint64_t, u64)
#define ROUND(T, name, low, high, top) static T round_##name(double x) { x = round(x); \\
    return x != x ? 0 : x <= (double)(low) ? (low) : x >= top ? (high) : (T)x; }
ROUND(int8_t, i8, INT8_MIN, INT8_MAX, 127.0) ROUND(uint8_t, u8, 0, UINT8_MAX, 255.0)
ROUND(int16_t, i16, INT16_MIN, INT16_MAX, 32767.0) ROUND(uint16_t, u16, 0, UINT16_MAX, 65535.0)
ROUND(int32_t, i32, INT32_MIN, INT32_MAX, 2147483647.0) ROUND(uint32_t, u32, 0, UINT32_MAX, 4294967295.0)
ROUND(int64_t, i64, INT64_MIN, INT64_MAX, 0x1p63) ROUND(uint64_t, u64, 0, UINT64_MAX, 0x1p64)
static uint64_t shifted(int op, uint64_t x, uint64_t n, int bits, int is_signed) {
    uint64_t mask = bits == 64 ? ~0ull : (1ull << bits) - 1;
    x &= mask;
    if (op > 1) {
        n %= bits;
        if (op == 3) n = (bits - n) % bits;
        return n ? (x << n | x >> (bits - n)) & mask : x;
    }
    if (op == 0) return n < bits ? x << n & mask : 0;
    int64_t wide = (int64_t)(x << (64 - bits)) >> (64 - bits);
    if (is_signed) return (uint64_t)(wide >> (n < 63 ? n : 63)) & mask;
    return n < bits ? x >> n : 0;
}
"""
_OPS = {"=": "==", "<>": "!=", "AND": "&", "OR": "|", "XOR": "^", "AND_THEN": "&&", "OR_ELSE": "||"}
_SHIFTS = ("SHL", "SHR", "ROL", "ROR")


def short(type_: Scalar) -> str:
    return f"{'i' if type_.kind == 'signed' else 'u'}{type_.bits}"


def c_type(type_: Scalar) -> str:
    if type_.kind == "real":
        return "float" if type_.bits == 32 else "double"
    return "uint8_t" if type_ == tree.BOOL else f"{'' if type_.kind == 'signed' else 'u'}int{type_.bits}_t"


def literal(type_: Scalar, value: Any) -> str:
    if type_.kind == "real":
        return f"(({c_type(type_)}){'-' if math.copysign(1, value) < 0 else ''}{abs(value).hex()})"
    if type_ == tree.BOOL:
        return str(int(value))
    return f"(({c_type(type_)}){value & (1 << 64) - 1}ull)"


def converted(e: Any, to: Scalar) -> str:
    """An expression where a value of type `to` is needed."""
    text, held = expression(e), e.held
    if to == tree.BOOL:
        return text if held == tree.BOOL else f"({text} != 0)"
    if held.kind == "real" and to.kind != "real":
        return f"round_{short(to)}({text})"
    return f"(({c_type(to)}){text})"


def expression(e: Any) -> str:
    if isinstance(e, Literal):
        return literal(base_of(e.type), e.value)
    if isinstance(e, tree.Name):
        return e.name
    if isinstance(e, tree.Bit):
        return f"({expression(e.base)} >> {e.bit} & 1)"
    if isinstance(e, tree.Unary):
        operand = converted(e.operand, e.held)
        if e.op == "NOT":
            return f"(!{operand})" if e.held == tree.BOOL else f"(({c_type(e.held)})~{operand})"
        return f"(({c_type(e.held)})(-{operand}))"
    if isinstance(e, tree.Binary):
        left, right = converted(e.left, e.computed), converted(e.right, e.computed)
        if e.op in ("/", "MOD") and e.computed.kind != "real":
            return f"{'div' if e.op == '/' else 'rem'}_{short(e.computed)}({left}, {right})"
        kind = c_type(e.held)
        return f"(({kind})({left} {_OPS.get(e.op, e.op)} {right}))"
    return _builtin(e)


def _builtin(e: tree.Builtin) -> str:
    held = e.held
    if e.name == "MUX":
        text = converted(e.args[-1], held)
        number = expression(e.args[0])
        for position in range(len(e.args) - 3, -1, -1):
            text = f"({number} == {position} ? {converted(e.args[1 + position], held)} : {text})"
        return text
    args = [converted(a, t) for a, t in zip(e.args, e.taken, strict=True)]
    if e.name == "SEL":
        return f"({args[0]} ? {args[2]} : {args[1]})"
    if e.name == "convert":
        return converted(Raw(e.taken[0], args[0]), held)
    if e.name == "ABS":
        if held.kind == "real":
            return f"(({c_type(held)})fabs({args[0]}))"
        return f"(({c_type(held)})({args[0]} < 0 ? 0 - {args[0]} : {args[0]}))"
    if e.name == "SQRT":
        return f"sqrt{'f' if held.bits == 32 else ''}({args[0]})"
    if e.name in _SHIFTS:
        signed = int(held.kind == "signed")
        return (
            f"(({c_type(held)})shifted({_SHIFTS.index(e.name)}, {args[0]}, {args[1]}, {held.bits}, {signed}))"
        )
    if e.name == "LIMIT":
        larger = f"({args[0]} > {args[1]} ? {args[0]} : {args[1]})"
        return f"({args[2]} < {larger} ? {args[2]} : {larger})"
    sign = ">" if e.name == "MAX" else "<"
    return f"({args[1]} {sign} {args[0]} ? {args[1]} : {args[0]})"


class Raw(tree.Name):
    """C text with the type of its value."""

    def __init__(self, held: Scalar, text: str) -> None:
        super().__init__(held, held, False, text)


def program(p: tree.Program) -> str:
    """The variables as globals, and `cycle`."""
    lines = [PRELUDE]
    for v in p.variables:
        assert isinstance(v.type, Scalar)
        lines.append(f"{c_type(v.type)} {v.name} = {literal(v.type, v.initial)};")
    lines.append("void cycle(void) {")
    lines += [f"    {s.target.name} = {converted(s.value, s.target.type)};" for s in p.body]
    return "\n".join([*lines, "}", ""])
