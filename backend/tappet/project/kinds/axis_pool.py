"""The SoftMotion General Axis Pool: holds the axes of an application that hang on no fieldbus (AXIS-01)."""

from __future__ import annotations

from pydantic import Field

from tappet.project.axes.cyclic_calls import around_tasks
from tappet.project.axes.drives import LIBRARY
from tappet.project.axes.settings import AxisSettings
from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND, VARIABLES, declaration
from tappet.project.data import CodeData, Line
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.object_kind import Compiled, Merging, Naming, ObjectKind, Placement, Renaming
from tappet.project.source_text import SourceWriter


class AxisPoolData(CodeData):
    """What axes of the pool have in common."""

    bus_task: Line = Field(
        default="", description="Task that moves the axes; empty: the fastest cyclic one (PLC-05)."
    )


def _source(project: Project, pool: ProjectObject, writer: SourceWriter) -> None:
    axes = [item for item in project.children(pool.id) if isinstance(item.data, AxisSettings)]
    axes = [item for item in axes if not item.excluded]
    if not axes:
        return
    writer.name = VARIABLES
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\nVAR_GLOBAL")
    for axis in axes:
        writer.part(axis.id, "declaration", declaration(axis.name, axis.data_as(AxisSettings)))
    writer.keyword("END_VAR")


def _bus_task_renamed(data: AxisPoolData, renaming: Renaming) -> AxisPoolData:
    if renaming.kind != "task" or name_key(renaming.old) != name_key(data.bus_task):
        return data
    return data.model_copy(update={"bus_task": renaming.new})


AXIS_POOL = ObjectKind(
    name="axis_pool",
    words="axis pool",
    description="Holds the axes of an application that hang on no fieldbus.",
    data=AxisPoolData,
    placement=Placement(parents=("application",), in_folders=False, once=True),
    naming=Naming(style="fixed", names=("SoftMotion General Axis Pool",)),
    order=155,
    compiled=Compiled(
        source=_source,
        around_tasks=around_tasks,
        libraries=lambda data, path: [LibraryReference(name=LIBRARY, place=path)],
    ),
    follow=_bus_task_renamed,
    merging=Merging(),
)
