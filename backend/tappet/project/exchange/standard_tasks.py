"""Tasks as texts give them: CONFIGURATION of the standard, and the like of CoDeSys 2.3."""

from __future__ import annotations

import re
from typing import Any

from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError
from tappet.project.exchange.drafts import Draft, task_configuration
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.split_text import SplitText, split_text

MAX_PRIORITY = 31
_TASK = re.compile(r"\bTASK\s+(?P<name>\w+)\s*\((?P<settings>[^()]*)\)\s*;", re.IGNORECASE)
_PROGRAM = re.compile(
    r"\bPROGRAM\s+(?P<instance>\w+)(?:\s+WITH\s+(?P<task>\w+))?\s*:\s*(?P<type>\w+)", re.IGNORECASE
)
_SETTING = re.compile(r"(\w+)\s*:=\s*([^,]+)")
_GLOBALS = re.compile(r"\bVAR_GLOBAL\b.*?\bEND_VAR\b", re.IGNORECASE | re.DOTALL)


def read_configurations(split: SplitText, application: Draft, report: ImportReport) -> None:
    """The tasks and global variables of the CONFIGURATIONs of a text."""
    for start, stop in split.configurations:
        text = split.text[start:stop]
        for block in _GLOBALS.finditer(text):
            inner = split_text(split.source, block.group(), report, list_name="Config_Globals")
            for draft in inner.drafts():
                draft.line = split.line(start + block.start())
                application.children.append(draft)
        plain = re.sub(r"\(\*.*?\*\)", lambda match: " " * len(match.group()), text, flags=re.DOTALL)
        programs = [
            (match["task"], match["type"], match["instance"], split.line(start + match.start()))
            for match in _PROGRAM.finditer(plain)
        ]
        for task in _TASK.finditer(plain):
            calls = [kind for name, kind, _, _ in programs if name and name.upper() == task["name"].upper()]
            line = split.line(start + task.start())
            draft = task_draft(split.source, line, task["name"], task["settings"], calls, report)
            task_configuration(application).children.append(draft)
        for name, kind, instance, line in programs:
            if name is None:
                task_configuration(application).children.append(
                    background_task(split.source, line, instance, kind, report)
                )


def background_task(source: str, line: int | None, instance: str, kind: str, report: ImportReport) -> Draft:
    """The task of a program that a file instantiates without one."""
    text = f"program '{kind}' has no task; it is called by a freewheeling task of the lowest priority"
    report.add("changed", source, text, name=instance, line=line)
    data = {"type": "freewheeling", "priority": MAX_PRIORITY, "pous": [{"name": kind}]}
    return Draft("task", instance, data, source, line)


def task_draft(
    source: str, line: int | None, name: str, settings: str, calls: list[str], report: ImportReport
) -> Draft:
    """A task with the settings `INTERVAL := T#10ms, PRIORITY := 1, SINGLE := bStart`."""
    values = {key.upper(): value.strip() for key, value in _SETTING.findall(settings)}
    data: dict[str, Any] = {"pous": _calls(source, line, name, calls, report)}
    data["priority"] = priority(source, line, name, values.get("PRIORITY", "1"), report)
    interval = values.get("INTERVAL", "")
    event = values.get("SINGLE", "") or values.get("EVENT", "")
    if event and not interval:
        data |= {"type": "event", "event": event}
    elif interval:
        data |= {"type": "cyclic", "interval": cycle(source, line, name, interval, report)}
    else:
        data["type"] = "freewheeling"
    return Draft("task", name, data, source, line)


def _calls(
    source: str, line: int | None, name: str, calls: list[str], report: ImportReport
) -> list[dict[str, str]]:
    if len({call.upper() for call in calls}) != len(calls):
        text = (
            "several instances of one program in the task became several calls of the one that there is here"
        )
        report.add("changed", source, text, name=name, line=line)
    return [{"name": call} for call in calls]


def priority(source: str, line: int | None, name: str, text: str, report: ImportReport) -> int:
    """A priority that is possible here."""
    try:
        value = int(text or "1")
    except ValueError:
        value = 1
    fit = min(max(value, 0), MAX_PRIORITY)
    if str(fit) != (text.strip() or "1"):
        report.add("changed", source, f"priority '{text}' became {fit}", name=name, line=line)
    return fit


def cycle(source: str, line: int | None, name: str, text: str, report: ImportReport) -> str:
    """An interval as a TIME literal or a number of microseconds; T#20ms where it cannot be read."""
    try:
        if duration_ns(text) > 0:
            return text
    except InvalidTimeError:
        pass
    report.add(
        "changed", source, f"the interval '{text}' cannot be read; it became T#20ms", name=name, line=line
    )
    return "T#20ms"
