"""One browser socket on the web server's side: what its session would have to know if the analysis started
again.
"""

from __future__ import annotations

import json
import logging
from contextlib import suppress
from typing import Any

from tappet.server.analysis.messages import Attach, Document, Send
from tappet.server.analysis.outbox import Outbox
from tappet.server.lsp.open_documents import DocumentRefusedError, OpenDocuments
from tappet.server.lsp.utf16 import Edge, TextEdit

REQUEST_FAILED = -32803
_ERROR = 1
"""`MessageType.Error` of the protocol."""
_SAID = {
    "en": "The analysis of this project ended unexpectedly ({reason}). It starts again with the next edit or "
    "request; no text is lost.",
    "zh": "本项目的分析意外结束（{reason}）。下一次编辑或请求时会重新启动；文本不会丢失。",
}

log = logging.getLogger(__name__)


class Client:
    """Follows the messages of a browser as far as they must be replayed. It never refuses any: the analysis
    does."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.outbox = Outbox()
        self._initialize: Any = None
        self._begun: str | None = None
        """The request `initialize` while it has no answer."""
        self._configuration: Any = None
        self._documents = OpenDocuments()
        self._waiting: dict[int | str, str] = {}
        """Methods of requests without an answer, by id."""
        self._told: dict[str, None] = {}
        """Documents of which the browser has heard."""

    # -- what goes to the analysis

    def note(self, text: str) -> None:
        """Follow a message of the browser."""
        try:
            message = json.loads(text)
        except (ValueError, RecursionError):
            return
        if not isinstance(message, dict) or not isinstance(method := message.get("method"), str):
            return
        identifier, params = message.get("id"), message.get("params")
        if isinstance(identifier, int | str) and not isinstance(identifier, bool):
            self._waiting[identifier] = method
            if method == "initialize":
                self._initialize, self._begun = params if params is not None else {}, text
        elif method == "workspace/didChangeConfiguration":
            self._configuration = params
        elif method.startswith("textDocument/did"):
            with suppress(KeyError, TypeError, ValueError, AttributeError, DocumentRefusedError):
                self._follow(method, params)

    def _follow(self, method: str, params: Any) -> None:
        document = params["textDocument"]
        if method == "textDocument/didOpen":
            self._documents.open(str(document["uri"]), int(document["version"]), str(document["text"]))
        elif method == "textDocument/didChange":
            edits = [_edit(change) for change in params["contentChanges"]]
            self._documents.change(str(document["uri"]), int(document["version"]), edits)
        elif method == "textDocument/didClose":
            self._documents.close(str(document["uri"]))

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
                error = {"code": REQUEST_FAILED, "message": reason}
                self._put({"id": identifier, "error": error})

    def lost(self, reason: str) -> None:
        """The analysis has ended: say so and answer what waits."""
        locale = self._initialize.get("locale") if isinstance(self._initialize, dict) else None
        language = "zh" if isinstance(locale, str) and locale.lower().startswith("zh") else "en"
        said = _SAID[language].format(reason=reason)
        self._put({"method": "window/showMessage", "params": {"type": _ERROR, "message": said}})
        self.refuse(said)

    def _put(self, message: dict[str, Any]) -> None:
        self.outbox.put(json.dumps({"jsonrpc": "2.0", **message}, ensure_ascii=False))


def _edit(change: Any) -> TextEdit:
    where = change.get("range")
    if where is None:
        return TextEdit(str(change["text"]))
    start, end = where["start"], where["end"]
    return TextEdit(
        str(change["text"]),
        (
            Edge(int(start["line"]), int(start["character"])),
            Edge(int(end["line"]), int(end["character"])),
        ),
    )
