"""References to libraries of other systems: those that are here under another name get that name."""

from __future__ import annotations

from typing import Any

from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.xml_tree import Element

_SAME = {"tc2_standard": "Standard", "iec_standard": "Standard"}
"""Libraries whose contents are in one of ours; the file's namespace is kept for qualified names."""


def reference(
    source: str, name: str, version: str, namespace: str, report: ImportReport, line: int | None = None
) -> dict[str, Any]:
    """The data of a library reference. Versions of other systems say nothing here, so any will do."""
    ours = _SAME.get(name.casefold())
    if ours is not None:
        text = f"its contents are in '{ours}', which takes its place"
        report.add("changed", source, text, name=name, line=line)
        return {"name": ours, "version": "*", "namespace": namespace or name}
    if version not in ("*", "") and name.casefold() != "standard":
        text = f"the file names version {version}; any version that is installed is taken"
        report.add("changed", source, text, name=name, line=line)
    return {"name": name, "version": "*", "namespace": "" if namespace == name else namespace}


def take_access(made: dict[str, Any], qualified_only: str) -> dict[str, Any]:
    """The data of a reference with what a file says of qualified access: `true` or `false` in any letters."""
    return made | {"qualified_only": True} if qualified_only.strip().casefold() == "true" else made


def take_parameters(
    source: str, made: dict[str, Any], library: Element, report: ImportReport
) -> dict[str, Any]:
    """The data of a reference with the values that an element gives to parameters of the library.

    CODESYS writes `<Parameter Name="CMAX" Value="20" />` without the list, TwinCAT `<Parameter
    ListName="GVL_PARAM"><Key>CMAX</Key><Value>20</Value></Parameter>`, all names in upper case.
    """
    found: dict[tuple[str, str], dict[str, str]] = {}
    for part in (part for holder in library.children("Parameters") for part in holder):
        name, value = (part.get(key.title()) or _inner(part, key) for key in ("name", "value"))
        name = name or _inner(part, "key")
        if not name or not value:
            text = f"the parameter '{name}' is given no value: it keeps its own"
            report.add("changed", source, text, name=made["name"], line=part.line)
            continue
        list_name = part.get("ListName")
        found[list_name.casefold(), name.casefold()] = {"list": list_name, "name": name, "value": value}
    return made | {"parameters": list(found.values())} if found else made


def _inner(part: Element, tag: str) -> str:
    child = part.child(tag.title())
    return child.text().strip() if child is not None else ""
