"""Type and value texts as the elements that PLCopen XML has for them."""

from __future__ import annotations

import re

from tappet.iec.tokens import NAME, Word, words
from tappet.iec.words import ELEMENTARY_TYPES
from tappet.project.exchange.declaration_sections import (
    Variable,
    assignment,
    comment_behind,
    members,
    read_notes,
)
from tappet.project.exchange.plcopen_declarations import CODESYS
from tappet.project.exchange.xml_tree import XHTML, escape_attribute, escape_text, is_legal

_SHORT_NAMES = {"DATE_AND_TIME": "DT", "TIME_OF_DAY": "TOD"}
_ELEMENTARY = {
    name: _SHORT_NAMES.get(name, name)
    for name, type_ in ELEMENTARY_TYPES.items()
    if type_.family not in ("time", "date") or type_.size == 4  # the schema is older than LTIME, LDATE ...
}
_ELEMENTARY |= {short: short for short in _SHORT_NAMES.values()}
"""The element of an elementary type, by upper-case name."""
_STRING = re.compile(r"(W?STRING)\s*(?:[(\[]\s*(.+?)\s*[)\]])?", re.IGNORECASE | re.DOTALL)
_ARRAY = re.compile(r"ARRAY\s*\[(?P<bounds>[^\]]*)\]\s*OF\b(?P<of>.*)", re.IGNORECASE | re.DOTALL)
_POINTER = re.compile(r"(?P<kind>POINTER|REFERENCE)\s+TO\b(?P<to>.*)", re.IGNORECASE | re.DOTALL)
_SUBRANGE = re.compile(r"(\w+)\s*\(\s*([-+]?\d+)\s*\.\.\s*([-+]?\d+)\s*\)")
_WITH_ARGUMENTS = re.compile(r"(?P<name>[\w.]+)\s*\((?P<inner>.*)\)", re.DOTALL)
_ARGUMENT = re.compile(r"\s*(\w+)\s*:=\s*(.+?)\s*", re.DOTALL)
_MAX_DEPTH = 20


def type_element(tag: str, text: str) -> str:
    """A type as an element of this name."""
    return f"<{tag}>{_type(text, 0)}</{tag}>"


def definition(text: str) -> tuple[str, str]:
    """Type and initial value of the first type of a TYPE block."""
    scan = list(words(text))
    colon = next((i for i, word in enumerate(scan) if word.text == ":"), None)
    if colon is None:
        return "", ""
    rest = [word for word in scan[colon + 1 :] if word.text != "END_TYPE"]
    if rest and rest[-1].text == ";":
        rest.pop()
    whole = not rest or rest[0].text in ("STRUCT", "UNION")  # their members have initial values
    assigned = None if whole else assignment(rest, 0)
    kind, initial = (rest, []) if assigned is None else (rest[:assigned], rest[assigned + 1 :])
    return _text_of(text, kind), _text_of(text, initial)


def _text_of(text: str, scan: list[Word]) -> str:
    return text[scan[0].start : scan[-1].end] if scan else ""


def _type(text: str, depth: int) -> str:
    text = text.strip()
    upper = text.upper()
    if upper in _ELEMENTARY:
        return f"<{_ELEMENTARY[upper]} />"
    string = _STRING.fullmatch(text)
    if string:
        length = f' length="{_attribute(string[2])}"' if string[2] else ""
        return f"<{string[1].lower()}{length} />"
    subrange = _SUBRANGE.fullmatch(text)
    if subrange and subrange[1].upper() in _ELEMENTARY:
        kind = "subrangeUnsigned" if subrange[1][0].upper() in "UBWDL" else "subrangeSigned"
        limits = f'<range lower="{subrange[2]}" upper="{subrange[3]}" />'
        return f"<{kind}>{limits}<baseType><{subrange[1].upper()} /></baseType></{kind}>"
    if depth < _MAX_DEPTH:
        array = _ARRAY.fullmatch(text)
        if array:
            return _array(array["bounds"], array["of"], depth)
        pointer = _POINTER.fullmatch(text)
        if pointer:
            inner = _type(pointer["to"], depth + 1)
            return f"<{pointer['kind'].lower()}><baseType>{inner}</baseType></{pointer['kind'].lower()}>"
        if upper.startswith(("STRUCT", "UNION")):
            return _structure(text, depth)
        if text.startswith("("):
            return _enum(text)
    return f'<derived name="{_attribute(" ".join(text.split()))}" />'


def _array(bounds: str, of: str, depth: int) -> str:
    dimensions = []
    for bound in bounds.split(","):
        lower, _, upper = bound.partition("..")
        dimensions.append(
            f'<dimension lower="{_attribute(lower.strip())}" upper="{_attribute(upper.strip())}" />'
        )
    return f"<array>{''.join(dimensions)}<baseType>{_type(of, depth + 1)}</baseType></array>"


def _structure(text: str, depth: int) -> str:
    scan = list(words(text))
    tag = "struct" if scan[0].text == "STRUCT" else "union"
    inside = [word for word in scan[1:] if word.text not in ("END_STRUCT", "END_UNION")]
    held = "".join(variable_element(item, depth) for item in members(text, inside, scan[0].end))
    return f"<{tag}>{held}</{tag}>"


