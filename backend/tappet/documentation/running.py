"""Heads and feet of pages with what is known before the pages are."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.documentation.document import Running, printable
from tappet.documentation.words import Language, word
from tappet.project.page_setup import Running as RunningTexts
from tappet.project.running_text import Piece, pieces_of

_PER_PAGE = frozenset({"object", "path", "page", "pages"})


def running(texts: RunningTexts, known: Mapping[str, str], language: Language) -> Running:
    """The three texts; `known` are the values of placeholders that are the same on each page."""
    left, centre, right = (_filled(text, known, language) for text in (texts.left, texts.centre, texts.right))
    return left, centre, right


def _filled(text: str, known: Mapping[str, str], language: Language) -> tuple[Piece, ...]:
    found: list[Piece] = []
    for piece in pieces_of(text):
        if piece.placeholder in _PER_PAGE:
            found.append(piece)
        elif piece.placeholder == "page_of_pages":
            found += pieces_of(word("page", language, page="{page}", pages="{pages}"))
        else:
            found.append(Piece("", printable(known[piece.placeholder] if piece.placeholder else piece.text)))
    return tuple(found)
