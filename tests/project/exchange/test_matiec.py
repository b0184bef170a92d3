"""Bodies of Beremiz and OpenPLC projects: what means something else there is rewritten and reported."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.project.exchange.importing import Imported, import_files
from tappet.project.exchange.plcopen_matiec import rewritten

SECONDS = "count seconds there and milliseconds here; they were rewritten"


def imported(body: str) -> Imported:
    source = (
        '<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml"><types>'
        '<dataTypes/><pous><pou name="P" pouType="program"><interface/>'
        f"<body>{body}</body></pou></pous></types></project>"
    )
    return import_files({"plc.xml": source.encode()})


def text(done: Imported) -> str:
    (program,) = done.project.find_kind("pou")
    return str(program.data.model_dump()["implementation"])


@pytest.mark.parametrize(
    ("written", "means"),
    [
        ("x := y * TIME_TO_REAL(CYCLE);", "x := y * (TIME_TO_REAL(CYCLE) / 1000.0);"),
        ("n := TIME_TO_INT(f(1, t));", "n := LINT_TO_INT(TIME_TO_LINT(f(1, t)) / 1000);"),
        ("t := REAL_TO_TIME(x + 1.5);", "t := REAL_TO_TIME(1000.0 * (x + 1.5));"),
        ("t := uint_to_time (n);", "t := LINT_TO_TIME(1000 * TO_LINT(n));"),
        (
            "x := TIME_TO_LREAL(LREAL_TO_TIME(x));",
            "x := (TIME_TO_LREAL(LREAL_TO_TIME(1000.0 * (x))) / 1000.0);",
        ),
        ("s := CONCAT(a, 'b,(', f(c, d));", "s := CONCAT(CONCAT(a, 'b,('), f(c, d));"),
    ],
)
def test_what_means_something_else(written: str, means: str) -> None:
    now, notes = rewritten(written)
    assert now == means
    assert len(notes) == 1


def test_comments_do_not_nest() -> None:
    written = "(* a (* b *) x := 1; (* c *) s := '(*'; // (* d"
    assert rewritten(written) == ("(* a ( * b *) x := 1; (* c *) s := '(*'; // (* d", [])


def test_counters_of_the_standard_come_with_their_library() -> None:
    for body, counted in (
        ("<ST><p>n := 1;</p></ST>", False),
        ("<ST><p>n := SIZEOF(CTU_ULINT);</p></ST>", True),
    ):
        done = imported(body.replace("<p>", '<p xmlns="http://www.w3.org/1999/xhtml">'))
        (manager,) = done.project.find_kind("library_manager")
        names = [entry["name"] for entry in manager.data.model_dump()["references"]]
        assert ("IEC_Counters" in names) is counted
        assert "Standard" in names


@pytest.mark.parametrize(
    "body",
    [
        "(* TIME_TO_REAL(x) {c} *) s := 'TIME_TO_REAL(x) {c}'; // {c}",
        "s := CONCAT(a, b); t := CONCAT(IN1 := a, IN2 := b, IN3 := c);",
        "x := TIME_TO_REAL(t; y := CONCAT(a, b, c",
        "n := MY_TIME_TO_REAL(t); r := TIME_TO_REAL;",
    ],
)
def test_what_stays(body: str) -> None:
    assert rewritten(body) == (body, [])


@given(st.text(alphabet="(){},;'$*CONCAT TIME_TO_REAL\n", max_size=200))
def test_any_text_is_read(body: str) -> None:
    now, notes = rewritten(body)
    assert notes or now == body


def test_c_code_becomes_a_comment_and_is_told() -> None:
    done = imported(
        "<ST><xhtml:p><![CDATA[{extern int f(); (* c *)}\nIF a THEN {{ g(); }} END_IF;]]></xhtml:p></ST>"
    )
    assert text(done) == "(* {extern int f(); ( * c * )} *)\nIF a THEN (* {{ g(); }} *) END_IF;"
    notes = [(entry.object, entry.outcome) for entry in done.report.noteworthy()]
    assert notes == [("P", "changed")]


def test_files_of_other_systems_keep_their_pragmas_and_times() -> None:
    body = "{IF defined (x)}\nn := TIME_TO_INT(t);\n{END_IF}"
    done = imported(f'<ST><xhtml xmlns="http://www.w3.org/1999/xhtml">{body}</xhtml></ST>')
    assert text(done) == body
    marked = imported(f"<ST><xhtml:p>{body}</xhtml:p></ST>")
    assert SECONDS in " ".join(entry.text for entry in marked.report.entries)
