"""Faulty statements: one message each, at the right place, and everything else stays in the tree."""

from __future__ import annotations

import pytest
from st_text import codes, statements

from tappet.lang import ast
from tappet.lang.parser import parse
from tappet.lang.source import Source


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("a += 5;", "There is no '+='; write x := x + y."),
        ("a *= 5;", "There is no '*='; write x := x * y."),
        ("a++;", "There is no '++'; write x := x + 1."),
        ("a--;", "There is no '--'; write x := x - 1."),
        ("a == 5;", "Comparison is '=', assignment is ':='."),
        ("a := b +;", "Write a value or a variable."),
    ],
)
def test_operators_of_other_languages(text: str, advice: str) -> None:
    (message,) = parse(Source("P", f"PROGRAM P\n{text}\nEND_PROGRAM")).diagnostics
    assert message.advice == advice


@pytest.mark.parametrize(
    ("code", "expected", "kept"),
    [
        ("a := ;\nb := 1;", ["2:6 E0104"], "a := ?; b := 1;"),
        ("a := 1\nb := 2;", ["2:6 E0101"], "a := 1; b := 2;"),
        ("a()\nb();", ["2:3 E0101"], "a(); b();"),
        ("a := (1 + 2;\nb := 2;", ["2:12 E0101"], "a := (1 + 2); b := 2;"),
        ("a := b[1;\nb := 2;", ["2:9 E0101"], "a := b[1]; b := 2;"),
        ("a := 1);\nb := 2;", ["2:7 E0101"], "a := 1; b := 2;"),
        ("a := b c;\nd := 2;", ["2:8 E0101"], "a := b; d := 2;"),
        ("x y;\nd := 2;", ["2:3 E0101"], "x; d := 2;"),
        ("fb(\nb := 2;\nc := 3;", ["3:7 E0101"], "fb(b := 2); c := 3;"),
        ("a.\nb := 2;\nc := 3;", [], "a.b := 2; c := 3;"),
        ("a. ;\nb := 2;", ["2:4 E0109"], "a.; b := 2;"),
        ("a += 5;\nb := 2;", ["2:4 E0104"], "((a + ?) = 5); b := 2;"),
        ("a++;\nb := 2;", ["2:4 E0104"], "(a + (+ ?)); b := 2;"),
        ("a == 5;\nb := 2;", ["2:4 E0104"], "((a = ?) = 5); b := 2;"),
        ("a := b | c;\nb := 2;", ["2:8 E0001"], "a := b; b := 2;"),
        ("a := 'abc;\nb := 2;", ["2:6 E0004"], "a := 'abc;'; b := 2;"),
        ("a := 5；\nb := 2;", ["2:7 E0001"], "a := 5; b := 2;"),
        (") a := 2;\nb := 2;", ["2:1 E0102"], "; b := 2;"),
        ("THEN a := 1;\nb := 2;", ["2:1 E0102"], "; a := 1; b := 2;"),
        ("IF a THEN b();", ["3:1 E0103"], "IF a THEN b(); END_IF"),
        ("IF a THEN IF b THEN IF c THEN d();", ["3:1 E0103"], None),
        (
            "WHILE x DO IF a THEN b(); END_WHILE c();",
            ["2:27 E0103"],
            "WHILE x DO IF a THEN b(); END_IF END_WHILE c();",
        ),
        ("IF a THEN b(); END_WHILE c();", ["2:16 E0110"], "IF a THEN b(); END_IF c();"),
        ("IF THEN b(); END_IF c();", ["2:4 E0104"], "IF ? THEN b(); END_IF c();"),
        ("IF a\n b();\nEND_IF c();", ["2:4 E0101"], "IF a THEN b(); END_IF c();"),
        ("IF a THEM\n b();\nEND_IF c();", ["2:6 E0101"], None),
        ("IFF a = 1 THEN\n b();\nELSE d();\nEND_IF c();", ["2:5 E0101"], "IFF; b(); d(); c();"),
        ("IF a THEN b(); END_IF ELSE d(); END_IF c();", ["2:23 E0106"], "IF a THEN b(); END_IF d(); c();"),
        ("IF a THEN ELSE b(); ELSE c(); END_IF", ["2:21 E0106"], "IF a THEN  ELSE b(); c(); END_IF"),
        ("IF a THEN ELSE b(); ELSIF x THEN c(); END_IF", ["2:21 E0106"], "IF a THEN  ELSE b(); c(); END_IF"),
        ("END_IF c();", ["2:1 E0106"], "c();"),
        ("END_VAR c();", ["2:1 E0106"], "c();"),
        ("ELSE c(); END_IF", ["2:1 E0106"], "c();"),
        ("FOR i = 1 TO 5 DO b(); END_FOR c();", ["2:7 E0101"], None),
        ("FOR i := 1 DO b(); END_FOR c();", ["2:12 E0101"], None),
        ("FOR i := 1 TO 5 b(); END_FOR c();", ["2:17 E0101"], "FOR i := 1 TO 5 DO b(); END_FOR c();"),
        ("WHILE a b(); END_WHILE c();", ["2:9 E0101"], "WHILE a DO b(); END_WHILE c();"),
        ("REPEAT a(); END_REPEAT c();", ["2:13 E0101"], "REPEAT a(); UNTIL ? END_REPEAT c();"),
        ("CASE x OF a(); 1: b(); END_CASE c();", ["2:11 E0101"], None),
        ("CASE x OF 1, : b(); END_CASE c();", ["2:14 E0104"], "CASE x OF 1, ?: b(); END_CASE c();"),
        ("CASE x OF 1 b(); 2: d(); END_CASE c();", None, None),
        ("CASE x OF 1: ELSE b(); ELSE d(); END_CASE c();", ["2:24 E0106"], None),
        ("CASE x OF 1: b(); END_IF c();", ["2:19 E0110"], "CASE x OF 1: b(); END_CASE c();"),
        ("RETURN\nb();", ["2:6 E0101"], "RETURN; b();"),
        ("JMP ;\nb();", ["2:5 E0109"], "JMP ; b();"),
        ("a := 16#G1;\nb();", ["2:6 E0010"], "a := 16#G1; b();"),
    ],
)
def test_one_mistake_gives_one_message(code: str, expected: list[str] | None, kept: str | None) -> None:
    result = parse(Source("PLC_PRG", f"PROGRAM PLC_PRG\n{code}\nEND_PROGRAM\nPROGRAM Next END_PROGRAM"))
    if expected is None:
        assert len(result.diagnostics) == 1
    else:
        assert codes(result.diagnostics) == expected
    first, second = result.unit.declarations
    assert isinstance(first, ast.Pou)
    assert second.name == "Next"
    if kept is not None:
        assert statements(first.body) == kept


