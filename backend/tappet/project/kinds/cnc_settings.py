"""The CNC settings of an application: what all its CNC programs share (CNC-03, CNCS-01)."""

from __future__ import annotations

from tappet.project.cnc.settings import CncSettingsData
from tappet.project.object_kind import JsonFile, Merging, Naming, ObjectKind, Placement

CNC_SETTINGS = ObjectKind(
    name="cnc_settings",
    words="CNC settings",
    description="What all CNC programs of an application share.",
    data=CncSettingsData,
    placement=Placement(parents=("application",), in_folders=False, once=True),
    naming=Naming(style="fixed", names=("CNC settings",)),
    order=159,
    folder=JsonFile(optional=True),
    merging=Merging(),
)
