"""TwinCAT 3: `.tsproj`, the system project: its PLC projects, their tasks, data types; the rest is reported.

PLC projects stand in it or in an `.xti` file of their own; a solution, `.sln`, lists the system projects.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.report import ExchangeError, ImportReport
from tappet.project.exchange.standard_tasks import cycle, priority
from tappet.project.exchange.twincat_types import read_types
from tappet.project.exchange.xml_tree import Element, read_xml

ENDINGS = (".tsproj", ".tspproj", ".sln", ".xti")
"""Endings of the files of a system, in lower case."""
_PROJECTS = (".tsproj", ".tspproj")
_LISTED = re.compile(r'^Project\("[^"]*"\)\s*=\s*"[^"]*"\s*,\s*"(?P<path>[^"]+)"', re.MULTILINE)
_LINKS_SHOWN = 50
_NAMES_SHOWN = 12
_PARTS = {"Io": "I/O devices", "Motion": "NC axes", "Safety": "safety projects", "Cpp": "C++ modules"}
"""What the parts of a system project hold."""


@dataclass(frozen=True, slots=True)
class SystemTask:
    """A task of the system: it calls the task of the same name of a PLC project."""

    name: str
    source: str
    line: int
    interval: str
    """A number of microseconds or a TIME literal."""
    priority: str
    disabled: bool


@dataclass(slots=True)
class Systems:
    """All system projects of an import."""

    names: list[str] = field(default_factory=list)
    tasks: dict[str, dict[str, SystemTask]] = field(default_factory=dict)
    """Of each `.plcproj` by path: the tasks of its system by folded name."""
    used: set[str] = field(default_factory=set)
    """Files that are read or need not be read."""
    types: list[Draft] = field(default_factory=list)
    """Data types that the systems hold for their PLC projects."""
    failures: list[ExchangeError] = field(default_factory=list)


def read_systems(files: Mapping[str, bytes], report: ImportReport) -> Systems:
    """Read the system projects among the files. A faulty one is reported and does not hinder the others."""
    found = Systems(used={path for path in files if path.lower().endswith((".sln", ".xti"))})
    projects = [path for path in sorted(files) if path.lower().endswith(_PROJECTS)]
    listed = _listed(files)
    for path in projects:
        found.used.add(path)
        if listed and path not in listed:
            report.add("refused", path, "no solution (.sln) lists this system project, so it was left out")
            continue
        try:
            _System(path, files, found, report).read()
        except ExchangeError as error:
            found.failures.append(error)
    return found


def _listed(files: Mapping[str, bytes]) -> set[str]:
    """The system projects that solutions list."""
    found = set()
    for path in files:
        if path.lower().endswith(".sln"):
            for match in _LISTED.finditer(files[path].decode("utf-8", errors="replace")):
                there = file_at(files, posixpath.dirname(path), match["path"])
                if there is not None and there.lower().endswith(_PROJECTS):
                    found.add(there)
    return found


def file_at(files: Mapping[str, bytes], folder: str, path: str) -> str | None:
    """The file at a path of Windows relative to a folder, whatever its case."""
    wanted = posixpath.normpath(posixpath.join(folder, path.replace("\\", "/"))).casefold()
    return next((known for known in files if posixpath.normpath(known).casefold() == wanted), None)


def adjust_task(draft: Draft, task: SystemTask, report: ImportReport) -> bool:
    """Give a task the times of its system task, which hold in TwinCAT; False when it never runs."""
    if task.disabled:
        calls = ", ".join(str(call["name"]) for call in draft.data.get("pous", ()))
        text = f"the task is disabled in the system project and was left out; it called {calls or 'nothing'}"
        report.add("refused", task.source, text, name=draft.name, line=task.line)
        return False
    interval = cycle(task.source, task.line, draft.name, task.interval, report)
    level = priority(task.source, task.line, draft.name, task.priority, report)
    changes = []
    own = str(draft.data.get("interval", "")) or "none"
    if not _same_time(own, interval):
        changes.append(f"interval {_shown_time(interval)} instead of {_shown_time(own)}")
    if draft.data.get("priority") != level:
        changes.append(f"priority {level} instead of {draft.data.get('priority')}")
    draft.data |= {"interval": interval, "priority": level}
    if changes:
        text = f"the settings of the system project hold: {', '.join(changes)}"
        report.add("changed", draft.source, text, name=draft.name, line=draft.line)
    return True


def _same_time(one: str, other: str) -> bool:
    try:
        return duration_ns(one) == duration_ns(other)
    except InvalidTimeError:
        return False


def _shown_time(text: str) -> str:
    return f"T#{text}us" if text.isdecimal() else text


class _System:
    """One system project."""

    def __init__(self, source: str, files: Mapping[str, bytes], found: Systems, report: ImportReport) -> None:
        self.source = source
        self.folder = posixpath.dirname(source)
        self.files = files
        self.found = found
        self.report = report
        self.tasks: dict[str, SystemTask] = {}
        self.by_number: dict[int, SystemTask] = {}

    def read(self) -> None:
        root = read_xml(self.source, self.files[self.source])
        project = root.child("Project")
        if root.tag != "TcSmProject" or project is None:
            raise ExchangeError(self.source, "is no system project: <TcSmProject> is missing", root.line)
        self._types(root, self.source)
        self.found.names.append(posixpath.basename(self.source).rpartition(".")[0])
        for item in project.walk():
            if item.tag == "Task":
                self._task(item)
        for item in project.children("Plc"):
            for plc in item.children("Project"):
                self._plc(plc)
        for item in project:
            if item.tag in _PARTS:
                self._part(item)
        self._links(root, self.source)

    def _types(self, root: Element, source: str) -> None:
        known = {draft.name.casefold() for draft in self.found.types}
        found = read_types(root, source, self.report)
        self.found.types += [draft for draft in found if draft.name.casefold() not in known]

    def _task(self, item: Element) -> None:
        tenths = item.get("CycleTime")
        count = int(tenths) if tenths.isascii() and tenths.isdecimal() and len(tenths) < 16 else 0
        interval = f"T#{count // 10}us{count % 10 * 100}ns" if count % 10 else str(count // 10)
        task = SystemTask(
            _child_text(item, "Name"),
            self.source,
            item.line,
            interval,
            item.get("Priority"),
            item.get("Disabled").lower() in ("true", "1"),
        )
        self.tasks[task.name.casefold()] = task
        if item.get("Id").isdecimal():
            self.by_number[int(item.get("Id")[:9])] = task

    def _plc(self, item: Element) -> None:
        source, folder = self.source, self.folder
        if item.get("File"):
            name = item.get("File").replace("\\", "/")
            places = (f"_Config/PLC/{name}", name)
            held = next((path for place in places if (path := file_at(self.files, folder, place))), None)
            if held is None:
                text = "the file of the PLC project was not given with the system project"
                self.report.add("refused", source, text, name=name, line=item.line)
                return
            source, folder = held, posixpath.dirname(held)
            root = read_xml(source, self.files[source])
            inner = root.child("Project")
            if inner is None:
                raise ExchangeError(source, "holds no PLC project: <Project> is missing", root.line)
            self._types(root, source)
            self._links(root, source)
            item = inner
        path = file_at(self.files, folder, item.get("PrjFilePath"))
        name = item.get("Name") or item.get("PrjFilePath")
        if path is None:
            text = f"the PLC project '{item.get('PrjFilePath')}' was not given with the system project"
            self.report.add("refused", source, text, name=name, line=item.line)
            return
        if item.get("Disabled").lower() in ("true", "1"):
            text = "the PLC project is disabled in the system project; it came in as any other"
            self.report.add("changed", source, text, name=name, line=item.line)
        self.found.tasks[path] = self.tasks | dict(self._renamed(item))

    def _renamed(self, plc: Element) -> Iterator[tuple[str, SystemTask]]:
        """Tasks of a PLC project that are called by a system task of another name."""
        for context in plc.walk():
            held = context.child("ManualConfig") if context.tag == "Context" else None
            number = _child_text(held, "OTCID").removeprefix("#x") if held is not None else ""
            if re.fullmatch(r"[0-9a-fA-F]{8}", number):
                task = self.by_number.get((int(number, 16) & 0xFFFF) >> 4)
                if task is not None:
                    yield _child_text(context, "Name").casefold(), task

    def _part(self, item: Element) -> None:
        names = []
        for held in item.walk():
            if held.tag in ("Device", "Axis", "Project", "Instance") and held is not item:
                name = _child_text(held, "Name") or held.get("Name") or held.get("File").rpartition(".")[0]
                if name:
                    names.append(name)
        if not names and not any(True for _ in item):
            return
        more = f" and {len(names) - _NAMES_SHOWN} more" if len(names) > _NAMES_SHOWN else ""
        listed = f": {', '.join(names[:_NAMES_SHOWN])}{more}" if names else ""
        advice = (
            "; add the devices here"
            if item.tag == "Io"
            else ("; add the axes here" if item.tag == "Motion" else "")
        )
        text = f"{_PARTS[item.tag]} of the system project are not read{advice}{listed}"
        self.report.add("refused", self.source, text, name=item.tag, line=item.line)

    def _links(self, root: Element, source: str) -> None:
        """One entry for each terminal that variables of PLC projects are linked with."""
        for mappings in root.children("Mappings"):
            for first in mappings.children("OwnerA"):
                plc = _instance(first.get("Name"))
                if plc is None:
                    continue
                for second in first.children("OwnerB"):
                    links = [
                        f"{_variable(link.get('VarA'))} ↔ {' > '.join(link.get('VarB').split('^'))}"
                        for link in second.children("Link")
                    ]
                    if not links:
                        continue
                    more = f" and {len(links) - _LINKS_SHOWN} more" if len(links) > _LINKS_SHOWN else ""
                    place = " > ".join(second.get("Name").split("^")[1:])
                    axis = second.get("Name").startswith("TINC^")
                    described = (
                        f"links with the axis '{place}' are not read"
                        if axis
                        else f"links with '{place}' are not read; map the variables to channels of a device "
                        "here"
                    )
                    text = f"{described}: {', '.join(links[:_LINKS_SHOWN])}{more}"
                    self.report.add("refused", source, text, name=plc, line=second.line)


def _instance(owner: str) -> str | None:
    """The PLC project that an end of a link belongs to: `TIPC^Line^Line Instance` in a system project."""
    parts = owner.split("^")
    if (len(parts) > 1 and parts[0] != "TIPC") or not parts[-1].endswith(" Instance"):
        return None
    return parts[-1].removesuffix(" Instance")


def _variable(text: str) -> str:
    """The variable of an end of a link: `PlcTask Outputs^Main.M1.bBrake` is `Main.M1.bBrake`."""
    return text.partition("^")[2].replace("^", ".").replace(".[", "[") or text


def _child_text(item: Element, tag: str) -> str:
    child = item.child(tag)
    return child.text().strip() if child is not None else ""
