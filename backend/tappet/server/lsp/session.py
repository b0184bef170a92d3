"""One connection of an editor: its open documents, what it asks, and the messages it is told.

The session knows neither how messages travel nor where texts are stored: both are handed in.
"""

from __future__ import annotations

import asyncio
import contextlib
import gc
import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal, Protocol

from cattrs.errors import BaseValidationError
from lsprotocol import converters
from lsprotocol import types as lsp

from tappet import __version__
from tappet.lang.diagnostic_translations import Language, language_of
from tappet.lang.room_for_trees import room_for_trees
from tappet.lang.services import documents as docs
from tappet.lang.services.documents import Position, Programs
from tappet.lang.services.fix_site import Offering, nothing_offered
from tappet.lang.services.formatting import Style
from tappet.lang.services.reports import reports
from tappet.lang.services.results import Report, ServiceError
from tappet.lang.services.semantic_tokens import TOKEN_MODIFIERS, TOKEN_TYPES
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.lang.source import split_lines
from tappet.server.lsp import convert, questions, rpc
from tappet.server.lsp.positions import Line, apply_change, lines_of, to_position

DEBOUNCE_S: Final = 0.3
"""Pause in the typing after which messages are worked out anew."""
IDLE_S: Final = 2.0
"""Pause without edits after which garbage is looked for, which takes longer than a check."""
UNTIDY: Final = 3
"""So many whole analyses leave garbage at most, also when edits never pause."""
SLICE_S: Final = 0.03
"""Requests and edits wait at most so long for a check that goes on behind the messages of the edited text."""
MAX_DOCUMENT: Final = 4_000_000
"""Characters of one document."""
READ_DOCUMENT: Final = "tappet/document"
"""Our own request: the text of a document that is not open, such as one of a library."""
EXPAND_SHORTHAND: Final = "tappet/shorthand"
"""Our own request: `{line}` to the declaration it is short for, or null."""
COMPLETION_IN: Final = "tappet/completionIn"
"""Our own request: completion in a text that is being tried, see `questions.completion_in`."""
OPERAND_FACTS: Final = "tappet/operandFacts"
"""Our own request: what is declared for the operands of a table, see `questions.operand_facts`."""
CROSS_REFERENCES: Final = "tappet/crossReferences"
"""Our own request: every place that names something, see `questions.cross_reference_list`."""

log = logging.getLogger(__name__)
_CONVERTER = converters.get_converter()
_State = Literal["new", "initialized", "shut down"]


class _Positioned(Protocol):
    """Params that name a position in a document."""

    text_document: lsp.TextDocumentIdentifier
    position: lsp.Position


@dataclass(slots=True)
class _Document:
    text: str
    version: int


