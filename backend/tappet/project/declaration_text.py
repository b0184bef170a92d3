"""A light reader of declarations: what a text declares, the name in its header, where its body begins.

The compiler's parser is another room. What is read here must work on texts that do not compile, because the
tree, the icons and the files have to be right while somebody is typing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

_TRIVIA_OR_TOKEN = re.compile(
    r"""
    (?P<blank>\s+) | (?P<line_comment>//[^\n]*) | (?P<comment>\(\*) | (?P<c_comment>/\*)
    | (?P<pragma>\{[^}]*\}?) | (?P<word>[^\W\d]\w*) | (?P<string>'(?:\$.|[^'$\n])*'? | "(?:\$.|[^"$\n])*"?)
    | (?P<number>\d\w*) | (?P<assign>:=) | (?P<symbol>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_END_VAR = re.compile(
    r"""
    (?P<line_comment>//[^\n]*) | (?P<comment>\(\*) | (?P<c_comment>/\*) | (?P<pragma>\{[^}]*\}?)
    | (?P<string>'(?:\$.|[^'$\n])*'? | "(?:\$.|[^"$\n])*"?) | (?<!\w)(?P<end_var>END_VAR)(?!\w)
    """,
    re.VERBOSE | re.DOTALL | re.IGNORECASE,
)
"""The end of a section, or what it must not be looked for in."""
_PARAMETER_LIST = re.compile(r"\{\s*attribute\s+'parameter_list'", re.IGNORECASE)
_TRIVIA = frozenset(["blank", "line_comment", "comment", "c_comment", "pragma"])
_COMMENT_EDGE = re.compile(r"\(\*|\*\)")

END_KEYWORDS = {
    "PROGRAM": "END_PROGRAM",
    "FUNCTION_BLOCK": "END_FUNCTION_BLOCK",
    "FUNCTIONBLOCK": "END_FUNCTION_BLOCK",  # CoDeSys 2.3
    "FUNCTION": "END_FUNCTION",
    "METHOD": "END_METHOD",
    "ACTION": "END_ACTION",
    "PROPERTY": "END_PROPERTY",
    "INTERFACE": "END_INTERFACE",
    "GET": "END_GET",
    "SET": "END_SET",
    "TYPE": "END_TYPE",
}
"""The keyword that closes the text of an object, by the keyword that opens it."""

_SECTIONS = "INPUT OUTPUT IN_OUT GLOBAL TEMP STAT EXTERNAL CONFIG ACCESS INST"
SECTION_KEYWORDS = frozenset(["VAR", *(f"VAR_{section}" for section in _SECTIONS.split())])
"""Keywords that open a block of variables (LDEC-02)."""

MODIFIERS = frozenset(["PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "FINAL", "ABSTRACT", "OVERRIDE"])
"""Words between the keyword and the name of a header."""
_HEADER_CONTINUES_WITH = frozenset(["EXTENDS", "IMPLEMENTS", ":", ","])
_HEADER_CONTINUES_AFTER = _HEADER_CONTINUES_WITH | MODIFIERS | frozenset(["OF", "TO"])


@dataclass(frozen=True, slots=True)
class Word:
    """A token of a text: a word in upper case, a symbol, or a literal; with its place."""

    text: str
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Header:
    """The first words of a text: what it declares and under which name."""

    keyword: str
    """PROGRAM, FUNCTION_BLOCK, FUNCTION, METHOD, ACTION, PROPERTY, INTERFACE, TYPE or a section keyword."""
    name: str | None
    name_start: int
    """Offset of the name in the text; where the name would stand when there is none."""


def words(text: str, start: int = 0) -> Iterator[Word]:
    """The tokens of a text from offset `start`, without blanks, comments (nested ones too) and pragmas."""
    for kind, begin, end in _scan(text, start):
        if kind not in _TRIVIA:
            token = text[begin:end]
            yield Word(token.upper() if kind == "word" else token, begin, end)


def trivia(text: str, start: int, end: int) -> Iterator[Word]:
    """The comments and pragmas between two offsets, the first of which is no middle of one."""
    for kind, begin, stop in _scan(text, start):
        if begin >= end:
            return
        if kind in _TRIVIA and kind != "blank":
            yield Word(text[begin:stop], begin, stop)


PARAMETER_LIST = "{attribute 'parameter_list'}"
"""Marks a global variable list as the parameters of a library."""


def is_parameter_list(text: str) -> bool:
    """Whether a global variable list has the mark of a parameter list."""
    if "parameter_list" not in text.lower():
        return False
    pragmas = (text[begin:end] for kind, begin, end in _scan(text, 0) if kind == "pragma")
    return any(_PARAMETER_LIST.match(pragma) for pragma in pragmas)


def as_parameter_list(text: str) -> str:
    """The text of a global variable list with the mark, in the line before its first section."""
    if is_parameter_list(text):
        return text
    first = next(words(text), None)
    start = text.rfind("\n", 0, first.start) + 1 if first is not None else len(text)
    return f"{text[:start]}{PARAMETER_LIST}\n{text[start:]}"


def _scan(text: str, start: int) -> Iterator[tuple[str, int, int]]:
    """Everything in a text, trivia too: (kind, start, end)."""
    position = start
    while position < len(text):
        match = _TRIVIA_OR_TOKEN.match(text, position)
        assert match is not None, "the pattern matches any character"
        kind = match.lastgroup or ""
        position = _end_of_trivia(text, match)
        yield kind, match.start(), position


def _end_of_trivia(text: str, match: re.Match[str]) -> int:
    """Where a match ends; for the opening of a comment, where the comment ends."""
    if match.lastgroup == "comment":
        return _end_of_comment(text, match.end())
    if match.lastgroup == "c_comment":
        closing = text.find("*/", match.end())
        return len(text) if closing < 0 else closing + 2
    return match.end()


def _end_of_comment(text: str, position: int) -> int:
    """Offset behind the `*)` that closes the comment whose `(*` ends at `position`; comments nest."""
    depth = 1
    while depth:
        edge = _COMMENT_EDGE.search(text, position)
        if edge is None:
            return len(text)
        depth += 1 if edge.group() == "(*" else -1
        position = edge.end()
    return position


@lru_cache(maxsize=1024)
def read_header(text: str) -> Header | None:
    """The header of a text, None when it does not begin with a keyword that declares something."""
    scan = words(text)
    first = next(scan, None)
    if first is None or (first.text not in END_KEYWORDS and first.text not in SECTION_KEYWORDS):
        return None
    if first.text in SECTION_KEYWORDS or first.text in ("GET", "SET"):
        return Header(first.text, None, first.end)
    for word in scan:
        if word.text in MODIFIERS:
            continue
        if re.match(r"[^\W\d]", word.text) and word.text not in SECTION_KEYWORDS | set(END_KEYWORDS.values()):
            return Header(first.text, text[word.start : word.end], word.start)
        break
    return Header(first.text, None, first.end)


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
    if header.keyword in SECTION_KEYWORDS:
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
    previous = ""
    for word in scan:
        if word.text in (")", ";"):
            return False
        if word.text == "." and previous.endswith("."):
            return True
        previous = word.text
    return False


def end_keyword(text: str) -> str | None:
    """The keyword that closes a text with this declaration, None when the declaration does not say."""
    header = read_header(text)
    return None if header is None else END_KEYWORDS.get(header.keyword)


def declaration_end(text: str) -> int:
    """Offset where the declaration part of a whole text ends and the line break before its body stands.

    The declaration part is the header and the variable sections that follow it; a comment on the last line
    belongs to it. A header without sections ends with its line.
    """
    header = read_header(text)
    end = 0
    sections_begun = False
    last = ""
    scan = words(text)
    while (word := next(scan, None)) is not None:
        if word.text in SECTION_KEYWORDS:
            section = _END_VAR.search(text, word.end)
            while section is not None and section.lastgroup != "end_var":
                section = _END_VAR.search(text, _end_of_trivia(text, section))
            if section is None:
                return len(text)
            sections_begun, end = True, section.end()
            scan = words(text, end)
        elif sections_begun or header is None or not _continues_header(text, end, last, word):
            break
        else:
            end, last = word.end, word.text
    return _end_of_commented_line(text, end) if end else 0


def _continues_header(text: str, end: int, last: str, word: Word) -> bool:
    if word.text in END_KEYWORDS.values():
        return False
    return (
        end == 0
        or "\n" not in text[end : word.start]
        or word.text in _HEADER_CONTINUES_WITH
        or last in _HEADER_CONTINUES_AFTER
    )


def _end_of_commented_line(text: str, end: int) -> int:
    """End of the line of offset `end` if only blanks and comments follow there, else `end` itself."""
    for kind, start, stop in _scan(text, end):
        if kind == "blank":
            line_break = text.find("\n", start, stop)
            if line_break >= 0:
                return line_break
        elif kind not in _TRIVIA:
            return end
    return len(text)
