"""The documents that one client has open, as its editors show them: texts, versions and spelled uris.

Plain texts without any analysis: the session beside the analysis keeps them, and so does the web server,
which replays them to an analysis that starts again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Final

from tappet.server.lsp.protocol.synchronization import TextDocumentContentChangeEvent
from tappet.server.lsp.utf16 import edited

MAX_DOCUMENT: Final = 4_000_000
"""Characters of one document."""
MAX_OPEN: Final = 10_000
"""Documents that one client may have open."""


class DocumentRefusedError(ValueError):
    """A document that is too long, one too many, or one that is not open; the text says which."""


@dataclass(frozen=True, slots=True)
class OpenDocument:
    """One document of an editor."""

    spelled: str
    """The uri as the client writes it."""
    version: int
    text: str


class OpenDocuments:
    """By canonical uri: `canonical` gives one spelling for each document."""

    def __init__(self, canonical: Callable[[str], str] = str) -> None:
        self._canonical = canonical
        self._open: dict[str, OpenDocument] = {}
        self._spelled: dict[str, str] = {}
        """Also of documents that have been closed: messages may still be about them."""

    def __iter__(self) -> Iterator[str]:
        return iter(self._open)

    def __len__(self) -> int:
        return len(self._open)

    def get(self, uri: str) -> OpenDocument | None:
        """The document of a canonical uri."""
        return self._open.get(uri)

    def text(self, uri: str) -> str | None:
        """What the editor shows; None when the document is not open."""
        known = self._open.get(uri)
        return known.text if known is not None else None

    def spelled(self, uri: str) -> str:
        """A uri as the client writes it."""
        return self._spelled.get(uri, uri)

    def open(self, spelled: str, version: int, text: str) -> str:
        """A document is shown from now on; its canonical uri. Raises DocumentRefusedError."""
        uri = self._canonical(spelled)
        if uri not in self._open and len(self._open) >= MAX_OPEN:
            raise DocumentRefusedError(f"More than {MAX_OPEN} documents are open; close some")
        self._set(uri, OpenDocument(spelled, version, text))
        return uri

    def change(self, spelled: str, version: int, edits: Iterable[TextDocumentContentChangeEvent]) -> str:
        """Edits of an open document, one after the other; its canonical uri. Raises DocumentRefusedError."""
        uri = self._canonical(spelled)
        known = self._open.get(uri)
        if known is None:
            raise DocumentRefusedError(f"'{spelled}' is not open")
        text = known.text
        for edit in edits:
            text = edited(text, edit)
        self._set(uri, OpenDocument(spelled, version, text))
        return uri

    def close(self, spelled: str) -> str:
        """The document is shown no longer; its canonical uri."""
        uri = self._canonical(spelled)
        self._open.pop(uri, None)
        return uri

    def _set(self, uri: str, document: OpenDocument) -> None:
        if len(document.text) > MAX_DOCUMENT:
            raise DocumentRefusedError(f"'{document.spelled}' has more than {MAX_DOCUMENT} characters")
        self._spelled[uri] = document.spelled
        self._open[uri] = document
