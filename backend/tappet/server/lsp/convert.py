"""From the results of the language services to the shapes of the protocol."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Final, Literal

from tappet.lang.diagnostic_translations import Texts, phrase, said
from tappet.lang.services.documents import Place, Position
from tappet.lang.services.formatting import Style
from tappet.lang.services.results import (
    CodeAction,
    Completion,
    Edit,
    Fold,
    Hover,
    ItemKind,
    Outline,
    Reference,
    Report,
    Signature,
)
from tappet.lang.services.semantic_tokens import TOKEN_MODIFIERS, TOKEN_TYPES, SemanticToken
from tappet.server.lsp.protocol import features as lsp
from tappet.server.lsp.protocol import product
from tappet.server.lsp.protocol.structures import (
    Diagnostic,
    DiagnosticRelatedInformation,
    DiagnosticSeverity,
    DiagnosticTag,
    Location,
    MarkupContent,
    Range,
    TextEdit,
    WorkspaceEdit,
)
from tappet.server.lsp.protocol.structures import Position as LspPosition
from tappet.server.lsp.shown import OtherTextError, ShownDocument
from tappet.server.lsp.utf16 import units
from tappet.translation.language import Language
from tappet.translation.library_comments import comment

LANGUAGE_ID: Final = "iec-st"
Shown = Callable[[str], ShownDocument]
"""A document as the client shows it."""

_COMPLETION_KINDS: Final = {
    ItemKind.PROGRAM: lsp.CompletionItemKind.MODULE,
    ItemKind.FUNCTION: lsp.CompletionItemKind.FUNCTION,
    ItemKind.FUNCTION_BLOCK: lsp.CompletionItemKind.CLASS,
    ItemKind.METHOD: lsp.CompletionItemKind.METHOD,
    ItemKind.ACTION: lsp.CompletionItemKind.METHOD,
    ItemKind.PROPERTY: lsp.CompletionItemKind.PROPERTY,
    ItemKind.INTERFACE: lsp.CompletionItemKind.INTERFACE,
    ItemKind.STRUCT: lsp.CompletionItemKind.STRUCT,
    ItemKind.UNION: lsp.CompletionItemKind.STRUCT,
    ItemKind.ENUM: lsp.CompletionItemKind.ENUM,
    ItemKind.ENUM_VALUE: lsp.CompletionItemKind.ENUM_MEMBER,
    ItemKind.TYPE: lsp.CompletionItemKind.TYPE_PARAMETER,
    ItemKind.VARIABLE: lsp.CompletionItemKind.VARIABLE,
    ItemKind.PARAMETER: lsp.CompletionItemKind.FIELD,
    ItemKind.CONSTANT: lsp.CompletionItemKind.CONSTANT,
    ItemKind.FIELD: lsp.CompletionItemKind.FIELD,
    ItemKind.GLOBAL_LIST: lsp.CompletionItemKind.MODULE,
    ItemKind.NAMESPACE: lsp.CompletionItemKind.MODULE,
    ItemKind.KEYWORD: lsp.CompletionItemKind.KEYWORD,
    ItemKind.OPERATOR: lsp.CompletionItemKind.FUNCTION,
    ItemKind.SNIPPET: lsp.CompletionItemKind.SNIPPET,
    ItemKind.ATTRIBUTE: lsp.CompletionItemKind.PROPERTY,
    ItemKind.LABEL: lsp.CompletionItemKind.REFERENCE,
    ItemKind.SECTION: lsp.CompletionItemKind.KEYWORD,
}
_SYMBOL_KINDS: Final = {
    ItemKind.PROGRAM: lsp.SymbolKind.MODULE,
    ItemKind.FUNCTION: lsp.SymbolKind.FUNCTION,
    ItemKind.FUNCTION_BLOCK: lsp.SymbolKind.CLASS,
    ItemKind.METHOD: lsp.SymbolKind.METHOD,
    ItemKind.ACTION: lsp.SymbolKind.METHOD,
    ItemKind.PROPERTY: lsp.SymbolKind.PROPERTY,
    ItemKind.INTERFACE: lsp.SymbolKind.INTERFACE,
    ItemKind.STRUCT: lsp.SymbolKind.STRUCT,
    ItemKind.UNION: lsp.SymbolKind.STRUCT,
    ItemKind.ENUM: lsp.SymbolKind.ENUM,
    ItemKind.ENUM_VALUE: lsp.SymbolKind.ENUM_MEMBER,
    ItemKind.TYPE: lsp.SymbolKind.TYPE_PARAMETER,
    ItemKind.CONSTANT: lsp.SymbolKind.CONSTANT,
    ItemKind.FIELD: lsp.SymbolKind.FIELD,
    ItemKind.GLOBAL_LIST: lsp.SymbolKind.NAMESPACE,
    ItemKind.SECTION: lsp.SymbolKind.NAMESPACE,
    ItemKind.LABEL: lsp.SymbolKind.KEY,
}
_SEVERITIES: Final = {
    "error": DiagnosticSeverity.ERROR,
    "warning": DiagnosticSeverity.WARNING,
    "info": DiagnosticSeverity.INFORMATION,
}
_TAGS: Final = {
    "W1102": DiagnosticTag.UNNECESSARY,  # unreachable
    "W1103": DiagnosticTag.UNNECESSARY,  # unused variable
    "W1115": DiagnosticTag.UNNECESSARY,  # unused label
    "W1203": DiagnosticTag.DEPRECATED,  # obsolete
}
_FOLD_KINDS: Final[dict[str, Literal["comment", "region"]]] = {
    "comment": "comment",
    "region": "region",
}


def location(place: Place, shown: Shown) -> Location | None:
    """A place in some document; None for one that the client does not show."""
    document = shown(place.document)
    found = document.range(place.span)
    return None if found is None else Location(document.spelled, found)


def completion_list(
    items: Sequence[Completion], line: str, position: Position, language: Language = "en"
) -> lsp.CompletionList:
    """Proposals at a position; `line` is the text of its line. Comments of libraries are in the language."""
    word = position.column
    while word > 0 and (line[word - 1].isalnum() or line[word - 1] == "_"):
        word -= 1
    return lsp.CompletionList(
        is_incomplete=False,
        items=[
            _completion(item, number, line, position, word, language) for number, item in enumerate(items)
        ],
    )


def _completion(
    item: Completion, number: int, line: str, position: Position, word: int, language: Language
) -> lsp.CompletionItem:
    text = item.insert if item.insert is not None else item.label
    start = units(line, max(word - item.over, 0))
    edit = TextEdit(
        Range(LspPosition(position.line, start), LspPosition(position.line, units(line, position.column))),
        text,
    )
    name = item.label.split(" ")[0] if item.kind is ItemKind.PARAMETER else item.label
    return lsp.CompletionItem(
        label=item.label,
        kind=_COMPLETION_KINDS.get(item.kind, lsp.CompletionItemKind.TEXT),
        detail=item.detail or None,
        documentation=_documentation(item.comment, item.library, language),
        sort_text=f"{item.rank}{number:05}",
        filter_text=line[max(word - item.over, 0) : word] + name if item.over else name,
        insert_text_format=lsp.InsertTextFormat.SNIPPET if item.snippet else None,
        tags=[lsp.CompletionItemTag.DEPRECATED] if item.deprecated else None,
        text_edit=edit,
    )


def _documentation(text: str, library: str, language: Language) -> MarkupContent | None:
    """A comment; one of a library in the language, where there are words for it."""
    if library:
        text = comment(text, library, language)
    return MarkupContent("markdown", escaped(text)) if text else None


def escaped(text: str) -> str:
    """Plain words as Markdown that shows them, each line a line."""
    marked = "".join(f"\\{char}" if char in "\\`*_{}[]<>#+-!|" else char for char in text)
    return marked.replace("\n", "  \n")


def hover(found: Hover, shown: ShownDocument) -> lsp.Hover:
    """An explanation."""
    parts = [f"```{LANGUAGE_ID}\n{found.code}\n```"]
    if found.text:
        parts.append("\n\n".join(_prose(piece) for piece in found.text.split("\n\n")))
    content = MarkupContent("markdown", "\n\n".join(parts))
    return lsp.Hover(content, shown.range(found.span))


def _prose(piece: str) -> str:
    """A paragraph of a hover: values in backquotes stay code, the rest is plain text."""
    return "`".join(part if index % 2 else escaped(part) for index, part in enumerate(piece.split("`")))


def signature_help(found: Signature, language: Language = "en") -> lsp.SignatureHelp:
    """The call being written; comments of libraries are in the language."""
    parameters = [
        lsp.ParameterInformation(
            (units(found.label, item.start), units(found.label, item.end)),
            _documentation(item.comment, item.library, language),
        )
        for item in found.parameters
    ]
    documentation = _documentation(found.comment, found.library, language)
    information = lsp.SignatureInformation(found.label, parameters, found.active, documentation)
    return lsp.SignatureHelp([information], 0, found.active)


def document_symbols(entries: Iterable[Outline], shown: ShownDocument) -> list[lsp.DocumentSymbol]:
    """The outline of a document."""
    found = []
    for entry in entries:
        children = document_symbols(entry.children, shown)
        whole, name = shown.range(entry.span), shown.range(entry.name_span)
        if whole is None or name is None:
            found += children
            continue
        kind = _SYMBOL_KINDS.get(entry.kind, lsp.SymbolKind.VARIABLE)
        found.append(
            lsp.DocumentSymbol(entry.name, kind, whole, name, entry.detail or None, children=children or None)
        )
    return found


def highlights(found: Iterable[Reference], shown: ShownDocument) -> list[lsp.DocumentHighlight]:
    """The places of a name in its document."""
    write, read = lsp.DocumentHighlightKind.WRITE, lsp.DocumentHighlightKind.READ
    places = ((shown.range(item.place.span), item.role) for item in found)
    return [
        lsp.DocumentHighlight(place, write if role in ("write", "declaration") else read)
        for place, role in places
        if place is not None
    ]


def text_edits(edits: Iterable[Edit], shown: Shown) -> dict[str, list[TextEdit]]:
    """Edits by document. Raises OtherTextError for one in lines that the client does not show."""
    found: dict[str, list[TextEdit]] = {}
    for edit in edits:
        document = shown(edit.place.document)
        place = document.range(edit.place.span)
        if place is None:
            raise OtherTextError(
                f"Somebody else is writing in '{document.spelled}', in lines that this concerns; "
                "try again when they are saved"
            )
        found.setdefault(document.spelled, []).append(TextEdit(place, edit.text))
    return found


def code_action(item: CodeAction, document: str, shown: Shown, language: Language) -> lsp.CodeAction:
    """Something that mends a message. What is more than an edit stands in `data`, for the client to do.

    Raises OtherTextError for an edit in lines that the client does not show.
    """
    reported = diagnostics([item.report], document, shown, False, language)
    changes = text_edits(item.edits, shown)
    members = [product.Member(m.kind, m.name, m.declaration, list(m.accessors)) for m in item.members]
    return lsp.CodeAction(
        title=item.title,
        kind="quickfix",
        diagnostics=reported,
        is_preferred=item.preferred or None,
        edit=WorkspaceEdit(changes) if changes else None,
        data=product.CodeActionData(
            key=item.key,
            values=dict(item.values),
            declare=product.Declaration(item.declare, item.type) if item.declare else None,
            library=item.library or None,
            members=product.Members(shown(item.owner).spelled, members) if members else None,
        ),
    )


def style(settings: object) -> Style:
    """How texts are formatted, from the settings of a client; what is missing or wrong is as usual."""
    found = settings
    for name in ("tappet", "format"):
        found = found.get(name) if isinstance(found, Mapping) else None
    chosen = found if isinstance(found, Mapping) else {}
    usual = Style()
    keywords = chosen.get("keywords")
    operators, commas = chosen.get("operators"), chosen.get("commas")
    return Style(
        keywords=keywords if keywords in ("upper", "lower", "keep") else usual.keywords,
        operators=operators if isinstance(operators, bool) else usual.operators,
        commas=commas if isinstance(commas, bool) else usual.commas,
    )


def semantic_tokens(tokens: Sequence[SemanticToken], shown: ShownDocument) -> lsp.SemanticTokens:
    """Tokens as the protocol packs them: five numbers each, relative to the one before."""
    data: list[int] = []
    last_line = last_start = 0
    for token in tokens:
        number = shown.shown_line(token.line)
        if number is None:
            continue
        text = shown.line(token.line)
        start = units(text, token.column)
        length = units(text, token.column + token.length) - start
        if length <= 0:
            continue
        modifiers = sum(1 << TOKEN_MODIFIERS.index(name) for name in token.modifiers)
        step = number - last_line
        data += (
            step,
            start - last_start if step == 0 else start,
            length,
            TOKEN_TYPES.index(token.type),
            modifiers,
        )
        last_line, last_start = number, start
    return lsp.SemanticTokens(data)


def folding_ranges(found: Iterable[Fold], shown: ShownDocument) -> list[lsp.FoldingRange]:
    """Lines that can be folded."""
    moved = ((shown.shown_line(fold.start), shown.shown_line(fold.end), fold.kind) for fold in found)
    return [
        lsp.FoldingRange(start, end, kind=_FOLD_KINDS.get(kind))
        for start, end, kind in moved
        if start is not None and end is not None
    ]


def diagnostics(
    reports: Iterable[Report], document: str, shown: Shown, advise: bool, language: Language = "en"
) -> list[Diagnostic]:
    """The messages of a document, those in lines that the client does not show left out; with `advise` the
    advice is in the text, for clients that show no data."""
    here = shown(document)
    found = []
    for report in reports:
        place = here.range(report.span)
        if place is None:
            continue
        message, advice = said(report.code, Texts(report.message, report.advice), report.facts, language)
        if advise and advice:
            message = f"{message}. {advice}"
        tag = _TAGS.get(report.code)
        related = [
            DiagnosticRelatedInformation(found_at, phrase(item.message, language))
            for item in report.related
            if (found_at := location(item.place, shown)) is not None
        ]
        found.append(
            Diagnostic(
                range=place,
                message=message,
                severity=_SEVERITIES[report.severity],
                code=report.code,
                source="tappet",
                tags=[tag] if tag is not None else None,
                related_information=related or None,
                data=product.DiagnosticData(advice, dict(report.facts), report.element),
            )
        )
    return found
