"""The begin of a session: what a client says about itself, what the server can do (LSP 3.17, Lifecycle)."""

from __future__ import annotations

from enum import IntEnum
from typing import Any, Literal

from tappet.server.lsp.protocol.structures import Structure


class InitializeParams(Structure):
    """The client; of what it says about itself only the language matters here."""

    locale: str | None = None


class DidChangeConfigurationParams(Structure):
    """Settings of the client."""

    settings: Any


class TextDocumentSyncKind(IntEnum):
    """How a client sends what changes in a text."""

    NONE = 0
    FULL = 1
    INCREMENTAL = 2


class SaveOptions(Structure):
    """Whether the text comes with the notification that it was saved."""

    include_text: bool | None = None


class TextDocumentSyncOptions(Structure):
    """Which notifications on documents the server wants."""

    open_close: bool | None = None
    change: TextDocumentSyncKind | None = None
    save: SaveOptions | None = None


class CompletionOptions(Structure):
    """Characters after which proposals are asked for."""

    trigger_characters: list[str] | None = None


class SignatureHelpOptions(Structure):
    """Characters after which the signature is asked for, and asked for again."""

    trigger_characters: list[str] | None = None
    retrigger_characters: list[str] | None = None


class CodeActionOptions(Structure):
    """Kinds of code actions that there are."""

    code_action_kinds: list[Literal["quickfix"]] | None = None


class RenameOptions(Structure):
    """Whether the server can tell before whether something can be renamed."""

    prepare_provider: bool | None = None


class SemanticTokensLegend(Structure):
    """Names of the numbers in semantic tokens."""

    token_types: list[str]
    token_modifiers: list[str]


class SemanticTokensOptions(Structure):
    """Semantic tokens of whole documents."""

    legend: SemanticTokensLegend
    full: bool | None = None


class ServerCapabilities(Structure):
    """What the server can do."""

    position_encoding: Literal["utf-16"] | None = None
    text_document_sync: TextDocumentSyncOptions | None = None
    completion_provider: CompletionOptions | None = None
    hover_provider: bool | None = None
    signature_help_provider: SignatureHelpOptions | None = None
    definition_provider: bool | None = None
    type_definition_provider: bool | None = None
    implementation_provider: bool | None = None
    references_provider: bool | None = None
    document_highlight_provider: bool | None = None
    document_symbol_provider: bool | None = None
    workspace_symbol_provider: bool | None = None
    document_formatting_provider: bool | None = None
    code_action_provider: CodeActionOptions | None = None
    folding_range_provider: bool | None = None
    rename_provider: RenameOptions | None = None
    semantic_tokens_provider: SemanticTokensOptions | None = None


class ServerInfo(Structure):
    """Name and version of the server."""

    name: str
    version: str | None = None


class InitializeResult(Structure):
    """The answer to `initialize`."""

    capabilities: ServerCapabilities
    server_info: ServerInfo | None = None
