"""Formula channels: an IEC expression over other channels, computed for many samples at once in LREAL.

The twin of the editor's `analysis/formula.ts`: the same words, values and faults, by one table of cases
(tests/traces/data). TRUE is 1 and FALSE is 0; where a channel has no value, the formula has none. Precedence
is that of IEC 61131-3, table 71; the values are those of IEEE 754.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np

from tappet.traces.samples import Reals

Node = Callable[[Sequence[Reals]], Reals]
Fault = Literal["empty", "unexpected", "end", "function", "arguments", "tooDeep"]


class FormulaError(ValueError):
    """What is wrong with a formula, and where: `at` from 0, at the token `word`."""

    def __init__(self, fault: Fault, at: int, word: str) -> None:
        super().__init__(_sentence(fault, at, word))
        self.fault = fault
        self.at = at
        self.word = word


def _sentence(fault: Fault, at: int, word: str) -> str:
    match fault:
        case "empty":
            return "the formula is empty"
        case "end":
            return f"something is missing at the end (at {at + 1})"
        case "unexpected":
            return f"'{word}' cannot stand at {at + 1}"
        case "function":
            return f"there is no function '{word}' (at {at + 1}); there are {', '.join(FUNCTIONS)}"
        case "arguments":
            known = FUNCTIONS[word.upper()]
            count = f"{known.least} to {known.most}" if known.least < known.most else f"{known.least}"
            return f"'{word}' takes {count} arguments (at {at + 1})"
        case "tooDeep":
            return f"the formula is nested too deeply (at {at + 1}); at most {_MOST_DEPTH} levels"


class _Call(NamedTuple):
    least: int
    most: int
    of: Callable[..., Reals]


def _one(of: Callable[[Reals], Reals]) -> _Call:
    return _Call(1, 1, of)


def _fold(of: Callable[[Reals, Reals], Reals]) -> Callable[..., Reals]:
    def folded(first: Reals, *rest: Reals) -> Reals:
        for one in rest:
            first = of(first, one)
        return first

    return folded


def _smaller(one: Reals, other: Reals) -> Reals:
    """As IEEE 754-2019 minimum: no value where one has none, and -0 is less than 0."""
    return np.asarray(np.where(one == other, np.where(np.signbit(one), one, other), np.minimum(one, other)))


def _larger(one: Reals, other: Reals) -> Reals:
    return -_smaller(-one, -other)


def _truth(value: object) -> Reals:
    return np.asarray(value, np.float64)


def _select(choice: Reals, zero: Reals, other: Reals) -> Reals:
    return np.asarray(np.where((choice != 0) & ~np.isnan(choice), other, zero), np.float64)


FUNCTIONS = {
    "ABS": _one(np.abs), "SQRT": _one(np.sqrt), "LN": _one(np.log), "LOG": _one(np.log10),
    "EXP": _one(np.exp), "SIN": _one(np.sin), "COS": _one(np.cos), "TAN": _one(np.tan),
    "ASIN": _one(np.arcsin), "ACOS": _one(np.arccos), "ATAN": _one(np.arctan), "TRUNC": _one(np.trunc),
    "FLOOR": _one(np.floor), "CEIL": _one(np.ceil), "SGN": _one(np.sign),
    "ATAN2": _Call(2, 2, np.arctan2), "EXPT": _Call(2, 2, np.power), "SEL": _Call(3, 3, _select),
    "MIN": _Call(2, 64, _fold(_smaller)), "MAX": _Call(2, 64, _fold(_larger)),
    "LIMIT": _Call(3, 3, lambda low, value, high: _smaller(_larger(value, low), high)),
}  # fmt: skip
_CONSTANTS = {"TRUE": 1.0, "FALSE": 0.0, "PI": float(np.pi)}
_LEVELS: tuple[dict[str, Callable[[Reals, Reals], Reals]], ...] = (
    {"OR": lambda a, b: _truth((a != 0) | (b != 0))},
    {"XOR": lambda a, b: _truth((a != 0) != (b != 0))},
    {"AND": lambda a, b: _truth((a != 0) & (b != 0)), "&": lambda a, b: _truth((a != 0) & (b != 0))},
    {"=": lambda a, b: _truth(a == b), "<>": lambda a, b: _truth(a != b)},
    {
        "<": lambda a, b: _truth(a < b),
        ">": lambda a, b: _truth(a > b),
        "<=": lambda a, b: _truth(a <= b),
        ">=": lambda a, b: _truth(a >= b),
    },
    {"+": np.add, "-": np.subtract},
    {"*": np.multiply, "/": np.divide, "MOD": np.fmod},
    {"**": np.power},
)
"""Operators from loose to tight."""
_OPERATORS = {word: (number, act) for number, level in enumerate(_LEVELS) for word, act in level.items()}
_WORDS = {"OR", "XOR", "AND", "MOD", "NOT"}
_MOST_DEPTH = 50
"""Of brackets and signs: the parser calls itself up to eleven times a level."""
_TOKEN = re.compile(
    r"\s*(?:(?P<number>16#[0-9A-Fa-f][0-9A-Fa-f_]*|8#[0-7][0-7_]*|2#[01][01_]*|\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?)"
    r"|(?P<name>(?u:[^\W\d]\w*)(?:\^?(?:\s*\.\s*(?u:\w+)|\s*\[[^\]\[]*(?:\[[^\]]*\][^\]\[]*)*\]))*\^?)"
    r"|(?P<sign>\*\*|<=|>=|<>|[-+*/()<>=,&])|(?P<end>\Z)|(?P<other>.))",
    re.ASCII | re.DOTALL,
)


def channel_key(name: str) -> str:
    """As names are compared: without spaces, in capitals."""
    return re.sub(r"\s+", "", name, flags=re.ASCII).upper()


class Formula:
    """A formula that was read. FormulaError with what is wrong."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._depth = 0
        self.channels: list[str] = []
        """Keys of the channels it is over, each once."""
        self.spelt: list[tuple[str, int]] = []
        """As they are first written, and where, from 0."""
        self._next()
        if self._kind == "end":
            raise FormulaError("empty", 0, "")
        self._root = self._expression()
        if self._kind != "end":
            raise self._unexpected()

    def values(self, channels: Sequence[Reals]) -> Reals:
        """For samples of `channels`, in their order."""
        shape = channels[0].shape if channels else (1,)
        with np.errstate(all="ignore"):
            found = np.array(np.broadcast_to(self._root(channels), shape))
        for one in channels:
            found[np.isnan(one)] = np.nan
        return found

    def _next(self) -> None:
        match = _TOKEN.match(self._text, self._at)
        assert match is not None  # any character is a token
        self._kind = str(match.lastgroup)
        self._word = match[self._kind]
        self._begin = match.start(self._kind)
        self._at = match.end()

    @property
    def _upper(self) -> str:
        return "" if self._kind == "number" else self._word.upper()

    def _unexpected(self) -> FormulaError:
        return FormulaError("end" if self._kind == "end" else "unexpected", self._begin, self._word)

    def _deeper(self, read: Callable[[], Node]) -> Node:
        if self._depth >= _MOST_DEPTH:
            raise FormulaError("tooDeep", self._begin, self._word)
        self._depth += 1
        node = read()
        self._depth -= 1
        return node

    def _expression(self, least: int = 0) -> Node:
        """Operators that bind at least so tight."""
        first, steps = self._prefix(), []
        while (operator := _OPERATORS.get(self._upper)) is not None and operator[0] >= least:
            self._next()
            steps.append((operator[1], self._expression(operator[0] + 1)))
        return _chain(first, steps) if steps else first

    def _prefix(self) -> Node:
        sign = self._upper
        if sign not in ("-", "+", "NOT"):
            return self._atom()
        self._next()
        of = self._deeper(self._prefix)
        if sign == "+":
            return of
        return (lambda values: -of(values)) if sign == "-" else (lambda values: _truth(of(values) == 0))

    def _atom(self) -> Node:
        kind, word = self._kind, self._word
        if kind == "number":
            self._next()
            base, _, digits = word.replace("_", "").rpartition("#")
            number = _truth(_whole(digits, int(base)) if base else float(digits))
            return lambda _: number
        if word == "(":
            self._next()
            inner = self._deeper(self._expression)
            self._close()
            return inner
        if kind != "name" or word.upper() in _WORDS:
            raise self._unexpected()
        begin = self._begin
        self._next()
        if self._word == "(":
            return self._call(word, begin)
        constant = _CONSTANTS.get(word.upper())
        if constant is not None:
            return lambda _: _truth(constant)
        key = channel_key(word)
        if key not in self.channels:
            self.channels.append(key)
            self.spelt.append((word, begin))
        place = self.channels.index(key)
        return lambda values: values[place]

    def _close(self) -> None:
        if self._word != ")":
            raise self._unexpected()
        self._next()

    def _call(self, name: str, begin: int) -> Node:
        known = FUNCTIONS.get(name.upper())
        if known is None:
            raise FormulaError("function", begin, name)
        given: list[Node] = []
        while not given or self._word == ",":
            self._next()
            given.append(self._deeper(self._expression))
        self._close()
        if not known.least <= len(given) <= known.most:
            raise FormulaError("arguments", begin, name)
        return lambda values: known.of(*(one(values) for one in given))


def _whole(digits: str, base: int) -> float:
    """The nearest LREAL; beyond the largest one infinite, as a decimal number is."""
    try:
        return float(int(digits, base))
    except OverflowError:
        return float("inf")


def _chain(first: Node, steps: Sequence[tuple[Callable[[Reals, Reals], Reals], Node]]) -> Node:
    """From left to right, in a loop: a long sum needs no deep stack."""

    def values(channels: Sequence[Reals]) -> Reals:
        found = first(channels)
        for act, right in steps:
            found = act(found, right(channels))
        return found

    return values
