"""Texts far beyond what a person writes: each gives code or a numbered error, none an exception of ours."""

from __future__ import annotations

import pytest

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
DEEP = 10_000


def program(declarations: str, body: str = "") -> str:
    return f"PROGRAM PLC_PRG\nVAR\n{declarations}\nEND_VAR\n{body}\nEND_PROGRAM\n"


def chain(before: str, after: str, count: int, last: str) -> str:
    """`count` objects, each made of the next one."""
    return "".join(before.format(i, i + 1) + after for i in range(count)) + last.format(count)


def branches(count: int) -> str:
    return "".join(f"ELSIF x = {i} THEN x := {i};" for i in range(1, count))


NUMBER = "TYPE S{} : INT; END_TYPE\n"
BLOCK = "FUNCTION_BLOCK S{}\n"
END = "END_FUNCTION_BLOCK\n"
NESTED = {
    "parentheses": program("x : INT;", "x := " + "(" * DEEP + "1" + ")" * DEEP + ";"),
    "signs": program("x : INT;", "x := " + "-" * DEEP + "1;"),
    "negations": program("x : BOOL;", "x := " + "NOT " * DEEP + "x;"),
    "if": program("x : BOOL;", "IF x THEN\n" * DEEP + "x := FALSE;" + "END_IF\n" * DEEP),
    "for": program("i : INT;", "FOR i := 0 TO 1 DO\n" * DEEP + "END_FOR\n" * DEEP),
    "case": program("i : INT;", "CASE i OF 1: " * DEEP + "END_CASE\n" * DEEP),
    "arrays": program("x : " + "ARRAY [0..0] OF " * DEEP + "INT;"),
    "pointers": program("x : " + "POINTER TO " * DEEP + "INT;"),
    "initial values": program("a : INT := " + "[" * DEEP + "1" + "]" * DEEP + ";"),
    "sum of a megabyte": program("x : DINT;", "x := x" + "+x" * 500_000 + ";"),
    "members": program("x : INT;", "x := x" + ".x" * 100_000 + ";"),
    "indices": program("x : INT;", "x := x" + "[1]" * 100_000 + ";"),
    "structures": chain("TYPE S{} : STRUCT a : S{}; END_STRUCT END_TYPE\n", "", 1500, NUMBER)
    + program("x : S0;"),
    "names of types": chain("TYPE S{} : S{}; END_TYPE\n", "", 1500, NUMBER) + program("x : S0;"),
    "blocks": chain("FUNCTION_BLOCK S{}\nVAR a : S{}; END_VAR\n", f"a();\n{END}", 500, BLOCK + END)
    + program("x : S0;", "x();"),
    "heirs": chain("FUNCTION_BLOCK S{} EXTENDS S{}\n", END, 1000, BLOCK + END) + program("x : S0;"),
    "constants": "VAR_GLOBAL CONSTANT\n"
    + chain("c{} : DINT := c{};\n", "", 1500, "c{} : DINT := 1;\nEND_VAR\n")
    + program("x : DINT := c0;"),
    "branches": program("x : INT;", "IF x = 0 THEN x := 1;" + branches(1500) + "END_IF"),
    "try": program("x : INT;", "__TRY\n" * 300 + "x := 1;" + "__FINALLY x := 2; __ENDTRY\n" * 300),
}
CYCLES = {
    "structures": "TYPE A : STRUCT b : B; END_STRUCT END_TYPE TYPE B : STRUCT a : A; END_STRUCT END_TYPE ",
    "itself": "TYPE A : STRUCT a : A; END_STRUCT END_TYPE ",
    "names": "TYPE A : B; END_TYPE TYPE B : A; END_TYPE ",
    "arrays": "TYPE A : ARRAY [0..1] OF A; END_TYPE ",
    "array of structures": "TYPE A : ARRAY [0..1] OF B; END_TYPE TYPE B : STRUCT x : A; END_STRUCT END_TYPE ",
    "bases of structures": "TYPE A EXTENDS B : STRUCT END_STRUCT END_TYPE "
    "TYPE B EXTENDS A : STRUCT END_STRUCT END_TYPE ",
    "blocks": "FUNCTION_BLOCK A\nVAR b : A; END_VAR END_FUNCTION_BLOCK ",
    "bases": "FUNCTION_BLOCK A EXTENDS B\nEND_FUNCTION_BLOCK FUNCTION_BLOCK B EXTENDS A\nEND_FUNCTION_BLOCK ",
    "base with heir": "FUNCTION_BLOCK A EXTENDS B\nEND_FUNCTION_BLOCK "
    "FUNCTION_BLOCK B\nVAR a : A; END_VAR END_FUNCTION_BLOCK ",
    "pointers": "TYPE A : POINTER TO B; END_TYPE TYPE B : POINTER TO A; END_TYPE ",
    "references": "TYPE A : REFERENCE TO A; END_TYPE ",
    "union": "TYPE A : UNION a : A; b : INT; END_UNION END_TYPE ",
    "array of itself": "FUNCTION_BLOCK A\nVAR a : ARRAY [0..3] OF A; END_VAR END_FUNCTION_BLOCK ",
}
REFUSED = {
    "interfaces": ("E0439", "INTERFACE A EXTENDS B\nEND_INTERFACE\nINTERFACE B EXTENDS A\nEND_INTERFACE\n"),
    "constants": ("E0409", "VAR_GLOBAL CONSTANT a : INT := b; b : INT := a; END_VAR "),
    "size of itself": (
        "E0317",
        "VAR_GLOBAL CONSTANT n : INT := SIZEOF(z); END_VAR VAR_GLOBAL z : ARRAY [0..n] OF INT; END_VAR ",
    ),
    "enumeration": ("E0331", f"TYPE E : ({','.join(f'e{i}' for i in range(33_000))}); END_TYPE "),
    "comment": ("E0002", "(*" * DEEP),
    "definition of itself": ("E0201", "{define a a}\nFUNCTION F : INT\nF := a;\nEND_FUNCTION "),
    "definitions in a circle": (
        "E0201",
        "{define a b + b}\n{define b a + a}\nFUNCTION F : INT\nF := a;\nEND_FUNCTION ",
    ),
    "definitions that double": (
        "E0201",
        "".join(f"{{define a{i} a{i + 1} + a{i + 1}}}\n" for i in range(60))
        + "FUNCTION F : INT\nF := a0;\nEND_FUNCTION ",
    ),
}
"""Texts with a code that is among their messages."""
METHODS = "".join(f"METHOD M{i} : INT\nM{i} := n + {i};\nEND_METHOD\n" for i in range(2000))
FAMILY = (
    f"FUNCTION_BLOCK B0\nVAR n0 : INT; END_VAR\nn0 := 1;\nMETHOD M : INT\nM := n0;\nEND_METHOD\n{END}"
    + "".join(
        f"FUNCTION_BLOCK B{i} EXTENDS B{i - 1}\nVAR n{i} : INT; END_VAR\nSUPER^(); n{i} := n0 + {i};\n"
        f"METHOD M : INT\nM := SUPER^.M() + 1;\nEND_METHOD\n{END}"
        for i in range(1, 200)
    )
)
TOO_LARGE = {
    "E0413": "a : ARRAY [0..9999, 0..9999, 0..9999] OF LINT;",
    "E0611": "a : ARRAY [0..9999] OF ARRAY [0..9999] OF ARRAY [0..9999] OF STRING(255);",
    "E0410": "s : STRING(99999999999);",
    "E0327": "a : ARRAY [0..9] OF INT := [999999999999(7)];",
    "E0010": "x : LREAL := 1E" + "9" * 100_000 + ";",
}
LARGE = {
    "array": program("a : ARRAY [0..99999] OF INT; i : DINT;", "FOR i := 0 TO 99999 DO a[i] := 1; END_FOR"),
    "listed values": program(
        f"a : ARRAY [0..99999] OF INT := [{','.join(map(str, range(30_000)))}, 70000(5)];"
    ),
    "blocks": program("a : ARRAY [0..99999] OF TON;", "a[5]();"),
    "one hundred million": program("a : ARRAY [0..99999999] OF BYTE := [99999999(7)];"),
    "text": program("s : STRING := '" + "a" * 1_000_000 + "';"),
    "names": program("a" * 100_000 + " : INT;", "a" * 100_000 + " := 1;"),
    "enumeration": f"TYPE E : ({','.join(f'e{i}' for i in range(10_000))}); END_TYPE "
    + program("x : E;", "x := e9999;"),
    "variables": program("".join(f"v{i} : INT := {i};\n" for i in range(5000)), "v1 := v4999;"),
    "labels of CASE": program(
        "x : INT;", f"CASE x OF {''.join(f'{i}: x := {i};' for i in range(3000))} END_CASE"
    ),
    "branches": program("x : INT;", "IF x = 0 THEN x := 1;" + branches(900) + "END_IF"),
    "cases": program(
        "x : DINT;", f"CASE x OF {''.join(f'{i}: x := {i + 1};' for i in range(10_000))} END_CASE"
    ),
    "methods": f"FUNCTION_BLOCK F\nVAR n : INT; END_VAR\n{METHODS}{END}" + program("a : F;", "a.M1();"),
    "family": FAMILY + program("a : B199; x : INT;", "a(); x := a.M();"),
    "jumps": program(
        "x : INT;", "".join(f"l{i}: IF x = {i} THEN JMP l{i * 7 % 1000}; END_IF\n" for i in range(1000))
    ),
    "arguments": f"FUNCTION F : INT\nVAR_INPUT {' '.join(f'a{i} : INT;' for i in range(2000))} END_VAR\n"
    "END_FUNCTION\n" + program("x : INT;", f"x := F({','.join(f'a{i} := {i}' for i in range(2000))});"),
    "conditions": program("x : INT;", "{IF 1}\n" * DEEP + "x := 1;\n" + "{END_IF}\n" * DEEP),
    "comments": "(*" * DEEP + "*)" * DEEP + program("x : INT;"),
    "rows of IL": "PROGRAM PLC_PRG\nVAR x : INT; END_VAR\nLD x\n" + "ADD x\n" * 5000 + "ST x\nEND_PROGRAM\n",
}


