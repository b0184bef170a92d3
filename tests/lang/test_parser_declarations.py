"""Objects, types and variables with their flags, attributes and comments."""

from __future__ import annotations

from typing import TypeVar

import pytest
from st_text import codes, statements, type_text, variable

from tappet.lang import ast
from tappet.lang.parser import parse
from tappet.lang.source import Source, Span

D = TypeVar("D", bound=ast.Declaration)


def read(text: str, **source: str) -> list[ast.Declaration]:
    result = parse(Source(source.pop("uri", "x.st"), text, **source))  # type: ignore[arg-type]
    assert [str(d) for d in result.diagnostics] == []
    return result.unit.declarations


def one(text: str, kind: type[D], **source: str) -> D:
    (found,) = read(text, **source)
    assert isinstance(found, kind)
    return found


def variables(text: str) -> list[ast.VarDecl]:
    return one(f"PROGRAM p VAR\n{text}\nEND_VAR END_PROGRAM", ast.Pou).blocks[0].variables


# -- types and variables


@pytest.mark.parametrize(
    "text",
    [
        "a : INT;",
        "a : INT := 5;",
        "a AT %IX0.0 : BOOL;",
        "a AT %QW* : INT := 3;",
        "a : Lib.Sub.T;",
        "a : STRING;",
        "a : STRING(20) := 'x';",
        'a : WSTRING(N + 1) := "x";'.replace("N + 1", "(N + 1)"),
        "a : ARRAY[0..9] OF INT;",
        "a : ARRAY[1..2, (- 3)..N] OF INT := [1, 3(7)];",
        "a : ARRAY[*, *] OF REAL;",
        "a : ARRAY[0..1] OF ARRAY[0..2] OF T := [[1, 2], [3(4)]];",
        "a : POINTER TO BYTE := ADR(b);",
        "a : POINTER TO ARRAY[0..7] OF BYTE;",
        "a : REFERENCE TO INT REF= b;",
        "a : INT(1..10) := 3;",
        "a : UDINT(LOW..HIGH);",
        "a : T := (x := 1, y := [2, 3], z := (q := TRUE));",
        "a : FB(1);",
        "a : FB(n := 1);",
        "a : FB(n := 1) := (in1 := 99);",
        "a : FB();",
        "a : (red, green := 5, blue) BYTE := green;",
        "a : STRUCT x : INT; y : REAL; END_STRUCT;",
    ],
)
def test_variable(text: str) -> None:
    (decl,) = variables(text)
    assert variable(decl) == text


def test_string_length_in_brackets() -> None:
    assert variable(variables("a : STRING[10];")[0]) == "a : STRING(10);"


def test_several_names_share_type_and_value() -> None:
    first, second = variables("a, b : INT := 2; // both")
    assert (first.name, second.name, first.name_span, second.name_span) == (
        "a",
        "b",
        Span(1, 0, 1, 1),
        Span(1, 3, 1, 4),
    )
    assert first.type_ref is second.type_ref
    assert first.initial is second.initial
    assert first.comment == second.comment == "both"


@pytest.mark.parametrize(
    ("section", "flags"),
    [
        ("VAR", set()),
        ("VAR CONSTANT", {"CONSTANT"}),
        ("VAR_INPUT RETAIN", {"RETAIN"}),
        ("VAR_OUTPUT", set()),
        ("VAR_IN_OUT CONSTANT", {"CONSTANT"}),
        ("VAR_TEMP", set()),
        ("VAR_STAT", set()),
        ("VAR_INST", set()),
        ("VAR_EXTERNAL", set()),
        ("VAR PERSISTENT RETAIN", {"RETAIN", "PERSISTENT"}),
        ("VAR NON_RETAIN", {"NON_RETAIN"}),
    ],
)
def test_sections_and_flags(section: str, flags: set[str]) -> None:
    pou = one(f"FUNCTION_BLOCK f\n{section} a : INT; END_VAR\nEND_FUNCTION_BLOCK", ast.Pou)
    (block,) = pou.blocks
    assert (block.section, block.flags, [v.name for v in block.variables]) == (
        section.split()[0],
        flags,
        ["a"],
    )


