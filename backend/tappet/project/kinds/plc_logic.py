"""The PLC logic: the node below a programmable device that holds its applications."""

from __future__ import annotations

from tappet.project.data import NoData
from tappet.project.object_kind import Child, Codesys, JsonFile, Merging, Naming, ObjectKind, Placement

PLC_LOGIC = ObjectKind(
    name="plc_logic",
    words="plc logic",
    description="The node below a programmable device that holds its applications.",
    data=NoData,
    placement=Placement(parents=("device",), once=True),
    naming=Naming(style="fixed", names=("PLC Logic",)),
    order=30,
    children=(Child("application", "Application"),),
    folder=JsonFile(optional=True),
    merging=Merging(),
    codesys=Codesys(type_ids=("40b404f9e5dc42c6907fc89f4a517386",)),
)
