"""Tasks as texts give them: CONFIGURATION of the standard, and the like of CoDeSys 2.3."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from tappet.iec.task import SOFT_PLC
from tappet.iec.tokens import NAME, Word, words
from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError
from tappet.project.exchange.drafts import Draft, task_configuration
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.split_text import SplitText, split_text


@dataclass(frozen=True, slots=True)
class TaskText:
    """`TASK name (settings)` in a text."""

    name: str
    settings: Mapping[str, str]
    """Values as written, by upper-case name: INTERVAL, PRIORITY, SINGLE, EVENT."""
    start: int
    """Offset of TASK."""
    behind: tuple[Word, ...]
    """The words up to the next task, or to what ends the task."""


def read_tasks(text: str) -> Iterator[TaskText]:
    """The tasks of a text in the form of IEC 61131-3 and of CoDeSys 2.3."""
    scan = list(words(text))
    heads = [i for i in range(len(scan) - 2) if scan[i].text == "TASK" and scan[i + 2].text == "("]
    for i, following in pairwise([*heads, len(scan)]):
        name = scan[i + 1]
        if not NAME.fullmatch(name.text):
            continue
        settings, end = _settings(text, scan, i + 3)
        if end >= following:
            continue  # nothing closes its parenthesis
        ends = (k for k in range(end, following) if scan[k].text in ("END_TASK", "END_RESOURCE"))
        behind = tuple(scan[end : next(ends, following)])
        yield TaskText(text[name.start : name.end], settings, scan[i].start, behind)


def _settings(text: str, scan: Sequence[Word], i: int) -> tuple[dict[str, str], int]:
    """`name := value, ...` from word `i` on, and the number of the word behind the parenthesis."""
    settings: dict[str, str] = {}
    depth = 1
    start = i
    while i < len(scan) and depth:
        depth += (scan[i].text in "([") - (scan[i].text in ")]")
        if depth == 0 or (depth == 1 and scan[i].text == ","):
            if i > start + 2 and scan[start + 1].text == ":=":
                settings[scan[start].text] = text[scan[start + 2].start : scan[i - 1].end]
            start = i + 1
        i += 1
    return settings, i if not depth else len(scan) + 1


def read_configurations(split: SplitText, application: Draft, report: ImportReport) -> None:
    """The tasks and global variables of the CONFIGURATIONs of a text."""
    for start, stop in split.configurations:
        text = split.text[start:stop]
        for begin, end in _global_lists(text):
            inner = split_text(split.source, text[begin:end], report, list_name="Config_Globals")
            for draft in inner.drafts():
                draft.line = split.line(start + begin)
                application.children.append(draft)
        programs = list(_programs(text))
        for task in read_tasks(text):
            calls = [program.type for program in programs if program.task.upper() == task.name.upper()]
            line = split.line(start + task.start)
            draft = task_draft(split.source, line, task.name, task.settings, calls, report)
            task_configuration(application).children.append(draft)
        for program in programs:
            if not program.task:
                line = split.line(start + program.start)
                draft = background_task(split.source, line, program.instance, program.type, report)
                task_configuration(application).children.append(draft)


def _global_lists(text: str) -> Iterator[tuple[int, int]]:
    """Where the lists of global variables begin and end."""
    begin: int | None = None
    for word in words(text):
        if word.text == "VAR_GLOBAL" and begin is None:
            begin = word.start
        elif word.text == "END_VAR" and begin is not None:
            yield begin, word.end
            begin = None


@dataclass(frozen=True, slots=True)
class _Program:
    """`PROGRAM instance WITH task : type`."""

    instance: str
    task: str
    """Empty where the program has none."""
    type: str
    start: int


def _programs(text: str) -> Iterator[_Program]:
    scan = list(words(text))
    shapes = ("PROGRAM", "", ":", ""), ("PROGRAM", "", "WITH", "", ":", "")
    for i, first in enumerate(scan):
        for shape in shapes:
            found = scan[i : i + len(shape)]
            if len(found) == len(shape) and all(
                word.text == wanted or (not wanted and NAME.fullmatch(word.text))
                for word, wanted in zip(found, shape, strict=True)
            ):
                instance, *task, kind = (text[w.start : w.end] for w in found[1::2])
                yield _Program(instance, "".join(task), kind, first.start)


def background_task(source: str, line: int | None, instance: str, kind: str, report: ImportReport) -> Draft:
    """The task of a program that a file instantiates without one."""
    text = f"program '{kind}' has no task; it is called by a freewheeling task of the lowest priority"
    report.add("changed", source, text, name=instance, line=line)
    data = {"type": "freewheeling", "priority": SOFT_PLC.lowest_priority, "pous": [{"name": kind}]}
    return Draft("task", instance, data, source, line)


def task_draft(
    source: str,
    line: int | None,
    name: str,
    settings: Mapping[str, str],
    calls: list[str],
    report: ImportReport,
) -> Draft:
    """A task with the settings `INTERVAL := T#10ms, PRIORITY := 1, SINGLE := bStart`."""
    data: dict[str, Any] = {"pous": _calls(source, line, name, calls, report)}
    data["priority"] = priority(source, line, name, settings.get("PRIORITY", "1"), report)
    interval = settings.get("INTERVAL", "")
    event = settings.get("SINGLE", "") or settings.get("EVENT", "")
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
    fit = min(max(value, SOFT_PLC.highest_priority), SOFT_PLC.lowest_priority)
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
