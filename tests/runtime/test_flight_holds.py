"""Who keeps the flight recorder frozen: each owner for himself, and no longer than he is there."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from plc_programs import build

from tappet.runtime.errors import PlcError
from tappet.runtime.flight_holds import FlightHolds
from tappet.runtime.local import LocalRuntime

TEXT = """
PROGRAM PLC_PRG
VAR n : DINT; END_VAR
n := n + 1;
END_PROGRAM
"""


class Clock:
    """Seconds that the test lets pass."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_a_freeze_ends_when_its_owner_is_gone() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        runtime.run(cycles=20)
        application = runtime.plc.application
        assert application is not None
        assert application.flight is not None
        clock = Clock()
        application.flight.holds = FlightHolds(clock)
        assert runtime.flight_freeze(True, "page", 60).frozen_by == "request"
        for clock.now in (50.0, 100.0, 150.0):  # the page is there
            runtime.plc.poll()
            assert runtime.flight_status().frozen
            runtime.plc.flight_renew("page", 60)
        clock.now = 209.0
        runtime.plc.poll()
        runtime.run(cycles=5)
        assert runtime.flight_status().last_cycle == 20
        clock.now = 210.0
        runtime.plc.poll()
        assert not runtime.flight_status().frozen
        runtime.run(cycles=3)
        assert runtime.flight_read(28, "PLC_PRG.n") == 28
        with pytest.raises(PlcError, match="not frozen any more"):
            runtime.plc.flight_renew("page", 60)


def test_each_owner_of_a_freeze_lets_go_for_himself() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        runtime.run(cycles=3)
        assert runtime.flight_freeze(True, "first", 60).frozen
        assert runtime.flight_freeze(True, "second", 60).frozen
        assert runtime.flight_freeze(False, "first").frozen, "the second one still looks"
        assert runtime.flight_freeze(False, "stranger").frozen
        assert not runtime.flight_freeze(False, "second").frozen
        for owner in ("", "first"):  # without an owner: of all
            runtime.flight_freeze(True, owner)
        assert not runtime.flight_freeze(False).frozen
        runtime.flight_freeze(True, "first")
        runtime.stop()
        runtime.start()
        assert not runtime.flight_status().frozen
        with pytest.raises(PlcError, match="not frozen any more"):
            runtime.plc.flight_renew("first", 60)


@given(st.lists(st.tuples(st.sampled_from("abc"), st.integers(-1, 5), st.integers(0, 3)), max_size=40))
def test_holds_are_as_a_list_of_deadlines_says(steps: list[tuple[str, int, int]]) -> None:
    """Each step: an owner takes a hold for so many seconds (0: for good, -1: lets go), then time passes."""
    clock = Clock()
    holds = FlightHolds(clock)
    ends: dict[str, float] = {}
    for owner, seconds, passing in steps:
        if seconds < 0:
            holds.release(owner)
            ends.pop(owner, None)
        else:
            holds.take(owner, seconds or None)
            ends[owner] = clock.now + seconds if seconds else float("inf")
        clock.now += passing
        before = dict(ends)
        ends = {name: end for name, end in ends.items() if end > clock.now}
        assert holds.lapse() == (bool(before) and not ends)
        assert bool(holds) == bool(ends)