def test_comments_of_variables() -> None:
    found = variables(
        """
        (* above one *)
        one : INT;
        two : INT; // behind two
        three : INT; (* behind three *) four : INT;
        // first line
        // second line
        {attribute 'x'}
        five : INT;

        (* far away *)

        six : INT;
        seven (* inside *) : INT;
        (*******
         * framed
         *******)
        eight : INT;
        """
    )
    assert [v.comment for v in found] == [
        "above one", "behind two", "behind three", "", "first line\nsecond line", "", "inside", "framed",
    ]  # fmt: skip


def test_attributes_of_variables() -> None:
    found = variables(
        """
        {attribute 'hide'}
        {attribute 'displaymode' := 'hex'}
        a : INT;
        b : INT; {info 'later'}
        c {attribute 'no_init'} : INT;
        d : INT;
        """
    )
    shown = [[(p.attribute, p.value) if p.attribute else p.text for p in v.attributes] for v in found]
    assert shown == [[("hide", None), ("displaymode", "hex")], ["info 'later'"], [("no_init", None)], []]


def test_attributes_of_blocks_and_objects() -> None:
    pou = one(
        "{attribute 'a'}\n{attribute 'b' := '1'}\nFUNCTION_BLOCK f\n{attribute 'c'}\nVAR\n"
        "{attribute 'd'}\nx : INT;"
        "\nEND_VAR\nEND_FUNCTION_BLOCK",
        ast.Pou,
    )
    assert [p.attribute for p in pou.attributes] == ["a", "b"]
    assert [p.attribute for p in pou.blocks[0].attributes] == ["c"]
    assert [p.attribute for p in pou.blocks[0].variables[0].attributes] == ["d"]


# -- objects


def test_program() -> None:
    pou = one("(* Main *)\nPROGRAM PLC_PRG\nVAR a : INT; END_VAR\na := 1;\nEND_PROGRAM", ast.Pou)
    assert (pou.kind, pou.name, pou.comment, pou.language) == ("PROGRAM", "PLC_PRG", "Main", "ST")
    assert pou.name_span == Span(1, 8, 1, 15)
    assert pou.span == Span(1, 0, 4, 11)
    assert statements(pou.body) == "a := 1;"


def test_function_with_type() -> None:
    pou = one("FUNCTION F : ARRAY[0..1] OF INT\nVAR_INPUT a : INT; END_VAR\nEND_FUNCTION", ast.Pou)
    assert pou.return_type is not None
    assert type_text(pou.return_type) == "ARRAY[0..1] OF INT"
    assert one("FUNCTION F : BOOL;\nEND_FUNCTION", ast.Pou).name == "F"
    assert one("FUNCTION F\nEND_FUNCTION", ast.Pou).return_type is None


def test_function_block_with_everything() -> None:
    pou = one(
        """
        FUNCTION_BLOCK PUBLIC ABSTRACT FB EXTENDS Lib.Base IMPLEMENTS IA, Lib.IB
        VAR_INPUT a : INT; END_VAR
        VAR b : INT; END_VAR
        METHOD PRIVATE FINAL M : BOOL
        VAR_INPUT x : INT; END_VAR
        M := x > 0;
        END_METHOD
        b := 1;
        ACTION Act
        b := 2;
        END_ACTION
        ACTION Act2 :
        END_ACTION
        PROPERTY PROTECTED P : INT
        GET
        VAR t : INT; END_VAR
        P := b;
        END_GET
        SET
        b := P;
        END_SET
        END_PROPERTY
        b := 3;
        END_FUNCTION_BLOCK
        """,
        ast.Pou,
    )
    assert (pou.access, pou.modifiers, pou.extends, pou.implements) == (
        "PUBLIC", {"ABSTRACT"}, "Lib.Base", ["IA", "Lib.IB"],
    )  # fmt: skip
    assert [b.section for b in pou.blocks] == ["VAR_INPUT", "VAR"]
    assert statements(pou.body) == "b := 1; b := 3;"
    (method,) = pou.methods
    assert (method.name, method.access, method.modifiers, method.owner is pou) == (
        "M",
        "PRIVATE",
        {"FINAL"},
        True,
    )
    assert [(a.kind, a.name, statements(a.body)) for a in pou.actions] == [
        ("ACTION", "Act", "b := 2;"),
        ("ACTION", "Act2", ""),
    ]
    (prop,) = pou.properties
    assert prop.type_ref is not None
    assert prop.getter is not None
    assert prop.setter is not None
    assert (prop.access, type_text(prop.type_ref), len(prop.getter.blocks)) == ("PROTECTED", "INT", 1)
    assert (statements(prop.getter.body), statements(prop.setter.body)) == ("P := b;", "b := P;")


