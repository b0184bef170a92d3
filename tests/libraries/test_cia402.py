"""The state machine of drives against the transition table of its standard: ETG.6010 V1.1, tables 1 to 6
(IEC 61800-7-201)."""

from __future__ import annotations

from itertools import product

import pytest
from tests.libraries.st_program import Program, run

STATES = {
    "NotReadyToSwitchOn": "x0xx0000",
    "SwitchOnDisabled": "x1xx0000",
    "ReadyToSwitchOn": "x01x0001",
    "SwitchedOn": "x01x0011",
    "OperationEnabled": "x01x0111",
    "QuickStopActive": "x00x0111",
    "FaultReactionActive": "x0xx1111",
    "Fault": "x0xx1000",
}
"""Bits 7 to 0 of the status word in each state."""
COMMANDS = {
    "shutdown": ("0x110", (2, 6, 8)),
    "switch on": ("00111", (3,)),
    "switch on and enable operation": ("01111", (3, 4)),
    "disable voltage": ("0xx0x", (7, 9, 10, 12)),
    "quick stop": ("0x01x", (7, 10, 11)),
    "disable operation": ("00111", (5,)),
    "enable operation": ("01111", (4, 16)),
}
"""Bits 7, 3, 2, 1, 0 of the control word of each command, and the transitions that it makes."""
TRANSITIONS = {
    2: ("SwitchOnDisabled", "ReadyToSwitchOn"),
    3: ("ReadyToSwitchOn", "SwitchedOn"),
    4: ("SwitchedOn", "OperationEnabled"),
    5: ("OperationEnabled", "SwitchedOn"),
    6: ("SwitchedOn", "ReadyToSwitchOn"),
    7: ("ReadyToSwitchOn", "SwitchOnDisabled"),
    8: ("OperationEnabled", "ReadyToSwitchOn"),
    9: ("OperationEnabled", "SwitchOnDisabled"),
    10: ("SwitchedOn", "SwitchOnDisabled"),
    11: ("OperationEnabled", "QuickStopActive"),
    12: ("QuickStopActive", "SwitchOnDisabled"),
    16: ("QuickStopActive", "OperationEnabled"),
}
"""Those that a command makes; 0, 1, 13, 14 and 15 come from the drive or from an edge."""
PATHS = {
    "NotReadyToSwitchOn": [],
    "SwitchOnDisabled": [0x00],
    "ReadyToSwitchOn": [0x00, 0x06],
    "SwitchedOn": [0x00, 0x06, 0x07],
    "OperationEnabled": [0x00, 0x06, 0x07, 0x0F],
    "QuickStopActive": [0x00, 0x06, 0x07, 0x0F, 0x0B],
}
"""Control words from the start to a state."""
DRIVE = """
PROGRAM Main
VAR
    Drive : SM3_Basic.CiA402Drive;
END_VAR
Drive();
END_PROGRAM
"""
BOTH = """
PROGRAM Main
VAR
    Drive   : SM3_Basic.CiA402Drive;
    Control : SM3_Basic.CiA402Control;
END_VAR
Drive(wControlWord := Control.wControlWord);
Control(wStatusWord := Drive.wStatusWord);
END_PROGRAM
"""
DECODED = """
PROGRAM Main
VAR
    wStatus : WORD;
    eState  : SM3_Basic.CiA402State;
END_VAR
eState := SM3_Basic.CiA402StateOf(wStatus);
END_PROGRAM
"""


def _matches(pattern: str, bits: str) -> bool:
    return all(wanted in ("x", bit) for wanted, bit in zip(pattern, bits, strict=True))


def _expected(state: str, word: int) -> str:
    bits = "".join(str(word >> bit & 1) for bit in (7, 3, 2, 1, 0))
    wanted = {
        after
        for pattern, transitions in COMMANDS.values()
        for before, after in (TRANSITIONS[number] for number in transitions)
        if before == state and _matches(pattern, bits)
    }
    assert len(wanted) <= 1, (state, bits, wanted)
    return next(iter(wanted), state)


def _state(program: Program) -> str:
    return program.literal("Main.Drive.eState").rpartition(".")[2]


def _bring(program: Program, state: str) -> None:
    program.set("Main.Drive", bInitialised=state != "NotReadyToSwitchOn")
    for word in PATHS[state]:
        program.set("Main.Drive", wControlWord=word)
        program.cycle()
    assert _state(program) == state


@pytest.mark.parametrize("state", PATHS)
def test_each_control_word_makes_the_transition_of_the_standard(state: str) -> None:
    for bits in product((0, 1), repeat=5):
        word = sum(bit << place for bit, place in zip(bits, (7, 3, 2, 1, 0), strict=True))
        with run(DRIVE, 0) as program:
            _bring(program, state)
            program.set("Main.Drive", wControlWord=word)
            program.cycle()
            assert _state(program) == _expected(state, word), f"{word:#x}"


