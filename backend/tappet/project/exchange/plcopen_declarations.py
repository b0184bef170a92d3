"""PLCopen XML: types, initial values and variable sections to declaration texts."""

from __future__ import annotations

import base64
import binascii
import re
from collections.abc import Iterator
from itertools import groupby

from tappet.project.exchange.xml_tree import Element

CODESYS = "http://www.3s-software.com/plcopenxml/"
"""Where the names of CODESYS's additional data begin."""

_SECTIONS = {
    "localVars": "VAR",
    "tempVars": "VAR_TEMP",
    "inputVars": "VAR_INPUT",
    "outputVars": "VAR_OUTPUT",
    "inOutVars": "VAR_IN_OUT",
    "externalVars": "VAR_EXTERNAL",
    "globalVars": "VAR_GLOBAL",
    "accessVars": "VAR_ACCESS",
    "staticVars": "VAR_STAT",
    "instVars": "VAR_INST",
}
_QUALIFIERS = ("constant", "retain", "nonretain", "persistent", "nonpersistent")
_TRUE = frozenset(["true", "1"])
_CONSTANT_INPUT = "input_constant"
_WRITTEN_OTHERWISE = frozenset([_CONSTANT_INPUT, "old_input_assignments"])
"""Attributes by which CODESYS marks what the declaration has words for."""


def added(element: Element | None) -> Iterator[tuple[str, Element]]:
    """The additional data of an element: the last part of its name in lower case, and each element in it."""
    for holder in element.children("addData") if element is not None else []:
        for data in holder.children("data"):
            name = data.get("name").rstrip("/").rsplit("/", 1)[-1].lower()
            for item in data:
                yield name, item


def type_text(element: Element | None) -> str:
    """A data type as text; of a `type` or `baseType` element, or of the element of the type itself."""
    if element is None:
        return ""
    inner = next((item for item in element if item.tag not in ("addData", "documentation")), None)
    if element.tag in ("type", "baseType", "returnType"):
        if inner is None:
            return element.text().strip() or next((type_text(item) for _, item in added(element)), "")
        return type_text(inner)
    tag = element.tag
    if tag in ("string", "wstring"):
        length = element.get("length")
        return f"{tag.upper()}({length})" if length else tag.upper()
    if tag == "derived":
        return element.get("name")
    if tag == "array":
        bounds = ", ".join(_bounds(item) for item in element.children("dimension"))
        return f"ARRAY[{bounds}] OF {type_text(element.child('baseType'))}"
    if tag in ("pointer", "reference"):
        return f"{tag.upper()} TO {type_text(element.child('baseType'))}"
    if tag in ("subrangeSigned", "subrangeUnsigned"):
        limits = element.child("range")
        return f"{type_text(element.child('baseType'))} ({_bounds(limits) if limits is not None else ''})"
    if tag == "enum":
        return _enum_text(element, {})
    if tag in ("struct", "union"):
        return _structure_text(element)
    return tag


def _bounds(element: Element) -> str:
    lower, upper = element.get("lower"), element.get("upper")
    return lower if lower == "*" or not upper else f"{lower}..{upper}"


def _enum_text(element: Element, comments: dict[str, str]) -> str:
    values = element.child("values")
    lines = []
    items = values.children("value") if values is not None else []
    for index, item in enumerate(items):
        value = f" := {item.get('value')}" if item.get("value") else ""
        comma = "," if index + 1 < len(items) else ""
        comment = comments.get(item.get("name"), "")
        lines += _comment_above(comment, "    ") if "\n" in comment else []
        behind = f" // {comment.strip()}" if comment.strip() and "\n" not in comment else ""
        lines.append(f"    {item.get('name')}{value}{comma}{behind}")
    base = type_text(element.child("baseType"))
    return "(\n" + "\n".join(lines) + "\n)" + (f" {base}" if base else "")


def _structure_text(element: Element) -> str:
    keyword = element.tag.upper()
    lines = [line for item in element.children("variable") for line in variable_lines(item)]
    return "\n".join([keyword, *lines, f"END_{keyword}"])


def value_text(element: Element | None) -> str:
    """An initial value as text; empty for none."""
    if element is None:
        return ""
    if element.tag in ("initialValue", "value"):
        inner = next(iter(element), None)
        return value_text(inner) if inner is not None else element.get("value") or element.text().strip()
    if element.tag == "simpleValue":
        return element.get("value") or element.text().strip()
    if element.tag == "arrayValue":
        return "[" + ", ".join(_repeated(item) for item in element.children("value")) + "]"
    if element.tag == "structValue":
        members = (f"{item.get('member')} := {value_text(item)}" for item in element.children("value"))
        return "(" + ", ".join(members) + ")"
    return element.text().strip()


