"""G-code text to lines of words. Spec GC-01 to GC-04, GC-09, GC-10, GC-13.

Never raises, whatever the text: what cannot be read is a problem with its place, the rest of the line is
read on. A large file is read line by line (`read_lines`), with memory for one line.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from tappet.cnc.letters import AXES
from tappet.cnc.words import Line, Problem, Program, Severity, Word

_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_TOKEN = re.compile(
    r"(?P<blank>[ \t\r\f\v]+)"
    r"|(?P<comment>\((?P<inside>[^)]*)\))"
    r"|(?P<rest>//(?P<behind>.*))"
    rf"|(?P<address>PROBE|FF|EF|[FE][{AXES}]|[A-Z])(?P<gap>[ \t]*)"
    rf"(?:(?P<number>{_NUMBER})|\$(?P<variable>[^$]*)\$)?",
    re.IGNORECASE | re.ASCII,
)
_NAME = re.compile(
    r"[A-Za-z_][A-Za-z0-9_]*(?:\[[0-9, ]+\])?(?:\.[A-Za-z_][A-Za-z0-9_]*(?:\[[0-9, ]+\])?)*", re.ASCII
)
_EXPRESSION = re.compile(r"\{[^}]*\}?|#\w*", re.ASCII)
_INTEGERS = frozenset("GMNH")
_BLANKS = " \t\r\f\v"
_LARGEST = 2147483647.0
"""Values beyond are refused by the decoder."""


class _LineReader:
    """Reads one line."""

    def __init__(self, text: str, place: int) -> None:
        self.text = text
        self.place = place
        self.words: list[Word] = []
        self.comments: list[str] = []
        self.problems: list[Problem] = []
        self.number: int | None = None

    def line(self) -> Line:
        text = self.text
        column = len(text) - len(text.lstrip())
        suppressed = text.startswith("/", column) and not text.startswith("//", column)
        if suppressed:
            column += 1
        end = len(text)
        while column < end:
            token = _TOKEN.match(text, column)
            if token is None:
                column = self._unreadable(column)
                continue
            self._take(token)
            column = token.end()
        return Line(
            self.place, suppressed, self.number, tuple(self.words), tuple(self.comments), tuple(self.problems)
        )

    def _take(self, token: re.Match[str]) -> None:
        kind = token.lastgroup
        if kind == "blank":
            return
        if (address := token["address"]) is not None:
            self._word(token, address.upper())
        elif token["comment"] is not None:
            self.comments.append(token["inside"].strip())
        else:
            self.comments.append(token["behind"].strip())

    def _word(self, token: re.Match[str], address: str) -> None:
        column, length = token.start(), len(token[0].rstrip())
        number, variable = token["number"], token["variable"]
        if number is None and variable is None:
            self._say(column, length, f"'{address}' has no value; write a number such as {address}10")
            return
        if address == "N":
            self._block_number(column, length, number)
            return
        if variable is not None:
            name = variable.strip()
            if not _NAME.fullmatch(name):
                self._say(
                    column, length, f"'${variable}$' is no name of a variable; write for example ${'GVL.x'}$"
                )
                return
            self.words.append(Word(address, 0.0, name, column, length))
            return
        value = float(number)
        if not abs(value) <= _LARGEST:
            self._say(
                column, length, f"{number} is too large; values reach from -{_LARGEST:.0f} to {_LARGEST:.0f}"
            )
        elif address in _INTEGERS and not value.is_integer():
            self._say(column, length, f"'{address}' takes whole numbers, not {number}")
        else:
            if "E" in number.upper():
                self._exponent(column, length, address, number)
            self.words.append(Word(address, value, None, column, length))

    def _exponent(self, column: int, length: int, address: str, number: str) -> None:
        mantissa, _, exponent = number.upper().partition("E")
        right = f"{address}{mantissa} E{exponent}"
        message = f"{number} is one number; write {right} with a blank if E is to be an acceleration"
        self._say(column, length, message, "warning")

    def _block_number(self, column: int, length: int, number: str | None) -> None:
        if self.number is not None or self.words:
            self._say(column, length, "The block number stands in front of the line, once")
        elif number is None or not number.isdigit() or float(number) > _LARGEST:
            self._say(column, length, "A block number is a whole number without sign, such as N10")
        else:
            self.number = int(number)

    def _unreadable(self, column: int) -> int:
        """Says what cannot be read; where reading goes on."""
        character = self.text[column]
        end = len(self.text)
        if character == "(":
            self._say(column, end - column, "The comment has no ')'")
            return end
        if character in "#{":
            match = _EXPRESSION.match(self.text, column)
            stop = match.end() if match else column + 1
            self._say(
                column,
                stop - column,
                "Local variables, expressions and subprograms are read from files at run time only"
                " (SMC_ReadNCFile2); write a number or $name$",
            )
            return stop
        self._say(
            column, 1, f"'{character}' does not begin a word; write an address and its value, such as X10"
        )
        return column + 1

    def _say(self, column: int, length: int, message: str, severity: Severity = "error") -> None:
        self.problems.append(Problem(self.place, column, max(length, 1), message, severity))


def read_lines(texts: Iterable[str]) -> Iterator[Line]:
    """The lines of a program, one by one."""
    before = True
    for place, text in enumerate(texts):
        text = text.rstrip("\r\n")
        if place == 0 and text.startswith("\ufeff"):
            text = " " + text[1:]
        stripped = text.lstrip(_BLANKS)
        if before and stripped.startswith("%"):
            before = False
            yield Line(place, header=stripped[1:].strip())
            continue
        line = _LineReader(text, place).line()
        before = before and line.is_empty and not line.problems
        yield line


def parse(text: str) -> Program:
    """A whole program."""
    return Program(tuple(read_lines(text.split("\n"))))


def decode(data: bytes) -> str:
    """The text of a file: UTF-8, else Latin 1, which has a character for every byte."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")
