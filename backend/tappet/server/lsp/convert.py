"""From the results of the language services to the shapes of the protocol."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Final

from lsprotocol import types as lsp

from tappet.lang.diagnostic_translations import Language, Texts, phrase, said
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
from tappet.server.lsp.positions import Line, to_range, units

LANGUAGE_ID: Final = "iec-st"
Lines = Callable[[str], Line]
"""The lines of a document."""

_COMPLETION_KINDS: Final = {
    ItemKind.PROGRAM: lsp.CompletionItemKind.Module,
    ItemKind.FUNCTION: lsp.CompletionItemKind.Function,
    ItemKind.FUNCTION_BLOCK: lsp.CompletionItemKind.Class,
    ItemKind.METHOD: lsp.CompletionItemKind.Method,
    ItemKind.ACTION: lsp.CompletionItemKind.Method,
    ItemKind.PROPERTY: lsp.CompletionItemKind.Property,
    ItemKind.INTERFACE: lsp.CompletionItemKind.Interface,
    ItemKind.STRUCT: lsp.CompletionItemKind.Struct,
    ItemKind.UNION: lsp.CompletionItemKind.Struct,
    ItemKind.ENUM: lsp.CompletionItemKind.Enum,
    ItemKind.ENUM_VALUE: lsp.CompletionItemKind.EnumMember,
    ItemKind.TYPE: lsp.CompletionItemKind.TypeParameter,
    ItemKind.VARIABLE: lsp.CompletionItemKind.Variable,
    ItemKind.PARAMETER: lsp.CompletionItemKind.Field,
    ItemKind.CONSTANT: lsp.CompletionItemKind.Constant,
    ItemKind.FIELD: lsp.CompletionItemKind.Field,
    ItemKind.GLOBAL_LIST: lsp.CompletionItemKind.Module,
    ItemKind.NAMESPACE: lsp.CompletionItemKind.Module,
    ItemKind.KEYWORD: lsp.CompletionItemKind.Keyword,
    ItemKind.OPERATOR: lsp.CompletionItemKind.Function,
    ItemKind.SNIPPET: lsp.CompletionItemKind.Snippet,
    ItemKind.ATTRIBUTE: lsp.CompletionItemKind.Property,
    ItemKind.LABEL: lsp.CompletionItemKind.Reference,
    ItemKind.SECTION: lsp.CompletionItemKind.Keyword,
}
_SYMBOL_KINDS: Final = {
    ItemKind.PROGRAM: lsp.SymbolKind.Module,
    ItemKind.FUNCTION: lsp.SymbolKind.Function,
    ItemKind.FUNCTION_BLOCK: lsp.SymbolKind.Class,
    ItemKind.METHOD: lsp.SymbolKind.Method,
    ItemKind.ACTION: lsp.SymbolKind.Method,
    ItemKind.PROPERTY: lsp.SymbolKind.Property,
    ItemKind.INTERFACE: lsp.SymbolKind.Interface,
    ItemKind.STRUCT: lsp.SymbolKind.Struct,
    ItemKind.UNION: lsp.SymbolKind.Struct,
    ItemKind.ENUM: lsp.SymbolKind.Enum,
    ItemKind.ENUM_VALUE: lsp.SymbolKind.EnumMember,
    ItemKind.TYPE: lsp.SymbolKind.TypeParameter,
    ItemKind.CONSTANT: lsp.SymbolKind.Constant,
    ItemKind.FIELD: lsp.SymbolKind.Field,
    ItemKind.GLOBAL_LIST: lsp.SymbolKind.Namespace,
    ItemKind.SECTION: lsp.SymbolKind.Namespace,
}
_SEVERITIES: Final = {
    "error": lsp.DiagnosticSeverity.Error,
    "warning": lsp.DiagnosticSeverity.Warning,
    "info": lsp.DiagnosticSeverity.Information,
}
_TAGS: Final = {
    "W1102": lsp.DiagnosticTag.Unnecessary,  # unreachable
    "W1103": lsp.DiagnosticTag.Unnecessary,  # unused variable
    "W1115": lsp.DiagnosticTag.Unnecessary,  # unused label
    "W1203": lsp.DiagnosticTag.Deprecated,  # obsolete
}
_FOLD_KINDS: Final = {
    "comment": lsp.FoldingRangeKind.Comment,
    "region": lsp.FoldingRangeKind.Region,
}


def location(place: Place, lines: Lines) -> lsp.Location:
    """A place in some document."""
    return lsp.Location(place.document, to_range(lines(place.document), place.span))


def completion_list(items: Sequence[Completion], line: str, position: Position) -> lsp.CompletionList:
    """Proposals at a position; `line` is the text of its line."""
    word = position.column
    while word > 0 and (line[word - 1].isalnum() or line[word - 1] == "_"):
        word -= 1
    return lsp.CompletionList(
        is_incomplete=False,
        items=[_completion(item, number, line, position, word) for number, item in enumerate(items)],
    )


def _completion(
    item: Completion, number: int, line: str, position: Position, word: int
) -> lsp.CompletionItem:
    text = item.insert if item.insert is not None else item.label
    start = units(line, max(word - item.over, 0))
    edit = lsp.TextEdit(
        lsp.Range(
            lsp.Position(position.line, start), lsp.Position(position.line, units(line, position.column))
        ),
        text,
    )
    name = item.label.split(" ")[0] if item.kind is ItemKind.PARAMETER else item.label
    return lsp.CompletionItem(
        label=item.label,
        kind=_COMPLETION_KINDS.get(item.kind, lsp.CompletionItemKind.Text),
        detail=item.detail or None,
        documentation=lsp.MarkupContent(lsp.MarkupKind.Markdown, escaped(item.comment))
        if item.comment
        else None,
        sort_text=f"{item.rank}{number:05}",
        filter_text=line[max(word - item.over, 0) : word] + name if item.over else name,
        insert_text_format=lsp.InsertTextFormat.Snippet if item.snippet else None,
        tags=[lsp.CompletionItemTag.Deprecated] if item.deprecated else None,
        text_edit=edit,
    )


def escaped(text: str) -> str:
    """Plain words as Markdown that shows them, each line a line."""
    marked = "".join(f"\\{char}" if char in "\\`*_{}[]<>#+-!|" else char for char in text)
    return marked.replace("\n", "  \n")


def hover(found: Hover, line: Line) -> lsp.Hover:
    """An explanation."""
    parts = [f"```{LANGUAGE_ID}\n{found.code}\n```"]
    if found.text:
        parts.append("\n\n".join(_prose(piece) for piece in found.text.split("\n\n")))
    content = lsp.MarkupContent(lsp.MarkupKind.Markdown, "\n\n".join(parts))
    return lsp.Hover(content, to_range(line, found.span))


def _prose(piece: str) -> str:
    """A paragraph of a hover: values in backquotes stay code, the rest is plain text."""
    return "`".join(part if index % 2 else escaped(part) for index, part in enumerate(piece.split("`")))


def signature_help(found: Signature) -> lsp.SignatureHelp:
    """The call being written."""
    parameters = [
        lsp.ParameterInformation(
            (units(found.label, item.start), units(found.label, item.end)),
            lsp.MarkupContent(lsp.MarkupKind.Markdown, escaped(item.comment)) if item.comment else None,
        )
        for item in found.parameters
    ]
    comment = lsp.MarkupContent(lsp.MarkupKind.Markdown, escaped(found.comment)) if found.comment else None
    information = lsp.SignatureInformation(found.label, comment, parameters, found.active)
    return lsp.SignatureHelp([information], 0, found.active)


def document_symbols(entries: Iterable[Outline], line: Line) -> list[lsp.DocumentSymbol]:
    """The outline of a document."""
    return [
        lsp.DocumentSymbol(
            name=entry.name,
            kind=_SYMBOL_KINDS.get(entry.kind, lsp.SymbolKind.Variable),
            range=to_range(line, entry.span),
            selection_range=to_range(line, entry.name_span),
            detail=entry.detail or None,
            children=document_symbols(entry.children, line) or None,
        )
        for entry in entries
    ]


def highlights(found: Iterable[Reference], line: Line) -> list[lsp.DocumentHighlight]:
    """The places of a name in its document."""
    write, read = lsp.DocumentHighlightKind.Write, lsp.DocumentHighlightKind.Read
    return [
        lsp.DocumentHighlight(
            to_range(line, item.place.span), write if item.role in ("write", "declaration") else read
        )
        for item in found
    ]


def text_edits(edits: Iterable[Edit], lines: Lines) -> dict[str, list[lsp.TextEdit]]:
    """Edits by document."""
    found: dict[str, list[lsp.TextEdit]] = {}
    for edit in edits:
        document = edit.place.document
        change = lsp.TextEdit(to_range(lines(document), edit.place.span), edit.text)
        found.setdefault(document, []).append(change)
    return found


def code_action(
    item: CodeAction, document: str, lines: Lines, spelled: Callable[[str], str], language: Language
) -> lsp.CodeAction:
    """Something that mends a message. What is more than an edit stands in `data`, for the client to do."""
    (report,) = diagnostics([item.report], document, lines, False, language)
    changes = {spelled(uri): edits for uri, edits in text_edits(item.edits, lines).items()}
    members = [
        {"kind": m.kind, "name": m.name, "declaration": m.declaration, "accessors": list(m.accessors)}
        for m in item.members
    ]
    return lsp.CodeAction(
        title=item.title,
        kind=lsp.CodeActionKind.QuickFix,
        diagnostics=[report],
        is_preferred=item.preferred or None,
        edit=lsp.WorkspaceEdit(changes) if changes else None,
        data={
            "key": item.key,
            "values": dict(item.values),
            "declare": {"name": item.declare, "type": item.type} if item.declare else None,
            "library": item.library or None,
            "members": {"owner": spelled(item.owner), "items": members} if members else None,
        },
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


def semantic_tokens(tokens: Sequence[SemanticToken], line: Line) -> lsp.SemanticTokens:
    """Tokens as the protocol packs them: five numbers each, relative to the one before."""
    data: list[int] = []
    last_line = last_start = 0
    for token in tokens:
        text = line(token.line)
        start = units(text, token.column)
        length = units(text, token.column + token.length) - start
        if length <= 0:
            continue
        modifiers = sum(1 << TOKEN_MODIFIERS.index(name) for name in token.modifiers)
        step = token.line - last_line
        data += (
            step,
            start - last_start if step == 0 else start,
            length,
            TOKEN_TYPES.index(token.type),
            modifiers,
        )
        last_line, last_start = token.line, start
    return lsp.SemanticTokens(data)


def folding_ranges(found: Iterable[Fold]) -> list[lsp.FoldingRange]:
    """Lines that can be folded."""
    return [lsp.FoldingRange(fold.start, fold.end, kind=_FOLD_KINDS.get(fold.kind)) for fold in found]


def diagnostics(
    reports: Iterable[Report], document: str, lines: Lines, advise: bool, language: Language = "en"
) -> list[lsp.Diagnostic]:
    """The messages of a document; with `advise` the advice is in the text, for clients that show no data."""
    line = lines(document)
    found = []
    for report in reports:
        message, advice = said(report.code, Texts(report.message, report.advice), report.facts, language)
        if advise and advice:
            message = f"{message}. {advice}"
        tag = _TAGS.get(report.code)
        related = [
            lsp.DiagnosticRelatedInformation(location(item.place, lines), phrase(item.message, language))
            for item in report.related
        ]
        found.append(
            lsp.Diagnostic(
                range=to_range(line, report.span),
                message=message,
                severity=_SEVERITIES[report.severity],
                code=report.code,
                source="tappet",
                tags=[tag] if tag is not None else None,
                related_information=related or None,
                data={"advice": advice, "facts": dict(report.facts)},
            )
        )
    return found