def test_message_names_what_is_open_and_what_was_found() -> None:
    text = (
        "PROGRAM PLC_PRG\nVAR a : BOOL; END_VAR\n\n\n\n\n\nIF a THEN\n  a := FALSE;\n\n\n        END_PROGRAM"
    )
    (message,) = parse(Source("PLC_PRG", text)).diagnostics
    assert str(message) == (
        "PLC_PRG:12:9: error E0103: END_IF expected for the IF of line 8 before END_PROGRAM. "
        "Close the IF with END_IF."
    )


def test_a_line_named_in_a_message_is_the_one_the_editor_shows() -> None:
    text = "PROGRAM PLC_PRG\nVAR\nEND_VAR\n\nIF TRUE THEN\n\nEND_PROGRAM"
    (message,) = parse(Source("PLC_PRG", text, body_line=3)).diagnostics
    assert message.message == "END_IF expected for the IF of line 2 before END_PROGRAM"


def test_mistakes_of_several_statements_are_all_told() -> None:
    text = "PROGRAM p\na := ;\nb := 1 2;\nIF THEN END_IF\nc( ;\nEND_PROGRAM"
    assert codes(parse(Source("p", text)).diagnostics) == ["2:6 E0104", "3:8 E0101", "4:4 E0104", "5:4 E0104"]


def test_messages_come_in_the_order_of_the_text() -> None:
    text = "PROGRAM p\na := ;\nb := ?;\nc := 'x;\nEND_PROGRAM"
    places = [d.span[:2] for d in parse(Source("p", text)).diagnostics]
    assert places == sorted(places)
    assert len(places) == 3