def _repeated(element: Element) -> str:
    count = element.get("repetitionValue")
    return f"{count}({value_text(element)})" if count not in ("", "1") else value_text(element)


def documentation(element: Element | None) -> str:
    """The documentation of an element as text."""
    found = element.child("documentation") if element is not None else None
    return found.text().rstrip() if found is not None else ""


def attributes(element: Element | None) -> list[str]:
    """The attribute pragmas of an element, a line each."""
    lines = []
    for attribute in _attribute_elements(element):
        if attribute.get("Name").lower() in _WRITTEN_OTHERWISE:
            continue
        value = attribute.get("Value").replace("$", "$$").replace("'", "$'")
        assigned = f" := '{value}'" if value else ""
        lines.append(f"{{attribute '{attribute.get('Name')}'{assigned}}}")
    return lines


def _attribute_elements(element: Element | None) -> Iterator[Element]:
    for name, item in added(element):
        if name == "attributes":
            yield from item.children("Attribute")


def _arguments(element: Element) -> str:
    """What a function block's FB_Init gets, in parentheses; empty for nothing."""
    given = [
        f"{label.text().strip()} := {value.text().strip()}"
        for name, item in added(element)
        if name == "inputassignments"
        for part in item.children("InputAssignment")
        if (label := part.child("Name")) is not None and (value := part.child("Value")) is not None
    ]
    return f"({', '.join(given)})" if given else ""


def variable_lines(element: Element) -> list[str]:
    """A variable as the lines of its declaration, with its attributes and its comment."""
    address = f" AT {element.get('address')}" if element.get("address") else ""
    value = value_text(element.child("initialValue"))
    note = documentation(element)
    indented = type_text(element.child("type")).replace("\n", "\n    ")
    assigned = f" := {value}" if value else ""
    line = f"    {element.get('name')}{address} : {indented}{_arguments(element)}{assigned};"
    lines = [f"    {attribute}" for attribute in attributes(element)]
    if "\n" in note.strip():
        lines += _comment_above(note, "    ")
    elif note.strip():
        line += f" // {note.strip()}"
    return [*lines, line]


def _comment_above(note: str, indent: str) -> list[str]:
    return [f"{indent}// {line.strip()}".rstrip() for line in note.strip().split("\n")]


def sections(interface: Element | None) -> list[str]:
    """The variable sections of an interface as lines."""
    lines: list[str] = []
    for item in _section_elements(interface):
        mixed = [part for name, held in added(item) if name == "mixedattrsvarlist" for part in held]
        for part in mixed or [item]:
            lines += section_lines(part)
    return lines


def _section_elements(interface: Element | None) -> Iterator[Element]:
    if interface is None:
        return
    for item in interface:
        if item.tag in _SECTIONS:
            yield item
    for _, item in added(interface):
        if item.tag in _SECTIONS:
            yield item


def section_lines(element: Element, own_attributes: bool = True) -> list[str]:
    """One variable section; its attributes are not of it when it is a whole list of global variables."""
    keyword = _SECTIONS.get(element.tag, "VAR")
    flags = [flag.upper() for flag in _QUALIFIERS if element.get(flag).lower() in _TRUE]
    flags = [{"NONRETAIN": "NON_RETAIN"}.get(flag, flag) for flag in flags if flag != "NONPERSISTENT"]
    variables = element.children("variable")
    if not variables and not flags and keyword == "VAR":
        return []
    lines: list[str] = []
    above = attributes(element) if own_attributes else []
    for constant, part in groupby(variables, _is_constant_input):
        words = [keyword, "CONSTANT", *flags] if constant else [keyword, *flags]
        lines += [
            *above,
            " ".join(words),
            *(line for item in part for line in variable_lines(item)),
            "END_VAR",
        ]
    return lines or [*above, " ".join([keyword, *flags]), "END_VAR"]


def _is_constant_input(variable: Element) -> bool:
    return any(item.get("Name").lower() == _CONSTANT_INPUT for item in _attribute_elements(variable))


