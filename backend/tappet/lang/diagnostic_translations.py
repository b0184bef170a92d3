"""Messages in other languages than the English of `diagnostics.csv`: `diagnostics_<language>.csv`, and for
what their places add, such as advice and names of kinds, `phrases_<language>.csv`."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from functools import cache, lru_cache, partial
from importlib.resources import files
from types import MappingProxyType
from typing import NamedTuple

from tappet.lang.diagnostics import TABLE
from tappet.translation.language import Language
from tappet.translation.sentences import sentence
from tappet.translation.templates import FIELD, Templates

_KINDS = frozenset({"what", "verb", "needed", "given", "count", "expected", "where", "size", "place"})
"""Facts that say what something is; all others may be names."""
_TOKENS = frozenset({"found", "expected", "begin", "end"})
"""Facts that quote a token of the program in English quotation marks, `';'`."""
_QUOTED = re.compile(r"'(.+)'", re.DOTALL)
_GAP = re.compile(r"(?<=”) (?=[\u3400-\u9fff])|(?<=[\u3400-\u9fff]) (?=“)")
"""A space between Chinese and its quotation marks: templates have it for tokens that are not quoted."""


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

    They stay English where the language has no words for the code.
    """
    own = _translated(language).get(code)
    if own is None:
        return english
    words = {name: _fact(name, value, language) for name, value in facts.items()}
    try:
        usual = TABLE[code].advice.format_map(facts) == english.advice
        advice = own.advice.format_map(words) if usual else phrase(english.advice, language)
        return Texts(_GAP.sub("", own.message.format_map(words)), advice)
    except KeyError:  # a fact that only the advice of its place has
        return english


def _fact(name: str, value: str, language: Language) -> str:
    """A fact in words of the language: one word may be a name of the program unless the fact is a kind."""
    found = phrase(value, language) if name in _KINDS or " " in value else value
    if found == value and name == "reason":
        found = _messages(language).find(value, partial(_said_in, language)) or value
    if found == value and name == "text":
        found = sentence(value, language)
    if name in _TOKENS and (token := _QUOTED.fullmatch(found)) is not None:
        return f"“{token[1]}”"
    return found


@cache
def _phrases(language: Language) -> Templates:
    """What places add to messages."""
    if language == "en":
        return Templates(())
    table = files("tappet.lang").joinpath(f"phrases_{language}.csv").read_text(encoding="utf-8")
    return Templates((row["english"], row["chinese"]) for row in csv.DictReader(table.splitlines()))


@cache
def _messages(language: Language) -> Templates:
    """Whole messages: some are the reason of others."""
    own = _translated(language)
    found = [(TABLE[code].message, own[code].message) for code in sorted(own.keys() & TABLE.keys())]
    return Templates(row for row in found if FIELD.sub("", row[0]).strip())


@lru_cache(maxsize=10_000)
def phrase(english: str, language: Language) -> str:
    """What a place adds to a message, such as its advice, in a language; as it is where there are no
    words."""
    return _phrases(language).find(english, partial(_said_in, language)) or english


def _said_in(language: Language, _field: str, fact: str) -> str:
    return phrase(fact, language)
