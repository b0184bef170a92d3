"""Which template a text was made of, and the text of another language with the same facts.

A row is an English text with fields, `There is no task '{name}'.`, and its translation with the same fields.
Several rows may fit a text: the one with the longest literal text is taken, of equal ones the first by
alphabet. A field takes as little as it can, so a match takes time in proportion to the text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple

FIELD = re.compile(r"(?<!\{)\{([a-z_]+)\}(?!\})")
"""A double brace stands for one that is shown."""

Say = Callable[[str, str], str | None]
"""What becomes of a fact: the name of its field and its text; None where there are no words for it."""
_FEW_LETTERS = 4


class _Row(NamedTuple):
    key: str
    """Literal text that every text of the template holds: says no faster than the pattern does."""
    pattern: re.Pattern[str]
    translation: str
    frame: bool
    """Whether it joins texts with hardly more than punctuation, so that it says nothing without them."""


class Templates:
    """Translations of whole texts and of templates with fields.

    Fields hold one character or more; those of `optional` may be empty, those of `words` have no blanks.
    """

    def __init__(
        self,
        rows: Iterable[tuple[str, str]],
        optional: frozenset[str] = frozenset(),
        words: frozenset[str] = frozenset(),
    ) -> None:
        known = sorted(rows, key=lambda row: (-len(FIELD.sub("", row[0])), row[0]))
        self._whole: Mapping[str, str] = MappingProxyType(
            {_shown(english): _shown(translation) for english, translation in known}
        )
        self._rows = tuple(
            _row(english, translation, optional, words)
            for english, translation in known
            if FIELD.search(english)
        )

    def find(self, text: str, say: Say) -> str | None:
        """The translation with its facts in the words of `say`; None where nothing fits."""
        whole = self._whole.get(text)
        if whole is not None:
            return whole
        for row in self._rows:
            match = row.pattern.fullmatch(text) if row.key in text else None
            if match is not None:
                facts = match.groupdict()
                said = {name: say(name, fact) for name, fact in facts.items()}
                if not row.frame or None not in said.values():
                    return filled(row.translation, {name: said[name] or facts[name] for name in facts})
        return None


def filled(template: str, facts: Mapping[str, str]) -> str:
    """A template with its facts; one that it does not name is left out."""
    parts = FIELD.split(template)
    return "".join(facts[part] if number % 2 else _shown(part) for number, part in enumerate(parts))


def _shown(text: str) -> str:
    return text.replace("{{", "{").replace("}}", "}")


def _row(english: str, translation: str, optional: frozenset[str], words: frozenset[str]) -> _Row:
    parts = FIELD.split(english)
    literals = parts[::2] = [_shown(literal) for literal in parts[::2]]
    frame = sum(character.isalpha() for literal in literals for character in literal) < _FEW_LETTERS
    return _Row(max(literals, key=len), _pattern(parts, optional, words), translation, frame)


def _pattern(parts: list[str], optional: frozenset[str], words: frozenset[str]) -> re.Pattern[str]:
    """What a template has been filled in to; `parts` are its literal texts and, between them, its fields."""
    names = parts[1::2]
    if len(set(names)) < len(names):  # the same fact twice: a first guess may have to be taken back
        return re.compile("".join(_repeated(parts)), re.DOTALL)
    pattern = re.escape(parts[0])
    for number, name in enumerate(names):
        fact = (r"\S" if name in words else ".") + ("*?" if name in optional else "+?")
        field = f"(?P<{name}>{fact})" + re.escape(parts[2 * number + 2])
        pattern += field if number == len(names) - 1 else f"(?>{field})"
    return re.compile(pattern, re.DOTALL)


def _repeated(parts: list[str]) -> Iterable[str]:
    seen: set[str] = set()
    for number, part in enumerate(parts):
        if number % 2 == 0:
            yield re.escape(part)
        else:
            yield f"(?P={part})" if part in seen else f"(?P<{part}>.+?)"
            seen.add(part)
