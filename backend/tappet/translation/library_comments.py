"""Comments of the product's libraries in the languages of its users, paragraph by paragraph.

The tables `<language>/libraries/<library>.csv` have the English paragraph of each. What cites a specification
stands behind a paragraph and is the same in all languages.
"""

from __future__ import annotations

import csv
import re
from functools import cache
from importlib.resources import files

from tappet.translation.language import Language

_CITATION = re.compile(r"(?:^|(?<=[.;:])\s+)(Spec\s[^.]*(?:\.\d[^.]*)*\.)\s*$")
"""`Spec STA-01, motion_semantics 2 to 5.` at the end of a comment."""


def paragraphs(comment: str) -> list[str]:
    """The paragraphs of a comment, each on one line, without the specification that it cites."""
    plain = _CITATION.sub("", comment.rstrip())
    found = (" ".join(part.split()) for part in re.split(r"\n\s*\n", plain))
    return [paragraph for paragraph in found if paragraph]


def said(paragraph: str, library: str, language: Language) -> str:
    """A paragraph in a language; as it is where there are no words for it."""
    return table(library, language).get(paragraph, paragraph)


@cache
def table(library: str, language: Language) -> dict[str, str]:
    """What there is in a language of the comments of a library, by English paragraph."""
    path = files(__package__).joinpath(language, "libraries", f"{library}.csv")
    if language == "en" or not path.is_file():
        return {}
    rows = csv.DictReader(path.read_text(encoding="utf-8").splitlines())
    return {row["english"]: row["translation"] for row in rows}
