"""Formula channels: an IEC expression over other channels, computed for many samples at once in LREAL.

The twin of the editor's `analysis/formula.ts`: the same words, the same values. TRUE is 1 and FALSE is 0;
where a channel has no value, the formula has none. Precedence is that of IEC 61131-3, table 71.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from tappet.project.trace import TraceData
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Flags, Integers, Reals, Samples, reduced

Node = Callable[[Sequence[Reals]], Reals]


class FormulaError(ValueError):
    """What is wrong with a formula, and where."""


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
    "MIN": _Call(2, 64, _fold(np.minimum)), "MAX": _Call(2, 64, _fold(np.maximum)),
    "LIMIT": _Call(3, 3, lambda low, value, high: np.minimum(np.maximum(value, low), high)),
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
_MOST_DEPTH = 100
_TOO_DEEP = "the formula is nested too deeply"
_TOKEN = re.compile(
    r"\s*(?:(?P<number>16#[0-9A-Fa-f_]+|8#[0-7_]+|2#[01_]+|\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*(?:\^?(?:\s*\.\s*\w+|\s*\[[^\]\[]*(?:\[[^\]]*\][^\]\[]*)*\]))*\^?)"
    r"|(?P<sign>\*\*|<=|>=|<>|[-+*/()<>=,&])|(?P<end>$))",
    re.ASCII,
)


def channel_key(name: str) -> str:
    """As names are compared: without spaces, in capitals."""
    return re.sub(r"\s+", "", name).upper()


class Formula:
    """A formula that was read. FormulaError with what is wrong."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._depth = 0
        self.channels: list[str] = []
        """Keys of the channels it is over, each once."""
        self._next()
        if self._kind == "end":
            raise FormulaError("the formula is empty")
        try:
            self._root = self._expression()
        except RecursionError:
            raise FormulaError(_TOO_DEEP) from None
        if self._kind != "end":
            raise self._unexpected()

    def values(self, channels: Sequence[Reals]) -> Reals:
        """For samples of `channels`, in their order."""
        shape = channels[0].shape if channels else (1,)
        try:
            with np.errstate(all="ignore"):
                found = np.array(np.broadcast_to(self._root(channels), shape))
        except RecursionError:
            raise FormulaError(_TOO_DEEP) from None
        for one in channels:
            found[np.isnan(one)] = np.nan
        return found

    def _next(self) -> None:
        match = _TOKEN.match(self._text, self._at)
        if match is None:
            raise FormulaError(f"'{self._text[self._at :].lstrip()[:1]}' cannot stand at {self._at + 1}")
        self._kind = str(match.lastgroup)
        self._word = match[self._kind]
        self._begin = match.start(self._kind)
        self._at = match.end()

    @property
    def _upper(self) -> str:
        return "" if self._kind == "number" else self._word.upper()

    def _unexpected(self) -> FormulaError:
        what = "the end" if self._kind == "end" else f"'{self._word}'"
        return FormulaError(f"{what} cannot stand at {self._begin + 1}")

    def _deeper(self, read: Callable[[], Node]) -> Node:
        if self._depth >= _MOST_DEPTH:
            raise FormulaError(_TOO_DEEP)
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
            number = _truth(int(digits, int(base)) if base else float(digits))
            return lambda _: number
        if word == "(":
            self._next()
            inner = self._deeper(self._expression)
            self._close()
            return inner
        if kind != "name" or word.upper() in _WORDS:
            raise self._unexpected()
        self._next()
        if self._word == "(":
            return self._call(word)
        constant = _CONSTANTS.get(word.upper())
        if constant is not None:
            return lambda _: _truth(constant)
        key = channel_key(word)
        if key not in self.channels:
            self.channels.append(key)
        place = self.channels.index(key)
        return lambda values: values[place]

    def _close(self) -> None:
        if self._word != ")":
            raise self._unexpected()
        self._next()

    def _call(self, name: str) -> Node:
        known = FUNCTIONS.get(name.upper())
        if known is None:
            raise FormulaError(f"there is no function '{name}'")
        given: list[Node] = []
        while not given or self._word == ",":
            self._next()
            given.append(self._deeper(self._expression))
        self._close()
        if not known.least <= len(given) <= known.most:
            raise FormulaError(f"'{name}' takes {known.least} to {known.most} values")
        return lambda values: known.of(*(one(values) for one in given))


