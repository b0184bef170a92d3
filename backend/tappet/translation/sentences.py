"""What the product says in sentences, in the language of the user: refusals, import reports, logs, reasons.

The tables `<language>/*.csv` have the English template of each. Facts stay as they are; what a fact of
`SPOKEN` holds is a text of ours, which is translated in turn. A text that no row fits stays English.
"""

from __future__ import annotations

import csv
from functools import cache, lru_cache
from importlib.resources import files

from tappet.translation.language import Language
from tappet.translation.templates import Templates

SPOKEN = frozenset({"advice", "kind", "list", "more", "place", "reason", "what"})
"""Fields that hold words of ours: other sentences, kinds of objects."""
OPTIONAL = frozenset({"more"})
"""Fields that may be empty."""
WORDS = frozenset(
    {"application", "constant", "count", "keyword", "limit", "line", "scalar", "size", "variable"}
)
"""Fields that hold one word, such as a number or an identifier: they tell short sentences from others."""
LONGEST = 10_000
"""Characters of a text that is looked up; none of our sentences is that long."""


@cache
def rows(language: Language) -> tuple[tuple[str, str], ...]:
    """All templates with their translations."""
    if language == "en":
        return ()
    names = sorted(
        one.name.removesuffix(".csv")
        for one in files(__package__).joinpath(language).iterdir()
        if one.name.endswith(".csv")
    )
    return tuple(row for name in names for row in table(language, name))


def table(language: Language, name: str) -> list[tuple[str, str]]:
    """The templates of one room of the product, or those of others that it shows, with their translations."""
    text = files(__package__).joinpath(language, f"{name}.csv").read_text(encoding="utf-8")
    return [(row["english"], row["translation"]) for row in csv.DictReader(text.splitlines())]


@cache
def _templates(language: Language) -> Templates:
    return Templates(rows(language), OPTIONAL, WORDS)


def sentence(english: str, language: Language) -> str:
    """A sentence in a language; as it is where there are no words for it."""
    if language == "en" or not english or len(english) > LONGEST:
        return english
    return _sentence(english, language) or english


@lru_cache(maxsize=10_000)
def _sentence(english: str, language: Language) -> str | None:
    def say(field: str, fact: str) -> str | None:
        return _sentence(fact, language) if field in SPOKEN and fact else fact

    return _templates(language).find(english, say)
