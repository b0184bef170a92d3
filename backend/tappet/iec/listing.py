"""The listing of a drawn body: one line of text an element, so that what is drawn has lines and columns too.

Contract: a drawn body is stored as a JSON object. Every object inside it with a text `id` is an element, in
the order of the file. Its line is a comment, so that the text around stays text for every tool: the id, then
each text that the element itself holds, in order. A text of several lines (statements in a box) has lines of
its own below. `Listing.places` says where a text of the body stands, so that what a reader makes of `a + b`
has the span of these very characters: messages, cross references and renaming see names where they stand.
Cost: linear in the body.
Reason: see `iec.places`; and a listing can be read by people in a message or a log.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

INDENT = "// "
"""What every line begins with."""
Path = tuple[str | int, ...]
MAX_DEPTH = 200
"""Levels of objects and lists; deeper ones are left out, their reader says what is wrong."""


@dataclass(frozen=True, slots=True)
class Element:
    """An object with an id in a drawn body."""

    id: str
    line: int
    """First line in the listing, from 0."""
    path: Path
    """Where the element stands in the body."""
    value: dict[str, Any]


@dataclass(slots=True)
class Listing:
    """The lines of a drawn body and where its texts stand in them."""

    body: Any = None
    """What the JSON says; None when it is none."""
    problem: str = ""
    """Why the body cannot be read."""
    lines: list[str] = field(default_factory=list)
    elements: list[Element] = field(default_factory=list)
    places: dict[Path, tuple[int, int]] = field(default_factory=dict)
    """Line and column of each text of an element, by its path in the body."""


def listing_of(body: str) -> Listing:
    """The listing of a stored body; never raises. An empty body has none."""
    if not body.strip():
        return Listing(body={})
    try:
        value = json.loads(body)
    except RecursionError:
        return Listing(problem="it is nested too deeply", lines=[INDENT])
    except ValueError as error:
        return Listing(problem=str(error), lines=[INDENT])
    if not isinstance(value, dict):
        return Listing(problem="it is no JSON object", lines=[INDENT])
    found = Listing(value)
    _collect(found, value, (), None)
    found.lines = found.lines or [INDENT]
    return found


def _collect(found: Listing, value: Any, path: Path, element: Element | None) -> None:
    if len(path) > MAX_DEPTH:
        return
    if isinstance(value, dict):
        name = value.get("id")
        if isinstance(name, str) and path:
            element = Element(name, len(found.lines), path, value)
            found.elements.append(element)
            found.lines.append(f"{INDENT}{_plain(name)}:")
            _texts(found, value, path, element)
        for key, item in value.items():
            _collect(found, item, (*path, key), element)
    elif isinstance(value, list):
        for number, item in enumerate(value):
            _collect(found, item, (*path, number), element)


def _texts(found: Listing, value: Any, path: Path, element: Element) -> None:
    """Enter the texts that an element itself holds; those of elements inside it are theirs."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in items:
        here = (*path, key)
        if isinstance(item, str):
            if here != (*element.path, "id"):
                _enter(found, item, here, element.line)
        elif isinstance(item, (dict, list)) and len(here) <= MAX_DEPTH and not _is_element(item):
            _texts(found, item, here, element)


def _is_element(item: object) -> bool:
    return isinstance(item, dict) and isinstance(item.get("id"), str)


def _enter(found: Listing, text: str, path: Path, line: int) -> None:
    pieces = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if len(pieces) == 1:
        column = len(found.lines[line]) + 1
        found.lines[line] += f" {pieces[0]}"
        found.places[path] = line, column
        return
    found.places[path] = len(found.lines), len(INDENT)
    found.lines += [INDENT + piece for piece in pieces]


def _plain(name: str) -> str:
    return " ".join(name.split())
