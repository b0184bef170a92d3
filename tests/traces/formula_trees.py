"""Random formulas with their values by Python's own scalar arithmetic: what both evaluators are held against.

`python tests/traces/formula_trees.py` writes `data/formula_random.json`, which the test of the editor's
`kinds/trace/analysis/formula.ts` reads, too.
"""

from __future__ import annotations

import json
import math
import random
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, Protocol

CHANNELS = {"x": 2.5, "y": -3.0, "zero": 0.0, "one": 1.0, "big": 1e200, "minus": -0.0}
FILE = Path(__file__).parent / "data" / "formula_random.json"
COUNT = 600
ATOM, PREFIX = 9, 8


class Tree(NamedTuple):
    """A formula, how tight its outermost operator binds (table 71 of IEC 61131-3), its value, and whether all
    operations of it are correctly rounded (those of IEEE 754), so that any machine has the same bits."""

    text: str
    binds: int
    value: float
    exact: bool

    def within(self, least: int) -> str:
        """As an operand of an operator that binds so."""
        return self.text if self.binds >= least else f"({self.text})"


class Source(Protocol):
    """Where choices come from: `random.Random`, or hypothesis."""

    def randrange(self, stop: int) -> int: ...


def _divided(a: float, b: float) -> float:
    if b != 0 or math.isnan(a):
        return a / b if b != 0 else math.nan
    return math.nan if a == 0 else math.copysign(math.inf, a) * math.copysign(1.0, b)


def _remainder(a: float, b: float) -> float:
    return math.nan if math.isinf(a) or b == 0 else math.fmod(a, b)


def _odd(value: float) -> bool:
    return math.isfinite(value) and math.fmod(value, 2) in (1.0, -1.0)


def power(a: float, b: float) -> float:
    """IEEE 754-2019 9.2.1 pow; Python raises where that has an infinity or no value."""
    try:
        return math.pow(a, b)
    except OverflowError:
        return -math.inf if a < 0 and _odd(b) else math.inf
    except ValueError:
        if a != 0:
            return math.nan
        return math.copysign(math.inf, a) if _odd(b) else math.inf


def _or_none(of: Callable[[float], float], at_zero: float = math.nan) -> Callable[[float], float]:
    def value(a: float) -> float:
        try:
            return of(a)
        except OverflowError:
            return math.inf
        except ValueError:
            return at_zero if a == 0 else math.nan

    return value


def _rounded(of: Callable[[float], int]) -> Callable[[float], float]:
    return lambda a: math.copysign(float(of(a)), a) if math.isfinite(a) else a


def _sign(a: float) -> float:
    return a if a == 0 or math.isnan(a) else math.copysign(1.0, a)


def _least(*values: float) -> float:
    if any(map(math.isnan, values)):
        return math.nan
    return min(values, key=lambda value: (value, math.copysign(1.0, value)))


def _largest(*values: float) -> float:
    return -_least(*(-value for value in values))


BINARY: list[tuple[str, int, Callable[[float, float], float], bool]] = [
    ("OR", 0, lambda a, b: float(a != 0 or b != 0), True),
    ("XOR", 1, lambda a, b: float((a != 0) != (b != 0)), True),
    ("AND", 2, lambda a, b: float(a != 0 and b != 0), True),
    ("&", 2, lambda a, b: float(a != 0 and b != 0), True),
    ("=", 3, lambda a, b: float(a == b), True),
    ("<>", 3, lambda a, b: float(a != b), True),
    ("<", 4, lambda a, b: float(a < b), True),
    (">", 4, lambda a, b: float(a > b), True),
    ("<=", 4, lambda a, b: float(a <= b), True),
    (">=", 4, lambda a, b: float(a >= b), True),
    ("+", 5, lambda a, b: a + b, True),
    ("-", 5, lambda a, b: a - b, True),
    ("*", 6, lambda a, b: a * b, True),
    ("/", 6, _divided, True),
    ("MOD", 6, _remainder, True),
    ("**", 7, power, False),
]
UNARY: list[tuple[str, Callable[[float], float]]] = [
    ("-", lambda a: -a),
    ("+", lambda a: a),
    ("NOT ", lambda a: float(a == 0)),
]
ONE: list[tuple[str, Callable[[float], float], bool]] = [
    ("ABS", abs, True),
    ("SQRT", _or_none(math.sqrt), True),
    ("TRUNC", _rounded(math.trunc), True),
    ("FLOOR", _rounded(math.floor), True),
    ("CEIL", _rounded(math.ceil), True),
    ("SGN", _sign, True),
    ("LN", _or_none(math.log, -math.inf), False),
    ("LOG", _or_none(math.log10, -math.inf), False),
    ("EXP", _or_none(math.exp), False),
    ("SIN", _or_none(math.sin), False),
    ("COS", _or_none(math.cos), False),
    ("TAN", _or_none(math.tan), False),
    ("ASIN", _or_none(math.asin), False),
    ("ACOS", _or_none(math.acos), False),
    ("ATAN", math.atan, False),
]
LITERALS: list[tuple[str, float]] = [
    ("0", 0.0), ("1", 1.0), ("2", 2.0), ("0.5", 0.5), ("1_000", 1000.0), ("1.5e1", 15.0), ("16#FF", 255.0),
    ("8#17", 15.0), ("2#101", 5.0), ("1e400", math.inf), ("TRUE", 1.0), ("false", 0.0), ("PI", math.pi),
]  # fmt: skip


