"""User names that people cannot tell apart: written with letters of other scripts, or with invisible ones.

The table is that of Unicode UTS #39 (confusables), as the package confusable-homoglyphs carries it: pairs of
characters, or of a character and a sequence, that look alike in common fonts.
"""

from __future__ import annotations

import json
import unicodedata
from collections.abc import Iterable
from functools import cache
from importlib.resources import files

_BESIDE = dict(zip(map(ord, "ьκкмптτχςⲍ"), "bkkmnttxcz", strict=True))
"""Small letters of which the table has the capital ones only, and that a hurried eye takes for Latin ones."""
_MARKS = range(0x300, 0x370)
"""Accents of Latin, Greek and Cyrillic letters; in other scripts marks are vowels."""


def look_alike(one: str, other: str) -> bool:
    """Whether two names look the same as they are written, or in small letters."""
    return skeleton(one) == skeleton(other) or skeleton(one.casefold()) == skeleton(other.casefold())


def skeleton(name: str) -> str:
    """Equal for names that look the same but for small and capital letters; it is no name itself."""
    table = _prototypes()
    before, shown = "", name
    while shown != before:
        before = shown
        shown = unicodedata.normalize("NFKD", shown)
        shown = "".join(c for c in _visible(shown) if ord(c) not in _MARKS)
        shown = shown.translate(table).casefold().translate(table)
    return shown


def _visible(text: str) -> str:
    """Without formatting characters: the table has such around letters written from right to left."""
    return "".join(c for c in text if unicodedata.category(c) != "Cf")


@cache
def _prototypes() -> dict[int, str]:
    """What stands for each character: of all that look alike one, or the sequence that they look like."""
    text = files("confusable_homoglyphs").joinpath("confusables.json").read_text("utf-8")
    groups: dict[str, set[str]] = {}
    for one, others in json.loads(text).items():
        look = _visible(one)
        joined = groups.get(look, {look})
        for other in (_visible(entry["c"]) for entry in others):
            joined |= groups.get(other, {other})
        for member in joined:
            groups[member] = joined
    chosen = {member: _prototype(group) for member, group in groups.items() if len(member) == 1}
    found = {ord(member): prototype for member, prototype in chosen.items() if prototype != member}
    return {code: prototype.translate(found) for code, prototype in found.items()} | _BESIDE


def _prototype(group: Iterable[str]) -> str:
    """A sequence of characters, else the plainest one: an ASCII letter, in small if there is one."""
    return min(
        group,
        key=lambda look: (len(look) == 1, not look.isascii(), not look.isalpha(), not look.islower(), look),
    )
