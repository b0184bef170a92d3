"""What an editor asks, one function a request: from positions to places, through the language services."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import Final

from tappet.lang.services import (
    code_actions,
    cross_references,
    folding,
    navigation,
    operands,
    outline,
    shorthand,
)
from tappet.lang.services import (
    completion as completions,
)
from tappet.lang.services import (
    documents as docs,
)
from tappet.lang.services import (
    formatting as formatting_service,
)
from tappet.lang.services import (
    hover as hovers,
)
from tappet.lang.services import (
    rename as renaming,
)
from tappet.lang.services import (
    semantic_tokens as tokens,
)
from tappet.lang.services import (
    signature_help as signatures,
)
from tappet.lang.services.results import CrossReference, Outline, ServiceError
from tappet.lang.source import Span
from tappet.server.lsp import convert
from tappet.server.lsp.client import Client, Methods
from tappet.server.lsp.positions import lines_of, to_position, to_range
from tappet.server.lsp.protocol import features as lsp
from tappet.server.lsp.protocol import product
from tappet.server.lsp.protocol.features import TextDocumentParams, TextDocumentPositionParams
from tappet.server.lsp.protocol.structures import Location, TextEdit, WorkspaceEdit
from tappet.server.lsp.shown import OtherTextError

MAX_SYMBOLS: Final = 500
_MEMBERS: Final = frozenset(["variable", "field", "constant", "enum_value", "label"])
"""What a search for nothing leaves out."""


def completion(session: Client, params: TextDocumentPositionParams) -> lsp.CompletionList:
    """What can be written here."""
    uri, position = session.at(params)
    found = completions.complete(session.workspace, uri, position)
    shown = session.shown(uri)
    return convert.completion_list(
        found, shown.line(position.line), shown.own_position(params.position), session.language
    )


def completion_in(session: Client, params: product.CompletionInParams) -> lsp.CompletionList:
    """What can be written at a place of a text that is being tried."""
    lines = lines_of(params.text)
    position = to_position(lines, params.position)
    view = session.workspace.trial_view(session.canonical(params.text_document.uri), position, params.text)
    return convert.completion_list(
        completions.proposals(view), lines(position.line), position, session.language
    )


def operand_facts(session: Client, params: product.OperandFactsParams) -> list[operands.OperandFacts | None]:
    """What is declared for operands of a body; None for what names no variable."""
    uri = session.canonical(params.text_document.uri)
    view = session.snapshot(uri).view(uri, docs.Position(0, 0))
    return list(operands.facts(view, params.operands))


def hover(session: Client, params: TextDocumentPositionParams) -> lsp.Hover | None:
    """What this is."""
    uri, position = session.at(params)
    found = hovers.hover(session.snapshot(uri), uri, position, session.language)
    return convert.hover(found, session.shown(uri)) if found is not None else None


def signature_help(session: Client, params: TextDocumentPositionParams) -> lsp.SignatureHelp | None:
    """The parameters of the call."""
    uri, position = session.at(params)
    found = signatures.signature(session.workspace, uri, position)
    return convert.signature_help(found, session.language) if found is not None else None


def definition(session: Client, params: TextDocumentPositionParams) -> Location | None:
    """Where this is declared."""
    uri, position = session.at(params)
    found = navigation.definition(session.snapshot(uri), uri, position)
    return session.location(found) if found is not None else None


def type_definition(session: Client, params: TextDocumentPositionParams) -> Location | None:
    """Where the type of this is declared."""
    uri, position = session.at(params)
    found = navigation.type_definition(session.snapshot(uri), uri, position)
    return session.location(found) if found is not None else None


def implementation(session: Client, params: TextDocumentPositionParams) -> list[Location]:
    """What implements or replaces this."""
    uri, position = session.at(params)
    return session.locations(navigation.implementations(session.snapshot(uri), uri, position))


def references(session: Client, params: lsp.ReferenceParams) -> list[Location]:
    """Where this is used, in every program that shows the document."""
    uri, position = session.at(params)
    places: dict[docs.Place, None] = {}
    for snapshot in session.workspace.snapshots():
        if snapshot.shows(uri):
            for item in navigation.references(snapshot, uri, position, params.context.include_declaration):
                places.setdefault(item.place)
    return session.locations(places)


def document_highlight(session: Client, params: TextDocumentPositionParams) -> list[lsp.DocumentHighlight]:
    """Where this is used in the document."""
    uri, position = session.at(params)
    return convert.highlights(navigation.highlights(session.snapshot(uri), uri, position), session.shown(uri))


def document_symbol(session: Client, params: TextDocumentParams) -> list[lsp.DocumentSymbol]:
    """The outline."""
    uri = session.canonical(params.text_document.uri)
    return convert.document_symbols(outline.outline(session.snapshot(uri), uri), session.shown(uri))


def _has_letters(name: str, wanted: str) -> bool:
    """Whether the letters stand in the name in their order, others between them."""
    letters = iter(name)
    return all(letter in letters for letter in wanted)


def workspace_symbol(session: Client, params: lsp.WorkspaceSymbolParams) -> list[lsp.SymbolInformation]:
    """Objects, members, variables, labels, types by letters of the name in their order, best match first."""
    wanted = params.query.lower()
    found: dict[tuple[str, str, str], lsp.SymbolInformation] = {}

    def collect(text_name: str, document: str, entries: list[Outline], container: str | None) -> None:
        for entry in entries:
            if (
                _has_letters(entry.name.lower(), wanted)
                and entry.kind != "section"
                and (wanted or entry.kind not in _MEMBERS)
            ):
                shown = session.shown(document)
                for symbol in convert.document_symbols([replace(entry, children=[])], shown):
                    place = Location(shown.spelled, symbol.selection_range)
                    found.setdefault(
                        (text_name, entry.kind, f"{container}.{entry.name}"),
                        lsp.SymbolInformation(entry.name, symbol.kind, place, container),
                    )
            collect(text_name, document, entry.children, container if entry.kind == "section" else entry.name)

    for snapshot in session.workspace.snapshots():
        for index, text in enumerate(snapshot.program.texts):
            if text.read_only:
                continue
            owner = text.source.owner
            for document in dict.fromkeys(segment.document for segment in text.segments):
                collect(text.source.uri, document, outline.outline_of(snapshot, index, document), owner)

    def distance(symbol: lsp.SymbolInformation) -> tuple[int, str]:
        name = symbol.name.lower()
        near = 0 if name == wanted else 1 if name.startswith(wanted) else 2 if wanted in name else 3
        return (near, name)

    return sorted(found.values(), key=distance)[:MAX_SYMBOLS]


def formatting(session: Client, params: lsp.DocumentFormattingParams) -> list[TextEdit]:
    """The edits that format a document."""
    uri = session.canonical(params.text_document.uri)
    text = session.text(uri)
    if text is None:
        raise ServiceError(f"'{params.text_document.uri}' is not open")
    options = params.options
    indent = " " * min(options.tab_size, 16) if options.insert_spaces else "\t"
    lines = lines_of(text)
    edits = formatting_service.formatting(uri, text, replace(session.style, indent=indent))
    return [TextEdit(to_range(lines, edit.place.span), edit.text) for edit in edits]


def folding_range(session: Client, params: TextDocumentParams) -> list[lsp.FoldingRange]:
    """What can be folded."""
    uri = session.canonical(params.text_document.uri)
    return convert.folding_ranges(folding.folds(session.snapshot(uri), uri), session.shown(uri))


def prepare_rename(session: Client, params: TextDocumentPositionParams) -> lsp.PrepareRenamePlaceholder:
    """The name that would be renamed; refused with the reason when it cannot be."""
    uri, position = session.at(params)
    span = renaming.renameable(session.snapshot(uri), uri, position)
    shown = session.shown(uri)
    place = shown.range(span)
    if place is None:
        raise OtherTextError(f"Somebody else is writing in '{shown.spelled}'; try again when it is saved")
    return lsp.PrepareRenamePlaceholder(place, shown.line(span.line)[span.column : span.end_column])


def rename(session: Client, params: lsp.RenameParams) -> WorkspaceEdit:
    """The edits that rename something in every program that shows the document."""
    uri, position = session.at(params)
    edits = {}
    for snapshot in session.workspace.snapshots():
        if snapshot.shows(uri):
            edits.update(
                {edit.place: edit for edit in renaming.rename(snapshot, uri, position, params.new_name)}
            )
    return WorkspaceEdit(convert.text_edits(edits.values(), session.shown))


def semantic_tokens(session: Client, params: TextDocumentParams) -> lsp.SemanticTokens:
    """What each word is."""
    uri = session.canonical(params.text_document.uri)
    return convert.semantic_tokens(tokens.semantic_tokens(session.snapshot(uri), uri), session.shown(uri))


def read_document(session: Client, params: product.ReadDocumentParams) -> product.DocumentText:
    """The text of a document, for one that is in no editor."""
    text = session.text(session.canonical(params.uri))
    if text is None:
        raise ServiceError(f"There is no document '{params.uri}'")
    return product.DocumentText(params.uri, convert.LANGUAGE_ID, text)


def expand_shorthand(session: Client, params: product.ShorthandParams) -> dict[str, str | None]:
    """The declaration that a typed line denotes (DECL-61..DECL-66), null for one that denotes none."""
    return {"line": shorthand.expand(params.line)}


def code_action(session: Client, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    """What mends the messages of a range."""
    uri = session.canonical(params.text_document.uri)
    shown = session.shown(uri)
    begin, end = shown.position(params.range.start), shown.position(params.range.end)
    actions = code_actions.code_actions(session.snapshot(uri), uri, Span(*begin, *end), session.offering)
    found = []
    for action in actions:
        with suppress(OtherTextError):
            found.append(convert.code_action(action, uri, session.shown, session.language))
    return [item for item in found if session.asks or item.edit is not None]


def cross_reference_list(
    session: Client, params: product.CrossReferencesParams
) -> list[product.FoundReference]:
    """Where something is declared and used."""
    places: dict[docs.Place, CrossReference] = {}
    if params.name is not None:
        for snapshot in session.workspace.snapshots():
            for item in cross_references.cross_references_of(snapshot, params.name):
                places.setdefault(item.place, item)
    elif params.text_document is None or params.position is None:
        raise ServiceError("Give 'name', or 'textDocument' and 'position'")
    else:
        uri, inside = session.at(TextDocumentPositionParams(params.text_document, params.position))
        for snapshot in session.workspace.snapshots():
            if snapshot.shows(uri):
                for item in cross_references.cross_references(snapshot, uri, inside):
                    places.setdefault(item.place, item)
    found = ((session.location(item.place), item) for item in places.values())
    return [
        product.FoundReference(place.uri, place.range, item.role, item.place.element, item.symbol, item.text)
        for place, item in found
        if place is not None
    ]


QUESTIONS: Final[Methods] = {
    "textDocument/completion": (TextDocumentPositionParams, completion),
    "textDocument/hover": (TextDocumentPositionParams, hover),
    "textDocument/signatureHelp": (TextDocumentPositionParams, signature_help),
    "textDocument/definition": (TextDocumentPositionParams, definition),
    "textDocument/typeDefinition": (TextDocumentPositionParams, type_definition),
    "textDocument/implementation": (TextDocumentPositionParams, implementation),
    "textDocument/references": (lsp.ReferenceParams, references),
    "textDocument/documentHighlight": (TextDocumentPositionParams, document_highlight),
    "textDocument/documentSymbol": (TextDocumentParams, document_symbol),
    "textDocument/codeAction": (lsp.CodeActionParams, code_action),
    "textDocument/formatting": (lsp.DocumentFormattingParams, formatting),
    "textDocument/foldingRange": (TextDocumentParams, folding_range),
    "textDocument/prepareRename": (TextDocumentPositionParams, prepare_rename),
    "textDocument/rename": (lsp.RenameParams, rename),
    "textDocument/semanticTokens/full": (TextDocumentParams, semantic_tokens),
    "workspace/symbol": (lsp.WorkspaceSymbolParams, workspace_symbol),
    "tappet/document": (product.ReadDocumentParams, read_document),
    "tappet/shorthand": (product.ShorthandParams, expand_shorthand),
    "tappet/completionIn": (product.CompletionInParams, completion_in),
    "tappet/crossReferences": (product.CrossReferencesParams, cross_reference_list),
    "tappet/operandFacts": (product.OperandFactsParams, operand_facts),
}
"""What editors ask, and the requests of our own front end (`tappet/...`)."""
