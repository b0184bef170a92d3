"""Where the tree of a text names something, and what."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

from tappet.lang import ast, symbols
from tappet.lang import types as t
from tappet.lang.analysis import Analysis
from tappet.lang.ast.fields import source_fields
from tappet.lang.parts import innermost
from tappet.lang.services.documents import Position
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import NOWHERE, Source, Span, split_lines

Role = Literal["declaration", "read", "write", "call", "address"]
"""How a place uses a name; `address`: ADR and REF=, through which it can be read and written."""
_ADDRESSING = frozenset({"ADR", "BITADR"})


class Key(NamedTuple):
    """Identity of something declared: the place of its name."""

    uri: str
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A name in a text. `symbol` is None for labels and for what only the type of a variable determines."""

    span: Span
    role: Role
    key: Key
    symbol: symbols.Symbol | None
    type: t.Type | None = None


def children(node: ast.Node) -> Iterator[ast.Node]:
    """The nodes directly below one."""
    for name in source_fields(type(node)):
        value = getattr(node, name)
        if isinstance(value, ast.Node):
            yield value
        elif isinstance(value, list):
            for item in value:
                if isinstance(item, ast.Node):
                    yield item
                elif isinstance(item, tuple):  # a branch of IF, a pair of bounds
                    for part in item:
                        if isinstance(part, ast.Node):
                            yield part
                        elif isinstance(part, list):
                            yield from (entry for entry in part if isinstance(entry, ast.Node))


def key_of(symbol: symbols.Symbol) -> Key | None:
    """Identity of a symbol; None for what no text declares."""
    if isinstance(symbol, symbols.EnumValueSymbol) and isinstance(symbol.type, t.Enum):
        decl = symbol.type.decl
        if decl is not None and decl.source is not None and isinstance(decl.type_ref, ast.EnumType):
            for value in decl.type_ref.values:
                if value.name.upper() == symbol.name.upper():
                    return Key(decl.source.uri, value.span.line, value.span.column)
    if symbol.source is None or symbol.span is None:
        return None
    return Key(symbol.source.uri, symbol.span.line, symbol.span.column)


def declared_type(type_: t.Type | None) -> tuple[Key, symbols.Symbol | None] | None:
    """Identity of the declaration of a named type."""
    if isinstance(type_, (t.Struct, t.Enum)):
        decl = type_.decl
        return _declaration_key(decl) if decl is not None else None
    if isinstance(type_, t.FunctionBlock):
        pou = type_.pou
        return _declaration_key(pou, pou.symbol) if pou is not None else None
    if isinstance(type_, t.Interface):
        interface = type_.pou
        return _declaration_key(interface, interface.symbol) if interface is not None else None
    return None


def _declaration_key(
    decl: ast.Declaration, symbol: symbols.Symbol | None = None
) -> tuple[Key, symbols.Symbol | None] | None:
    if decl.source is None:
        return None
    return Key(decl.source.uri, decl.name_span.line, decl.name_span.column), symbol


def find_type(analysis: Analysis, name: str) -> symbols.Symbol | None:
    """The type, block or interface of a possibly qualified name."""
    symbol: symbols.Symbol | None = None
    for number, part in enumerate(name.upper().split(".")):
        if number == 0:
            symbol = analysis.scope.get(part)
        elif isinstance(symbol, symbols.NamespaceSymbol):
            symbol = symbol.members.get(part)
        else:
            return None
    return (
        symbol
        if isinstance(symbol, (symbols.TypeSymbol, symbols.PouSymbol, symbols.InterfaceSymbol))
        else None
    )


