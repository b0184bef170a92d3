"""What an editor asks, one function a request: from positions to places, through the language services."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import asdict, replace
from typing import Any, Final

from lsprotocol import types as lsp

from tappet.lang.services import (
    code_actions,
    cross_references,
    folding,
    monitoring,
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
from tappet.server.lsp.client import Client
from tappet.server.lsp.positions import lines_of, to_position, to_range
from tappet.server.lsp.shown import OtherTextError

MAX_LINE: Final = 10_000
"""Characters of a line that may be short for a declaration."""
MAX_NAME: Final = 500
MAX_SYMBOLS: Final = 500
MAX_TRIAL: Final = 1_000_000
"""Characters of a text that is being tried."""
MAX_OPERANDS: Final = 2000
_MEMBERS: Final = frozenset(["variable", "field", "constant", "enum_value"])
"""What a search for nothing leaves out."""


def completion(session: Client, params: lsp.CompletionParams) -> lsp.CompletionList:
    """What can be written here."""
    uri, position = session.at(params)
    found = completions.complete(session.workspace, uri, position)
    shown = session.shown(uri)
    return convert.completion_list(found, shown.line(position.line), shown.own_position(params.position))


def completion_in(session: Client, params: Any) -> lsp.CompletionList:
    """What can be written at a place of a text that is being tried: `{textDocument, position, text}`."""
    identifier, at = _place(params)
    text = params.get("text")
    if not isinstance(text, str) or len(text) > MAX_TRIAL:
        raise ServiceError(f"'text' is the whole text of the document, at most {MAX_TRIAL} characters")
    lines = lines_of(text)
    position = to_position(lines, at)
    view = session.workspace.trial_view(session.canonical(identifier.uri), position, text)
    return convert.completion_list(completions.proposals(view), lines(position.line), position)


def operand_facts(session: Client, params: Any) -> list[dict[str, str] | None]:
    """What is declared for operands of a body: `{textDocument, operands}` to `{type, address, comment}` each.

    None for what names no variable.
    """
    identifier, _ = _place(
        params | {"position": {"line": 0, "character": 0}} if isinstance(params, dict) else None
    )
    wanted = params.get("operands")
    if (
        not isinstance(wanted, list)
        or len(wanted) > MAX_OPERANDS
        or not all(_is_name(item) for item in wanted)
    ):
        raise ServiceError(f"'operands' are at most {MAX_OPERANDS} texts of at most {MAX_NAME} characters")
    uri = session.canonical(identifier.uri)
    view = session.snapshot(uri).view(uri, docs.Position(0, 0))
    return [None if found is None else asdict(found) for found in operands.facts(view, wanted)]


def element_variables(session: Client, params: Any) -> dict[str, list[str]]:
    """The expressions to monitor at the elements of a drawn body, by id: `{textDocument}`."""
    identifier, _ = _place(
        params | {"position": {"line": 0, "character": 0}} if isinstance(params, dict) else None
    )
    uri = session.canonical(identifier.uri)
    return monitoring.variables_of(session.snapshot(uri), uri)


def hover(session: Client, params: lsp.HoverParams) -> lsp.Hover | None:
    """What this is."""
    uri, position = session.at(params)
    found = hovers.hover(session.snapshot(uri), uri, position)
    return convert.hover(found, session.shown(uri)) if found is not None else None


def signature_help(session: Client, params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
    """The parameters of the call."""
    uri, position = session.at(params)
    found = signatures.signature(session.workspace, uri, position)
    return convert.signature_help(found) if found is not None else None


def definition(session: Client, params: lsp.DefinitionParams) -> lsp.Location | None:
    """Where this is declared."""
    uri, position = session.at(params)
    found = navigation.definition(session.snapshot(uri), uri, position)
    return session.location(found) if found is not None else None


def type_definition(session: Client, params: lsp.TypeDefinitionParams) -> lsp.Location | None:
    """Where the type of this is declared."""
    uri, position = session.at(params)
    found = navigation.type_definition(session.snapshot(uri), uri, position)
    return session.location(found) if found is not None else None


def implementation(session: Client, params: lsp.ImplementationParams) -> list[lsp.Location]:
    """What implements or replaces this."""
    uri, position = session.at(params)
    return session.locations(navigation.implementations(session.snapshot(uri), uri, position))


def references(session: Client, params: lsp.ReferenceParams) -> list[lsp.Location]:
    """Where this is used, in every program that shows the document."""
    uri, position = session.at(params)
    places: dict[docs.Place, None] = {}
    for snapshot in session.workspace.snapshots():
        if snapshot.shows(uri):
            for item in navigation.references(snapshot, uri, position, params.context.include_declaration):
                places.setdefault(item.place)
    return session.locations(places)


def document_highlight(session: Client, params: lsp.DocumentHighlightParams) -> list[lsp.DocumentHighlight]:
    """Where this is used in the document."""
    uri, position = session.at(params)
    return convert.highlights(navigation.highlights(session.snapshot(uri), uri, position), session.shown(uri))


def document_symbol(session: Client, params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
    """The outline."""
    uri = session.canonical(params.text_document.uri)
    return convert.document_symbols(outline.outline(session.snapshot(uri), uri), session.shown(uri))


def workspace_symbol(session: Client, params: lsp.WorkspaceSymbolParams) -> list[lsp.SymbolInformation]:
    """Objects, their members and variables, types by a part of the name, best match first."""
    wanted = params.query.lower()
    found: dict[tuple[str, str], lsp.SymbolInformation] = {}

    def collect(text_name: str, document: str, entries: list[Outline], container: str | None) -> None:
        for entry in entries:
            if (
                wanted in entry.name.lower()
                and entry.kind != "section"
                and (wanted or entry.kind not in _MEMBERS)
            ):
                shown = session.shown(document)
                for symbol in convert.document_symbols([replace(entry, children=[])], shown):
                    place = lsp.Location(shown.spelled, symbol.selection_range)
                    found.setdefault(
                        (text_name, f"{container}.{entry.name}"),
                        lsp.SymbolInformation(place, entry.name, symbol.kind, container_name=container),
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
        return (0 if name == wanted else 1 if name.startswith(wanted) else 2, name)

    return sorted(found.values(), key=distance)[:MAX_SYMBOLS]


def formatting(session: Client, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    """The edits that format a document."""
    uri = session.canonical(params.text_document.uri)
    text = session.text(uri)
    if text is None:
        raise ServiceError(f"'{params.text_document.uri}' is not open")
    options = params.options
    indent = " " * min(options.tab_size, 16) if options.insert_spaces else "\t"
    lines = lines_of(text)
    edits = formatting_service.formatting(uri, text, replace(session.style, indent=indent))
    return [lsp.TextEdit(to_range(lines, edit.place.span), edit.text) for edit in edits]


def folding_range(session: Client, params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
    """What can be folded."""
    uri = session.canonical(params.text_document.uri)
    return convert.folding_ranges(folding.folds(session.snapshot(uri), uri), session.shown(uri))


def prepare_rename(session: Client, params: lsp.PrepareRenameParams) -> lsp.PrepareRenamePlaceholder:
    """The name that would be renamed; refused with the reason when it cannot be."""
    uri, position = session.at(params)
    span = renaming.renameable(session.snapshot(uri), uri, position)
    shown = session.shown(uri)
    place = shown.range(span)
    if place is None:
        raise OtherTextError(f"Somebody else is writing in '{shown.spelled}'; try again when it is saved")
    return lsp.PrepareRenamePlaceholder(place, shown.line(span.line)[span.column : span.end_column])


def rename(session: Client, params: lsp.RenameParams) -> lsp.WorkspaceEdit:
    """The edits that rename something in every program that shows the document."""
    uri, position = session.at(params)
    edits = {}
    for snapshot in session.workspace.snapshots():
        if snapshot.shows(uri):
            edits.update(
                {edit.place: edit for edit in renaming.rename(snapshot, uri, position, params.new_name)}
            )
    return lsp.WorkspaceEdit(convert.text_edits(edits.values(), session.shown))


def semantic_tokens(session: Client, params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
    """What each word is."""
    uri = session.canonical(params.text_document.uri)
    return convert.semantic_tokens(tokens.semantic_tokens(session.snapshot(uri), uri), session.shown(uri))


def read_document(session: Client, params: Any) -> dict[str, str]:
    """The text of a document, for one that is in no editor."""
    uri = params.get("uri") if isinstance(params, dict) else None
    text = session.text(session.canonical(uri)) if isinstance(uri, str) else None
    if text is None:
        raise ServiceError(f"There is no document '{uri}'")
    return {"uri": str(uri), "languageId": convert.LANGUAGE_ID, "text": text}


def expand_shorthand(session: Client, params: Any) -> dict[str, str | None]:
    """The declaration that a typed line denotes (DECL-61..DECL-66)."""
    line = params.get("line") if isinstance(params, dict) else None
    if not isinstance(line, str) or len(line) > MAX_LINE:
        raise ServiceError("'line' is the text of one line of a declaration editor")
    return {"line": shorthand.expand(line)}


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


def cross_reference_list(session: Client, params: Any) -> list[dict[str, Any]]:
    """Where something is declared and used, by `{textDocument, position}` or by `{name}`.

    Each place has `uri`, `range`, `access` (declaration, read, write, call, address), `symbol` and `text`.
    """
    name = params.get("name") if isinstance(params, dict) else None
    places: dict[docs.Place, CrossReference] = {}
    if isinstance(name, str):
        if len(name) > MAX_NAME:
            raise ServiceError(f"A name has at most {MAX_NAME} characters")
        for snapshot in session.workspace.snapshots():
            for item in cross_references.cross_references_of(snapshot, name):
                places.setdefault(item.place, item)
    else:
        try:
            uri, inside = session.at(lsp.DefinitionParams(*_place(params)))
        except ServiceError as error:
            raise ServiceError("Give 'name', or 'textDocument' and 'position'") from error
        for snapshot in session.workspace.snapshots():
            if snapshot.shows(uri):
                for item in cross_references.cross_references(snapshot, uri, inside):
                    places.setdefault(item.place, item)
    found = ((session.location(item.place), item) for item in places.values())
    return [
        {
            "uri": place.uri,
            "range": place.range,
            "access": item.role,
            "element": item.place.element,
            "symbol": item.symbol,
            "text": item.text,
        }
        for place, item in found
        if place is not None
    ]


def _place(params: Any) -> tuple[lsp.TextDocumentIdentifier, lsp.Position]:
    """Document and position of a request of our own."""
    try:
        return (
            lsp.TextDocumentIdentifier(str(params["textDocument"]["uri"])),
            lsp.Position(int(params["position"]["line"]), int(params["position"]["character"])),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ServiceError("Give 'textDocument' and 'position'") from error


def _is_name(item: object) -> bool:
    return isinstance(item, str) and len(item) <= MAX_NAME
