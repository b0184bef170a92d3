"""One connection of an editor: its open documents, its requests, and the messages published to it.

The session knows neither how messages travel nor where texts are stored: both are handed in. What is
analysed it shares with the other sessions of the project (`project_analysis`).
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any, Final, Literal

from msgspec import Raw

from tappet import __version__
from tappet.lang.services import documents as docs
from tappet.lang.services.documents import Position
from tappet.lang.services.fix_site import Offering, nothing_offered
from tappet.lang.services.formatting import Style
from tappet.lang.services.results import ServiceError
from tappet.lang.services.semantic_tokens import TOKEN_MODIFIERS, TOKEN_TYPES
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.lang.source import split_lines
from tappet.server.lsp import convert, questions, rpc
from tappet.server.lsp.client import Methods
from tappet.server.lsp.open_documents import DocumentRefusedError, OpenDocument, OpenDocuments
from tappet.server.lsp.positions import lines_of
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.protocol import lifecycle, synchronization
from tappet.server.lsp.protocol.features import TextDocumentPositionParams
from tappet.server.lsp.protocol.structures import Location
from tappet.server.lsp.publication import Publication
from tappet.server.lsp.shown import OtherTextError, ShownDocument
from tappet.server.lsp.text_difference import TextDifference
from tappet.translation.language import Language, language_of
from tappet.translation.sentences import sentence

_REFUSING: Final = frozenset({"textDocument/rename", "textDocument/prepareRename", "tappet/crossReferences"})
"""Requests that say why where the client shows another text than the analysed one; others answer nothing."""

_State = Literal["new", "initialized", "shut down"]


@dataclass(frozen=True, slots=True)
class Attached:
    """A client as an earlier session has left it, for one that takes its place."""

    initialize: str | None = None
    """Params of `initialize` as JSON; None: the client has not begun."""
    configuration: str | None = None
    """Params of the newest `workspace/didChangeConfiguration` as JSON."""
    documents: tuple[OpenDocument, ...] = ()
    published: tuple[str, ...] = ()
    """Documents of which the client shows messages."""


class LanguageSession:
    """Serves one client. Made in the event loop that serves it; `close` ends it."""

    def __init__(
        self,
        analysis: ProjectAnalysis,
        send: rpc.Send,
        *,
        advise: bool = False,
        canonical: Callable[[str], str] = str,
        offering: Offering = nothing_offered,
    ) -> None:
        """`advise`: advice is part of the message texts. `canonical`: one spelling for each document uri.
        `offering`: libraries that have something of a name."""
        self.analysis = analysis
        self.endpoint = rpc.Endpoint(
            send, self._find, analysis.thread, lambda text: sentence(text, self.language)
        )
        self.exit = asyncio.Event()
        """Set when the client has said that it ends."""
        self.advise = advise
        self.canonical = canonical
        self.offering = offering
        self.asks = not advise
        """Whether the client can do what no edit of texts does: ask for a declaration, make objects."""
        self.style = Style()
        self.language: Language = "en"
        """Of the messages, as the client has asked for when it began."""
        self.documents = OpenDocuments(canonical)
        """As the client shows them."""
        self.publication = Publication(self)
        self._state: _State = "new"
        self._shown: tuple[int, dict[str, ShownDocument]] = (-1, {})
        """Documents, as of one generation of the workspace and of the open texts."""
        analysis.attach(self)

    @property
    def workspace(self) -> Workspace:
        """The programs, with the unsaved texts of all sessions."""
        return self.analysis.workspace

    @property
    def is_initialized(self) -> bool:
        """Whether the client wants messages."""
        return self._state == "initialized"

    async def receive(self, message: str) -> None:
        """Take one message of the client."""
        await self.endpoint.receive(message)

    def take_over(self, client: Attached) -> None:
        """Continue with a client whose session was lost. Call before anything is received."""

        def restore() -> None:
            if client.initialize is not None:
                known = Raw(client.initialize)
                self.initialize(rpc.params_as(lifecycle.InitializeParams, "initialize", known))
            if client.configuration is not None:
                with suppress(rpc.RpcError):  # they were refused the first time as well
                    kind, settings = lifecycle.DidChangeConfigurationParams, Raw(client.configuration)
                    self.configuration_changed(
                        rpc.params_as(kind, "workspace/didChangeConfiguration", settings)
                    )
            for document in client.documents:
                self._put(
                    self.documents.open(document.spelled, document.version, document.text), edited=False
                )
            self.publication.expect([*client.published, *self.documents])
            self.analysis.schedule_from_thread(False)

        self.endpoint.post(restore, "taking over")

    async def close(self) -> None:
        """End the session; its unsaved texts count no longer."""
        await self.endpoint.close()
        self.analysis.detach(self, list(self.documents))

    # -- dispatch

    def _find(self, method: str, request: bool) -> rpc.Work | None:
        found = (_REQUESTS if request else _NOTIFICATIONS).get(method)
        if found is None:
            return None
        kind, carry_out = found

        def work(params: Raw) -> Any:
            if self._state != "initialized" and method not in ("initialize", "exit", "shutdown"):
                raise rpc.RpcError(rpc.NOT_INITIALIZED, f"'{method}' before 'initialize' or after 'shutdown'")
            try:
                return carry_out(self, rpc.params_as(kind, method, params) if kind is not None else None)
            except OtherTextError as error:
                if request and method not in _REFUSING:
                    return None
                raise rpc.RpcError(rpc.REQUEST_FAILED, str(error)) from error
            except ServiceError as error:
                raise rpc.RpcError(rpc.REQUEST_FAILED, str(error)) from error

        return work

    # -- life

    def initialize(self, params: lifecycle.InitializeParams) -> lifecycle.InitializeResult:
        """The capabilities of this server."""
        self.language = language_of(params.locale)
        self._state = "initialized"
        full = lifecycle.SemanticTokensLegend(list(TOKEN_TYPES), list(TOKEN_MODIFIERS))
        return lifecycle.InitializeResult(
            lifecycle.ServerCapabilities(
                position_encoding="utf-16",
                text_document_sync=lifecycle.TextDocumentSyncOptions(
                    open_close=True,
                    change=lifecycle.TextDocumentSyncKind.INCREMENTAL,
                    save=lifecycle.SaveOptions(include_text=False),
                ),
                completion_provider=lifecycle.CompletionOptions(trigger_characters=[".", "(", ",", "'"]),
                hover_provider=True,
                signature_help_provider=lifecycle.SignatureHelpOptions(["(", ","], [")"]),
                definition_provider=True,
                type_definition_provider=True,
                implementation_provider=True,
                references_provider=True,
                document_highlight_provider=True,
                document_symbol_provider=True,
                workspace_symbol_provider=True,
                document_formatting_provider=True,
                code_action_provider=lifecycle.CodeActionOptions(["quickfix"]),
                folding_range_provider=True,
                rename_provider=lifecycle.RenameOptions(prepare_provider=True),
                semantic_tokens_provider=lifecycle.SemanticTokensOptions(full, full=True),
            ),
            lifecycle.ServerInfo("tappet", __version__),
        )

    def initialized(self, params: None) -> None:
        """The client is ready: begin with the messages."""
        self.analysis.schedule_from_thread(False)

    def shutdown(self, params: None) -> None:
        """Nothing but `exit` follows."""
        self._state = "shut down"

    def on_exit(self, params: None) -> None:
        """The client has ended."""
        self.analysis.loop.call_soon_threadsafe(self.exit.set)

    def configuration_changed(self, params: lifecycle.DidChangeConfigurationParams) -> None:
        """How texts are formatted: `{tappet: {format: {keywords, operators, commas}}}`."""
        self.style = convert.style(params.settings)

    # -- documents

    def did_open(self, params: synchronization.DidOpenTextDocumentParams) -> None:
        """A text of the editor replaces a stored document from now on."""
        item = params.text_document
        with _refusals():
            uri = self.documents.open(item.uri, item.version, item.text)
        self.publication.expect([uri])
        self._put(uri, edited=False)

    def did_change(self, params: synchronization.DidChangeTextDocumentParams) -> None:
        """Edits of an open document."""
        item = params.text_document
        with _refusals():
            uri = self.documents.change(item.uri, item.version, params.content_changes)
        self._put(uri, edited=True)

    def did_close(self, params: synchronization.DidCloseTextDocumentParams) -> None:
        """The stored text, or that of another session, counts again."""
        uri = self.documents.close(params.text_document.uri)
        self._shown = (-1, {})
        self.analysis.drop(self, uri)

    def did_save(self, params: None) -> None:
        """What is stored has changed."""
        self.analysis.refresh()

    def watched_files_changed(self, params: None) -> None:
        """Files have changed on disk."""
        self.analysis.refresh()

    def _put(self, uri: str, *, edited: bool) -> None:
        text = self.documents.text(uri)
        assert text is not None
        self._shown = (-1, {})
        self.analysis.put(self, uri, text, edited=edited)

    # -- places

    def shown(self, document: str) -> ShownDocument:
        """A document as this client shows it, open or not."""
        if self._shown[0] != self.workspace.generation:
            self._shown = (self.workspace.generation, {})
        found = self._shown[1].get(document)
        if found is None:
            found = self._shown[1][document] = self._show(document)
        return found

    def _show(self, document: str) -> ShownDocument:
        texts, spelled = self.analysis.texts, self.documents.spelled(document)
        if self.workspace.is_drawn(document):
            line = lines_of(self._composed_text(document) or "")
            return ShownDocument(document, spelled, line, line, None)
        own = self.documents.text(document)
        shown = own if own is not None else texts.stored(document)
        analysed = texts.analysed(document)
        if analysed is None:
            analysed = shown if shown is not None else self._composed_text(document) or ""
        if shown is None or shown == analysed:
            line = lines_of(analysed)
            return ShownDocument(document, spelled, line, line, None)
        difference = TextDifference(shown, analysed)
        return ShownDocument(document, spelled, lines_of(analysed), lines_of(shown), difference)

    def _composed_text(self, document: str) -> str | None:
        """The text of a document that is part of some program, such as one of a library."""
        for text in self.workspace.texts_showing(document):
            shown = text.lines_of(document)
            if shown is not None:
                lines = split_lines(text.source.text)
                return "\n".join(lines[shown[0] : shown[1]])
        return None

    def text(self, document: str) -> str | None:
        """The text of a document as the editor shows it, or as it is stored."""
        own = self.documents.text(document)
        stored = own if own is not None else self.analysis.texts.stored(document)
        return stored if stored is not None else self._composed_text(document)

    def at(self, params: TextDocumentPositionParams) -> tuple[str, Position]:
        """Document and place of a request, in the analysed text. Raises OtherTextError."""
        uri = self.canonical(params.text_document.uri)
        return uri, self.shown(uri).position(params.position)

    def snapshot(self, uri: str) -> Snapshot:
        """The program that shows a document."""
        return self.workspace.snapshot(uri)

    def location(self, place: docs.Place) -> Location | None:
        """A place as the client names it; None where it shows another text."""
        return convert.location(place, self.shown)

    def locations(self, places: Iterable[docs.Place]) -> list[Location]:
        """Places as the client names them, those left out where it shows another text."""
        found = (self.location(place) for place in places)
        return [place for place in found if place is not None]


@contextmanager
def _refusals() -> Iterator[None]:
    """A document that is refused is an error of the params."""
    try:
        yield
    except DocumentRefusedError as error:
        raise rpc.RpcError(rpc.INVALID_PARAMS, str(error)) from error


_REQUESTS: Final[Methods] = {
    "initialize": (lifecycle.InitializeParams, LanguageSession.initialize),
    "shutdown": (None, LanguageSession.shutdown),
    **questions.QUESTIONS,
}
_NOTIFICATIONS: Final[Methods] = {
    "initialized": (None, LanguageSession.initialized),
    "exit": (None, LanguageSession.on_exit),
    "textDocument/didOpen": (synchronization.DidOpenTextDocumentParams, LanguageSession.did_open),
    "textDocument/didChange": (synchronization.DidChangeTextDocumentParams, LanguageSession.did_change),
    "textDocument/didClose": (synchronization.DidCloseTextDocumentParams, LanguageSession.did_close),
    "textDocument/didSave": (None, LanguageSession.did_save),
    "workspace/didChangeConfiguration": (
        lifecycle.DidChangeConfigurationParams,
        LanguageSession.configuration_changed,
    ),
    "workspace/didChangeWatchedFiles": (None, LanguageSession.watched_files_changed),
}