def variable_element(item: Variable, depth: int = 0) -> str:
    """A variable with its address, type, initial value, attributes, arguments of FB_Init and comment."""
    name, arguments = _without_arguments(item.type)
    place = f' address="{_attribute(item.address)}"' if item.address else ""
    initial = f"<initialValue>{value_element(item.initial)}</initialValue>" if item.initial else ""
    added = attributes_data(item.attributes) + arguments
    return (
        f'<variable name="{_attribute(item.name)}"{place}><type>{_type(name, depth + 1)}</type>{initial}'
        f"{f'<addData>{added}</addData>' if added else ''}{documentation_element(item.comment)}</variable>"
    )


def _without_arguments(text: str) -> tuple[str, str]:
    """A type without the arguments for FB_Init, and these as additional data, where all of them are named."""
    match = _WITH_ARGUMENTS.fullmatch(text)
    if match is None or match["name"].upper() in ("STRING", "WSTRING", "ARRAY") or ":=" not in match["inner"]:
        return text, ""
    given = [_ARGUMENT.fullmatch(part) for part in _parts(match["inner"])]
    if not all(given):
        return text, ""
    rows = "".join(
        f"<InputAssignment><Name>{part[1]}</Name><Value>{escape_text(part[2])}</Value></InputAssignment>"
        for part in given
        if part is not None
    )
    return match["name"], codesys_data("inputassignments", f"<InputAssignments>{rows}</InputAssignments>")


def _parts(text: str) -> list[str]:
    """The parts of a list between commas outside of parentheses."""
    ends, depth = [-1], 0
    for word in words(text):
        depth += (word.text in "([") - (word.text in ")]")
        if word.text == "," and depth == 0:
            ends.append(word.start)
    return [text[start + 1 : end] for start, end in zip(ends, [*ends[1:], len(text)], strict=True)]


def codesys_data(name: str, content: str) -> str:
    """Additional data as CODESYS names them."""
    return f'<data name="{CODESYS}{name}" handleUnknown="implementation">{content}</data>'


def attributes_data(pairs: tuple[tuple[str, str], ...]) -> str:
    """Attribute pragmas; empty for none."""
    rows = "".join(
        f'<Attribute Name="{escape_attribute(name)}" Value="{escape_attribute(value)}" />'
        for name, value in pairs
        if is_legal(name + value)
    )
    return codesys_data("attributes", f"<Attributes>{rows}</Attributes>") if rows else ""


def documentation_element(text: str) -> str:
    """A comment; empty for none."""
    if not text or not is_legal(text):
        return ""
    return f'<documentation><xhtml xmlns="{XHTML}">{escape_text(text)}</xhtml></documentation>'


def _enum(text: str) -> str:
    values = []
    for name, value, _ in _enum_values(text):
        given = f' value="{_attribute(value)}"' if value else ""
        values.append(f'<value name="{_attribute(name)}"{given} />')
    behind = list(words(text))
    close = next((i for i, word in enumerate(behind) if word.text == ")"), len(behind))
    base = text[behind[close].end :].strip() if close < len(behind) else ""
    held = f"<baseType>{_type(base, 1)}</baseType>" if NAME.fullmatch(base) else ""
    return f"<enum><values>{''.join(values)}</values>{held}</enum>"


def enum_comments(text: str) -> str:
    """The comments of enumeration values as additional data; empty for none."""
    if not text.startswith("("):
        return ""
    rows = "".join(
        f'<EnumValue><Name>{escape_text(name)}</Name><Documentation><xhtml xmlns="{XHTML}">'
        f"{escape_text(comment)}</xhtml></Documentation></EnumValue>"
        for name, _, comment in _enum_values(text)
        if comment and is_legal(comment)
    )
    content = f"<EnumValueDocumentation>{rows}</EnumValueDocumentation>"
    return codesys_data("enumvaluedocumentation", content) if rows else ""


def _enum_values(text: str) -> list[tuple[str, str, str]]:
    """Name, value and comment of each value of an enumeration."""
    scan = list(words(text))
    found: list[tuple[str, str, str]] = []
    part: list[Word] = []
    start, depth = scan[0].end if scan else 0, 0
    for word in [*scan[1:], Word(",", len(text), len(text))]:
        if depth == 0 and word.text in (",", ")"):
            if part and NAME.fullmatch(part[0].text):
                value = text[part[2].start : part[-1].end] if len(part) > 2 else ""
                above = read_notes(text, start, part[0].start, behind=True).comment
                end = word.end if word.text == "," else part[-1].end
                notes = [above, comment_behind(text, end)]
                comment = "\n".join(note for note in notes if note)
                found.append((text[part[0].start : part[0].end], value, comment))
            part, start = [], word.end
            if word.text == ")":
                break
        else:
            depth += (word.text == "(") - (word.text == ")")
            part.append(word)
    return found


def value_element(text: str) -> str:
    """An initial value; aggregates stand there as they are written, which CODESYS does too."""
    return f'<simpleValue value="{_attribute(text)}" />'


def _attribute(text: str) -> str:
    return escape_attribute(text if is_legal(text) else "?")
