"""Programs that hand texts of every length to every function, and keep the results between guards."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from builtin_functions import FUNCTIONS

GUARD = 165
LENGTHS = (1, 2, 10, 79, 80, 81, 254, 255, 256, 300)
"""Lengths of variables around those of STRING and of the string functions."""
POSITIONS = (-1, 0, 1, 2, 9, 10, 11, 79, 80, 81, 254, 255, 256, 300, 32767)
LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
LONGEST = 255
"""Characters that string functions and conversions take."""


@dataclass(frozen=True)
class Made:
    """An expression and the text it gives."""

    text: str
    value: str
    wide: bool


@dataclass(frozen=True)
class Case:
    """A result, and the guarded variable it goes to."""

    statement: str
    value: str
    length: int
    wide: bool


def word(wide: bool) -> str:
    return "WSTRING" if wide else "STRING"


def content(r: Random, length: int) -> str:
    start = r.randrange(len(LETTERS))
    return ((LETTERS[start:] + LETTERS[:start]) * (length // len(LETTERS) + 1))[:length]


def quoted(text: str, wide: bool) -> str:
    return f'"{text}"' if wide else f"'{text}'"


class Texts:
    """Makes the cases of one program."""

    def __init__(self, r: Random) -> None:
        self.r = r
        self.sources: list[str] = []
        self.cases: list[Case] = []

    def source(self, wide: bool) -> Made:
        """A variable that is full, nearly full or empty, or a literal."""
        length = self.r.choice(LENGTHS)
        value = content(self.r, self.r.choice((length, length, length, length - 1, 0, length // 2)))
        if self.r.random() < 0.2:
            return Made(quoted(value, wide), value, wide)
        name = f"s{len(self.sources)}"
        self.sources.append(f"{name} : {word(wide)}({length}) := {quoted(value, wide)};")
        return Made(name, value, wide)

    def made(self, wide: bool, depth: int) -> Made:
        """An expression of one of all kinds."""
        if depth == 0:
            return self.source(wide)
        kinds: tuple[Callable[[bool, int], Made], ...] = (
            self.source_only, self.converted, self.function, self.function, self.choice, self.passed,
        )  # fmt: skip
        return self.r.choice(kinds)(wide, depth - 1)

    def source_only(self, wide: bool, depth: int) -> Made:
        return self.source(wide)

    def converted(self, wide: bool, depth: int) -> Made:
        """A conversion; between the widths 255 characters are taken."""
        inner = self.made(self.r.random() < 0.4 if depth else not wide, depth)
        names = (f"{word(inner.wide)}_TO_{word(wide)}", f"TO_{word(wide)}", f"ANY_TO_{word(wide)}")
        value = inner.value if inner.wide == wide else inner.value[:LONGEST]
        return Made(f"{self.r.choice(names)}({inner.text})", value, wide)

    def function(self, wide: bool, depth: int) -> Made:
        """A function of Standard or Standard64."""
        name = self.r.choice(("CONCAT", "INSERT", "REPLACE", "LEFT", "RIGHT", "MID", "DELETE"))
        texts = [self.made(wide, depth) for _ in range(2 if name in ("CONCAT", "INSERT", "REPLACE") else 1)]
        count = {"CONCAT": 0, "INSERT": 1, "LEFT": 1, "RIGHT": 1}.get(name, 2)
        numbers = [self.r.choice(POSITIONS) for _ in range(count)]
        args = [*(t.value[:LONGEST] for t in texts), *numbers]
        written = ", ".join([*(t.text for t in texts), *map(str, numbers)])
        full = f"W{name}" if wide else name
        return Made(f"{full}({written})", FUNCTIONS[full](args, None), wide)

    def choice(self, wide: bool, depth: int) -> Made:
        """SEL, MUX, MIN, MAX and LIMIT keep the whole text that they choose."""
        first, second = self.made(wide, depth), self.made(wide, depth)
        name = self.r.choice(("SEL", "MUX", "MIN", "MAX"))
        written = f"{first.text}, {second.text}"
        if name in ("SEL", "MUX"):
            gate = self.r.random() < 0.5
            lead = ("on" if gate else "off") if name == "SEL" else ("one" if gate else "none")
            return Made(f"{name}({lead}, {written})", (second if gate else first).value, wide)
        pick = min if name == "MIN" else max
        return Made(f"{name}({written})", pick(first.value, second.value), wide)

    def passed(self, wide: bool, depth: int) -> Made:
        """Through the input and the result of a function, which cut it."""
        inner = self.made(wide, depth)
        taken, given = self.r.choice(LENGTHS), self.r.choice(LENGTHS)
        name = f"Pass{'W' if wide else 'S'}{taken}_{given}"
        return Made(f"{name}({inner.text})", inner.value[:taken][:given], wide)

    def case(self) -> None:
        wide = self.r.random() < 0.5
        made, length = self.made(wide, self.r.choice((1, 1, 2))), self.r.choice(LENGTHS)
        place = f"r{len(self.cases)}.t"
        statement = f"{place} := {made.text};"
        value = made.value
        if self.r.random() < 0.2:
            taken = self.r.choice(LENGTHS)
            statement = f"f{'W' if wide else 'S'}{taken}(x := {made.text}, y => {place});"
            value = value[:taken]
        self.cases.append(Case(statement, value[:length], length, wide))


def program(made: Texts) -> str:
    """The text of a program with all cases."""
    parts = []
    for wide in (False, True):
        kind, letter = word(wide), "W" if wide else "S"
        for length in LENGTHS:
            guard = f"ARRAY[0..15] OF BYTE := [16({GUARD})]"
            parts.append(
                f"TYPE G{letter}{length} : STRUCT before : {guard}; t : {kind}({length}); "
                f"after : {guard}; END_STRUCT END_TYPE"
            )
            parts.append(
                f"FUNCTION_BLOCK FB{letter}{length} VAR_INPUT x : {kind}({length}); END_VAR "
                f"VAR_OUTPUT y : {kind}({length}); END_VAR y := x; END_FUNCTION_BLOCK"
            )
    text = "\n".join(c.statement for c in made.cases)
    for wide in (False, True):
        letter = "W" if wide else "S"
        for taken in LENGTHS:
            for given in LENGTHS:
                name = f"Pass{letter}{taken}_{given}"
                if name + "(" in text:
                    parts.append(
                        f"FUNCTION {name} : {word(wide)}({given}) VAR_INPUT x : {word(wide)}({taken}); "
                        f"END_VAR {name} := x; END_FUNCTION"
                    )
    results = [f"r{i} : G{'W' if c.wide else 'S'}{c.length};" for i, c in enumerate(made.cases)]
    blocks = [f"f{letter}{n} : FB{letter}{n};" for letter in "WS" for n in LENGTHS]
    own = ["on : BOOL := TRUE; off : BOOL; one : INT := 1; none : INT;"]
    variables = "\n".join([*own, *made.sources, *results, *blocks])
    parts.append(f"PROGRAM PLC_PRG\nVAR\n{variables}\nEND_VAR\n{text}\nEND_PROGRAM")
    return "\n".join(parts)
