"""System events: what happens to an application, and functions or tasks can be coupled to (TASK-05, TASK-16).

The names are those of the field. A function is called where the event happens; an external task is started.
"""

from __future__ import annotations

from typing import Literal, get_args

SystemEventName = Literal[
    "PrepareStart",
    "StartDone",
    "PrepareStop",
    "StopDone",
    "PrepareReset",
    "ResetDone",
    "PrepareOnlineChange",
    "OnlineChangeDone",
    "PrepareDownload",
    "DownloadDone",
    "PrepareExit",
    "Exception",
    "AfterReadingInputs",
    "BeforeWritingOutputs",
]
SYSTEM_EVENTS: tuple[SystemEventName, ...] = get_args(SystemEventName)
IN_CYCLE: tuple[SystemEventName, SystemEventName] = ("AfterReadingInputs", "BeforeWritingOutputs")
"""In the bus cycle task, around its programs; all others are called beside the tasks."""

ExternalEventName = Literal["StartDone", "OnlineChangeDone", "SIGUSR1", "SIGUSR2"]
EXTERNAL_EVENTS: tuple[ExternalEventName, ...] = get_args(ExternalEventName)
"""What an external task can wait for: an application that runs from now on, or with other code; a signal that
another program sends to the process of the runtime."""

EVENT_LIST = "IoConfig_SystemEvents"
"""List of global variables that counts the calls of each event."""
EXPORT_PREFIX = "SystemEvent_"


def counter_of(event: str) -> str:
    """Path of the variable that counts the calls of an event."""
    return f"{EVENT_LIST}.udi{event}"


def external_event(name: str) -> ExternalEventName | None:
    """The external event of this name; case does not count. None where the target has none."""
    return next((event for event in EXTERNAL_EVENTS if event.upper() == name.strip().upper()), None)
