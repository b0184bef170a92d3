"""A light reader of declarations: what a text declares, the name in its header, where its body begins.

What is read here must work on texts that do not compile, because the tree, the icons and the files have to be
right while somebody is typing.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import lru_cache

from tappet.iec.tokens import NAME, NOT_CODE, TRIVIA, Kind, Word, extent, pieces, words
from tappet.iec.words import ACCESSORS, ENDS, GENERIC_SECTION, MODIFIERS, OBJECT_ENDS, SECTIONS

BEGINNINGS = {
    **{word: end for word, end in OBJECT_ENDS.items() if word != "TRANSITION"},
    "FUNCTIONBLOCK": "END_FUNCTION_BLOCK",  # CoDeSys 2.3
}
"""Keywords that begin the text of an object, and what closes it; a transition is a part of its chart."""
_CLOSING = frozenset(BEGINNINGS.values())
_NO_NAMES = SECTIONS | frozenset(ENDS.values()) | {"END_VAR"}
_END_VAR = re.compile(rf"{NOT_CODE}|(?P<end_var>(?<![\w%#])(?i:END_VAR)(?![\w#]))")
_HEADER_CONTINUES_WITH = frozenset(["EXTENDS", "IMPLEMENTS", ":", ","])
_STATEMENT_SECOND = frozenset([":=", "(", "[", ".", "^", ";"])
_HEADER_CONTINUES_AFTER = _HEADER_CONTINUES_WITH | frozenset(["OF", "TO"])


@dataclass(frozen=True, slots=True)
class Header:
    """The first words of a text: what it declares and under which name."""

    keyword: str
    """PROGRAM, FUNCTION_BLOCK, FUNCTION, METHOD, ACTION, PROPERTY, INTERFACE, TYPE or a section keyword."""
    name: str | None
    name_start: int
    """Offset of the name in the text; where the name would stand when there is none."""


@lru_cache(maxsize=1024)
def read_header(text: str) -> Header | None:
    """The header of a text, None when it does not begin with a keyword that declares something."""
    scan = words(text)
    first = next(scan, None)
    if first is None or (first.text not in BEGINNINGS and first.text not in SECTIONS):
        return None
    if first.text in SECTIONS or first.text in ACCESSORS:
        return Header(first.text, None, first.end)
    for word in scan:
        if word.text in MODIFIERS:
            continue
        if NAME.fullmatch(word.text) and word.text not in _NO_NAMES:
            if "\n" in text[first.end : word.start] and _goes_on_as_statement(scan):
                break
            return Header(first.text, text[word.start : word.end], word.start)
        break
    return Header(first.text, None, first.end)


def _goes_on_as_statement(scan: Iterator[Word]) -> bool:
    """Whether the word before is no name in a later line of the header, but begins the body."""
    word = next(scan, None)
    return word is not None and word.text in _STATEMENT_SECOND


def rename_header(text: str, name: str) -> str:
    """The text with `name` as the name in its header; unchanged when the header has no name."""
    header = read_header(text)
    if header is None or header.name is None:
        return text
    return text[: header.name_start] + name + text[header.name_start + len(header.name) :]


@lru_cache(maxsize=1024)
def subkind_of(text: str) -> str | None:
    """What a declaration declares: program, function_block, function, method, property, interface, action,
    struct, union, enum, subrange or alias; gvl for a list of variables; None when the text does not say.
    """
    header = read_header(text)
    if header is None:
        return None
    if header.keyword in SECTIONS:
        return "gvl"
    if header.keyword == "FUNCTIONBLOCK":
        return "function_block"
    if header.keyword != "TYPE":
        return header.keyword.lower()
    return _type_subkind(text, header)


def _type_subkind(text: str, header: Header) -> str | None:
    scan = words(text, header.name_start + len(header.name or ""))
    for word in scan:
        if word.text == ":":
            break
        if word.text == "END_TYPE":
            return None
    first = next(scan, None)
    if first is None or first.text == "END_TYPE":
        return None
    if first.text in ("STRUCT", "UNION"):
        return first.text.lower()
    if first.text == "(":
        return "enum"
    second = next(scan, None)
    return "subrange" if second is not None and second.text == "(" and _has_range(scan) else "alias"


def _has_range(scan: Iterator[Word]) -> bool:
    """Whether `..` follows before the closing parenthesis: INT(0..10) is a subrange, STRING(80) is not."""
    for word in scan:
        if word.text in (")", ";"):
            return False
        if word.text == "..":
            return True
    return False


def end_keyword(text: str) -> str | None:
    """The keyword that closes a text with this declaration, None when the declaration does not say."""
    header = read_header(text)
    return None if header is None else BEGINNINGS.get(header.keyword)


def declaration_end(text: str) -> int:
    """Offset where the declaration part of a whole text ends and the line break before its body stands.

    The declaration part is the header and the variable sections that follow it; a comment on the last line
    belongs to it. A header without sections ends with the line of its name or the last one that continues it.
    """
    header = read_header(text)
    if header is None:
        return 0
    named = -1 if header.name is None else header.name_start
    end = 0
    last = ""
    sections_begun = False
    scan = words(text)
    while (word := next(scan, None)) is not None:
        if word.text in SECTIONS:
            section_end = _end_of_section(text, word.end)
            if section_end is None:
                return len(text)
            sections_begun, end = word.text != GENERIC_SECTION, section_end
            last = ""
            scan = words(text, end)
        elif sections_begun or (word.start > named and not _continues_header(text, end, last, word)):
            break
        else:
            end, last = word.end, word.text
    return commented_line_end(text, end) if end else 0


def _end_of_section(text: str, position: int) -> int | None:
    """Where END_VAR ends behind an offset; searched for, because sections are long."""
    while (match := _END_VAR.search(text, position)) is not None:
        if match["end_var"]:
            return match.end()
        position = extent(text, match[0], match.start())
    return None


def _continues_header(text: str, end: int, last: str, word: Word) -> bool:
    if word.text in _CLOSING:
        return False
    return (
        end == 0
        or "\n" not in text[end : word.start]
        or word.text in _HEADER_CONTINUES_WITH
        or last in _HEADER_CONTINUES_AFTER
    )


def commented_line_end(text: str, end: int, kinds: Collection[Kind] = TRIVIA) -> int:
    """End of the line of offset `end` if only blanks and pieces of these kinds follow there, else `end`."""
    position = end
    for kind, _, start, stop in pieces(text, end):
        line_break = text.find("\n", position, start)
        if line_break >= 0:
            return line_break
        if kind not in kinds:
            return end
        position = stop
    line_break = text.find("\n", position)
    return line_break if line_break >= 0 else len(text)
