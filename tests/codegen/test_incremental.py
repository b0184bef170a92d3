"""Builds after edits, with one session, give what a build of everything gives: messages, values, lines."""

from __future__ import annotations

import io
from collections.abc import Iterator

import pytest
from edited_application import BODIES, OPTIONS, Pair, agree, changed_over, edited, messages, values
from elftools.elf.elffile import ELFFile
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from linked_application import loaded

from tappet.codegen.build import BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.core.lower import lower_pou
from tappet.core.program import LoweringError, Program
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol

pytestmark = pytest.mark.usefixtures("small_modules")


def lines(package: CodePackage) -> dict[str, set[int]]:
    """Lines with code, by text."""
    found: dict[str, set[int]] = {}
    for data in package.objects:
        for uri, line in _lines_of(data):
            found.setdefault(uri, set()).add(line)
    return found


def _lines_of(data: bytes) -> Iterator[tuple[str, int]]:
    dwarf = ELFFile(io.BytesIO(data)).get_dwarf_info()
    for unit in dwarf.iter_CUs():
        program = dwarf.line_program_for_CU(unit)
        names = [entry.name.decode() for entry in program["file_entry"]]
        for entry in program.get_entries():
            if entry.state is not None and not entry.state.end_sequence and entry.state.line:
                yield names[entry.state.file - 1], entry.state.line


edits = st.sampled_from(sorted(BODIES)).flatmap(
    lambda name: st.tuples(st.just(name), st.sampled_from(BODIES[name]))
)


@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(st.lists(edits, min_size=1, max_size=2), st.booleans()), min_size=2, max_size=5))
def test_every_build_says_and_does_what_a_whole_one_does(steps: list[tuple[list[tuple[str, str]], bool]]):
    pair = Pair()
    running: CodePackage | None = None
    for changes, download in steps:
        pair.bodies |= dict(changes)
        after, whole = pair.both(running)
        assert messages(after) == messages(whole)
        assert after.ok == whole.ok
        if after.package is None or whole.package is None:
            continue
        assert after.package.data_id == whole.package.data_id
        assert after.package.code_id == whole.package.code_id
        with loaded(after.package) as a, loaded(whole.package) as b:
            assert values(a) == values(b)
        if running is not None:
            assert changed_over(running, after.package) == changed_over(running, whole.package)
        if download or running is None:
            running = after.package


def test_edit_of_a_body_compiles_little():
    pair = Pair()
    whole = agree(pair, partial=False)
    assert whole.package is not None
    after = agree(edited(pair, FB_Leaf="q := q + 3;"))
    assert after.package is not None
    assert 2 <= after.cached_objects < len(after.package.objects)
    back = agree(edited(pair, FB_Leaf=BODIES["FB_Leaf"][0]))
    assert back.package is not None
    assert back.package.code_id == whole.package.code_id
    grown = agree(edited(pair, G="more : INT;"))
    assert grown.package is not None
    assert grown.cached_objects == len(grown.package.objects)


def test_edit_of_a_declaration_is_no_whole_build():
    pair = Pair()
    agree(pair, partial=False)
    agree(edited(pair, Base_vars="extra : DINT := 3;"))
    agree(edited(pair, FB_Base="n := n + extra;"))


def test_changed_tasks_are_a_whole_build():
    pair = Pair()
    agree(pair, partial=False)
    tasks = (Task("T", programs=("PLC_PRG", "PLC_PRG")),)
    after, whole = pair.build(tasks=tasks), pair.whole(tasks=tasks)
    assert not after.partial
    assert after.package is not None
    assert whole.package is not None
    assert after.package.code_id == whole.package.code_id


def test_new_calls_reach_library_functions_constants_and_methods():
    pair = Pair()
    agree(pair, partial=False)
    agree(edited(pair, FB_Leaf="q := q + LEN(CONCAT('abc', 'de')) + REAL_TO_DINT(SQRT(16.0)); t();"))
    agree(edited(pair, PLC_PRG="sum := sum + Bump(b); text := DINT_TO_STRING(sum); G.log := 'a new text';"))
    agree(edited(pair, PLC_PRG="leaf(); sum := sum + leaf.Value;"))


def test_errors_in_between_leave_nothing_behind():
    pair = Pair()
    agree(pair, partial=False)
    for name, wrong in (("PLC_PRG", "sum := 'text';"), ("Scale", "Scale := nn;"), ("FB_Leaf", "q := ;")):
        after, whole = edited(pair, **{name: wrong}).both()
        assert not after.ok
        assert messages(after) == messages(whole)
    edited(pair, Scale="Scale := 5;", FB_Leaf="q := 8;", PLC_PRG="leaf(); sum := sum + Scale(1) + leaf.q;")
    agree(pair)


