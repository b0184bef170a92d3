"""An analysis after edits of declarations knows the same as a full one, and looks at no more than it must."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest
from edited_project import CHOICES, OBJECTS, knowledge, messages, parse_edited, text_of, units_of
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.lang.analysis import Analysis, analyse, resume
from tappet.lang.analysis.bodies import State
from tappet.lang.analysis.edits import declaration_edits
from tappet.lang.analysis.edits.dependents import Dependents
from tappet.lang.analysis.edits.identifiers import identifiers_of
from tappet.lang.parser import parse
from tappet.lang.source import Scope, Source

EDITS = st.lists(
    st.sampled_from([(place, number) for place, texts in CHOICES.items() for number in range(len(texts))]),
    min_size=1,
    max_size=3,
)


def compared_after_each(begin: list[tuple[str, int]], edits: list[list[tuple[str, int]]]) -> None:
    """Messages, types, values, layout and what every name stands for are those of a full analysis."""
    chosen = dict(begin)
    units = units_of(chosen)
    analysis = analyse(list(units.values()))
    for edit in edits:
        chosen |= dict(edit)
        parse_edited(units, chosen)
        analysis = analyse(list(units.values()), previous=analysis)
        fresh = units_of(chosen)
        full = analyse(list(fresh.values()))
        assert _differences(messages(analysis), messages(full)) == []
        known = knowledge(analysis, units.values())
        assert _differences(known, knowledge(full, fresh.values())) == []


SEVERAL = st.lists(EDITS, min_size=8, max_size=12)


@settings(max_examples=10, deadline=None, derandomize=True)
@given(EDITS, SEVERAL)
def test_every_edit_leads_to_what_a_full_analysis_knows(
    begin: list[tuple[str, int]], edits: list[list[tuple[str, int]]]
) -> None:
    compared_after_each(begin, edits)


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(EDITS, SEVERAL)
def test_so_do_many(begin: list[tuple[str, int]], edits: list[list[tuple[str, int]]]) -> None:
    compared_after_each(begin, edits)


@settings(max_examples=15, deadline=None, derandomize=True)
@given(EDITS, st.lists(st.tuples(EDITS, st.sampled_from([*OBJECTS]), st.booleans()), min_size=4, max_size=8))
def test_what_waits_is_made_up_for(
    begin: list[tuple[str, int]], edits: list[tuple[list[tuple[str, int]], str, bool]]
) -> None:
    """Bodies wait for the next edits or are analysed between them; in the end nothing is missing."""
    chosen = dict(begin)
    units = units_of(chosen)
    analysis = analyse(list(units.values()))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(declaration_edits, "AT_ONCE", 0)
        for edit, first, some in edits:
            chosen |= dict(edit)
            parse_edited(units, chosen)
            analysis = analyse(list(units.values()), None, analysis, frozenset([first]))
            if some:
                resume(analysis, 0.0)
        analysis = analyse(list(units.values()), previous=analysis)
    assert not analysis.is_waiting
    fresh = units_of(chosen)
    full = analyse(list(fresh.values()))
    assert _differences(messages(analysis), messages(full)) == []
    assert _differences(knowledge(analysis, units.values()), knowledge(full, fresh.values())) == []


def test_an_edited_text_is_told_of_before_others() -> None:
    begin = {"other_body": 2, "axis_body": 2}
    units = units_of(begin)
    first = analyse(list(units.values()))
    units["Common"] = parse(text_of("Common", begin | {"shared": 3})).unit
    units["P_Other"] = parse(text_of("P_Other", begin | {"other_body": 1})).unit
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(declaration_edits, "AT_ONCE", 0)
        early = analyse(list(units.values()), None, first, frozenset(["P_Other"]))
    assert early.is_waiting
    known = {uri: [str(d) for d in early.diagnostics if d.uri == uri] for uri in ("P_Other", "FB_Axis")}
    while not resume(early, 0.0):
        pass
    late = analyse(list(units.values()), previous=early)
    changed = {uri: [str(d) for d in late.diagnostics if d.uri == uri] for uri in ("P_Other", "FB_Axis")}
    assert known["P_Other"] == changed["P_Other"]
    assert known["FB_Axis"] != changed["FB_Axis"]


def _differences(found: list[str], expected: list[str]) -> list[tuple[str | None, str | None]]:
    """The first lines that differ; a comparison of all by pytest would take minutes."""
    return [pair for pair in itertools.zip_longest(found, expected) if pair[0] != pair[1]][:3]


def _edited(place: str, number: int, begin: dict[str, int] | None = None) -> tuple[set[str], Analysis]:
    """The bodies that are analysed again when one place is edited, and what is known then."""
    chosen = begin or {}
    units = units_of(chosen)
    first = analyse(list(units.values()))
    assert isinstance(first.state, State)
    before = dict(first.state.records)
    for name in OBJECTS:
        source = text_of(name, chosen | {place: number})
        if source != units[name].source:
            units[name] = parse(source).unit
    second = analyse(list(units.values()), previous=first)
    assert second.continued
    assert isinstance(second.state, State)
    records = second.state.records
    parts = [part for pou in second.pous for part in pou.with_children()]
    return {p.qualified_name for p in parts if records[id(p)] is not before.get(id(p))}, second


@pytest.mark.parametrize(
    ("place", "number", "begin", "looked_at"),
    [
        ("base", 1, {}, {"FB_Base"}),
        ("row", 1, {}, set()),
        ("row", 1, {"prg_body": 4}, {"PLC_PRG"}),
        ("gvl", 2, {}, {"FB_Axis.__getSpeed"}),
        ("gvl", 1, {}, {"P_List"}),
        ("limits", 1, {}, set()),
        ("pool_in", 1, {}, {"F_Pool"}),
        ("pool_in", 1, {"prg_body": 6}, {"F_Pool", "PLC_PRG"}),
        ("scale_in", 1, {"prg_body": 6}, {"F_Scale", "PLC_PRG"}),
        ("enum", 1, {"prg_body": 2}, {"PLC_PRG"}),
        ("go_in", 1, {"prg_body": 1}, {"PLC_PRG"}),
        ("speed", 1, {}, {"FB_Axis.__getSpeed"}),
        ("other", 1, {}, {"P_Other"}),
    ],
)
def test_bodies_that_can_tell_no_difference_stay(
    place: str, number: int, begin: dict[str, int], looked_at: set[str]
) -> None:
    found, _ = _edited(place, number, begin)
    assert found == looked_at


@pytest.mark.parametrize(
    ("place", "number", "again", "sized"),
    [
        ("base", 1, {"FB_Base", "FB_Derived"}, {"F_Uses", "Common", "PLC_PRG"}),
        ("prg", 1, {"PLC_PRG"}, set()),
        ("nest", 1, {"ST_Nest"}, {"F_Uses"}),
        ("init_in", 1, {"FB_Init", "PLC_PRG"}, set()),
        ("enum", 1, {"E_Mode", "PLC_PRG", "Common"}, set()),
    ],
)
def test_texts_with_variables_of_a_block_need_its_size_only(
    place: str, number: int, again: set[str], sized: set[str]
) -> None:
    units = units_of({})
    first = analyse(list(units.values()))
    assert isinstance(first.state, State)
    edited = {}
    for name in OBJECTS:
        source = text_of(name, {place: number})
        if source != units[name].source:
            edited[name] = (units[name], parse(source).unit)
    identifiers = {
        name: identifiers_of(edited[name][1] if name in edited else unit) for name, unit in units.items()
    }
    found = Dependents(first.state.session, identifiers, edited)
    assert again <= found.again
    assert sized <= found.sized
    assert found.again.isdisjoint(found.sized)
    assert not sized or found.again != set(OBJECTS)


@pytest.mark.parametrize(
    ("declared", "plain"),
    [
        ("a : T;", True),
        ("a, b : ARRAY[1..2] OF T; c : POINTER TO T; // T (* T *)\n s : STRING := 'T';", True),
        ("a : T := (x := 1);", False),
        ("a : T(1);", False),
        ("a : T; n : INT := SIZEOF(T);", False),
        ("a AT %MW0 : T;", False),
        ("T : INT;", False),
    ],
)
def test_names_that_are_only_types_of_variables(declared: str, plain: bool) -> None:
    unit = parse(Source("P", f"PROGRAM P\nVAR\n{declared}\nEND_VAR\nEND_PROGRAM")).unit
    assert ("T" in identifiers_of(unit).plain_types) is plain


def test_types_that_hold_an_edited_one_are_laid_out_again() -> None:
    _, after = _edited("row", 2)
    sizes = {name: type_.size for name, type_ in after.types.items()}
    full = analyse(list(units_of({"row": 2}).values()))
    assert sizes == {name: type_.size for name, type_ in full.types.items()}
    assert sizes["ST_ROW"] == 12


def test_a_library_is_not_edited_in_parts() -> None:
    units = list(units_of({}).values())
    library = replace(units[-1].source, uri="lib", text="FUNCTION L : INT\nEND_FUNCTION", library="Lib")
    library = replace(library, scope=Scope.LIBRARY)
    units.append(parse(library).unit)
    first = analyse(units)
    units[-1] = parse(replace(library, text="FUNCTION L : DINT\nEND_FUNCTION")).unit
    assert not analyse(units, previous=first).continued


BLOCK = "FUNCTION_BLOCK B\nMETHOD M : INT\nEND_METHOD\nEND_FUNCTION_BLOCK"
CALLER = "PROGRAM P\nVAR b : B; i : INT; END_VAR\ni := b.M();\nEND_PROGRAM"


def test_methods_come_and_go() -> None:
    trees = [parse(Source("B", BLOCK)).unit, parse(Source("P", CALLER)).unit]
    analysis = analyse(trees)
    assert analysis.ok
    for name, errors in (("N", ["E0204"]), ("M", [])):
        trees[0] = parse(Source("B", BLOCK.replace("METHOD M", f"METHOD {name}"))).unit
        analysis = analyse(trees, previous=analysis)
        assert analysis.continued
        assert [d.code for d in analysis.diagnostics if d.severity == "error"] == errors
