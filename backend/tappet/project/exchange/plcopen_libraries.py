"""PLCopen XML: the libraries of a CODESYS application."""

from __future__ import annotations

from typing import Any

from tappet.project.exchange.libraries import reference, take_parameters
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.xml_tree import Element


def read_libraries(source: str, item: Element, report: ImportReport) -> list[dict[str, Any]]:
    """The references of a `Libraries` element: `Name, version (company)`, or `#Placeholder`, resolved."""
    found = []
    for library in item.children("Library"):
        resolution = library.get("DefaultResolution") or library.get("Name")
        name, _, rest = resolution.lstrip("#").partition(",")
        name, version = name.strip(), rest.partition("(")[0].strip() or "*"
        made = reference(source, name, version, library.get("Namespace"), report, library.line)
        found.append(take_parameters(source, made, library, report))
    return found
