"""Structured Text: its statements are those of the tree."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from tappet.lang import ast
from tappet.lang.languages.reader import TextReader

if TYPE_CHECKING:
    from tappet.lang.parser_statements import StatementParser


class StructuredText(TextReader):
    """ST is what a body is in when it looks like nothing else."""

    name: ClassVar[str] = "ST"

    def begins(self, parser: StatementParser, pou: ast.Pou) -> bool:
        """Any text can be meant as ST."""
        return True

    def read(self, parser: StatementParser, pou: ast.Pou) -> None:
        """Statements up to the end of the list."""
        pou.body += parser.statements()


READER = StructuredText()
