"""Intervals and watchdog times: TASK-17, tasks EX-04."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.project.durations import LONGEST_NS, duration_ns
from tappet.project.errors import InvalidTimeError


@pytest.mark.parametrize(
    ("text", "nanoseconds"),
    [
        ("t#200ms", 200_000_000),
        ("T#20ms", 20_000_000),
        ("t#500us", 500_000),
        ("300", 300_000),
        (" 300 ", 300_000),
        ("TIME#1s500ms", 1_500_000_000),
        ("T#1h_30m", 5_400_000_000_000),
        ("LTIME#1d2h3m4s5ms6us7ns", 93_784_005_006_007),
        ("T#1.5s", 1_500_000_000),
        ("T#0ms", 0),
    ],
)
def test_durations(text: str, nanoseconds: int) -> None:
    assert duration_ns(text) == nanoseconds


@pytest.mark.parametrize(
    "text",
    ["abc", "", "T#", "T#_", "T#5", "-5", "T#-5ms", "T#1ms1s", "T#1s1s", "T#1.5s2ms", "5ms", "1.5", "٣"],
)
def test_texts_that_are_no_durations(text: str) -> None:
    with pytest.raises(InvalidTimeError, match="no time"):
        duration_ns(text)


@pytest.mark.parametrize("text", ["9" * 5000, "T#" + "9" * 100 + "d", "T#300000d"])
def test_durations_beyond_the_clock(text: str) -> None:
    with pytest.raises(InvalidTimeError, match="longer than a task can wait"):
        duration_ns(text)


@given(st.text())
def test_any_text_is_a_duration_or_refused(text: str) -> None:
    try:
        nanoseconds = duration_ns(text)
    except InvalidTimeError as error:
        nanoseconds = 0
        message = str(error)
    else:
        message = ""
    assert 0 <= nanoseconds <= LONGEST_NS
    assert len(message) < 400


@given(st.integers(0, LONGEST_NS))
def test_units_add_up(nanoseconds: int) -> None:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    assert duration_ns(f"LTIME#{seconds}s{rest}ns") == nanoseconds
