"""The diagnostics published to one session, and those that are new to it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from tappet.lang.services.results import Report
from tappet.server.lsp import convert
from tappet.server.lsp.client import Client
from tappet.server.lsp.protocol.structures import Diagnostic
from tappet.server.lsp.protocol.synchronization import PublishDiagnosticsParams
from tappet.translation.language import Language

Published = dict[tuple[str, Language, bool], list[Diagnostic]]
"""Messages of documents in one language: sessions that show the same text share them."""


class Publication:
    """Used in the thread of the analysis only."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._reports: Mapping[str, list[Report]] = {}
        """What was published last, of documents with messages."""
        self._due: set[str] = set()
        """Documents to publish in any case: just opened, where an editor shows no messages yet."""
        self._moved: set[str] = set()
        """Documents whose messages were published at other lines, because the client shows another text."""

    def expect(self, documents: Iterable[str]) -> None:
        """Publish these the next time, also when they have no messages."""
        self._due.update(documents)

    def news(
        self, found: Mapping[str, list[Report]], only: Collection[str] | None, published: Published
    ) -> list[PublishDiagnosticsParams]:
        """Params of what is new, by the messages of all documents or of `only` these."""
        out = []
        due = self._due if only is None else {document for document in self._due if document in only}
        self._due = self._due - due
        # sorted, so that equal states are published in one order
        concerned = {*found, *self._reports, *due, *self._moved} if only is None else {*only}
        for document in sorted(concerned):
            now = found.get(document, [])
            other = self._client.shown(document).is_other
            known = now == self._reports.get(document, [])
            if not known or document in due or other or document in self._moved:
                out.append(self._params(document, now, published))
                (self._moved.add if other else self._moved.discard)(document)
        if only is None:
            self._reports = found
        else:
            self._reports = {k: v for k, v in self._reports.items() if k not in only} | dict(found)
        return out

    def _params(self, document: str, now: list[Report], published: Published) -> PublishDiagnosticsParams:
        client = self._client
        key = (document, client.language, client.advise)
        mine = any(report.related for report in now) or client.shown(document).is_other
        diagnostics = None if mine else published.get(key)
        if diagnostics is None:
            diagnostics = convert.diagnostics(now, document, client.shown, client.advise, client.language)
            if not mine:
                published[key] = diagnostics
        shown = client.documents.get(document)
        version = shown.version if shown is not None else None
        return PublishDiagnosticsParams(client.documents.spelled(document), diagnostics, version)
