"""An axis group steered from its page (axis_group.md AG-10, AG-11, AG-16, AG-23)."""

from __future__ import annotations

import pytest
from tests.project.test_axis_groups import DEFAULTS, programmed, running, with_group

from tappet.runtime.errors import PlcError
from tappet.runtime.local import LocalRuntime
from tappet.runtime.operations.axis_group_panel import GroupAction, SteerAxisGroup
from tappet.runtime.operations.declaration import OperationError

PANEL = "IoConfig_GroupPanel_Machine.Machine"
BODY = """fbPower(AxisGroup := Machine);
fbMove.Position.a[0] := 170.0;
fbMove(AxisGroup := Machine, CoordSystem := SMC_COORD_SYSTEM.ACS);"""


def machine() -> LocalRuntime:
    plc = running(programmed(with_group("X", "Y", defaults=DEFAULTS), BODY))
    for switch in ("Enable", "bRegulatorOn", "bDriveStart"):
        plc.write(f"PLC_PRG.fbPower.{switch}", True)
    plc.run(cycles=10)
    return plc


def steer(plc: LocalRuntime, action: GroupAction, cycles: int = 3) -> str:
    """The state of the group behind a command."""
    SteerAxisGroup("Machine", action).run(plc.plc)
    plc.run(cycles=cycles)
    return plc.literal("Machine.eState")


def test_a_group_is_enabled_and_disabled() -> None:
    with machine() as plc:
        assert steer(plc, "enable") == "GroupStandby"
        assert plc.literal(f"{PANEL}.eError") == "SMC_NO_ERROR"
        assert steer(plc, "disable") == "GroupDisabled"
        assert not plc.read(f"{PANEL}.xUsed")


def test_a_command_that_the_state_forbids_says_why() -> None:
    with machine() as plc:
        assert steer(plc, "stop") == "GroupDisabled"
        assert plc.literal(f"{PANEL}.eError") == "SMC_AXIS_GROUP_WRONG_STATE"
        assert steer(plc, "enable") == "GroupStandby"
        assert plc.literal(f"{PANEL}.eError") == "SMC_NO_ERROR"


def test_a_stop_ends_on_the_path_and_lets_go_of_the_group() -> None:
    """The group brakes from 10 mm/s with the 100 mm/s² of its axes: 0.1 s, 0.5 mm."""
    with machine() as plc:
        steer(plc, "enable")
        plc.write("PLC_PRG.fbMove.Execute", True)
        plc.run(cycles=50)
        before = float(plc.read("X.fSetPosition"))
        assert plc.read("Machine.fPathVelocity") == pytest.approx(10.0)
        assert steer(plc, "stop", cycles=2) == "GroupStopping"
        plc.run(cycles=10)
        assert plc.literal("Machine.eState") == "GroupStandby"
        assert plc.read("PLC_PRG.fbMove.CommandAborted")
        assert float(plc.read("X.fSetPosition")) - before == pytest.approx(0.5, abs=2 * 0.02 * 10.0)
        assert float(plc.read("X.fSetVelocity")) == 0.0


def test_a_reset_takes_back_the_errors_of_the_group_and_its_axes() -> None:
    with machine() as plc:
        steer(plc, "enable")
        plc.write("PLC_PRG.fbMove.Execute", True)
        plc.run(cycles=20)
        plc.write("PLC_PRG.fbPower.bRegulatorOn", False)
        plc.run(cycles=40)
        assert plc.literal("Machine.eState") == "GroupErrorStop"
        plc.write("PLC_PRG.fbPower.bRegulatorOn", True)
        plc.run(cycles=10)
        assert steer(plc, "reset", cycles=20) == "GroupStandby"


def test_another_group_is_not_there() -> None:
    with machine() as plc, pytest.raises(OperationError, match="has no axis group 'Other'"):
        SteerAxisGroup("Other", "stop").run(plc.plc)


def test_an_application_that_stands_cannot_be_steered() -> None:
    with machine() as plc:
        plc.plc.stop()
        with pytest.raises(PlcError, match="does not run"):
            SteerAxisGroup("Machine", "enable").run(plc.plc)
