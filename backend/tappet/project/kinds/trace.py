"""A trace: variables that the runtime samples in step with a task (TRC-01)."""

from __future__ import annotations

import re

from tappet.project.naming import name_key
from tappet.project.object_kind import JsonFile, Naming, ObjectKind, Placement, Renaming
from tappet.project.trace import TraceChannel, TraceData, TraceRecord

_WORD = re.compile(r"(?<![\w.])[^\W\d]\w*")
_TEXTS = ("pou", "gvl", "persistent", "axis", "cam")


def _renamed(data: TraceData, renaming: Renaming) -> TraceData:
    """Tasks, and programs, lists and axes at the begin of paths, follow their names."""
    old = name_key(renaming.old)

    def text(given: str) -> str:
        if renaming.kind not in _TEXTS:
            return given
        return _WORD.sub(lambda m: renaming.new if name_key(m[0]) == old else m[0], given)

    def channel(given: TraceChannel) -> TraceChannel:
        return given.model_copy(update={"variable": text(given.variable)})

    def record(given: TraceRecord) -> TraceRecord:
        is_task = renaming.kind == "task" and name_key(given.task) == old
        trigger = given.trigger
        fields = {"variable": text(trigger.variable), "level": text(trigger.level)}
        return given.model_copy(
            update={
                "task": renaming.new if is_task else given.task,
                "condition": text(given.condition),
                "trigger": trigger.model_copy(update=fields),
                "channels": tuple(channel(one) for one in given.channels),
            }
        )

    return data.model_copy(update={"records": tuple(record(one) for one in data.records)})


TRACE = ObjectKind(
    name="trace",
    words="trace",
    description="A trace: variables that the runtime samples in step with a task, as curves over time.",
    data=TraceData,
    placement=Placement(parents=("application",)),
    naming=Naming(proposal="Trace"),
    order=165,
    follow=_renamed,
    folder=JsonFile(),
    reported=True,
)
