"""Random typed expressions with their values by numpy's scalars, for both evaluators of watch lists.

`python tests/runtime/watch_trees.py` writes `data/watch_random.json`, which the test of the browser's
`online/computed` reads, too.
"""

from __future__ import annotations

import json
import math
import random
import sys
from collections.abc import Callable
from contextlib import suppress
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from iec_numbers import (
    DATES,
    INTEGERS,
    NUMPY,
    REALS,
    TIMES,
    ImpossibleError,
    common,
    computed_by,
    fits,
    real_of,
    smallest,
    wrapped,
)

FILE = Path(__file__).parent / "data" / "watch_random.json"
COUNT = 500
DECLARATION: list[tuple[str, str, str]] = [
    ("si", "SINT", "-128"), ("sj", "SINT", "7"), ("i", "INT", "32767"), ("j", "INT", "-2"),
    ("d", "DINT", "2147483647"), ("e", "DINT", "-3"), ("l", "LINT", "9223372036854775807"),
    ("m", "LINT", "-9223372036854775808"), ("us", "USINT", "255"), ("u", "UINT", "65535"), ("v", "UINT", "0"),
    ("ud", "UDINT", "4294967295"), ("ul", "ULINT", "18446744073709551615"),
    ("um", "ULINT", "9007199254740993"),
    ("by", "BYTE", "16#A5"), ("w", "WORD", "16#8001"), ("dw", "DWORD", "16#80000001"),
    ("lw", "LWORD", "16#8000000000000001"), ("r", "REAL", "0.1"), ("s", "REAL", "16777216.0"),
    ("lr", "LREAL", "-2.5"), ("zero", "LREAL", "0.0"), ("on", "BOOL", "TRUE"), ("off", "BOOL", "FALSE"),
    ("t", "TIME", "T#1s500ms"), ("tm", "TIME", "T#49d17h2m47s295ms"), ("lt", "LTIME", "LTIME#1us"),
    ("day", "DATE", "D#2024-02-29"), ("tod", "TOD", "TOD#12:30:00.5"), ("dt", "DT", "DT#2024-02-29-12:30:00"),
    ("ld", "LDATE", "LDATE#2024-02-29"), ("ltod", "LTOD", "LTOD#12:30:00.000000001"),
    ("ldt", "LDT", "LDT#2024-02-29-12:30:00.5"),
]  # fmt: skip
_DAY = 19_782  # of 2024-02-29 since 1970
_NOON = 45_000  # seconds at half past twelve
_VALUES: dict[str, int] = {
    "t": 1500, "tm": 2**32 - 1, "lt": 1000, "day": _DAY * 86_400, "tod": _NOON * 1000 + 500,
    "dt": _DAY * 86_400 + _NOON, "ld": _DAY * 86_400 * 10**9, "ltod": _NOON * 10**9 + 1,
    "ldt": (_DAY * 86_400 + _NOON) * 10**9 + 500_000_000,
}  # fmt: skip
LITERALS: list[tuple[str, str | None, int | float]] = [
    ("0", None, 0), ("1", None, 1), ("3", None, 3), ("200", None, 200), ("16#FFFF", None, 65535),
    ("1.5", None, 1.5), ("1e-3", None, 0.001), ("INT#-5", "INT", -5), ("UINT#16#FF00", "UINT", 65280),
    ("BYTE#2#1010", "BYTE", 10), ("REAL#1.1", "REAL", float(np.float32(1.1))), ("LREAL#2", "LREAL", 2.0),
    ("TRUE", "BOOL", 1), ("T#1m0.5s", "TIME", 60_500), ("LTIME#1ms1ns", "LTIME", 1_000_001),
    ("TOD#12:30:00.5", "TOD", 45_000_500),
]  # fmt: skip
ATOM, PREFIX = 9, 8
RANKS = {
    "OR": 1, "OR_ELSE": 1, "XOR": 2, "AND": 3, "&": 3, "AND_THEN": 3, "=": 4, "<>": 4, "<": 5, ">": 5,
    "<=": 5, ">=": 5, "+": 6, "-": 6, "*": 7, "/": 7, "MOD": 7,
}  # fmt: skip
COMPARISONS: dict[str, Callable[[Any, Any], bool]] = {
    "=": lambda a, b: a == b, "<>": lambda a, b: a != b, "<": lambda a, b: a < b, ">": lambda a, b: a > b,
    "<=": lambda a, b: a <= b, ">=": lambda a, b: a >= b,
}  # fmt: skip


