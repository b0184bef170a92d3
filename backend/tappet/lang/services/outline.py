"""The outline of a document: objects, their variables, jump labels and children."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang import ast
from tappet.lang.services.describe import POU_KINDS, slice_of
from tappet.lang.services.documents import Position, Text
from tappet.lang.services.results import ItemKind, Outline
from tappet.lang.services.workspace import Snapshot
from tappet.lang.source import Span
from tappet.lang.walk import statements


def outline(snapshot: Snapshot, document: str) -> list[Outline]:
    """What a document declares, nested."""
    view = snapshot.view(document, Position(0, 0))
    return outline_of(snapshot, view.index, document)


def outline_of(snapshot: Snapshot, index: int, document: str) -> list[Outline]:
    """What a text of the program declares in a document."""
    maker = _Maker(snapshot.program.texts[index], document)
    unit = snapshot.results[index].unit
    return [entry for declaration in unit.declarations for entry in maker.declaration(declaration)]


class _Maker:
    def __init__(self, text: Text, document: str) -> None:
        self.text = text
        self.document = document

    def span(self, span: Span) -> Span | None:
        """A span in the document, cut to it; None when it lies in another one."""
        lines = self.text.lines_of(self.document)
        assert lines is not None
        first, behind = lines
        if span.end_line < first or span.line >= behind:
            return None
        begin = (span.line, span.column) if span.line >= first else (first, 0)
        end = (span.end_line, span.end_column) if span.end_line < behind else (behind - 1, 1_000_000)
        return self.text.place(Span(*begin, *end)).span

    def entry(
        self,
        name: str,
        kind: ItemKind,
        detail: str,
        span: Span,
        name_span: Span,
        children: Iterable[Outline] = (),
    ) -> list[Outline]:
        below = list(children)
        place = self.span(span)
        if place is None:
            return below
        own = self.span(name_span) or Span(place.line, place.column, place.line, place.column)
        return [Outline(name or "?", kind, detail, place, own, below)]

    def declaration(self, node: ast.Declaration) -> list[Outline]:
        if isinstance(node, ast.Pou):
            return self.pou(node)
        if isinstance(node, ast.Property):
            return self.property(node)
        if isinstance(node, ast.Interface):
            below = [entry for method in node.methods for entry in self.pou(method)]
            below += [entry for item in node.properties for entry in self.property(item)]
            return self.entry(node.name, ItemKind.INTERFACE, "", node.span, node.name_span, below)
        if isinstance(node, ast.TypeDecl):
            return self.type(node)
        if isinstance(node, ast.GlobalList):
            below = [entry for block in node.blocks for entry in self.variables(block)]
            return self.entry(node.name, ItemKind.GLOBAL_LIST, "", node.span, node.name_span, below)
        return []

    def pou(self, node: ast.Pou) -> list[Outline]:
        detail = self.written(node.return_type.span) if node.return_type is not None else ""
        below = [entry for block in node.blocks for entry in self.block(block)]
        below += self.labels(node.body)
        for child in (*node.methods, *node.actions):
            below += self.pou(child)
        for item in node.properties:
            below += self.property(item)
        kind = POU_KINDS.get(node.kind, ItemKind.FUNCTION)
        return self.entry(node.name, kind, detail, node.span, node.name_span, below)

    def property(self, node: ast.Property) -> list[Outline]:
        detail = self.written(node.type_ref.span) if node.type_ref is not None else ""
        accessors = [accessor for accessor in (node.getter, node.setter) if accessor is not None]
        below = [entry for accessor in accessors for entry in self.labels(accessor.body)]
        return self.entry(node.name, ItemKind.PROPERTY, detail, node.span, node.name_span, below)

    def labels(self, body: Iterable[ast.Stmt]) -> list[Outline]:
        """Jump labels of ST, labels of networks in IL."""
        found: list[Outline] = []
        for statement in statements(body):
            if statement.label is not None:
                span = statement.span
                name = span._replace(end_line=span.line, end_column=span.column + len(statement.label))
                found += self.entry(statement.label, ItemKind.LABEL, "", span, name)
        return found

    def type(self, node: ast.TypeDecl) -> list[Outline]:
        ref = node.type_ref
        below: list[Outline] = []
        kind, detail = ItemKind.TYPE, ""
        if isinstance(ref, ast.StructType):
            kind = ItemKind.UNION if ref.union else ItemKind.STRUCT
            for member in ref.members:
                below += self.variable(member, ItemKind.FIELD)
        elif isinstance(ref, ast.EnumType):
            kind = ItemKind.ENUM
            for value in ref.values:
                below += self.entry(value.name, ItemKind.ENUM_VALUE, "", value.span, value.span)
        else:
            detail = self.written(ref.span)
        return self.entry(node.name, kind, detail, node.span, node.name_span, below)

    def block(self, node: ast.VarBlock) -> list[Outline]:
        keyword = Span(node.span.line, node.span.column, node.span.line, node.span.column + len(node.section))
        name = " ".join([node.section, *sorted(node.flags)])
        return self.entry(name, ItemKind.SECTION, "", node.span, keyword, self.variables(node))

    def variables(self, node: ast.VarBlock) -> list[Outline]:
        kind = ItemKind.CONSTANT if "CONSTANT" in node.flags else ItemKind.VARIABLE
        return [entry for variable in node.variables for entry in self.variable(variable, kind)]

    def variable(self, node: ast.VarDecl, kind: ItemKind) -> list[Outline]:
        return self.entry(node.name, kind, self.written(node.type_ref.span), node.span, node.name_span)

    def written(self, span: Span) -> str:
        text = " ".join(slice_of(self.text.source, span).split())
        return text if len(text) <= 60 else f"{text[:57]}..."
