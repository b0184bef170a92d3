"""The texts of an object that can be searched, each with its place in the data and the area it belongs to."""

from __future__ import annotations

import json
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from tappet.iec.languages import language_of
from tappet.iec.tokens import COMMENT, pieces
from tappet.project.data import encoded_fields
from tappet.project.kind_registry import kind_of
from tappet.project.model import ProjectObject
from tappet.project.search.query import Area
from tappet.project.source_text import Part

Path = tuple[str | int, ...]
NAME_PATH: Path = ()
"""The path of the name of an object, which is not in its data."""
_PARTS: dict[str, Part] = {"declaration": "declaration", "implementation": "implementation"}
_NOT_SEARCHED = frozenset(["language", "exclude_from_build"])
MAX_DEPTH = 200
"""Levels of objects and lists in the data; deeper ones are left out."""


@dataclass(frozen=True, slots=True)
class Content:
    """One text of an object."""

    area: Area
    path: Path
    """Where it stands in the data."""
    text: str
    part: Part | None = None
    element: str | None = None
    """Id of the element of a drawn body."""
    inner: Path | None = None
    """Where it stands in a drawn body, which is JSON in a text of the data."""
    writable: bool = True

    def comments(self) -> Comments:
        """Where its comments are; only code has any."""
        return Comments(self.text if self.part is not None else "")


class Comments:
    """Where the comments of a text are."""

    def __init__(self, text: str) -> None:
        found = [(piece.start, piece.end) for piece in pieces(text) if piece.kind == COMMENT] if text else []
        self._starts = [start for start, _ in found]
        self._ends = [end for _, end in found]

    def holds(self, offset: int) -> bool:
        """Whether a character is one of a comment."""
        at = bisect_right(self._starts, offset) - 1
        return at >= 0 and offset < self._ends[at]


def contents_of(item: ProjectObject) -> Iterator[Content]:
    """Everything of an object that can be searched: its name, its declaration, its body, then the others."""
    kind = kind_of(item)
    fixed = kind is None or kind.naming.style == "fixed"
    yield Content(Area.NAMES, NAME_PATH, item.name, writable=not fixed)
    data = item.data.model_dump(mode="json")
    for field, part in _PARTS.items():
        text = data.get(field)
        if not isinstance(text, str):
            continue
        if part == "implementation" and _is_drawn(data, text):
            yield from _drawn(text)
            continue
        area = Area.DECLARATIONS if part == "declaration" else Area.IMPLEMENTATIONS
        yield Content(area, (field,), text, part)
    left_out = _NOT_SEARCHED | encoded_fields(type(item.data))
    for field, value in data.items():
        if field not in _PARTS and field not in left_out:
            for path, text, writable in _leaves(value, (field,)):
                yield Content(Area.TABLES, path, text, writable=writable)


def _is_drawn(data: dict[str, Any], text: str) -> bool:
    return language_of(str(data.get("language", "ST"))).form_of(text) == "drawn"


def _drawn(text: str) -> Iterator[Content]:
    """The texts of a drawn body; one that cannot be read has none."""
    try:
        body = json.loads(text)
    except (ValueError, RecursionError):
        return
    yield from _elements(body, (), None)


def _elements(value: Any, path: Path, element: str | None) -> Iterator[Content]:
    if len(path) > MAX_DEPTH:
        return
    if isinstance(value, dict):
        name = value.get("id")
        if isinstance(name, str) and path:
            element = name
        for key, item in value.items():
            if key != "id":
                yield from _elements(item, (*path, key), element)
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _elements(item, (*path, number), element)
    elif isinstance(value, str) and value:
        where: Path = ("implementation",)
        yield Content(Area.IMPLEMENTATIONS, where, value, "implementation", element, inner=path)


def _leaves(value: Any, path: Path) -> Iterator[tuple[Path, str, bool]]:
    """Texts and numbers in data; numbers can only be found: other digits may be no number of the model."""
    if len(path) > MAX_DEPTH:
        return
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _leaves(item, (*path, key))
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _leaves(item, (*path, number))
    elif isinstance(value, str) and value:
        yield path, value, True
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, str(value), False
