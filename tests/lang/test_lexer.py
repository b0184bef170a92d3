"""Tokens, comments and pragmas with their places."""

from __future__ import annotations

import pytest
from st_text import codes

from tappet.iec.words import KEYWORDS
from tappet.lang.lexer import COMMENT, PRAGMA, lex, tokenize
from tappet.lang.source import Source, Span


def kinds(text: str) -> list[str]:
    return [token.kind for token in tokenize(Source("x", text))]


def texts(text: str) -> list[str]:
    return [token.text for token in tokenize(Source("x", text))]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:=b;", ["id", ":=", "id", ";"]),
        ("IF x THEN", ["IF", "id", "THEN"]),
        ("if End_If eND_vAR", ["IF", "END_IF", "END_VAR"]),
        ("a<=b>=c<>d=e=>f", ["id", "<=", "id", ">=", "id", "<>", "id", "=", "id", "=>", "id"]),
        ("a**b*c", ["id", "**", "id", "*", "id"]),
        ("1..5", ["int", "..", "int"]),
        ("1.5..2.5", ["number", "..", "number"]),
        ("a.3", ["id", ".", "int"]),
        ("x.y.z", ["id", ".", "id", ".", "id"]),
        ("16#FF 2#1010 8#17 1_000", ["number", "number", "number", "number"]),
        ("1e5 1.0E-3 1.64e+009", ["number", "number", "number"]),
        ("INT#-5 REAL#1.5e-3 WORD#16#FF", ["number", "number", "number"]),
        ("INT#5-3", ["number", "-", "int"]),
        ("16#1E-3", ["number", "-", "int"]),
        ("T#5s T#1h30m t#14ms LTIME#1us", ["number"] * 4),
        ("TOD#12:00:00: x", ["number", ":", "id"]),
        ("DT#1996-05-06-15:36:30-x", ["number", "-", "id"]),
        ("D#1996-05-06-1", ["number"]),
        ("'abc' \"w\" STRING#'x'", ["string", "string", "number"]),
        ("'$'' '$$'", ["string", "string"]),
        ("%IX0.0 %QW* %M5*2", ["address", "address", "address", "*", "int"]),
        ("E_Mode#Auto", ["number"]),
        ("AND_THEN OR_ELSE & ^", ["AND_THEN", "OR_ELSE", "&", "^"]),
        ("get Set PUBLIC extends by", ["id"] * 5),
        ("__TRY __NEW", ["__TRY", "id"]),
    ],
)
def test_kinds(text: str, expected: list[str]) -> None:
    assert kinds(text) == expected


@pytest.mark.parametrize("word", sorted(KEYWORDS - {"ACTION", "TRANSITION", "PARAMS"}))
def test_keywords_are_recognised_in_any_case(word: str) -> None:
    assert kinds(f"{word} {word.lower()} {word.title()} {word}x") == [word, word, word, "id"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ACTION Run:", ["ACTION", "id", ":"]),
        ("END_IF; ACTION PRIVATE Run", ["END_IF", ";", "ACTION", "id", "id"]),
        ("x := ACTION y", ["id", ":=", "id", "id"]),
        ("ACTION := TRANSITION;", ["id", ":=", "id", ";"]),
        (
            "IF ACTION THEN TRANSITION.a[PARAMS] S= b;",
            ["IF", "id", "THEN", "id", ".", "id", "[", "id", "]", "id", "=", "id", ";"],
        ),
        ("CASE PARAMS OF PARAMS OF INT", ["CASE", "id", "OF", "PARAMS", "OF", "id"]),
        ("ACTION : INT; TRANSITION, PARAMS : INT;", ["id", ":", "id", ";", "id", ",", "id", ":", "id", ";"]),
        ("TRANSITION FROM a TO b := NULL;", ["TRANSITION", "id", "id", "TO", "id", ":=", "id", ";"]),
        ("TRANSITION (PRIORITY := 1) FROM", ["TRANSITION", "(", "id", ":=", "int", ")", "id"]),
        ("ACTION AND TRANSITION", ["id", "AND", "id"]),
    ],
)
def test_words_of_charts_are_names_where_they_begin_nothing(text: str, expected: list[str]) -> None:
    assert kinds(text) == expected


