"""Text to syntax tree: a recursive-descent parser that takes any text and never raises.

The parts build on each other: `parser_core` (tokens, errors), `parser_arguments`, `parser_operands`,
`parser_expressions`, `parser_recovery`, `parser_statements`, `parser_types`, `parser_variables`,
`parser_type_blocks`, and `parser_declarations` for whole objects.
A body is read by the reader of its language (`languages`), and charts and drawings are lowered to statements
behind the parser (`lowering`).
"""

from __future__ import annotations

from dataclasses import dataclass

from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.lexer import Lexed, lex
from tappet.lang.lowering import lower_bodies
from tappet.lang.parameter_lists import take_given_values
from tappet.lang.parser_declarations import Parser
from tappet.lang.source import Source, Span


@dataclass(frozen=True, slots=True)
class ParseResult:
    """The tree of a text, complete as far as it could be read, and what was wrong, in order of the text."""

    unit: ast.Unit
    diagnostics: list[Diagnostic]
    inactive: tuple[Span, ...] = ()
    """Places that conditional pragmas leave out (see `conditional`)."""


def parse(source: Source) -> ParseResult:
    """Parse a whole text. Conditional pragmas stay in the tree; `conditional.parse_sources` decides them.

    Time grows linearly with the length of the text.
    """
    return parse_tokens(source, lex(source.text, source.uri))


def parse_tokens(source: Source, lexed: Lexed, inactive: tuple[Span, ...] = ()) -> ParseResult:
    """Parse the tokens of a text, or what conditional pragmas leave of them."""
    parser = Parser(source, lexed)
    unit = parser.unit()
    found = lexed.diagnostics + parser.diagnostics
    if parser.graphs:
        unit.graphs = frozenset(pou.graph.language for pou in parser.graphs if pou.graph is not None)
        found += lower_bodies(source, parser.graphs)
    found.sort(key=_place)
    return ParseResult(unit, found + take_given_values(unit), inactive)


def parse_expression(text: str, uri: str = "") -> tuple[ast.Expr, list[Diagnostic]]:
    """One expression that fills the whole text, as a watch list or a condition has it."""
    lexed = lex(text, uri)
    parser = Parser(Source(uri, text), lexed)
    expression = parser.expression()
    if parser.kinds[parser.i] != "end":
        parser.expected("The end of the expression", "Remove the rest.")
    found = lexed.diagnostics + parser.diagnostics
    found.sort(key=_place)
    return expression, found


def _place(item: Diagnostic) -> tuple[int, int]:
    return item.span.line, item.span.column
