"""Type and value texts as the elements that PLCopen XML has for them."""

from __future__ import annotations

import re

from tappet.project.declaration_text import Word, words
from tappet.project.exchange.declaration_sections import Variable, members
from tappet.project.exchange.text_parts import NAME
from tappet.project.exchange.xml_tree import escape_attribute, is_legal

_ELEMENTARY_TYPES = """
    BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME DATE DT TOD
"""
_ELEMENTARY = frozenset(_ELEMENTARY_TYPES.split())
_LONG_NAMES = {"DATE_AND_TIME": "DT", "TIME_OF_DAY": "TOD"}
_STRING = re.compile(r"(W?STRING)\s*(?:[(\[]\s*(.+?)\s*[)\]])?", re.IGNORECASE | re.DOTALL)
_ARRAY = re.compile(r"ARRAY\s*\[(?P<bounds>[^\]]*)\]\s*OF\b(?P<of>.*)", re.IGNORECASE | re.DOTALL)
_POINTER = re.compile(r"(?P<kind>POINTER|REFERENCE)\s+TO\b(?P<to>.*)", re.IGNORECASE | re.DOTALL)
_MAX_DEPTH = 20


def type_element(tag: str, text: str) -> str:
    """A type as an element of this name; of a whole TYPE declaration what it says the type is."""
    body = _definition(text) if text.lstrip()[:4].upper() == "TYPE" or "END_TYPE" in text.upper() else text
    return f"<{tag}>{_type(body, 0)}</{tag}>"


def _definition(text: str) -> str:
    """What stands between the colon and the end of the first type of a TYPE block."""
    scan = list(words(text))
    colon = next((i for i, word in enumerate(scan) if word.text == ":"), None)
    if colon is None:
        return ""
    rest = [word for word in scan[colon + 1 :] if word.text != "END_TYPE"]
    if rest and rest[-1].text == ";":
        rest.pop()
    return text[rest[0].start : rest[-1].end] if rest else ""


def _type(text: str, depth: int) -> str:
    text = text.strip()
    upper = text.upper()
    if upper in _ELEMENTARY:
        return f"<{upper} />"
    if upper in _LONG_NAMES:
        return f"<{_LONG_NAMES[upper]} />"
    string = _STRING.fullmatch(text)
    if string:
        length = f' length="{_attribute(string[2])}"' if string[2] else ""
        return f"<{string[1].lower()}{length} />"
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
    return f"<{tag}>{''.join(_member(item, depth) for item in members(text, inside))}</{tag}>"


def _member(item: Variable, depth: int) -> str:
    initial = f"<initialValue>{value_element(item.initial)}</initialValue>" if item.initial else ""
    kind = _type(item.type, depth + 1)
    return f'<variable name="{_attribute(item.name)}"><type>{kind}</type>{initial}</variable>'


def _enum(text: str) -> str:
    scan = list(words(text))
    values: list[str] = []
    part: list[Word] = []
    for word in [*scan[1:], Word(",", len(text), len(text))]:
        if word.text in (",", ")"):
            if part and NAME.fullmatch(part[0].text):
                value = text[part[2].start : part[-1].end] if len(part) > 2 else ""
                given = f' value="{_attribute(value)}"' if value else ""
                values.append(f'<value name="{_attribute(text[part[0].start : part[0].end])}"{given} />')
            part = []
            if word.text == ")":
                break
        else:
            part.append(word)
    return f"<enum><values>{''.join(values)}</values></enum>"


def value_element(text: str) -> str:
    """An initial value; aggregates stand there as they are written, which CODESYS does too."""
    return f'<simpleValue value="{_attribute(text)}" />'


def _attribute(text: str) -> str:
    return escape_attribute(text if is_legal(text) else "?")
