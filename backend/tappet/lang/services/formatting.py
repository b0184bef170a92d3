"""Indentation, blanks and the case of keywords. Line breaks, comments and the order of tokens stay.

Alignment inside declarations is kept: blanks are added where they are missing there, never taken away.
Source: spec LDEC-17 (keywords in upper case).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from tappet.iec.words import (
    ACCESS_SPECIFIERS,
    ACCESSORS,
    CONSTANTS,
    INSTANCES,
    KEYWORDS,
    OBJECT_HEADS,
    OPERATORS,
    SECTION_FLAGS,
    SECTIONS,
    STATEMENT_ENDS,
    STRING_TYPES,
    STRUCTURE_ENDS,
)
from tappet.lang.lexer import ADDRESS, END, ID, INT, NUMBER, STRING, Lexed, Trivia, lex
from tappet.lang.parser_variables import BEHIND_NAME
from tappet.lang.services.documents import Place
from tappet.lang.services.instruction_list import format_rows, holds_rows
from tappet.lang.services.results import Edit
from tappet.lang.source import Span
from tappet.lang.types import ELEMENTARY

_TYPE_NAMES = frozenset(ELEMENTARY) | set(STRING_TYPES)
_ENDS_INSIDE = STRUCTURE_ENDS | STATEMENT_ENDS
_INDENTING = SECTIONS | set(_ENDS_INSIDE)
_CLOSED_BY = {end: word for word, end in _ENDS_INSIDE.items()}
_BRANCH = {
    "ELSE": ("IF", "CASE"),
    "ELSIF": ("IF",),
    "UNTIL": ("REPEAT",),
    "__CATCH": ("__TRY",),
    "__FINALLY": ("__TRY",),
}
_LAST_BRANCH = "CASE ELSE"
"""Denotes a CASE in its ELSE, where nothing is a label."""
_BEGINS_STATEMENT = frozenset([";", "THEN", "ELSE", "DO", "REPEAT", "END_VAR", "__TRY", "__FINALLY"]) | set(
    _CLOSED_BY
)
_NO_BLANK_BEFORE = frozenset([";", ",", ")", "]", ".", "^", ".."])
_NO_BLANK_AFTER = frozenset(["(", "[", ".", ".."])
_BINARY = frozenset(OPERATORS) - {";", ",", "(", ")", "[", "]", "^", ".", "..", ":"}
_TIGHT = _BINARY - {":=", "?=", "=>"}
"""Operators that a style may write without blanks."""
_VALUES = frozenset([ID, INT, NUMBER, STRING, *CONSTANTS])
_OPERAND_END = _VALUES | {ADDRESS, ")", "]", "^", *INSTANCES}
_LABEL_PARTS = _VALUES | {".", ",", "..", "-", "+", "*", "(", ")"}


Case = Literal["upper", "lower", "keep"]


@dataclass(frozen=True, slots=True)
class Style:
    """What can be chosen about the look of a text."""

    indent: str = "    "
    keywords: Case = "upper"
    operators: bool = True
    """Blanks around operators; without them `a := b + c` becomes `a := b+c`."""
    commas: bool = True
    """A blank behind a comma."""


@dataclass(slots=True)
class _Piece:
    """A token or trivia as it stands in the text."""

    kind: str
    text: str
    line: int
    column: int
    end_line: int
    end_column: int
    index: int
    """Of the token; -1 for trivia."""


_USUAL = Style()


def format_text(text: str, style: Style = _USUAL) -> str:
    """The text of a document, formatted; unchanged when a comment or string in it is not closed."""
    lexed = lex(text, "")
    if lexed.unclosed_comment or any(d.code in ("E0003", "E0004") for d in lexed.diagnostics):
        return text
    if holds_rows(lexed):
        return format_rows(text)
    return _Formatter(text, lexed, style).run()


def formatting(document: str, text: str, style: Style = _USUAL) -> list[Edit]:
    """The edits that format a document, one for each line that changes."""
    before, after = text.split("\n"), format_text(text, style).split("\n")
    return [
        Edit(Place(document, "", Span(number, 0, number, len(old))), new)
        for number, (old, new) in enumerate(zip(before, after, strict=True))
        if old != new
    ]


class _Formatter:
    def __init__(self, text: str, lexed: Lexed, style: Style) -> None:
        self.lexed = lexed
        self.style = style
        self.indent = style.indent
        self.lines = text.split("\n")
        self.stack: list[str] = []
        """Open constructs; 'label' is the branch of a CASE that has begun."""
        self.at_start = True
        """Whether the next token begins a statement or declaration."""
        self.values = _values_of_types(lexed)
        self.statement_shift = 0
        self.depth = 0
        """Open parentheses and brackets."""

    def run(self) -> str:
        by_line: dict[int, list[_Piece]] = {}
        covered: set[int] = set()
        for piece in self.pieces():
            by_line.setdefault(piece.line, []).append(piece)
            covered.update(range(piece.line + 1, piece.end_line + 1))
        out: list[str] = []
        for number, line in enumerate(self.lines):
            found = by_line.get(number)
            over_lines = found is not None and any(p.index >= 0 and p.end_line > p.line for p in found)
            if found and (number in covered or over_lines):  # beside a comment or string of several lines
                for piece in found:
                    self.advance(piece)
                out.append(line.rstrip())
            elif found:
                out.append(self.line(found, line))
            else:
                out.append(line if number in covered else "")
        return "\n".join(line.rstrip() if n not in covered else line for n, line in enumerate(out))

    def pieces(self) -> list[_Piece]:
        lexed = self.lexed
        found: list[_Piece] = []
        for index, kind in enumerate(lexed.kinds):
            found.extend(_trivia(item) for item in lexed.trivia.get(index, ()))
            if kind is not END:
                line, column, text = lexed.lines[index], lexed.columns[index], lexed.texts[index]
                last = line + text.count("\n")
                found.append(_Piece(kind, text, line, column, last, column + len(text), index))
        return found

    # -- one line

    def line(self, pieces: list[_Piece], original: str) -> str:
        first = pieces[0]
        width = self.leading(first)
        own = len(original) - len(original.lstrip())
        old = len(original[:own].expandtabs(4))
        if first.index < 0 or self.at_start or first.kind in _CLOSED_BY or first.kind == "END_VAR":
            lead = self.indent * width
            self.statement_shift = len(lead.expandtabs(4)) - old
        else:  # continues from the line before: keep how it stands to it
            lead = " " * max(old + self.statement_shift, 0)
        text = lead
        previous: _Piece | None = None
        for piece in pieces:
            if previous is not None:
                text += self.gap(previous, piece, original)
            text += self.cased(piece)
            self.advance(piece)
            previous = piece
        return text

    def leading(self, piece: _Piece) -> int:
        """Levels of indentation of a line that begins with `piece`."""
        stack = self.stack
        kind = piece.kind
        level = len(stack)
        if kind == "END_VAR":
            return max(level - 1, 0) if stack and stack[-1] in SECTIONS else level
        if kind in _CLOSED_BY:
            opener = _CLOSED_BY[kind]
            for depth in range(len(stack) - 1, -1, -1):
                if _closes(stack[depth], opener):
                    return depth
            return level
        if kind in _BRANCH:
            for depth in range(len(stack) - 1, -1, -1):
                if stack[depth] in _BRANCH[kind]:
                    return depth
            return level
        if kind in OBJECT_HEADS or kind in ("END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK", "END_TYPE"):
            return 0
        if self.is_label(piece) and stack[-1] == "label":
            return level - 1
        if piece.index < 0 and stack and stack[-1] == "label" and self.next_is_label(piece):
            return level - 1
        return level

    def is_label(self, piece: _Piece) -> bool:
        """Whether `piece` begins the label of a CASE branch."""
        stack = self.stack
        if piece.index < 0 or not self.at_start or not stack or stack[-1] not in ("CASE", "label"):
            return False
        kinds = self.lexed.kinds
        index = piece.index
        while kinds[index] in _LABEL_PARTS:
            index += 1
        return index > piece.index and kinds[index] == ":"

    def next_is_label(self, piece: _Piece) -> bool:
        """Whether the token behind a comment begins a label: the comment belongs to it then."""
        lexed = self.lexed
        for index, kind in enumerate(lexed.kinds):
            if (lexed.lines[index], lexed.columns[index]) > (piece.line, piece.column):
                if kind in ("END_CASE", "ELSE"):
                    return False
                token = _Piece(kind, "", 0, 0, 0, 0, index)
                return kind is not END and self.is_label(token)
        return False

    # -- state

    def advance(self, piece: _Piece) -> None:
        """Take note of a token."""
        if piece.index < 0:
            return
        kind, stack = piece.kind, self.stack
        if self.is_label(piece) and stack[-1] == "CASE":
            stack.append("label")
        if kind in ("(", "["):
            self.depth += 1
        elif kind in (")", "]"):
            self.depth = max(self.depth - 1, 0)
        elif kind in SECTIONS:
            self.close_to(None)
            stack.append(kind)
            self.depth = 0
        elif kind == "END_VAR":
            if stack and stack[-1] in SECTIONS:
                stack.pop()
        elif kind in _CLOSED_BY:
            self.close_to(_CLOSED_BY[kind])
            self.depth = 0
        elif kind == "ELSE" and stack and stack[-1] in ("CASE", "label"):
            if stack[-1] == "label":
                stack.pop()
            stack[-1] = _LAST_BRANCH
        elif kind in _INDENTING:
            stack.append(kind)
        elif kind in OBJECT_HEADS:
            self.close_to(None)
            self.depth = 0
        self.at_start = self.starts(piece)

    def starts(self, piece: _Piece) -> bool:
        """Whether a statement or declaration begins behind `piece`."""
        kind, stack = piece.kind, self.stack
        if self.depth:
            return False
        if kind in _BEGINS_STATEMENT or kind in SECTIONS or kind in ("STRUCT", "UNION"):
            return True
        if kind in SECTION_FLAGS or self.is_access(piece.index):
            return bool(stack) and stack[-1] in SECTIONS
        if kind == "OF":
            return bool(stack) and stack[-1] == "CASE"
        if kind == ":":
            return bool(stack) and stack[-1] == "label"
        kinds = self.lexed.kinds
        following = kinds[piece.index + 1]
        if following in SECTIONS or following in OBJECT_HEADS:
            return True
        return not stack and self.lexed.lines[piece.index + 1] != piece.line and self.in_head(piece.index)

    def is_access(self, index: int) -> bool:
        """Whether an access specifier stands here, behind VAR and its other flags."""
        before, after = self.lexed.kinds[index - 1], self.lexed.kinds[index + 1]
        return (
            index > 0
            and self.lexed.texts[index].upper() in ACCESS_SPECIFIERS
            and (before in SECTIONS or before in SECTION_FLAGS)
            and after not in BEHIND_NAME
        )

    def in_head(self, index: int) -> bool:
        """Whether the line of a token begins with the head of an object; the next line begins a new thing."""
        lexed = self.lexed
        line = lexed.lines[index]
        while index and lexed.lines[index - 1] == line:
            index -= 1
        kind, word = lexed.kinds[index], lexed.texts[index].upper()
        return kind in OBJECT_HEADS or kind.startswith("END_") or word in ACCESSORS

    def close_to(self, opener: str | None) -> None:
        """Leave constructs up to and with the innermost `opener`; None: all of them."""
        if opener is None:
            self.stack.clear()
        elif any(_closes(entry, opener) for entry in self.stack):
            while not _closes(self.stack.pop(), opener):
                pass

    # -- blanks

    def gap(self, left: _Piece, right: _Piece, original: str) -> str:
        """What stands between two pieces of a line."""
        written = original[left.end_column : right.column] if left.end_line == left.line else ""
        if left.index < 0 or right.index < 0:
            return written.expandtabs(4) if written else (" " if right.index < 0 else "")
        wanted = self.blank(left, right, bool(written))
        if written and not wanted and lex(left.text + right.text, "").texts[:2] != [left.text, right.text]:
            return " "  # together they would be another token
        if self.stack and self.declaring() and len(written) > len(wanted) and right.kind not in (";", ","):
            return written.expandtabs(4)
        return wanted

    def blank(self, left: _Piece, right: _Piece, written: bool) -> str:
        a, b = left.kind, right.kind
        keep = " " if written else ""
        if a == ":" and b == ";":
            return " "
        if a in _NO_BLANK_AFTER or b in _NO_BLANK_BEFORE:
            return ""
        if right.index in self.values or (left.index in self.values and (a == "<" or b in ("(", "["))):
            return ""
        if b == "(" or b == "[":
            if a in _OPERAND_END:
                return keep if a is ID and b == "(" and left.text.upper() in _TYPE_NAMES else ""
            return keep if a in KEYWORDS else " " if a in _BINARY else keep
        if b == ":":
            return keep if self.declaring() else ""
        if (a == "-" or a == "+") and self.is_sign(left):
            return ""
        if not self.style.commas and a == ",":
            return ""
        if not self.style.operators and (a in _TIGHT or (b in _TIGHT and a in _OPERAND_END)):
            return ""
        return " "

    def is_sign(self, piece: _Piece) -> bool:
        """Whether `-` or `+` stands before its only operand."""
        return piece.index == 0 or self.lexed.kinds[piece.index - 1] not in _OPERAND_END

    def cased(self, piece: _Piece) -> str:
        """Keywords in upper case, elementary types where a type stands."""
        text = piece.text
        if piece.index < 0:
            return text.split("\n", 1)[0].rstrip("\r")  # the other lines of a comment stay as they are
        if piece.kind in KEYWORDS:
            behind_dot = piece.index > 0 and self.lexed.kinds[piece.index - 1] == "."
            is_name = self.lexed.kinds[piece.index + 1] in (":=", "=>") and self.depth > 0
            return text if behind_dot or is_name else self.written(text)
        behind = self.lexed.kinds[piece.index - 1] if piece.index else ""
        is_type = piece.kind is ID and behind in (":", "OF", "TO") and self.declaring()
        return self.written(text) if is_type and text.upper() in _TYPE_NAMES else text

    def written(self, word: str) -> str:
        """A keyword in the case of the style."""
        case = self.style.keywords
        return word.upper() if case == "upper" else word.lower() if case == "lower" else word

    def declaring(self) -> bool:
        """Whether declarations stand here, not statements."""
        return not self.stack or self.stack[-1] in SECTIONS or self.stack[-1] in ("STRUCT", "UNION")


def _closes(entry: str, opener: str) -> bool:
    return entry == opener or (entry == _LAST_BRANCH and opener == "CASE")


def _values_of_types(lexed: Lexed) -> frozenset[int]:
    """Tokens `<` and `>` around the values of generic constants, as in `ring : FB_Ring<20>`."""
    kinds, texts = lexed.kinds, lexed.texts
    found: set[int] = set()
    for start in (number for number, kind in enumerate(kinds) if kind == "<" and number > 1):
        before = start - 1
        while before > 1 and kinds[before - 1] == ".":
            before -= 2
        named = kinds[before] is ID and kinds[start - 1] is ID
        if not named or (
            kinds[before - 1] not in (":", "OF", "TO") and texts[before - 1].upper() != "EXTENDS"
        ):
            continue
        depth, at = 0, start + 1
        while kinds[at] not in (END, ";") and (depth or kinds[at] != ">"):
            depth += (kinds[at] == "(") - (kinds[at] == ")")
            at += 1
        if kinds[at] == ">":
            found |= {start, at}
    return frozenset(found)


def _trivia(item: Trivia) -> _Piece:
    span = item.span
    return _Piece(item.kind, item.text, span.line, span.column, span.end_line, span.end_column, -1)
