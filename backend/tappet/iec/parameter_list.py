"""The attribute that makes a global variable list the parameters of a library."""

from __future__ import annotations

from tappet.iec.tokens import PRAGMA, pieces, words
from tappet.iec.trivia import attribute_of

ATTRIBUTE = "parameter_list"
PARAMETER_LIST = f"{{attribute '{ATTRIBUTE}'}}"
"""Marks a global variable list as the parameters of a library."""


def is_parameter_list(text: str) -> bool:
    """Whether the text of a global variable list has the mark of a parameter list."""
    if ATTRIBUTE not in text.lower():
        return False
    attributes = (attribute_of(piece.text) for piece in pieces(text) if piece.kind == PRAGMA)
    return any(found is not None and found.name.lower() == ATTRIBUTE for found in attributes)


def as_parameter_list(text: str) -> str:
    """The text of a global variable list with the mark, in the line before its first section."""
    if is_parameter_list(text):
        return text
    first = next(words(text), None)
    start = text.rfind("\n", 0, first.start) + 1 if first is not None else len(text)
    return f"{text[:start]}{PARAMETER_LIST}\n{text[start:]}"
