"""What every part of the syntax tree is made of: the node with its place, pragmas, folded values."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.lang.source import NOWHERE, Span

Constant = bool | int | float | str | bytes | None
"""Folded value of a constant expression: numbers in the unit of their type (TIME in ms, LTIME in ns,
DATE and DT in s, TOD in ms), STRING as bytes (latin-1), WSTRING as str."""


@dataclass(slots=True, kw_only=True)
class Node:
    """Anything with a place in the text."""

    span: Span = NOWHERE


@dataclass(slots=True, kw_only=True)
class Pragma(Node):
    """`{...}`: attribute, message, conditional or region, as written without the braces."""

    text: str
    # attribute pragmas only
    attribute: str | None = None
    value: str | None = None