class LanguageSession:
    """Serves one client. Made in the event loop that serves it; `close` ends it."""

    def __init__(
        self,
        programs: Programs,
        send: rpc.Send,
        *,
        debounce_s: float = DEBOUNCE_S,
        advise: bool = False,
        canonical: Callable[[str], str] = str,
        offering: Offering = nothing_offered,
    ) -> None:
        """`advise`: advice is part of the message texts. `canonical`: one spelling for each document uri.
        `offering`: libraries that have something of a name."""
        self.workspace = Workspace(programs)
        self.endpoint = rpc.Endpoint(send, self._find)
        self.exit = asyncio.Event()
        """Set when the client has said that it ends."""
        self._loop = asyncio.get_running_loop()
        self._debounce_s = debounce_s
        self._advise = advise
        self.canonical = canonical
        self.offering = offering
        self.asks = not advise
        """Whether the client can do what no edit of texts does: ask for a declaration, make objects."""
        self.style = Style()
        self.language: Language = "en"
        """Of the messages, as the client has asked for when it began."""
        self._state: _State = "new"
        self._open: dict[str, _Document] = {}
        self._names: dict[str, str] = {}
        """Uri as the client spells it, by canonical uri."""
        self._split: tuple[int, dict[str, Line]] = (-1, {})
        """Lines of documents, as of one generation of the workspace."""
        self._published: dict[str, list[Report]] = {}
        self._opened_since: set[str] = set()
        """Documents opened since messages were published last: a new text in an editor shows none yet."""
        self._edited_since: set[str] = set()
        """Documents edited since messages were published last: theirs come first."""
        self._left = False
        """Whether messages of other documents are still to be worked out."""
        self._timer: asyncio.TimerHandle | None = None
        self._publishing: asyncio.Task[None] | None = None
        self._again = False
        self._tidying: asyncio.TimerHandle | None = None
        self._tidied = 0
        """Whole analyses of the workspace whose garbage is gone."""

    async def receive(self, message: str) -> None:
        """Take one message of the client."""
        await self.endpoint.receive(message)

    def stored_texts_changed(self) -> None:
        """Somebody else has changed what is stored. Call in the event loop."""
        self.endpoint.post(self.workspace.refresh, "stored texts changed")
        self._schedule()

    async def close(self) -> None:
        """End the session."""
        for timer in (self._timer, self._tidying):
            if timer is not None:
                timer.cancel()
        if self._publishing is not None:
            self._publishing.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._publishing
        await self.endpoint.close()

    # -- dispatch

    def _find(self, method: str, request: bool) -> rpc.Work | None:
        handler = (_REQUESTS if request else _NOTIFICATIONS).get(method)
        if handler is None:
            return None

        def work(params: Any) -> Any:
            if self._state != "initialized" and method not in ("initialize", "exit", "shutdown"):
                raise rpc.RpcError(rpc.NOT_INITIALIZED, f"'{method}' before 'initialize' or after 'shutdown'")
            try:
                result = handler(self, _structured(method, params))
            except ServiceError as error:
                raise rpc.RpcError(rpc.REQUEST_FAILED, str(error)) from error
            return _CONVERTER.unstructure(result)

        return work

    # -- life

    def initialize(self, params: lsp.InitializeParams) -> lsp.InitializeResult:
        """Tell what is served."""
        self.language = language_of(params.locale)
        self._state = "initialized"
        full = lsp.SemanticTokensLegend(list(TOKEN_TYPES), list(TOKEN_MODIFIERS))
        return lsp.InitializeResult(
            lsp.ServerCapabilities(
                position_encoding=lsp.PositionEncodingKind.Utf16,
                text_document_sync=lsp.TextDocumentSyncOptions(
                    open_close=True, change=lsp.TextDocumentSyncKind.Incremental, save=lsp.SaveOptions(False)
                ),
                completion_provider=lsp.CompletionOptions(trigger_characters=[".", "(", ",", "'"]),
                hover_provider=True,
                signature_help_provider=lsp.SignatureHelpOptions(["(", ","], [")"]),
                definition_provider=True,
                type_definition_provider=True,
                implementation_provider=True,
                references_provider=True,
                document_highlight_provider=True,
                document_symbol_provider=True,
                workspace_symbol_provider=True,
                document_formatting_provider=True,
                code_action_provider=lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix]),
                folding_range_provider=True,
                rename_provider=lsp.RenameOptions(prepare_provider=True),
                semantic_tokens_provider=lsp.SemanticTokensOptions(full, full=True),
            ),
            lsp.ServerInfo("tappet", __version__),
        )

    def initialized(self, params: lsp.InitializedParams) -> None:
        """The client is ready: begin with the messages."""
        self._schedule_from_worker()

    def shutdown(self, params: None) -> None:
        """Nothing but `exit` follows."""
        self._state = "shut down"

    def on_exit(self, params: None) -> None:
        """The client has ended."""
        self._loop.call_soon_threadsafe(self.exit.set)

    def configuration_changed(self, params: lsp.DidChangeConfigurationParams) -> None:
        """How texts are formatted: `{tappet: {format: {keywords, operators, commas}}}`."""
        self.style = convert.style(params.settings)

    # -- documents

    def did_open(self, params: lsp.DidOpenTextDocumentParams) -> None:
        """A text of the editor stands for a document from now on."""
        item = params.text_document
        self._opened_since.add(self.canonical(item.uri))
        self._set(item.uri, item.text, item.version)

    def did_change(self, params: lsp.DidChangeTextDocumentParams) -> None:
        """Edits of an open document."""
        uri = self.canonical(params.text_document.uri)
        known = self._open.get(uri)
        if known is None:
            raise rpc.RpcError(rpc.INVALID_PARAMS, f"'{params.text_document.uri}' is not open")
        text = known.text
        for change in params.content_changes:
            text = apply_change(text, change)
        self._set(params.text_document.uri, text, params.text_document.version)

    def did_close(self, params: lsp.DidCloseTextDocumentParams) -> None:
        """The stored text counts again."""
        uri = self.canonical(params.text_document.uri)
        self._open.pop(uri, None)
        self.workspace.close(uri)
        self._schedule_from_worker()

    def did_save(self, params: lsp.DidSaveTextDocumentParams) -> None:
        """What is stored has changed."""
        self.workspace.refresh()
        self._schedule_from_worker()

    def watched_files_changed(self, params: lsp.DidChangeWatchedFilesParams) -> None:
        """Files have changed on disk."""
        self.workspace.refresh()
        self._schedule_from_worker()

    def _set(self, spelled: str, text: str, version: int) -> None:
        if len(text) > MAX_DOCUMENT:
            raise rpc.RpcError(rpc.INVALID_PARAMS, f"'{spelled}' has more than {MAX_DOCUMENT} characters")
        uri = self.canonical(spelled)
        self._names[uri] = spelled
        self._edited_since.add(uri)
        self._open[uri] = _Document(text, version)
        self.workspace.open(uri, text)
        self._schedule_from_worker()

    # -- places

    def lines(self, document: str) -> Line:
        """The lines of a document, open or not."""
        if self._split[0] != self.workspace.generation:
            self._split = (self.workspace.generation, {})
        split = self._split[1]
        if document not in split:
            known = self._open.get(document)
            split[document] = lines_of(known.text if known is not None else self.text(document) or "")
        return split[document]

    def text(self, document: str) -> str | None:
        """The text of a document that is part of some program."""
        for program in self.workspace.programs():
            for text in program.texts:
                shown = text.lines_of(document)
                if shown is not None:
                    lines = split_lines(text.source.text)
                    return "\n".join(lines[shown[0] : shown[1]])
        return None

    def text_now(self, document: str) -> str | None:
        """The text of a document as the editor shows it, or as it is stored."""
        known = self._open.get(document)
        return known.text if known is not None else self.text(document)

    def at(self, params: _Positioned) -> tuple[str, Position]:
        """Document and place of a request."""
        uri = self.canonical(params.text_document.uri)
        return uri, to_position(self.lines(uri), params.position)

    def snapshot(self, uri: str) -> Snapshot:
        """The program that shows a document."""
        return self.workspace.snapshot(uri)

    def spelled(self, uri: str) -> str:
        """A uri as the client writes it."""
        return self._names.get(uri, uri)

    def location(self, place: docs.Place) -> lsp.Location:
        """A place as the client names it."""
        found = convert.location(place, self.lines)
        found.uri = self.spelled(found.uri)
        return found

    # -- messages

    def _schedule_from_worker(self) -> None:
        self._loop.call_soon_threadsafe(self._schedule)

    def _schedule(self) -> None:
        """Work the messages out when the typing pauses."""
        for timer in (self._timer, self._tidying):
            if timer is not None:
                timer.cancel()
        self._timer = self._loop.call_later(self._debounce_s, self._publish_soon)

    def _publish_soon(self) -> None:
        self._timer = None
        if self._publishing is not None and not self._publishing.done():
            self._again = True
            return
        self._publishing = self._loop.create_task(self._publish())

    async def _publish(self) -> None:
        while True:
            self._again = False
            try:
                await self._tell(self._first_messages)
                if self._left and await self._work_on():
                    await self._tell(self._all_messages)
            except Exception:
                # The session goes on: the next change of a text tries again.
                log.exception("the messages of a program could not be worked out")
                return
            await self.endpoint.run(self._prepare)
            if not self._again:
                self._tidy_later()
                return

    async def _work_on(self) -> bool:
        """Do what is left, a while at a time; False when an edit has come: its messages go first."""
        while not await self.endpoint.run(self._go_on):
            if self._again or self._timer is not None:
                return False
        return True

    async def _tell(self, messages: Callable[[], list[Any]]) -> None:
        """Publish what there is to tell."""
        for params in await self.endpoint.run(messages):
            await self.endpoint.notify(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS, params)

    def _first_messages(self) -> list[Any]:
        """What to publish first: everything, or, where an edit concerns many texts, that of the edited
        ones."""
        if self._state != "initialized":
            return []
        edited, self._edited_since = self.workspace.in_texts_of(self._edited_since), set()
        with room_for_trees():
            snapshots = self.workspace.first_snapshots(edited)
            self._left = any(snapshot.is_waiting for snapshot in snapshots)
            return self._new_messages(snapshots, edited if self._left else None)

    def _go_on(self) -> bool:
        """Work for a while on what has been left for later; whether nothing is left."""
        with room_for_trees():
            return self.workspace.go_on(SLICE_S)

    def _all_messages(self) -> list[Any]:
        """What to publish when nothing is left for later."""
        if self._state != "initialized" or self._timer is not None:
            return []
        with room_for_trees():
            return self._new_messages(self.workspace.snapshots(), None)

    def _prepare(self) -> None:
        """Make the next check quick: the trees of a whole analysis are old enough to be left alone by the
        search for young garbage, which would look at each of them during the first edit."""
        self.workspace.prepare()
        if self._tidied != self.workspace.whole_analyses:
            gc.freeze()
            gc.unfreeze()

    def _tidy_later(self) -> None:
        """Look for garbage when there are no edits for a while."""
        left = self.workspace.whole_analyses - self._tidied
        if left:
            pause = IDLE_S if left < UNTIDY else 0.0
            self._tidying = self._loop.call_later(pause, self.endpoint.post, self._tidy, "tidying")

    def _tidy(self) -> None:
        """Look for the garbage of whole analyses while nobody waits for messages."""
        self._tidied = self.workspace.whole_analyses
        gc.collect()

    def _new_messages(self, snapshots: list[Snapshot], only: set[str] | None) -> list[Any]:
        """Documents, or of some documents those, whose messages are others than those told last, and those
        that have just been opened."""
        found: dict[str, list[Report]] = {}
        for snapshot in snapshots:
            for document, entries in reports(snapshot, only).items():
                known = found.setdefault(document, [])
                known += [entry for entry in entries if entry not in known]
        out = []
        opened = {document for document in self._opened_since if only is None or document in only}
        self._opened_since -= opened
        for document in {*found, *self._published} if only is None else only:
            now = found.get(document, [])
            if now != self._published.get(document, []) or document in opened:
                version = self._open[document].version if document in self._open else None
                diagnostics = convert.diagnostics(now, document, self.lines, self._advise, self.language)
                params = lsp.PublishDiagnosticsParams(self.spelled(document), diagnostics, version)
                out.append(_CONVERTER.unstructure(params))
        if only is None:
            self._published = found
        else:
            self._published = {k: v for k, v in self._published.items() if k not in only} | found
        return out