class _Finder:
    """Walks one tree with a stack of its own: trees may be deeper than Python's."""

    def __init__(self, snapshot: Snapshot, source: Source) -> None:
        self.analysis = snapshot.analysis
        self.source = source
        self.found: list[Occurrence] = []
        self.stack: list[tuple[ast.Node, Role, int]] = []

    def run(self, unit: ast.Unit) -> list[Occurrence]:
        self.stack.append((unit, "read", 0))
        while self.stack:
            node, role, body = self.stack.pop()
            self.visit(node, role, body)
        self.found.sort(key=lambda item: (item.span.line, item.span.column))
        return self.found

    def add(
        self,
        span: Span,
        role: Role,
        symbol: symbols.Symbol | None,
        key: Key | None = None,
        type_: t.Type | None = None,
    ) -> None:
        if key is None and symbol is not None:
            key = key_of(symbol)
        if key is not None and span is not NOWHERE and span[:2] != span[2:]:
            self.found.append(Occurrence(span, role, key, symbol, type_))

    def visit(self, node: ast.Node, role: Role, body: int) -> None:
        push = self.stack.append
        if isinstance(node, ast.Name):
            if node.symbol is not None and node.name[0] != "%" and node.span != NOWHERE:
                column = node.span.end_column - len(node.name)
                self.add(Span(node.span.end_line, column, *node.span[2:]), role, node.symbol)
            return
        if isinstance(node, ast.Member):
            if node.symbol is not None:
                self.add(node.name_span, role, node.symbol)
            push((node.base, "read", body))
            return
        if isinstance(node, (ast.Assign, ast.AssignExpr)):
            if isinstance(node, ast.Assign):
                self.label(node, body)
            push((node.target, "write", body))
            push((node.value, "address" if node.op == "REF=" else "read", body))
            return
        if isinstance(node, ast.Call):
            push((node.callee, "call", body))
            callee = node.callee
            taken = isinstance(callee, ast.Name) and callee.name.upper() in _ADDRESSING
            for argument in node.args:
                push((argument, "address" if taken else "read", body))
            return
        if isinstance(node, (ast.Index, ast.Deref)):
            push((node.base, role, body))
            if isinstance(node, ast.Index):
                for index in node.indices:
                    push((index, "read", body))
            return
        if isinstance(node, ast.Argument):
            if node.name is not None and node.parameter is not None:
                span = node.span
                self.add(
                    Span(span.line, span.column, span.line, span.column + len(node.name)),
                    "write",
                    node.parameter,
                )
            if node.value is not None:
                changed = node.output or getattr(node.parameter, "section", "") == "VAR_IN_OUT"
                push((node.value, "write" if changed else role, body))
            return
        if isinstance(node, ast.For):
            push((node.variable, "write", body))
        self.declarations(node, body)
        if isinstance(node, (ast.Pou, ast.Accessor)):
            body = id(node)
        for child in children(node):
            if not (isinstance(node, ast.For) and child is node.variable):
                push((child, "read", body))

    def label(self, node: ast.Stmt, body: int) -> None:
        if node.label is not None:
            span = node.span
            place = Span(span.line, span.column, span.line, span.column + len(node.label))
            self.add(place, "declaration", None, _label_key(self.source, body, node.label))

    def declarations(self, node: ast.Node, body: int) -> None:
        """Names that are not expressions: of declarations, of types, and labels."""
        if isinstance(node, ast.VarDecl):
            self.variable(node)
        elif isinstance(node, ast.NamedType):
            self.named_type(node)
        elif isinstance(node, ast.Stmt):
            self.label(node, body)
            if isinstance(node, ast.Jump) and node.target:
                self.jump(node, body)
        elif isinstance(node, ast.EnumValue):
            key = Key(self.source.uri, node.span.line, node.span.column)
            span = node.span
            self.add(
                Span(span.line, span.column, span.line, span.column + len(node.name)),
                "declaration",
                None,
                key,
            )
        elif isinstance(node, ast.Declaration) and node.name and not isinstance(node, ast.GlobalList):
            symbol = node.symbol if isinstance(node, (ast.Pou, ast.Interface)) else None
            key = Key(self.source.uri, node.name_span.line, node.name_span.column)
            self.add(node.name_span, "declaration", symbol, key)
            self.heritage(node)

    def variable(self, node: ast.VarDecl) -> None:
        if "." in node.name:
            self.path(node)
            return
        key = Key(self.source.uri, node.name_span.line, node.name_span.column)
        self.add(node.name_span, "declaration", node.symbol, key)

    def path(self, node: ast.VarDecl) -> None:
        """`PLC_PRG.inst.x` of a VAR_CONFIG, and `.x` of a global variable."""
        line, column = node.name_span.line, node.name_span.column
        column += node.name.startswith(".")
        symbol: symbols.Symbol | None = None
        type_: t.Type | None = None
        for number, part in enumerate(node.name.removeprefix(".").split(".")):
            name = part.partition("[")[0]
            if number == 0:
                symbol = self.analysis.scope.get(name.upper())
                type_ = (
                    symbol.instance
                    if isinstance(symbol, symbols.PouSymbol)
                    else getattr(symbol, "type", None)
                )
            else:
                inner = None if type_ is None else innermost(type_)
                block = inner.pou.symbol if isinstance(inner, t.FunctionBlock) and inner.pou else None
                symbol = block.locals.get(name.upper()) if isinstance(block, symbols.PouSymbol) else None
                type_ = symbol.type if isinstance(symbol, symbols.VarSymbol) else None
            if symbol is None:
                return
            self.add(Span(line, column, line, column + len(name)), "read", symbol)
            column += len(part) + 1

    def named_type(self, node: ast.NamedType) -> None:
        last = node.name.rpartition(".")[2]
        column = node.span.column + len(node.name) - len(last)
        span = Span(node.span.line, column, node.span.line, column + len(last))
        symbol = find_type(self.analysis, node.name)
        if symbol is not None:
            self.add(span, "read", symbol, type_=node.type)
            return
        declared = declared_type(node.type)
        if declared is not None:
            self.add(span, "read", declared[1], declared[0], node.type)

    def heritage(self, node: ast.Declaration) -> None:
        named: list[tuple[str | None, Span]] = []
        if isinstance(node, ast.Pou):
            named = [
                (node.extends, node.extends_span),
                *zip(node.implements, node.implements_spans, strict=True),
            ]
        elif isinstance(node, ast.Interface):
            named = list(zip(node.extends, node.extends_spans, strict=True))
        elif isinstance(node, ast.TypeDecl):
            named = [(node.extends, node.extends_span)]
        for name, span in named:
            symbol = find_type(self.analysis, name) if name else None
            if name and symbol is not None:
                last = name.rpartition(".")[2]
                self.add(Span(span.end_line, span.end_column - len(last), *span[2:]), "read", symbol)

    def jump(self, node: ast.Jump, body: int) -> None:
        self.add(node.target_span, "read", None, _label_key(self.source, body, node.target))


