"""The task configuration: holds the tasks of an application (TASK-01)."""

from __future__ import annotations

from tappet.project.data import NoData
from tappet.project.object_kind import Codesys, JsonFile, Merging, Naming, ObjectKind, Placement

TASK_CONFIGURATION = ObjectKind(
    name="task_configuration",
    words="task configuration",
    description="Holds the tasks of an application.",
    data=NoData,
    placement=Placement(parents=("application",), in_folders=False, once=True),
    naming=Naming(style="fixed", names=("Task Configuration",)),
    order=140,
    folder=JsonFile(optional=True),
    merging=Merging(),
    codesys=Codesys(type_ids=("ae1de277a2074a289efb456c06bd52f3",)),
)
