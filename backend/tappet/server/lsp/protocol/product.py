"""Requests of our own front end (`tappet/...`), and what our answers carry as `data`."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct

from tappet.server.lsp.protocol.structures import Position, Range, Structure, TextDocumentIdentifier

MAX_LINE = 10_000
"""Characters of a line that may be short for a declaration."""
MAX_NAME = 500
MAX_TRIAL = 1_000_000
"""Characters of a text that is being tried."""
MAX_OPERANDS = 2000
Name = Annotated[str, Meta(max_length=MAX_NAME)]


class ReadDocumentParams(Structure):
    """`tappet/document`: a document that is in no editor, such as one of a library."""

    uri: str


class DocumentText(Structure):
    """The answer to `tappet/document`."""

    uri: str
    language_id: str
    text: str


class ShorthandParams(Structure):
    """`tappet/shorthand`: a typed line of a declaration editor."""

    line: Annotated[str, Meta(max_length=MAX_LINE)]


class CompletionInParams(Structure):
    """`tappet/completionIn`: a place of a text that is being tried in place of the document."""

    text_document: TextDocumentIdentifier
    position: Position
    text: Annotated[str, Meta(max_length=MAX_TRIAL)]


class OperandFactsParams(Structure):
    """`tappet/operandFacts`: operands of a body."""

    text_document: TextDocumentIdentifier
    operands: Annotated[list[Name], Meta(max_length=MAX_OPERANDS)]


class CrossReferencesParams(Structure):
    """`tappet/crossReferences`: something by its name, or by a place where it stands."""

    name: Name | None = None
    text_document: TextDocumentIdentifier | None = None
    position: Position | None = None


class FoundReference(Struct, frozen=True):
    """A place that names something, of the answer to `tappet/crossReferences`."""

    uri: str
    range: Range
    access: Literal["declaration", "read", "write", "call", "address"]
    element: str | None
    """Element of a drawing."""
    symbol: str
    """What is named, with its owner."""
    text: str
    """The line of the place."""


class DiagnosticData(Structure):
    """What a diagnostic carries besides its text."""

    advice: str
    facts: dict[str, str]
    """What the message is about, by the names in the table of diagnostics."""
    element: str | None = None
    """Element of a drawing."""


class Declaration(Struct, frozen=True):
    """A variable that the client asks about before it declares it."""

    name: str
    type: str


class Member(Struct, frozen=True):
    """An object below a POU that the client makes."""

    kind: str
    name: str
    declaration: str
    accessors: list[str]


class Members(Struct, frozen=True):
    """Objects that a POU misses."""

    owner: str
    """Document of the POU."""
    items: list[Member]


class CodeActionData(Struct, frozen=True):
    """What the client does with a code action besides its edit; null where there is nothing."""

    key: str
    values: dict[str, str]
    declare: Declaration | None
    library: str | None
    """To add to the project."""
    members: Members | None
