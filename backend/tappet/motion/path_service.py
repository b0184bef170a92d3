"""The path of a CNC program as the blocks on the controller make it: objects, preprocessed, positions.

For the editor's graphic, CNC info and the compiler. One thread at a time. Variables have their offline values
(CNC-17). Nothing is ever cut off in silence: `fault` says why a path ends early.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from tappet.cnc.parser import parse
from tappet.cnc.word_list import VARIABLE_TYPES, CodeWord, code_words, default_words, packed
from tappet.cnc.words import Line, Word
from tappet.motion.path_blocks import PathBlock, path_blocks
from tappet.motion.path_program import (
    DECODER,
    INTERPOLATOR,
    VELOCITY_CHECK,
    EndlessProgramError,
    PathProgram,
    ProgramFault,
    Rows,
    Samples,
)
from tappet.motion.path_program_text import MOST_VARIABLES, SAMPLE_FIELDS
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData, PreprocessingBlock
from tappet.project.naming import name_key

AXES = ("x", "y", "z", "a", "b", "c", "p", "q", "u", "v", "w")
MOST_OBJECTS = 2_000_000
MOST_SAMPLES = 2_000_000
KEPT_PROGRAMS = 4
"""Chains of blocks that stay loaded."""
SMALLEST_QUEUE = 128
T = TypeVar("T", Rows, Samples)
_LREAL, _M_PARAMETERS = VARIABLE_TYPES["LREAL"], VARIABLE_TYPES["SMC_M_PARAMETERS"]
_COLUMN = {field: number for number, field in enumerate(SAMPLE_FIELDS)}


class PathSettingsError(ValueError):
    """The settings name a block or an input that the library does not have."""


@dataclass(frozen=True, slots=True)
class PathFault:
    """Why a path ends before its program."""

    message: str
    """In English, without place."""
    code: str = ""
    """Value of SMC_ERROR; empty for a limit of the editor."""
    line: int | None = None
    """Of the text, from 0; None where it is no line."""
    column: int = 0
    length: int = 0
    """Of the word at fault; 0 for the whole line."""


@dataclass(frozen=True, slots=True)
class PathObjects:
    """Objects of a path."""

    rows: Rows
    """Structured array of SMC_GEOINFO: the fields are `tappet.cnc.queue_file.FIELDS`, the items whole
    structures of the compiled layout. `iSourceLine_No` is the number of the line in the text, from 1."""
    fault: PathFault | None = None

    @property
    def lines(self) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
        """Line of the text that each object comes from, from 0; -1: none."""
        return self.rows["iSourceLine_No"].astype(np.int64) - 1

    @property
    def length(self) -> float:
        """Sum of the lengths [u]."""
        return float(self.rows["dLength"].sum())


@dataclass(frozen=True, slots=True)
class Motion:
    """Positions of the interpolator, one a cycle."""

    interval_s: float
    positions: Samples
    """A row a cycle, a column an axis in the order of AXES."""
    velocity: Samples
    """On the path [u/s]."""
    lines: np.ndarray[tuple[int], np.dtype[np.int64]]
    """Of the text, from 0; -1: none."""
    fault: PathFault | None = None

    @property
    def duration_s(self) -> float:
        """From the first cycle to the one that ends the path."""
        return len(self.velocity) * self.interval_s


class PathService:
    """Makes paths; keeps the compiled programs of the chains that were asked for last."""

    def __init__(self, cache: Path | None = None) -> None:
        """`cache`: a folder of compiled objects."""
        self._cache = cache
        self._programs: OrderedDict[tuple[tuple[str, ...], int], PathProgram] = OrderedDict()

    def close(self) -> None:
        """Unload the programs."""
        while self._programs:
            self._programs.popitem()[1].close()

    def objects_of(self, program: CncProgramData) -> PathObjects:
        """The objects that the decoder makes, with the end velocities of SMC_CheckVelocities."""
        return self._path(program, ())

    def preprocessed(self, program: CncProgramData, settings: CncSettingsData) -> PathObjects:
        """The objects behind the preprocessing of the settings. Raises PathSettingsError."""
        return self._path(program, settings.preprocessing)

    def interpolated(
        self, program: CncProgramData, settings: CncSettingsData, *, preprocessing: bool = True
    ) -> Motion:
        """The positions on the path, preprocessed or not. Raises PathSettingsError."""
        chain = settings.preprocessing if preprocessing else ()
        order = _Order(program, chain)
        compiled = self._started(order, settings.interpolation_time_us)
        parts: list[Samples] = []
        fault = _drained(compiled.samples(), parts, MOST_SAMPLES, "positions")
        rows = np.concatenate(parts) if parts else np.zeros((0, len(SAMPLE_FIELDS)))
        return Motion(
            settings.interpolation_time_us * 1e-6,
            rows[:, : len(AXES)],
            rows[:, _COLUMN["dVel"]],
            rows[:, _COLUMN["iActObjectSourceNo"]].astype(np.int64) - 1,
            fault or order.fault(compiled.fault),
        )

    def _path(self, program: CncProgramData, chain: Sequence[PreprocessingBlock]) -> PathObjects:
        order = _Order(program, chain)
        compiled = self._started(order, 0)
        parts: list[Rows] = []
        fault = _drained(compiled.objects(), parts, MOST_OBJECTS, "objects")
        rows = np.zeros(sum(map(len, parts)), compiled.geo)  # concatenate would drop the gaps of the layout
        place = 0
        for part in parts:
            rows[place : place + len(part)] = part
            place += len(part)
        return PathObjects(rows, fault or order.fault(compiled.fault, rows))

    def _started(self, order: _Order, interpolation_us: int) -> PathProgram:
        compiled = self._compiled(order)
        try:
            order.start(compiled, interpolation_us)
        except ValueError as error:
            raise PathSettingsError(str(error)) from None
        return compiled

    def _compiled(self, order: _Order) -> PathProgram:
        queue = SMALLEST_QUEUE
        while queue < order.data.queue_size:
            queue *= 2
        key = tuple(block.name for block in order.blocks), queue
        found = self._programs.pop(key, None)
        if found is None:
            while len(self._programs) >= KEPT_PROGRAMS:
                self._programs.popitem(last=False)[1].close()
            found = PathProgram(order.blocks, queue, self._cache)
        self._programs[key] = found
        return found


def _drained(given: Iterator[T], parts: list[T], most: int, what: str) -> PathFault | None:
    """Collects what a program gives, up to a limit."""
    count = 0
    try:
        for part in given:
            parts.append(part)
            count += len(part)
            if count > most:
                return PathFault(f"The path has more than {most} {what}; it is shown up to there")
    except EndlessProgramError:
        return PathFault("The program jumps back for ever without a movement")
    return None


class _Order:
    """A program and its chain, ready for a compiled program."""

    def __init__(self, data: CncProgramData, chain: Sequence[PreprocessingBlock]) -> None:
        self.data = data
        known = {name_key(name): block for name, block in path_blocks().items()}
        missing = next((one.block for one in chain if name_key(one.block) not in known), None)
        if missing is not None:
            raise PathSettingsError(
                f"SM3_CNC has no preprocessing block '{missing}'; remove it from the CNC settings"
            )
        self.blocks: list[PathBlock] = [known[name_key(one.block)] for one in chain]
        self._chain = chain
        self._lines = parse(data.implementation).lines
        self._values = {name_key(row.name): row.value for row in data.offline_values}

    def start(self, compiled: PathProgram, interpolation_us: int) -> None:
        """Hand the program over. Raises ValueError for an input that a block does not have."""
        names: dict[str, int] = {}

        def place_of(word: CodeWord) -> tuple[int, int]:
            if word.letter == ord("O") and word.variable in parameters:
                return compiled.parameters, _M_PARAMETERS
            number = names.setdefault(name_key(word.variable or ""), len(names))
            return compiled.variables + 8 * min(number, MOST_VARIABLES - 1), _LREAL

        parameters = {
            word.variable
            for line in self._lines
            if any(word.address == "M" for word in line.words)
            for word in line.words
            if word.address == "O"
        }
        defaults = default_words(self.data.velocity, self.data.acceleration, self.data.deceleration)
        words = packed([*defaults, *code_words(_by_place(self._lines, self._values))], place_of)
        variables = np.array([self._values.get(name, 0.0) for name in list(names)[:MOST_VARIABLES]])
        compiled.start(
            words,
            variables,
            [getattr(self.data.start, axis) for axis in AXES],
            suppress=self.data.step_suppression,
            parameters=[
                (f"{number}.{parameter.name}", parameter.value)
                for number, one in enumerate(self._chain)
                for parameter in one.parameters
            ],
            interpolation_us=interpolation_us,
        )

    def fault(self, found: ProgramFault | None, rows: Rows | None = None) -> PathFault | None:
        """A fault of the compiled program at its place; `rows`: what it gave before."""
        if found is None:
            return None
        who = self.blocks[found.who - 1].name if found.who > 0 else _NAMES[found.who]
        message = f"{who}: {found.text}"
        number = found.line
        if found.who == VELOCITY_CHECK and rows is not None:
            number = _first_without_dynamics(rows)
        if not 0 < number <= len(self._lines):
            return PathFault(message, found.code)
        line = self._lines[number - 1]
        at = next((word for word in line.words if _written(word) == found.word.upper()), None)
        if at is None:
            return PathFault(message, found.code, line.place)
        return PathFault(message, found.code, line.place, at.column, at.length)


_NAMES = {DECODER: "SMC_NCDecoder", VELOCITY_CHECK: "SMC_CheckVelocities", INTERPOLATOR: "SMC_Interpolator"}


def _first_without_dynamics(rows: Rows) -> int:
    """Line of the first object that cannot move, from 1; 0: there is none."""
    still = (rows["dLength"] > 0) & ((rows["dVel"] <= 0) | (rows["dAccel"] <= 0) | (rows["dDecel"] <= 0))
    return int(rows["iSourceLine_No"][still.argmax()]) if still.any() else 0


def _written(word: Word) -> str:
    """As the decoder writes a word."""
    return f"{word.address}{word.value:g}".upper()


def _by_place(lines: Sequence[Line], values: Mapping[str, float]) -> Iterator[Line]:
    """Lines numbered by their places from 1, so that objects say the line of the text they come from; jumps
    go to the same lines as before."""
    places: dict[float, int] = {}
    for line in lines:
        if line.number is not None:
            places.setdefault(float(line.number), line.place + 1)
    for line in lines:
        words = line.words
        if any(word.address == "G" and word.variable is None and word.value == 20 for word in words):
            words = tuple(_to_place(word, places, values) if word.address == "L" else word for word in words)
        number = line.number if line.number is None else line.place + 1
        yield (
            line
            if words is line.words and number is line.number
            else replace(line, number=number, words=words)
        )


def _to_place(word: Word, places: Mapping[float, int], values: Mapping[str, float]) -> Word:
    target = word.value if word.variable is None else values.get(name_key(word.variable), 0.0)
    return word._replace(value=float(places.get(target, len(places) + 2**30)), variable=None)