@pytest.mark.parametrize(
    ("text", "trivia"),
    [
        ("(* a *) x", ["(* a *)"]),
        ("(* a (* b *) c *) x", ["(* a (* b *) c *)"]),
        ("(* a (* b *) c (* d (* e *) *) *) x", ["(* a (* b *) c (* d (* e *) *) *)"]),
        ("(**) x (***) y (*)*) z", ["(**)", "(***)", "(*)*)"]),
        ("// one\nx // two", ["// one", "// two"]),
        ("x (* // *) y // (* z", ["(* // *)", "// (* z"]),
        ("/* a * b */ x", ["/* a * b */"]),
        ("{attribute 'a' := '}'} x", ["{attribute 'a' := '}'}"]),
        ("{IF defined (x)}\nx\n{END_IF}", ["{IF defined (x)}", "{END_IF}"]),
        ("{text don't} x", ["{text don't}"]),
        ("'(* no comment *)' x", []),
        ("a / b", []),
    ],
)
def test_comments_and_pragmas(text: str, trivia: list[str]) -> None:
    tokens = tokenize(Source("x", text))
    assert [t.text for t in tokens if t.kind in (COMMENT, PRAGMA)] == trivia
    assert lex(text, "x").diagnostics == []


def test_places_of_tokens_and_comments() -> None:
    text = "a :=\r\n  (* one\r\n two *) bc;\n\td"
    assert [(t.text, t.span) for t in tokenize(Source("x", text))] == [
        ("a", Span(0, 0, 0, 1)),
        (":=", Span(0, 2, 0, 4)),
        ("(* one\r\n two *)", Span(1, 2, 2, 7)),
        ("bc", Span(2, 8, 2, 10)),
        (";", Span(2, 10, 2, 11)),
        ("d", Span(3, 1, 3, 2)),
    ]


@pytest.mark.parametrize(
    ("text", "place"),
    [("", (0, 0)), ("a", (0, 1)), ("a\n", (1, 0)), ("a\n  ", (1, 2)), ("a\r", (1, 0)), ("(* x\n", (1, 0))],
)
def test_end_stands_behind_the_last_character(text: str, place: tuple[int, int]) -> None:
    lexed = lex(text, "x")
    assert (lexed.lines[-1], lexed.columns[-1]) == place


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a := 5；", ["1:7 E0001"]),
        ("a ! b", ["1:3 E0001"]),
        ("§§§§ a", ["1:1 E0001"]),
        ("\x00", ["1:1 E0001"]),
        ("x (* never closed", ["1:3 E0002"]),
        ("x (* outer (* inner *) ", ["1:3 E0002"]),
        ("/* open", ["1:1 E0002"]),
        ("{attribute 'x'\ny", ["1:1 E0003"]),
        ("'abc\nx", ["1:1 E0004"]),
        ("'abc$'\nx", ["1:1 E0004"]),
        ("'abc$\nx", ["1:1 E0004"]),
        ("Größe := 1;", ["1:1 E0005"]),
    ],
)
def test_what_is_no_token_is_reported_once(text: str, expected: list[str]) -> None:
    assert codes(lex(text, "x").diagnostics) == expected


@pytest.mark.parametrize("text", ["'", "'abc", "'abc$'", "'abc$", '"abc'])
def test_a_string_without_end_goes_to_the_end_of_its_line(text: str) -> None:
    lexed = lex(f"{text}\nx", "x")
    assert lexed.texts[:2] == [text, "x"]
    assert [d.span for d in lexed.diagnostics] == [Span(0, 0, 0, len(text))]


def test_an_attribute_may_go_over_several_lines_as_twincat_tools_write_it() -> None:
    text = "{attribute 'note' := '\n  a: {b}\n  c: d\n'}\nx : INT; {attribute 'y' :=\n 'z'\n}\ny"
    lexed = lex(text, "x")
    assert not lexed.diagnostics
    assert lexed.kinds == ["id", ":", "id", ";", "id", "end"]
    assert [item.text[:16] for item in lexed.trivia[0]] == ["{attribute 'note"]
    assert (lexed.lines[0], lexed.columns[0]) == (4, 0)
    assert (lexed.lines[4], lexed.columns[4]) == (7, 0)


def test_an_apostrophe_in_a_long_attribute_does_not_end_it() -> None:
    lexed = lex("{attribute 'note' := '\n  a: it's so\n'}\nx", "x")
    assert not lexed.diagnostics
    assert (lexed.kinds, lexed.lines[0]) == (["id", "end"], 3)


def test_full_width_characters_are_read_as_what_they_look_like() -> None:
    assert kinds("a：=（1）；") == ["id", ":", "=", "(", "int", ")", ";"]


def test_tokens_cover_the_text_in_order() -> None:
    text = "PROGRAM p (* c *) {x}\nVAR a : INT := 16#F; END_VAR // e\na := 'q' + %IW3;\nEND_PROGRAM"
    rest = text
    for piece in texts(text):
        before, found, rest = rest.partition(piece)
        assert found
        assert before.strip() == ""
    assert rest == ""
