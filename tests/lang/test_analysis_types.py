"""Types, layout, constants and declarations (spec language_types.md, language_declarations.md)."""

from __future__ import annotations

import pytest
from resolved import analysed, codes, messages, program, type_of, variable

from tappet.lang import types as t
from tappet.lang.analysis import AnalysisOptions
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import PouSymbol, Storage


def test_structure_is_aligned_naturally() -> None:
    a = analysed(
        "TYPE S : STRUCT b : BOOL; d : DINT; c : BYTE; l : LREAL; w : WSTRING(3); END_STRUCT END_TYPE"
    )
    s = type_of(a, "S")
    assert isinstance(s, t.Struct)
    assert [(m.name, m.offset) for m in s.members.values()] == [
        ("b", 0), ("d", 4), ("c", 8), ("l", 16), ("w", 24),
    ]  # fmt: skip
    assert (s.size, s.align) == (32, 8)


@pytest.mark.parametrize(
    ("mode", "offsets", "size"),
    [("0", [0, 1, 3, 4], 5), ("1", [0, 1, 3, 4], 5), ("2", [0, 2, 4, 5], 6), ("8", [0, 2, 4, 5], 6)],
)
def test_pack_mode(mode: str, offsets: list[int], size: int) -> None:
    """LPRG-40, language_pragmas EX-06."""
    a = analysed(
        f"{{attribute 'pack_mode' := '{mode}'}}\nTYPE S : STRUCT Enable : BOOL; Counter : INT; "
        "MaxSize : BOOL; MaxSizeReached : BOOL; END_STRUCT END_TYPE"
    )
    s = type_of(a, "S")
    assert isinstance(s, t.Struct)
    assert ([m.offset for m in s.members.values()], s.size) == (offsets, size)


def test_unknown_pack_mode_is_reported() -> None:
    a = analysed("{attribute 'pack_mode' := '3'}\nTYPE S : STRUCT a : INT; END_STRUCT END_TYPE")
    assert codes(a) == ["E0609"]


def test_union_members_share_their_place() -> None:
    u = type_of(analysed("TYPE U : UNION a : LREAL; b : INT; c : STRING(10); END_UNION END_TYPE"), "U")
    assert isinstance(u, t.Struct)
    assert {m.offset for m in u.members.values()} == {0}
    assert (u.size, u.align) == (16, 8)


def test_extended_structure_begins_with_its_base() -> None:
    a = analysed(
        "TYPE B EXTENDS A : STRUCT y : LINT; END_STRUCT END_TYPE",
        "TYPE A : STRUCT x : INT; END_STRUCT END_TYPE",
    )
    s = type_of(a, "B")
    assert isinstance(s, t.Struct)
    assert [(m.name, m.offset) for m in s.members.values()] == [("x", 0), ("y", 8)]


def test_bit_members_are_packed() -> None:
    s = type_of(analysed("TYPE S : STRUCT a : BIT; b : BIT; c : INT; d : BIT; END_STRUCT END_TYPE"), "S")
    assert isinstance(s, t.Struct)
    assert [(m.offset, m.bit) for m in s.members.values()] == [(0, 0), (0, 1), (2, None), (4, 0)]


def test_instance_layout_of_a_block() -> None:
    a = analysed(
        "FUNCTION_BLOCK FB\nVAR_INPUT a : BOOL; END_VAR VAR_IN_OUT r : INT; END_VAR VAR_OUTPUT q : "
        "DINT; END_VAR "
        "VAR_TEMP t : INT; END_VAR VAR_STAT s : INT; END_VAR VAR m AT %MW2 : INT; END_VAR\nEND_FUNCTION_BLOCK"
    )
    fb = a.pous[0].instance
    assert fb is not None
    assert [(m.name, m.offset) for m in fb.members.values()] == [("a", 0), ("r", 8), ("q", 16)]
    assert fb.size == 24
    assert variable(a, "FB.t").storage is Storage.LOCAL
    assert variable(a, "FB.m").storage is Storage.DIRECT
    statics = a.gvls[-1]
    assert (statics.name, list(statics.members)) == ("__STAT_FB", ["S"])
    assert variable(a, "FB.s").storage is Storage.GLOBAL