def _chain(first: Node, steps: Sequence[tuple[Callable[[Reals, Reals], Reals], Node]]) -> Node:
    """From left to right, in a loop: a long sum needs no deep stack."""

    def values(channels: Sequence[Reals]) -> Reals:
        found = first(channels)
        for act, right in steps:
            found = act(found, right(channels))
        return found

    return values


class WithFormulas:
    """Samples with further channels that are computed of theirs, block by block.

    A formula that cannot be read, or is over what was not recorded, has no values.
    """

    def __init__(
        self, samples: Samples, names: Sequence[str], formulas: Sequence[tuple[int, str, str]]
    ) -> None:
        """`names` of the channels of `samples` in formulas; number, name and text of each formula."""
        self._samples = samples
        self._places = {channel_key(name): number for number, name in enumerate(names)}
        self._formulas = [self._read(text) for _, _, text in formulas]
        extra = [ChannelInfo(index, name, "LREAL", "f8") for index, name, _ in formulas]
        self.channels = [*samples.channels, *extra]

    def _read(self, text: str) -> Formula | None:
        try:
            formula = Formula(text)
        except FormulaError:
            return None
        return formula if all(key in self._places for key in formula.channels) else None

    @property
    def count(self) -> int:
        """How many there are."""
        return self._samples.count

    def times(self, start: int, stop: int) -> Integers:
        """Unix times in ns."""
        return self._samples.times(start, stop)

    def cycles(self, start: int, stop: int) -> Integers:
        """Numbers of the cycles."""
        return self._samples.cycles(start, stop)

    def gaps(self, start: int, stop: int) -> Flags:
        """1 where samples are missing before."""
        return self._samples.gaps(start, stop)

    def times_at(self, numbers: Integers) -> Integers:
        """Unix times of single samples."""
        return self._samples.times_at(numbers)

    def gaps_at(self, numbers: Integers) -> Flags:
        """1 where samples are missing before single samples."""
        return self._samples.gaps_at(numbers)

    def native(self, channel: int, start: int, stop: int) -> npt.NDArray[Any]:
        """Values as the type of the variable has them; of a formula LREAL."""
        own = len(self._samples.channels)
        if channel < own:
            return self._samples.native(channel, start, stop)
        formula = self._formulas[channel - own]
        count = max(0, stop - start)
        if formula is None:
            return np.full(count, np.nan)
        places = [self._places[key] for key in formula.channels]
        columns = [self._samples.native(place, start, stop).astype(np.float64) for place in places]
        try:
            found = formula.values(columns)
        except FormulaError:
            return np.full(count, np.nan)
        return found if columns else np.full(count, found[0])

    def search(self, time: int) -> int:
        """Number of the first sample that is not before a time."""
        return self._samples.search(time)

    def extremes(self, channel: int, start: int, stop: int, step: int) -> tuple[Reals, Reals]:
        """Least and largest values of blocks."""
        if channel < len(self._samples.channels):
            return self._samples.extremes(channel, start, stop, step)
        return reduced(self.native(channel, start, stop), step)


def with_formulas(samples: Samples, settings: TraceData, record: int) -> Samples:
    """The samples of a record with what its settings compute of them."""
    channels = settings.records[record].channels if record < len(settings.records) else ()
    formulas = [
        (number, channel.shown_name, channel.formula)
        for number, channel in enumerate(channels)
        if channel.formula.strip()
    ]
    # A file of another program may number its channels otherwise.
    names = [
        channels[one.index].shown_name if one.index < len(channels) else one.name for one in samples.channels
    ]
    return WithFormulas(samples, names, formulas) if formulas else samples
