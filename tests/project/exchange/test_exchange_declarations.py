"""Exports without the plain texts, as other tools read them: the elements say all that declarations say."""

from __future__ import annotations

import re

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.plcopen_write import write_plcopen

_PLAIN = re.compile(
    rb'\s*<data name="[^"]*interfaceasplaintext"[^>]*>.*?</data>'
    rb"|\s*<InterfaceAsPlainText>.*?</InterfaceAsPlainText>",
    re.DOTALL,
)


def through_elements(text: str) -> dict[str, str]:
    """The declarations of a text by name, after an export whose plain texts a tool has dropped."""
    whole = write_plcopen(import_files({"a.st": text.encode()}).project)
    again = import_files({"x.xml": _PLAIN.sub(b"", whole)}).project
    assert _PLAIN.search(whole) is not None
    return {
        item.name: item.data.declaration.rstrip("\n")
        for item in again.walk()
        if hasattr(item.data, "declaration")
    }


def unchanged(name: str, text: str, end: str = "") -> None:
    """A declaration in the form that the import writes comes back as it was."""
    assert through_elements(f"{text}\n{end}")[name] == text


def test_header_of_a_block() -> None:
    unchanged(
        "FB_Last",
        """// Moves the last axis.
// Not for others.
{attribute 'hide'}
{attribute 'displaymode' := 'it$'s hex'}
FUNCTION_BLOCK INTERNAL FINAL FB_Last EXTENDS Lib.FB_Base IMPLEMENTS I_One, I_Two
VAR_INPUT CONSTANT
    k : INT := 3;
END_VAR
{attribute 'section'}
VAR_INPUT
    {attribute 'x' := 'y'}
    i AT %IX0.1 : BOOL; // the input
    // two
    // lines
    j : STRING(20) := 'a; := b';
END_VAR
VAR_IN_OUT CONSTANT
    c : ST_Big;
END_VAR
VAR RETAIN PERSISTENT
    r : ARRAY[0..3, 1..2] OF POINTER TO INT;
END_VAR
VAR
    fb : FB_Other(n := 3, s := F(1, b := 2)) := (a := 1);
    sub : INT (-5..5);
    ref : REFERENCE TO Lib.ST_Data;
END_VAR
VAR_STAT
    s : INT;
END_VAR""",
        "END_FUNCTION_BLOCK",
    )


def test_members_of_blocks_and_interfaces() -> None:
    found = through_elements("""
INTERFACE I_Run EXTENDS I_Base, I_More
METHOD Run : BOOL
END_METHOD
END_INTERFACE
FUNCTION_BLOCK ABSTRACT FB_Run
// runs
{attribute 'm'}
METHOD PROTECTED ABSTRACT Go : REFERENCE TO INT
VAR_INST
    v : INT;
END_VAR
END_METHOD
PROPERTY PRIVATE Speed : REAL
GET
VAR
    x : INT;
END_VAR
END_GET
END_PROPERTY
END_FUNCTION_BLOCK
FUNCTION INTERNAL F_Sum : LREAL
VAR_INPUT
    a : ARRAY[*] OF LREAL;
END_VAR
END_FUNCTION""")
    assert found["I_Run"] == "INTERFACE I_Run EXTENDS I_Base, I_More"
    assert found["FB_Run"] == "FUNCTION_BLOCK ABSTRACT FB_Run"
    assert found["Go"].split("\n")[:3] == [
        "// runs",
        "{attribute 'm'}",
        "METHOD PROTECTED ABSTRACT Go : REFERENCE TO INT",
    ]
    assert "VAR_INST\n    v : INT;\nEND_VAR" in found["Go"]
    assert found["Speed"] == "PROPERTY PRIVATE Speed : REAL"
    assert found["Get"] == "VAR\n    x : INT;\nEND_VAR"
    assert found["F_Sum"].split("\n")[0] == "FUNCTION INTERNAL F_Sum : LREAL"
    assert "a : ARRAY[*] OF LREAL;" in found["F_Sum"]


