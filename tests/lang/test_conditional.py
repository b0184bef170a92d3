"""Conditional pragmas: which text is compiled (spec LPRG-50..LPRG-73)."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from st_text import codes, statements

from tappet.lang import ast
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.parser import ParseResult
from tappet.lang.source import Source, Span

OTHERS = [
    "VAR_GLOBAL\n{attribute 'DoCount'}\ng_count : INT;\ng_real : LREAL; g_text : T_Text;\nEND_VAR",
    "TYPE DUT : STRUCT a : INT; END_STRUCT; T_Text : STRING(20); END_TYPE",
    "{attribute 'vision'}\nFUNCTION fun1 : INT\nEND_FUNCTION",
    "FUNCTION_BLOCK FB_x\nACTION Act END_ACTION\nEND_FUNCTION_BLOCK",
    "INTERFACE I_x END_INTERFACE",
    "VAR_GLOBAL g_clock : LTOD; g_bit : BIT; END_VAR",
]


def read(text: str, **options: object) -> ParseResult:
    sources = [Source("PLC_PRG", text), Source("GVL_1", OTHERS[0], name="GVL_1")]
    sources += [Source(f"o{n}", other) for n, other in enumerate(OTHERS[1:])]
    return parse_sources(sources, ParseOptions(**options))[0]  # type: ignore[arg-type]


def body(code: str, **options: object) -> str:
    result = read(f"PROGRAM PLC_PRG\nVAR x : INT; END_VAR\n{code}\nEND_PROGRAM", **options)
    assert [str(d) for d in result.diagnostics] == []
    (program,) = result.unit.declarations
    assert isinstance(program, ast.Pou)
    return statements(program.body)


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("defined (hallo)", False),
        ("defined (GIVEN)", True),
        ("DEFINED(given)", True),
        ("defined (variable: x)", True),
        ("defined (variable: g_count)", True),
        ("defined (variable: GVL_1.g_count)", True),
        ("defined (variable:nothing)", False),
        ("defined (type:DUT)", True),
        ("defined (type: FB_x)", True),
        ("defined (type: I_x)", True),
        ("defined (type: INT)", False),
        ("defined (pou:fun1)", True),
        ("defined (pou: FB_x.Act)", True),
        ("defined (pou: CheckBounds)", False),
        ("defined (task: MainTask)", True),
        ("defined (task: Other)", False),
        ("defined (resource: GVL_1)", True),
        ("defined (resource: GVL_2)", False),
        ("hasattribute (pou: fun1, 'vision')", True),
        ("hasattribute (pou: fun1, 'sound')", False),
        ("hasattribute (variable: g_count, 'docount')", True),
        ("hasattribute (variable: g_real, 'DoCount')", False),
        ("hastype (variable: g_real, LREAL)", True),
        ("hastype (variable: g_real, ANY_NUM)", True),
        ("hastype (variable: g_real, ANY_INT)", False),
        ("hastype (variable: g_text, STRING)", True),
        ("hastype (variable: g_clock, LTIME_OF_DAY)", True),
        ("hastype (variable: g_clock, ANY_DATE)", True),
        ("hastype (variable: g_clock, ANY_MAGNITUDE)", False),
        ("hastype (variable: g_bit, BIT)", True),
        ("hastype (variable: g_bit, BOOL)", False),
        ("hastype (variable: g_text, T_Text)", True),
        ("hastype (variable: x, ANY_MAGNITUDE)", True),
        ("hastype (variable: x, ANY_BIT)", False),
        ("hastype (variable: x, ANY_DERIVED)", False),
        ("hastype (variable: x, ANY)", True),
        ("hasvalue (GIVEN, '7')", True),
        ("hasvalue (GIVEN, '8')", False),
        ("hasvalue (nothing, '')", False),
        ("NOT defined (hallo)", True),
        ("defined (type: DUT) AND NOT (defined (pou: CheckBounds))", True),
        ("defined (pou: CheckBounds) AND (defined (type: DUT))", False),
        ("defined (pou: CheckBounds) OR (defined (type: DUT))", True),
        ("(TRUE)", True),
        ("0", False),
    ],
)
def test_condition(condition: str, holds: bool) -> None:
    code = f"{{IF {condition}}}\na();\n{{ELSE}}\nb();\n{{END_IF}}"
    assert body(code, defines={"GIVEN": "7"}, tasks=["MainTask"]) == ("a();" if holds else "b();")


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("{define hallo}{IF defined (hallo)} a(); {END_IF}", "a();"),
        ("{define hallo}{undefine hallo}{IF defined (hallo)} a(); {END_IF}", ""),
        ("{undefine nothing} a();", "a();"),
        ("{define t '2'}{IF hasvalue(t,'1')} a(); {ELSIF hasvalue(t,'2')} b(); {ELSE} c(); {END_IF}", "b();"),
        ("{IF TRUE} a(); {ELSIF TRUE} b(); {ELSE} c(); {END_IF} d();", "a(); d();"),
        ("{IF FALSE}{IF TRUE} a(); {ELSE} b(); {END_IF}{ELSE}{IF TRUE} c(); {END_IF}{END_IF}", "c();"),
        ("{IF FALSE} this is ' not ST\n at \" all )\n{ELSE} a(); {END_IF}", "a();"),
        ("IF x = 1 {IF FALSE} AND y {END_IF} THEN a(); END_IF", "IF (x = 1) THEN a(); END_IF"),
        ("{IF FALSE} IF p THEN {ELSE} IF q THEN {END_IF} a(); END_IF", "IF q THEN a(); END_IF"),
        ("{define LIMIT_X 25} x := limit_x + 1;", "x := (25 + 1);"),
        ("{define SUM (a + b)} x := SUM * 2; {undefine SUM} x := SUM;", "x := ((a + b) * 2); x := SUM;"),
        ("{IF FALSE}{define LATE 1}{END_IF} x := LATE;", "x := LATE;"),
        ("{IF FALSE}{info 'never'}{END_IF} {info 'shown'}", "{info 'shown'}"),
        ("{include 'part.st'} c();", "a(); b(); c();"),
    ],
)
def test_compiled_text(code: str, expected: str) -> None:
    assert body(code, include={"part.st": "a(); // x\nb();"}.get) == expected


def test_declarations_depend_on_conditions_of_other_texts() -> None:
    first = "VAR_GLOBAL {IF defined (type: T_Late)} a : INT; {END_IF} END_VAR"
    second = "TYPE {IF TRUE} T_Late : INT; {END_IF} END_TYPE"
    result = parse_sources([Source("g", first), Source("t", second)])[0]
    (gvl,) = result.unit.declarations
    assert isinstance(gvl, ast.GlobalList)
    assert [v.name for v in gvl.blocks[0].variables] == ["a"]


def test_local_variables_are_seen_by_children_of_the_block() -> None:
    block = Source("FB", "FUNCTION_BLOCK FB VAR x : INT; END_VAR END_FUNCTION_BLOCK")
    child = Source("FB.A", "ACTION A {IF defined (variable: x)} a(); {END_IF} END_ACTION", owner="FB")
    action = parse_sources([block, child])[1].unit.declarations[0]
    assert isinstance(action, ast.Pou)
    assert statements(action.body) == "a();"


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("{IF TRUE} a();", ["3:1 E0020"]),
        ("{END_IF}", ["3:1 E0021"]),
        ("{IF TRUE}{ELSE}{ELSE}{END_IF}", ["3:16 E0021"]),
        ("{IF TRUE}{ELSE}{ELSIF TRUE}{END_IF}", ["3:16 E0021"]),
        ("{IF hello}{END_IF}", ["3:1 E0022"]),
        ("{IF}{END_IF}", ["3:1 E0022"]),
        ("{IF defined (thing: x)}{END_IF}", ["3:1 E0022"]),
        ("{IF defined (x) defined (y)}{END_IF}", ["3:1 E0022"]),
        ("{IF hastype (pou: x, INT)}{END_IF}", ["3:1 E0022"]),
        ("{IF " + "(" * 5000 + "}{END_IF}", ["3:1 E0022"]),
        ("{define 5}", ["3:1 E0022"]),
        ("{include 'does_not_exist.st'}", ["3:1 E0023"]),
        ("{IF FALSE} 'open\n{END_IF} a()", ["4:12 E0101"]),
    ],
)
def test_mistakes(code: str, expected: list[str]) -> None:
    result = read(f"PROGRAM PLC_PRG\nVAR x : INT; END_VAR\n{code}\nEND_PROGRAM")
    assert codes(result.diagnostics) == expected


def test_places_left_out_are_told() -> None:
    result = read("PROGRAM p\n{IF FALSE} a(); {ELSE}\nb();\n{END_IF}\nEND_PROGRAM")
    assert result.inactive == (Span(1, 10, 1, 16),)


def test_include_cannot_go_on_forever() -> None:
    result = parse_sources([Source("x", "{include a}")], ParseOptions(include=lambda name: "{include a} "))[0]
    assert {d.code for d in result.diagnostics} == {"E0023"}


@given(
    st.lists(
        st.sampled_from(
            [
                "{IF TRUE}",
                "{IF FALSE}",
                "{ELSIF defined(a)}",
                "{ELSE}",
                "{END_IF}",
                "{define a b}",
                "{undefine a}",
                "a",
            ]
        ),
        max_size=20,
    )
)
def test_any_order_of_pragmas_gives_a_tree(pieces: list[str]) -> None:
    read("PROGRAM p " + "\n".join(pieces) + ";\nEND_PROGRAM")


@given(st.text(alphabet="()adefinhs:,' .ANDORT01", max_size=40))
def test_any_condition_is_understood_or_reported(condition: str) -> None:
    result = read(f"PROGRAM p\n{{IF {condition}}}\na();\n{{END_IF}}\nEND_PROGRAM")
    assert all(d.span.line == 1 for d in result.diagnostics)
