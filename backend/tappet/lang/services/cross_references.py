"""Every place of a program that names something, by a place that names it or by its name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tappet.lang import ast
from tappet.lang.lexer import ADDRESS, lex
from tappet.lang.parser import parse_expression
from tappet.lang.services.documents import Position
from tappet.lang.services.occurrences import (
    Key,
    Occurrence,
    Role,
    key_of,
    occurrence_at,
    occurrences,
    occurrences_of,
)
from tappet.lang.services.resolution import Scope, resolve
from tappet.lang.services.results import CrossReference
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import Span, split_lines
from tappet.lang.symbols import EnumValueSymbol, PouSymbol, Symbol, VarSymbol

_SELECTED = re.compile(r"\[[^\]]*\]|\^")
"""An element of an array, and what a pointer leads to."""


def cross_references(snapshot: Snapshot, document: str, position: Position) -> list[CrossReference]:
    """Where what stands at a position is declared and used; a direct address as well."""
    view = snapshot.view(document, position)
    for index, kind in enumerate(view.lexed.kinds):
        if kind is ADDRESS and view.lexed.lines[index] == view.position.line:
            column, text = view.lexed.columns[index], view.lexed.texts[index]
            if column <= view.position.column <= column + len(text):
                return _of_address(snapshot, text)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None:
        return []
    return _listed(snapshot, occurrences_of(snapshot, found, view.index))


def cross_references_of(snapshot: Snapshot, name: str) -> list[CrossReference]:
    """Where everything of a name is declared and used: `iCount`, `PLC_PRG.iCount`, `TON` or `%IX0.0`.

    Of a path through instances, `PLC_PRG.aValve[2].xOpen`, it is what the last name means.
    """
    path = [part for part in _SELECTED.sub("", name).strip().upper().split(".") if part]
    if name.strip().startswith("%"):
        return _of_address(snapshot, name.strip())
    if not path:
        return []
    meant = _meant(snapshot, name)
    if meant is not None:
        path, keys = [meant.name], {key for key in (key_of(meant),) if key is not None}
    else:
        keys = _declared(snapshot, path)
    named = re.compile(rf"(?<!\w){re.escape(path[-1])}(?!\w)", re.IGNORECASE)
    places: list[tuple[int, Occurrence]] = []
    for index, text in enumerate(snapshot.program.texts):
        if not text.read_only and named.search(text.source.text):
            places += [(index, item) for item in occurrences(snapshot, index) if item.key in keys]
    return _listed(snapshot, iter(places))


def _meant(snapshot: Snapshot, expression: str) -> Symbol | None:
    """What an expression of the application names; None for a plain name or one with its owner alone."""
    found, faults = parse_expression(expression)
    while isinstance(found, (ast.Index, ast.Deref)):
        found = found.base
    if faults or (isinstance(found, ast.Member) and isinstance(found.base, ast.Name)):
        return None
    return resolve(Scope(snapshot, None), found).symbol if isinstance(found, ast.Member) else None


def _declared(snapshot: Snapshot, path: list[str]) -> set[Key]:
    """Identities of what a path of names may mean, the owner of the first name left open."""
    keys: set[Key] = set()
    if len(path) == 1:
        symbol = snapshot.analysis.scope.get(path[0])
        key = key_of(symbol) if symbol is not None else None
        if key is not None:
            keys.add(key)
    named = re.compile(rf"(?<!\w){re.escape(path[-1])}(?!\w)", re.IGNORECASE)
    for index, text in enumerate(snapshot.program.texts):
        if text.read_only or not named.search(text.source.text):
            continue
        lines = split_lines(text.source.text)
        for item in occurrences(snapshot, index):
            if item.role != "declaration":
                continue
            label = _label(item.symbol, _written(lines, item.span)).upper().split(".")
            if label[-len(path) :] == path:
                keys.add(item.key)
    return keys


def _listed(snapshot: Snapshot, places: Iterator[tuple[int, Occurrence]]) -> list[CrossReference]:
    found: dict[tuple[str, Span], CrossReference] = {}
    for index, item in places:
        text = snapshot.program.texts[index]
        if text.read_only:
            continue
        lines = split_lines(text.source.text)
        place = text.place(item.span)
        label = _label(item.symbol, _written(lines, item.span))
        line = lines[item.span.line].rstrip()
        found.setdefault((place.document, place.span), CrossReference(place, item.role, label, line))
    return list(found.values())


def _written(lines: list[str], span: Span) -> str:
    return lines[span.line][span.column : span.end_column]


def _label(symbol: Symbol | None, written: str) -> str:
    """The name of something with its owner."""
    if isinstance(symbol, PouSymbol):
        own = symbol.qualified_name or symbol.name
        return own.replace("__get", "").replace("__set", "")
    if isinstance(symbol, VarSymbol):
        return f"{symbol.owner}.{symbol.name}" if symbol.owner else symbol.name
    if isinstance(symbol, EnumValueSymbol):
        return f"{symbol.type}.{symbol.name}"
    return symbol.name if symbol is not None else written


def _of_address(snapshot: Snapshot, address: str) -> list[CrossReference]:
    """Where a direct address stands: in declarations behind AT, and among statements."""
    wanted = address.upper()
    found: list[CrossReference] = []
    for text in snapshot.program.texts:
        if text.read_only or wanted not in text.source.text.upper():
            continue
        lexed = lex(text.source.text, text.source.uri)
        lines = split_lines(text.source.text)
        for index, kind in enumerate(lexed.kinds):
            if kind is not ADDRESS or lexed.texts[index].upper() != wanted:
                continue
            line, column = lexed.lines[index], lexed.columns[index]
            place = text.place(Span(line, column, line, column + len(wanted)))
            declared = index > 0 and lexed.texts[index - 1].upper() == "AT"
            written = lexed.kinds[index + 1] == ":="
            role: Role = "declaration" if declared else "write" if written else "read"
            found.append(CrossReference(place, role, wanted, lines[line].rstrip()))
    return found
