"""An analysis after an edit of bodies says and resolves the same as a full one."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.lang import ast
from tappet.lang.analysis import Analysis, analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol

OBJECTS = {
    "E": "TYPE E : (one, two); END_TYPE",
    "G": "VAR_GLOBAL g : INT; go : BOOL; END_VAR",
    "F": "FUNCTION F : INT\nVAR_INPUT a : INT := 2; END_VAR VAR t : INT; END_VAR\n{0}\nF := a;\nEND_FUNCTION",
    "FB": (
        "FUNCTION_BLOCK FB\nVAR_INPUT a : INT; END_VAR VAR_OUTPUT q : INT; END_VAR VAR n, m : INT := "
        "1 + 2; END_VAR\n"
        "{0}\nMETHOD Up : INT\nVAR k : INT; END_VAR\n{1}\nUp := n;\nEND_METHOD\n"
        "PROPERTY V : INT\nGET\n{2}\nV := n;\nEND_GET\nEND_PROPERTY\nEND_FUNCTION_BLOCK"
    ),
    "FB.Act": "ACTION Act\n{0}\nEND_ACTION",
    "P": (
        "PROGRAM P\nVAR f : FB := (a := 2); d : Dev(n := 3); x, y : INT; e : E; r : REAL; END_VAR "
        "VAR_EXTERNAL go : BOOL; END_VAR\n{0}\nEND_PROGRAM"
    ),
    "Dev": (
        "FUNCTION_BLOCK Dev\nMETHOD FB_Init : BOOL\nVAR_INPUT b1 : BOOL; b2 : BOOL; n : INT; "
        "END_VAR\nEND_METHOD\n"
        "END_FUNCTION_BLOCK"
    ),
}
BODIES = {
    "F": ["", "t := a;", "a := F(a);", "t := g + foo;", "F := TRUE;"],
    "FB": ["", "q := a; n := m;", "q := Up();", "bad := 1;", "V := 3;", "Act();", "CASE n OF 1: 1: END_CASE"],
    "FB.Act": ["", "n := 0;", "q := V;", "Act();", "nope;"],
    "P": [
        "",
        "x := f.Up();",
        "f(a := F(3)); y := f.V;",
        "e := one; CASE e OF one: x := 1; END_CASE",
        "r := x / 0;",
        "go := x;",
    ],
}


def _text(name: str, body: tuple[str, str, str]) -> Source:
    owner, _, child = name.partition(".")
    filled = OBJECTS[name]
    for number, part in enumerate(body):
        filled = filled.replace(f"{{{number}}}", part)
    return Source(name, filled, name=name if name == "G" else None, owner=owner if child else None)


def _units(bodies: dict[str, tuple[str, str, str]]) -> dict[str, ast.Unit]:
    return {name: parse(_text(name, bodies.get(name, ("", "", "")))).unit for name in OBJECTS}


def _messages(analysis: Analysis) -> list[str]:
    return [str(d) for d in analysis.diagnostics]


@st.composite
def edits(draw: st.DrawFn) -> dict[str, tuple[str, str, str]]:
    return {
        name: (
            draw(st.sampled_from(choices)),
            draw(st.sampled_from(BODIES["FB"])),
            draw(st.sampled_from(BODIES["FB"])),
        )
        for name, choices in BODIES.items()
    }


@settings(max_examples=120, deadline=None)
@given(st.lists(edits(), min_size=2, max_size=4))
def test_every_step_says_the_same_as_a_full_analysis(steps: list[dict[str, tuple[str, str, str]]]) -> None:
    units = _units(steps[0])
    analysis = analyse(list(units.values()))
    for before, after in itertools.pairwise(steps):
        for name, body in after.items():
            if body != before[name]:
                units[name] = parse(_text(name, body)).unit
        analysis = analyse(list(units.values()), previous=analysis)
        full = analyse(list(_units(after).values()))
        assert _messages(analysis) == _messages(full)


def test_only_the_edited_bodies_are_analysed() -> None:
    units = _units({})
    first = analyse(list(units.values()))
    symbols = {p.name: p for p in first.pous}
    units["P"] = parse(_text("P", ("x := f.Up() + y;", "", ""))).unit
    second = analyse(list(units.values()), previous=first)
    assert second.changed is not None
    assert [p.qualified_name for p in second.changed] == ["P"]
    assert {p.name: p for p in second.pous} == symbols
    program = symbols["P"]
    assert program.pou is units["P"].declarations[0]
    assert program.pou is not None
    assignment = program.pou.body[0]
    assert isinstance(assignment, ast.Assign)
    assert assignment.value.type is not None
    decls = [d for block in program.pou.blocks for d in block.variables]
    assert all(d.symbol is not None for d in decls)
    assert all(d.type_ref.type is not None for d in decls)
    assert decls[0].init is not None
    assert isinstance(decls[0].init.type, type(symbols["FB"].instance))
    args = getattr(decls[1].type_ref, "args", None)
    assert args
    assert args[0].parameter.name == "n"


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("P", "x, y : INT", "x, y, z : INT"),
        ("P", "x, y : INT", "x, y : DINT"),
        ("P", "a := 2", "a := 3"),
        ("F", ": INT\nVAR", ": DINT\nVAR"),
        ("F", "a : INT := 2", "a : INT"),
        ("FB", "METHOD Up", "METHOD Down"),
        ("E", "one, two", "one, two, three"),
        ("G", "g : INT", "g : DINT"),
    ],
)
def test_edits_of_declarations_keep_the_symbols_of_all_objects(name: str, old: str, new: str) -> None:
    units = _units({})
    first = analyse(list(units.values()))
    objects = [*first.pous, *(pou.instance for pou in first.pous), *first.types.values()]
    units[name] = parse(_edited(units[name].source, old, new)).unit
    second = analyse(list(units.values()), previous=first)
    assert second.continued
    assert second.changed is None
    assert [*second.pous, *(pou.instance for pou in second.pous), *second.types.values()] == objects


def _edited(source: Source, old: str, new: str) -> Source:
    assert old in source.text
    return replace(source, text=source.text.replace(old, new))


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("F", "FUNCTION F", "FUNCTION F2"),
        ("FB", "FUNCTION_BLOCK FB", "FUNCTION_BLOCK FB EXTENDS Dev"),
        ("FB", "FUNCTION_BLOCK FB", "FUNCTION_BLOCK ABSTRACT FB"),
        ("E", "(one, two)", "INT"),
        ("G", "VAR_GLOBAL", "VAR_CONFIG P.x AT %IX0.0 : BOOL; END_VAR VAR_GLOBAL"),
        ("F", "FUNCTION F", "FUNCTION_BLOCK F"),
    ],
)
def test_edits_of_heads_take_the_full_way(name: str, old: str, new: str) -> None:
    units = _units({})
    first = analyse(list(units.values()))
    units[name] = parse(_edited(units[name].source, old, new)).unit
    second = analyse(list(units.values()), previous=first)
    assert not second.continued
    assert second.changed is None
    assert second.state is not None


def test_a_second_object_of_the_name_takes_the_full_way() -> None:
    units = [*_units({}).values(), parse(Source("F2", "FUNCTION F : INT\nEND_FUNCTION")).unit]
    first = analyse(units)
    units[-1] = parse(Source("F2", "FUNCTION F : DINT\nEND_FUNCTION")).unit
    assert not analyse(units, previous=first).continued


def test_an_added_object_takes_the_full_way() -> None:
    units = list(_units({}).values())
    first = analyse(units)
    second = analyse([*units, parse(Source("Q", "PROGRAM Q\nEND_PROGRAM")).unit], previous=first)
    assert not second.continued
    assert "Q" in second.programs


def test_the_body_of_a_block_appears() -> None:
    """Others ask whether an instance does anything."""
    uses = "FUNCTION Uses : INT\nVAR f : FB; END_VAR\nUses := 1;\nEND_FUNCTION"
    texts = ["FUNCTION_BLOCK FB\nVAR a : INT; END_VAR\nEND_FUNCTION_BLOCK", uses]
    units = [parse(Source(f"t{n}", text)).unit for n, text in enumerate(texts)]
    first = analyse(units)
    assert not [d for d in first.diagnostics if d.code == "W1221"]
    units[0] = parse(Source("t0", texts[0].replace("END_VAR", "END_VAR a := 1;"))).unit
    second = analyse(units, previous=first)
    assert second.continued
    assert [d.uri for d in second.diagnostics if d.code == "W1221"] == ["t1"]


def test_comments_follow_their_edits() -> None:
    """A comment is no part of what a text declares, but of what an editor shows."""
    text = "(* {0} *)\nFUNCTION_BLOCK FB\nVAR\n    a : INT; // {0}\nEND_VAR\na := 1;\nEND_FUNCTION_BLOCK"
    first = analyse([parse(Source("t", text.format("old"))).unit])
    second = analyse([parse(Source("t", text.format("new"))).unit], previous=first)
    assert second.changed is not None
    assert [second.pous[0].comment, second.pous[0].locals["A"].comment] == ["new", "new"]


def test_nothing_changed() -> None:
    units = list(_units({}).values())
    first = analyse(units)
    messages = _messages(first)
    second = analyse(units, previous=first)
    assert second.changed == []
    assert _messages(second) == messages
    assert isinstance(second.pous[0], PouSymbol)