def tree(source: Source, depth: int) -> Tree:
    """A formula of at most so many levels."""
    kind = source.randrange(10) if depth else source.randrange(2)
    if kind == 0:
        text, value = LITERALS[source.randrange(len(LITERALS))]
        return Tree(text, ATOM, value, True)
    if kind == 1:
        name = list(CHANNELS)[source.randrange(len(CHANNELS))]
        return Tree(name.upper() if source.randrange(2) else name, ATOM, CHANNELS[name], True)
    if kind == 2:
        sign, act = UNARY[source.randrange(len(UNARY))]
        of = tree(source, depth - 1)
        return Tree(f"{sign}{of.within(PREFIX)}", PREFIX, act(of.value), of.exact)
    if kind == 3:
        name, call, exact = ONE[source.randrange(len(ONE))]
        of = tree(source, depth - 1)
        return Tree(f"{name}({of.text})", ATOM, call(of.value), exact and of.exact)
    if kind == 4:
        return _several(source, depth)
    operator, binds, join, exact = BINARY[source.randrange(len(BINARY))]
    left, right = tree(source, depth - 1), tree(source, depth - 1)
    text = f"{left.within(binds)} {operator} {right.within(binds + 1)}"
    return Tree(text, binds, join(left.value, right.value), exact and left.exact and right.exact)


def _several(source: Source, depth: int) -> Tree:
    """A call with more than one argument."""
    name = ("MIN", "Max", "LIMIT", "SEL", "ATAN2", "expt")[source.randrange(6)]
    count = {"LIMIT": 3, "SEL": 3, "MIN": 2 + source.randrange(3)}.get(name, 2)
    given = [tree(source, depth - 1) for _ in range(count)]
    values = [one.value for one in given]
    text = f"{name}({', '.join(one.text for one in given)})"
    exact = all(one.exact for one in given) and name not in ("ATAN2", "expt")
    match name:
        case "MIN":
            found = _least(*values)
        case "Max":
            found = _largest(*values)
        case "LIMIT":
            found = _least(_largest(values[1], values[0]), values[2])
        case "SEL":
            found = values[2] if values[0] != 0 and not math.isnan(values[0]) else values[1]
        case "ATAN2":
            found = math.atan2(*values)
        case _:
            found = power(*values)
    return Tree(text, ATOM, found, exact)


def same(found: float, expected: Tree) -> bool:
    """Bit by bit, also the sign of zero, where all is correctly rounded."""
    if math.isnan(expected.value) or math.isnan(found):
        return math.isnan(expected.value) and math.isnan(found)
    return found == expected.value and math.copysign(1, found) == math.copysign(1, expected.value)


def rows(count: int = COUNT) -> list[list[str]]:
    """Text and value of random formulas that are the same on any machine; few of them have no value."""
    source = random.Random(71)
    found: dict[str, str] = {}
    while len(found) < count:
        one = tree(source, 4)
        if one.exact and len(one.text) > 8 and (not math.isnan(one.value) or len(found) % 8 == 0):
            found[one.text] = repr(one.value)
    return [list(pair) for pair in found.items()]


def written() -> str:
    """The file."""
    cases = ",\n    ".join(json.dumps(row) for row in rows())
    channels = json.dumps({name: repr(value) for name, value in CHANNELS.items()})
    return f'{{\n  "channels": {channels},\n  "cases": [\n    {cases}\n  ]\n}}\n'


if __name__ == "__main__":
    FILE.write_text(written(), encoding="utf-8")
