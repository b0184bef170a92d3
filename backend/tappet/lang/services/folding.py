"""Lines that can be folded: blocks, comments, regions."""

from __future__ import annotations

import re
from typing import Literal

from tappet.iec.words import ENDS, SECTIONS
from tappet.lang.lexer import PRAGMA
from tappet.lang.services.documents import Position
from tappet.lang.services.instruction_list import networks
from tappet.lang.services.results import Fold
from tappet.lang.services.workspace import Snapshot

_REGION = re.compile(r"\{\s*(region|endregion)\b", re.IGNORECASE)
_OPENED_BY = {end: begin for begin, end in ENDS.items()}


def folds(snapshot: Snapshot, document: str) -> list[Fold]:
    """The foldable lines of a document."""
    view = snapshot.view(document, Position(0, 0))
    lines = view.text.lines_of(document)
    assert lines is not None
    first, behind = lines
    shift = view.text.place(view.unit.span._replace(line=first, end_line=first)).span.line - first
    found: list[Fold] = []

    def add(start: int, end: int, kind: Literal["region", "comment", "code"]) -> None:
        start, end = max(start, first), min(end, behind - 1)
        if end > start:
            found.append(Fold(start + shift, end + shift, kind))

    lexed = view.lexed
    opened: list[tuple[str, int]] = []
    regions: list[int] = []
    for index, kind in enumerate(lexed.kinds):
        for trivia in lexed.trivia.get(index, ()):
            match = _REGION.match(trivia.text) if trivia.kind is PRAGMA else None
            if match is None:
                add(trivia.span.line, trivia.span.end_line, "comment")
            elif match[1].lower() == "region":
                regions.append(trivia.span.line)
            elif regions:
                add(regions.pop(), trivia.span.line, "region")
        word = lexed.texts[index].upper()
        accessor = word in ("GET", "SET") and bool(opened) and opened[-1][0] == "PROPERTY"
        if kind in ENDS or kind in SECTIONS or accessor:
            opened.append((word, lexed.lines[index]))
        elif kind == "END_VAR" or kind in _OPENED_BY:
            wanted = SECTIONS if kind == "END_VAR" else {_OPENED_BY[kind]}
            if not any(begin in wanted for begin, _ in opened):
                continue
            while opened:  # an opening without an end folds nothing
                begin, line = opened.pop()
                if begin in wanted:
                    add(line, lexed.lines[index], "code")
                    break
    for start, last in networks(view.unit):
        add(start, last, "code")
    return sorted(set(found), key=lambda fold: (fold.start, -fold.end))
