"""The rows of the timing tables of commands, for every block of the library with Execute.

The blocks are those of the library: a new one without a case fails. Spec motion_semantics 3, ax3000 5.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.libraries.command_cases import (
    EXECUTES,
    GOALS,
    HOLDERS,
    NUMBERS,
    OVER,
    UNTIL_ANOTHER,
    Case,
    has_output,
    stands,
)
from tests.libraries.every_block import BLOCKS, EXECUTE, LIBRARY, Machine, begin_pin, good_inputs, machine

ON_FILES = {"SMC_ReadCAM", "SMC_WriteCAM", "SMC_AxisDiagnosticLog"}
"""They need a runtime: tests/runtime/test_file_block_timing.py."""
ABORTED = [
    block
    for block, case in EXECUTES.items()
    if case.aborts and "CommandAborted" in {pin.name.removeprefix("b") for pin in BLOCKS[block].outputs}
]
MOTIONS = [
    block
    for block in ABORTED
    if block not in ("MC_TouchProbe", "MC_HaltSuperimposed", "SMC_SetControllerMode")
]


@pytest.fixture(scope="module")
def machines() -> Iterator[dict[str, Machine]]:
    with machine("virtual") as virtual, machine("drive") as drive:
        yield {"virtual": virtual, "drive": drive}


def _check(block: str, told: set[str]) -> None:
    """EXE-05: one of Done, CommandAborted and Error, and then not Busy; what is reached is Busy."""
    assert len(told & {*OVER}) <= 1, told
    assert block in HOLDERS or not (told & {*OVER} and told & {"Busy", "Active"}), told
    assert not told & {*GOALS} or "Busy" in told, told


def _start(found: Machine, block: str, case: Case) -> None:
    case.before(found)
    found.set(block, **good_inputs(block), **case.inputs)
    found.cycle()
    assert stands(found, block) == set(), "EXE-08"
    found.set(block, **{str(begin_pin(block)): True})
    found.cycle()
    assert stands(found, block) in ({"Busy"}, {"Done"}, {"Busy", "Done"} if block in HOLDERS else {"Busy"})


def release(found: Machine, block: str) -> None:
    found.set(block, **{str(begin_pin(block)): False})
    found.cycle()


def test_every_block_with_execute_has_a_case() -> None:
    """SMC_MeasureDistance works while bExecute is TRUE, as a block with Enable."""
    found = {
        name
        for name, item in LIBRARY.items()
        if item.kind == "function_block" and any(pin.name in EXECUTE for pin in item.inputs)
    }
    assert found == {*EXECUTES, "SMC_MeasureDistance", *ON_FILES}
    assert {block for block in BLOCKS if begin_pin(block) in EXECUTE} == found - ON_FILES


@pytest.mark.parametrize("block", EXECUTES)
def test_a_command_from_its_edge_to_its_end(machines: dict[str, Machine], block: str) -> None:
    """Rows n-1 to n+k+1: EXE-01, EXE-05 to EXE-08, ax3000 MC-02 and MC-03."""
    case = EXECUTES[block]
    found = machines[case.kind]
    _start(found, block, case)
    if has_output(block, "Active") and "Busy" in stands(found, block):
        found.cycle()
        assert stands(found, block) >= {"Busy", "Active"}, "EXE-06: a cycle behind Busy"
    case.ends(found)
    last = ("Done",) if has_output(block, "Done") else GOALS
    if not has_output(block, *last):
        found.cycle(20)
        assert stands(found, block) - {"Active"} == {"Busy"}
        return
    for _ in range(8000):
        told = stands(found, block)
        _check(block, told)
        if told & {*last}:
            break
        assert "Busy" in told
        found.cycle()
    expected = told & {"Done"} or {"Busy", *told} & {"Busy", *GOALS}
    expected |= {"Busy"} if block in HOLDERS else set()
    for _ in range(4):
        assert stands(found, block) - {"Active"} == expected, "EXE-07"
        found.cycle()
    if "Done" in expected and block not in UNTIL_ANOTHER:
        release(found, block)
        assert stands(found, block) == set(), "EXE-08"


@pytest.mark.parametrize("block", EXECUTES)
def test_a_result_lasts_one_cycle_without_execute(machines: dict[str, Machine], block: str) -> None:
    """EXE-04, EXE-07: a falling edge ends nothing, and the end is told in one cycle."""
    case = EXECUTES[block]
    found = machines[case.kind]
    _start(found, block, case)
    if "Done" in stands(found, block) and block not in HOLDERS:
        release(found, block)
        assert stands(found, block) == set()
        return
    release(found, block)
    case.ends(found)
    if not has_output(block, "Done") or block in UNTIL_ANOTHER:
        found.cycle(5)
        assert "Busy" in stands(found, block)
        assert not stands(found, block) & {*OVER}
        return
    found.until(lambda: "Done" in stands(found, block), 8000)
    assert stands(found, block) == {"Done"}
    found.cycle()
    assert stands(found, block) == set()


@pytest.mark.parametrize("released", [False, True])
@pytest.mark.parametrize("block", EXECUTES)
def test_an_error_at_the_edge(machines: dict[str, Machine], block: str, released: bool) -> None:
    """EXE-10, EXE-07: Error alone, as long as Execute, in one cycle at least; its number goes with it."""
    case = EXECUTES[block]
    found = machines[case.kind]
    (case.wrongly or case.before)(found)
    found.set(block, **{**good_inputs(block), **case.inputs, **case.wrong})
    found.cycle()
    state = found.state
    found.set(block, **{str(begin_pin(block)): True})
    found.cycle()
    assert (stands(found, block), NUMBERS[found.error(block)]) == ({"Error"}, case.error)
    assert found.state == state
    for _ in range(0 if released else 3):
        found.cycle()
        assert (stands(found, block), NUMBERS[found.error(block)]) == ({"Error"}, case.error)
    release(found, block)
    assert (stands(found, block), found.error(block)) == (set(), "SMC_NO_ERROR")


@pytest.mark.parametrize("released", [False, True])
@pytest.mark.parametrize("block", ABORTED)
def test_a_command_that_is_aborted(machines: dict[str, Machine], block: str, released: bool) -> None:
    """EXE-09, EXE-07, INF-06: a cycle behind the other command at the latest, then as long as Execute."""
    case = EXECUTES[block]
    found = machines[case.kind]
    _start(found, block, case)
    if "Done" in stands(found, block):
        pytest.skip("it is over in the call of its edge")
    found.cycle(3)
    assert "Busy" in stands(found, block)
    if released:
        release(found, block)
    assert case.aborts is not None
    case.aborts(found)
    found.cycle()
    if "CommandAborted" not in stands(found, block):
        found.cycle()
    assert stands(found, block) == {"CommandAborted"}
    if not released:
        found.cycle(3)
        assert stands(found, block) == {"CommandAborted"}
        release(found, block)
        assert stands(found, block) == set()
        return
    found.cycle()
    assert stands(found, block) == set()


@pytest.mark.parametrize("block", ["MC_GearOut", "MC_CamOut"])
def test_a_released_slave_stays_released(machines: dict[str, Machine], block: str) -> None:
    """EXE-07: Done as long as Execute, also when another command has it; ax3000 EX-AX-17 stops by it."""
    case = EXECUTES[block]
    found = machines[case.kind]
    _start(found, block, case)
    found.set("OtherStop", Execute=True, Deceleration=100.0)
    found.cycle()
    for _ in range(5):
        found.cycle()
        assert stands(found, block) == {"Done"}
    release(found, block)
    assert stands(found, block) == set()


@pytest.mark.parametrize("block", MOTIONS)
def test_another_edge_while_it_is_busy(machines: dict[str, Machine], block: str) -> None:
    """EXE-03, MC-04: it starts anew, without an end of the one before."""
    case = EXECUTES[block]
    found = machines[case.kind]
    _start(found, block, case)
    found.cycle(3)
    release(found, block)
    assert "Busy" in stands(found, block)
    before = found.number("Axis.fSetVelocity")
    found.set(block, **{str(begin_pin(block)): True})
    found.cycle()
    if block in (
        "MC_PositionProfile",
        "MC_VelocityProfile",
        "MC_AccelerationProfile",
        "MC_Home",
        "SMC_Homing",
    ):
        assert stands(found, block) == {"Error"}, "the block starts in standstill alone"
        return
    assert stands(found, block) - {"Active", *GOALS} == {"Busy"}
    assert abs(found.number("Axis.fSetVelocity") - before) <= 1.0, "without a step"
    found.cycle(3)
    _check(block, stands(found, block))


@pytest.mark.parametrize("block", MOTIONS)
def test_an_axis_that_fails_fails_its_command(machines: dict[str, Machine], block: str) -> None:
    """EXE-10, ERR-08: Error with the number of the axis, in errorstop."""
    case = EXECUTES[block]
    found = machines[case.kind]
    _start(found, block, case)
    if "Done" in stands(found, block):
        pytest.skip("it is over in the call of its edge")
    found.cycle(3)
    found.set("MC_ImmediateStop2", Execute=True)
    found.cycle(2)
    assert (stands(found, block), found.error(block)) == ({"Error"}, "SMC_IS_AXIS_STOPPED")
    assert found.state == "errorstop"
