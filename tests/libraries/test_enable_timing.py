"""The rules of timing of blocks with Enable, for every one of the library.

The blocks are those of the library: a new one without a case fails. Spec motion_semantics 4, ax3000 5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from tests.libraries.command_cases import (
    VALID,
    Act,
    Inputs,
    has_output,
    nothing,
    standing,
    stands,
    torque_mode,
    without_bus,
)
from tests.libraries.every_block import (
    BLOCKS,
    ENABLE,
    LEVELS,
    LIBRARY,
    Machine,
    begin_pin,
    good_inputs,
    machine,
)


@dataclass(frozen=True)
class Reading:
    """How the error of a block with Enable comes and goes."""

    breaks: Act | None = lambda found: without_bus(found, nothing)
    """What is wrong; None: the block has no error of its own."""
    mends: Act = lambda found: found.write("xBus", True)
    before: Act = standing
    inputs: Inputs = field(default_factory=dict)
    kind: str = "virtual"


def _wrong(block: str, good: Inputs, bad: Inputs) -> Reading:
    """An input of a block is wrong."""
    return Reading(lambda found: found.set(block, **bad), lambda found: found.set(block, **good))


AXIS_ERROR = Reading(
    lambda found: found.set("Axis", bError=True), lambda found: found.set("Axis", bError=False)
)
ENABLES = {
    "MC_DigitalCamSwitch": Reading(),
    "SMC_DigitalCamSwitch_HighPrecision": Reading(),
    "MC_Power": Reading(
        lambda found: found.set("Axis", fTaskCycle=0.0), lambda found: found.set("Axis", fTaskCycle=0.001)
    ),
    "MC_ReadActualPosition": Reading(),
    "MC_ReadActualTorque": Reading(),
    "MC_ReadActualVelocity": Reading(),
    "MC_ReadAxisError": Reading(),
    "MC_ReadAxisInfo": Reading(breaks=None),
    "MC_ReadBoolParameter": _wrong(
        "MC_ReadBoolParameter", {"ParameterNumber": 1205}, {"ParameterNumber": 17}
    ),
    "MC_ReadDigitalInput": _wrong("MC_ReadDigitalInput", {"InputNumber": 0}, {"InputNumber": 99}),
    "MC_ReadDigitalOutput": _wrong("MC_ReadDigitalOutput", {"OutputNumber": 0}, {"OutputNumber": 99}),
    "MC_ReadMotionState": Reading(),
    "MC_ReadParameter": _wrong("MC_ReadParameter", {"ParameterNumber": 1113}, {"ParameterNumber": 99999}),
    "MC_ReadStatus": Reading(),
    "MC_SetOverride": _wrong("MC_SetOverride", {"VelFactor": 0.5}, {"VelFactor": 1.5}),
    "SMC3_BrakeStatus": Reading(),
    "SMC3_PersistPosition": Reading(
        lambda found: found.set("Axis", bError=True),
        lambda found: found.set("Axis", bError=False),
        kind="drive",
    ),
    "SMC3_PersistPositionLogical": Reading(breaks=None),
    "SMC3_PersistPositionSingleturn": Reading(
        lambda found: found.set("Axis", bError=True),
        lambda found: found.set("Axis", bError=False),
        inputs={"usiNumberOfAbsoluteBits": 16},
        kind="drive",
    ),
    "SMC_CamEditor": Reading(breaks=None),
    "SMC_CamRegister": _wrong("SMC_CamRegister", {"MasterScaling": 1.0}, {"MasterScaling": 0.0}),
    "SMC_CheckAxisCommunication": AXIS_ERROR,
    "SMC_CheckLimits": AXIS_ERROR,
    "SMC_GetCamSlaveSetPosition": _wrong(
        "SMC_GetCamSlaveSetPosition", {"MasterScaling": 1.0}, {"MasterScaling": 0.0}
    ),
    "SMC_GetMaxSetAccDec": Reading(breaks=None),
    "SMC_GetMaxSetVelocity": Reading(breaks=None),
    "SMC_GetOverride": Reading(breaks=None),
    "SMC_GetTrackingError": Reading(breaks=None, inputs={"byDeadTimeCycles": 0}),
    "SMC_InPosition": Reading(breaks=None),
    "SMC_MeasureDistance": Reading(breaks=None),
    "SMC_ReadFBError": Reading(breaks=None),
    "SMC_ReadSetPosition": Reading(),
    "SMC_SetOverride": _wrong("SMC_SetOverride", {"AccFactor": 0.5}, {"AccFactor": -0.5}),
    "SMC_SetTorque": Reading(breaks=None, before=torque_mode, inputs={"fTorque": 1.0}, kind="drive"),
}


@pytest.fixture(scope="module")
def machines() -> Iterator[dict[str, Machine]]:
    with machine("virtual") as virtual, machine("drive") as drive:
        yield {"virtual": virtual, "drive": drive}


def test_every_block_with_enable_has_a_case() -> None:
    """Other blocks work while another input is TRUE (test_profiles), or in each call (test_cam_tappets)."""
    starts = {block: begin_pin(block) for block in BLOCKS}
    assert {block for block in starts if starts[block] in ENABLE} == {*ENABLES} - {"SMC_MeasureDistance"}
    alone = {
        name
        for name, item in LIBRARY.items()
        if name not in BLOCKS and any(pin.name in ENABLE for pin in item.inputs)
    }
    assert alone == {"SMC_PI"}, "without an axis: test_pi_controller"
    assert {block for block in starts if starts[block] in LEVELS} == {"MC_Jog", "SMC_Inch"}
    assert {block for block in starts if starts[block] is None} == {"SMC_GetTappetValue"}


def _enable(found: Machine, block: str, value: bool) -> None:
    found.set(block, **{str(begin_pin(block)): value})
    if block == "MC_Power" and not value:
        found.set("Power", Enable=False)  # the one that brings the axis into its state says so too
    found.cycle()


@pytest.mark.parametrize("block", ENABLES)
def test_a_block_works_while_it_is_enabled(machines: dict[str, Machine], block: str) -> None:
    """ENA-01, ENA-02, ENA-05: from the call in which Enable rises to that in which it falls."""
    case = ENABLES[block]
    found = machines[case.kind]
    case.before(found)
    found.set(block, **good_inputs(block), **case.inputs)
    found.cycle()
    assert stands(found, block) == set()
    works = {name for name in (*VALID, "Busy") if has_output(block, name)}
    for _ in range(3):
        if block == "MC_Power":
            found.set(block, bRegulatorOn=True, bDriveStart=True)
        _enable(found, block, True)
        assert stands(found, block) == works, "in the same call"
        found.cycle(3)
        assert stands(found, block) == works
        if block == "MC_Power":
            break
        _enable(found, block, False)
        assert stands(found, block) == set(), "in the same call"


@pytest.mark.parametrize("block", [block for block, case in ENABLES.items() if case.breaks])
def test_an_error_lasts_as_long_as_its_cause(machines: dict[str, Machine], block: str) -> None:
    """ENA-03: and no longer than Enable."""
    case = ENABLES[block]
    found = machines[case.kind]
    case.before(found)
    found.set(block, **good_inputs(block), **case.inputs)
    if block == "MC_Power":
        found.set(block, bRegulatorOn=True, bDriveStart=True)
    _enable(found, block, True)
    assert case.breaks is not None
    assert "Error" not in stands(found, block)
    case.breaks(found)
    found.cycle()
    for _ in range(3):
        assert "Error" in stands(found, block)
        assert not stands(found, block) & {*VALID}, "not valid with an error"
        assert found.error(block) != "SMC_NO_ERROR"
        found.cycle()
    case.mends(found)
    found.cycle(2)
    assert (stands(found, block) & {"Error"}, found.error(block)) == (set(), "SMC_NO_ERROR")
    case.breaks(found)
    found.cycle()
    assert "Error" in stands(found, block)
    _enable(found, block, False)
    assert (stands(found, block), found.error(block)) == (set(), "SMC_NO_ERROR")


READERS = [block for block in ENABLES if has_output(block, "Valid")]


@pytest.mark.parametrize("block", READERS)
def test_instances_do_not_disturb_each_other(machines: dict[str, Machine], block: str) -> None:
    """ax3000 MC-01: the second one works on when the first one is switched off."""
    case = ENABLES[block]
    found = machines[case.kind]
    case.before(found)
    for name in (block, f"{block}2"):
        found.set(name, **good_inputs(block), **case.inputs)
        _enable(found, name, True) if name == block else found.set(name, **{str(begin_pin(block)): True})
    found.cycle()
    assert stands(found, block) == stands(found, f"{block}2")
    _enable(found, block, False)
    assert stands(found, block) == set()
    assert "Valid" in stands(found, f"{block}2")
