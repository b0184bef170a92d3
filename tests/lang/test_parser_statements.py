"""Statements of ST and extended ST."""

from __future__ import annotations

import pytest
from st_text import body_of, same, statements

from tappet.lang import ast
from tappet.lang.source import Span


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("a := b;", "a := b;"),
        ("a.b[1]^ := 2;", "a.b[1]^ := 2;"),
        ("a := b := 3;", "a := (b := 3);"),
        ("a S= b; a R= c; r REF= x; r REF= 0;", "a S= b; a R= c; r REF= x; r REF= 0;"),
        ("a := (x := 1, y := 2);", "a := (x := 1, y := 2);"),
        ("%QX0.0 := TRUE;", "%QX0.0 := TRUE;"),
        (".g := 1;", ".g := 1;"),
        ("fb(IN := a, Q => b);", "fb(IN := a, Q => b);"),
        ("inst.Action();", "inst.Action();"),
        ("SUPER^.M(); THIS^.x := 1; SUPER^();", "SUPER^.M(); THIS^.x := 1; SUPER^();"),
        ("p^(in1 := 1);", "p^(in1 := 1);"),
        ("AND(a, b);", "AND(a, b);"),
        ("a = b;", "(a = b);"),
        (";;", "; ;"),
        ("RETURN; EXIT; CONTINUE;", "RETURN; EXIT; CONTINUE;"),
        ("IF a THEN b := 1; END_IF", "IF a THEN b := 1; END_IF"),
        ("IF a THEN b := 1; END_IF;", "IF a THEN b := 1; END_IF"),
        ("IF a THEN ELSIF b THEN c(); ELSE d(); END_IF", "IF a THEN  ELSIF b THEN c(); ELSE d(); END_IF"),
        ("IF a THEN ELSE END_IF", "IF a THEN  ELSE  END_IF"),
        ("IF a THEN ELSE IF b THEN c(); END_IF END_IF", "IF a THEN  ELSE IF b THEN c(); END_IF END_IF"),
        ("IF b := (i = 1) THEN END_IF", "IF (b := (i = 1)) THEN  END_IF"),
        ("FOR i := 1 TO 5 DO a(); END_FOR", "FOR i := 1 TO 5 DO a(); END_FOR"),
        ("FOR i := 10 TO 1 BY -3 DO END_FOR;", "FOR i := 10 TO 1 BY (- 3) DO  END_FOR"),
        ("WHILE a < 3 DO a := a + 1; END_WHILE", "WHILE (a < 3) DO a := (a + 1); END_WHILE"),
        ("REPEAT a(); UNTIL b END_REPEAT", "REPEAT a(); UNTIL b END_REPEAT"),
        ("REPEAT a(); UNTIL b; END_REPEAT;", "REPEAT a(); UNTIL b END_REPEAT"),
        ("CASE x OF 1: a(); END_CASE", "CASE x OF 1: a(); END_CASE"),
        (
            "CASE x OF\n 1, 5: a(); b();\n 10..20: c();\n ELSE d(); END_CASE",
            "CASE x OF 1, 5: a(); b(); 10..20: c(); ELSE d(); END_CASE",
        ),
        (
            "CASE x OF Red: a := 1; E.Green, E.Blue: a := 2; LOW..HIGH: ; END_CASE",
            "CASE x OF Red: a := 1; E.Green, E.Blue: a := 2; LOW..HIGH: ; END_CASE",
        ),
        ("CASE x OF -1: a(); -5..-2: END_CASE", "CASE x OF (- 1): a(); (- 5)..(- 2):  END_CASE"),
        ("CASE x OF N + 1: a(); 16#FF: b(); END_CASE", "CASE x OF (N + 1): a(); 16#FF: b(); END_CASE"),
        ("CASE x OF T#1s: a(); 'x': b(); END_CASE", "CASE x OF T#1s: a(); 'x': b(); END_CASE"),
        ("CASE x OF E#Red: a(); END_CASE", "CASE x OF E.Red: a(); END_CASE"),
        (
            "CASE x OF 1: CASE y OF A: b(); END_CASE B: IF c THEN d: e(); END_IF END_CASE",
            "CASE x OF 1: CASE y OF A: b(); END_CASE B: IF c THEN d: e(); END_IF END_CASE",
        ),
        ("again: i := i + 1; JMP again;", "again: i := (i + 1); JMP again;"),
        ("IF a THEN lab: END_IF", "IF a THEN lab:  END_IF"),
        ("l1: l2: a();", "l1:  l2: a();"),
        (
            "__TRY a(); __CATCH(e) b(); __FINALLY c(); __ENDTRY",
            "__TRY a(); __CATCH(e) b(); __FINALLY c(); __ENDTRY",
        ),
        (
            "{info 'x'} a := 1; {IF defined (b)} c(); {END_IF}",
            "{info 'x'} a := 1; {IF defined (b)} c(); {END_IF}",
        ),
        ("IF a THEN {text 'x'} END_IF", "IF a THEN {text 'x'} END_IF"),
        ("Set(1); Get := 2; by := 3; S := R;", "Set(1); Get := 2; by := 3; S := R;"),
    ],
)
def test_structure(code: str, expected: str) -> None:
    body = body_of(code)
    assert statements(body) == expected
    assert same(body, body_of(expected)) or "E#" in code


def test_pragmas_are_statements_with_their_parts() -> None:
    (pragma,) = body_of("{attribute 'symbol' := 'read'}")
    assert isinstance(pragma, ast.PragmaStmt)
    assert pragma.pragma.text == "attribute 'symbol' := 'read'"
    assert (pragma.pragma.attribute, pragma.pragma.value) == ("symbol", "read")


def test_places_of_statements() -> None:
    first, second = body_of("a := 1;\nIF b THEN\n  c();\nEND_IF;")
    assert first.span == Span(1, 0, 1, 7)
    assert second.span == Span(2, 0, 4, 7)
    assert isinstance(second, ast.If)
    assert second.branches[0][1][0].span == Span(3, 2, 3, 6)


def test_case_branches_know_their_place() -> None:
    (case,) = body_of("CASE x OF\n 1..3, 5:\n  a();\nEND_CASE")
    assert isinstance(case, ast.Case)
    assert case.branches[0].span == Span(2, 1, 3, 6)
    assert [r.span for r in case.branches[0].selectors] == [Span(2, 1, 2, 5), Span(2, 7, 2, 8)]
