"""Mends of coding rules: the message goes, nothing worse comes, and the program computes what it did."""

from __future__ import annotations

import re
from collections.abc import Mapping

import pytest
from linked_application import loaded
from sample_stage import ALL_CODING_RULES, stage

from tappet.codegen.build import BuildOptions, build_application
from tappet.lang.coding_settings import StaticAnalysis
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.sample_texts import Sample, samples
from tappet.lang.services.code_actions import MENDED, code_actions
from tappet.lang.services.documents import Program, whole_file
from tappet.lang.services.results import CodeAction
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.lang.source import Source, Span

EVERYTHING = Span(0, 0, 10_000, 0)
CODING = sorted(code for code in MENDED if code[0] == "S")
_COMMENT = re.compile(r"[ ]*\(\*.*?\*\)", re.DOTALL)
FAILING = [
    pytest.param(code, sample, id=f"{code}-{number}")
    for code in CODING
    for number, sample in enumerate(samples()[code])
    if not sample.passes
]


def snapshot_of(texts: Mapping[str, Source]) -> Snapshot:
    static = StaticAnalysis(ALL_CODING_RULES)
    program = Program("App", [whole_file(name, source) for name, source in texts.items()], static=static)
    (snapshot,) = Workspace(lambda unsaved: [program]).snapshots()
    return snapshot


def sources_of(text: str) -> dict[str, Source]:
    return {source.uri: source for source in stage(text).sources}


def applied(sources: Mapping[str, Source], action: CodeAction) -> dict[str, Source]:
    """The texts after the edits of an action."""
    after = dict(sources)
    for edit in sorted(action.edits, key=lambda e: e.place.span, reverse=True):
        source = after[edit.place.document]
        starts = [0]
        for line in source.text.split("\n"):
            starts.append(starts[-1] + len(line) + 1)
        span = edit.place.span
        begin, end = starts[span.line] + span.column, starts[span.end_line] + span.end_column
        text = source.text[:begin] + edit.text + source.text[end:]
        after[edit.place.document] = Source(
            source.uri, text, source.scope, source.owner, source.name, source.library, source.namespace
        )
    return after


def messages(snapshot: Snapshot, code: str) -> list[Diagnostic]:
    return [d for d in snapshot.diagnostics if d.code == code]


def mend(sources: Mapping[str, Source], code: str) -> dict[str, Source]:
    """The texts after the first mend of a code."""
    snapshot = snapshot_of(sources)
    found = messages(snapshot, code)
    assert found
    for diagnostic in found:
        for action in code_actions(snapshot, diagnostic.uri, EVERYTHING):
            if action.report.code == code and action.key != "all":
                return applied(sources, action)
    raise AssertionError(f"nothing mends {code}")


@pytest.mark.parametrize(("code", "sample"), FAILING)
def test_a_mend_takes_its_message_away_and_brings_no_error(code: str, sample: Sample) -> None:
    before = sources_of(_COMMENT.sub("", sample.text))  # a comment keeps statements from being put together
    after = mend(before, code)
    now = snapshot_of(after)
    assert len(messages(now, code)) < len(messages(snapshot_of(before), code)), after
    assert [str(d) for d in now.diagnostics if d.severity == "error"] == []


HEAD = "VAR n, m : INT; b, c : BOOL; d : DINT; e : E_Mode; r : REAL; END_VAR\n"
TYPES = "TYPE E_Mode : (idle, run); END_TYPE\n"


@pytest.mark.parametrize(
    ("code", "before", "after"),
    [
        ("S1205", "CASE n OF 1: m := 1; 2: m := 2; END_CASE", "ELSE\n    ;\nEND_CASE"),
        ("S1206", "IF b THEN n := 1;\nELSIF c THEN n := 2;\nEND_IF", "n := 2;\nELSE\n    ;\nEND_IF"),
        (
            "S1206",
            "IF b THEN\n IF c THEN ; END_IF\nELSIF c THEN n := 2;\nEND_IF",
            "n := 2;\nELSE\n    ;\nEND_IF",
        ),
        ("S1209", "n := 1;\n;\nm := 1;", "n := 1;\nm := 1;"),
        ("S1209", "n := 1;; m := 1;", "n := 1; m := 1;"),
        ("S1210", "n := 1;\nRETURN;", "n := 1;\nEND_PROGRAM"),
        ("S1212", "b := c = TRUE;", "b := c;"),
        ("S1212", "b := FALSE = c;", "b := NOT c;"),
        ("S1212", "b := (b OR c) <> TRUE;", "b := NOT (b OR c);"),
        ("S1216", "b := b AND c OR n = 1;", "b := (b AND c) OR n = 1;"),
        ("S1216", "b := b AND c OR b AND n = 1;", "b := (b AND c) OR (b AND n = 1);"),
        ("S1217", "d := n;", "d := TO_DINT(n);"),
        ("S1220", "IF n > 1 THEN b := TRUE; ELSE b := FALSE; END_IF", "b := n > 1;"),
        ("S1220", "IF b OR c THEN b := FALSE; ELSE b := TRUE; END_IF", "b := NOT (b OR c);"),
        ("S1223", "e := run;", "e := E_Mode.run;"),
        ("S1227", "n := m + 0;", "n := m;"),
        ("S1227", "n := 1 * (m - n);", "n := (m - n);"),
        ("S1227", "b := c AND TRUE;", "b := c;"),
        ("S1242", "n := m + 16#1F;", "n := m + INT#16#1F;"),
        ("S1242", "r := r * 2.5;", "r := r * REAL#2.5;"),
        ("S1007", "N := 1;", "n := 1;"),
    ],
)
def test_statements_are_mended(code: str, before: str, after: str) -> None:
    text = f"{TYPES}PROGRAM Sample\n{HEAD}{before}\nEND_PROGRAM\n"
    (mended,) = mend({"Sample": Source("Sample", text)}, code).values()
    assert after in mended.text
    assert mended.text.startswith(f"{TYPES}PROGRAM Sample\n{HEAD}")