def test_words_that_count_by_place_may_be_names() -> None:
    pou = one(
        "FUNCTION_BLOCK Final EXTENDS Public\nVAR get, set, extends, by : INT; END_VAR\n"
        "METHOD Private : INT END_METHOD\nMETHOD Override END_METHOD\nget := set;\nEND_FUNCTION_BLOCK",
        ast.Pou,
    )
    assert (pou.name, pou.extends, [m.name for m in pou.methods]) == (
        "Final",
        "Public",
        ["Private", "Override"],
    )
    assert [v.name for v in pou.blocks[0].variables] == ["get", "set", "extends", "by"]


def test_methods_behind_their_block() -> None:
    (pou,) = read("FUNCTION_BLOCK f END_FUNCTION_BLOCK METHOD m END_METHOD PROPERTY p : INT END_PROPERTY")
    assert isinstance(pou, ast.Pou)
    assert ([m.name for m in pou.methods], [p.name for p in pou.properties]) == (["m"], ["p"])


def test_child_text_of_its_own() -> None:
    method = one(
        "METHOD Start : BOOL\nStart := TRUE;\nEND_METHOD", ast.Pou, owner="FB_Motor", uri="FB_Motor.Start"
    )
    assert (method.kind, method.owner, method.source and method.source.owner) == ("METHOD", None, "FB_Motor")
    action = one("a := 1;\nb();", ast.Pou, owner="FB_Motor", name="Act")
    assert (action.kind, action.name, statements(action.body)) == ("ACTION", "Act", "a := 1; b();")
    prop = one("PROPERTY P : INT\nEND_PROPERTY", ast.Property, owner="FB_Motor")
    assert (prop.getter, prop.setter) == (None, None)


def test_interface() -> None:
    node = one(
        "INTERFACE IMotor EXTENDS IA, Lib.IB\nMETHOD Start : BOOL\nVAR_INPUT v : REAL; END_VAR\nEND_METHOD\n"
        "PROPERTY Speed : REAL\nGET END_GET\nSET END_SET\nEND_PROPERTY\nPROPERTY Q : INT GET SET END_PROPERTY"
        "\nEND_INTERFACE",
        ast.Interface,
    )
    assert (node.name, node.extends) == ("IMotor", ["IA", "Lib.IB"])
    assert [m.name for m in node.methods] == ["Start"]
    assert [(p.name, p.getter is not None, p.setter is not None) for p in node.properties] == [
        ("Speed", True, True),
        ("Q", True, True),
    ]


def test_types() -> None:
    found = read(
        """
        (* A point *)
        TYPE Point :
        STRUCT
            x : INT; (* across *)
            y : INT := 2;
        END_STRUCT
        END_TYPE
        TYPE Point3 EXTENDS Lib.Point : STRUCT z : INT; END_STRUCT; END_TYPE
        {attribute 'qualified_only'}
        TYPE Color : (red, (* like fire *)
            green := 5, blue // like the sea
        ) DINT := green; END_TYPE
        TYPE U : UNION a : LREAL; b : LINT; END_UNION END_TYPE
        TYPE Sub : INT (1..10) := 3; Alias : STRING(50); Arr : ARRAY[0..1] OF Point; END_TYPE
        TYPE INTERNAL Ref : REFERENCE TO INT; END_TYPE
        """
    )
    assert all(isinstance(d, ast.TypeDecl) for d in found)
    by_name = {d.name: d for d in found if isinstance(d, ast.TypeDecl)}
    assert list(by_name) == ["Point", "Point3", "Color", "U", "Sub", "Alias", "Arr", "Ref"]
    assert by_name["Point"].comment == "A point"
    assert type_text(by_name["Point"].type_ref) == "STRUCT x : INT; y : INT := 2; END_STRUCT"
    assert by_name["Point3"].extends == "Lib.Point"
    color = by_name["Color"].type_ref
    assert isinstance(color, ast.EnumType)
    assert type_text(color) == "(red, green := 5, blue) DINT"
    assert [v.comment for v in color.values] == ["like fire", "", "like the sea"]
    assert [p.attribute for p in by_name["Color"].attributes] == ["qualified_only"]
    assert by_name["Color"].initial is not None
    union = by_name["U"].type_ref
    assert isinstance(union, ast.StructType)
    assert union.union
    assert type_text(by_name["Sub"].type_ref) == "INT(1..10)"
    assert type_text(by_name["Ref"].type_ref) == "REFERENCE TO INT"


