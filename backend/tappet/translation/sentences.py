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

SPOKEN = frozenset({"advice", "kind", "more", "place", "reason", "what"})
"""Fields that hold words of ours: other sentences, kinds of objects."""
OPTIONAL = frozenset({"more"})
"""Fields that may be empty."""
LONGEST = 10_000
"""Characters of a text that is looked up; none of our sentences is that long."""


@cache
def rows(language: Language) -> tuple[tuple[str, str], ...]:
    """All templates with their translations."""
    if language == "en":
        return ()
    tables = sorted(files(__package__).joinpath(language).iterdir(), key=lambda table: table.name)
    return tuple(
        (row["english"], row["translation"])
        for table in tables
        if table.name.endswith(".csv")
        for row in csv.DictReader(table.read_text(encoding="utf-8").splitlines())
    )


@cache
def _templates(language: Language) -> Templates:
    return Templates(rows(language), OPTIONAL)


def sentence(english: str, language: Language) -> str:
    """A sentence in a language; as it is where there are no words for it."""
    if language == "en" or not english or len(english) > LONGEST:
        return english
    return _sentence(english, language)


@lru_cache(maxsize=10_000)
def _sentence(english: str, language: Language) -> str:
    def say(field: str, fact: str) -> str:
        return sentence(fact, language) if field in SPOKEN else fact

    return _templates(language).find(english, say) or english
