"""What a query finds in the texts of the libraries that a project refers to; they can only be read."""

from __future__ import annotations

import time
from collections.abc import Iterator

from tappet import libraries
from tappet.iec.sections import subkind_of
from tappet.libraries import UnknownLibraryError
from tappet.libraries.library import Library
from tappet.project.data import UnknownData
from tappet.project.model import Project
from tappet.project.search.contents import Content
from tappet.project.search.finding import find_in_content
from tappet.project.search.pattern import Pattern
from tappet.project.search.query import Area, Query
from tappet.project.sources import compiled
from tappet.server.search.replies import hit_reply
from tappet.server.search.shapes import SearchObject, SearchReport

SECONDS = 10.0


def find_in_libraries(project: Project, query: Query, *, after: str | None, limit: int) -> SearchReport:
    """Raises InvalidPatternError. `after` is the address of a text."""
    pattern = Pattern(query)
    end = time.monotonic() + SECONDS
    found: list[SearchObject] = []
    total = searched = 0
    waiting = after is not None
    for library in _libraries_of(project):
        for source in library.sources:
            if waiting:
                waiting = source.uri != after
                continue
            searched += 1
            content = Content(Area.IMPLEMENTATIONS, (), source.text, "declaration", writable=False)
            name = source.name or source.uri.rpartition("/")[2]
            hits = list(find_in_content(pattern, _of_one_text(query), content))
            if hits:
                kept = hits[: limit - total]
                total += len(kept)
                found.append(
                    SearchObject(
                        object_id=None,
                        library=library.name,
                        name=name,
                        path=f"{library.name}/{name}",
                        kind="library_item",
                        subkind=subkind_of(source.text),
                        revision=0,
                        hits=[hit_reply(hit) for hit in kept],
                        total=len(hits),
                    )
                )
            if total >= limit or time.monotonic() > end:
                return SearchReport(objects=found, next=source.uri, searched=searched)
    return SearchReport(objects=found, next=None, searched=searched)


def _of_one_text(query: Query) -> Query:
    """The texts of libraries are not divided: whoever searches declarations or bodies searches them whole."""
    whole = {Area.IMPLEMENTATIONS} if query.areas & {Area.DECLARATIONS, Area.IMPLEMENTATIONS} else set()
    areas = frozenset(whole | (query.areas & {Area.COMMENTS}))
    return Query(query.text, query.match_case, query.whole_words, query.regular_expression, areas)


def _libraries_of(project: Project) -> Iterator[Library]:
    """Each library that something in the project refers to, once; what is not installed is left out."""
    seen = set()
    for item in project.walk():
        asked = compiled(item).libraries
        if asked is None or isinstance(item.data, UnknownData):
            continue
        for reference in asked(item.data, project.path_of(item.id)):
            try:
                library = libraries.load(reference.name, reference.version)
            except UnknownLibraryError:
                continue
            if (library.name, library.version) not in seen:
                seen.add((library.name, library.version))
                yield library
