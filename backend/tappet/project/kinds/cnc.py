"""A CNC program: a path for several axes, as DIN 66025 text (CNC-01, CNC-02)."""

from __future__ import annotations

from tappet.project.cnc.program import CncProgramData, new_program
from tappet.project.object_kind import JsonFile, Naming, ObjectKind, Placement

CNC = ObjectKind(
    name="cnc",
    words="CNC program",
    description="A CNC program: a path for several axes, as DIN 66025 text or table.",
    data=CncProgramData,
    placement=Placement(parents=("application",)),
    naming=Naming(proposal="CNC"),
    order=158,
    new=new_program,
    companion="cnc_settings",
    folder=JsonFile(optional=True, texts={"implementation": "cnc"}),
    reported=True,
)
