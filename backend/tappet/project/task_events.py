"""The calls of the functions that are coupled to system events (TASK-05).

Each event has an exported function that counts the call and makes it; the runtime calls it where the event
happens. What happens in each cycle are programs around those of the bus cycle task, the cyclic one with the
shortest interval.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from tappet.iec.system_events import EVENT_LIST, EXPORT_PREFIX, IN_CYCLE, counter_of
from tappet.iec.task import Task
from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.model import ProjectObject
from tappet.project.source_text import SourceWriter

_HEADS = {
    False: "{{attribute 'hide'}}\n{{attribute 'tappet_export' := '{name}'}}\nFUNCTION {name} : BOOL",
    True: "{{attribute 'hide'}}\nPROGRAM {name}",
}


def events_around(
    item: ProjectObject, calls: Mapping[str, str], tasks: Sequence[Task], writer: SourceWriter
) -> list[Task]:
    """The tasks with the calls of events in their cycle; writes the text. `calls`: function by event."""
    if not calls:
        return list(tasks)
    writer.name = EVENT_LIST
    writer.keyword(NOT_WRITTEN_BY_HAND)
    counters = "\n".join(f"    {counter_of(event).partition('.')[2]} : UDINT;" for event in calls)
    writer.keyword(f"{{attribute 'qualified_only'}}\nVAR_GLOBAL\n{counters}\nEND_VAR")
    for event, function in calls.items():
        name, in_cycle = f"{EXPORT_PREFIX}{event}", event in IN_CYCLE
        writer.keyword(_HEADS[in_cycle].format(name=name))
        writer.keyword(f"{counter_of(event)} := {counter_of(event)} + 1;")
        writer.element(item.id, event, f"{function}();")
        writer.keyword("END_PROGRAM" if in_cycle else f"{name} := TRUE;\nEND_FUNCTION")
    bus = _bus_task(tasks)
    first, last = (tuple(f"{EXPORT_PREFIX}{event}" for event in (one,) if one in calls) for one in IN_CYCLE)
    return [
        replace(task, programs=(*first, *task.programs, *last)) if task is bus else task for task in tasks
    ]


def _bus_task(tasks: Sequence[Task]) -> Task | None:
    """The task that moves the inputs and outputs (PLC-05)."""
    cyclic = [task for task in tasks if task.kind == "cyclic"]
    return min(cyclic, key=lambda task: (task.interval_ns, task.priority), default=None)
