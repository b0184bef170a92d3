"""One browser socket on the web server's side: what its session would have to know if the analysis started
again.
"""

from __future__ import annotations

import logging
from contextlib import suppress
from typing import Final

import msgspec

from tappet.server.analysis.messages import Attach, Document, Send
from tappet.server.analysis.outbox import Outbox
from tappet.server.lsp import rpc
from tappet.server.lsp.open_documents import DocumentRefusedError, OpenDocuments
from tappet.server.lsp.protocol.lifecycle import InitializeParams
from tappet.server.lsp.protocol.synchronization import (
    DidChangeTextDocumentParams,
    DidCloseTextDocumentParams,
    DidOpenTextDocumentParams,
)
from tappet.translation.language import Language, language_of
from tappet.translation.sentences import sentence

_ERROR: Final = 1
"""`MessageType.Error` of the protocol."""

log = logging.getLogger(__name__)


class Client:
    """Follows the messages of a browser as far as they must be replayed. It never refuses any: the analysis
    does."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.outbox = Outbox()
        self._initialize: str | None = None
        """Params of `initialize`, as JSON."""
        self._begun: str | None = None
        """The request `initialize` while it has no answer."""
        self._configuration: str | None = None
        """Params of the newest `workspace/didChangeConfiguration`, as JSON."""
        self._documents = OpenDocuments()
        self._waiting: dict[rpc.Id, str] = {}
        """Methods of requests without an answer, by id."""
        self._told: dict[str, None] = {}
        """Documents of which the browser has heard."""

    # -- what goes to the analysis

    def note(self, text: str) -> None:
        """Follow a message of the browser."""
        with suppress(rpc.RpcError, DocumentRefusedError):
            message = rpc.read(text)
            if message.method is None:
                return
            if message.id is not None:
                self._waiting[message.id] = message.method
                if message.method == "initialize":
                    self._initialize, self._begun = _text(message.params), text
            else:
                self._follow(message.method, message.params)

    def _follow(self, method: str, params: msgspec.Raw) -> None:
        if method == "workspace/didChangeConfiguration":
            self._configuration = _text(params)
        elif method == "textDocument/didOpen":
            opened = rpc.params_as(DidOpenTextDocumentParams, method, params).text_document
            self._documents.open(opened.uri, opened.version, opened.text)
        elif method == "textDocument/didChange":
            changed = rpc.params_as(DidChangeTextDocumentParams, method, params)
            document = changed.text_document
            self._documents.change(document.uri, document.version, changed.content_changes)
        elif method == "textDocument/didClose":
            closed = rpc.params_as(DidCloseTextDocumentParams, method, params)
            self._documents.close(closed.text_document.uri)

    def attach(self) -> Attach:
        """The session as it has to be now."""
        documents = [self._documents.get(uri) for uri in self._documents]
        return Attach(
            self.number,
            None if self._begun else self._initialize,
            self._configuration,
            [Document(d.spelled, d.version, d.text) for d in documents if d is not None],
            list(self._told),
        )

    def begun(self) -> str | None:
        """The request `initialize` while it has no answer: it is asked again."""
        return self._begun

    # -- what goes to the browser

    def take(self, message: Send) -> None:
        """A message of the analysis."""
        if message.answers is not None:
            if self._waiting.pop(message.answers, None) == "initialize":
                self._begun = None
        elif message.replaces:
            self._told[message.replaces] = None
        self.outbox.put(message.text, message.replaces)

    def refuse(self, reason: str) -> None:
        """Answer what waits: the analysis cannot."""
        for identifier, method in list(self._waiting.items()):
            if method != "initialize":
                del self._waiting[identifier]
                said = sentence(reason, self._language())
                self.outbox.put(rpc.failure(identifier, rpc.REQUEST_FAILED, said))

    def lost(self, reason: str) -> None:
        """The analysis has ended: say so and answer what waits."""
        text = (
            f"The analysis of this project ended unexpectedly ({reason}). It starts again with the next edit "
            "or request; no text is lost."
        )
        said = sentence(text, self._language())
        self.outbox.put(rpc.notification("window/showMessage", {"type": _ERROR, "message": said}))
        self.refuse(text)

    def _language(self) -> Language:
        """What the browser has asked for when it began."""
        if self._initialize is not None:
            with suppress(rpc.RpcError):
                params = msgspec.Raw(self._initialize)
                return language_of(rpc.params_as(InitializeParams, "initialize", params).locale)
        return "en"


def _text(json: msgspec.Raw) -> str:
    return bytes(json).decode()