def test_inherited_members_keep_their_offsets() -> None:
    a = analysed(
        "FUNCTION_BLOCK Child EXTENDS Base\nVAR y : BYTE; END_VAR\ny := x;\nEND_FUNCTION_BLOCK",
        "FUNCTION_BLOCK Base\nVAR x : BYTE; END_VAR\nMETHOD Get : INT\nGet := "
        "x;\nEND_METHOD\nEND_FUNCTION_BLOCK",
    )
    assert codes(a) == []
    base, child = a.pous[1].instance, a.pous[0].instance
    assert base is not None
    assert child is not None
    assert [(m.name, m.offset) for m in child.members.values()] == [("__VFTABLE", 0), ("x", 8), ("y", 16)]
    assert child.base is base
    assert list(a.pous[0].vtable) == ["__BODY", "GET"]


def test_block_without_methods_has_no_virtual_table() -> None:
    a = analysed("FUNCTION_BLOCK FB\nVAR x : BYTE; END_VAR\nEND_FUNCTION_BLOCK")
    fb = a.pous[0].instance
    assert fb is not None
    assert list(fb.members) == ["X"]
    assert fb.size == 1


def test_instance_variable_of_a_method() -> None:
    a = analysed(
        "FUNCTION_BLOCK FB\nMETHOD M\nVAR_INST n : INT; END_VAR\nn := n + 1;\nEND_METHOD\nEND_FUNCTION_BLOCK"
    )
    fb = a.pous[0].instance
    assert fb is not None
    assert "M.N" in fb.members
    assert a.pous[0].methods["M"].locals["N"].storage is Storage.INSTANCE


@pytest.mark.parametrize(
    "texts",
    [
        ("TYPE A : STRUCT b : B; END_STRUCT END_TYPE TYPE B : STRUCT a : A; END_STRUCT END_TYPE",),
        ("TYPE A : STRUCT a : ARRAY[0..1] OF A; END_STRUCT END_TYPE",),
        ("FUNCTION_BLOCK A\nVAR a : A; END_VAR\nEND_FUNCTION_BLOCK",),
        (
            "FUNCTION_BLOCK A\nVAR b : B; END_VAR\nEND_FUNCTION_BLOCK",
            "FUNCTION_BLOCK B\nVAR a : A; END_VAR\nEND_FUNCTION_BLOCK",
        ),
        ("TYPE A : B; END_TYPE TYPE B : A; END_TYPE",),
        ("FUNCTION_BLOCK A EXTENDS B\nEND_FUNCTION_BLOCK", "FUNCTION_BLOCK B EXTENDS A\nEND_FUNCTION_BLOCK"),
        ("TYPE A EXTENDS A : STRUCT x : INT; END_STRUCT END_TYPE",),
    ],
)
def test_what_contains_itself_is_an_error(texts: tuple[str, ...]) -> None:
    found = analysed(*texts)
    assert "E0408" in codes(found)
    chain = next(m for m in messages(found) if "contains itself" in m)
    assert " -> " in chain


def test_pointer_to_the_own_type_is_legal() -> None:
    a = analysed("TYPE Node : STRUCT next : POINTER TO Node; value : INT; END_STRUCT END_TYPE")
    assert codes(a) == []
    assert type_of(a, "Node").size == 16


def test_constants_in_bounds_lengths_and_other_constants() -> None:
    a = analysed(
        "VAR_GLOBAL CONSTANT N : INT := M * 2; M : INT := 5; R : REAL := 0.1; T1 : TIME := T#1s + T#5ms; "
        "Name : STRING := 'abc'; END_VAR",
        "PROGRAM P\nVAR x : ARRAY[1..N, 0..M - 1] OF INT; s : STRING(N + 1); END_VAR\nEND_PROGRAM",
    )
    assert codes(a) == []
    assert str(variable(a, "P.x").type) == "ARRAY [1..10, 0..4] OF INT"
    assert str(variable(a, "P.s").type) == "STRING(11)"
    values = {v.name: v.constant for v in a.gvls[0].members.values()}
    assert values == {"N": 10, "M": 5, "R": 0.10000000149011612, "T1": 1005, "Name": b"abc"}
    assert {v.storage for v in a.gvls[0].members.values()} == {Storage.CONSTANT}
    assert {v.home for v in a.gvls[0].members.values()} == {Storage.GLOBAL}


