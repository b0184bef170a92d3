"""Messages in other languages than the English of `diagnostics.csv`: `diagnostics_<language>.csv`."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Literal, NamedTuple

from tappet.lang.diagnostics import TABLE

Language = Literal["en", "zh"]


class Texts(NamedTuple):
    """Templates of a message and its advice; both have the fields of the English ones, or fewer."""

    message: str
    advice: str


@cache
def _translated(language: Language) -> Mapping[str, Texts]:
    if language == "en":
        return MappingProxyType({})
    table = files("tappet.lang").joinpath(f"diagnostics_{language}.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(table.splitlines())
    return MappingProxyType({row["code"]: Texts(row["message"], row["advice"]) for row in rows})


def translated_codes(language: Language) -> frozenset[str]:
    """The codes that have texts in a language."""
    return frozenset(TABLE) if language == "en" else frozenset(_translated(language))


def texts(code: str, language: Language) -> Texts:
    """The templates of a code, the English ones where the language has none."""
    entry = TABLE[code]
    return _translated(language).get(code) or Texts(entry.message, entry.advice)


def said(code: str, english: Texts, facts: Mapping[str, str], language: Language) -> Texts:
    """A message and its advice in a language, made of the facts of its report.

    They stay English where the language has no words for the code; advice that the place gave stays as it is.
    """
    own = _translated(language).get(code)
    if own is None:
        return english
    try:
        usual = TABLE[code].advice.format_map(facts) == english.advice
        return Texts(own.message.format_map(facts), own.advice.format_map(facts) if usual else english.advice)
    except KeyError:  # a fact that only the advice of its place has
        return english


def language_of(tag: str | None) -> Language:
    """The language of our texts for a tag such as `zh-CN`; English for those that we do not speak."""
    return "zh" if (tag or "").lower().startswith("zh") else "en"
