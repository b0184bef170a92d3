"""TwinCAT 3: data types that a system project holds for all its PLC projects, as declarations.

In TwinCAT a type of a PLC project can be made a global one: its declaration is only there from then on.
"""

from __future__ import annotations

import re

from tappet.iec.tokens import NAME
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.xml_tree import Element

FOLDER = "TwinCAT types"
_ATTRIBUTE = "plcAttribute_"
_NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
_NUMERIC_TYPES = """
    BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL BIT
"""
_NUMERIC = frozenset(_NUMERIC_TYPES.split())
_TRUTH = {"0": "FALSE", "1": "TRUE", "false": "FALSE", "true": "TRUE"}


def read_types(root: Element, source: str, report: ImportReport) -> list[Draft]:
    """The types that a system project itself holds, not those that it got from libraries and modules."""
    found = []
    for holder in root.children("DataTypes"):
        for item in holder.children("DataType"):
            title = item.child("Name")
            if title is None or title.get("PersistentType").lower() != "true":
                continue
            name = title.text().strip()
            lines = _declaration(item, name, source, report) if NAME.fullmatch(name) else None
            if lines is None:
                text = "is no structure, enumeration or alias of the type system: it is not read"
                if item.child("EventId") is not None:
                    text = "event classes are not read"
                report.add("refused", source, text, name=name, line=item.line)
                continue
            found.append(Draft("dut", name, {"declaration": "\n".join(lines)}, source, item.line))
    return found


def _declaration(item: Element, name: str, source: str, report: ImportReport) -> list[str] | None:
    base, members = item.child("BaseType"), item.children("SubItem")
    above = [*_comment(item), *_attributes(item)]
    if item.child("EnumInfo") is not None:
        values = [
            f"    {_text(value, 'Text')} := {_text(value, 'Enum').replace('#x', '16#')}"
            for value in item.children("EnumInfo")
        ]
        kind = f" {base.text().strip()}" if base is not None else ""
        return [*above, f"TYPE {name} :", "(", ",\n".join(values), f"){kind};", "END_TYPE"]
    if members:
        extends = item.child("ExtendsType")
        head = f"TYPE {name}{f' EXTENDS {extends.text().strip()}' if extends is not None else ''} :"
        lines = [line for member in members for line in _member(member, name, source, report)]
        return [*above, head, "STRUCT", *lines, "END_STRUCT", "END_TYPE"]
    if base is not None and item.child("Method") is None:
        return [*above, f"TYPE {name} : {_type(item, base)};", "END_TYPE"]
    return None


def _member(item: Element, owner: str, source: str, report: ImportReport) -> list[str]:
    name, kind = _text(item, "Name"), item.child("Type")
    type_ = _type(item, kind) if kind is not None else "BYTE"
    value = _initial(item, type_)
    if value is None:
        text = "the initial value is not read"
        report.add("changed", source, text, name=f"{owner}.{name}", line=item.line)
    assigned = f" := {value}" if value else ""
    above = [f"    {line}" for line in (*_comment(item), *_attributes(item))]
    return [*above, f"    {name} : {type_}{assigned};"]


def _type(item: Element, named: Element) -> str:
    text = named.text().strip()
    for attribute, words in (("ReferenceTo", "REFERENCE TO"), ("PointerTo", "POINTER TO")):
        count = named.get(attribute)
        text = f"{words} " * (min(int(count), 9) if count.isdecimal() else count == "true") + text
    bounds = []
    for part in item.children("ArrayInfo"):
        low, count = _text(part, "LBound"), _text(part, "Elements")
        if re.fullmatch(r"-?\d{1,9}", low) and re.fullmatch(r"\d{1,9}", count):
            bounds.append(f"{low}..{int(low) + int(count) - 1}")
    return f"ARRAY[{', '.join(bounds)}] OF {text}" if bounds else text


def _initial(item: Element, type_: str) -> str | None:
    """The initial value; '' for none, None for one that cannot be written for the type."""
    default = item.child("Default")
    if default is None:
        return ""
    value = _text(default, "Value") or _text(default, "Bool")
    if type_ == "BOOL":
        return _TRUTH.get(value.lower())
    if type_ in _NUMERIC and _NUMBER.fullmatch(value):
        return value
    text = default.child("String")
    if text is not None and type_.startswith("STRING"):
        written = text.text().replace("$", "$$").replace("'", "$'")
        return f"'{written}'" if written.isprintable() else None
    return None


def _comment(item: Element) -> list[str]:
    lines = _text(item, "Comment").splitlines()
    return [f"// {line.strip()}" for line in lines if line.strip()]


def _attributes(item: Element) -> list[str]:
    found = []
    for holder in item.children("Properties"):
        for part in holder.children("Property"):
            name = _text(part, "Name")
            if name.startswith(_ATTRIBUTE):
                value = _text(part, "Value").replace("'", "$'")
                given = f" := '{value}'" if value else ""
                found.append(f"{{attribute '{name.removeprefix(_ATTRIBUTE)}'{given}}}")
    return found


def _text(item: Element, tag: str) -> str:
    child = item.child(tag)
    return child.text().strip() if child is not None else ""
