"""A cam: global variables of its name, of the type MC_CAM_REF (CAM-10, CAM-90)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.cams.checks import findings
from tappet.project.cams.code import LIST_VARIABLES, VARIABLES, cam_list, declarations
from tappet.project.cams.table import CamTable
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import CODE_PLACES, Compiled, JsonFile, Naming, ObjectKind, Placement
from tappet.project.source_text import SourceWriter


def _source(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    """The variables of a cam, and a function that holds what is wrong with it."""
    cam = item.data_as(CamTable)
    writer.name = VARIABLES.format(name=item.name)
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\nVAR_GLOBAL")
    writer.part(item.id, "declaration", declarations(item.name, cam))
    writer.keyword("END_VAR")
    found = findings(cam)
    if found:
        writer.keyword(f"{{attribute 'hide'}}\nFUNCTION SM3_{item.name}_Findings : BOOL")
        for one in found:
            writer.element(item.id, str(one.x), f"{{{one.severity} cam '{item.name}: {one.text}'}}")
        writer.keyword(f"SM3_{item.name}_Findings := TRUE;\nEND_FUNCTION")


def _list(project: Project, cams: Sequence[ProjectObject], writer: SourceWriter) -> None:
    """Pointers to all cams."""
    writer.name = LIST_VARIABLES
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\nVAR_GLOBAL")
    writer.part(cams[0].id, "declaration", cam_list([item.name for item in cams]))
    writer.keyword("END_VAR")


CAM = ObjectKind(
    name="cam",
    words="cam table",
    description="A cam: how a slave axis depends on a master; it is a global variable of its name.",
    data=CamTable,
    placement=Placement(parents=CODE_PLACES),
    naming=Naming(proposal="Cam"),
    order=157,
    compiled=Compiled(
        source=_source,
        together=_list,
        variable_in=(VARIABLES,),
        variable_endings=("", "_A", "_T"),
    ),
    folder=JsonFile(flat=True),
    reported=True,
)
