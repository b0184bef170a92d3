"""The panel of an axis: somebody moves it by hand, as long as his page says again and again that he is there.

The build gives each axis of the project an `AxisPanel` of `SM3_Basic` in the list `IoConfig_AxisPanels`
(`project.axes.cyclic_calls`). These operations write its inputs; what it does is written in ST, the dead-man
watchdog among it: a page that is closed or cut off ends in a controlled stop although nobody asks for one.
Who has control is told by a number that his page makes up; requests with another one are refused.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from msgspec import Meta, Struct

from tappet.runtime.operations.declaration import Fact, Operation, OperationError, Rest
from tappet.runtime.panel_inputs import COUNTERS, PanelInputs

if TYPE_CHECKING:
    from tappet.codegen.values import Value
    from tappet.runtime.plc import SoftPlc

PANELS = "IoConfig_AxisPanels"
LONGEST_ANSWER_S = 10.0
"""Of a measurement: LONGEST of StepMeasurement."""
_COMMANDS = {
    "move_absolute": "MoveAbsolute",
    "move_relative": "MoveRelative",
    "set_position": "SetPosition",
    "home": "Home",
    "reset": "Reset",
    "measure_step": "MeasureStep",
    "measure_move": "MeasureMove",
}
_JOGS = {"jog_forward": (True, False), "jog_backward": (False, True), "jog_end": (False, False)}

AxisName = Annotated[str, Meta(min_length=1, max_length=200, description="Name of the axis.")]
Holder = Annotated[int, Meta(ge=1, lt=COUNTERS, description="Number that the page has made up.")]
Finite = Annotated[float, Meta(ge=-1e300, le=1e300)]
Positive = Annotated[float, Meta(gt=0, le=1e300)]
Action = Literal[
    "take", "force", "power_on", "power_off", "jog_forward", "jog_backward", "jog_end", "move_absolute",
    "move_relative", "set_position", "home", "reset", "measure_step", "measure_move",
]  # fmt: skip


class PanelStatus(Struct, frozen=True):
    """Who moves the axis."""

    state: str
    """Free, Taking, Control or Leaving."""
    holder: int
    """Whose control it is, or was."""


class SteerAxis(Operation[PanelStatus], frozen=True):
    """Take control of an axis (`force`: also while a command of the program moves it), or move it."""

    op: ClassVar[str] = "steer_axis"
    rest: ClassVar[Rest | None] = Rest(
        "POST",
        "/axes/{axis}/panel",
        "operator",
        lambda steer: Fact("axis-panel", steer.axis, f"{steer.action} {steer.position}"),
        tag="values",
    )
    axis: AxisName
    holder: Holder
    action: Action
    position: Finite = 0.0
    """Target, distance of a relative move, or height of what is measured."""
    velocity: Positive = 10.0
    acceleration: Positive = 100.0
    deceleration: Positive = 100.0
    jerk: Positive = 10_000.0
    duration: Annotated[float, Meta(gt=0, le=LONGEST_ANSWER_S)] = 1.0
    """Seconds until the axis moves back from what is measured."""

    def run(self, plc: SoftPlc) -> PanelStatus:
        """What is wrong with a command, the panel says at eError."""
        panel = Panel(plc, self.axis)
        if self.action in ("take", "force"):
            panel.take(self.holder, forced=self.action == "force")
            return panel.status()
        panel.check(self.holder)
        if self.action in ("power_on", "power_off"):
            panel.write(xPower=self.action == "power_on")
            return panel.status()
        motion = {
            "fPosition": self.position,
            "fVelocity": self.velocity,
            "fAcceleration": self.acceleration,
            "fDeceleration": self.deceleration,
            "fJerk": self.jerk,
            "fDuration": self.duration,
        }
        if self.action in _JOGS:
            forward, backward = _JOGS[self.action]
            panel.write(**motion, xForward=forward, xBackward=backward)
        else:
            panel.command(_COMMANDS[self.action], **motion)
        return panel.status()


class StopAxis(Operation[PanelStatus], frozen=True):
    """Stop an axis that one controls; with `release` the program has it again then."""

    op: ClassVar[str] = "stop_axis"
    rest: ClassVar[Rest | None] = Rest(
        "POST",
        "/axes/{axis}/panel/stop",
        "operator",
        lambda stop: Fact("axis-panel", stop.axis, "release" if stop.release else "stop"),
        tag="values",
        always=True,
    )
    axis: AxisName
    holder: Holder
    release: bool = False

    def run(self, plc: SoftPlc) -> PanelStatus:
        """By the deceleration of its dynamic limits."""
        panel = Panel(plc, self.axis)
        panel.check(self.holder)
        if self.release:
            panel.write(xWanted=False)
        else:
            panel.command("Stop", xForward=False, xBackward=False)
        return panel.status()


class KeepAxis(Operation[PanelStatus], frozen=True):
    """Say that one is there, at least once a second as long as one wants control."""

    op: ClassVar[str] = "keep_axis"
    rest: ClassVar[Rest | None] = Rest("POST", "/axes/{axis}/panel/alive", "operator", None, tag="values")
    axis: AxisName
    holder: Holder

    def run(self, plc: SoftPlc) -> PanelStatus:
        """Control that was lost meanwhile is said, not taken again."""
        panel = Panel(plc, self.axis)
        status = panel.status()
        if status.holder == self.holder and status.state != "Free":
            panel.write(udiAlive=panel.next("udiAlive"))
        return status


class Panel(PanelInputs):
    """The panel of one axis of the application that runs."""

    def __init__(self, plc: SoftPlc, axis: str) -> None:
        missing = f"the application that runs has no axis '{axis}'; download it with the axis"
        super().__init__(plc, f"{PANELS}.{axis}", missing)
        self._axis = axis

    def take(self, holder: int, *, forced: bool) -> None:
        """Ask for control. OperationError when somebody else has it."""
        status = self.status()
        if status.state != "Free":
            self.check(holder)
        self.write(
            udiHolder=holder,
            xWanted=True,
            xForced=forced,
            udiAlive=self.next("udiAlive"),
            xForward=False,
            xBackward=False,
            xUsed=True,
        )

    def check(self, holder: int) -> None:
        """OperationError unless this page has control, or is getting it."""
        status = self.status()
        if status.state == "Free":
            raise OperationError("no_control", f"nobody controls the axis '{self._axis}'; take control of it")
        if status.holder != holder:
            raise OperationError("no_control", f"another page controls the axis '{self._axis}'")

    def command(self, name: str, **inputs: Value) -> None:
        """Begin a command of the panel. OperationError while it measures, unless it is to stop."""
        if name != "Stop" and self.literal("ePhase") != "Idle":
            text = f"the axis '{self._axis}' is being measured; wait for the end, or stop it"
            raise OperationError("measuring", text)
        self.write(**inputs, eCommand=name, udiCommand=self.next("udiCommand"))

    def status(self) -> PanelStatus:
        """Who moves the axis."""
        return PanelStatus(self.literal("eState"), int(self.literal("udiHolder")))