def _structured(method: str, params: Any) -> Any:
    """The params of a method as their class. Raises RpcError naming what is wrong."""
    types = lsp.METHOD_TO_TYPES.get(method)
    kind: Any = types[2] if types is not None else None
    if kind is None:
        return params
    try:
        return _CONVERTER.structure(params if params is not None else {}, kind)
    except (BaseValidationError, TypeError, ValueError, KeyError, AttributeError) as error:
        raise rpc.RpcError(
            rpc.INVALID_PARAMS, f"The parameters of '{method}' are not as they should be"
        ) from error


_REQUESTS: Final[dict[str, Callable[[LanguageSession, Any], Any]]] = {
    lsp.INITIALIZE: LanguageSession.initialize,
    lsp.SHUTDOWN: LanguageSession.shutdown,
    lsp.TEXT_DOCUMENT_COMPLETION: questions.completion,
    lsp.TEXT_DOCUMENT_HOVER: questions.hover,
    lsp.TEXT_DOCUMENT_SIGNATURE_HELP: questions.signature_help,
    lsp.TEXT_DOCUMENT_DEFINITION: questions.definition,
    lsp.TEXT_DOCUMENT_TYPE_DEFINITION: questions.type_definition,
    lsp.TEXT_DOCUMENT_IMPLEMENTATION: questions.implementation,
    lsp.TEXT_DOCUMENT_REFERENCES: questions.references,
    lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: questions.document_highlight,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: questions.document_symbol,
    lsp.WORKSPACE_SYMBOL: questions.workspace_symbol,
    lsp.TEXT_DOCUMENT_CODE_ACTION: questions.code_action,
    CROSS_REFERENCES: questions.cross_reference_list,
    COMPLETION_IN: questions.completion_in,
    OPERAND_FACTS: questions.operand_facts,
    lsp.TEXT_DOCUMENT_FORMATTING: questions.formatting,
    lsp.TEXT_DOCUMENT_FOLDING_RANGE: questions.folding_range,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: questions.prepare_rename,
    lsp.TEXT_DOCUMENT_RENAME: questions.rename,
    lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL: questions.semantic_tokens,
    READ_DOCUMENT: questions.read_document,
    EXPAND_SHORTHAND: questions.expand_shorthand,
}
_NOTIFICATIONS: Final[dict[str, Callable[[LanguageSession, Any], Any]]] = {
    lsp.INITIALIZED: LanguageSession.initialized,
    lsp.EXIT: LanguageSession.on_exit,
    lsp.TEXT_DOCUMENT_DID_OPEN: LanguageSession.did_open,
    lsp.TEXT_DOCUMENT_DID_CHANGE: LanguageSession.did_change,
    lsp.TEXT_DOCUMENT_DID_CLOSE: LanguageSession.did_close,
    lsp.TEXT_DOCUMENT_DID_SAVE: LanguageSession.did_save,
    lsp.WORKSPACE_DID_CHANGE_CONFIGURATION: LanguageSession.configuration_changed,
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: LanguageSession.watched_files_changed,
}
