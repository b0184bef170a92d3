"""PLCopen XML: tasks and the programs they call, with CODESYS's task settings."""

from __future__ import annotations

import re
from typing import Any

from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.plcopen_declarations import added, documentation, iso_interval
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.standard_tasks import background_task, cycle, priority
from tappet.project.exchange.xml_tree import Element

KINDS = {
    "cyclic": "cyclic",
    "freewheeling": "freewheeling",
    "event": "event",
    "status": "status",
    "external": "external",
    "externalevent": "external",
}
"""Kinds of tasks by the names that CODESYS gives them."""


def read_task(source: str, item: Element, report: ImportReport) -> Draft:
    """A `task` element."""
    name = item.get("name") or "Task"
    settings = next((part for kind, part in added(item) if kind == "tasksettings"), None)
    data: dict[str, Any] = {
        "priority": priority(source, item.line, name, item.get("priority"), report),
        "pous": [_call(part) for part in item.children("pouInstance")],
    }
    kind = settings.get("KindOfTask").lower() if settings is not None else ""
    event = item.get("single") or (settings.get("Event") if settings is not None else "")
    interval = (settings.get("Interval") if settings is not None else "") or item.get("interval")
    data["type"] = KINDS.get(kind) or (
        "event" if event and not interval else "cyclic" if interval else "freewheeling"
    )
    if kind and kind not in KINDS:
        text = f"the kind of task '{kind}' became '{data['type']}'"
        report.add("changed", source, text, name=name, line=item.line)
    if data["type"] == "cyclic":
        data["interval"] = cycle(
            source, item.line, name, _with_unit(iso_interval(interval), settings), report
        )
    elif event:
        data["event"] = event
    watchdog = settings.child("Watchdog") if settings is not None else None
    if watchdog is not None:
        data["watchdog"] = _watchdog(source, watchdog, name, report)
    return Draft("task", name, data, source, item.line)


def task_of_instance(source: str, item: Element, report: ImportReport) -> Draft:
    """A program that stands outside of all tasks."""
    kind = item.get("typeName") or item.get("name")
    return background_task(source, item.line, item.get("name") or kind, kind, report)


def _call(item: Element) -> dict[str, str]:
    comment = " ".join(documentation(item).split())[:4000]
    return {"name": item.get("typeName") or item.get("name"), "comment": comment}


def _with_unit(text: str, settings: Element | None) -> str:
    """A bare number is in the unit that stands beside it; without one it is in microseconds."""
    unit = settings.get("IntervalUnit") if settings is not None else ""
    if (
        re.fullmatch(r"\d+", text)
        and unit in ("ms", "s", "ns", "us")
        and settings is not None
        and settings.get("Interval")
    ):
        return f"T#{text}{unit}"
    return text


def _watchdog(source: str, item: Element, name: str, report: ImportReport) -> dict[str, Any]:
    data: dict[str, Any] = {"enabled": item.get("Enabled").lower() in ("true", "1")}
    time = item.get("Time")
    if re.fullmatch(r"\d+", time):
        time = f"T#{time}{item.get('TimeUnit') or 'us'}"
    try:
        if time and duration_ns(time) > 0:
            data["time"] = time
    except InvalidTimeError:
        report.add("changed", source, f"the watchdog time '{time}' cannot be read", name=name, line=item.line)
    sensitivity = item.get("Sensitivity")
    if re.fullmatch(r"\d{1,6}", sensitivity):
        data["sensitivity"] = int(sensitivity)
    return data
