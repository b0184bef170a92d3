"""The panel of an axis group: enables, disables, resets and stops it (AG-10, AG-11, AG-16, AG-23).

The build gives each axis group of the project an `AxisGroupPanel` of `SM3_AxisGroup` (`project.axis_groups`).
It does what the blocks of these names do, with their refusals, and takes nothing from the program.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from msgspec import Meta, Struct

from tappet.runtime.operations.declaration import Fact, Operation, Rest
from tappet.runtime.panel_inputs import PanelInputs

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

_PANEL = "IoConfig_GroupPanel_{name}.{name}"
_COMMANDS = {"enable": "Enable", "disable": "Disable", "reset": "Reset", "stop": "Stop"}

GroupName = Annotated[str, Meta(min_length=1, max_length=200, description="Name of the axis group.")]
GroupAction = Literal["enable", "disable", "reset", "stop"]


class GroupPanelStatus(Struct, frozen=True):
    """The command that was given."""

    command: int
    """Its number; the panel says at xBusy and eError what becomes of it."""


class SteerAxisGroup(Operation[GroupPanelStatus], frozen=True):
    """Enable, disable, reset or stop an axis group."""

    op: ClassVar[str] = "steer_axis_group"
    rest: ClassVar[Rest | None] = Rest(
        "POST",
        "/axis_groups/{group}/panel",
        "operator",
        lambda steer: Fact("axis-group-panel", steer.group, steer.action),
        tag="values",
    )
    group: GroupName
    action: GroupAction

    def run(self, plc: SoftPlc) -> GroupPanelStatus:
        """What is wrong with a command, the panel says at eError."""
        group = self.group
        missing = f"the application that runs has no axis group '{group}'; download it with the group"
        panel = PanelInputs(plc, _PANEL.format(name=group), missing)
        number = panel.next("udiCommand")
        panel.write(eCommand=_COMMANDS[self.action], udiCommand=number, xUsed=True)
        return GroupPanelStatus(number)
