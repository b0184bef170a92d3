"""An axis of the SoftMotion General Axis Pool (AXIS-01, AXIS-04)."""

from __future__ import annotations

from tappet.project.axes.cyclic_calls import PANELS
from tappet.project.axes.drives import DRIVE_ENDING
from tappet.project.axes.settings import AxisSettings
from tappet.project.axes.variables import VARIABLES
from tappet.project.naming import name_key
from tappet.project.object_kind import Compiled, Naming, ObjectKind, Placement, Renaming


def _renamed(data: AxisSettings, renaming: Renaming) -> AxisSettings:
    """The bus task and the master follow their names."""
    if renaming.kind == "task" and name_key(renaming.old) == name_key(data.bus_task):
        return data.model_copy(update={"bus_task": renaming.new})
    if renaming.kind == "axis" and name_key(renaming.old) == name_key(data.mirroring.master):
        mirroring = data.mirroring.model_copy(update={"master": renaming.new})
        return data.model_copy(update={"mirroring": mirroring})
    return data


AXIS = ObjectKind(
    name="axis",
    words="axis",
    description="An axis; it is a global variable of its name.",
    data=AxisSettings,
    placement=Placement(parents=("axis_pool",), in_folders=False),
    naming=Naming(proposal="Axis"),
    order=156,
    templates={
        "SM_Drive_Virtual": lambda name: AxisSettings(),
        "SM_Drive_Simulated": lambda name: AxisSettings(drive="SM_Drive_Simulated"),
        "SM_Drive_GenericDSP402": lambda name: AxisSettings(drive="SM_Drive_GenericDSP402"),
        "SM_Drive_PosControl": lambda name: AxisSettings(drive="SM_Drive_PosControl"),
        "SM_Drive_Logical": lambda name: AxisSettings(drive="SM_Drive_Logical"),
    },
    compiled=Compiled(in_parent=True, variable_in=(VARIABLES, PANELS), variable_endings=("", DRIVE_ENDING)),
    follow=_renamed,
    reported=True,
)
