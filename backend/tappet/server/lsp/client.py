"""What requests and published messages need of the session of a client, whoever serves it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Protocol

from tappet.lang.services import documents as docs
from tappet.lang.services.documents import Position
from tappet.lang.services.fix_site import Offering
from tappet.lang.services.formatting import Style
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.server.lsp.open_documents import OpenDocuments
from tappet.server.lsp.protocol.features import TextDocumentPositionParams
from tappet.server.lsp.protocol.structures import Location, Structure
from tappet.server.lsp.shown import ShownDocument
from tappet.translation.language import Language

Methods = Mapping[str, tuple[type[Structure] | None, Callable[[Any, Any], Any]]]
"""By method: its params (None: not read), and what carries it out, with the client and the params."""


class Client(Protocol):
    """A client with its open documents and settings; what is analysed it shares with others."""

    canonical: Callable[[str], str]
    """One spelling for each document uri."""
    offering: Offering
    """Libraries that have something of a name."""
    advise: bool
    """Whether advice is part of the message texts."""
    asks: bool
    """Whether the client can do what no edit of texts does: ask for a declaration, make objects."""
    style: Style
    language: Language
    """Of the messages, as the client has asked for when it began."""
    documents: OpenDocuments
    """As the client shows them."""

    @property
    def workspace(self) -> Workspace:
        """The programs, with the unsaved texts of all sessions."""

    def shown(self, document: str) -> ShownDocument:
        """A document as this client shows it, open or not."""

    def text(self, document: str) -> str | None:
        """The text of a document as the editor shows it, or as it is stored."""

    def at(self, params: TextDocumentPositionParams) -> tuple[str, Position]:
        """Document and place of a request, in the analysed text. Raises OtherTextError."""

    def snapshot(self, uri: str) -> Snapshot:
        """The program that shows a document."""

    def location(self, place: docs.Place) -> Location | None:
        """A place as the client names it; None where it shows another text."""

    def locations(self, places: Iterable[docs.Place]) -> list[Location]:
        """Places as the client names them, those left out where it shows another text."""
