"""Reading declarations that need not compile: sub-kinds, header names, the split of a whole text."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.iec.parameter_list import as_parameter_list, is_parameter_list
from tappet.iec.sections import declaration_end, end_keyword, rename_header, subkind_of
from tappet.iec.trivia import attribute_of
from tappet.iec.words import SECTIONS


@pytest.mark.parametrize(
    ("text", "subkind"),
    [
        ("PROGRAM PLC_PRG", "program"),
        ("program p", "program"),
        (
            "{attribute 'qualified_only'}\n(* a (* nested *) note *)\n// x\nFUNCTION_BLOCK PUBLIC FB",
            "function_block",
        ),
        ("FUNCTION F : INT", "function"),
        ("METHOD PRIVATE m", "method"),
        ("VAR_GLOBAL CONSTANT\nEND_VAR", "gvl"),
        ("TYPE T : STRUCT END_STRUCT END_TYPE", "struct"),
        ("TYPE T EXTENDS Base :\nSTRUCT END_STRUCT END_TYPE", "struct"),
        ("TYPE T : UNION END_UNION END_TYPE", "union"),
        ("TYPE PUBLIC T : (a, b := 5) DINT; END_TYPE", "enum"),
        ("TYPE T : INT (0..10); END_TYPE", "subrange"),
        ("TYPE T : STRING(80); END_TYPE", "alias"),
        ("TYPE T : ARRAY[0..3] OF INT; END_TYPE", "alias"),
        ("TYPE T END_TYPE", None),
        ("TYPE", None),
        ("", None),
        ("(* open", None),
        ("x := 1;", None),
    ],
)
def test_subkinds(text: str, subkind: str | None) -> None:
    assert subkind_of(text) == subkind


@pytest.mark.parametrize(
    ("text", "renamed"),
    [
        ("PROGRAM Old\nVAR\nEND_VAR", "PROGRAM New\nVAR\nEND_VAR"),
        (
            "(* Old *) FUNCTION_BLOCK ABSTRACT old EXTENDS Old",
            "(* Old *) FUNCTION_BLOCK ABSTRACT New EXTENDS Old",
        ),
        ("METHOD PUBLIC FINAL Old : INT", "METHOD PUBLIC FINAL New : INT"),
        ("TYPE Old :\nSTRUCT", "TYPE New :\nSTRUCT"),
        ("VAR_GLOBAL\nOld : INT;", "VAR_GLOBAL\nOld : INT;"),
        ("PROGRAM", "PROGRAM"),
        ("PROGRAM\nOld\nVAR\nEND_VAR", "PROGRAM\nNew\nVAR\nEND_VAR"),
        ("PROGRAM\nx := 1;", "PROGRAM\nx := 1;"),
        ("METHOD END_VAR", "METHOD END_VAR"),
        ("PROGRAM\nVAR", "PROGRAM\nVAR"),
        ("nonsense", "nonsense"),
    ],
)
def test_renaming_the_header(text: str, renamed: str) -> None:
    assert rename_header(text, "New") == renamed


@pytest.mark.parametrize(
    "text",
    [
        "PROGRAM P\nVAR\n  x : INT;\nEND_VAR|\nx := 1;",
        "PROGRAM P\nVAR\nEND_VAR\nVAR_INPUT\nEND_VAR // last (* one|\nx := 1;",
        "PROGRAM P\nVAR\nEND_VAR (* goes\non *) (* and on *)|\nx := 1;",
        "PROGRAM P\nVAR\nEND_VAR| x := 1;\ny := 2;",
        "PROGRAM P\nVAR (* END_VAR *)\ns : STRING := 'END_VAR';\nEND_VAR|\n(* VAR END_VAR *)\nx := 1;",
        "PROGRAM P|\nx := 1;",
        "PROGRAM\nP\nVAR\nEND_VAR|\nx := 1;",
        "PROGRAM (* name below *)\n\nP|\nx := 1;",
        "FUNCTION_BLOCK\nABSTRACT FB\nEXTENDS Base|\nx();",
        "PROGRAM|\nx := 1;",
        "PROGRAM|\ntimer(IN := TRUE);",
        "METHOD PRIVATE|\nTHIS.x := 1;",
        "FUNCTION F : ARRAY[0..3] OF\nINT|\nF := 1;",
        "FUNCTION F : INT;|\nF := 1;",
        "FUNCTION_BLOCK FB\n  EXTENDS Base\n  IMPLEMENTS A,\n  B|\nx();",
        "FUNCTION_BLOCK FB EXTENDS Base\nVAR\nEND_VAR|\nIF x THEN VAR := 1; END_IF",
        "FUNCTION_BLOCK FB|\nEND_FUNCTION_BLOCK",
        "METHOD m : BOOL\n\n// nothing declared\nVAR_INPUT\nEND_VAR|\n",
        "VAR\nEND_VAR|\nSpeed := 3;",
        "|x := 1;",
        "|",
        "PROGRAM P\nVAR\n x : INT;|",
    ],
)
def test_where_the_body_begins(text: str) -> None:
    assert declaration_end(text.replace("|", "")) == text.index("|")


def test_end_keywords() -> None:
    assert end_keyword("FUNCTION_BLOCK FB") == "END_FUNCTION_BLOCK"
    assert end_keyword("VAR_GLOBAL") is None
    assert end_keyword("?") is None


PIECES = st.sampled_from(
    [
        "PROGRAM P",
        "VAR",
        "END_VAR",
        "TYPE T :",
        "(*",
        "*)",
        "//",
        "\n",
        " ",
        "'",
        '"',
        "{",
        "}",
        "x := 1;",
        "é",
        ":",
        "(",
    ]
)


@given(st.lists(PIECES, max_size=30).map("".join) | st.text(max_size=200))
def test_any_text_is_read(text: str) -> None:
    assert 0 <= declaration_end(text) <= len(text)
    subkind_of(text)
    end_keyword(text)
    rename_header(text, "New")


@pytest.mark.parametrize(
    ("text", "marked"),
    [
        ("VAR_GLOBAL CONSTANT\nEND_VAR", "{attribute 'parameter_list'}\nVAR_GLOBAL CONSTANT\nEND_VAR"),
        (
            "// {attribute 'parameter_list'}\n{attribute 'qualified_only'} VAR_GLOBAL CONSTANT END_VAR",
            "// {attribute 'parameter_list'}\n{attribute 'parameter_list'}\n"
            "{attribute 'qualified_only'} VAR_GLOBAL CONSTANT END_VAR",
        ),
        ("", "{attribute 'parameter_list'}\n"),
    ],
)
def test_the_mark_of_a_parameter_list(text: str, marked: str) -> None:
    assert not is_parameter_list(text)
    assert as_parameter_list(text) == as_parameter_list(marked) == marked
    assert is_parameter_list(marked.replace("{attribute 'parameter_list'}", "{ ATTRIBUTE 'Parameter_List' }"))


BLOCKS = st.sampled_from(sorted(SECTIONS - {"VAR_GENERIC"})).map(
    lambda keyword: f"{keyword}\n    x : INT; // END_VAR\nEND_VAR"
)
GENERIC = st.sampled_from(["", "\nVAR_GENERIC CONSTANT\n    N : INT; (* EXTENDS *)\nEND_VAR"])
BASES = st.sampled_from(["", " EXTENDS Base", "\nEXTENDS Base", "\nEXTENDS Base IMPLEMENTS Itf, Itf2"])
BODIES = st.sampled_from(["", "a := 1;", "var_x := 1;\nIF a THEN\nEND_IF", "// note\nEXTENDS_x := 2;"])


@given(GENERIC, BASES, st.lists(BLOCKS, max_size=4), BODIES)
def test_the_body_begins_behind_the_last_section(
    generic: str, bases: str, blocks: list[str], body: str
) -> None:
    declaration = "\n".join([f"FUNCTION_BLOCK FB{generic}{bases}", *blocks])
    assert declaration_end(f"{declaration}\n{body}") == len(declaration)


@pytest.mark.parametrize(
    ("pragma", "name", "value"),
    [
        ("{attribute 'hide'}", "hide", None),
        ("{ ATTRIBUTE 'a' := 'b' }", "a", "b"),
        ("{attribute 'obsolete' := 'it$'s $$5'}", "obsolete", "it's $5"),
        ("{attribute 'obsolete' := 'last$''}", "obsolete", "last'"),
        ("{attribute 'a' := 5}", "a", "5"),
    ],
)
def test_attributes(pragma: str, name: str, value: str | None) -> None:
    assert attribute_of(pragma) == (name, value)
    assert attribute_of(pragma.replace("attribute", "region").replace("ATTRIBUTE", "region")) is None
