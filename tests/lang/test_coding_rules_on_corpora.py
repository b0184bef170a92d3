"""All coding rules on all there is to check: no rule fails, and each message has a place in its text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sample_stage import ALL_CODING_RULES, stage
from tests.spec.language_cases import load_cases, sources_of

from tappet import libraries
from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.codegen.check import check_application
from tappet.lang.analysis import AnalysisOptions, analyse
from tappet.lang.coding_settings import StaticAnalysis
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.sample_texts import samples
from tappet.lang.source import Scope, Source, split_lines
from tappet.project import folder
from tappet.project import sources as project_sources

ROOT = Path(__file__).resolve().parents[2]
STATIC = StaticAnalysis(ALL_CODING_RULES)


def _analysed(sources: Sequence[Source]) -> list[Diagnostic]:
    units = [result.unit for result in parse_sources(sources, ParseOptions())]
    return analyse(units, AnalysisOptions(static=STATIC)).diagnostics


def _check_places(found: Iterable[Diagnostic], sources: Sequence[Source]) -> set[str]:
    """The codes of the coding rules among the messages; each is about a place of its text."""
    ends = {source.uri: [len(line) for line in split_lines(source.text)] for source in sources}
    codes = set()
    for d in found:
        if d.code not in ALL_CODING_RULES:
            continue
        lines = ends[d.uri]
        assert d.span.end_line < len(lines), d
        assert d.span.end_column <= lines[d.span.end_line], d
        assert (d.span.line, d.span.column) <= (d.span.end_line, d.span.end_column), d
        codes.add(d.code)
    return codes


def test_conformance_programs() -> None:
    codes: set[str] = set()
    for path in sorted((ROOT / "tests" / "conformance").rglob("*.st")):
        sources = [Source(path.name, path.read_text(encoding="utf-8"))]
        codes |= _check_places(_analysed(sources), sources)
    assert len(codes) > 50


def test_cases_of_the_specification() -> None:
    codes: set[str] = set()
    for case in load_cases():
        sources = sources_of(case)
        codes |= _check_places(_analysed(sources), sources)
    assert len(codes) > 50


def test_samples_of_all_messages() -> None:
    """Those of errors above all: what is wrong has no type, no symbol, or no value."""
    for sample in {sample.text for entries in samples().values() for sample in entries}:
        sources = stage(sample).sources
        _check_places(_analysed(sources), sources)


TEXTS = sorted({sample.text for entries in samples().values() for sample in entries})
PIECE = re.compile(r"\w+|\s+|[^\w\s]")
WORDS = sorted({piece for text in TEXTS for piece in PIECE.findall(text) if piece.strip()})
CHANGE = st.tuples(st.integers(0, 400), st.sampled_from(["", *WORDS]))


@settings(max_examples=200, deadline=None)
@given(st.sampled_from(TEXTS), st.lists(CHANGE, min_size=1, max_size=4))
def test_samples_with_some_words_changed(text: str, changes: list[tuple[int, str]]) -> None:
    sources = []
    for source in stage(text).sources:
        pieces = PIECE.findall(source.text)
        for place, word in changes:
            pieces[place % len(pieces)] = word
        sources.append(replace(source, text="".join(pieces)))
    _check_places(_analysed(sources), sources)


@pytest.mark.parametrize("name", sorted(libraries.names()))
def test_libraries_as_own_code(name: str) -> None:
    found, _ = libraries.resolve([LibraryReference(name), LibraryReference("Conversion")])
    sources = [
        replace(source, scope=Scope.APPLICATION if library.name == name else source.scope)
        for library in found
        for source in library.sources
    ]
    _check_places(_analysed(sources), sources)


def test_example_project() -> None:
    project = folder.load(ROOT / "projects" / "bottling")
    for application in project.applications():
        sources = project_sources.application_sources(project, application.id)
        references = tuple(project_sources.libraries(project, application.id))
        options = BuildOptions(libraries=references, static=STATIC)
        found = check_application(sources, (), options)
        assert len({d.code for d in found} & ALL_CODING_RULES) > 10
