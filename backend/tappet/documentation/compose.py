"""The documentation of a project, or of chosen objects of it."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Collection, Iterator
from datetime import datetime
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from tappet.documentation.colours import listing, plain_listing
from tappet.documentation.document import Document, Listing, Note, Section, Table, printable
from tappet.documentation.variables import declared_variables
from tappet.documentation.words import Language, word
from tappet.iec.languages import language_of
from tappet.iec.listing import listing_of
from tappet.iec.tokens import WORD, pieces
from tappet.project.model import Project, ProjectObject
from tappet.project.placement import words_of

_TEXTS = ("declaration", "implementation")
_NOT_SETTINGS = frozenset([*_TEXTS, "language"])
_COLUMNS = ("name", "scope", "type", "initial", "address", "comment")
MOST_ROWS = 20_000
"""Rows of the cross references; a name that stands everywhere has no more places than `MOST_PLACES`."""
MOST_PLACES = 100


class Printing(BaseModel):
    """What is printed, and how."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    language: Language = "en"
    paper: Literal["a4", "us-letter"] = "a4"
    objects: frozenset[str] | None = Field(
        default=None, max_length=100_000, description="Ids of the objects that are printed; null: all."
    )
    contents: bool = Field(default=True, description="With a table of contents.")
    variables: bool = Field(default=True, description="With tables of the variables that are declared.")
    cross_references: bool = Field(default=False, description="With the places of all names of the project.")
    author: str = Field(default="", max_length=200)
    footer: str = Field(default="", max_length=200, description="At the left of the foot of each page.")


def compose(project: Project, printing: Printing, at: datetime, revision: int | None = None) -> Document:
    """The documentation; `revision` is that of the project, where it is known."""
    language = printing.language
    chosen = printing.objects
    items = [item for item in project.walk() if chosen is None or item.id in chosen]
    sections = [_section(project, item, printing) for item in items]
    if printing.cross_references:
        sections.append(_cross_references(items, language))
    facts = [(word("author", language), printing.author)] if printing.author else []
    if revision is not None:
        facts.append((word("revision", language), str(revision)))
    facts.append((word("printed", language), at.strftime("%Y-%m-%d %H:%M")))
    return Document(
        title=printable(project.name),
        description=project.description,
        facts=tuple((name, printable(value)) for name, value in facts),
        language=language,
        paper=printing.paper,
        footer=printable(printing.footer),
        contents=word("contents", language) if printing.contents else "",
        page=word("page", language, page="{page}", pages="{pages}"),
        sections=tuple(sections),
    )


def _section(project: Project, item: ProjectObject, printing: Printing) -> Section:
    level = 1 + sum(1 for _ in project.ancestors(item.id))
    about = words_of(item.subkind or item.kind)
    return Section(level, printable(item.name), about, tuple(_blocks(item, printing)))


def _blocks(item: ProjectObject, printing: Printing) -> Iterator[Listing | Table | Note]:
    language = printing.language
    data: dict[str, Any] = item.data.model_dump(mode="json")
    declaration, body = data.get("declaration"), data.get("implementation")
    if isinstance(declaration, str) and declaration:
        yield listing(word("declaration", language), declaration)
        rows = declared_variables(declaration) if printing.variables else []
        if rows:
            shown = tuple(tuple(printable(cell) for cell in row) for row in rows)
            yield Table(word("variables", language), tuple(word(head, language) for head in _COLUMNS), shown)
    if isinstance(body, str) and body:
        title = word("implementation", language)
        name = str(data.get("language", "ST"))
        form = language_of(name).form_of(body)
        if form == "drawn":
            yield plain_listing(f"{title} ({name})", tuple(listing_of(body).lines))
        elif form == "kept":
            yield Note(word("kept", language, name=name))
        else:
            yield listing(f"{title} ({name})", body)
    settings = tuple(_settings({key: value for key, value in data.items() if key not in _NOT_SETTINGS}))
    if settings:
        heads = (word("name", language), word("value", language))
        yield Table(word("settings", language), heads, settings)


def _settings(data: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Data that are no texts of the language, as names and values."""
    for key, value in data.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict):
            yield from _settings(value, f"{name}.")
        elif isinstance(value, list) and any(isinstance(one, dict | list) for one in value):
            numbered = {str(number): one for number, one in enumerate(value, 1)}
            yield from _settings(numbered, f"{name}.")
        elif value not in (None, "", [], False):
            shown = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
            yield printable(name), "\n".join(printable(line) for line in shown.split("\n"))


def _cross_references(items: Collection[ProjectObject], language: Language) -> Section:
    """Where the names of objects and of global variables stand; by name, as texts need not compile."""
    names: dict[str, str] = {}
    for item in items:
        data = item.data.model_dump(mode="json")
        if isinstance(data.get("declaration"), str):
            names.setdefault(item.name.upper(), item.name)
            for row in declared_variables(data["declaration"]):
                if row.scope.startswith("VAR_GLOBAL"):
                    names.setdefault(row.name.upper(), row.name)
    places: dict[str, list[str]] = defaultdict(list)
    for item in items:
        data = item.data.model_dump(mode="json")
        for part in _TEXTS:
            text = data.get(part)
            if not isinstance(text, str) or (part == "implementation" and _is_no_text(data)):
                continue
            for name, line in _words(text):
                if name in names:
                    places[name].append(f"{item.name} ({word(part, language)} {line})")
    rows = tuple(
        (
            printable(names[name]),
            printable(", ".join(found[:MOST_PLACES]) + (" ..." if len(found) > MOST_PLACES else "")),
        )
        for name, found in sorted(places.items())[:MOST_ROWS]
    )
    heads = (word("name", language), word("places", language))
    return Section(1, word("cross", language), "", (Table("", heads, rows),))


def _is_no_text(data: dict[str, Any]) -> bool:
    return language_of(str(data.get("language", "ST"))).form_of(data["implementation"]) != "text"


def _words(text: str) -> Iterator[tuple[str, int]]:
    """Each word with its line, once a line."""
    seen: set[tuple[str, int]] = set()
    line, at = 1, 0
    for kind, piece, begin, _ in pieces(text):
        if kind is not WORD:
            continue
        line += text.count("\n", at, begin)
        at = begin
        key = (piece.upper(), line)
        if key not in seen:
            seen.add(key)
            yield key
