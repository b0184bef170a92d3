"""The optional coding rules: chosen by code, off by default; all rules: right after an edit, quiet."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from edited_project import CHOICES, messages, parse_edited, units_of
from hypothesis import given, settings
from hypothesis import strategies as st
from sample_stage import ALL_CODING_RULES

from tappet import libraries
from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.codegen.check import check_application
from tappet.lang.analysis import Analysis, AnalysisOptions, analyse
from tappet.lang.coding_settings import PREFIXES, StaticAnalysis, static_analysis
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.parser import parse
from tappet.lang.rules import chosen_codes
from tappet.lang.source import Scope, Source
from tappet.project import folder
from tappet.project import sources as project_sources

ROOT = Path(__file__).resolve().parents[2]
EDITS = (
    "n := n + 1;",
    "IF n = 1 THEN n := 2; ELSIF n = 1 THEN n := 3; END_IF",
    "GVL.nTotal := 1437; n := F(n);",
    "WHILE n < 10 DO x := 1; END_WHILE",
    "RETURN; n := 1; JMP l; l: n := 2; n := 3;",
    "n := F(1); x := n / 0;",
    "// n := 1;\nGVL.nTotal := 2; nTotal := n; (* twice *)",
    "",
)
OTHERS = (
    Source("GVL", "VAR_GLOBAL nTotal : INT; bUnused : BOOL; END_VAR", name="GVL"),
    Source(
        "F",
        "FUNCTION F : INT\nVAR_INPUT n, m : INT := 1; END_VAR\nVAR k : INT; END_VAR\nF := n;\nEND_FUNCTION",
    ),
    Source("FB", "FUNCTION_BLOCK FB\nVAR a : INT; END_VAR\na := a + 1;\nEND_FUNCTION_BLOCK"),
)


def _main(body: str) -> Source:
    return Source("P", f"PROGRAM P\nVAR n, x : INT; inst : FB; END_VAR\n{body}\nEND_PROGRAM")


def test_choice_of_rules() -> None:
    assert chosen_codes("all") == ALL_CODING_RULES
    assert chosen_codes("") == frozenset()
    assert chosen_codes("s1001, S1002") == {"S1001", "S1002"}
    assert all(code.startswith("S12") for code in chosen_codes("S12"))
    with pytest.raises(ValueError, match=r"'X9'.*S1001"):
        chosen_codes("S12 X9")


def test_rules_are_off_unless_chosen() -> None:
    units = [parse(source).unit for source in (_main(EDITS[2]), *OTHERS)]
    assert not [d for d in analyse(units).diagnostics if d.code[0] == "S"]
    options = AnalysisOptions(static=StaticAnalysis(chosen_codes("S1211")))
    found = {d.code for d in analyse(units, options).diagnostics}
    assert {code for code in found if code[0] == "S"} == {"S1211"}


def test_a_rule_can_be_an_error_and_prefixes_and_limits_are_those_of_the_project() -> None:
    text = (
        "FUNCTION_BLOCK fbValve\nVAR nCount : INT; xOn : BOOL; END_VAR\n"
        "IF xOn THEN IF nCount > 1 THEN nCount := 0; END_IF END_IF\nEND_FUNCTION_BLOCK"
    )
    rules = {"S1001": "error", "S1004": "warning", "S1301": "warning"}

    def found(prefixes: dict[str, str], limits: dict[str, int]) -> list[tuple[str, str]]:
        options = AnalysisOptions(static=static_analysis(rules, prefixes, limits))
        diagnostics = analyse([parse(Source("F", text)).unit], options).diagnostics
        return sorted((d.code, d.severity) for d in diagnostics if d.code[0] == "S")

    assert found({}, {}) == [("S1001", "error"), ("S1004", "warning")]
    ours = {"FUNCTION_BLOCK": "fb", "BOOL": "x", "INT": "i", "UNHEARD_OF": "u"}
    assert found(ours, {"nesting": 1, "unheard_of": 1}) == [("S1004", "warning"), ("S1301", "warning")]
    assert found(dict.fromkeys(PREFIXES, ""), {"nesting": 2}) == []


@pytest.mark.parametrize("static", [frozenset(), ALL_CODING_RULES], ids=["off", "on"])
def test_after_an_edit_the_messages_are_those_of_a_fresh_analysis(static: frozenset[str]) -> None:
    options = AnalysisOptions(static=StaticAnalysis(static))
    others = [parse(source).unit for source in OTHERS]
    previous: Analysis | None = None
    for body in (*EDITS, *reversed(EDITS)):
        units = [parse(_main(body)).unit, *others]
        previous = analyse(units, options, previous)
        fresh = analyse([parse(source).unit for source in (_main(body), *OTHERS)], options)
        assert [str(d) for d in previous.diagnostics] == [str(d) for d in fresh.diagnostics]


EDIT = st.sampled_from([(place, number) for place, texts in CHOICES.items() for number in range(len(texts))])


@settings(max_examples=15, deadline=None)
@given(st.lists(st.lists(EDIT, min_size=1, max_size=2), min_size=4, max_size=8))
def test_after_edits_of_declarations_as_well(edits: list[list[tuple[str, int]]]) -> None:
    options = AnalysisOptions(static=StaticAnalysis(ALL_CODING_RULES))
    chosen: dict[str, int] = {}
    units = units_of(chosen)
    analysis = analyse(list(units.values()), options)
    for edit in edits:
        chosen |= dict(edit)
        parse_edited(units, chosen)
        analysis = analyse(list(units.values()), options, analysis)
        assert messages(analysis) == messages(analyse(list(units_of(chosen).values()), options))


@pytest.mark.parametrize("name", sorted(libraries.names()))
def test_libraries_give_no_warning(name: str) -> None:
    found, _ = libraries.resolve([LibraryReference(name), LibraryReference("Conversion")])
    sources = [
        replace(source, scope=Scope.APPLICATION if library.name == name else source.scope)
        for library in found
        for source in library.sources
    ]
    units = [result.unit for result in parse_sources(sources, ParseOptions())]
    assert [str(d) for d in analyse(units).diagnostics if d.severity == "warning"] == []


def test_example_project_gives_no_warning() -> None:
    project = folder.load(ROOT / "projects" / "bottling")
    for application in project.applications():
        sources = project_sources.application_sources(project, application.id)
        options = BuildOptions(libraries=tuple(project_sources.libraries(project, application.id)))
        assert [str(d) for d in check_application(sources, (), options) if d.severity == "warning"] == []


def test_what_is_malformed_does_not_stop_the_analysis_of_the_rest() -> None:
    texts = [
        Source("A", "PROGRAM A\nIF THEN ;;; ) := END\n"),
        Source("B", "\x00\x01 FUNCTION_BLOCK (* open"),
        Source("C", "TYPE C : STRUCT x : ; END_TYPE"),
        _main("n := nope;"),
        *OTHERS,
    ]
    analysis = analyse(
        [r.unit for r in parse_sources(texts, ParseOptions())],
        AnalysisOptions(static=StaticAnalysis(ALL_CODING_RULES)),
    )
    assert "E0201" in {d.code for d in analysis.diagnostics if d.uri == "P"}


def test_long_flat_texts_are_no_trouble_for_the_rules() -> None:
    long = " AND ".join(["b"] * 3000)
    chain = "".join(f"ELSIF n = {number} THEN n := 1;\n" for number in range(900))
    first = f"IF {long} THEN n := 1; ELSIF {long} THEN n := 1; ELSE n := 1; END_IF"
    body = f"{first}\nIF b THEN n := 2;\n{chain}END_IF"
    source = Source("P", f"PROGRAM P\nVAR b : BOOL; n : INT; END_VAR\n{body}\nEND_PROGRAM")
    analysis = analyse([parse(source).unit], AnalysisOptions(static=StaticAnalysis(ALL_CODING_RULES)))
    assert not [d for d in analysis.diagnostics if d.severity == "error"]
