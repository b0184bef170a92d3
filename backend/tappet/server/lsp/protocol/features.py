"""Questions about documents and their answers (LSP 3.17, Language Features and Workspace Features).

Where params of several methods are the same, they are one class here.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Any, Literal

from tappet.server.lsp.protocol.structures import (
    Diagnostic,
    Location,
    MarkupContent,
    Position,
    Range,
    Structure,
    TextDocumentIdentifier,
    TextEdit,
    Uinteger,
    WorkspaceEdit,
)


class TextDocumentParams(Structure):
    """A document asked about: `DocumentSymbolParams`, `FoldingRangeParams`, `SemanticTokensParams`."""

    text_document: TextDocumentIdentifier


class TextDocumentPositionParams(Structure):
    """A place that is asked about: `HoverParams`, `CompletionParams`, `DefinitionParams` ..."""

    text_document: TextDocumentIdentifier
    position: Position


class CompletionItemKind(IntEnum):
    """What a proposal is."""

    TEXT = 1
    METHOD = 2
    FUNCTION = 3
    CONSTRUCTOR = 4
    FIELD = 5
    VARIABLE = 6
    CLASS = 7
    INTERFACE = 8
    MODULE = 9
    PROPERTY = 10
    UNIT = 11
    VALUE = 12
    ENUM = 13
    KEYWORD = 14
    SNIPPET = 15
    COLOR = 16
    FILE = 17
    REFERENCE = 18
    FOLDER = 19
    ENUM_MEMBER = 20
    CONSTANT = 21
    STRUCT = 22
    EVENT = 23
    OPERATOR = 24
    TYPE_PARAMETER = 25


class CompletionItemTag(IntEnum):
    """How a proposal is drawn besides."""

    DEPRECATED = 1


class InsertTextFormat(IntEnum):
    """Whether an inserted text has places to fill in."""

    PLAIN_TEXT = 1
    SNIPPET = 2


class CompletionItem(Structure):
    """A proposal."""

    label: str
    kind: CompletionItemKind | None = None
    tags: list[CompletionItemTag] | None = None
    detail: str | None = None
    documentation: MarkupContent | None = None
    sort_text: str | None = None
    filter_text: str | None = None
    insert_text_format: InsertTextFormat | None = None
    text_edit: TextEdit | None = None


class CompletionList(Structure):
    """Proposals; incomplete ones are asked for again when more is typed."""

    is_incomplete: bool
    items: list[CompletionItem]


class Hover(Structure):
    """An explanation of a range."""

    contents: MarkupContent
    range: Range | None = None


class ParameterInformation(Structure):
    """A parameter: begin and end of it in the label of its signature, in UTF-16 units."""

    label: tuple[Uinteger, Uinteger]
    documentation: MarkupContent | None = None


class SignatureInformation(Structure):
    """The head of something that can be called."""

    label: str
    parameters: list[ParameterInformation]
    active_parameter: Uinteger | None
    """Null, as of LSP 3.18: none of them."""
    documentation: MarkupContent | None = None


class SignatureHelp(Structure):
    """The call being written."""

    signatures: list[SignatureInformation]
    active_signature: Uinteger
    active_parameter: Uinteger | None
    """Null, as of LSP 3.18: none of them."""


class ReferenceContext(Structure):
    """Whether the declaration is a reference as well."""

    include_declaration: bool


class ReferenceParams(TextDocumentPositionParams):
    """Something whose uses are asked for."""

    context: ReferenceContext


class DocumentHighlightKind(IntEnum):
    """What is done with a name at a place."""

    TEXT = 1
    READ = 2
    WRITE = 3


class DocumentHighlight(Structure):
    """A place of a name."""

    range: Range
    kind: DocumentHighlightKind | None = None


class SymbolKind(IntEnum):
    """What a symbol is."""

    FILE = 1
    MODULE = 2
    NAMESPACE = 3
    PACKAGE = 4
    CLASS = 5
    METHOD = 6
    PROPERTY = 7
    FIELD = 8
    CONSTRUCTOR = 9
    ENUM = 10
    INTERFACE = 11
    FUNCTION = 12
    VARIABLE = 13
    CONSTANT = 14
    STRING = 15
    NUMBER = 16
    BOOLEAN = 17
    ARRAY = 18
    OBJECT = 19
    KEY = 20
    NULL = 21
    ENUM_MEMBER = 22
    STRUCT = 23
    EVENT = 24
    OPERATOR = 25
    TYPE_PARAMETER = 26


class DocumentSymbol(Structure):
    """An entry of the outline."""

    name: str
    kind: SymbolKind
    range: Range
    selection_range: Range
    """That of the name."""
    detail: str | None = None
    children: list[DocumentSymbol] | None = None


class WorkspaceSymbolParams(Structure):
    """A part of a name."""

    query: str


class SymbolInformation(Structure):
    """A symbol of the workspace."""

    name: str
    kind: SymbolKind
    location: Location
    container_name: str | None = None


class CodeActionParams(Structure):
    """A range that something may be done about. Its diagnostics are ours and known without being told."""

    text_document: TextDocumentIdentifier
    range: Range


class CodeAction(Structure):
    """Something that mends a diagnostic."""

    title: str
    kind: Literal["quickfix"] | None = None
    diagnostics: list[Diagnostic] | None = None
    is_preferred: bool | None = None
    edit: WorkspaceEdit | None = None
    data: Any = None
    """What no edit of texts does, see `product.CodeActionData`."""


class FormattingOptions(Structure):
    """How lines are indented."""

    tab_size: Uinteger
    insert_spaces: bool


class DocumentFormattingParams(Structure):
    """A document to format."""

    text_document: TextDocumentIdentifier
    options: FormattingOptions


class FoldingRange(Structure):
    """Lines that can be folded."""

    start_line: Uinteger
    end_line: Uinteger
    kind: Literal["comment", "imports", "region"] | None = None


class RenameParams(TextDocumentPositionParams):
    """Something and its new name."""

    new_name: str


class PrepareRenamePlaceholder(Structure):
    """What can be renamed, and its name."""

    range: Range
    placeholder: str


class SemanticTokens(Structure):
    """Five numbers for each token, places relative to the token before."""

    data: list[Uinteger]
