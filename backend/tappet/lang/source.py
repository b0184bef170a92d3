"""Source texts and places in them."""

from __future__ import annotations

import re

from tappet.iec.places import NOWHERE, BodyText, SourceMap, Span
from tappet.iec.source import GivenValue, Scope, Source, Use

_LINE_END = re.compile(r"\r\n|\n|\r")


def split_lines(text: str) -> list[str]:
    """The lines of a text as spans count them: without the rarer line ends that `str.splitlines` knows."""
    return _LINE_END.split(text)


def text_at(source: Source, span: Span) -> str:
    """The text of a span on one line, with single spaces."""
    lines = split_lines(source.text)[span.line : span.end_line + 1]
    if not lines:
        return ""
    lines[-1] = lines[-1][: span.end_column]
    lines[0] = lines[0][span.column :]
    return " ".join(" ".join(lines).split())


__all__ = [
    "NOWHERE",
    "BodyText",
    "GivenValue",
    "Scope",
    "Source",
    "SourceMap",
    "Span",
    "Use",
    "split_lines",
    "text_at",
]
