"""Notifications on documents, of the client and of the server (LSP 3.17, Document Synchronization)."""

from __future__ import annotations

from tappet.server.lsp.protocol.structures import (
    Diagnostic,
    Integer,
    Range,
    Structure,
    TextDocumentIdentifier,
    TextDocumentItem,
    VersionedTextDocumentIdentifier,
)


class DidOpenTextDocumentParams(Structure):
    """An editor shows a document."""

    text_document: TextDocumentItem


class TextDocumentContentChangeEvent(Structure):
    """An edit; without a range the text is the whole document."""

    text: str
    range: Range | None = None


class DidChangeTextDocumentParams(Structure):
    """Edits of an open document, each on what the one before has left; the version is that after all."""

    text_document: VersionedTextDocumentIdentifier
    content_changes: list[TextDocumentContentChangeEvent]


class DidCloseTextDocumentParams(Structure):
    """An editor shows a document no longer."""

    text_document: TextDocumentIdentifier


class PublishDiagnosticsParams(Structure):
    """All diagnostics of a document, in place of those before."""

    uri: str
    diagnostics: list[Diagnostic]
    version: Integer | None = None
    """Of the text that they are about."""
