"""System events of a loaded application: functions that are called then, and external tasks that are started.

Contract: the build exports `SystemEvent_<name>` for each event with a function (`project.task_events`). It
runs guarded, like an initialiser, on a thread of its own; a fault in it is an exception of the application.
"""

from __future__ import annotations

from tappet.iec.system_events import EXPORT_PREFIX
from tappet.runtime.application import LoadedApplication
from tappet.runtime.contexts import FAULTED
from tappet.runtime.faults import describe
from tappet.runtime.logbook import Logbook


def happened(application: LoadedApplication, event: str, log: Logbook) -> bool:
    """Call the function of an event and start the external tasks that wait for it; False when the application
    is in the state exception because of it."""
    for spec, task in zip(application.package.tasks, application.contexts.tasks, strict=True):
        if spec.kind == "external" and spec.event == event:
            task["raised"] = task["raised"] + 1
    symbol = f"{EXPORT_PREFIX}{event}"
    if symbol not in application.package.exports:
        return True
    already = application.tasks.state == FAULTED
    fault = application.call_beside(f"system event {event}", application.code[symbol])
    if fault is None:
        return True
    if already:  # what is told is the first exception
        text = f"the function of system event {event} ended in an exception: {describe(fault)[0]}"
        log.add("error", "application", text)
        return True
    application.mark_faulted()
    return False
