"""Text to tokens, by the expression of `iec.tokens`; comments and pragmas are set aside as trivia.

`lex` gives the parallel lists the parser reads, `tokenize` one list of everything for tools such as the
highlighter and the formatter. Both accept any text: what is no token is reported and left out.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final, NamedTuple

from tappet.iec import tokens
from tappet.iec.literals import quoted_is_closed
from tappet.iec.tokens import TOKEN, TRIVIA, WORD, extent, kind_of
from tappet.iec.trivia import block_comment_end
from tappet.iec.words import KEYWORDS, OPERATORS
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import Source, Span

ID: Final = "id"
INT: Final = "int"  # plain decimal digits: a number, or the bit of `x.3`
END: Final = "end"  # after the last token
NUMBER, STRING, ADDRESS = tokens.NUMBER, tokens.STRING, tokens.ADDRESS
COMMENT, PRAGMA = tokens.COMMENT, tokens.PRAGMA

_WORDS_BY_PLACE: Final = ("ACTION", "TRANSITION", "PARAMS")
"""Keywords that are names like any other where they begin nothing: variables of other systems have them."""
_BEFORE_OPERAND: Final = frozenset(
    [
        ".",
        ":=",
        "?=",
        ",",
        "(",
        "[",
        "=>",
        "=",
        "<>",
        "<",
        ">",
        "<=",
        ">=",
        "+",
        "-",
        "*",
        "/",
        "**",
        "&",
        "..",
        "AND",
        "OR",
        "XOR",
        "NOT",
        "MOD",
        "AND_THEN",
        "OR_ELSE",
        "OF",
        "IF",
        "ELSIF",
        "WHILE",
        "UNTIL",
        "CASE",
        "FOR",
        "TO",
    ]
)
"""Behind these no object begins."""
_BEHIND_OPERAND: Final = frozenset(
    [
        "AND",
        "OR",
        "XOR",
        "MOD",
        "AND_THEN",
        "OR_ELSE",
        "THEN",
        "DO",
        "OF",
        "TO",
        "AT",
        "END_IF",
        "END_CASE",
        "END_FOR",
        "END_WHILE",
        "END_REPEAT",
    ]
)
"""Keywords that follow an operand."""

_LINE_END = re.compile(r"\r\n|\n|\r")

_NEWLINE: Final = "newline"
_SPECIAL: Final = "special"
_BASE_KINDS: dict[str, str] = {op: op for op in OPERATORS} | {word: word for word in KEYWORDS}
_BASE_KINDS |= {"\n": _NEWLINE, "\r\n": _NEWLINE, "\r": _NEWLINE, "(*": _SPECIAL}

_FULL_WIDTH = {chr(0xFF01 + n): chr(0x21 + n) for n in range(94)} | {
    "。": ".",
    "、": ",",
    "【": "[",
    "】": "]",
}
_QUOTES = {"‘": "'", "’": "'", "“": '"', "”": '"', "＇": "'", "＂": '"'}
_HINTS = {
    "!": "Write NOT for a negation and <> for 'not equal'.",
    "|": "Write OR.",
    "~": "Write NOT.",
    "?": "Write SEL(condition, else_value, then_value).",
    "#": "A type stands before '#', as in INT#5 or T#10ms.",
    "}": "A pragma begins with '{'.",
    "\\": "Divide with '/'.",
}


class Trivia(NamedTuple):
    """A comment or pragma with its marks, and where it stands."""

    kind: str
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Token:
    """One token, comment or pragma. `kind` is the operator or upper-case keyword itself, or one of above."""

    kind: str
    text: str
    span: Span


class Lexed:
    """Tokens as parallel lists ending with END; `trivia[i]` holds the comments and pragmas before token i."""

    __slots__ = ("columns", "damaged", "diagnostics", "kinds", "lines", "texts", "trivia", "unclosed_comment")

    def __init__(self) -> None:
        self.kinds: list[str] = []
        self.texts: list[str] = []
        self.lines: list[int] = []
        self.columns: list[int] = []
        self.trivia: dict[int, list[Trivia]] = {}
        self.diagnostics: list[Diagnostic] = []
        self.damaged: set[int] = set()
        """Tokens before which something unreadable was left out: an error there is no error of its own."""
        self.unclosed_comment = False
        """Whether the rest of the text went into a comment: then missing ends are no error of their own."""


def lex(text: str, uri: str) -> Lexed:
    """Split `text` into tokens; `uri` names it in the diagnostics. Linear in the length of the text."""
    out = Lexed()
    kinds, texts, lines, columns = out.kinds, out.texts, out.lines, out.columns
    known = _BASE_KINDS.copy()
    lookup = known.get
    line = line_start = position = 0
    last = len(text)
    text += " \n" if text.endswith("\r") else "\n"  # so that blanks at the end belong to a match
    size = len(text)
    while position < size:
        for match in TOKEN.finditer(text, position):
            piece = match[1]
            kind = lookup(piece)
            if kind is _NEWLINE:
                line += 1
                line_start = match.end()
                continue
            start = match.start(1)
            if kind is None:
                kind = _classify(piece)
                if kind is not _SPECIAL:
                    known[piece] = kind
            if kind is not _SPECIAL:
                kinds.append(kind)
                texts.append(piece)
                lines.append(line)
                columns.append(start - line_start)
                continue
            end, line, line_start = _special(out, text, last, uri, start, match.end(), line, line_start)
            if end != match.end():
                position = end
                break
        else:
            break
    kinds.append(END)
    texts.append("")
    if last < line_start:  # the added line end was the last token
        line -= 1
        line_start = max(text.rfind("\n", 0, last), text.rfind("\r", 0, last)) + 1
    lines.append(line)
    columns.append(last - line_start)
    for word in _WORDS_BY_PLACE:
        if word in kinds:
            _free_names(kinds, texts, word)
    return out


def _free_names(kinds: list[str], texts: list[str], word: str) -> None:
    """Makes identifiers of the places of a keyword where it begins nothing."""
    for i, kind in enumerate(kinds):
        if kind == word and not _begins_construct(kinds, texts, i):
            kinds[i] = ID


def _begins_construct(kinds: list[str], texts: list[str], i: int) -> bool:
    following = kinds[i + 1]
    if kinds[i] == "PARAMS":
        return following == "OF" and kinds[i - 1] != "CASE"
    if i and kinds[i - 1] in _BEFORE_OPERAND:
        return False
    if following == "(":  # TRANSITION (PRIORITY := 1) FROM
        return kinds[i] == "TRANSITION" and texts[i + 2].upper() == "PRIORITY"
    if following is ID:
        return not (kinds[i + 2] == "=" and texts[i + 1].upper() in ("S", "R", "REF"))
    return following in KEYWORDS and following not in _BEHIND_OPERAND


def _classify(piece: str) -> str:
    kind = kind_of(piece)
    if kind is WORD:
        upper = piece.upper()
        return _SPECIAL if not piece.isascii() else upper if upper in KEYWORDS else ID
    if kind is NUMBER:
        return INT if piece.isdecimal() and piece.isascii() else NUMBER
    if kind is STRING:
        return STRING if quoted_is_closed(piece) else _SPECIAL
    return ADDRESS if kind is ADDRESS else _SPECIAL


def _special(
    out: Lexed, text: str, last: int, uri: str, start: int, end: int, line: int, line_start: int
) -> tuple[int, int, int]:
    """Take a comment, a pragma or a faulty piece; returns where to continue, and the line there.

    `last` is where the text as it was written ends.
    """
    piece = text[start:end]
    column = start - line_start
    index = len(out.kinds)
    kind = kind_of(piece)
    closed = piece != "(*" or block_comment_end(text, start) is not None
    end = extent(text, piece, start)
    if kind in TRIVIA:
        piece = text[start : min(end, last)]
        end_line, end_start = line, line_start
        for mark in _LINE_END.finditer(piece):
            end_line += 1
            end_start = start + mark.end()
        span = Span(line, column, end_line, start + len(piece) - end_start)
        if piece[0] == "{":
            out.trivia.setdefault(index, []).append(Trivia(PRAGMA, piece, span))
            if piece[-1] != "}":
                out.diagnostics.append(report("E0003", uri, span))
            return end, end_line, end_start
        out.trivia.setdefault(index, []).append(Trivia(COMMENT, piece, span))
        if not closed or (piece.startswith("/*") and not (len(piece) > 3 and piece.endswith("*/"))):
            out.unclosed_comment = True
            place = Span(line, column, line, column + 2)
            mark_text = "*)" if piece[0] == "(" else "*/"
            out.diagnostics.append(report("E0002", uri, place, mark=mark_text))
        return end, end_line, end_start
    span = Span(line, column, line, column + len(piece))
    if kind is STRING:
        whole = text[start:end]
        if whole != piece:
            _append(out, STRING, whole, line, column)
            last_break = max(whole.rfind("\n"), whole.rfind("\r"))
            breaks = len(_LINE_END.findall(whole))
            return end, line + breaks, start + last_break + 1
        out.diagnostics.append(report("E0004", uri, span, quote=piece[0]))
        _append(out, STRING, piece, line, column)
        out.damaged.add(index + 1)
    elif kind is WORD:
        wrong = next(char for char in piece if not char.isascii())
        out.diagnostics.append(report("E0005", uri, span, name=piece, char=wrong))
        _append(out, ID, piece, line, column)
    else:
        _unexpected(out, uri, span, piece)
    return end, line, line_start


def _unexpected(out: Lexed, uri: str, span: Span, char: str) -> None:
    plain = _QUOTES.get(char) or _FULL_WIDTH.get(char)
    if plain:
        hint = f"Write the plain character {plain}"
    elif char == "%":
        hint = "An address needs an area and a number, as in %IX0.0."
    else:
        hint = _HINTS.get(char, "Remove it.")
    shown = char if char.isprintable() else f"U+{ord(char):04X}"
    previous = out.diagnostics[-1] if out.diagnostics else None
    run = previous is not None and previous.code == "E0001" and previous.span.line == span.line
    if not run or plain:  # one message for a line of foreign characters
        out.diagnostics.append(report("E0001", uri, span, char=shown, hint=hint))
    kind = _BASE_KINDS.get(plain or "")
    if kind:  # read on as if it were right, so that one wrong key gives one message
        _append(out, kind, char, span.line, span.column)
    else:
        out.damaged.add(len(out.kinds))


def _append(out: Lexed, kind: str, text: str, line: int, column: int) -> None:
    out.kinds.append(kind)
    out.texts.append(text)
    out.lines.append(line)
    out.columns.append(column)


def tokenize(source: Source) -> list[Token]:
    """Every token, comment and pragma of the text in order, without the end mark."""
    lexed = lex(source.text, source.uri)
    out: list[Token] = []
    for index, kind in enumerate(lexed.kinds):
        out.extend(Token(*trivia) for trivia in lexed.trivia.get(index, ()))
        if kind is not END:
            line, column = lexed.lines[index], lexed.columns[index]
            text = lexed.texts[index]
            out.append(Token(kind, text, Span(line, column, line, column + len(text))))
    return out
