"""What the texts have in common that a cam is written to and read from: numbers, errors with their lines."""

from __future__ import annotations

import re

from tappet.project.cams.table import FARTHEST
from tappet.project.errors import ProjectError

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?", re.ASCII)


class CamTextError(ProjectError):
    """A text that is no cam."""

    code = "cam_text"

    def __init__(self, line: int, reason: str) -> None:
        super().__init__(f"Line {line} of the text: {reason}.")
        self.line = line
        self.reason = reason


def number_in(word: str, line: int) -> float:
    """A decimal number. Raises CamTextError."""
    shown = word if len(word) <= 40 else f"{word[:40]}..."
    if _NUMBER.fullmatch(word) is None:
        raise CamTextError(line, f"'{shown}' is no number")
    value = float(word)
    if not abs(value) <= FARTHEST:
        raise CamTextError(line, f"{shown} is too large; positions and derivatives are at most 1e12")
    return value


def lines_of(text: str) -> list[str]:
    """The lines of a file, whatever ends them, without the mark of its byte order."""
    return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n").split("\n")
