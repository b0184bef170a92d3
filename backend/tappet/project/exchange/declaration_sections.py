"""Declaration texts to headers and variable sections, as far as PLCopen XML has a place for them.

What cannot be read is left out: the plain text stands beside the sections and is what counts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from tappet.iec.sections import read_header
from tappet.iec.tokens import COMMENT, NAME, Word, pieces, trivia, words
from tappet.iec.trivia import attribute_of
from tappet.iec.words import GENERIC_SECTION, MODIFIERS, SECTIONS

_FLAGS = {"CONSTANT": "constant", "RETAIN": "retain", "NON_RETAIN": "nonretain", "PERSISTENT": "persistent"}
_OPEN, _CLOSE = frozenset("(["), frozenset(")]")


@dataclass(frozen=True, slots=True)
class Notes:
    """What stands before a declaration."""

    comment: str = ""
    attributes: tuple[tuple[str, str], ...] = ()
    """Name and value of each attribute pragma."""


@dataclass(frozen=True, slots=True)
class Head:
    """The header of a POU, method, property or interface, or the first of a TYPE block."""

    notes: Notes
    modifiers: tuple[str, ...] = ()
    """PUBLIC, ABSTRACT ... as they stand."""
    extends: tuple[str, ...] = ()
    implements: tuple[str, ...] = ()


def read_head(text: str) -> Head:
    """The header of a declaration with what stands before it."""
    header = read_header(text)
    scan = list(words(text))
    if header is None or not scan or header.keyword in SECTIONS:
        return Head(Notes())
    notes = read_notes(text, 0, scan[0].start)
    before = [word for word in scan[1:] if word.end <= header.name_start]
    behind = _without_generic_section([word for word in scan if word.start >= header.name_start])
    end = next((word.start for word in behind if word.text in SECTIONS), len(text))
    bases: dict[str, tuple[str, ...]] = {}
    for i, word in enumerate(behind):
        if word.start >= end or word.text == ":":
            break
        if word.text in ("EXTENDS", "IMPLEMENTS"):
            bases[word.text] = tuple(_names(text, behind[i + 1 :]))
    modifiers = tuple(word.text for word in before if word.text in MODIFIERS)
    return Head(notes, modifiers, bases.get("EXTENDS", ()), bases.get("IMPLEMENTS", ()))


def _names(text: str, scan: list[Word]) -> Iterator[str]:
    """The names that a list begins with, parted by commas: `I_A, Lib.I_B`."""
    name = ""
    for word in scan:
        is_name = NAME.fullmatch(word.text) is not None
        if word.text == "," and name:
            yield name
            name = ""
        elif (is_name and name[-1:] in ("", ".")) or (word.text == "." and name):
            name += text[word.start : word.end]
        else:
            break
    if name:
        yield name


def _without_generic_section(scan: list[Word]) -> list[Word]:
    """The words of a header without its generic constants."""
    start = next((i for i, word in enumerate(scan) if word.text == GENERIC_SECTION), None)
    if start is None:
        return scan
    end = next((i for i, word in enumerate(scan) if i > start and word.text == "END_VAR"), len(scan) - 1)
    return scan[:start] + scan[end + 1 :]


def read_notes(text: str, start: int, end: int, *, behind: bool = False) -> Notes:
    """The comments and attributes between two offsets.

    `behind`: a comment on the line of the first offset belongs to what stands before it.
    """
    line_end = text.find("\n", start) if behind else start
    comments: list[str] = []
    attributes = []
    for item in trivia(text, start, end):
        attribute = attribute_of(item.text)
        if attribute is not None:
            attributes.append((attribute.name, attribute.value or ""))
        elif not item.text.startswith("{") and (item.start >= line_end >= 0):
            comments += _comment_lines(item.text)
    return Notes("\n".join(comments), tuple(attributes))


def _comment_lines(text: str) -> list[str]:
    inner = text.lstrip("/") if text.startswith("//") else text[2:-2]
    return [line.strip() for line in inner.strip().split("\n")]


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of a section; texts as they are written."""

    name: str
    type: str
    address: str = ""
    initial: str = ""
    comment: str = ""
    attributes: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Section:
    """VAR_INPUT ... END_VAR."""

    keyword: str
    flags: tuple[str, ...]
    variables: tuple[Variable, ...]
    notes: Notes = Notes()
    """What stands before its keyword."""


def read_sections(text: str) -> list[Section]:
    """The sections of a declaration."""
    scan = list(words(text))
    found: list[Section] = []
    i = 0
    while i < len(scan):
        if scan[i].text not in SECTIONS:
            i += 1
            continue
        keyword = scan[i].text
        notes = read_notes(text, scan[i - 1].end if i else 0, scan[i].start, behind=i > 0)
        i += 1
        flags: list[str] = []
        while i < len(scan) and scan[i].text in _FLAGS:
            flags.append(_FLAGS[scan[i].text])
            i += 1
        start = i
        while i < len(scan) and scan[i].text != "END_VAR":
            i += 1
        variables = tuple(_variables(text, scan[start:i], scan[start - 1].end))
        found.append(Section(keyword, tuple(dict.fromkeys(flags)), variables, notes))
        i += 1
    return found


def return_type(text: str) -> str:
    """The type behind the colon of a header, empty for none."""
    scan = words(text)
    for word in scan:
        if word.text in SECTIONS:
            return ""
        if word.text == ":":
            line_end = text.find("\n", word.end)
            stop = len(text) if line_end < 0 else line_end
            kept = [item for item in words(text, word.end) if item.end <= stop and item.text != ";"]
            return text[kept[0].start : kept[-1].end] if kept else ""
    return ""


def members(text: str, scan: list[Word], start: int) -> list[Variable]:
    """The members between STRUCT, which ends at `start`, and END_STRUCT."""
    return list(_variables(text, scan, start))


def _variables(text: str, scan: list[Word], start: int) -> Iterator[Variable]:
    for part in _statements(scan):
        yield from _declared(text, part, read_notes(text, start, part[0].start, behind=True))
        start = part[-1].end


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


def _declared(text: str, part: list[Word], notes: Notes) -> Iterator[Variable]:
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
    assigned = assignment(part, colon)
    type_end = assigned if assigned is not None else len(part) - 1
    if type_end <= colon + 1:
        return
    kind = text[part[colon + 1].start : part[type_end - 1].end]
    initial = ""
    if assigned is not None and assigned + 1 < len(part) - 1:
        initial = text[part[assigned + 1].start : part[-2].end]
    comment = "\n".join(note for note in (notes.comment, comment_behind(text, part[-1].end)) if note)
    for name in names:
        yield Variable(name, kind, address, initial, comment, notes.attributes)


def assignment(part: list[Word], colon: int) -> int | None:
    """Index of the `:=` of the initial value; those in parentheses are of arguments."""
    depth = 0
    for i, word in enumerate(part):
        depth += (word.text in _OPEN) - (word.text in _CLOSE)
        if i >= colon and word.text == ":=" and depth == 0:
            return i
    return None


def comment_behind(text: str, end: int) -> str:
    """The comment on the rest of a line, if nothing else is there."""
    line_end = text.find("\n", end)
    lines: list[str] = []
    for kind, piece, start, stop in pieces(text, end):
        if start > line_end >= 0:
            break
        if kind is not COMMENT:
            return ""
        lines += _comment_lines(piece)
        line_end = max(line_end, text.find("\n", stop)) if line_end >= 0 else line_end
    return "\n".join(lines)