@pytest.mark.parametrize("state", PATHS)
def test_a_fault_ends_every_state(state: str) -> None:
    """Transitions 13, 14 and 15: the fault is reset by an edge, and only when it is gone."""
    with run(DRIVE, 0) as program:
        _bring(program, state)
        program.set("Main.Drive", bFault=True, bStands=False, bInitialised=True)
        program.cycle()
        program.cycle()
        assert _state(program) == "FaultReactionActive"
        program.set("Main.Drive", bStands=True)
        program.cycle()
        assert _state(program) == "Fault"
        for word, fault, after in (
            (0x80, True, "Fault"),
            (0x80, False, "Fault"),
            (0x0F, False, "Fault"),
            (0x80, False, "SwitchOnDisabled"),
        ):
            program.set("Main.Drive", wControlWord=word, bFault=fault)
            program.cycle()
            assert _state(program) == after, f"{word:#x}"


def test_a_quick_stop_ends_without_torque_where_the_drive_does_not_hold() -> None:
    """Transition 12 by itself: quick stop option codes 1 and 2."""
    with run(DRIVE, 0) as program:
        _bring(program, "QuickStopActive")
        program.set("Main.Drive", bHolds=False, bStands=False, wControlWord=0x0F)
        program.cycle()
        assert _state(program) == "QuickStopActive"
        program.set("Main.Drive", bStands=True)
        program.cycle()
        assert _state(program) == "SwitchOnDisabled"


@pytest.mark.parametrize("state", ["ReadyToSwitchOn", "SwitchedOn", "OperationEnabled", "QuickStopActive"])
def test_without_voltage_a_drive_has_no_power(state: str) -> None:
    with run(DRIVE, 0) as program:
        _bring(program, state)
        program.set("Main.Drive", bVoltage=False)
        program.cycle()
        assert _state(program) == "SwitchOnDisabled"
        program.set("Main.Drive", wControlWord=0x06)
        program.cycle()
        assert _state(program) == "SwitchOnDisabled"


def test_the_status_word_tells_the_state() -> None:
    with run(DRIVE, 0) as program:
        for state in PATHS:
            with run(DRIVE, 0) as fresh:
                _bring(fresh, state)
                fresh.set("Main.Drive", wControlWord=0x80)  # no command
                fresh.cycle()
                word = int(fresh.literal("Main.Drive.wStatusWord"))
                assert _matches(STATES[state], f"{word & 0xFF:08b}"), state
                assert word >> 4 & 1 == 1
        program.set("Main.Drive", bFault=True)
        for state in ("FaultReactionActive", "Fault"):
            program.cycle()
            word = int(program.literal("Main.Drive.wStatusWord"))
            assert _matches(STATES[state], f"{word & 0xFF:08b}"), state


def test_every_status_word_is_read_as_the_standard_has_it() -> None:
    with run(DECODED, 0) as program:
        for word in range(0x100):
            fits = [name for name, pattern in STATES.items() if _matches(pattern, f"{word:08b}")]
            assert len(fits) <= 1
            program.set("Main", wStatus=word)
            program.cycle()
            found = program.literal("Main.eState").rpartition(".")[2]
            assert found == (fits[0] if fits else "NotReadyToSwitchOn"), f"{word:#x}"


def test_the_axis_side_brings_a_drive_to_operation_and_back() -> None:
    with run(BOTH, 3) as program:
        assert _state(program) == "SwitchOnDisabled"
        program.set("Main.Control", bPower=True, bStart=True)
        seen = []
        for _ in range(6):
            program.cycle()
            seen.append(_state(program))
        assert [*dict.fromkeys(seen)][-3:] == ["ReadyToSwitchOn", "SwitchedOn", "OperationEnabled"]
        program.set("Main.Control", bStart=False)
        program.cycle()
        program.cycle()
        assert _state(program) == "QuickStopActive"
        assert program.literal("Main.Control.bOn") == "TRUE"
        assert program.literal("Main.Control.bFollows") == "FALSE"
        program.set("Main.Control", bStart=True)
        program.cycle()
        program.cycle()
        assert _state(program) == "OperationEnabled"
        program.set("Main.Control", bPower=False)
        program.cycle()
        program.cycle()
        assert _state(program) == "SwitchOnDisabled"


def test_the_axis_side_resets_a_fault() -> None:
    with run(BOTH, 3) as program:
        program.set("Main.Control", bPower=True, bStart=True)
        for _ in range(6):
            program.cycle()
        program.set("Main.Drive", bFault=True)
        for _ in range(3):
            program.cycle()
        assert _state(program) == "Fault"
        assert program.literal("Main.Control.bFault") == "TRUE"
        program.set("Main.Drive", bFault=False)
        for _ in range(3):
            program.cycle()
        assert _state(program) == "Fault"
        program.set("Main.Control", bReset=True)
        for _ in range(6):
            program.cycle()
        assert _state(program) == "OperationEnabled"
        assert program.literal("Main.Control.bFault") == "FALSE"
