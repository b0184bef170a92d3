"""Text to tokens, by one compiled expression; comments and pragmas are set aside as trivia.

`lex` gives the parallel lists the parser reads, `tokenize` one list of everything for tools such as the
highlighter and the formatter. Both accept any text: what is no token is reported and left out.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final, NamedTuple

from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.source import Source, Span

ID: Final = "id"
INT: Final = "int"  # plain decimal digits: a number, or the bit of `x.3`
NUMBER: Final = "number"  # every other numeric, time, date or typed literal
STRING: Final = "string"
ADDRESS: Final = "address"
END: Final = "end"  # after the last token
COMMENT: Final = "comment"
PRAGMA: Final = "pragma"

_WORDS = """
    PROGRAM END_PROGRAM FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK METHOD END_METHOD
    ACTION END_ACTION TRANSITION END_TRANSITION PROPERTY END_PROPERTY END_GET END_SET INTERFACE END_INTERFACE
    TYPE END_TYPE STRUCT END_STRUCT UNION END_UNION
    VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_GLOBAL VAR_TEMP VAR_STAT VAR_INST VAR_EXTERNAL VAR_CONFIG
    VAR_ACCESS VAR_GENERIC END_VAR CONSTANT RETAIN NON_RETAIN PERSISTENT
    AT ARRAY OF POINTER REFERENCE TO
    IF THEN ELSIF ELSE END_IF CASE END_CASE FOR DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT
    EXIT CONTINUE RETURN JMP __TRY __CATCH __FINALLY __ENDTRY
    AND OR XOR NOT MOD AND_THEN OR_ELSE TRUE FALSE NULL THIS SUPER PARAMS
