"""Messages in other languages than the English of `diagnostics.csv`: `diagnostics_<language>.csv`, and for
what their places add, such as advice and names of kinds, `phrases_<language>.csv`."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from functools import cache, lru_cache
from importlib.resources import files
from types import MappingProxyType
from typing import Literal, NamedTuple

from tappet.lang.diagnostics import TABLE

Language = Literal["en", "zh"]


_KINDS = frozenset({"what", "verb", "needed", "given", "count", "expected", "where", "size", "place"})
"""Facts that say what something is; all others may be names."""
_FIELD = re.compile(r"\{([a-z_]+)\}")


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
        return Texts(own.message.format_map(words), advice)
    except KeyError:  # a fact that only the advice of its place has
        return english


def _fact(name: str, value: str, language: Language) -> str:
    """A fact in words of the language: one word may be a name of the program unless the fact is a kind."""
    found = phrase(value, language) if name in _KINDS or " " in value else value
    if found == value and name == "reason":
        found = _filled(value, _messages(language), language) or value
    return found


class _Phrases(NamedTuple):
    """What places add to messages: whole texts, and patterns of texts that hold others."""

    whole: Mapping[str, str]
    patterns: tuple[tuple[re.Pattern[str], str], ...]


def _pattern(english: str) -> re.Pattern[str]:
    """What an English template with fields has been filled in to."""
    parts = _FIELD.split(english.replace("{{", "{").replace("}}", "}"))
    seen: set[str] = set()
    for number in range(1, len(parts), 2):
        name = parts[number]
        parts[number] = f"(?P={name})" if name in seen else f"(?P<{name}>.+?)"
        seen.add(name)
    return re.compile("".join(part if n % 2 else re.escape(part) for n, part in enumerate(parts)), re.DOTALL)


@cache
def _phrases(language: Language) -> _Phrases:
    if language == "en":
        return _Phrases({}, ())
    table = files("tappet.lang").joinpath(f"phrases_{language}.csv").read_text(encoding="utf-8")
    rows = [(row["english"], row["chinese"]) for row in csv.DictReader(table.splitlines())]
    exact_first = sorted(rows, key=lambda row: -len(_FIELD.sub("", row[0])))
    patterns = [(_pattern(english), text) for english, text in exact_first if _FIELD.search(english)]
    return _Phrases(dict(rows), tuple(patterns))


@cache
def _messages(language: Language) -> tuple[tuple[re.Pattern[str], str], ...]:
    """Whole messages: some are the reason of others."""
    own = _translated(language)
    codes = sorted(own.keys() & TABLE.keys(), key=lambda code: -len(TABLE[code].message))
    found = [(TABLE[code].message, own[code].message) for code in codes]
    return tuple((_pattern(english), text) for english, text in found if _FIELD.sub("", english).strip())


@lru_cache(maxsize=10_000)
def phrase(english: str, language: Language) -> str:
    """What a place adds to a message, such as its advice, in a language; as it is where there are no
    words."""
    table = _phrases(language)
    found = table.whole.get(english)
    if found is not None:
        return found
    return _filled(english, table.patterns, language) or english


def _filled(
    english: str, patterns: tuple[tuple[re.Pattern[str], str], ...], language: Language
) -> str | None:
    """The text of the first pattern that fits."""
    for pattern, text in patterns:
        match = pattern.fullmatch(english)
        if match is not None:
            parts = match.groupdict()
            return text.format_map({name: phrase(part, language) for name, part in parts.items()})
    return None


def language_of(tag: str | None) -> Language:
    """The language of our texts for a tag such as `zh-CN`; English for those that we do not speak."""
    return "zh" if (tag or "").lower().startswith("zh") else "en"
