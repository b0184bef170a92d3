"""The documentation of a project, or of chosen objects of it."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Collection, Iterator
from datetime import datetime
from typing import Any

from tappet.documentation.colours import listing, plain_listing
from tappet.documentation.document import Document, Listing, Logo, Note, Section, Sheet, Table, printable
from tappet.documentation.printing import Printing, setup_for
from tappet.documentation.running import running
from tappet.documentation.variables import declared_variables
from tappet.documentation.words import Language, word
from tappet.iec.languages import language_of
from tappet.iec.listing import listing_of
from tappet.iec.tokens import WORD, pieces
from tappet.project.data import SPLIT_TEXTS, encoded_fields
from tappet.project.folder.layout import read_endings
from tappet.project.kind_registry import kind_of
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import JsonFile
from tappet.project.page_setup import PageSetupData
from tappet.project.picture import read_picture
from tappet.project.placement import words_of

_TEXTS = ("declaration", "implementation")
_NOT_SETTINGS = frozenset([*_TEXTS, "language", SPLIT_TEXTS])
_COLUMNS = ("name", "scope", "type", "initial", "address", "comment")
MOST_ROWS = 20_000
"""Rows of the cross references; a name that stands everywhere has no more places than `MOST_PLACES`."""
MOST_PLACES = 100


def compose(project: Project, printing: Printing, at: datetime, revision: int | None = None) -> Document:
    """The documentation; `revision` is that of the project, where it is known.

    Raises ProjectError where the request and the page setup of the project do not go together.
    """
    language = printing.language
    setup = setup_for(project, printing)
    chosen = printing.objects
    items = [item for item in project.walk() if chosen is None or item.id in chosen]
    sections = [_section(project, item, setup, language) for item in items]
    if setup.cross_references:
        sections.append(_cross_references(items, language))
    known = {
        "project": project.name,
        "author": setup.author,
        "company": setup.company,
        "revision": "" if revision is None else str(revision),
        "date": at.strftime("%Y-%m-%d"),
        "time": at.strftime("%H:%M"),
    }
    facts = [(word(name, language), known[name]) for name in ("company", "author", "revision") if known[name]]
    facts.append((word("printed", language), f"{known['date']} {known['time']}"))
    margins = setup.margins
    return Document(
        title=printable(project.name),
        description=project.description,
        facts=tuple((name, printable(value)) for name, value in facts),
        language=language,
        sheet=Sheet(*setup.size, (margins.top, margins.right, margins.bottom, margins.left)),
        title_page=setup.title_page,
        logo=_logo(setup),
        header=running(setup.header, known, language),
        footer=running(setup.footer, known, language),
        contents=word("contents", language) if setup.contents else "",
        sections=tuple(sections),
    )


def _logo(setup: PageSetupData) -> Logo | None:
    if setup.logo is None:
        return None
    return Logo(read_picture(setup.logo), setup.logo_on_title_page and setup.title_page, setup.logo_in_header)


def _section(project: Project, item: ProjectObject, setup: PageSetupData, language: Language) -> Section:
    level = 1 + sum(1 for _ in project.ancestors(item.id))
    about = words_of(item.subkind or item.kind)
    blocks = tuple(_blocks(item, setup, language))
    return Section(level, printable(item.name), about, blocks, printable(project.path_of(item.id)))


def _blocks(
    item: ProjectObject, setup: PageSetupData, language: Language
) -> Iterator[Listing | Table | Note]:
    data: dict[str, Any] = item.data.model_dump(mode="json")
    declaration, body = data.get("declaration"), data.get("implementation")
    if isinstance(declaration, str) and declaration:
        yield listing(word("declaration", language), declaration)
        rows = declared_variables(declaration) if setup.variables else []
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
    texts = _texts_of(item)
    for key in texts:
        text = data.get(key)
        if isinstance(text, str) and text:
            yield plain_listing(word("text", language), tuple(text.rstrip("\n").split("\n")))
    encoded = encoded_fields(type(item.data))
    shown_data = {
        key: f"{len(value) * 3 // 4:,} B" if key in encoded and value else value
        for key, value in data.items()
        if key not in _NOT_SETTINGS and key not in texts
    }
    settings = tuple(_settings(shown_data))
    if settings:
        heads = (word("name", language), word("value", language))
        yield Table(word("settings", language), heads, settings)


def _texts_of(item: ProjectObject) -> tuple[str, ...]:
    """The fields that are texts of many lines: those that are files of their own in a project folder."""
    kind = kind_of(item)
    if kind is not None:
        return tuple(kind.folder.texts) if isinstance(kind.folder, JsonFile) else ()
    return tuple(read_endings(item.data.model_dump().get(SPLIT_TEXTS)) or ())


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
