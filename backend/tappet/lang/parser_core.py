"""Token access, errors and recovery shared by all parts of the parser.

The parser never raises. A missing piece is reported once and represented by an `ErrorExpr`, an empty name
or nothing; `failed_at` suppresses every further message at the same token, and a statement that has
reported anything is left at its `;` or at the next line that begins a statement.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Final

from tappet.iec.trivia import attribute_of
from tappet.iec.words import ENDS, OBJECT_HEADS, SECTIONS, STATEMENT_ENDS
from tappet.lang import ast
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.lexer import COMMENT, END, ID, PRAGMA, STRING, Lexed, Trivia
from tappet.lang.source import Source, Span

make_span: Callable[[tuple[int, int, int, int]], Span] = partial(tuple.__new__, Span)

BODY_END: Final = frozenset(ENDS.values()) | OBJECT_HEADS | SECTIONS | {
    END, "END_VAR", "ELSE", "ELSIF", "UNTIL", "__CATCH", "__FINALLY", "STRUCT", "UNION",
}  # fmt: skip
"""Tokens at which a list of statements stops."""
COMPOUND: Final = frozenset(STATEMENT_ENDS)
STATEMENT_KEYWORDS: Final = COMPOUND | {"EXIT", "CONTINUE", "RETURN", "JMP"}
_STATEMENT_SECOND: Final = frozenset([":=", ".", "(", "[", "^", ":"])

MAX_NESTING: Final = 100
"""Levels of parentheses, or of statements, in each other: beyond any hand-written text, within the stack."""
MAX_TREE_DEPTH: Final = 400
"""Depth of one expression tree, so that recursive passes over it stay within the stack."""

Opener = tuple[str, int]  # opening keyword and its line (0-based)


class Core:
    """The tokens of one text and the place reached in them."""

    __slots__ = (
        "columns",
        "depth",
        "diagnostics",
        "failed_at",
        "graphs",
        "i",
        "kinds",
        "label_scan_end",
        "lexed",
        "lines",
        "open",
        "orphan_ends",
        "source",
        "texts",
        "trivia",
    )

    def __init__(self, source: Source, lexed: Lexed) -> None:
        self.source = source
        self.lexed = lexed
        self.kinds = lexed.kinds
        self.texts = lexed.texts
        self.lines = lexed.lines
        self.columns = lexed.columns
        self.trivia = lexed.trivia
        self.diagnostics: list[Diagnostic] = []
        self.i = 0
        self.depth = 0
        self.failed_at = -1
        self.label_scan_end = 0
        """Up to here no CASE label was found; keeps the search for labels linear."""
        self.graphs: list[ast.Pou] = []
        """POUs whose body is no list of statements yet."""
        self.open: list[Opener] = []
        """The constructs begun and not yet closed, outermost first."""
        self.orphan_ends = 0
        """Ends still to come of constructs whose beginning was faulty; they are no errors of their own."""

    # -- places

    def span_from(self, start: int) -> Span:
        """From token `start` to the last token taken."""
        last = self.i - 1
        if last < start:
            return self.span_at(start)
        line, text = self.lines[last], self.texts[last]
        if "\n" in text:
            end = self.span_at(last)
            return make_span((self.lines[start], self.columns[start], end[2], end[3]))
        return make_span((self.lines[start], self.columns[start], line, self.columns[last] + len(text)))

    def span_at(self, index: int) -> Span:
        """Of one token."""
        line, column, text = self.lines[index], self.columns[index], self.texts[index]
        if "\n" in text:  # a string over several lines
            return make_span((line, column, line + text.count("\n"), len(text) - text.rfind("\n") - 1))
        return make_span((line, column, line, column + len(text)))

    # -- errors

    def found(self, index: int | None = None) -> str:
        """How a message names the token at `index` (the current one by default)."""
        at = self.i if index is None else index
        kind = self.kinds[at]
        if kind is END:
            return "the end of the text"
        text = self.texts[at]
        if kind is STRING or len(text) > 40:
            return f"the string {text[:40]}" if kind is STRING else f"'{text[:37]}...'"
        return kind if kind == text.upper() and text[0].isalpha() else f"'{text}'"

    def error(self, code: str, span: Span | None = None, **fields: object) -> None:
        """Report at `span`, or at the current token; only the first message at a token counts."""
        if self.failed_at == self.i:
            return
        self.failed_at = self.i
        if self.i in self.lexed.damaged:
            return  # the lexer has said why
        if self.kinds[self.i] is END and self.lexed.unclosed_comment:
            return  # the missing text went into the comment
        self.diagnostics.append(report(code, self.source.uri, span or self.span_at(self.i), **fields))

    def expected(self, what: str, hint: str = "", **facts: str) -> None:
        """Report that `what` is missing here; at a line end the message stands where it is missing."""
        i = self.i
        span = self.span_at(i)
        if i and self.lines[i - 1] != self.lines[i]:
            line, end = self.lines[i - 1], self.columns[i - 1] + len(self.texts[i - 1])
            span = Span(line, max(end - 1, 0), line, end)
            facts |= {"place": "behind"}
        hint = hint or f"Write {what}."
        self.error("E0101", span, expected=what, found=self.found(), hint=hint, **facts)

    def missing(self, kind: str, hint: str = "", what: str = "") -> None:
        """Report that a token is missing here."""
        self.expected(what or (kind if kind[0].isalpha() else f"'{kind}'"), hint, missing=kind)

    def take(self, kind: str, what: str = "", hint: str = "") -> bool:
        """Step over a token of `kind`, or report it as missing."""
        if self.kinds[self.i] == kind:
            self.i += 1
            return True
        self.missing(kind, hint, what)
        return False

    def shown_line(self, line: int) -> int:
        """The number that an editor shows for a 0-based line: the implementation counts from 1 again."""
        body = self.source.body_line
        return (line - body if line >= body else line) + 1

    def close(self, opener: Opener) -> None:
        """Take the end keyword of `opener`. Another one that closes nothing else counts as a slip of it."""
        begin, line = opener
        end = ENDS[begin]
        kind = self.kinds[self.i]
        if kind == end:
            self.i += 1
            return
        stray = kind.startswith("END_") and all(ENDS[other] != kind for other, _ in self.open)
        code = "E0110" if stray else "E0103"
        self.missing_end(code, end, begin, line)
        if stray and kind != "END_VAR":
            self.i += 1

    def missing_end(self, code: str, end: str, begin: str, line: int) -> None:
        """Report that the construct that `begin` opened in `line` is not closed here."""
        self.error(code, end=end, begin=begin, line=self.shown_line(line), opened=line, found=self.found())

    # -- names

    def word(self) -> str:
        """The current token in upper case if it is an identifier, else ''; for words that count by place."""
        return self.texts[self.i].upper() if self.kinds[self.i] is ID else ""

    def name(self, what: str, hint: str = "Write a name.") -> tuple[str, Span]:
        """Take an identifier. A keyword in its place is reported and taken when it can be nothing else."""
        i = self.i
        kind = self.kinds[i]
        if kind is ID:
            self.i = i + 1
            return self.texts[i], self.span_at(i)
        if kind[0].isalpha() and kind == self.texts[i].upper() and self._is_misused_keyword():
            self.error("E0105", name=kind, what=what)
            self.i = i + 1
            return self.texts[i], self.span_at(i)
        self.error("E0109", what=f"The name of the {what}", found=self.found(), hint=hint)
        return "", self.span_at(i)

    def _is_misused_keyword(self) -> bool:
        return self.kinds[self.i + 1] in (":", ",", ":=", "AT", ";") and self.kinds[self.i] != "END_VAR"

    def qualified_name(self, what: str) -> tuple[str, Span]:
        """`name.name`, joined by dots, and its place."""
        start = self.i
        name, _ = self.name(what)
        while self.kinds[self.i] == "." and name:
            self.i += 1
            part, _ = self.name(what)
            name = f"{name}.{part}"
        return name, self.span_from(start)

    # -- recovery

    def skip_statement(self) -> None:
        """Go behind the `;` of a faulty statement, or to the next token that begins or ends a statement."""
        kinds, lines = self.kinds, self.lines
        i = self.i
        while True:
            kind = kinds[i]
            if kind == ";":
                i += 1
                break
            if kind in BODY_END or kind in STATEMENT_KEYWORDS:
                break
            if kind == "THEN" or kind == "DO" or kind == "OF":
                self.orphan_ends += 1
                i += 1
                break
            if kind is ID and i and lines[i] != lines[i - 1] and kinds[i + 1] in _STATEMENT_SECOND:
                break
            i += 1
        self.i = i

    # -- comments and pragmas

    def pragmas_before(self, index: int) -> list[ast.Pragma]:
        """The pragmas between the token before `index` and it."""
        trivia = self.trivia.get(index)
        if trivia is None:
            return []
        return [pragma_of(item) for item in trivia if item.kind is PRAGMA]

    def attributes_of(self, first: int, last: int) -> list[ast.Pragma]:
        """The pragmas of the declaration from token `first` to `last`: above, inside, or behind it."""
        if not self.trivia:
            return []
        found = self.attributes_before(first)
        for index in range(first + 1, last + 1):
            if index in self.trivia:
                found += self.pragmas_before(index)
        return found + self.attributes_after(last)

    def attributes_before(self, index: int) -> list[ast.Pragma]:
        """The pragmas before `index` that do not end the line of the token before it (LPRG-04)."""
        trivia = self.trivia.get(index)
        if trivia is None:
            return []
        own_line = self.lines[index - 1] if index else -1
        return [
            pragma_of(item)
            for item in trivia
            if item.kind is PRAGMA and (item.span.line != own_line or self.lines[index] == own_line)
        ]

    def attributes_after(self, index: int) -> list[ast.Pragma]:
        """The pragmas behind token `index` on its line, when the line ends there."""
        trivia = self.trivia.get(index + 1)
        line = self.lines[index]
        if trivia is None or self.lines[index + 1] == line:
            return []
        return [pragma_of(item) for item in trivia if item.kind is PRAGMA and item.span.line == line]

    def comment_of(self, first: int, last: int) -> str:
        """The comment of the declaration from token `first` to `last`: behind, inside, or above it."""
        trivia = self.trivia
        if not trivia:
            return ""
        after = trivia.get(last + 1)
        if after:
            line = self.lines[last]
            texts = [
                plain_comment(item.text) for item in after if item.kind is COMMENT and item.span.line == line
            ]
            if texts:
                return "\n".join(texts)
        for index in range(first + 1, last + 1):
            inside = trivia.get(index)
            if inside:
                texts = [plain_comment(item.text) for item in inside if item.kind is COMMENT]
                if texts:
                    return "\n".join(texts)
        return self.comment_above(first)

    def comment_above(self, index: int) -> str:
        """The comment lines directly above token `index`, also above its pragmas."""
        trivia = self.trivia.get(index)
        if trivia is None:
            return ""
        own_line = self.lines[index - 1] if index else -1
        texts: list[str] = []
        line = self.lines[index]
        for item in reversed(trivia):
            span = item.span
            if span.end_line < line - 1 or span.line == own_line:
                break
            if item.kind is COMMENT:
                texts.append(plain_comment(item.text))
            line = span.line
        return "\n".join(reversed(texts))


def plain_comment(text: str) -> str:
    """The words of a comment without its marks, and without the asterisks that frame a block."""
    if text.startswith("//"):
        return text[2:].lstrip("/").strip()
    inner = text[2:]
    if inner.endswith(("*)", "*/")):
        inner = inner[:-2]
    lines = [line.strip().strip("*").strip() for line in inner.splitlines()]
    return "\n".join(line for line in lines if line)


def pragma_of(item: Trivia) -> ast.Pragma:
    """The node of a pragma, with name and value of an attribute pragma."""
    text = item.text[1:].removesuffix("}").strip()
    pragma = ast.Pragma(span=item.span, text=text)
    attribute = attribute_of(item.text)
    if attribute is not None:
        pragma.attribute, pragma.value = attribute
    return pragma
