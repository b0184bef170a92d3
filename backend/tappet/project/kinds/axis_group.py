"""An axis group: axes that move together along paths; it is a global variable of its name (AG-01)."""

from __future__ import annotations

from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.axis_groups import kinematics
from tappet.project.axis_groups.kinematics import KIN_ENDING
from tappet.project.axis_groups.preparation import PANEL, around_tasks
from tappet.project.axis_groups.settings import AxisGroupSettings
from tappet.project.axis_groups.variables import LIBRARY, VARIABLES, declaration
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.object_kind import Compiled, Naming, ObjectKind, Placement, Renaming
from tappet.project.source_text import SourceWriter


def _source(project: Project, group: ProjectObject, writer: SourceWriter) -> None:
    writer.name = VARIABLES.format(name=group.name)
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\nVAR_GLOBAL")
    writer.part(group.id, "declaration", declaration(group.name, group.data_as(AxisGroupSettings)))
    writer.keyword("END_VAR")


def _renamed(data: AxisGroupSettings, renaming: Renaming) -> AxisGroupSettings:
    """Axes follow their names."""
    if renaming.kind != "axis":
        return data
    old = name_key(renaming.old)
    axes = [renaming.new if name_key(axis) == old else axis for axis in data.axes]
    return data if axes == data.axes else data.model_copy(update={"axes": axes})


def _libraries(data: AxisGroupSettings, path: str) -> list[LibraryReference]:
    names = [LIBRARY, kinematics.LIBRARY] if data.kinematics.type else [LIBRARY]
    return [LibraryReference(name=name, place=path) for name in names]


AXIS_GROUP = ObjectKind(
    name="axis_group",
    words="axis group",
    description="Axes that move together along paths; it is a global variable of its name.",
    data=AxisGroupSettings,
    placement=Placement(parents=("application",)),
    naming=Naming(proposal="AxisGroup"),
    order=157,
    compiled=Compiled(
        source=_source,
        around_tasks=around_tasks,
        variable_in=(VARIABLES, PANEL),
        variable_endings=("", KIN_ENDING),
        libraries=_libraries,
    ),
    follow=_renamed,
    reported=True,
)
