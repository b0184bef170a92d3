"""A program as words of SMC_GCODE_WORD, and these as an initialiser in ST. Spec cnc 12, DAT-01, DAT-04."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from tappet.cnc.letters import END_OF_BLOCK, LETTERS, SKIP
from tappet.cnc.words import Line

VARIABLE_TYPES = {
    "INT": 1, "BYTE": 2, "WORD": 3, "DINT": 4, "DWORD": 5, "REAL": 6, "SINT": 14, "USINT": 15, "UINT": 16,
    "UDINT": 17, "LREAL": 22, "SMC_M_PARAMETERS": 100,
}  # fmt: skip
"""Types of variables to SMC_GCODE_WORD.byVarType: as SMC_VARTYPE, and the parameters of an M function."""


_LAYOUT = struct.Struct("<dixxxxQBBxxxxxx")
WORD_SIZE = _LAYOUT.size
"""Bytes of an SMC_GCODE_WORD: fValue, diValue, pAdr, byLetter, byVarType."""


class CodeWord(NamedTuple):
    """An SMC_GCODE_WORD."""

    letter: int
    value: float = 0.0
    variable: str | None = None

    def initialiser(self, types: Mapping[str, str]) -> str:
        """The structure in ST. `types`: variables in capital letters to names of their types.

        Raises KeyError for a variable that is not there, or has a type that words cannot have.
        """
        members = [f"byLetter := {self.letter}"]
        if self.variable is not None:
            members.append(f"pAdr := ADR({self.variable})")
            members.append(f"byVarType := {VARIABLE_TYPES[types[self.variable.upper()].upper()]}")
        elif self.value or math.copysign(1.0, self.value) < 0:
            members.append(f"fValue := {real_text(self.value)}")
            members.append(f"diValue := {_integer(self.value)}")
        return f"({', '.join(members)})"


def real_text(value: float) -> str:
    """A literal of LREAL."""
    text = repr(value)
    mantissa, e, exponent = text.partition("e")
    return f"{mantissa if '.' in mantissa else mantissa + '.0'}{'E' if e else ''}{exponent}"


def default_words(
    velocity: float = 0.0, acceleration: float = 100.0, deceleration: float = 100.0, *, in_space: bool = False
) -> Iterator[CodeWord]:
    """What stands in front of a program: its default dynamics, and 3D mode. Spec CNC-13 to CNC-15."""
    yield CodeWord(LETTERS["F"], velocity)
    yield CodeWord(LETTERS["E"], acceleration)
    yield CodeWord(LETTERS["E"], -deceleration)
    if in_space:
        yield CodeWord(LETTERS["G"], 17.0)
    yield CodeWord(END_OF_BLOCK)


def code_words(lines: Iterable[Line]) -> Iterator[CodeWord]:
    """The words of lines; empty ones leave out. The end of a block has the number of its line, from 1."""
    for line in lines:
        if line.is_empty:
            continue
        if line.suppressed:
            yield CodeWord(SKIP)
        if line.number is not None:
            yield CodeWord(LETTERS["N"], float(line.number))
        for word in line.words:
            yield CodeWord(LETTERS[word.address], word.value, word.variable)
        yield CodeWord(END_OF_BLOCK, float(line.place + 1))


def array_initialiser(words: Iterable[CodeWord], types: Mapping[str, str] | None = None) -> str:
    """The words as an initialiser of ARRAY OF SMC_GCODE_WORD. `types`: see `CodeWord.initialiser`."""
    return "[" + ",\n    ".join(word.initialiser(types or {}) for word in words) + "]"


def packed(words: Iterable[CodeWord], place_of: Callable[[CodeWord], tuple[int, int]]) -> bytes:
    """The words as they are in memory. `place_of`: address and byVarType of a word with a variable."""
    pack = _LAYOUT.pack
    return b"".join(
        pack(word.value, _integer(word.value), 0, word.letter, 0)
        if word.variable is None
        else pack(0.0, 0, (place := place_of(word))[0], word.letter, place[1])
        for word in words
    )


def _integer(value: float) -> int:
    return min(max(round(value), -2147483647), 2147483647)
