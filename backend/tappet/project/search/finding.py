"""What a query finds in objects and texts.

Cost: linear in what is searched. A search ends after `limit` hits or `seconds` and says where to go on, so
that an answer has a size and a time whatever is asked.
"""

from __future__ import annotations

import time
from bisect import bisect_right
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from tappet.project.errors import UnknownObjectError
from tappet.project.model import Project, ProjectObject
from tappet.project.search.contents import Content, contents_of
from tappet.project.search.pattern import Found, Pattern
from tappet.project.search.query import Area, Query

BEFORE = 60
"""Characters of the line that are shown before a hit."""
AFTER = 160
"""Characters that are shown of a hit, and of the line behind it."""


@dataclass(frozen=True, slots=True)
class Hit:
    """A place where something was found. Lines and columns count from 1, columns in code points."""

    number: int
    """Of this hit in its object, from 0; the same as long as object and query are."""
    area: Area
    content: Content
    found: Found
    line: int
    column: int
    end_line: int
    end_column: int
    before: str
    """The beginning of the line, cut on the left."""
    match: str
    after: str
    """The rest of the line, cut on the right."""


@dataclass(frozen=True, slots=True)
class ObjectHits:
    """What was found in an object."""

    item: ProjectObject
    path: str
    hits: tuple[Hit, ...]
    total: int
    """More than `hits` where the limit has cut them."""


@dataclass(frozen=True, slots=True)
class Findings:
    """What was found in a project."""

    objects: tuple[ObjectHits, ...]
    next: str | None
    """The object behind which the search goes on; None when everything was searched."""
    searched: int
    """Number of objects."""


def find_in_project(
    project: Project,
    query: Query,
    *,
    within: Collection[str] | None = None,
    children: bool = True,
    after: str | None = None,
    limit: int = 2000,
    seconds: float = 10.0,
) -> Findings:
    """What a query finds in the objects `within`, and below them with `children`; None is the whole project.

    `after` goes on behind that object. Raises InvalidPatternError, UnknownObjectError.
    """
    pattern = Pattern(query)
    chosen = _chosen(project, within, children)
    end = time.monotonic() + seconds
    found: list[ObjectHits] = []
    total = searched = 0
    waiting = after is not None
    if after is not None:
        project.get(after)
    for item in project.walk():
        if waiting:
            waiting = item.id != after
            continue
        if chosen is not None and item.id not in chosen:
            continue
        searched += 1
        hits = find_in_object(pattern, query, item)
        if hits:
            kept = tuple(hits[: limit - total])
            found.append(ObjectHits(item, project.path_of(item.id), kept, len(hits)))
            total += len(kept)
        if total >= limit or time.monotonic() > end:
            return Findings(tuple(found), item.id, searched)
    return Findings(tuple(found), None, searched)


def _chosen(project: Project, within: Collection[str] | None, children: bool) -> set[str] | None:
    if within is None:
        return None
    chosen = set(within)
    for object_id in within:
        if object_id not in project.objects:
            raise UnknownObjectError(f"The project '{project.name}' has no object with the id {object_id}")
        if children:
            chosen.update(item.id for item in project.walk(object_id))
    return chosen


def find_in_object(pattern: Pattern, query: Query, item: ProjectObject) -> list[Hit]:
    """All hits in an object, in the order of its texts."""
    hits: list[Hit] = []
    for content in contents_of(item):
        hits += find_in_content(pattern, query, content, len(hits))
    return hits


def find_in_content(pattern: Pattern, query: Query, content: Content, number: int = 0) -> Iterator[Hit]:
    """The hits in one text that are in an area which is asked for; `number` is that of the first."""
    code = content.part is not None
    if content.area not in query.areas and not (code and Area.COMMENTS in query.areas):
        return
    lines: list[int] | None = None
    comments = None
    for found in pattern.matches(content.text):
        if code and comments is None:
            comments = content.comments()
        area = Area.COMMENTS if comments is not None and comments.holds(found.start) else content.area
        if area not in query.areas:
            continue
        lines = _line_starts(content.text) if lines is None else lines
        yield _hit(number, area, content, found, lines)
        number += 1


def _line_starts(text: str) -> list[int]:
    starts = [0]
    while (position := text.find("\n", starts[-1])) >= 0:
        starts.append(position + 1)
    return starts


def _hit(number: int, area: Area, content: Content, found: Found, lines: list[int]) -> Hit:
    text = content.text
    line = bisect_right(lines, found.start) - 1
    end_line = bisect_right(lines, found.end) - 1
    begin = lines[line]
    line_end = text.find("\n", found.end)
    line_end = len(text) if line_end < 0 else line_end
    cut = max(begin, found.start - BEFORE)
    before = text[cut : found.start]
    return Hit(
        number,
        area,
        content,
        found,
        line + 1,
        found.start - begin + 1,
        end_line + 1,
        found.end - lines[end_line] + 1,
        before.lstrip() if cut == begin else f"…{before}",
        _cut(text[found.start : found.end]),
        _cut(text[found.end : line_end]),
    )


def _cut(text: str) -> str:
    return text if len(text) <= AFTER else f"{text[:AFTER]}…"