def test_constants_that_need_each_other() -> None:
    a = analysed("VAR_GLOBAL CONSTANT A : INT := B + 1; B : INT := A + 1; END_VAR")
    assert "E0409" in codes(a)


@pytest.mark.parametrize(
    ("declaration", "code"),
    [
        ("VAR a : INT; A : REAL; END_VAR", "E0205"),
        ("VAR a : Speed; END_VAR", "E0202"),
        ("VAR a : ARRAY[5..1] OF INT; END_VAR", "E0411"),
        ("VAR n : INT; a : ARRAY[0..n] OF INT; END_VAR", "E0317"),
        ("VAR a : ARRAY[0..1.5] OF INT; END_VAR", "E0412"),
        ("VAR a : ARRAY[0..4294967296] OF INT; END_VAR", "E0413"),
        ("VAR a : ARRAY[0..2000000000] OF LREAL; END_VAR", "E0611"),
        ("VAR a : STRING(-1); END_VAR", "E0410"),
        ("VAR a : STRING(5000000000); END_VAR", "E0410"),
        ("VAR a : REAL(0..1); END_VAR", "E0415"),
        ("VAR a : SINT(0..200); END_VAR", "E0416"),
        ("VAR a : ARRAY[0..3] OF REFERENCE TO INT; END_VAR", "E0407"),
        ("VAR a : REFERENCE TO REFERENCE TO INT; END_VAR", "E0407"),
        ("VAR a : POINTER TO REFERENCE TO INT; END_VAR", "E0407"),
        ("VAR a : ARRAY[*] OF INT; END_VAR", "E0414"),
        ("VAR CONSTANT a : INT; END_VAR", "W1223"),
        ("VAR a : P; END_VAR", "E0422"),
        ("VAR A__B : INT; END_VAR", "E0206"),
        ("VAR RETAIN x AT %MX0.0 : BOOL; END_VAR", "E0402"),
        ("VAR_INPUT x AT %IX0.0 : BOOL; END_VAR", "E0401"),
        ("VAR x AT %IX0.16 : BOOL; END_VAR", "E0602"),
        ("VAR x AT %IX0 : BOOL; END_VAR", "E0601"),
        ("VAR x AT %MW999999 : INT; END_VAR", "E0604"),
        ("VAR x AT %QX0.1 : INT; END_VAR", "E0603"),
        ("VAR x AT %I* : BOOL; END_VAR", "W1303"),
        ("VAR_EXTERNAL x : INT; END_VAR", "E0211"),
        ("VAR_IN_OUT x : INT := 3; END_VAR", "E0430"),
        ("VAR_GLOBAL x : INT; END_VAR", "E0405"),
    ],
)
def test_faulty_declaration(declaration: str, code: str) -> None:
    assert code in codes(program(declaration))


def test_enumeration_values_and_default() -> None:
    """LTYP-110..LTYP-116."""
    a = analysed("TYPE E : (red, yellow, green := 10, blue) := yellow; END_TYPE")
    e = type_of(a, "E")
    assert isinstance(e, t.Enum)
    assert (e.values, e.default, e.base) == ({"red": 0, "yellow": 1, "green": 10, "blue": 11}, 1, t.INT)