@pytest.mark.parametrize(
    ("code", "before", "after"),
    [
        ("S1004", "    start : BOOL;\n", "    bStart : BOOL;\n"),
        ("S1108", "    nA, nB : INT := 3; // two\n", "    nA : INT := 3;\n    nB : INT := 3; // two\n"),
        (
            "S1415",
            "    nA : INT := 3;\n    nB : INT;\n",
            "VAR CONSTANT\n    nA : INT := 3;\nEND_VAR\nVAR\n    nB : INT;\n",
        ),
    ],
)
def test_declarations_are_mended(code: str, before: str, after: str) -> None:
    used = "nA := nB;" if code == "S1108" else "nB := nA;" if code == "S1415" else "start := TRUE;"
    text = f"PROGRAM Sample\nVAR\n{before}END_VAR\n{used}\nEND_PROGRAM\n"
    (mended,) = mend({"Sample": Source("Sample", text)}, code).values()
    assert after in mended.text


@pytest.mark.parametrize(
    ("code", "statements"),
    [
        ("S1217", "d := n * m;"),  # computed in 32 bits, which a conversion of INT would cut
        ("S1220", "IF b THEN c := TRUE; (* why *) ELSE c := FALSE; END_IF"),
        ("S1220", "IF b THEN c := TRUE; ELSE c := TRUE; END_IF"),
        ("S1227", "n := m * 0;"),
        ("S1227", "b := c AND FALSE;"),
    ],
)
def test_what_would_change_the_program_is_not_offered(code: str, statements: str) -> None:
    text = f"{TYPES}PROGRAM Sample\n{HEAD}{statements}\nEND_PROGRAM\n"
    snapshot = snapshot_of({"Sample": Source("Sample", text)})
    assert messages(snapshot, code)
    found = code_actions(snapshot, "Sample", EVERYTHING)
    assert code not in {action.report.code for action in found}


def test_all_of_a_kind_are_mended_at_once() -> None:
    text = f"{TYPES}PROGRAM Sample\n{HEAD}b := c = TRUE;\nc := b = FALSE;\nn := m = n;\nEND_PROGRAM\n"
    sources = {"Sample": Source("Sample", text)}
    snapshot = snapshot_of(sources)
    line = text[: text.index("b := c")].count("\n")
    found = code_actions(snapshot, "Sample", Span(line, 6, line, 6))
    (action,) = [item for item in found if item.key == "all" and item.report.code == "S1212"]
    assert dict(action.values) == {"code": "S1212", "count": "2"}
    after = applied(sources, action)["Sample"].text
    assert "b := c;\nc := NOT b;\n" in after


def test_nothing_is_mended_in_the_rows_of_il() -> None:
    text = "PROGRAM Sample\nVAR\n    n : INT; d : DINT;\nEND_VAR\nLD n\nADD 5\nST d\nEND_PROGRAM\n"
    snapshot = snapshot_of({"Sample": Source("Sample", text)})
    found = {action.report.code for action in code_actions(snapshot, "Sample", EVERYTHING)}
    assert not found & {"S1217", "S1242"}


RUN = """TYPE E_Mode : (idle, run); END_TYPE
PROGRAM Main
VAR n : INT; m : INT := 5; b, c : BOOL; d : DINT; e : E_Mode; r : REAL; turns : INT; END_VAR
turns := turns + 1;;
c := turns MOD 3 = 0;
b := (c OR turns > 4) <> TRUE AND n < 9 OR b = FALSE;
n := n + 1 * (m - 0) + 16#1F;
d := n;
r := r * 2.5 + 1;
IF b OR c THEN c := FALSE; ELSE c := TRUE; END_IF
CASE turns OF 1: e := run; 2: e := idle; END_CASE
IF b THEN d := d + 1; ELSIF c AND TRUE THEN d := d + n; END_IF
D := D + 1;
RETURN;
END_PROGRAM
"""
VALUES = ("n", "m", "b", "c", "d", "e", "r", "turns")


def values(text: str) -> list[list[str]]:
    """What the program has computed after each of some cycles."""
    package = build_application([Source("Main", text)], options=BuildOptions(level=0)).package
    assert package is not None
    found = []
    with loaded(package) as application:
        for _ in range(7):
            application.cycle()
            found.append([application.literal(f"Main.{name}") for name in VALUES])
    return found


def test_a_program_computes_the_same_when_all_is_mended() -> None:
    sources = {"Main": Source("Main", RUN)}
    done: set[str] = set()
    while True:
        offers = code_actions(snapshot_of(sources), "Main", EVERYTHING)
        wanted = [a for a in offers if a.report.code[:3] == "S12" and a.key != "all"]
        if not wanted:
            break
        done.add(wanted[0].report.code)
        sources = applied(sources, wanted[0])
    assert {"S1206", "S1209", "S1210", "S1212", "S1216", "S1217", "S1220", "S1223", "S1227", "S1242"} <= done
    assert values(RUN)[0] != values(RUN)[-1]
    assert values(sources["Main"].text) == values(RUN)
