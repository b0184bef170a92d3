"""Basic structures: numbers, places, texts, edits, diagnostics (LSP 3.17, Basic JSON Structures)."""

from __future__ import annotations

from enum import IntEnum
from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

MAX_UINTEGER = 2**31 - 1
Uinteger = Annotated[int, Meta(ge=0, le=MAX_UINTEGER)]
Integer = Annotated[int, Meta(ge=-(2**31), le=2**31 - 1)]


class Structure(Struct, rename="camel", omit_defaults=True):
    """An object of the protocol."""


class Position(Structure):
    """A place between two characters; `character` counts UTF-16 units."""

    line: Uinteger
    character: Uinteger


class Range(Structure):
    """From a position up to another one, which does not belong to it."""

    start: Position
    end: Position


class Location(Structure):
    """A range of a document."""

    uri: str
    range: Range


class TextDocumentIdentifier(Structure):
    """A document."""

    uri: str


class VersionedTextDocumentIdentifier(Structure):
    """One version of a document."""

    uri: str
    version: Integer


class TextDocumentItem(Structure):
    """A document with its text."""

    uri: str
    language_id: str
    version: Integer
    text: str


class TextEdit(Structure):
    """A range and the text in its place."""

    range: Range
    new_text: str


class WorkspaceEdit(Structure):
    """Edits by document."""

    changes: dict[str, list[TextEdit]] | None = None


class MarkupContent(Structure):
    """A text for people."""

    kind: Literal["plaintext", "markdown"]
    value: str


class DiagnosticSeverity(IntEnum):
    """How bad it is."""

    ERROR = 1
    WARNING = 2
    INFORMATION = 3
    HINT = 4


class DiagnosticTag(IntEnum):
    """How a range is drawn besides."""

    UNNECESSARY = 1
    DEPRECATED = 2


class DiagnosticRelatedInformation(Structure):
    """Another place that explains a diagnostic."""

    location: Location
    message: str


class Diagnostic(Structure):
    """A message about a range."""

    range: Range
    message: str
    severity: DiagnosticSeverity | None = None
    code: str | None = None
    source: str | None = None
    tags: list[DiagnosticTag] | None = None
    related_information: list[DiagnosticRelatedInformation] | None = None
    data: Any = None
    """See `product.DiagnosticData`."""