class Tree(NamedTuple):
    """An expression; `value` None where a whole number is divided by zero."""

    text: str
    binds: int
    type: str
    held: str
    value: int | float | None
    untyped: bool = False

    def within(self, least: int) -> str:
        """As an operand of an operator that binds so."""
        return self.text if self.binds >= least else f"({self.text})"


class Source(Protocol):
    """Where choices come from: `random.Random`, or hypothesis."""

    def randrange(self, stop: int) -> int: ...


def _in(tree: Tree, type_: str) -> int | float | None:
    if tree.value is None:
        return None
    return real_of(tree.value, type_) if type_ in REALS else wrapped(int(tree.value), type_)


def _adapted(tree: Tree, other: Tree) -> Tree:
    """A literal without a type takes the type of the other side where that holds it."""
    if not tree.untyped or other.untyped:
        return tree
    assert tree.value is not None
    if not fits(tree.value, other.type):
        return tree
    value = real_of(tree.value, other.type) if other.type in REALS else tree.value
    return tree._replace(type=other.type, held=other.type, value=value, untyped=False)


def combine(op: str, left: Tree, right: Tree) -> Tree:
    """Two operands and what stands between them; ImpossibleError for what is refused."""
    text = f"{left.within(RANKS[op])} {op} {right.within(RANKS[op] + 1)}"
    made = _Made(text, RANKS[op])
    if op in ("AND_THEN", "OR_ELSE"):
        if left.type != "BOOL" or right.type != "BOOL":
            raise ImpossibleError
        decided = left.value == (0 if op == "AND_THEN" else 1) or left.value is None
        return made.of("BOOL", left.value if decided else right.value)
    if left.untyped and right.untyped:
        raise ImpossibleError  # both evaluators fold these without limits; the written table has them
    if op in ("AND", "OR", "XOR", "&"):
        return _logic(made, op, left, right)
    if op in COMPARISONS:
        return _compared(made, op, left, right)
    if left.type in TIMES | DATES or right.type in TIMES | DATES:
        return _times(made, op, left, right)
    left, right = _adapted(left, right), _adapted(right, left)
    result, computed = common(left.type, right.type)
    if op == "MOD" and computed in REALS:
        raise ImpossibleError
    a, b = _in(left, computed), _in(right, computed)
    missing = a is None or b is None
    return made.of(result, None if missing else computed_by(op, a, b, computed), computed)


class _Made(NamedTuple):
    text: str
    binds: int

    def of(self, type_: str, value: int | float | None, held: str | None = None) -> Tree:
        return Tree(self.text, self.binds, type_, held or type_, value)


def _logic(made: _Made, op: str, left: Tree, right: Tree) -> Tree:
    left, right = _adapted(left, right), _adapted(right, left)
    for side, other in ((left, right), (right, left)):
        if side.untyped and other.type == "BOOL" and side.value not in (0, 1):
            raise ImpossibleError
    if "BOOL" in (left.type, right.type):
        if not all(side.type == "BOOL" or (side.untyped and side.value in (0, 1)) for side in (left, right)):
            raise ImpossibleError
        if any(isinstance(side.value, float) for side in (left, right)):
            raise ImpossibleError
        result = "BOOL"
    elif left.type in INTEGERS and right.type in INTEGERS:
        sizes = INTEGERS[left.type][1], INTEGERS[right.type][1]
        wide = left.type if sizes[0] >= sizes[1] else right.type
        is_bits = sizes[0] == sizes[1] and INTEGERS[right.type][0] == "bits"
        result = right.type if is_bits else wide
        if any(side.untyped and not fits(side.value or 0, result) for side in (left, right)):
            raise ImpossibleError
    else:
        raise ImpossibleError
    a, b = _in(left, result), _in(right, result)
    if a is None or b is None:
        return made.of(result, None)
    a, b = int(a), int(b)
    return made.of(result, wrapped({"OR": a | b, "XOR": a ^ b}.get(op, a & b), result))


