"""The types of charts, added to every program that has a chart (LSFC-06)."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from typing import Final

from tappet.lang import ast
from tappet.lang.parser import parse
from tappet.lang.source import Scope, Source

NAME: Final = "IecSfc"
"""Name and namespace of the library."""


def has_chart(unit: ast.Unit) -> bool:
    """Whether a text declares a POU written in SFC."""
    found: list[ast.Pou | ast.Accessor | None] = []
    for declaration in unit.declarations:
        properties = [declaration] if isinstance(declaration, ast.Property) else []
        if isinstance(declaration, ast.Pou):
            found += [declaration, *declaration.actions, *declaration.methods]
            properties = declaration.properties
        found += [accessor for p in properties for accessor in (p.getter, p.setter)]
    return any(body is not None and body.language == "SFC" for body in found)


def with_types(units: Sequence[ast.Unit], earlier: Sequence[ast.Unit]) -> Sequence[ast.Unit]:
    """The units, and that of the library where a chart needs it, from an earlier analysis if it had one."""
    if not any(has_chart(unit) for unit in units) or any(u.source.library == NAME for u in units):
        return units
    kept = [unit for unit in earlier if unit.source.library == NAME]
    return [*units, kept[0] if kept else _read()]


def _read() -> ast.Unit:
    text = files("tappet.lang.sfc").joinpath("IecSfc.st").read_text(encoding="utf-8")
    source = Source(f"{NAME}/{NAME}", text, Scope.LIBRARY, name=NAME, library=NAME, namespace=NAME)
    return parse(source).unit