def test_enumeration_values_by_constants_and_each_other() -> None:
    a = analysed(
        "TYPE E : (a := N, b := a + 1, c := 16#8000) DINT; END_TYPE VAR_GLOBAL CONSTANT N : INT := 3; END_VAR"
    )
    e = type_of(a, "E")
    assert codes(a) == []
    assert isinstance(e, t.Enum)
    assert e.values == {"a": 3, "b": 4, "c": 32768}


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("TYPE E : (a := 5, b := 3); END_TYPE", "W1222"),
        ("TYPE E : (a := 300) BYTE; END_TYPE", "E0331"),
        ("TYPE E : (a, A); END_TYPE", "E0205"),
        ("TYPE E : (a, b) REAL; END_TYPE", "E0415"),
        ("TYPE S : STRUCT x AT %MW0 : INT; END_STRUCT END_TYPE", "E0403"),
        ("TYPE S : STRUCT x : INT; X : INT; END_STRUCT END_TYPE", "E0205"),
        ("TYPE S EXTENDS T : STRUCT x : INT; END_STRUCT END_TYPE TYPE T : INT; END_TYPE", "E0417"),
        ("TYPE S EXTENDS Nope : STRUCT x : INT; END_STRUCT END_TYPE", "E0202"),
        ("FUNCTION F : INT\nVAR_TEMP t : INT; END_VAR\nF := t;\nEND_FUNCTION", "E0404"),
        ("FUNCTION F\nEND_FUNCTION", "E0432"),
        ("FUNCTION_BLOCK FB EXTENDS Nope\nEND_FUNCTION_BLOCK", "E0216"),
        ("FUNCTION_BLOCK FB IMPLEMENTS INope\nEND_FUNCTION_BLOCK", "E0217"),
        ("PROGRAM A\nEND_PROGRAM\nPROGRAM a\nEND_PROGRAM", "E0420"),
    ],
)
def test_faulty_object(text: str, code: str) -> None:
    assert code in codes(analysed(text))


def test_subrange_and_alias() -> None:
    a = program(
        "VAR i : INT(-4095..4095); j : SubInt; m : Msg; f : Fast := 2.5; END_VAR",
        "",
        "TYPE SubInt : INT (-4095..4095); END_TYPE TYPE Msg : STRING(50) := 'hi'; END_TYPE TYPE Fast "
        ": REAL; END_TYPE",
    )
    assert codes(a) == []
    assert str(variable(a, "P.i").type) == "INT (-4095..4095)"
    assert str(variable(a, "P.j").type) == "SubInt"
    assert variable(a, "P.m").type == t.String(50)
    decl = variable(a, "P.m").decl
    assert decl is not None
    assert decl.init is not None
    assert decl.init.constant == b"hi"


def test_direct_addresses_in_both_modes() -> None:
    """LDEC-59."""
    declaration = (
        "VAR a AT %QX7.5 : BOOL; b AT %QX1.10 : BOOL; w AT %IW215 : WORD; d AT %MD48 : DINT; END_VAR"
    )
    a = program(declaration)
    assert [(variable(a, f"P.{n}").offset, variable(a, f"P.{n}").bit) for n in "abwd"] == [
        (14, 5), (3, 2), (430, None), (192, None),
    ]  # fmt: skip
    b = program(declaration.replace("1.10", "1.2"), options=AnalysisOptions(byte_addressing=True))
    assert [variable(b, f"P.{n}").offset for n in "abwd"] == [7, 1, 215, 48]


def test_external_variable_is_the_global_one() -> None:
    gvl = Source("G", "VAR_GLOBAL x : INT := 12; END_VAR", name="G")
    a = program("VAR_EXTERNAL x : INT; END_VAR", "x := 1;", gvl)
    assert codes(a) == []
    assert variable(a, "P.x") is variable(a, "G.x")
    assert codes(program("VAR_EXTERNAL x : DINT; END_VAR", "", gvl)) == ["E0212"]


def test_lists_are_initialised_by_slot() -> None:
    a = analysed(
        Source("A", "VAR_GLOBAL x : INT; END_VAR", name="A"),
        Source("B", "{attribute 'global_init_slot' := '300'}\nVAR_GLOBAL y : INT; END_VAR", name="B"),
    )
    assert [g.name for g in a.gvls] == ["B", "A"]