def _compared(made: _Made, op: str, left: Tree, right: Tree) -> Tree:
    if left.type == right.type and (left.type == "BOOL" or left.type in TIMES | DATES):
        if left.type == "BOOL" and op not in ("=", "<>"):
            raise ImpossibleError
        a, b = left.value, right.value
    else:
        left, right = _adapted(left, right), _adapted(right, left)
        _, computed = common(left.type, right.type)
        a, b = _in(left, computed), _in(right, computed)
    missing = a is None or b is None
    return made.of("BOOL", None if missing else int(COMPARISONS[op](a, b)))


def _times(made: _Made, op: str, left: Tree, right: Tree) -> Tree:
    if op == "*" and right.type in TIMES:
        left, right = right, left
    if left.type not in TIMES:
        raise ImpossibleError
    missing = left.value is None or right.value is None
    if (left.type == right.type and op in "+-") or (right.type in INTEGERS and op == "*"):
        b = right.value
    elif op == "/" and _is_unsigned(right):
        b = _in(right, right.type)
    else:
        raise ImpossibleError
    return made.of(left.type, None if missing else computed_by(op, left.value, b, left.type))


def _is_unsigned(tree: Tree) -> bool:
    if tree.untyped:
        return isinstance(tree.value, int)
    return tree.type in INTEGERS and INTEGERS[tree.type][0] != "signed"


def prefixed(op: str, of: Tree) -> Tree:
    """NOT or a minus."""
    made = _Made(f"{op}{of.within(PREFIX)}", PREFIX)
    if of.untyped:
        raise ImpossibleError
    if op == "NOT ":
        if of.type == "BOOL":
            return made.of("BOOL", None if of.value is None else 1 - int(of.value))
        if of.type not in INTEGERS:
            raise ImpossibleError
        value = _in(of, of.type)
        return made.of(of.type, None if value is None else wrapped(~int(value), of.type))
    if of.type in REALS:
        return made.of(of.type, None if of.value is None else -of.value)
    if of.type not in INTEGERS:
        raise ImpossibleError
    family, bits = INTEGERS[of.type]
    held = "DINT" if bits < 32 else "LINT" if bits == 32 and family != "signed" else of.type
    value = _in(of, held)
    return made.of(of.type, None if value is None else wrapped(-int(value), held), held)


def call(name: str, given: list[Tree]) -> Tree:
    """ABS, SQRT, MIN, MAX."""
    made = _Made(f"{name}({', '.join(one.text for one in given)})", ATOM)
    first = given[0]
    if name in ("ABS", "SQRT"):
        if first.untyped or not (first.type in INTEGERS or first.type in REALS):
            raise ImpossibleError
        if name == "ABS":
            value = _in(first, first.type)
            found = None if value is None else abs(value)
            return made.of(first.type, wrapped(found, first.type) if isinstance(found, int) else found)
        type_ = first.type if first.type in REALS else "LREAL"
        root = _in(first, type_)
        with np.errstate(invalid="ignore"):
            return made.of(type_, None if root is None else float(np.sqrt(NUMPY[type_](root))))
    left, right = given
    if left.untyped and right.untyped:
        raise ImpossibleError
    if left.type == right.type and left.type in TIMES | DATES:
        result = computed = left.type
        a, b = left.value, right.value
    else:
        left, right = _adapted(left, right), _adapted(right, left)
        result, computed = common(left.type, right.type)
        a, b = _in(left, computed), _in(right, computed)
    if a is None or b is None:
        return made.of(result, None, computed)
    takes = b < a if name == "MIN" else b > a
    return made.of(result, b if takes else a, computed)


