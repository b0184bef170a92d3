"""The pages of the help, made of the tables of the language, the messages and the views."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from tappet import libraries
from tappet.lang.diagnostic_translations import texts
from tappet.lang.diagnostics import TABLE
from tappet.lang.reference import topics
from tappet.server.help.shapes import HelpEntry, HelpPage, HelpSection
from tappet.server.problems import not_found
from tappet.translation.language import Language


class _View(NamedTuple):
    title: str
    text: str


@cache
def _views(language: Language) -> Mapping[str, _View]:
    table = files("tappet.server.help").joinpath("views.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(table.splitlines())
    return {row["name"]: _View(row[f"title_{language}"], row[language]) for row in rows}


def entries(language: Language) -> list[HelpEntry]:
    """All pages: words, views, messages, and the items of the installed libraries."""
    return [*_own_entries(language), *_library_entries(libraries.names())]


@cache
def _own_entries(language: Language) -> tuple[HelpEntry, ...]:
    words = (
        HelpEntry(
            kind="word",
            name=topic.title,
            title=" ".join(topic.words),
            summary=topic.text(language),
            words=list(topic.words),
            library=None,
        )
        for topic in topics().values()
    )
    views = (
        HelpEntry(kind="view", name=name, title=view.title, summary=view.text, words=[], library=None)
        for name, view in _views(language).items()
    )
    messages = (
        HelpEntry(
            kind="message",
            name=code,
            title=code,
            summary=_plain(texts(code, language).message),
            words=[code, *entry.aliases],
            library=None,
        )
        for code, entry in sorted(TABLE.items())
    )
    return (*words, *views, *messages)


@cache
def _library_entries(names: tuple[str, ...]) -> tuple[HelpEntry, ...]:
    """What the newest versions of the libraries offer, by the names of their texts: nothing is parsed."""
    return tuple(
        HelpEntry(
            kind="library", name=item, title=item, summary=library, words=[item.upper()], library=library
        )
        for library in names
        for item in sorted(
            {source.name or source.uri.rpartition("/")[2] for source in libraries.load(library).sources}
        )
    )


_HEADINGS: Mapping[str, tuple[str, str]] = {
    "example": ("Example", "示例"),
    "advice": ("What to do", "处理方法"),
    "why": ("Why", "说明"),
    "accepted": ("Accepted", "正确"),
    "reported": ("Reported", "会报告"),
    "codesys": ("In CODESYS", "在 CODESYS 中"),
}


def _section(heading: str | None, text: str, code: str | None, language: Language) -> HelpSection:
    title = None if heading is None else _HEADINGS[heading][0 if language == "en" else 1]
    return HelpSection(heading=title, text=text, code=code)


def word_page(name: str, language: Language) -> HelpPage:
    """The page of a word or sign, in any case. Raises a 404 problem."""
    wanted = name.upper()
    topic = next((one for one in topics().values() if wanted in one.words), None)
    if topic is None:
        raise not_found("word of the language", name)
    return HelpPage(
        kind="word",
        name=topic.title,
        title=" ".join(topic.words),
        sections=[
            _section(None, topic.text(language), None, language),
            _section("example", "", topic.example, language),
        ],
    )


def view_page(name: str, language: Language) -> HelpPage:
    """The page of a view of the workbench. Raises a 404 problem."""
    view = _views(language).get(name)
    if view is None:
        raise not_found("page of a view", name)
    return HelpPage(
        kind="view", name=name, title=view.title, sections=[_section(None, view.text, None, language)]
    )


def message_page(code: str, language: Language) -> HelpPage:
    """The page of a message of the compiler: what it says, what to do, why, and samples. Raises a 404
    problem. Explanations and samples are those of the manual, which is in English.
    """
    from tappet.lang.diagnostic_pages import as_text, explanation_of, samples_of  # reads all rules

    entry = TABLE.get(code.upper())
    if entry is None:
        raise not_found("message", code)
    said = texts(entry.code, language)
    sections = [
        _section(None, _plain(said.message), None, language),
        _section("advice", _plain(said.advice), None, language),
    ]
    if entry.aliases:
        sections.append(_section("codesys", ", ".join(entry.aliases), None, language))
    if (why := explanation_of(entry.code)) is not None:
        sections.append(_section("why", why, None, language))
    for sample in samples_of(entry.code):
        heading = "accepted" if sample.passes else "reported"
        sections.append(_section(heading, "", as_text(sample.text), language))
    title = f"{entry.code}: {entry.name.replace('_', ' ')}"
    return HelpPage(kind="message", name=entry.code, title=title, sections=sections)


def _plain(template: str) -> str:
    return template.replace("{{", "{").replace("}}", "}")
