"""Comments, pragmas and strings that hold words of declarations: every importer reads them as such."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.iec.tokens import code_of
from tappet.project.exchange.declaration_sections import read_head, read_sections
from tappet.project.exchange.importing import Imported, import_files
from tappet.project.exchange.plcopen_matiec import rewritten

NOTES = [
    "", "(* END_VAR *)", "(* (* END_PROGRAM *) VAR *)", "(*'*)", "(* $' *)", "// END_VAR 'x",
    "// (* PROGRAM C",
    "(* PROGRAM C\nVAR *)", "{warning disable W1204}", "{region 'END_VAR'}", "(* TASK t (PRIORITY := 3); *)",
    "/* END_TYPE\n' */",
]  # fmt: skip
"""What may stand behind any word; a line end follows."""
FLAT_NOTES = ["(* (* *)", "(* (*(*)", "(* ' (* END_VAR *)", "(* x (*)", "(**)", ""]
"""The same in a dialect whose comments do not nest."""
STRINGS = [
    "'END_VAR'", "'$''", "'it$'s END_PROGRAM'", "'$$'", "'(*'", "'*)'", "'//'", "'{'", "'}'", "''", "'a;b'",
    "'TASK t (INTERVAL := T#1s);'", "';$R$NEND_VAR$R$N'", "'\"'", "'PROGRAM C'",
]  # fmt: skip
notes, flat_notes, strings = st.sampled_from(NOTES), st.sampled_from(FLAT_NOTES), st.sampled_from(STRINGS)


@st.composite
def programs(draw: st.DrawFn, note: st.SearchStrategy[str] = notes) -> list[tuple[str, str, str]]:
    """Name, declaration and body of programs."""
    found = []
    for name in ("A", "B"):
        lines = [
            f"{draw(note)}\n    s{i} : STRING := {draw(strings)};" for i in range(draw(st.integers(1, 3)))
        ]
        variables = "".join(lines)
        declaration = f"PROGRAM {name}\nVAR {variables} {draw(note)}\nEND_VAR"
        body = f"s0 := {draw(strings)}; {draw(note)}\ns0 := CONCAT(s0, {draw(strings)}); {draw(note)}"
        found.append((name, declaration, body))
    return found


def imported(name: str, text: str) -> Imported:
    return import_files({name: text.encode()})


def texts(done: Imported) -> dict[str, tuple[str, str]]:
    """Declaration and body of each POU, with single blanks."""
    found = {}
    for item in done.project.find_kind("pou"):
        data = item.data.model_dump()
        found[item.name] = (spaced(data["declaration"]), spaced(data["implementation"]))
    return found


def spaced(text: str) -> str:
    return " ".join(text.split())


@pytest.mark.parametrize("file", ["plain.st", "blocks.exp"])
@settings(max_examples=60, deadline=None)
@given(found=programs())
def test_programs_of_a_text(file: str, found: list[tuple[str, str, str]]) -> None:
    done = imported(file, "\n\n".join(f"{head}\n{body}\nEND_PROGRAM" for _, head, body in found))
    assert texts(done) == {name: (spaced(head), spaced(body)) for name, head, body in found}


@settings(max_examples=60, deadline=None)
@given(programs(flat_notes))
def test_comments_of_an_export_that_do_not_nest(found: list[tuple[str, str, str]]) -> None:
    """What is no comment stays as it is; the comments end where they ended."""
    mark = "(* @NESTEDCOMMENTS := 'No' *)\n"
    ending = "(* @END_DECLARATION := '0' *)"
    done = imported(
        "b.exp", "\n\n".join(f"{mark}{head}\n{ending}\n{body}\nEND_PROGRAM" for _, head, body in found)
    )
    plain = {name: (head, body) for name, head, body in found}
    for name, parts in texts(done).items():
        for now, written in zip(parts, plain.pop(name), strict=True):
            assert spaced(code_of(now)) == spaced(code_of(without_flat(written)))
            assert [s for s in STRINGS if s in now] == [s for s in STRINGS if s in spaced(written)]
    assert plain == {}


def without_flat(text: str) -> str:
    for note in filter(None, FLAT_NOTES):
        text = text.replace(f"{note}\n", "\n")
    return text


@settings(max_examples=60, deadline=None)
@given(notes, strings, notes, notes, strings)
def test_the_configuration_of_a_text(one: str, text: str, two: str, three: str, other: str) -> None:
    done = imported(
        "plain.st",
        f"PROGRAM Main\nEND_PROGRAM\nCONFIGURATION C {one}\n"
        f"VAR_GLOBAL {two}\n g : STRING := {text}; {three}\n"
        f"END_VAR\nRESOURCE R ON PLC {one}\nVAR_GLOBAL h : STRING := {other}; END_VAR\n"
        f"TASK t1 {two}\n(INTERVAL := {three}\nT#20ms, PRIORITY := 5); {one}\n"
        f"PROGRAM m1 {three}\nWITH t1 : Main;\n"
        "END_RESOURCE\nEND_CONFIGURATION\n",
    )
    (task,) = (item for item in done.project.find_kind("task") if item.name == "t1")
    data = task.data.model_dump()
    assert (data["interval"], data["priority"]) == ("T#20ms", 5)
    assert [call["name"] for call in data["pous"]] == ["Main"]
    lists = [item.data.model_dump()["declaration"] for item in done.project.find_kind("gvl")]
    found = [
        (v.name, v.initial) for item in lists for section in read_sections(item) for v in section.variables
    ]
    assert found == [("g", text), ("h", other)]


@settings(max_examples=60, deadline=None)
@given(notes, strings, notes)
def test_the_tasks_of_an_export(one: str, text: str, two: str) -> None:
    done = imported(
        "blocks.exp",
        f"PROGRAM PLC_PRG\nVAR s : STRING := {text}; END_VAR\nEND_PROGRAM\n\nRESOURCE\n"
        f"{{event_task : 'start','TASK x (',''}}\n"
        f"TASK main {one}\n(PRIORITY := 1, {two}\nINTERVAL := T#3ms);\nPLC_PRG(); {one}\n"
        f"LOG(s := {text}, n := F(1)); {two}\n{{Additional_info : 1,0}}\nEND_TASK\nEND_RESOURCE\n",
    )
    tasks = {item.name: item.data.model_dump() for item in done.project.find_kind("task")}
    assert list(tasks) == ["main"]
    assert (tasks["main"]["interval"], tasks["main"]["priority"]) == ("T#3ms", 1)
    assert [call["name"] for call in tasks["main"]["pous"]] == ["PLC_PRG", "LOG"]


@given(notes, notes, strings, notes)
def test_types_of_one_block(one: str, two: str, text: str, three: str) -> None:
    block = f"TYPE\nA {one}\n: STRUCT s : STRING := {text}; {two}\nEND_STRUCT;\nB : INT; {three}\nEND_TYPE\n"
    done = imported("plain.st", block)
    found = {
        item.name: spaced(item.data.model_dump()["declaration"]) for item in done.project.find_kind("dut")
    }
    assert set(found) == {"A", "B"}
    assert text in found["A"]
    assert "END_STRUCT" not in code_of(found["B"])


@given(notes, notes, notes, strings)
def test_heads_and_sections(one: str, two: str, three: str, text: str) -> None:
    """What goes into PLCopen XML beside the plain text."""
    declaration = (
        f"FUNCTION_BLOCK {one}\nF EXTENDS {two}\nLib.Base IMPLEMENTS {three}\nI_A {one}\n, Lib.I_B {two}\n"
        f"VAR_INPUT {three}\n a {one}\n: STRING(5) {two}\n:= {text}; {three}\n b : INT;\nEND_VAR"
    )
    head = read_head(declaration)
    assert (head.extends, head.implements) == (("Lib.Base",), ("I_A", "Lib.I_B"))
    (section,) = read_sections(declaration)
    assert [(v.name, v.initial) for v in section.variables] == [("a", text), ("b", "")]


@given(st.lists(flat_notes | strings.map("s := {};".format), max_size=6), strings)
def test_bodies_for_matiec(lines: list[str], text: str) -> None:
    """C code becomes a comment, a conversion of times is rewritten; strings and what is around stay."""
    written = [*lines, f"{{{{ if (x) {{ y = '('; }}\n}}}} t := INT_TO_TIME(LEN({text}));"]
    now, _ = rewritten("\n".join(written))
    assert spaced(code_of(now)).endswith(spaced(code_of(f"t := LINT_TO_TIME(1000 * TO_LINT(LEN({text})));")))
    assert [s for s in STRINGS if f" {s};" in now] == [
        s for s in STRINGS if any(f" {s};" in line for line in lines)
    ]
    assert "if (x)" not in code_of(now)