def test_struct_extends_after_the_keyword() -> None:
    decl = one("TYPE T : STRUCT EXTENDS B a : INT; END_STRUCT END_TYPE", ast.TypeDecl)
    assert (decl.extends, type_text(decl.type_ref)) == ("B", "STRUCT a : INT; END_STRUCT")
    decl = one("TYPE T : STRUCT extends : INT; END_STRUCT END_TYPE", ast.TypeDecl)
    assert (decl.extends, type_text(decl.type_ref)) == (None, "STRUCT extends : INT; END_STRUCT")


def test_global_list() -> None:
    gvl = one(
        "{attribute 'qualified_only'}\n(* Signals *)\nVAR_GLOBAL\na : INT;\nEND_VAR\n"
        "{attribute 'x'}\nVAR_GLOBAL CONSTANT\nc : INT := 1;\nEND_VAR",
        ast.GlobalList,
        name="GVL",
    )
    assert (gvl.name, gvl.comment, [p.attribute for p in gvl.attributes]) == (
        "GVL",
        "Signals",
        ["qualified_only"],
    )
    assert [(b.flags, [v.name for v in b.variables]) for b in gvl.blocks] == [
        (set(), ["a"]),
        ({"CONSTANT"}, ["c"]),
    ]
    assert [p.attribute for p in gvl.blocks[1].attributes] == ["x"]


@pytest.mark.parametrize(
    ("uri", "text", "name"),
    [
        ("dir/GVL_Line.st", "VAR_GLOBAL END_VAR", "GVL_Line"),
        ("C:\\x\\My list.ST", "VAR_GLOBAL END_VAR", "My_list"),
        (
            "main.st",
            "VAR_GLOBAL END_VAR PROGRAM Main END_PROGRAM VAR_GLOBAL a : INT; END_VAR",
            "main_Globals",
        ),
    ],
)
def test_global_list_of_a_file_is_named_after_it(uri: str, text: str, name: str) -> None:
    (gvl,) = (d for d in read(text, uri=uri) if isinstance(d, ast.GlobalList))
    assert gvl.name == name


def test_variable_configuration() -> None:
    gvl = one("VAR_CONFIG PLC_PRG.fb[1, 2].xIn AT %IX1.0 : BOOL; END_VAR", ast.GlobalList, name="Config")
    (decl,) = gvl.blocks[0].variables
    assert (gvl.blocks[0].section, decl.name, decl.address) == ("VAR_CONFIG", "PLC_PRG.fb[1,2].xIn", "%IX1.0")


def test_empty_texts() -> None:
    assert read("") == []
    assert read(" // nothing\n(* here *)\n;") == []


@pytest.mark.parametrize(
    ("text", "expected", "names"),
    [
        ("PROGRM P a := 1; END_PROGRAM FUNCTION F : INT END_FUNCTION", ["1:1 E0108"], ["F"]),
        ("a", ["1:1 E0108"], []),
        ("END_VAR", ["1:1 E0106"], []),
        ("PROGRAM\nVAR a : INT; END_VAR END_PROGRAM", ["2:1 E0109"], [""]),
        ("FUNCTION F INT\nVAR END_VAR\nEND_FUNCTION", ["1:12 E0101"], ["F"]),
        ("PROGRAM P : INT\nEND_PROGRAM", ["1:11 E0101"], ["P"]),
        ("FUNCTION_BLOCK F EXTENDS\nEND_FUNCTION_BLOCK", ["2:1 E0109"], ["F"]),
        ("PROGRAM P\na := 1;", ["2:8 E0103"], ["P"]),
        ("PROGRAM P END_FUNCTION\nPROGRAM Q END_PROGRAM", ["1:11 E0110"], ["P", "Q"]),
        ("PROGRAM P a(); END_METHOD b(); END_PROGRAM", ["1:16 E0106"], ["P"]),
        ("FUNCTION_BLOCK F METHOD M\nEND_FUNCTION_BLOCK", ["2:1 E0103"], ["F"]),
        ("PROGRAM P a := 1; VAR b : INT; END_VAR END_PROGRAM", ["1:19 E0112"], ["P"]),
        ("INTERFACE I x := 1; METHOD m END_METHOD END_INTERFACE", ["1:13 E0114"], ["I"]),
        ("PROPERTY P INT\nEND_PROPERTY", ["1:12 E0101"], ["P"]),
        ("PROPERTY P : INT\na := 1;\nEND_PROPERTY", ["1:16 E0101"], ["P"]),
        ("PROPERTY P : INT VAR a : INT; END_VAR GET END_GET END_PROPERTY", ["1:18 E0114"], ["P"]),
        ("TYPE T STRUCT a : INT; END_STRUCT END_TYPE", ["1:8 E0101"], ["T"]),
        ("TYPE END_TYPE", ["1:6 E0109"], []),
        ("TYPE E : (a, b c, d) END_TYPE", ["1:16 E0101"], ["E"]),
        ("TYPE A : INT END_TYPE", [], ["A"]),
        ("VAR_GLOBAL a : INT;", ["1:20 E0103"], ["x"]),
        ("PROGRAM P STRUCT a : INT; END_STRUCT END_PROGRAM", ["1:11 E0114"], ["P"]),
    ],
)
def test_faulty_object_keeps_what_is_right(text: str, expected: list[str], names: list[str]) -> None:
    result = parse(Source("x.st", text))
    assert codes(result.diagnostics) == expected
    assert [d.name for d in result.unit.declarations] == names


