"""Colours that need understanding: what each name is."""

from __future__ import annotations

from typing import Final, NamedTuple

from tappet.lang import types as t
from tappet.lang.lexer import ADDRESS, END, ID, INT, NUMBER, PRAGMA, STRING
from tappet.lang.services import describe
from tappet.lang.services.documents import Position
from tappet.lang.services.instruction_list import bodies, is_operator
from tappet.lang.services.occurrences import Occurrence, occurrences
from tappet.lang.services.operators import head_of
from tappet.lang.services.results import ItemKind
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import Span, split_lines
from tappet.lang.types import ELEMENTARY

TOKEN_TYPES: Final = (
    "namespace", "type", "class", "enum", "interface", "struct", "parameter", "variable", "property",
    "enumMember", "function", "method", "macro", "keyword", "comment", "string", "number", "operator",
    "label",
)  # fmt: skip
"""Names of the Language Server Protocol, in the order that their numbers have."""
TOKEN_MODIFIERS: Final = ("declaration", "readonly", "static", "defaultLibrary", "modification", "inactive")

_BY_KIND: Final = {
    ItemKind.PROGRAM: "namespace",
    ItemKind.FUNCTION: "function",
    ItemKind.FUNCTION_BLOCK: "class",
    ItemKind.METHOD: "method",
    ItemKind.ACTION: "method",
    ItemKind.PROPERTY: "property",
    ItemKind.INTERFACE: "interface",
    ItemKind.STRUCT: "struct",
    ItemKind.UNION: "struct",
    ItemKind.ENUM: "enum",
    ItemKind.ENUM_VALUE: "enumMember",
    ItemKind.TYPE: "type",
    ItemKind.VARIABLE: "variable",
    ItemKind.PARAMETER: "parameter",
    ItemKind.CONSTANT: "variable",
    ItemKind.GLOBAL_LIST: "namespace",
    ItemKind.NAMESPACE: "namespace",
    ItemKind.OPERATOR: "function",
}


class SemanticToken(NamedTuple):
    """One coloured piece of a line of a document."""

    line: int
    column: int
    length: int
    type: str
    modifiers: frozenset[str]


_PLAIN: frozenset[str] = frozenset()


def semantic_tokens(snapshot: Snapshot, document: str) -> list[SemanticToken]:
    """All tokens of a document in order."""
    view = snapshot.view(document, Position(0, 0))
    lines = view.text.lines_of(document)
    assert lines is not None
    first, behind = lines
    names = {
        (item.span.line, item.span.column): item
        for item in occurrences(snapshot, view.index)
        if first <= item.span.line < behind
    }
    inactive = view.result.inactive
    rows = {line for begin, end, _ in bodies(view.unit) for line in range(begin, end)}
    lexed = view.lexed
    found: list[tuple[Span, str, frozenset[str]]] = []
    for index, kind in enumerate(lexed.kinds):
        for trivia in lexed.trivia.get(index, ()):
            if first <= trivia.span.line < behind:
                type_ = "macro" if trivia.kind is PRAGMA else "comment"
                found += [(span, type_, _PLAIN) for span in _by_line(trivia.span, trivia.text)]
        line = lexed.lines[index]
        if kind is END or not first <= line < behind:
            continue
        column, text = lexed.columns[index], lexed.texts[index]
        span = Span(line, column, line, column + len(text))
        if any(part[:2] <= span[:2] < part[2:] for part in inactive):
            found.append((span, "comment", frozenset({"inactive"})))
            continue
        if line in rows and is_operator(lexed, index):
            found.append((span, "keyword", _PLAIN))
            continue
        type_, modifiers = _classify(kind, text, names.get((line, column)))
        if type_:
            found += [(part, type_, modifiers) for part in _by_line(span, text)]
    shift = view.text.place(Span(first, 0, first, 0)).span.line - first
    tokens = [
        SemanticToken(span.line + shift, span.column, span.end_column - span.column, type_, modifiers)
        for span, type_, modifiers in found
        if span.end_column > span.column
    ]
    tokens.sort(key=lambda item: (item.line, item.column))
    return tokens


def _by_line(span: Span, text: str) -> list[Span]:
    """A comment or string over several lines in pieces of one line."""
    pieces = split_lines(text)
    found = []
    for number, piece in enumerate(pieces):
        column = span.column if number == 0 else 0
        found.append(Span(span.line + number, column, span.line + number, column + len(piece)))
    return found


def _classify(kind: str, text: str, name: Occurrence | None) -> tuple[str, frozenset[str]]:
    if name is not None:
        return _name(name)
    if kind is ID:
        upper = text.upper()
        if upper in ELEMENTARY or upper in ("STRING", "WSTRING"):
            return "type", frozenset({"defaultLibrary"})
        if head_of(text) is not None:
            return "function", frozenset({"defaultLibrary"})
        return "variable", _PLAIN
    if kind is STRING:
        return "string", _PLAIN
    if kind is INT or kind is NUMBER:
        return "number", _PLAIN
    if kind is ADDRESS:
        return "variable", frozenset({"static"})
    if text[:1].isalpha() or text[:2] == "__":
        return "keyword", _PLAIN
    if kind in (";", ",", "(", ")", "[", "]", ".", ":"):
        return "", _PLAIN
    return "operator", _PLAIN


def _name(name: Occurrence) -> tuple[str, frozenset[str]]:
    modifiers: set[str] = set()
    if name.role == "declaration":
        modifiers.add("declaration")
    elif name.role == "write":
        modifiers.add("modification")
    symbol = name.symbol
    if symbol is None:
        if "#" in name.key.uri:
            return "label", frozenset(modifiers)
        return _type_kind(name.type), frozenset(modifiers)
    kind = describe.kind_of(symbol)
    if kind in (ItemKind.CONSTANT, ItemKind.ENUM_VALUE):
        modifiers.add("readonly")
    if symbol.source is not None and symbol.source.library is not None:
        modifiers.add("defaultLibrary")
    if kind is ItemKind.VARIABLE and getattr(symbol, "section", "") == "VAR_GLOBAL":
        modifiers.add("static")
    return _BY_KIND.get(kind, "variable"), frozenset(modifiers)


def _type_kind(type_: t.Type | None) -> str:
    if isinstance(type_, t.Enum):
        return "enum"
    if isinstance(type_, t.Struct):
        return "struct"
    if isinstance(type_, t.FunctionBlock):
        return "class"
    return "interface" if isinstance(type_, t.Interface) else "type"