def variable(name: str) -> Tree:
    """A declared one."""
    type_, literal = next((type_, literal) for own, type_, literal in DECLARATION if own == name)
    value: int | float
    if type_ == "BOOL":
        value = int(literal == "TRUE")
    elif type_ in REALS:
        value = real_of(float(literal), type_)
    else:
        value = _VALUES.get(name, 0) or int(literal.removeprefix("16#"), 16 if "#" in literal else 10)
    return Tree(f"PLC_PRG.{name}", ATOM, type_, type_, value)


def tree(source: Source, depth: int) -> Tree:
    """An expression of at most so many levels; ImpossibleError where the types drawn do not meet."""
    kind = source.randrange(12) if depth else source.randrange(4)
    if kind == 0:
        text, type_, value = LITERALS[source.randrange(len(LITERALS))]
        found = type_ or smallest(value)
        return Tree(text, ATOM, found, found, value, type_ is None)
    if kind < 4:
        return variable(DECLARATION[source.randrange(len(DECLARATION))][0])
    if kind == 4:
        return prefixed(("-", "NOT ")[source.randrange(2)], tree(source, depth - 1))
    if kind == 5:
        name = ("ABS", "SQRT", "MIN", "MAX")[source.randrange(4)]
        return call(name, [tree(source, depth - 1) for _ in range(1 if name in ("ABS", "SQRT") else 2)])
    op = list(RANKS)[source.randrange(len(RANKS))]
    return combine(op, tree(source, depth - 1), tree(source, depth - 1))


def shown(value: int | float | None, type_: str) -> str | None:
    """As JSON carries it, exact."""
    if value is None:
        return None
    if type_ == "BOOL":
        return "true" if value else "false"
    if isinstance(value, float):
        return (
            repr(value)
            if math.isfinite(value)
            else {math.inf: "Infinity", -math.inf: "-Infinity"}.get(value, "NaN")
        )
    return str(value)


def _row(one: Tree) -> list[str | None]:
    return [one.text, one.held, shown(one.value, one.held)]


def rows(count: int = COUNT) -> list[list[str | None]]:
    """The operators in turn between variables of all types where they are possible, divisions by zero, and
    random expressions."""
    firsts = {type_: variable(name) for name, type_, _ in reversed(DECLARATION)}
    operators = list(RANKS)
    wanted: list[tuple[list[str], Tree, Tree]] = []
    for number, (left, right) in enumerate(product(firsts.values(), repeat=2)):
        at = number % len(operators)
        wanted.append((operators[at:] + operators[:at], left, right))
    wanted += [([op], left, variable("v")) for op in ("/", "MOD") for left in firsts.values()]
    found: dict[str, list[str | None]] = {}
    for possible, left, right in wanted:
        for op in possible:
            with suppress(ImpossibleError):
                one = combine(op, left, right)
                found[one.text] = _row(one)
                break
    source = random.Random(12)
    total = len(found) + count
    while len(found) < total:
        with suppress(ImpossibleError):
            one = tree(source, 4)
            if one.binds < ATOM:
                found[one.text] = _row(one)
    return list(found.values())


def written() -> str:
    """The file."""
    cases = ",\n    ".join(json.dumps(row) for row in rows())
    declaration = ",\n    ".join(json.dumps(one) for one in DECLARATION)
    return f'{{\n  "declaration": [\n    {declaration}\n  ],\n  "cases": [\n    {cases}\n  ]\n}}\n'


if __name__ == "__main__":
    FILE.write_text(written(), encoding="utf-8")
