"""Applications around shared library snapshots are the same as applications analysed with their libraries."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random

import pytest
from sampled import sampled
from tests.spec.language_cases import load_cases, sources_of

from tappet import libraries as installed
from tappet.codegen.emit_module import EmitOptions, emit_module
from tappet.core import passes
from tappet.core.lower import Task, lower
from tappet.core.program import LoweringError
from tappet.lang.analysis import Analysis, AnalysisOptions, analyse
from tappet.lang.analysis import libraries as snapshots
from tappet.lang.analysis.libraries import Influence, own_results, read_program
from tappet.lang.conditional import parse_sources
from tappet.lang.deep_trees import deep_recursion
from tappet.lang.source import GivenValue, Scope, Source
from tappet.project.library_reference import LibraryReference

CONFORMANCE = sorted((Path(__file__).parents[1] / "conformance").rglob("*.st"))
CASES = load_cases()
CHOSEN = Random(8).sample(range(len(CASES)), 60)
OPTIONS = AnalysisOptions()
REFERENCES = [LibraryReference(name) for name in ("Standard", "Standard64", "Util", "Conversion")]
PRODUCT = [source for library in installed.resolve(REFERENCES)[0] for source in library.sources]


def library(text: str, name: str = "Parts", given: tuple[GivenValue, ...] = ()) -> Source:
    uri = f"{name}/{text.split()[1]}"
    return Source(uri, text, Scope.LIBRARY, library=name, namespace=name, given=given)


def around(sources: Sequence[Source]) -> tuple[Analysis, list[str]]:
    """The analysis around shared libraries, and the messages of the parser."""
    results, shared = read_program(sources, OPTIONS)
    own = [result.unit for result in own_results(results, shared)]
    analysis = analyse(own, OPTIONS, libraries=shared)
    return analysis, [str(d) for result in results for d in result.diagnostics]


def together(sources: Sequence[Source]) -> tuple[Analysis, list[str]]:
    """The analysis of all texts at once."""
    results = parse_sources(sources)
    analysis = analyse([result.unit for result in results], OPTIONS)
    return analysis, [str(d) for result in results for d in result.diagnostics]


def code(analysis: Analysis) -> str:
    """The code of all programs and what they call, before LLVM optimises it."""
    try:
        lowered = lower(analysis, [Task("Task", tuple(pou.name for pou in analysis.programs.values()))])
    except LoweringError as error:
        return str(error)
    passes.run(lowered.module)
    return emit_module(lowered.module, list(lowered.module.functions), EmitOptions(), True)


def symbols(analysis: Analysis) -> object:
    """What the application sees, with types and places."""
    blocks = {
        pou.qualified_name: (
            [(m.name, str(m.type), m.offset) for m in pou.instance.members.values()] if pou.instance else [],
            [(name, target.qualified_name) for name, target in pou.vtable.items()],
            [(p.name, str(p.type), p.section) for p in pou.parameters],
        )
        for pou in analysis.pous
    }
    lists = {
        gvl.name: [(m.name, str(m.type), m.offset) for m in gvl.members.values()] for gvl in analysis.gvls
    }
    scope = {name: (type(symbol).__name__, symbol.name) for name, symbol in analysis.scope.items()}
    return blocks, lists, scope, {name: (str(t), t.size) for name, t in analysis.types.items()}


def compare(sources: Sequence[Source]) -> None:
    with deep_recursion():
        mine, read = around(sources)
        other, expected = together(sources)
        assert read == expected
        assert [str(d) for d in mine.diagnostics] == [str(d) for d in other.diagnostics]
        assert symbols(mine) == symbols(other)
        if other.ok and not any(": error " in text for text in expected):
            assert code(mine) == code(other)


@pytest.mark.parametrize("path", sampled(CONFORMANCE, 3), ids=lambda path: path.stem)
def test_conformance_programs(path: Path) -> None:
    compare([Source(path.name, path.read_text(encoding="utf-8")), *PRODUCT])


@pytest.mark.parametrize("number", sampled(CHOSEN, 3))
def test_language_examples(number: int) -> None:
    compare([*sources_of(CASES[number]), *PRODUCT])


PARTS = (
    library("FUNCTION_BLOCK Plain\nVAR_INPUT n : INT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK"),
    library("FUNCTION_BLOCK Holder\nVAR p : Plain; s : Settings; END_VAR\np(n := s.a);\nEND_FUNCTION_BLOCK"),
    library("TYPE Settings : STRUCT a : INT := Limits.low; END_STRUCT END_TYPE"),
    library("VAR_GLOBAL CONSTANT low : INT := 7; END_VAR".replace("VAR_GLOBAL", "VAR_GLOBAL ", 1)),
)
PARTS = (*PARTS[:3], Source("Parts/Limits", PARTS[3].text, Scope.LIBRARY, None, "Limits", "Parts", "Parts"))
INFLUENCES = {
    "nothing": "VAR h : Holder; END_VAR\nh();",
    "extends": "VAR d : Derived; h : Holder; END_VAR\nd(n := 2); h();",
    "name": "VAR h : Holder; q : Plain; r : Parts.Plain; END_VAR\nh(); q(); r(n := 1);",
    "list": "VAR h : Holder; i : INT; END_VAR\nh(); i := Limits.low + Parts.Limits.low;",
    "fault": "VAR h : Holder; END_VAR\nh(nowhere := 1); Plan(); x := low;",
}
BESIDE = {
    "extends": [Source("Derived", "FUNCTION_BLOCK Derived EXTENDS Plain\nn := n + 2;\nEND_FUNCTION_BLOCK")],
    "name": [
        Source("Plain", "FUNCTION_BLOCK Plain\nVAR own : LREAL; END_VAR\nown := 1;\nEND_FUNCTION_BLOCK")
    ],
    "list": [Source("Limits", "VAR_GLOBAL low : DINT := 1; END_VAR", name="Limits")],
}


@pytest.mark.parametrize("order", [tuple(INFLUENCES), tuple(reversed(INFLUENCES))], ids=["forth", "back"])
def test_what_an_application_changes_in_a_library_stays_with_it(order: tuple[str, ...]) -> None:
    for name in order * 2:
        program = Source("Main", f"PROGRAM Main\n{INFLUENCES[name]}\nEND_PROGRAM")
        compare([program, *BESIDE.get(name, []), *PARTS])


def test_an_extended_block_has_a_method_table_only_where_it_is_extended() -> None:
    sources = {
        name: [
            Source("Main", f"PROGRAM Main\n{INFLUENCES[name]}\nEND_PROGRAM"),
            *BESIDE.get(name, []),
            *PARTS,
        ]
        for name in ("nothing", "extends")
    }
    tables = {
        name: {p.name: bool(p.vtable) for p in around(texts)[0].pous} for name, texts in sources.items()
    }
    assert tables["nothing"]["Plain"] is False
    assert tables["extends"]["Plain"] is True


@pytest.mark.parametrize(
    "text",
    [
        "{IF defined (FAST)}\nFUNCTION F : INT\nF := 1;\nEND_FUNCTION\n{END_IF}",
        "FUNCTION_BLOCK G VAR_GENERIC CONSTANT n : INT; END_VAR\nVAR a : ARRAY[1..n] OF INT; END_VAR\n"
        "END_FUNCTION_BLOCK",
    ],
    ids=["conditional", "generic"],
)
def test_a_library_that_depends_on_the_application_has_no_snapshot(text: str) -> None:
    sources = [
        Source("Main", "PROGRAM Main\nVAR h : Holder; END_VAR\nh();\nEND_PROGRAM"),
        *PARTS,
        library(text),
    ]
    assert read_program(sources, OPTIONS)[1] is None
    compare(sources)


def test_values_that_name_nothing_of_the_project_are_part_of_the_key() -> None:
    def given(value: str) -> list[Source]:
        values = (GivenValue("low", value, "Library Manager"),)
        limits = Source(
            "Parts/Limits", PARTS[3].text, Scope.LIBRARY, None, "Limits", "Parts", "Parts", given=values
        )
        constant = Source("Own", "VAR_GLOBAL CONSTANT cOwn : INT := 3; END_VAR", name="Own")
        program = Source("Main", "PROGRAM Main\nVAR i : INT := Limits.low; END_VAR\nEND_PROGRAM")
        return [program, constant, *PARTS[:3], limits]

    assert read_program(given("9"), OPTIONS)[1] is not read_program(given("10"), OPTIONS)[1]
    assert read_program(given("9"), OPTIONS)[1] is read_program(given("9"), OPTIONS)[1]
    assert read_program(given("cOwn"), OPTIONS)[1] is None
    for value in ("9", "INT#16#1F", "cOwn", "1 + cOwn"):
        compare(given(value))


def test_an_edit_of_a_library_text_makes_another_snapshot() -> None:
    program = Source("Main", "PROGRAM Main\nVAR h : Holder; END_VAR\nh();\nEND_PROGRAM")
    compare([program, *PARTS])
    changed = library(PARTS[0].text.replace("n + 1", "n + 5"))
    compare([program, changed, *PARTS[1:]])
    compare([program, *PARTS])


def test_messages_of_an_application_do_not_stay_in_the_snapshot() -> None:
    program = Source("Main", f"PROGRAM Main\n{INFLUENCES['fault']}\nEND_PROGRAM")
    _, shared = read_program([program, *PARTS], OPTIONS)
    assert shared is not None
    state = shared.state
    before = [list(record.messages) for record in (*state.session.declared.values(), *state.records.values())]
    for name in INFLUENCES:
        around(
            [Source("Main", f"PROGRAM Main\n{INFLUENCES[name]}\nEND_PROGRAM"), *BESIDE.get(name, []), *PARTS]
        )
    after = [list(record.messages) for record in (*state.session.declared.values(), *state.records.values())]
    assert before == after


def test_threads_share_a_snapshot() -> None:
    def build(number: int) -> str:
        text = (
            f"PROGRAM Main\nVAR h : Holder; t : TON; i : INT; END_VAR\nh(); t(); i := {number};\nEND_PROGRAM"
        )
        with deep_recursion():
            analysis, _ = around([Source("Main", text), *PARTS, *PRODUCT])
            return code(analysis) if analysis.ok else str(analysis.diagnostics)

    with ThreadPoolExecutor(4) as pool:
        first = list(pool.map(build, [number % 5 for number in range(20)]))
    assert first == [build(number % 5) for number in range(20)]


def test_as_many_snapshots_are_kept_as_it_says() -> None:
    for number in range(snapshots.KEPT + 3):
        read_program([*PARTS[:3], library(f"FUNCTION F{number} : INT\nEND_FUNCTION")], OPTIONS)
    assert len(snapshots._Kept.by_content) == snapshots.KEPT
    _, shared = read_program(PARTS, OPTIONS)
    assert shared is not None
    assert shared.influence([]) == Influence()
