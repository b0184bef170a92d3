"""The installed libraries."""

from __future__ import annotations

from functools import cache

from fastapi import APIRouter
from pydantic import TypeAdapter

from tappet import libraries
from tappet.libraries import Library, UnknownLibraryError, catalog
from tappet.server.dependencies import Viewer
from tappet.server.problems import Problem, not_found
from tappet.server.schemas.libraries import LibraryDetail, LibraryItem, LibrarySource, LibrarySummary

router = APIRouter(prefix="/libraries", tags=["libraries"])
_ITEMS = TypeAdapter(list[LibraryItem])


def _load(name: str) -> Library:
    try:
        return libraries.load(name)
    except UnknownLibraryError as error:
        raise Problem(404, "not-found", f"{error}.") from None


@cache
def _items(name: str) -> list[LibraryItem]:
    return _ITEMS.validate_python(catalog.items(_load(name)), from_attributes=True)


def _summary(library: Library) -> LibrarySummary:
    return LibrarySummary(
        name=library.name,
        version=library.version,
        namespace=library.namespace,
        company=library.company,
        description=library.description,
    )


@router.get("")
def list_libraries(who: Viewer) -> list[LibrarySummary]:
    """All libraries a project may refer to."""
    return [_summary(libraries.load(name)) for name in libraries.names()]


@router.get("/{name}")
def get_library(name: str, who: Viewer) -> LibraryDetail:
    """A library with its POUs and types, their pins, defaults and comments."""
    library = _load(name)
    return LibraryDetail(**_summary(library).model_dump(), items=_items(library.name))


@router.get("/{name}/sources/{item}")
def get_library_source(name: str, item: str, who: Viewer) -> LibrarySource:
    """The ST text of an item: libraries are open."""
    for source in _load(name).sources:
        if (source.name or "").upper() == item.upper():
            return LibrarySource(uri=source.uri, text=source.text)
    raise not_found(f"item of library {name}", item)
