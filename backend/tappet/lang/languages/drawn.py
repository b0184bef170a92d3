"""The base of readers whose bodies are elements: from stored JSON to statements with places in its listing.

A reader walks the elements and asks `DrawnBody` for the expressions and statements that stand in their texts;
it reports at elements. What the JSON is worth as a whole is checked here, once for all languages.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

from tappet.iec.listing import Element, Listing, Path, listing_of
from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.languages.reader import BodyReader
from tappet.lang.lexer import END, Lexed, Trivia, lex
from tappet.lang.parser_type_blocks import TypeBlockParser
from tappet.lang.source import BodyText, Source, Span

if TYPE_CHECKING:
    from collections.abc import Callable

_Tree = TypeVar("_Tree")


class DrawnReader(BodyReader):
    """Reads bodies whose elements are stored as JSON."""

    @abstractmethod
    def read_elements(self, body: DrawnBody, pou: ast.Pou) -> None:
        """Reads a body, into statements of `pou.body` or, as a `GraphReader`, a graph in `pou.graph`.

        Reports, never raises.
        """

    def read_drawn(self, source: Source, part: BodyText, pou: ast.Pou) -> list[Diagnostic]:
        """Reads what is stored of a body; what is wrong with it."""
        body = DrawnBody(source, part)
        pou.language = self.name
        if body.listing.problem:
            body.report_body("E0130", language=self.name, reason=body.listing.problem)
            return body.diagnostics
        known: set[str] = set()
        for element in body.listing.elements:
            if element.id in known:
                body.report("E0131", element, id=element.id)
            known.add(element.id)
        self.read_elements(body, pou)
        return body.diagnostics


class DrawnBody:
    """A drawn body while it is read: its elements, and their texts as parts of the tree."""

    def __init__(self, source: Source, part: BodyText) -> None:
        self.source = source
        self.line = part.line
        """Where the listing begins in the text."""
        self.listing: Listing = listing_of(part.drawn or "")
        self.diagnostics: list[Diagnostic] = []

    @property
    def elements(self) -> list[Element]:
        """All elements, outer ones before those inside them."""
        return self.listing.elements

    @property
    def body(self) -> Any:
        """The JSON object that is stored."""
        return self.listing.body

    def span(self, element: Element) -> Span:
        """The line of an element."""
        line = self.line + element.line
        return Span(line, 0, line, len(self.listing.lines[element.line]))

    def report(self, code: str, element: Element, **fields: object) -> None:
        """Report at an element."""
        self.diagnostics.append(report(code, self.source.uri, self.span(element), **fields))

    def report_body(self, code: str, **fields: object) -> None:
        """Report at the body as a whole."""
        at = Span(self.line, 0, self.line, 0)
        self.diagnostics.append(report(code, self.source.uri, at, **fields))

    def expression(self, element: Element, *path: str | int) -> ast.Expr:
        """The expression that stands in a text of an element; a missing one is reported."""
        return self._parsed(element, path, _expression) or ast.ErrorExpr(span=self.span(element))

    def statements(self, element: Element, *path: str | int) -> list[ast.Stmt]:
        """The statements of ST that stand in a text of an element."""
        return self._parsed(element, path, TypeBlockParser.statements) or []

    def _parsed(self, element: Element, path: Path, read: Callable[[TypeBlockParser], _Tree]) -> _Tree | None:
        place = self.listing.places.get((*element.path, *path))
        text = _at(element.value, path)
        if place is None or not isinstance(text, str) or not text.strip():
            self.report("E0132", element, id=element.id, what=".".join(map(str, path)))
            return None
        parser = TypeBlockParser(
            self.source, _shifted(lex(text, self.source.uri), self.line + place[0], place[1])
        )
        tree = read(parser)
        if parser.kinds[parser.i] is not END:
            parser.expected("The end of the text", "Remove the rest.")
        self.diagnostics += parser.lexed.diagnostics + parser.diagnostics
        return tree


def _expression(parser: TypeBlockParser) -> ast.Expr:
    return parser.expression()


def _at(value: Any, path: Path) -> Any:
    for key in path:
        if isinstance(value, dict) and isinstance(key, str):
            value = value.get(key)
        elif isinstance(value, list) and isinstance(key, int) and 0 <= key < len(value):
            value = value[key]
        else:
            return None
    return value


def _shifted(lexed: Lexed, line: int, column: int) -> Lexed:
    """Tokens at the place where their text stands in the listing; all its lines begin at the same column."""

    def moved(span: Span) -> Span:
        return Span(span.line + line, span.column + column, span.end_line + line, span.end_column + column)

    lexed.lines = [number + line for number in lexed.lines]
    lexed.columns = [number + column for number in lexed.columns]
    lexed.trivia = {
        index: [Trivia(item.kind, item.text, moved(item.span)) for item in items]
        for index, items in lexed.trivia.items()
    }
    lexed.diagnostics = [replace(item, span=moved(item.span)) for item in lexed.diagnostics]
    return lexed
