"""Rename something everywhere, or say why that is not possible."""

from __future__ import annotations

import re

from tappet.iec.words import KEYWORDS
from tappet.lang.services.documents import LIBRARY_SCHEME, Position
from tappet.lang.services.occurrences import Occurrence, occurrence_at, occurrences_of
from tappet.lang.services.resolution import block_members, is_operator, scope_at
from tappet.lang.services.results import Edit, ServiceError
from tappet.lang.services.workspace import Snapshot, View
from tappet.lang.source import Span, split_lines, text_at
from tappet.lang.symbols import EnumValueSymbol, GvlSymbol, NamespaceSymbol, PouSymbol, Symbol, VarSymbol
from tappet.lang.types import ELEMENTARY, Struct

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*", re.ASCII)


def renameable(snapshot: Snapshot, document: str, position: Position) -> Span:
    """The range of the name at a position. Raises ServiceError with the reason when it cannot be renamed."""
    view = snapshot.view(document, position)
    return view.place(_target(snapshot, view).span).span


def _target(snapshot: Snapshot, view: View) -> Occurrence:
    found = occurrence_at(snapshot, view.index, view.position)
    if found is None:
        raise ServiceError("Nothing that has a declaration stands here")
    obstacle = _obstacle(snapshot, found)
    if obstacle:
        raise ServiceError(obstacle)
    return found


def rename(snapshot: Snapshot, document: str, position: Position, name: str) -> list[Edit]:
    """The edits that give what stands at a position another name.

    Raises ServiceError when nothing there can be renamed, or when the new name is no name or taken.
    """
    view = snapshot.view(document, position)
    found = _target(snapshot, view)
    _check_name(name)
    places = list(occurrences_of(snapshot, found, view.index))
    _check_free(snapshot, found, places, name)
    edits: dict[tuple[str, Span], Edit] = {}
    for index, item in places:
        place = snapshot.program.texts[index].place(item.span)
        if place.element is not None:
            raise ServiceError(
                f"'{_written(view, found)}' is used by element {place.element} of a drawing "
                f"({snapshot.program.texts[index].source.uri}), where it cannot be renamed from here"
            )
        edits[place.document, place.span] = Edit(place, name)
    return list(edits.values())


def _written(view: View, found: Occurrence) -> str:
    return text_at(view.source, found.span)


def _obstacle(snapshot: Snapshot, found: Occurrence) -> str:
    symbol = found.symbol
    if isinstance(symbol, GvlSymbol):
        return "A global variable list is renamed as an object of the project"
    if "#" in found.key.uri:
        return ""
    text = snapshot.text_of(found.key.uri)
    if text is None:
        return "No text declares this"
    if text.read_only or any(segment.document.startswith(LIBRARY_SCHEME) for segment in text.segments):
        return f"This belongs to the library {text.source.library or ''}".rstrip() + " and cannot be renamed"
    return ""


def _check_name(name: str) -> None:
    if not _NAME.fullmatch(name):
        raise ServiceError(
            f"'{name}' is no identifier: use letters A-Z, digits and underscores, no digit first"
        )
    if "__" in name:
        raise ServiceError(f"'{name}' must not contain two underscores in a row")
    upper = name.upper()
    if upper in KEYWORDS or upper in ELEMENTARY or upper in ("STRING", "WSTRING"):
        raise ServiceError(f"'{name}' is a keyword")
    if is_operator(name):
        raise ServiceError(f"'{name}' is the name of an operator")


def _check_free(
    snapshot: Snapshot, found: Occurrence, places: list[tuple[int, Occurrence]], name: str
) -> None:
    """The new name must be free where the thing is declared, and must not be hidden where it is used."""
    key = name.upper()
    symbol = found.symbol
    if symbol is not None and symbol.name.upper() == key:
        return  # only the case changes
    if "#" in found.key.uri:
        return
    taken = _sibling(snapshot, symbol, key)
    if taken is not None:
        raise ServiceError(f"'{taken.name}' exists already")
    for index, item in places:
        text = snapshot.program.texts[index]
        position = Position(item.span.line, item.span.column)
        scope = scope_at(View(snapshot, index, text, snapshot.results[index], position))
        other = scope.locals.get(key) or (block_members(scope.block).get(key) if scope.block else None)
        if other is not None and not _is_member_access(text.source.text, item.span):
            where = scope.pou.qualified_name if scope.pou is not None else text.source.uri
            raise ServiceError(f"'{other.name}' of {where} would be meant instead of the renamed one")


def _is_member_access(text: str, span: Span) -> bool:
    line = split_lines(text)[span.line]
    return line[: span.column].rstrip().endswith((".", "#"))


def _sibling(snapshot: Snapshot, symbol: Symbol | None, key: str) -> Symbol | None:
    """What has the name already in the place where the symbol is declared."""
    if isinstance(symbol, VarSymbol) and symbol.section != "VAR_GLOBAL" and symbol.owner is not None:
        owner = snapshot.pous.get(symbol.owner.upper())
        if owner is not None:
            return owner.locals.get(key) or block_members(owner.owner or owner).get(key)
        structure = snapshot.analysis.types.get(symbol.owner.upper())
        if isinstance(structure, Struct):
            member = structure.members.get(key)
            return VarSymbol(member.name) if member is not None else None
    if isinstance(symbol, VarSymbol) and symbol.section == "VAR_GLOBAL":
        for gvl in snapshot.analysis.gvls:
            if gvl.name == symbol.owner:
                return gvl.members.get(key)
    if isinstance(symbol, PouSymbol) and symbol.owner is not None:
        return symbol.owner.locals.get(key) or block_members(symbol.owner).get(key)
    if isinstance(symbol, EnumValueSymbol):
        values = getattr(symbol.type, "values", {})
        return symbol if key in {value.upper() for value in values} else None
    found = snapshot.analysis.scope.get(key)
    if isinstance(found, NamespaceSymbol) or found is None:
        return None
    return found if found.source is None or found.source.library is None else None