def test_configured_addresses() -> None:
    fb = "FUNCTION_BLOCK FB\nVAR i AT %I* : BOOL; o AT %Q* : BOOL; END_VAR\no := i;\nEND_FUNCTION_BLOCK"
    lines = "P.a[1].i AT %IX1.0 : BOOL; P.a[1].o AT %QX0.3 : BOOL;"
    a = program("VAR a : ARRAY[1..1] OF FB; END_VAR", "a[1]();", fb, f"VAR_CONFIG {lines} END_VAR")
    assert codes(a) == []
    assert [(c.path, c.owner, c.offset, c.area, c.address, c.bit) for c in a.configured] == [
        ("P.a[1].i", "P", 0, "I", 2, 0),
        ("P.a[1].o", "P", 1, "Q", 0, 3),
    ]


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ("P.a.i AT %IX1.0 : BOOL; P.b.i AT %IX1.0 : BOOL;", "E0606"),
        ("P.a.i AT %QX1.0 : BOOL;", "E0607"),
        ("P.a.i AT %IB1 : BYTE;", "E0607"),
        ("P.a.i AT %IX1.0 : BOOL; P.a.i AT %IX1.1 : BOOL;", "E0610"),
        ("P.a.i AT %I* : BOOL;", "E0608"),
    ],
)
def test_faulty_configuration(lines: str, code: str) -> None:
    fb = "FUNCTION_BLOCK FB\nVAR i AT %I* : BOOL; END_VAR\nEND_FUNCTION_BLOCK"
    assert code in codes(program("VAR a : FB; END_VAR", "a();", fb, f"VAR_CONFIG {lines} END_VAR"))


def test_objects_hide_each_other_from_inside_out() -> None:
    """CON-06..CON-09: application, then POUs view, then libraries."""
    text = "FUNCTION F : {0}\nF := 1;\nEND_FUNCTION"
    library = Source("L/F", text.format("LREAL"), Scope.LIBRARY, library="Lib", namespace="L")
    pous = Source("F", text.format("REAL"), Scope.POUS)
    own = Source("F", text.format("INT"), Scope.APPLICATION)
    call = "VAR x : LREAL; END_VAR", "x := F(); x := L.F();"
    for texts, type_ in (((library,), t.LREAL), ((library, pous), t.REAL), ((library, pous, own), t.INT)):
        a = program(call[0], call[1], *texts)
        found = a.scope["F"]
        assert codes(a) == (["W1201"] if own in texts else [])
        assert isinstance(found, PouSymbol)
        assert found.return_type is type_
        assert len({p.qualified_name for p in a.pous}) == len(a.pous)


def test_name_of_two_libraries_is_ambiguous() -> None:
    text = "FUNCTION F : INT\nF := 1;\nEND_FUNCTION"
    a = program(
        "VAR x : INT; END_VAR",
        "x := F(); x := L1.F();",
        Source("L1/F", text, Scope.LIBRARY, library="L1"),
        Source("L2/F", text, Scope.LIBRARY, library="L2"),
    )
    assert codes(a) == ["E0203"]


def test_types_known_without_a_library_are_never_ambiguous() -> None:
    def meant(*types: str) -> t.Type | None:
        libraries = [
            Source(f"L{n}/HRESULT", f"TYPE HRESULT : {type_}; END_TYPE", Scope.LIBRARY, library=f"L{n}")
            for n, type_ in enumerate(types)
        ]
        a = program("VAR h : HRESULT; END_VAR", "h := 1;", *libraries)
        assert codes(a) == []
        return variable(a, "P.h").type

    assert meant() is t.DINT
    assert meant("LINT") is t.LINT
    assert meant("LINT", "SINT") is t.DINT
    assert meant("LINT", "SINT", "INT") is t.DINT


def test_children_with_their_own_texts() -> None:
    a = analysed(
        Source("FB", "FUNCTION_BLOCK FB\nVAR n : INT; END_VAR\nEND_FUNCTION_BLOCK"),
        Source("FB.Up", "METHOD Up : INT\nn := n + 1; Up := n;\nEND_METHOD", owner="FB"),
        Source("FB.Zero", "ACTION Zero\nn := 0;\nEND_ACTION", owner="FB"),
        Source(
            "FB.V", "PROPERTY V : INT\nGET\nV := n;\nEND_GET\nSET\nn := V;\nEND_SET\nEND_PROPERTY", owner="FB"
        ),
        Source(
            "P",
            "PROGRAM P\nVAR f : FB; x : INT; END_VAR\nx := f.Up(); f.Zero(); f.V := f.V + 1;\nEND_PROGRAM",
        ),
    )
    assert codes(a) == []
    fb = a.pous[0]
    assert (list(fb.methods), list(fb.actions), list(fb.properties)) == (["UP"], ["ZERO"], ["V"])
    getter = fb.properties["V"].getter
    assert getter is not None
    assert getter.result is not None
    assert getter.result.name == "V"