def test_lowering_that_fails_half_way_is_not_continued(monkeypatch: pytest.MonkeyPatch):
    pair = Pair()
    agree(pair, partial=False)
    edited(pair, FB_Leaf="q := 21;", FB_Base="n := 22;", PLC_PRG="b(); leaf(); sum := b.n + leaf.q;")
    count = 0

    def fails(program: Program, pou: PouSymbol) -> None:
        nonlocal count
        count += 1
        if count == 2:
            raise LoweringError("no code for this", "FB_Leaf", None)
        lower_pou(program, pou)

    with monkeypatch.context() as patch:
        patch.setattr("tappet.core.edits.relower.lower_pou", fails)
        failed = pair.build()
    assert [d.code for d in failed.diagnostics if d.severity == "error"] == ["E0901"]
    agree(pair, partial=False)


def test_area_that_grows_is_no_whole_build():
    pair = Pair()
    agree(pair, partial=False)
    agree(edited(pair, PLC_PRG="%MW3000 := 7; sum := sum + %MW3000;"))
    agree(edited(pair, PLC_PRG="%MW3001 := 7; sum := sum + %MW3001;"))


def test_online_change_after_edits():
    pair = Pair()
    first_build = agree(pair, partial=False).package
    assert first_build is not None
    second = agree(edited(pair, FB_Leaf="q := q + 100;"), previous=first_build).package
    assert second is not None
    assert second.online_change is not None
    assert (second.online_change.base_code_id, second.online_change.moves) == (first_build.code_id, ())
    assert second.data_id == first_build.data_id
    moved = agree(edited(pair, Base_vars="extra : DINT := 3;"), previous=second).package
    assert moved is not None
    assert "tappet.online_change" not in second.exports
    edited(pair, FB_Leaf="q := q + 1000;")
    third = agree(pair, previous=moved).package
    assert third is not None
    assert third.online_change is not None
    assert third.online_change.base_code_id == moved.code_id
    assert changed_over(moved, third) == changed_over(moved, pair.whole(moved).package or moved)
    last = agree(edited(pair, FB_Leaf="q := q + 5;"), previous=first_build).package
    assert last is not None
    assert changed_over(first_build, last) == changed_over(
        first_build, pair.whole(first_build).package or last
    )


def test_same_program_has_the_same_code_id_after_an_online_change_that_moved_data():
    pair = Pair()
    old = pair.build().package
    pair.bodies["Base_vars"] = "extra : POINTER TO DINT := ADR(n);"
    moved = pair.build(old).package
    assert moved is not None
    assert "tappet.online_change" in moved.exports
    again = pair.whole(moved).package
    assert again is not None
    assert "tappet.online_change" not in again.exports
    assert again.code_id == moved.code_id


def test_comments_are_no_change_of_the_code_but_lines_are():
    pair = Pair()
    old = agree(pair, partial=False).package
    assert old is not None
    commented = agree(edited(pair, FB_Leaf="q := q + 2; // ' two (*")).package
    moved = agree(edited(pair, FB_Leaf="\nq := q + 2;")).package
    text = agree(edited(pair, FB_Leaf="q := q + LEN('a//b') - 1;")).package
    other = agree(edited(pair, FB_Leaf="q := q + LEN('a//bc') - 1;")).package
    assert commented is not None
    assert commented.code_id == old.code_id
    assert len({p.code_id for p in (old, moved, text, other) if p is not None}) == 4


@pytest.mark.parametrize(
    ("name", "body"),
    [
        ("FB_Leaf", "\n\n{info 'note'}\n(* moved *)\nq := q + 2;"),
        ("Scale", "\n\n\nScale := 3 * n;\nScale := Scale + 1;"),
        ("PLC_PRG", "\nb();\n\nd(); leaf();\n\nsum := sum + s.Area();"),
        ("FB_Base.Area", "Area := n;\n\n\nArea := Scale(Area);"),
    ],
)
def test_lines_follow_the_edited_text(name: str, body: str):
    pair = Pair()
    pair.bodies["Scale"] = "\nScale := 3 * n;"
    pair.bodies["FB_Base.Area"] = "Area := Scale(n);"
    pair.build()
    pair.bodies[name] = body
    after, whole = pair.both()
    assert after.partial
    assert after.package is not None
    assert whole.package is not None
    assert lines(after.package) == lines(whole.package)


def test_configured_addresses_are_not_repeated():
    texts = {
        "Config": "VAR_CONFIG PLC_PRG.x AT %IW4 : INT; END_VAR",
        "PLC_PRG": "PROGRAM PLC_PRG\nVAR x AT %I* : INT; y : INT; END_VAR\ny := x;\nEND_PROGRAM",
    }
    session = BuildSession()
    for body in ("y := x;", "y := x + 1;", "y := x + 2;"):
        texts["PLC_PRG"] = f"PROGRAM PLC_PRG\nVAR x AT %I* : INT; y : INT; END_VAR\n{body}\nEND_PROGRAM"
        built = build_application([Source(n, x) for n, x in texts.items()], (), OPTIONS, None, session)
        assert built.package is not None
        assert built.analysis is not None
        count = len(built.analysis.configured)
        assert count == 1
