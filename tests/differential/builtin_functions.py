"""What the operators with names do: choices, shifts, conversions, functions of texts."""

from __future__ import annotations

from typing import Any

import typed_tree as tree
from arithmetic import convert, saturate, shift, square_root, wrap
from typed_tree import base_of


def _larger(a: Any, b: Any) -> Any:
    return b if b > a else a


def _smaller(a: Any, b: Any) -> Any:
    return b if b < a else a


def _converted(args: list[Any], e: tree.Builtin) -> Any:
    target = base_of(e.type)
    source = e.taken[0]
    value = args[0]
    if source.unit_ns and target.unit_ns and source != target:
        day = 86_400_000_000_000 // source.unit_ns
        if source in (tree.DT, tree.LDT) and target in (tree.TOD, tree.LTOD):
            value %= day
        elif source in (tree.DT, tree.LDT) and target in (tree.DATE, tree.LDATE):
            value -= value % day
        return wrap(value * source.unit_ns // target.unit_ns, target)
    return convert(value, target)


def _absolute(args: list[Any], e: tree.Builtin) -> Any:
    held = e.held
    return abs(args[0]) if held.kind == "real" else wrap(abs(args[0]), held)


LONGEST = 255
"""Characters the string functions handle."""


def _middle(text: str, length: int, position: int) -> str:
    inside = length >= 1 and 1 <= position <= len(text)
    return text[position - 1 : position - 1 + length] if inside else ""


def _joined(*parts: str) -> str:
    return "".join(parts)[:LONGEST]


def _inserted(text: str, other: str, position: int) -> str:
    if not 0 <= position <= len(text):
        return text
    return _joined(text[:position], other, text[position:])


def _deleted(text: str, length: int, position: int) -> str:
    if length < 1 or not 1 <= position <= len(text):
        return text
    return text[: position - 1] + text[position - 1 + length :]


def _replaced(text: str, other: str, length: int, position: int) -> str:
    if not 1 <= position <= len(text):
        return text
    return _joined(text[: position - 1], other, text[position - 1 + max(length, 0) :])


FUNCTIONS: dict[str, Any] = {
    "MAX": lambda a, e: _larger(a[0], a[1]),
    "MIN": lambda a, e: _smaller(a[0], a[1]),
    "LIMIT": lambda a, e: _smaller(_larger(a[1], a[0]), a[2]),
    "convert": _converted,
    "ABS": _absolute,
    "SQRT": lambda a, e: square_root(a[0], e.held),
    "TRUNC": lambda a, e: saturate(a[0], tree.DINT),
    "LEN": lambda a, e: len(a[0]),
    "FIND": lambda a, e: a[0].find(a[1]) + 1 if a[1] else 0,
    "CONCAT": lambda a, e: _joined(*a),
    "LEFT": lambda a, e: a[0][: max(a[1], 0)],
    "RIGHT": lambda a, e: a[0][-a[1] :] if a[1] > 0 else "",
    "MID": lambda a, e: _middle(*a),
    "INSERT": lambda a, e: _inserted(*a),
    "DELETE": lambda a, e: _deleted(*a),
    "REPLACE": lambda a, e: _replaced(*a),
    "text": lambda a, e: str(a[0]),
}
for _name in ("SHL", "SHR", "ROL", "ROR"):
    FUNCTIONS[_name] = lambda a, e, name=_name: shift(name, a[0], a[1], e.held)
FUNCTIONS |= {
    f"W{name}": FUNCTIONS[name]
    for name in ("LEN", "FIND", "CONCAT", "LEFT", "RIGHT", "MID", "INSERT", "DELETE", "REPLACE")
}
