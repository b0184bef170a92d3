"""Where something is declared, and where it is used."""

from __future__ import annotations

from tappet.lang import types as t
from tappet.lang.services.documents import Place, Position
from tappet.lang.services.occurrences import (
    Key,
    declared_type,
    key_of,
    occurrence_at,
    occurrences,
    occurrences_of,
)
from tappet.lang.services.results import Reference
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import Span
from tappet.lang.symbols import GvlSymbol, InterfaceSymbol, PouSymbol, PropertySymbol, Symbol, VarSymbol


def definition(snapshot: Snapshot, document: str, position: Position) -> Place | None:
    """Where the name at a position is declared; None for what no text declares."""
    view = snapshot.view(document, position)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None:
        return None
    if "#" in found.key.uri:  # a label: in the same text
        for item in occurrences(snapshot, view.index):
            if item.key == found.key and item.role == "declaration":
                return view.place(item.span)
        return None
    if isinstance(found.symbol, GvlSymbol) or found.symbol is None:
        width = 0
    else:
        width = len(found.symbol.name.removeprefix("__get").removeprefix("__set"))
    return _place(snapshot, found.key, width or found.span.end_column - found.span.column)


def type_definition(snapshot: Snapshot, document: str, position: Position) -> Place | None:
    """Where the type of the variable at a position is declared; None for elementary types."""
    view = snapshot.view(document, position)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None or not isinstance(found.symbol, (VarSymbol, PropertySymbol)):
        return None
    type_ = found.symbol.type
    while isinstance(type_, (t.Array, t.Pointer, t.Reference)):
        type_ = type_.element if isinstance(type_, t.Array) else type_.base
    declared = declared_type(type_)
    return _place(snapshot, declared[0], len(str(type_))) if declared is not None else None


def _place(snapshot: Snapshot, key: Key, width: int) -> Place | None:
    return snapshot.place(key.uri, Span(key.line, key.column, key.line, key.column + width))


def references(
    snapshot: Snapshot, document: str, position: Position, with_declaration: bool = True
) -> list[Reference]:
    """Every place of the program that names what stands at a position."""
    view = snapshot.view(document, position)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None:
        return []
    return [
        Reference(snapshot.program.texts[index].place(item.span), item.role)
        for index, item in occurrences_of(snapshot, found, view.index)
        if with_declaration or item.role != "declaration"
    ]


def highlights(snapshot: Snapshot, document: str, position: Position) -> list[Reference]:
    """The places in the same document that name what stands at a position."""
    view = snapshot.view(document, position)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None:
        return []
    places = [
        (view.place(item.span), item.role)
        for item in occurrences(snapshot, view.index)
        if item.key == found.key
    ]
    return [Reference(place, role) for place, role in places if place.document == document]


def implementations(snapshot: Snapshot, document: str, position: Position) -> list[Place]:
    """What implements the interface, or extends or replaces the block or method, at a position."""
    view = snapshot.view(document, position)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None:
        return []
    symbol = found.symbol
    targets: list[Symbol] = []
    if isinstance(symbol, InterfaceSymbol):
        targets = [pou for pou in snapshot.analysis.pous if symbol in _interfaces(pou)]
    elif isinstance(symbol, PouSymbol) and symbol.kind == "FUNCTION_BLOCK":
        targets = [pou for pou in snapshot.analysis.pous if symbol in _bases(pou)]
    elif isinstance(symbol, PouSymbol) and symbol.kind == "METHOD":
        for pou in snapshot.analysis.pous:
            own = pou.methods.get(symbol.name.upper())
            if own is not None and own is not symbol and _replaces(pou, symbol):
                targets.append(own)
    keys = [(key_of(target), len(target.name)) for target in targets]
    places = [_place(snapshot, key, width) for key, width in keys if key is not None]
    return [place for place in places if place is not None]


def _replaces(pou: PouSymbol, method: PouSymbol) -> bool:
    if method.owner is not None:
        return method.owner in _bases(pou)
    key = method.name.upper()
    return any(interface.methods.get(key) is method for interface in _interfaces(pou))


def _bases(pou: PouSymbol) -> list[PouSymbol]:
    found: list[PouSymbol] = []
    base = pou.base
    while base is not None and base not in found:
        found.append(base)
        base = base.base
    return found


def _interfaces(pou: PouSymbol) -> list[InterfaceSymbol]:
    found: list[InterfaceSymbol] = []
    waiting = [interface for block in (pou, *_bases(pou)) for interface in block.interfaces]
    while waiting:
        interface = waiting.pop()
        if interface not in found:
            found.append(interface)
            waiting += interface.bases
    return found