def test_child_without_owner_is_reported() -> None:
    a = analysed(Source("X.M", "METHOD M\nEND_METHOD", owner="X"))
    assert codes(a) == ["E0429"]


def test_an_unknown_name_below_an_address_is_one_message() -> None:
    for operand in ("Unknown.x", "Unknown", "odd", "odd.x", "n.k"):
        text = program("VAR odd : FB_Odd; n : INT; z : LWORD; END_VAR", f"z := ADR({operand});")
        found = [code for code in codes(text) if code[0] == "E"]
        assert found[0] == "E0202"  # of the declaration
        assert found[1:] in ([], ["E0201"], ["E0204"]), (operand, found)


def test_values_of_enumerations_are_constant_expressions() -> None:
    a = analysed(
        "TYPE E : (a := SHL(1, 2), b := SIZEOF(S) + 4, c := MAX(3, c1), d := 2, e) DINT; END_TYPE\n"
        "TYPE S : STRUCT x : INT; y : DINT; END_STRUCT END_TYPE\n"
        "VAR_GLOBAL CONSTANT c1 : INT := SHL(INT#1, 9); END_VAR"
    )
    assert codes(a) == ["W1222"]
    assert a.types["E"].values == {"a": 4, "b": 12, "c": 512, "d": 2, "e": 3}
    function = "FUNCTION F : INT\nVAR_INPUT n : INT; END_VAR\nF := n;\nEND_FUNCTION"
    assert "E0317" in codes(analysed("TYPE E : (a := F(3)); END_TYPE\n" + function))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("F(1);", []),
        ("F(a := 1);", []),
        ("x := F(1);", ["W1147"]),
        ("x := 2 + F(1);", ["W1147"]),
        ("F(F(1));", ["W1147"]),
    ],
)
def test_a_marked_function_without_a_return_type_counts_as_0(body: str, expected: list[str]) -> None:
    head = "{attribute 'no_return_type'}\nFUNCTION F\nVAR_INPUT a : INT; END_VAR\nEND_FUNCTION\n"
    found = codes(analysed(f"{head}PROGRAM P\nVAR x : INT; END_VAR\n{body}\nEND_PROGRAM"))
    assert [code for code in found if code.startswith(("E", "W1147"))] == expected


def test_a_function_without_a_return_type_has_no_result_to_assign() -> None:
    assert "E0305" in codes(analysed("{attribute 'no_return_type'}\nFUNCTION F\nF := 1;\nEND_FUNCTION"))


def test_unknown_type_is_told_once() -> None:
    """What is done with members, elements and targets of an unknown type is no fault of its own."""
    types = (
        "TYPE Inner : STRUCT drive : Missing; n : INT; END_STRUCT END_TYPE "
        "TYPE Outer EXTENDS Inner : STRUCT m : INT; END_STRUCT END_TYPE "
        "VAR_GLOBAL g : Outer := (drive := 1, m := 2); END_VAR"
    )
    variables = "VAR p : POINTER TO Missing; a : ARRAY[0..1] OF Missing; END_VAR"
    assert codes(program(variables, "g.drive.x := p^.x + a[0].x + p[1];", types)) == ["E0202"] * 3
    assert sorted(codes(program("VAR s : Outer; END_VAR", "s.other := 1;", types))) == ["E0202", "E0204"]


def test_list_names_its_own_variables_plainly() -> None:
    """A list with the attribute qualified_only needs no qualification in its own text (LPRG-42)."""
    text = (
        "{attribute 'qualified_only'} VAR_GLOBAL CONSTANT n : INT := 3; END_VAR "
        "VAR_GLOBAL v : ARRAY[0..n] OF INT := [n, n]; w : INT := n + 1; END_VAR"
    )
    assert codes(analysed(text)) == []
    assert codes(program("VAR v : INT := n; END_VAR", "", text)) == ["E0207"]