def _label_key(source: Source, body: int, name: str) -> Key:
    return Key(f"{source.uri}#{name.upper()}", body, 0)


_CACHE = "_occurrences"


def occurrences(snapshot: Snapshot, index: int) -> list[Occurrence]:
    """The names in one text of the program, in order."""
    cache_: dict[int, list[Occurrence]] = snapshot.derived.setdefault(_CACHE, {})
    found = cache_.get(index)
    if found is None:
        text = snapshot.program.texts[index]
        found = _Finder(snapshot, text.source).run(snapshot.results[index].unit)
        cache_[index] = found
    return found


def occurrence_at(snapshot: Snapshot, index: int, position: Position) -> Occurrence | None:
    """The name at a position of a text."""
    for item in occurrences(snapshot, index):
        span = item.span
        if span.line == position.line and span.column <= position.column <= span.end_column:
            return item
    return None


def occurrences_of(snapshot: Snapshot, found: Occurrence, index: int) -> Iterator[tuple[int, Occurrence]]:
    """Every place of the program that names what `found` in text number `index` names, with its text."""
    texts = snapshot.program.texts
    line = split_lines(texts[index].source.text)[found.span.line]
    name = re.escape(line[found.span.column : found.span.end_column])
    named = re.compile(rf"(?<!\w){name}(?!\w)", re.IGNORECASE)
    for number, text in enumerate(texts):
        if named.search(text.source.text):  # far cheaper than to walk the tree
            for item in occurrences(snapshot, number):
                if item.key == found.key:
                    yield number, item
