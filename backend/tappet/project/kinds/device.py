"""A device of the Devices view (CON-01)."""

from __future__ import annotations

from pydantic import Field, StrictBool

from tappet.project.data import Data, Line, Text
from tappet.project.object_kind import DEVICES_VIEW, Child, Codesys, Naming, ObjectKind, Placement, Plcopen


class DeviceData(Data):
    """A device of the Devices view (CON-01)."""

    device_type: Line = Field(
        default="tappet.softplc", description="Device description that this device follows."
    )
    runtime_id: Line | None = Field(
        default=None, description="Runtime that the active path leads to (COM-10)."
    )
    simulated: StrictBool = Field(
        default=False, description="Run in the simulation instead of the runtime (ONL-08)."
    )
    description: Text = ""


DEVICE = ObjectKind(
    name="device",
    words="device",
    description="A device of the Devices view.",
    data=DeviceData,
    placement=Placement(parents=(DEVICES_VIEW,)),
    naming=Naming(style="free", proposal="Device", unique="place"),
    order=20,
    children=(Child("plc_logic", "PLC Logic"),),
    plcopen=Plcopen(),
    codesys=Codesys(type_ids=("225bfe4773364dbc94194105a7c831fa",)),
)
