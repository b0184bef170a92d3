"""Joining two changed versions: edits at different places of a text, conflicts at the same place."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from tappet.project.exchange.three_way import join_data, join_texts, nearest

LINES = st.lists(st.sampled_from(["a := 1;", "b := 2;", "IF x THEN", "END_IF", "", "c;"]), max_size=12)
TEXTS = LINES.map("\n".join)


@given(TEXTS, TEXTS)
def test_a_change_of_one_side_is_taken_whole(base: str, changed: str) -> None:
    for ours, theirs in ((base, changed), (changed, base), (changed, changed)):
        joined = join_texts(base, ours, theirs)
        assert (joined.text, joined.conflicts) == (changed, ())


@given(TEXTS, TEXTS, TEXTS)
def test_sides_are_equal_where_nothing_conflicts(base: str, ours: str, theirs: str) -> None:
    one, other = join_texts(base, ours, theirs), join_texts(base, theirs, ours)
    assert bool(one.conflicts) == bool(other.conflicts)
    if not one.conflicts:
        assert one.text == other.text


@given(st.lists(st.tuples(st.sampled_from("klr"), st.text("xyz", max_size=3)), min_size=1, max_size=20))
def test_edits_at_different_lines_are_all_there(edits: list[tuple[str, str]]) -> None:
    """Numbered lines, so that the right result is known: each is kept, changed on the left or on the right,
    with an unchanged line behind each."""
    base, ours, theirs, wanted = [], [], [], []
    for number, (side, text) in enumerate(edits):
        line, changed, fence = f"line {number}", f"changed {number} {text}", f"fence {number}"
        base += [line, fence]
        ours += [changed if side == "l" else line, fence]
        theirs += [changed if side == "r" else line, fence]
        wanted += [line if side == "k" else changed, fence]
    joined = join_texts("\n".join(base), "\n".join(ours), "\n".join(theirs))
    assert (joined.text, joined.conflicts) == ("\n".join(wanted), ())


def test_the_same_line_changed_in_two_ways_is_a_conflict_at_its_line() -> None:
    joined = join_texts("a\nb\nc", "a\nours\nc", "a\ntheirs\nc\nd")
    assert (joined.text, joined.conflicts) == ("a\ntheirs\nc\nd", (2,))


def test_without_an_ancestor_what_only_one_side_has_stays() -> None:
    joined = join_texts(None, "a\nmine\nb\nc", "a\nb\nyours\nc")
    assert (joined.text, joined.conflicts) == ("a\nmine\nb\nyours\nc", ())
    assert join_texts(None, "a\nmine\nb", "a\nyours\nb").conflicts == (2,)


def test_both_sides_may_declare_variables_at_one_place() -> None:
    def both(mine: str, yours: str) -> tuple[str, tuple[int, ...]]:
        texts = [f"VAR\n  old : INT;\n{more}END_VAR" for more in ("", mine, yours)]
        joined = join_texts(*texts, declarations=True)
        return joined.text, joined.conflicts

    text, conflicts = both("  a : INT;\n", "  b, c : BOOL := TRUE; // c\n")
    assert (text, conflicts) == (
        "VAR\n  old : INT;\n  a : INT;\n  b, c : BOOL := TRUE; // c\nEND_VAR",
        (),
    )
    assert both("  a : INT;\n", "  A : REAL;\n")[1] == (3,)
    assert both("  a : INT;\n", "  b();\n")[1] == (3,)


def test_fields_and_drawn_bodies_are_taken_as_a_whole() -> None:
    base = {"interval": "T#10ms", "priority": 1, "comment": "x"}
    joined = join_data(base, base | {"interval": "T#20ms"}, base | {"priority": 3})
    assert joined.data == {"interval": "T#20ms", "priority": 3, "comment": "x"}
    assert join_data(base, base | {"priority": 2}, base | {"priority": 3}).conflicts == {"priority": ()}
    drawn = {"language": "LD", "implementation": "a\nb"}
    left, right = drawn | {"implementation": "a1\nb"}, drawn | {"implementation": "a\nb1"}
    assert join_data(drawn, left, right).conflicts == {"implementation": ()}
    text = {"language": "ST"}
    assert join_data(drawn | text, left | text, right | text).conflicts == {"implementation": (1,)}


def test_the_ancestor_is_the_state_most_like_the_other_side() -> None:
    states = [{"declaration": text} for text in ("a\nb\nc\nours", "a\nb\nc", "a")]
    assert nearest(states, {"declaration": "a\nb\nc\ntheirs"}) == {"declaration": "a\nb\nc"}
    assert nearest([], {}) is None