def codes(text: str) -> list[str]:
    result = build_application([Source("a.st", text)], (), BuildOptions(level=0), session=SESSION)
    return [d.code for d in result.diagnostics if d.severity == "error"]


@pytest.mark.parametrize("name", NESTED)
def test_deep_nesting_is_an_error(name: str) -> None:
    assert "E0107" in codes(NESTED[name])


@pytest.mark.parametrize("name", CYCLES)
def test_a_type_that_contains_itself_is_an_error(name: str) -> None:
    assert "E0408" in codes(CYCLES[name] + program("x : A;"))


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_end_is_an_error(name: str) -> None:
    code, text = REFUSED[name]
    assert code in codes(text + program("x : INT;"))


@pytest.mark.parametrize(
    ("code", "line"),
    [("E0201", "x := y{};\n"), ("E0104", "x := ;\n"), ("E0202", "END_VAR VAR v{0} : T{0};\n")],
)
def test_each_of_many_errors_is_reported_once(code: str, line: str) -> None:
    lines = "".join(line.format(i) for i in range(20_000))
    text = program("x : INT; " + lines) if "VAR" in line else program("x : INT;", lines)
    assert codes(text) == [code] * 20_000


@pytest.mark.parametrize("code", TOO_LARGE)
def test_what_no_memory_holds_is_an_error(code: str) -> None:
    assert codes(program(TOO_LARGE[code])) == [code]


@pytest.mark.parametrize("name", LARGE)
def test_large_texts_are_built(name: str) -> None:
    assert codes(LARGE[name]) == []
