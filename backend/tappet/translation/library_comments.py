"""Comments of the product's libraries in the languages of its users, sentence by sentence.

The tables `<language>/libraries/<library>.csv` have the English sentence of each. What cites a specification
stands behind the others and is the same in all languages.
"""

from __future__ import annotations

import csv
import re
from functools import cache
from importlib.resources import files

from tappet.translation.language import Language

_CITATION = re.compile(r"(?:^|(?<=[.;:)])\s+)(Spec\s[^.]*(?:\.\d[^.]*)*\.)")
"""`Spec STA-01, motion_semantics 2 to 5.`"""
_END = re.compile(r"(?<=\.)\s+(?=[A-Z(])")
"""Between two sentences."""


def sentences(comment: str) -> list[str]:
    """The sentences of a comment, without the specification that it cites."""
    plain = " ".join(_CITATION.sub("", comment).split())
    return [sentence for sentence in _END.split(plain) if sentence]


def said(comment: str, library: str, language: Language) -> list[str]:
    """The sentences of a comment in a language; those without words for it as they are."""
    known = table(library, language)
    return [known.get(sentence, sentence) for sentence in sentences(comment)]


def comment(english: str, library: str, language: Language) -> str:
    """A whole comment in a language; as it is if there are no words for any of its sentences."""
    found = said(english, library, language)
    if found == sentences(english):
        return english
    return re.sub(r"(?<=[。）]) ", "", " ".join(found))


@cache
def table(library: str, language: Language) -> dict[str, str]:
    """What there is in a language of the comments of a library, by English sentence."""
    path = files(__package__).joinpath(language, "libraries", f"{library}.csv")
    if language == "en" or not path.is_file():
        return {}
    rows = csv.DictReader(path.read_text(encoding="utf-8").splitlines())
    return {row["english"]: row["translation"] for row in rows}
