"""The messages of a document, at their places in it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from tappet.lang.diagnostics import Diagnostic
from tappet.lang.services.documents import Place, Text
from tappet.lang.services.results import RelatedReport, Report
from tappet.lang.services.workspace import Snapshot

MAX_PER_DOCUMENT = 500
"""An editor shows no more; a text with more has one mistake that makes the others."""


@dataclass(slots=True)
class Published:
    """The messages of one text as its documents show them, as long as the text and the messages stay: none of
    them names a place in another text."""

    text: Text
    diagnostics: list[Diagnostic]
    reports: dict[str, list[Report]]


def reports(snapshot: Snapshot, only: Collection[str] | None = None) -> dict[str, list[Report]]:
    """All messages of a program, or those of some documents, by document, libraries left out; without an
    entry a document has none."""
    by_text: dict[str, list[Diagnostic]] = {}
    for diagnostic in snapshot.diagnostics:
        by_text.setdefault(diagnostic.uri, []).append(diagnostic)
    found: dict[str, list[Report]] = {}
    for uri, diagnostics in by_text.items():
        text = snapshot.text_of(uri)
        if text is None or text.read_only:
            continue
        if only is not None and not any(segment.document in only for segment in text.segments):
            continue
        for document, entries in _of_text(snapshot, text, diagnostics).items():
            if only is None or document in only:
                known = found.setdefault(document, [])
                known += entries[: MAX_PER_DOCUMENT - len(known)]
    return found


def _of_text(snapshot: Snapshot, text: Text, diagnostics: list[Diagnostic]) -> dict[str, list[Report]]:
    published: Published | None = snapshot.published.get(text.source.uri)
    if published is not None and published.diagnostics == diagnostics and published.text == text:
        return published.reports
    found: dict[str, list[Report]] = {}
    for diagnostic in diagnostics:
        place = text.place(diagnostic.span)
        entries = found.setdefault(place.document, [])
        if len(entries) < MAX_PER_DOCUMENT:
            entries.append(report_of(snapshot, diagnostic, place))
    uri = text.source.uri
    if all(item.uri == uri for diagnostic in diagnostics for item in diagnostic.related):
        snapshot.published[uri] = Published(text, diagnostics, found)
    return found


def report_of(snapshot: Snapshot, diagnostic: Diagnostic, place: Place) -> Report:
    """A message as its document shows it."""
    return Report(
        place.span,
        diagnostic.code,
        diagnostic.severity,
        diagnostic.message,
        diagnostic.advice,
        tuple(_related(snapshot, diagnostic)),
        diagnostic.facts,
        place.element,
    )


def _related(snapshot: Snapshot, diagnostic: Diagnostic) -> list[RelatedReport]:
    found = []
    for item in diagnostic.related:
        place = snapshot.place(item.uri, item.span)
        if place is not None:
            found.append(RelatedReport(place, item.message))
    return found
