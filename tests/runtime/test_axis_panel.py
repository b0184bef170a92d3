"""The panel of an axis on virtual time: control, commands, and the dead-man watchdog."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import pytest
from test_moving_axes import CYCLE, no_step, package, positions
from tests.project.axis_projects import BODY, moving, with_axes

from tappet.codegen.package import CodePackage
from tappet.runtime.errors import PlcError
from tappet.runtime.local import LocalRuntime
from tappet.runtime.operations.axis_panel import Action, KeepAxis, SteerAxis, StopAxis
from tappet.runtime.operations.declaration import OperationError

ME, ANOTHER = 7, 8
PATIENCE = round(2.0 / CYCLE)


@cache
def machine(body: str) -> CodePackage:
    return package(moving(with_axes("Drive"), body))


@pytest.fixture
def runtime() -> Iterator[LocalRuntime]:
    """No program moves the axis."""
    with LocalRuntime(machine("")) as runtime:
        runtime.run(cycles=2)
        yield runtime


def steer(runtime: LocalRuntime, action: Action, holder: int = ME, **motion: float) -> None:
    SteerAxis("Drive", holder, action, **motion).run(runtime.plc)


def stay(runtime: LocalRuntime, cycles: int) -> list[float]:
    """So many cycles with somebody at the page; the set positions."""
    places = []
    for _ in range(cycles):
        KeepAxis("Drive", ME).run(runtime.plc)
        places += positions(runtime, 1)
    return places


def state(runtime: LocalRuntime) -> str:
    return runtime.literal("IoConfig_AxisPanels.Drive.eState")


def test_an_axis_is_moved_by_hand(runtime: LocalRuntime) -> None:
    steer(runtime, "take")
    stay(runtime, 2)
    assert state(runtime) == "Control"
    steer(runtime, "move_absolute", position=5.0)
    stay(runtime, 2)
    assert runtime.literal("IoConfig_AxisPanels.Drive.eError") == "SMC_REGULATOR_OR_START_NOT_SET"
    steer(runtime, "power_on")
    stay(runtime, 3)
    steer(runtime, "move_absolute", position=5.0)
    places = stay(runtime, 60)
    assert no_step(places)
    assert places[-1] == pytest.approx(5.0)
    steer(runtime, "move_relative", position=-2.0)
    assert stay(runtime, 60)[-1] == pytest.approx(3.0)
    steer(runtime, "set_position", position=100.0)
    assert stay(runtime, 3)[-1] == pytest.approx(100.0)
    assert runtime.literal("IoConfig_AxisPanels.Drive.eError") == "SMC_NO_ERROR"
    steer(runtime, "home", position=25.0)
    assert stay(runtime, 10)[-1] == pytest.approx(25.0)
    assert runtime.literal("IoConfig_AxisPanels.Drive.eError") == "SMC_NO_ERROR"
    assert runtime.literal("Drive.nAxisState") == "standstill"
    steer(runtime, "power_off")
    stay(runtime, 3)
    assert runtime.literal("Drive.nAxisState") == "power_off"
    StopAxis("Drive", ME, release=True).run(runtime.plc)
    runtime.run(cycles=3)
    assert state(runtime) == "Free"
    assert runtime.read("IoConfig_AxisPanels.Drive.xUsed") is False


def test_a_jog_lasts_as_long_as_the_key(runtime: LocalRuntime) -> None:
    steer(runtime, "take")
    stay(runtime, 2)
    steer(runtime, "power_on")
    stay(runtime, 3)
    steer(runtime, "jog_forward")
    forward = stay(runtime, 50)
    assert runtime.read("Drive.fSetVelocity") == 10.0
    steer(runtime, "jog_end")
    forward += stay(runtime, 20)
    assert runtime.read("Drive.fSetVelocity") == 0.0
    assert no_step(forward)
    assert runtime.literal("IoConfig_AxisPanels.Drive.eError") == "SMC_NO_ERROR"
    steer(runtime, "jog_backward")
    backward = stay(runtime, 30)
    assert backward[-1] < forward[-1]
    StopAxis("Drive", ME).run(runtime.plc)
    stay(runtime, 20)
    assert runtime.read("Drive.fSetVelocity") == 0.0
    assert state(runtime) == "Control"


@pytest.mark.parametrize("action", ["jog_forward", "move_relative"])
def test_a_page_that_is_gone_stops_the_axis_by_its_ramp(runtime: LocalRuntime, action: Action) -> None:
    steer(runtime, "take")
    stay(runtime, 2)
    steer(runtime, "power_on")
    stay(runtime, 3)
    steer(runtime, action, position=1000.0)
    places = stay(runtime, 30)
    places += positions(runtime, PATIENCE - 2)
    assert runtime.read("Drive.fSetVelocity") == 10.0
    places += positions(runtime, 30)
    assert no_step(places)
    assert runtime.read("Drive.fSetVelocity") == 0.0
    assert state(runtime) == "Free"
    assert runtime.read("IoConfig_AxisPanels.Drive.xLost") is True
    assert runtime.literal("Drive.nAxisState") == "power_off"
    with pytest.raises(OperationError, match="nobody controls the axis"):
        steer(runtime, "move_absolute")
    assert KeepAxis("Drive", ME).run(runtime.plc).state == "Free"


def test_one_page_controls_an_axis(runtime: LocalRuntime) -> None:
    steer(runtime, "take")
    stay(runtime, 2)
    for action in ("take", "force", "power_on"):
        with pytest.raises(OperationError, match="another page controls the axis 'Drive'"):
            steer(runtime, action, holder=ANOTHER)
    with pytest.raises(OperationError, match="another page"):
        StopAxis("Drive", ANOTHER).run(runtime.plc)
    for _ in range(PATIENCE + 2):
        KeepAxis("Drive", ANOTHER).run(runtime.plc)
        runtime.run(cycles=1)
    assert state(runtime) == "Free"


def test_control_of_an_axis_that_the_program_moves_has_to_be_forced() -> None:
    with LocalRuntime(machine(BODY)) as runtime:
        places = positions(runtime, 60)
        steer(runtime, "take")
        places += positions(runtime, 5)
        assert runtime.read("IoConfig_AxisPanels.Drive.xRefused") is True
        assert state(runtime) == "Free"
        assert runtime.read("Drive.fSetVelocity") == 10.0
        steer(runtime, "force")
        places += stay(runtime, 20)
        assert state(runtime) == "Control"
        assert runtime.read("Drive.fSetVelocity") == 0.0
        assert runtime.read("PLC_PRG.fbMove.Error") is True
        steer(runtime, "move_relative", position=-1.0)
        runtime.write("PLC_PRG.fbMove.Execute", False)
        places += stay(runtime, 60)
        assert no_step(places)
        assert runtime.read("PLC_PRG.fbMove.Error") is True
        StopAxis("Drive", ME, release=True).run(runtime.plc)
        runtime.run(cycles=3)
        assert runtime.literal("Drive.nAxisState") in ("standstill", "discrete_motion")


def test_errors_are_reset_by_hand(runtime: LocalRuntime) -> None:
    steer(runtime, "take")
    stay(runtime, 2)
    steer(runtime, "power_on")
    stay(runtime, 3)
    runtime.write("Drive.fMaxVelocity", 5.0)
    steer(runtime, "move_absolute", position=100.0)
    stay(runtime, 60)
    assert runtime.literal("Drive.nAxisState") == "errorstop"
    assert runtime.literal("IoConfig_AxisPanels.Drive.eError") == "SMC_VD_MAX_VELOCITY_EXCEEDED"
    steer(runtime, "reset")
    stay(runtime, 5)
    assert runtime.literal("Drive.nAxisState") == "standstill"
    assert runtime.literal("IoConfig_AxisPanels.Drive.eError") == "SMC_NO_ERROR"


def test_an_axis_that_is_not_there_or_not_moved_is_refused(runtime: LocalRuntime) -> None:
    with pytest.raises(OperationError, match="has no axis 'Other'"):
        SteerAxis("Other", ME, "take").run(runtime.plc)
    runtime.stop()
    with pytest.raises(PlcError, match="does not run"):
        steer(runtime, "take")
