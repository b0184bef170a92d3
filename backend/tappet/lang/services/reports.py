"""The messages of a document, at their places in it."""

from __future__ import annotations

from collections.abc import Collection

from tappet.lang.diagnostics import Diagnostic
from tappet.lang.services.documents import Place
from tappet.lang.services.results import RelatedReport, Report
from tappet.lang.services.workspace import Snapshot

MAX_PER_DOCUMENT = 500
"""An editor shows no more; a text with more has one mistake that makes the others."""


def reports(snapshot: Snapshot, only: Collection[str] | None = None) -> dict[str, list[Report]]:
    """All messages of a program, or those of some documents, by document, libraries left out; without an
    entry a document has none."""
    found: dict[str, list[Report]] = {}
    for diagnostic in snapshot.diagnostics:
        text = snapshot.text_of(diagnostic.uri)
        if text is None or text.read_only:
            continue
        place = text.place(diagnostic.span)
        if only is not None and place.document not in only:
            continue
        entries = found.setdefault(place.document, [])
        if len(entries) < MAX_PER_DOCUMENT:
            entries.append(report_of(snapshot, diagnostic, place))
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
    )


def _related(snapshot: Snapshot, diagnostic: Diagnostic) -> list[RelatedReport]:
    found = []
    for item in diagnostic.related:
        place = snapshot.place(item.uri, item.span)
        if place is not None:
            found.append(RelatedReport(place, item.message))
    return found
