"""What reads the bodies of one language: text or elements in, statements of the common tree out.

Contract: a reader is asked in this order. `TextReader.begins`: is the body that stands here in its language
(asked only where the project does not say). `read`, or `drawn.DrawnReader.read_elements`: the body becomes
statements of the tree, or a node of its own (`ast.Graph`) that says what is written or drawn. `lower` of a
`GraphReader`: the graph becomes statements and variables, once, behind the parser and before any analysis
(`lang.lowering`).
Spans of what is made point into the text that is compiled; a drawn body has its listing there
(`iec.listing`), so that messages, line tables, call stacks and cross references need to know nothing of
languages. A reader reports and never raises.
Cost: linear in the body; a reader keeps nothing between bodies.
Reason: LD, FBD, CFC and SFC differ from ST in how they are written down, not in what they mean.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import Source, Span, split_lines

if TYPE_CHECKING:
    from tappet.lang.parser_statements import StatementParser


@dataclass(slots=True)
class Lowering:
    """What readers have at hand while they lower the graphs of one text."""

    source: Source
    diagnostics: list[Diagnostic] = field(default_factory=list)
    _lines: list[str] = field(default_factory=list)

    def report(self, code: str, span: Span, **fields: object) -> None:
        """Report at a place of the text."""
        self.diagnostics.append(report(code, self.source.uri, span, **fields))

    def text_of(self, span: Span) -> str:
        """The text of a span, of its first line only."""
        if not self._lines:
            self._lines = split_lines(self.source.text)
        last = span.end_column if span.end_line == span.line else None
        return self._lines[span.line][span.column : last]


class BodyReader(ABC):
    """A language as the compiler sees it."""

    name: ClassVar[str]
    """As in `iec.languages`."""

    def library(self) -> Source | None:
        """The text with the types that lowered bodies use; it joins programs that have such a body."""
        return None


class GraphReader(BodyReader):
    """Reads bodies into graphs (`pou.graph`) and lowers them behind the parser."""

    @abstractmethod
    def lower(self, pou: ast.Pou, context: Lowering) -> None:
        """Turns `pou.graph` into variables and statements of `pou`, whose lists are filled in place."""


class TextReader(BodyReader):
    """Reads bodies written as text."""

    @abstractmethod
    def begins(self, parser: StatementParser, pou: ast.Pou) -> bool:
        """Whether a part of a body in this language stands at the next token."""

    @abstractmethod
    def read(self, parser: StatementParser, pou: ast.Pou) -> None:
        """Reads on from the next token as far as the body goes, into `pou.body` or `pou.graph`."""
