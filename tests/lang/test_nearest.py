"""Proposals are names that a slip or two of the fingers away, and no others."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from resolved import analysed

from tappet.lang.nearest import distance, nearest

NAMES = st.text(alphabet="ABCD", max_size=7)


def _slips(a: str, b: str) -> int:
    """The definition: each place is touched once."""
    if not a or not b:
        return len(a) + len(b)
    found = min(_slips(a[1:], b) + 1, _slips(a, b[1:]) + 1, _slips(a[1:], b[1:]) + (a[0] != b[0]))
    if a[:2] == b[1::-1] and len(a) > 1 and len(b) > 1:
        found = min(found, _slips(a[2:], b[2:]) + 1)
    return found


@given(a=st.text(alphabet="ABC", max_size=5), b=st.text(alphabet="ABC", max_size=5), limit=st.integers(0, 6))
def test_the_distance_is_that_of_its_definition(a: str, b: str, limit: int) -> None:
    slips = _slips(a, b)
    found = distance(a, b, limit)
    assert found == slips if slips <= limit else found > limit


@given(name=NAMES, known=st.lists(NAMES, unique=True, max_size=8))
def test_only_near_names_are_proposed_the_nearest_first(name: str, known: list[str]) -> None:
    found = nearest(name, known, 3)
    limit = max(1, len(name) // 4)
    slips = [distance(name, other, limit) for other in found]
    assert slips == sorted(slips)
    assert all(one <= limit for one in slips)
    missed = [other for other in known if distance(name, other, limit) <= limit and other not in found]
    assert len(found) == 3 or all(distance(name, other, limit) >= len(name) for other in missed)


def _advice(body: str) -> list[str]:
    text = (
        "FUNCTION Speek : INT VAR_INPUT a : INT; END_VAR Speek := a; END_FUNCTION\n"
        "TYPE T_Speed : INT; END_TYPE\nTYPE I_Speed : INT; END_TYPE\n"
        f"PROGRAM P\nVAR Speed, iq : INT; n : DINT; END_VAR\n{body}\nEND_PROGRAM"
    )
    return [d.advice for d in analysed(text).diagnostics if d.severity == "error"]


def test_what_is_proposed_is_of_the_kind_that_is_needed() -> None:
    assert _advice("n := Speex;") == ["Did you mean 'Speed' (P)?"]
    assert _advice("n := Speex(1);") == ["Did you mean 'Speek' (function)?"]


def test_names_that_are_not_near_are_not_proposed() -> None:
    assert (
        _advice("n := Velocity; n := SpeedOfMotor; n := xyz;") == ["Declare it, or correct its spelling."] * 3
    )