"""
KEYWORDS: Final = frozenset(_WORDS.split())
"""Words with a fixed meaning in declarations and ST. Others (GET, PUBLIC, BY) count by their place only."""

_TOKEN = re.compile(
    r"""[^\S\r\n]*+(
      [^\W\d]\w*+(?!\#)
    | [;,)\[\]^+&-] | := | \(\*(?:[^*(]++|\*(?!\))|\((?!\*))*+\*\) | \(\*?+
    | \r?\n | \r
    | \d\w*+(?:\#\w*+|(?:\.\d\w*+)?+(?:(?<=\d[eE])[+-]\d\w*+)?+)
    | \.\.?+ | :
    | //[^\r\n]*+ | /\*[^*]*+(?:\*(?!/)[^*]*+)*+(?:\*/)?+ | /
    | '(?:[^'$\r\n]|\$[^\r\n])*+\$?+'?+ | "(?:[^"$\r\n]|\$[^\r\n])*+\$?+"?+
    | => | = | <= | <> | < | >= | > | \*\*?+
    | \{(?:[^{}'"\r\n]|'[^'\r\n]*+'|"[^"\r\n]*+")*+\}
    | \{\s*+(?i:attribute)\b(?:[^{}'"\r\n]|[\r\n]\s*+(?=['":}])|'[^']*+'|"[^"]*+")*+\}
    | \{\s*+(?i:attribute)\s*+'[^'\r\n]*+'\s*+:=\s*+'[^{}]*+(?<=['\s])\} | \{[^}\r\n]*+\}?+
    | (?i:L?(?:D|DT|DATE|TOD|TIME_OF_DAY|DATE_AND_TIME))\#\d\w*+(?:[-:]\d\w*+)*+(?:\.\d\w*+)?+
    | [^\W\d]\w*+\#(?:
          [+-]?+\d\w*+(?:\#\w*+|(?:\.\d\w*+)?+(?:(?<=\d[eE])[+-]\d\w*+)?+)
        | '(?:[^'$\r\n]|\$[^\r\n])*+\$?+'?+ | "(?:[^"$\r\n]|\$[^\r\n])*+\$?+"?+
        | \w*+ )
    | %[A-Za-z]*+(?:\*|\d++(?:\.\d++)*+)?+
    | \S
    )""",
    re.VERBOSE,
)
_COMMENT_MARK = re.compile(r"\(\*|\*\)")
_MANY_LINES = {
    quote: re.compile(rf"({quote}(?:\$[^\r\n]|[^{quote}$]){{0,32767}}{quote})[ \t]*(?=[;,)\]+=<>:]|\r?\n|$)")
    for quote in "'\""
}
_LINE_END = re.compile(r"\r\n|\n|\r")

_NEWLINE: Final = "newline"
_SPECIAL: Final = "special"
_OPERATORS = "; , ( ) [ ] ^ + - & := .. . : / => = <= <> < >= > * **"
_BASE_KINDS: dict[str, str] = {op: op for op in _OPERATORS.split()} | {word: word for word in KEYWORDS}
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
        for match in _TOKEN.finditer(text, position):
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
            end, line, line_start = _special(out, text, uri, start, match.end(), line, line_start)
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
    return out


def _classify(piece: str) -> str:
    first = piece[0]
    if first.isdigit():
        return INT if piece.isdecimal() and piece.isascii() else NUMBER
    if first == "_" or first.isalnum():
        if "#" in piece:
            return NUMBER
        upper = piece.upper()
        if upper in KEYWORDS:
            return upper if piece.isascii() else _SPECIAL
        return ID if piece.isascii() else _SPECIAL
    if first in "'\"":
        return STRING if len(piece) > 1 and _closed(piece) else _SPECIAL
    if first == "%" and len(piece) > 1:
        return ADDRESS
    return _SPECIAL


def _closed(string: str) -> bool:
    """Whether the last quote of a string closes it, rather than being escaped by an odd number of `$`."""
    if string[-1] != string[0]:
        return False
    body = string[1:-1]
    return (len(body) - len(body.rstrip("$"))) % 2 == 0


def _special(
    out: Lexed, text: str, uri: str, start: int, end: int, line: int, line_start: int
) -> tuple[int, int, int]:
    """Take a comment, a pragma or a faulty piece; returns where to go on, and the line there."""
    piece = text[start:end]
    column = start - line_start
    index = len(out.kinds)
    if piece == "(*":
        end = _nested_comment_end(text, end)
    if piece.startswith(("(*", "//", "/*", "{")):
        piece = text[start:end].removesuffix("\n") if end == len(text) else text[start:end]
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
        closed = piece.startswith("//") or (
            len(piece) > 3 and piece.endswith("*)" if piece[0] == "(" else "*/")
        )
        if not closed or (piece[0] == "(" and _open_comments(piece)):
            out.unclosed_comment = True
            place = Span(line, column, line, column + 2)
            mark_text = "*)" if piece[0] == "(" else "*/"
            out.diagnostics.append(report("E0002", uri, place, mark=mark_text))
        return end, end_line, end_start
    span = Span(line, column, line, column + len(piece))
    if piece[0] in "'\"":
        whole = _string_over_lines(text, start)
        if whole:
            _append(out, STRING, whole, line, column)
            last_break = max(whole.rfind("\n"), whole.rfind("\r"))
            breaks = len(_LINE_END.findall(whole))
            return start + len(whole), line + breaks, start + last_break + 1
        out.diagnostics.append(report("E0004", uri, span, quote=piece[0]))
        _append(out, STRING, piece.rstrip("$") + piece[0], line, column)
        out.damaged.add(index + 1)
    elif piece[0] == "_" or piece[0].isalnum():
        wrong = next(char for char in piece if not char.isascii())
        out.diagnostics.append(report("E0005", uri, span, name=piece, char=wrong))
        _append(out, ID, piece, line, column)
    else:
        _unexpected(out, uri, span, piece)
    return end, line, line_start


def _string_over_lines(text: str, start: int) -> str:
    """The string that begins at `start` and ends on a later line, '' where a quote is missing rather.

    A quote is taken as the end when what follows can follow a string, and the first line does not end like a
    statement: without its end, a string would go on to the begin of the next one.
    """
    match = _MANY_LINES[text[start]].match(text, start)
    if match is None or match[0].partition("\n")[0].rstrip().endswith(";"):
        return ""
    return match[1]


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


def _nested_comment_end(text: str, position: int) -> int:
    """End of the comment whose opening mark ends at `position`; the end of the text if it is not closed."""
    depth = 1
    for mark in _COMMENT_MARK.finditer(text, position):
        depth += 1 if mark[0] == "(*" else -1
        if depth == 0:
            return mark.end()
    return len(text)


def _open_comments(piece: str) -> bool:
    depth = 0
    for mark in _COMMENT_MARK.finditer(piece):
        depth += 1 if mark[0] == "(*" else -1
    return depth > 0


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