@pytest.mark.parametrize(
    ("text", "expected", "kept"),
    [
        ("a INT; b : INT;", ["2:3 E0101"], ["a : INT;", "b : INT;"]),
        ("a : INT\nb : INT;", ["2:7 E0101"], ["a : INT;", "b : INT;"]),
        ("a : ; b : INT;", ["2:5 E0101"], ["a : ;", "b : INT;"]),
        ("a : INT = 5; b : INT;", ["2:9 E0101"], ["a : INT := 5;", "b : INT;"]),
        ("a, : INT; b : INT;", ["2:4 E0109"], ["a : INT;", " : INT;", "b : INT;"]),
        ("my new var : INT;", ["2:1 E0111"], ["my_new_var : INT;"]),
        ("MOD : INT; b : INT;", ["2:1 E0105"], ["MOD : INT;", "b : INT;"]),
        ("IF, THEN : INT; b : INT;", ["2:1 E0105", "2:5 E0105"], ["IF : INT;", "THEN : INT;", "b : INT;"]),
        ("5 : INT; b : INT;", ["2:1 E0109"], ["b : INT;"]),
        ("a := 5; b : INT;", ["2:3 E0101"], ["a :  := 5;", "b : INT;"]),
        ("a AT : BOOL; b : INT;", ["2:6 E0101"], ["a : BOOL;", "b : INT;"]),
        ("a : ARRAY[1..] OF INT; b : INT;", ["2:14 E0104"], ["a : ARRAY[1..?] OF INT;", "b : INT;"]),
        ("a : ARRAY OF INT; b : INT;", ["2:11 E0101"], ["a : ARRAY[] OF INT;", "b : INT;"]),
        ("a : ARRAY[1..2] INT; b : INT;", ["2:17 E0101"], ["a : ARRAY[1..2] OF INT;", "b : INT;"]),
        ("a : POINTER INT; b : INT;", ["2:13 E0101"], ["a : POINTER TO INT;", "b : INT;"]),
        ("a : PARAMS OF INT; b : INT;", ["2:5 E0113"], ["a : INT;", "b : INT;"]),
        ("a : INT := ; b : INT;", ["2:12 E0104"], ["a : INT := ?;", "b : INT;"]),
    ],
)
def test_faulty_variable_keeps_what_is_right(text: str, expected: list[str], kept: list[str]) -> None:
    result = parse(Source("x", f"PROGRAM p VAR\n{text}\nEND_VAR END_PROGRAM"))
    assert codes(result.diagnostics) == expected
    (pou,) = result.unit.declarations
    assert isinstance(pou, ast.Pou)
    assert [variable(v) for v in pou.blocks[0].variables] == kept


@pytest.mark.parametrize(
    "rest", ["IF a THEN a(); END_IF", "a(1);", "a.b := 1;", "a[1] := 2;", "FOR i := 1 TO 2 DO END_FOR"]
)
def test_missing_end_var_is_found_at_the_first_statement(rest: str) -> None:
    result = parse(Source("x", f"PROGRAM p\nVAR\na : INT;\n{rest}\nEND_PROGRAM"))
    assert codes(result.diagnostics) == ["4:1 E0103"]
    (pou,) = result.unit.declarations
    assert isinstance(pou, ast.Pou)
    assert len(pou.body) == 1