def test_types() -> None:
    unchanged(
        "E_Mode",
        """// The mode
{attribute 'strict'}
TYPE E_Mode :
(
    Idle := 0, // waiting
    Busy := 16#10, // working, really
    Done // last
) UINT := Busy;
END_TYPE""",
    )
    unchanged(
        "ST_More",
        """{attribute 'pack_mode' := '1'}
TYPE ST_More EXTENDS ST_Base :
STRUCT
    {attribute 'x'}
    a : INT := 3; // behind
    b AT %I* : BOOL;
    c : ARRAY[0..1] OF INT := [1, 2];
END_STRUCT
END_TYPE""",
    )
    unchanged("U_Any", "TYPE U_Any :\nUNION\n    r : REAL;\n    d : DWORD; // bits\nEND_UNION\nEND_TYPE")
    unchanged("T_Part", "TYPE T_Part : INT (0..100) := 5;\nEND_TYPE")
    unchanged("T_Name", "TYPE T_Name : STRING(20) := 'x';\nEND_TYPE")


def test_lists_of_several_sections() -> None:
    text = """// limits
{attribute 'qualified_only'}
VAR_GLOBAL CONSTANT
    N : INT := 3; // how many
END_VAR
{attribute 'linkalways'}
VAR_GLOBAL PERSISTENT
    {attribute 'init'}
    g : INT;
END_VAR"""
    assert through_elements(text)["a"] == text


NAMES = st.from_regex(r"[a-h][a-z]{0,4}_", fullmatch=True)
TEXTS = st.text('abc <>&"$;:=', min_size=1, max_size=8).map(str.strip).filter(bool)
VALUES = TEXTS.map(lambda text: text.replace("$", "$$"))
PRAGMAS = st.tuples(NAMES, VALUES | st.just("")).map(
    lambda pair: f"{{attribute '{pair[0]}'" + (f" := '{pair[1]}'}}" if pair[1] else "}")
)
TYPES = st.sampled_from(
    ["INT", "STRING", "WSTRING(5)", "ARRAY[0..N] OF Lib.T_A", "POINTER TO ST_B", "SINT (-3..3)", "T_C"]
)
INITIAL = st.sampled_from(["", " := 3", " := (a := 1, b := [2(3)])", " := 'x; $'//'", " := F(x := 1)"])
COMMENTS = st.just("") | st.from_regex(r" // [a-z<&]{1,5}( [a-z>{'(]{1,4})?", fullmatch=True)
SECTIONS = st.sampled_from(
    ["VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR CONSTANT", "VAR RETAIN", "VAR_TEMP"]
)


@st.composite
def blocks(draw: st.DrawFn) -> str:
    """A block in the form that the import writes; elements keep no order of sections without a place."""
    above = draw(st.lists(PRAGMAS, max_size=2, unique=True))
    words = draw(st.sampled_from(["", "PUBLIC ", "INTERNAL ABSTRACT ", "FINAL "]))
    bases = draw(st.sampled_from(["", " EXTENDS A", " IMPLEMENTS I, J", " EXTENDS L.A IMPLEMENTS I"]))
    lines = [*above, f"FUNCTION_BLOCK {words}FB_Any{bases}"]
    for section in draw(st.lists(SECTIONS, max_size=4)):
        lines += [*draw(st.lists(PRAGMAS, max_size=1)), section]
        for name in draw(st.lists(NAMES, min_size=1, max_size=3, unique=True)):
            lines += [f"    {pragma}" for pragma in draw(st.lists(PRAGMAS, max_size=2))]
            place = draw(st.sampled_from(["", " AT %QW3"]))
            lines.append(f"    {name}{place} : {draw(TYPES)}{draw(INITIAL)};{draw(COMMENTS)}")
        lines.append("END_VAR")
    return "\n".join(lines)


@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(blocks())
def test_any_block(text: str) -> None:
    unchanged("FB_Any", text, "END_FUNCTION_BLOCK")
