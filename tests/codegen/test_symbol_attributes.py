"""Attributes that the monitor and outside clients read from the symbol map."""

from __future__ import annotations

import pytest
from linked_application import loaded

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.display import Mode, display_text
from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_export import exported
from tappet.lang.source import Source

SESSION = BuildSession()


def package_of(*texts: str | Source) -> CodePackage:
    sources = [t if isinstance(t, Source) else Source(f"text{n}", t) for n, t in enumerate(texts)]
    result = build_application(sources, session=SESSION, options=BuildOptions(level=1))
    assert result.package is not None, [str(d) for d in result.diagnostics]
    return CodePackage.from_bytes(result.package.to_bytes())


def test_rights_of_variables() -> None:
    """LPRG-44, SYM-10, SYM-11: a variable's own right overrides that of its object."""
    program = """{attribute 'symbol' := 'readwrite'}
PROGRAM PLC_PRG
VAR
    A : INT; B : ARRAY[0..1] OF INT;
    {attribute 'symbol' := 'none'}
    C : INT;
    {attribute 'symbol' := 'read'}
    D : INT;
    fb : FB;
END_VAR
END_PROGRAM"""
    block = """FUNCTION_BLOCK FB
VAR
    {attribute 'symbol' := 'read'}
    inside : INT;
END_VAR
END_FUNCTION_BLOCK"""
    plain = """PROGRAM Other
VAR
    {attribute 'symbol'}
    bare : INT;
    {attribute 'symbol' := 'write'}
    w : INT;
    {attribute 'symbol' := 'no-exit'}
    unseen : FB;
    not_marked : INT;
END_VAR
END_PROGRAM"""
    lists = Source(
        "GVL",
        "{attribute 'symbol' := 'read'}\nVAR_GLOBAL\n    g AT %MW4 : INT; h : INT;\nEND_VAR",
        name="GVL",
    )
    assert exported(package_of(program, block, plain, lists).symbols) == {
        "PLC_PRG.A": "readwrite", "PLC_PRG.B": "readwrite", "PLC_PRG.D": "read", "PLC_PRG.fb": "readwrite",
        "Other.bare": "readwrite", "Other.w": "write", "GVL.g": "read", "GVL.h": "read",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("path", "value", "mode", "shown"),
    [
        ("hex", 255, "dec", "16#000000FF"),
        ("hexadecimal", -1, "bin", "16#FFFF"),
        ("bin", 5, "dec", "2#00000101"),
        ("binary", 5, "hex", "2#00000101"),
        ("dec", 200, "hex", "200"),
        ("decimal", 200, "bin", "200"),
        ("plain", 200, "hex", "16#C8"),
        ("plain", 200, "bin", "2#11001000"),
        ("plain", 200, "dec", "200"),
        ("r", 1.5, "hex", "1.5"),
        ("inside.x", 10, "dec", "16#0A"),
    ],
)
def test_display_mode(path: str, value: float, mode: Mode, shown: str) -> None:
    """LPRG-21: the attribute overrides the display mode of the Online menu."""
    text = """TYPE T : STRUCT
    {attribute 'displaymode' := 'hex'}
    x : BYTE;
END_STRUCT END_TYPE
PROGRAM P
VAR
    {attribute 'displaymode' := 'hex'}
    hex : DWORD;
    {attribute 'displaymode' := 'hexadecimal'}
    hexadecimal : INT;
    {attribute 'displaymode' := 'bin'}
    bin : BYTE;
    {attribute 'displaymode' := 'binary'}
    binary : BYTE;
    {attribute 'displaymode' := 'dec'}
    dec : BYTE;
    {attribute 'displaymode' := 'decimal'}
    decimal : BYTE;
    {attribute 'displaymode' := 'hex'}
    r : REAL;
    plain : BYTE;
    inside : T;
END_VAR
END_PROGRAM"""
    symbols = package_of(text).symbols
    assert display_text(symbols, symbols.resolve(f"P.{path}"), value, mode) == shown


def test_wide_string_functions() -> None:
    """LTYP-17, catalog TYPE-21: the functions of Standard64 count characters, not bytes."""
    text = """PROGRAM P
VAR
    w : WSTRING := "Größe 12 µm";
    n, found, none : INT;
    left, right, mid, joined, put, cut, swapped : WSTRING;
END_VAR
n := WLEN(w);
found := WFIND(w, "µ");
none := WFIND(w, "x");
left := WLEFT(w, 5);
right := WRIGHT(w, 2);
mid := WMID(w, 2, 7);
joined := WCONCAT(left, "!");
put := WINSERT(left, "--", 2);
cut := WDELETE(w, 9, 3);
swapped := WREPLACE(left, "ü", 2, 3);
END_PROGRAM"""
    options = BuildOptions(level=1, libraries=(LibraryReference("Standard"), LibraryReference("Standard64")))
    result = build_application([Source("P", text)], session=BuildSession(), options=options)
    assert result.package is not None, [str(d) for d in result.diagnostics]
    with loaded(result.package) as application:
        application.cycle()
        names = ["n", "found", "none", "left", "right", "mid", "joined", "put", "cut", "swapped"]
        w = "Größe 12 µm"
        values = ["11", "10", "0", w[:5], w[-2:], w[6:8], w[:5] + "!", "Gr--öße", w[:2], "Grüe"]
        found = [application.literal(f"P.{name}").strip('"') for name in names]
        assert found == values
