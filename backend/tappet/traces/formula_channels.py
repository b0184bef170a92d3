"""Formula channels of a record: further channels of its samples, computed block by block."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from tappet.project.trace import TraceChannel, TraceData, TraceRecord
from tappet.traces.formula import Formula, FormulaError, channel_key
from tappet.traces.recording import ChannelInfo
from tappet.traces.samples import Flags, Integers, Reals, Samples, reduced


class FormulaProblem(NamedTuple):
    """Why a formula has no values: number and name of its channel, and what would be right."""

    channel: int
    name: str
    message: str


class FormulasError(ValueError):
    """Formulas of a record that have no values, all of them."""

    def __init__(self, problems: Sequence[FormulaProblem]) -> None:
        super().__init__(problems[0].message)
        self.problems = list(problems)


def read_formulas(formulas: Sequence[tuple[int, TraceChannel]], names: Sequence[str]) -> list[Formula]:
    """The formulas of channels, by number, over channels of these names; raises FormulasError."""
    known = {channel_key(name) for name in names}
    found: list[Formula] = []
    problems: list[FormulaProblem] = []
    for number, channel in formulas:
        try:
            formula = Formula(channel.formula)
        except FormulaError as error:
            problems.append(FormulaProblem(number, channel.shown_name, str(error)))
            continue
        found.append(formula)
        spelt = zip(formula.channels, formula.spelt, strict=True)
        missing = next((as_written for key, as_written in spelt if key not in known), None)
        if missing is not None:
            word, at = missing
            there = ", ".join(names) or "none"
            message = f"no recorded variable is called '{word}' (at {at + 1}); there are: {there}"
            problems.append(FormulaProblem(number, channel.shown_name, message))
    if problems:
        raise FormulasError(problems)
    return found


def formula_channels(channels: Sequence[TraceChannel]) -> list[tuple[int, TraceChannel]]:
    """Those that are computed, with their numbers."""
    return [(number, channel) for number, channel in enumerate(channels) if channel.formula.strip()]


def check_formulas(record: TraceRecord) -> None:
    """Raises FormulasError where a formula of a record would have no values."""
    names = [channel.shown_name for channel in record.channels if channel.recorded]
    read_formulas(formula_channels(record.channels), names)


class WithFormulas:
    """Samples with further channels that are computed of theirs, block by block."""

    def __init__(
        self, samples: Samples, names: Sequence[str], formulas: Sequence[tuple[int, TraceChannel]]
    ) -> None:
        """`names` of the channels of `samples` in formulas; number and settings of each formula. Raises
        FormulasError."""
        self._samples = samples
        self._places: dict[str, int] = {}
        for number, name in enumerate(names):
            self._places.setdefault(channel_key(name), number)
        self._formulas = read_formulas(formulas, names)
        extra = [ChannelInfo(number, channel.shown_name, "LREAL", "f8") for number, channel in formulas]
        self.channels = [*samples.channels, *extra]

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
        places = [self._places[key] for key in formula.channels]
        columns = [self._samples.native(place, start, stop).astype(np.float64) for place in places]
        found = formula.values(columns)
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
    """The samples of a record with what its settings compute of them; raises FormulasError."""
    channels = settings.records[record].channels if record < len(settings.records) else ()
    formulas = formula_channels(channels)
    # A file of another program may number its channels otherwise.
    names = [
        channels[one.index].shown_name if one.index < len(channels) else one.name for one in samples.channels
    ]
    return WithFormulas(samples, names, formulas) if formulas else samples
