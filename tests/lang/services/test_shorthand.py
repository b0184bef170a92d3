"""Short forms of declarations (DECL-61..DECL-66, LDEC-142, LDEC-143, declaration EX-02)."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.lang.parser import parse
from tappet.lang.services.shorthand import expand
from tappet.lang.source import Source


@pytest.mark.parametrize(
    ("typed", "declaration"),
    [
        ("A", "A: BOOL;"),
        ("A B I 2", "A, B: INT := 2;"),
        ("ST S 2; A string", "ST: STRING(2); (* A string *)"),
        ("X %MD12 R 5; Real Number", "X AT %MD12: REAL := 5.0; (* Real Number *)"),
        ("B !", "B: BOOL;"),
        ("b", "b: BOOL;"),  # a lone abbreviation is a name: something must be declared
        ("a b", "a: BOOL;"),  # DECL-62: upper or lower case
        ("speed real -3", "speed: REAL := -3.0;"),
        ("speed R 2.5", "speed: REAL := 2.5;"),
        ("x y z", "x, y, z: BOOL;"),  # DECL-62: no type found, so the last one is a name
        ("run B 1", "run: BOOL := TRUE;"),
        ("run TRUE", "run: BOOL := TRUE;"),
        ("text S 'abc'", "text: STRING := 'abc';"),
        ("mask I 16#FF", "mask: INT := 16#FF;"),
        ("    indented I;", "    indented: INT;"),
        ("q %QX0.1 ; lamp", "q AT %QX0.1: BOOL; (* lamp *)"),
        ("n I - 3", "n: INT := -3;"),
        ("t string 20", "t: STRING(20);"),
        ("a ? b & I ~ 7", "a, b: INT := 7;"),  # DECL-66: other characters are ignored
    ],
)
def test_line_becomes_a_declaration(typed: str, declaration: str) -> None:
    found = expand(typed)
    assert found == declaration
    assert parse(Source("P", f"PROGRAM P\nVAR\n{found}\nEND_VAR\nEND_PROGRAM")).diagnostics == []


@pytest.mark.parametrize("typed", ["", "   ", "; comment", "VAR", "END_VAR", "a : INT;", "a := 3", "12"])
def test_other_lines_stay_as_they_are(typed: str) -> None:
    assert expand(typed) is None


@given(st.text(max_size=60))
def test_any_line_is_taken(typed: str) -> None:
    found = expand(typed)
    assert found is None or found.rstrip(" *)").count(";") >= 1
