"""What reads IEC texts finds the same words, literals, comments, pragmas and sections in every text."""

import re

from hypothesis import example, given, settings
from iec_texts import TEXTS

from tappet.iec.sections import declaration_end
from tappet.iec.tokens import ADDRESS, COMMENT, NUMBER, PRAGMA, STRING, WORD, Piece, code_of, pieces, words
from tappet.iec.words import GENERIC_SECTION, KEYWORDS, SECTIONS
from tappet.lang.lexer import END, ID, INT, lex

_LINE_END = re.compile(r"\r\n|\n|\r")
_KINDS = {ID: WORD, INT: NUMBER, NUMBER: NUMBER, STRING: STRING, ADDRESS: ADDRESS}


def of_compiler(text: str) -> list[Piece]:
    """Words, literals, addresses and trivia as the compiler's lexer has them."""
    starts = [0, *(mark.end() for mark in _LINE_END.finditer(text))]
    lexed = lex(text, "text")
    found: list[Piece] = []
    for index, kind in enumerate(lexed.kinds):
        for item in lexed.trivia.get(index, ()):
            start = starts[item.span.line] + item.span.column
            end = starts[item.span.end_line] + item.span.end_column
            assert text[start:end] == item.text
            found.append(Piece(item.kind, item.text, start, end))
        if kind is not END and (kind in _KINDS or kind in KEYWORDS):
            start = starts[lexed.lines[index]] + lexed.columns[index]
            piece = lexed.texts[index]
            found.append(Piece(_KINDS.get(kind, WORD), piece, start, start + len(piece)))
    return found


def shape(found: list[Piece]) -> list[tuple[str, int]]:
    return [(piece.kind, piece.start) for piece in found]


@given(TEXTS)
@example("x²")
@example("²")
@example("'$\n'a'")
@example("//\r x")
@example("/*\r")
@example("(* a\r")
@example("{attribute '}'}")
@example("STRING#'a' INT#5 16#FF %IX0.1")
@settings(max_examples=400)
def test_the_compiler_and_the_project_read_the_same_pieces(text: str) -> None:
    counting = (WORD, NUMBER, STRING, ADDRESS, COMMENT, PRAGMA)
    mine = [piece for piece in pieces(text) if piece.kind in counting]
    theirs = of_compiler(text)
    assert shape(mine) == shape(theirs)
    for own, other in zip(mine, theirs, strict=True):
        assert own.text == other.text or own.kind == STRING  # the compiler adds the quote that is missing


@given(TEXTS)
@settings(max_examples=200)
def test_pieces_and_blanks_are_the_text(text: str) -> None:
    position = 0
    for piece in pieces(text):
        assert text[position : piece.start].strip() == ""
        assert text[piece.start : piece.end] == piece.text != ""
        position = piece.end
    assert text[position:].strip() == ""


@given(TEXTS)
@settings(max_examples=200)
def test_code_is_what_is_no_comment_and_no_string(text: str) -> None:
    expected = "".join(
        piece.text for piece in pieces(text) if piece.kind not in (COMMENT, STRING) and not _typed(piece)
    )
    assert "".join(code_of(text).split()) == "".join(expected.split()) or "#'" in text or '#"' in text


def _typed(piece: Piece) -> bool:
    return piece.kind == NUMBER and piece.text[-1] in "'\""


@given(TEXTS)
@settings(max_examples=300)
def test_a_section_ends_where_its_word_stands(text: str) -> None:
    """Against the words one by one; `END_VAR` that touches an address or a prefix is none."""
    if re.search(r"[\w#%]END_VAR|END_VAR[\w#]", text):
        return
    text = f"PROGRAM P\nVAR {text}"
    end = None
    inside = ""
    for word in words(text, text.index("VAR")):
        if inside:
            if word.text == "END_VAR":
                inside, end = "", word.end
        elif word.text in SECTIONS:
            inside = word.text
        elif end is not None:
            break
    if GENERIC_SECTION in text.upper():
        return
    if inside:
        assert declaration_end(text) == len(text)
    else:
        assert end is not None
        found = declaration_end(text)
        assert found >= end
        assert all(piece.kind in (COMMENT, PRAGMA) for piece in pieces(text[end:found]))