def plain_text(element: Element) -> str | None:
    """The declaration as the engineer wrote it, where the export holds it."""
    for holder in (element, element.child("interface")):
        if holder is None:
            continue
        direct = holder.child("InterfaceAsPlainText")
        if direct is not None:
            return exact_text(direct)
        for item in (holder, *(part for part in holder if part.tag in _SECTIONS)):
            for name, inner in added(item):
                if name == "interfaceasplaintext" or inner.tag == "InterfaceAsPlainText":
                    return exact_text(inner)
    return None


def exact_text(element: Element) -> str:
    """The text in an element, without the indentation around an `xhtml` or `p` element in it.

    A text that XML cannot hold is in base64, which our own exports say in an attribute.
    """
    inner = [item for item in element if item.tag in ("xhtml", "html", "p")]
    text = "\n".join(item.text() for item in inner) if inner else element.text()
    if element.get("encoding") == "base64":
        try:
            return base64.b64decode(text, validate=True).decode()
        except (binascii.Error, UnicodeDecodeError):
            return text
    return text


def data_type_text(element: Element) -> str:
    """The declaration of a `dataType`."""
    name = element.get("name")
    comments: dict[str, str] = {}
    extends = ""
    inner: Element | None = None
    for kind, item in added(element):
        if kind == "enumvaluedocumentation":
            for described in item.children("EnumValue"):
                label = described.child("Name")
                note = described.child("Documentation")
                if label is not None and note is not None:
                    comments[label.text().strip()] = note.text().strip("\n")
        elif kind == "datatypeinheritance":
            extends = ", ".join(found.text().strip() for found in item.children("Extends"))
        elif item.tag in ("union", "Union"):
            inner = item
    base = element.child("baseType")
    if element.tag in ("union", "Union"):
        inner = element
    if inner is None and base is not None:
        inner = next((item for item in base if item.tag != "addData"), None)
        inner = inner or next((item for _, item in added(base)), None)
    value = value_text(element.child("initialValue"))
    assigned = f" := {value}" if value else ""
    head = f"TYPE {name}{f' EXTENDS {extends}' if extends else ''} :"
    lines = [*_comment_lines(documentation(element)), *attributes(element)]
    if inner is not None and inner.tag == "enum":
        lines += [head, f"{_enum_text(inner, comments)}{assigned};"]
    elif inner is not None and inner.tag in ("struct", "union", "Union"):
        lines += [head, _structure_text(inner)]
    else:
        lines.append(f"{head} {type_text(inner)}{assigned};")
    return "\n".join([*lines, "END_TYPE"])


def _comment_lines(note: str) -> list[str]:
    return _comment_above(note, "") if note.strip() else []


def head_lines(keyword: str, element: Element) -> list[str]:
    """Comment, attributes and header of a POU, method, property or interface."""
    interface = element.child("interface")
    returns = type_text(interface.child("returnType")) if interface is not None else ""
    extends: list[str] = []
    implements: list[str] = []
    modifiers: list[str] = []
    inheritance = element.children("Inheritance")
    for holder in (element, interface):
        for name, item in added(holder):
            if name.endswith("inheritance"):
                inheritance.append(item)
            elif name == "accessmodifiers":
                modifiers += [key.upper() for key, value in item.attributes.items() if value.lower() in _TRUE]
    for item in inheritance:
        extends += [part.text().strip() for part in item.children("Extends")]
        implements += [part.text().strip() for part in item.children("Implements")]
    words = [keyword, *dict.fromkeys(modifiers), element.get("name")]
    if extends:
        words.append(f"EXTENDS {', '.join(extends)}")
    if implements:
        words.append(f"IMPLEMENTS {', '.join(implements)}")
    if returns and keyword in ("FUNCTION", "METHOD", "PROPERTY"):
        words.append(f": {returns}")
    notes = documentation(interface) or documentation(element)
    pragmas = list(dict.fromkeys([*attributes(interface), *attributes(element)]))
    return [*_comment_lines(notes), *pragmas, " ".join(words)]


def iso_interval(text: str) -> str:
    """`PT0.02S`, an ISO 8601 duration, as a TIME literal; other texts as they are."""
    match = re.fullmatch(
        r"P(?:(\d+)D)?(?:T(?:(\d+)H)?(?:(\d+)M)?(?:(\d+(?:[.,]\d+)?)S)?)?", text.strip(), re.IGNORECASE
    )
    if match is None or not any(match.groups()):
        return text.strip()
    days, hours, minutes = (int(part or 0) for part in match.groups()[:3])
    seconds = round(float((match[4] or "0").replace(",", ".")) * 1e6)
    return str(((days * 24 + hours) * 60 + minutes) * 60_000_000 + seconds)
