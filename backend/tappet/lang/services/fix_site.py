"""Where a message stands, for the code that mends it: tokens, tree, scope, and edits of the text."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.lexer import Lexed
from tappet.lang.services.cursor import token_before
from tappet.lang.services.describe import slice_of
from tappet.lang.services.documents import Position, Text
from tappet.lang.services.occurrences import children
from tappet.lang.services.resolution import Scope, scope_at
from tappet.lang.services.results import CodeAction, Edit, NewMember, Report
from tappet.lang.services.workspace import Snapshot, View
from tappet.lang.source import Span, split_lines

Offering = Callable[[str], Sequence[str]]
"""Libraries that are not referred to and have something of a name."""


def nothing_offered(name: str) -> Sequence[str]:
    """There are no libraries to choose from."""
    return ()


@dataclass(frozen=True)
class Site:
    """One message in its text."""

    view: View
    diagnostic: Diagnostic
    report: Report
    offering: Offering

    @property
    def snapshot(self) -> Snapshot:
        """The program."""
        return self.view.snapshot

    @property
    def span(self) -> Span:
        """Range of the message in the text of the compiler."""
        return self.diagnostic.span

    @property
    def facts(self) -> Mapping[str, str]:
        """What the message is about, by name."""
        return self.diagnostic.facts

    @property
    def lexed(self) -> Lexed:
        """The tokens of the text."""
        return self.view.lexed

    @cached_property
    def lines(self) -> list[str]:
        """The lines of the text."""
        return split_lines(self.view.source.text)

    @cached_property
    def scope(self) -> Scope:
        """The names seen at the message."""
        return scope_at(self.view)

    @cached_property
    def token(self) -> int:
        """Index of the token at which the message begins."""
        return token_before(self.lexed, Position(self.span.line, self.span.column)) + 1

    @cached_property
    def written(self) -> str:
        """The text that the message is about; '' over several lines."""
        span = self.span
        same = span.line == span.end_line < len(self.lines)
        return self.lines[span.line][span.column : span.end_column] if same else ""

    @cached_property
    def path(self) -> list[ast.Node]:
        """The nodes of the tree around the message, outermost first."""
        found: list[ast.Node] = []
        node: ast.Node | None = self.view.unit
        begin, end = self.span[:2], self.span[2:]
        while node is not None:
            found.append(node)
            inner = None
            for child in children(node):
                if child.span[:2] <= begin and end <= child.span[2:]:
                    inner = child
            node = inner
        return found

    @property
    def in_declaration(self) -> bool:
        """Whether the message stands in a declaration, not among statements."""
        return any(isinstance(node, (ast.VarBlock, ast.TypeDecl)) for node in self.path)

    def spoken(self, span: Span) -> bool:
        """Whether a range holds a comment, which an edit would lose."""
        text = slice_of(self.view.source, span)
        return "//" in text or "(*" in text

    # -- edits

    def replace(self, span: Span, text: str) -> Edit:
        """Put `text` in place of a range."""
        return Edit(self.view.place(span), text)

    def replacement(self, span: Span, text: str) -> CodeAction:
        """The action that writes another text in place of a range, as the obvious mend."""
        title = f"Replace by '{text}'"
        return self.action("replace", title, self.replace(span, text), preferred=True, name=text)

    def insertion(self, edit: Edit, text: str) -> CodeAction:
        """The action that inserts what is missing, as the obvious mend."""
        return self.action("insert", f"Insert '{text}'", edit, preferred=True, name=text)

    def insert(self, line: int, column: int, text: str) -> Edit:
        """Put `text` before a place."""
        return self.replace(Span(line, column, line, column), text)

    def token_span(self, index: int) -> Span:
        """Range of a token."""
        lexed = self.lexed
        line, column = lexed.lines[index], lexed.columns[index]
        return Span(line, column, line, column + len(lexed.texts[index]))

    def before_line(self, line: int, text: str) -> Edit:
        """Put lines (with their line ends) before a line, also before one that is in no document."""
        return insert_before_line(self.view.text, self.lines, line, text)

    def conversion(self, function: str) -> CodeAction:
        """Wraps what the message is about into a function of conversion."""
        span = self.span
        opening = self.insert(span.line, span.column, f"{function}(")
        closing = self.insert(span.end_line, span.end_column, ")")
        title = f"Convert with {function}"
        return self.action("convert", title, opening, closing, preferred=True, function=function)

    def action(
        self,
        key: str,
        title: str,
        *edits: Edit,
        preferred: bool = False,
        declare: str = "",
        type_: str = "",
        library: str = "",
        members: tuple[NewMember, ...] = (),
        owner: str = "",
        **values: str,
    ) -> CodeAction:
        """An action that mends the message."""
        return CodeAction(
            title,
            key,
            tuple(values.items()),
            self.report,
            edits,
            preferred,
            declare,
            type_,
            library,
            members,
            owner,
        )


def insert_before_line(text: Text, lines: Sequence[str], line: int, inserted: str) -> Edit:
    """Put lines (with their line ends) before a line of a text, also before one of the compiler itself."""
    for segment in text.segments:
        if segment.count is not None and line == segment.line + segment.count:  # behind the last line
            end = len(lines[line - 1])
            place = text.place(Span(line - 1, end, line - 1, end))
            return Edit(place, "\n" + inserted.removesuffix("\n"))
    return Edit(text.place(Span(line, 0, line, 0)), inserted)


def indent_of(line: str) -> str:
    """The blanks at the beginning of a line."""
    return line[: len(line) - len(line.lstrip())]
