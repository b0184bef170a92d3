"""Declaration texts to variable sections, as far as PLCopen XML has a place for them.

What cannot be read is left out: the plain text stands beside the sections and is what counts.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from tappet.project.declaration_text import SECTION_KEYWORDS, Word, words
from tappet.project.exchange.text_parts import NAME

_FLAGS = {"CONSTANT": "constant", "RETAIN": "retain", "NON_RETAIN": "nonretain", "PERSISTENT": "persistent"}
_OPEN, _CLOSE = frozenset("(["), frozenset(")]")


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of a section; texts as they are written."""

    name: str
    type: str
    address: str = ""
    initial: str = ""
    comment: str = ""


@dataclass(frozen=True, slots=True)
class Section:
    """VAR_INPUT ... END_VAR."""

    keyword: str
    flags: tuple[str, ...]
    variables: tuple[Variable, ...]


def read_sections(text: str) -> list[Section]:
    """The sections of a declaration."""
    scan = list(words(text))
    found: list[Section] = []
    i = 0
    while i < len(scan):
        if scan[i].text not in SECTION_KEYWORDS:
            i += 1
            continue
        keyword = scan[i].text
        i += 1
        flags: list[str] = []
        while i < len(scan) and scan[i].text in _FLAGS:
            flags.append(_FLAGS[scan[i].text])
            i += 1
        start = i
        while i < len(scan) and scan[i].text != "END_VAR":
            i += 1
        variables = tuple(_variables(text, scan[start:i]))
        found.append(Section(keyword, tuple(dict.fromkeys(flags)), variables))
        i += 1
    return found


def return_type(text: str) -> str:
    """The type behind the colon of a header, empty for none."""
    scan = words(text)
    for word in scan:
        if word.text in SECTION_KEYWORDS:
            return ""
        if word.text == ":":
            line_end = text.find("\n", word.end)
            stop = len(text) if line_end < 0 else line_end
            kept = [item for item in words(text, word.end) if item.end <= stop and item.text != ";"]
            return text[kept[0].start : kept[-1].end] if kept else ""
    return ""


def members(text: str, scan: list[Word]) -> list[Variable]:
    """The members between STRUCT and END_STRUCT."""
    return list(_variables(text, scan))


def _variables(text: str, scan: list[Word]) -> Iterator[Variable]:
    for part in _statements(scan):
        yield from _declared(text, part)


def _statements(scan: list[Word]) -> Iterator[list[Word]]:
    part: list[Word] = []
    depth = structures = 0
    for word in scan:
        depth += (word.text in _OPEN) - (word.text in _CLOSE)
        structures += (word.text in ("STRUCT", "UNION")) - (word.text in ("END_STRUCT", "END_UNION"))
        if word.text == ";" and depth <= 0 and structures <= 0:
            if part:
                yield [*part, word]
            part = []
        else:
            part.append(word)


def _declared(text: str, part: list[Word]) -> Iterator[Variable]:
    colon = next((i for i, word in enumerate(part) if word.text == ":"), None)
    if not colon:
        return
    names: list[str] = []
    address = ""
    for i, word in enumerate(part[:colon]):
        if word.text == "AT":
            address = text[word.end : part[colon].start].strip()
            break
        if NAME.fullmatch(word.text) and (i == 0 or part[i - 1].text == ","):
            names.append(text[word.start : word.end])
    assigned = next((i for i, word in enumerate(part) if i > colon and word.text == ":="), None)
    type_end = assigned if assigned is not None else len(part) - 1
    if type_end <= colon + 1:
        return
    kind = text[part[colon + 1].start : part[type_end - 1].end]
    initial = ""
    if assigned is not None and assigned + 1 < len(part) - 1:
        initial = text[part[assigned + 1].start : part[-2].end]
    for name in names:
        yield Variable(name, kind, address, initial, _comment_behind(text, part[-1].end))


def _comment_behind(text: str, end: int) -> str:
    line_end = text.find("\n", end)
    rest = text[end : line_end if line_end >= 0 else len(text)].strip()
    if rest.startswith("//"):
        return rest.lstrip("/").strip()
    match = re.fullmatch(r"\(\*(.*)\*\)", rest)
    return match[1].strip() if match else ""
