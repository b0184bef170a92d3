"""Breakpoints on the steps of a chart (LSFC-25): they halt where the step is active, before what it does."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from debugger_programs import URI, add, halted, line, loaded, step, until, value

from tappet.runtime.plc import SoftPlc

TEXT = """PROGRAM PLC_PRG
VAR
    n : INT;
    m : INT;
    entered : INT;
END_VAR
INITIAL_STEP Count: Up(N); END_STEP
STEP Rest: Enter(ENTRY); Down(N); END_STEP
TRANSITION FROM Count TO Rest := n MOD 3 = 0; END_TRANSITION
TRANSITION FROM Rest TO Count := m MOD 2 = 0; END_TRANSITION
ACTION Up:
    n := n + 1;
    n := n + 0;
END_ACTION
ACTION Down: m := m + 1; END_ACTION
ACTION Enter: entered := entered + 1; END_ACTION
END_PROGRAM
"""
COUNT, REST, UP, DOWN = 7, 8, 12, 15


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    yield plc
    plc.close()


def counters(plc: SoftPlc) -> tuple[object, object, object]:
    return value(plc, "PLC_PRG.n"), value(plc, "PLC_PRG.m"), value(plc, "PLC_PRG.entered")


def test_a_step_halts_while_it_is_active_and_before_its_actions(plc: SoftPlc) -> None:
    """Found by hand: `Count` leaves with n = 3, 6, 9, `Rest` with even m; what is left runs once more."""
    found = add(plc, REST)
    assert found.actual is not None
    assert found.actual.line == REST
    plc.start()
    seen = []
    for _ in range(4):
        assert line(plc) == REST
        seen.append(counters(plc))
        plc.debugger.control("continue")
        until(lambda: counters(plc) != seen[-1])
        halted(plc)
    assert seen == [(3, 0, 0), (4, 1, 1), (6, 3, 1), (9, 5, 2)]


def test_step_over_goes_on_to_the_next_step_that_is_carried_out(plc: SoftPlc) -> None:
    add(plc, COUNT)
    plc.start()
    assert line(plc) == COUNT
    plc.debugger.remove(None)
    assert [step(plc, "step_over") for _ in range(7)] == [COUNT, COUNT, REST, REST, COUNT, COUNT, REST]


def test_step_into_enters_the_action_of_the_step(plc: SoftPlc) -> None:
    add(plc, COUNT)
    plc.start()
    assert line(plc) == COUNT
    plc.debugger.remove(None)
    assert [step(plc, "step_into") for _ in range(3)] == [UP, UP + 1, COUNT]
    assert step(plc, "step_into") == UP
    assert step(plc, "step_over") == UP + 1
    assert step(plc, "step_over") == COUNT, "the action goes on until the next step is carried out"


def test_flow_control_knows_the_active_steps(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    add(plc, DOWN)
    plc.start()
    halted(plc)
    lines = {statement.line for statement in plc.debugger.flow(URI).statements}
    assert REST in lines
    assert COUNT not in lines
