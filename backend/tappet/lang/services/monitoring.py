"""Which variables each element of a drawn body shows while it runs."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.lang import ast
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import NOWHERE, text_at
from tappet.lang.symbols import GvlSymbol, PouSymbol, VarSymbol
from tappet.lang.walk import all_expressions

_PATHS = (ast.Name, ast.Member, ast.Index, ast.Deref)


def variables_of(snapshot: Snapshot, document: str) -> dict[str, list[str]]:
    """Expressions to monitor by element id, each once, in the order of the element; a variable of a POU with
    its owner before it: `PLC_PRG.iCount`."""
    found: dict[str, dict[str, None]] = {}
    for text, unit in snapshot.units():
        if not text.map.is_drawn(document):
            continue
        for body in _bodies(unit):
            for e, first in _variables(body):
                place = text.place(e.span)
                if place.document == document and place.element is not None:
                    written = text_at(text.source, e.span)
                    owner = first.owner if isinstance(first, VarSymbol) and first.owner else ""
                    path = f"{owner}.{written}" if owner else written
                    found.setdefault(place.element, {})[path] = None
    return {element: list(paths) for element, paths in found.items()}


def _bodies(unit: ast.Unit) -> Iterator[list[ast.Stmt]]:
    for declaration in unit.declarations:
        if isinstance(declaration, ast.Pou):
            yield declaration.body
        elif isinstance(declaration, ast.Property):
            yield from (part.body for part in (declaration.getter, declaration.setter) if part is not None)


def _first_symbol(e: ast.Expr) -> object:
    while isinstance(e, (ast.Member, ast.Index, ast.Deref)):
        e = e.base
    return e.symbol if isinstance(e, ast.Name) else None


def _variables(body: list[ast.Stmt]) -> Iterator[tuple[ast.Expr, object]]:
    """The longest paths that begin with a variable or a list of them, each with what its first name means."""
    inner: set[int] = set()
    found: list[tuple[ast.Expr, object]] = []
    for e in all_expressions(body):
        if isinstance(e, ast.Call):
            inner.add(id(e.callee))
        if not isinstance(e, _PATHS) or e.span == NOWHERE:
            continue
        if not isinstance(e, ast.Name):
            inner.add(id(e.base))
        if id(e) in inner:
            continue
        symbol = _first_symbol(e)
        if isinstance(symbol, (VarSymbol, GvlSymbol)) or (
            isinstance(symbol, PouSymbol) and symbol.instance is not None and not isinstance(e, ast.Name)
        ):
            found.append((e, symbol))
    yield from sorted(found, key=lambda item: item[0].span[:2])
