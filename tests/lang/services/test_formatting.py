"""Indentation, blanks, case; and that nothing else changes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.iec.words import KEYWORDS
from tappet.lang.lexer import tokenize
from tappet.lang.services.formatting import Style, format_text, formatting
from tappet.lang.source import Source

UGLY = """program p
var
a:int;  b AT %IX0.0:bool:=true; // c
xLong      : INT   := 5;     (* kept aligned *)
end_var
if a=1 then b:=2;
c( x:=1,
   y:=-2 );
elsif not x and (y or z) then
// comment
for i:=1 to 10 do
x[ i ]:=a . b^ ;
case x of
1,2: a:=1;
// next
3..5:
b:=2;
if c then
d(); end_if
else
e();
end_case
end_for
else
  repeat
    x := x - 1; y := SEL(a,b,-c)**2;
        until x<0 end_repeat
end_if;
end_program
"""
NEAT = """PROGRAM p
VAR
    a: INT;  b AT %IX0.0: BOOL := TRUE; // c
    xLong      : INT   := 5;     (* kept aligned *)
END_VAR
IF a = 1 THEN b := 2;
    c(x := 1,
       y := -2);
ELSIF NOT x AND (y OR z) THEN
    // comment
    FOR i := 1 TO 10 DO
        x[i] := a.b^;
        CASE x OF
            1, 2: a := 1;
            // next
            3..5:
                b := 2;
                IF c THEN
                    d(); END_IF
        ELSE
            e();
        END_CASE
    END_FOR
ELSE
    REPEAT
        x := x - 1; y := SEL(a, b, -c) ** 2;
    UNTIL x < 0 END_REPEAT
END_IF;
END_PROGRAM
"""


def test_a_whole_program() -> None:
    assert format_text(UGLY) == NEAT


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:=b+1;", "a := b + 1;"),
        ("a := - 1;", "a := -1;"),
        ("a := b - - 1;", "a := b - -1;"),
        ("a := f( 1 ,2 );", "a := f(1, 2);"),
        ("a := AND (b, c);", "a := AND (b, c);"),
        ("a := AND(b, c);", "a := AND(b, c);"),
        ("a   :=   b;", "a := b;"),
        ("a := b;    // kept", "a := b;    // kept"),
        ("a := b;// added", "a := b; // added"),
        ("fb(IF := 1, do => x);", "fb(IF := 1, do => x);"),
        ("x.end_if := 1;", "x.end_if := 1;"),
        ("arr [ 1 , 2 ] := 3;", "arr[1, 2] := 3;"),
        ("p ^ . x := this ^;", "p^.x := THIS^;"),
        ("return ;", "RETURN;"),
        (
            "IF a THEN\n// c\n(* d\n  e *)\nb();\nEND_IF",
            "IF a THEN\n    // c\n    (* d\n  e *)\n    b();\nEND_IF",
        ),
        ("IF a THEN\n\n\nb();\nEND_IF", "IF a THEN\n\n\n    b();\nEND_IF"),
        ("TYPE s : struct\nx:int;\nend_struct end_type", "TYPE s : STRUCT\n    x: INT;\nEND_STRUCT END_TYPE"),
        ("a := 'x  y' ;  ", "a := 'x  y';"),
        (
            "function_block f\nvar PROTECTED constant\nx:int;\nend_var\nend_function_block",
            "FUNCTION_BLOCK f\nVAR PROTECTED CONSTANT\n    x: INT;\nEND_VAR\nEND_FUNCTION_BLOCK",
        ),
    ],
)
def test_small_pieces(text: str, expected: str) -> None:
    assert format_text(text) == expected


def test_tabs_as_indentation() -> None:
    assert format_text("IF a THEN\n  b();\nEND_IF", Style(indent="\t")) == "IF a THEN\n\tb();\nEND_IF"


@pytest.mark.parametrize(
    ("style", "expected"),
    [
        (Style(keywords="lower"), "if a and NOT_ME then b := c + d(1, -2); end_if"),
        (Style(keywords="keep"), "If a AND NOT_ME then b := c + d(1, -2); End_if"),
        (Style(operators=False), "IF a AND NOT_ME THEN b := c+d(1, -2); END_IF"),
        (Style(commas=False), "IF a AND NOT_ME THEN b := c + d(1,-2); END_IF"),
    ],
)
def test_what_can_be_chosen(style: Style, expected: str) -> None:
    assert format_text("If a AND NOT_ME then b:=c+d( 1 , -2 );End_if", style) == expected


def test_lines_of_a_string_over_lines_stay() -> None:
    text = "PROGRAM P\nVAR s : STRING; END_VAR\ns:='one\n  two' ;\ns:= s;\nEND_PROGRAM\n"
    expected = "PROGRAM P\nVAR s : STRING; END_VAR\ns:='one\n  two' ;\ns := s;\nEND_PROGRAM\n"
    assert format_text(text) == expected


def test_edits_are_the_lines_that_change() -> None:
    (edit,) = formatting("doc", "a := 1;\nb:=2;\nc := 3;")
    assert (edit.place.document, edit.place.span, edit.text) == ("doc", (1, 0, 1, 5), "b := 2;")


@pytest.mark.parametrize("text", ["a:=1; (* open", "a:='open\n;", "{open\na:=1;"])
def test_text_with_something_unclosed_stays(text: str) -> None:
    assert format_text(text) == text


MARKS = [
    "(",
    ")",
    "[",
    "]",
    ":=",
    ":",
    ";",
    ",",
    ".",
    "-",
    "=",
    "*",
    "/",
    "<",
    ">",
    "&",
    "..",
    "^",
    "\n",
    "\n",
]
WORDS = [*sorted(KEYWORDS), *MARKS, "a", "b1", "5", "'s'", "// c\n", "(* c *)", "(* c\n d *)", "T#5s", "{p}"]


STYLES = st.builds(
    Style,
    indent=st.sampled_from(["    ", "  ", "\t"]),
    keywords=st.sampled_from(["upper", "lower", "keep"]),
    operators=st.booleans(),
    commas=st.booleans(),
)


@given(st.lists(st.sampled_from(WORDS), max_size=60), STYLES)
def test_tokens_stay_the_same_and_a_second_pass_changes_nothing(words: list[str], style: Style) -> None:
    text = " ".join(words)
    once = format_text(text, style)
    before = [(t.kind, t.text.upper()) for t in tokenize(Source("x", text))]
    after = [(t.kind, t.text.upper()) for t in tokenize(Source("x", once))]
    assert after == before
    assert once.count("\n") == text.count("\n")
    assert format_text(once, style) == once
