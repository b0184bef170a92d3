"""The reference of the words and signs of the language: `reference.csv`, and what the tables of it say.

A row of the table is one topic: its words, the first of which is its title, an example, and what it means
in English and Chinese. Sizes and ranges of types come from `iec.words`; a keyword that closes something
belongs to the topic of the one that opens it. A test compares the words with those of the language, both
ways.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from tappet.iec import words
from tappet.translation.language import Language


@dataclass(frozen=True, slots=True)
class Topic:
    """Words that mean one thing, or belong together."""

    words: tuple[str, ...]
    """In upper case, the title first; with the keywords that close them."""
    group: str
    """declaration, section, modifier, statement, operator, function, type, constant."""
    example: str
    texts: Mapping[Language, str]

    @property
    def title(self) -> str:
        """The word it is found under."""
        return self.words[0]

    def text(self, language: Language) -> str:
        """What it means, with the size and range of an elementary type."""
        facts = _type_facts(self.title, language)
        return f"{self.texts[language]} {facts}" if facts else self.texts[language]


@cache
def topics() -> Mapping[str, Topic]:
    """All topics by title, in the order of the table."""
    table = files("tappet.lang").joinpath("reference.csv").read_text(encoding="utf-8")
    found = {}
    for row in csv.DictReader(table.splitlines(keepends=True)):
        named = tuple(row["words"].split())
        ends = tuple(
            words.ENDS[word] for word in named if word in words.ENDS and words.ENDS[word] not in named
        )
        if row["group"] == "section":
            ends = ("END_VAR",) if named == ("VAR",) else ()
        topic = Topic((*named, *ends), row["group"], row["syntax"], {"en": row["en"], "zh": row["zh"]})
        found[topic.title] = topic
    return MappingProxyType(found)


_FAMILIES: Mapping[str, tuple[str, str]] = {
    "signed": ("Range {low} to {high}.", "范围 {low} 至 {high}。"),
    "unsigned": ("Range {low} to {high}.", "范围 {low} 至 {high}。"),
}
_SIZE = ("Takes {size} byte(s).", "占 {size} 个字节。")


def _type_facts(name: str, language: Language) -> str:
    known = words.elementary_type(name)
    if known is None:
        return ""
    at = 0 if language == "en" else 1
    said = [_SIZE[at].format(size=known.size)]
    if known.family in _FAMILIES:
        bits = known.size * 8
        low, high = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if known.signed else (0, (1 << bits) - 1)
        said.append(_FAMILIES[known.family][at].format(low=low, high=high))
    return (" " if language == "en" else "").join(said)
