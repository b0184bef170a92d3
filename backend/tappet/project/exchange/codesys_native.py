"""CODESYS V3: `.export`, its own exchange file: a list of objects with id, id of the parent, and texts.

What the texts are is told by the type ids of the objects and, where they say nothing, by the first keyword.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from tappet.project.declaration_text import as_parameter_list, read_header
from tappet.project.exchange.drafts import (
    Batch,
    Draft,
    body,
    exclude,
    hex_id,
    library_manager,
    task_configuration,
)
from tappet.project.exchange.libraries import reference
from tappet.project.exchange.plcopen_tasks import KINDS
from tappet.project.exchange.report import ExchangeError, ImportReport
from tappet.project.exchange.standard_tasks import cycle, priority
from tappet.project.exchange.without_result import mark_without_result
from tappet.project.exchange.xml_tree import Element, read_xml, xml_text

_FOLDER = "738bea1e99bb4f0490bba7a567e74e3a"
_DEVICE = "225bfe4773364dbc94194105a7c831fa"
_LOGIC = "40b404f9e5dc42c6907fc89f4a517386"
_APPLICATION = "639b491f5557464caf911471bac9f549"
_TASKS = "ae1de277a2074a289efb456c06bd52f3"
_TASK = "98a2708a9b184f3182eda1465b24fa2d"
_LIBRARIES = "adb5cb658e1d4a00b70a375ea27582f3"
_KINDS = {
    "6f9dac998de14efc846568ac443b7d08": "pou",
    "2db5746dd28444259f7f2663a34b0ebc": "dut",
    "ffbfa93ab94d45fca329229860183b1d": "gvl",
    "261bd6e6249c4232bb6f84c2fbeef430": "persistent",
    "6654496c404d479aaad28551054e5f1e": "interface",
    "f8a58466d7f6439fbbb8d4600e41d099": "method",
    "f89f767527f146b38abbb7da8e774ffd": "method",
    "5a3b8626d3e94f3798b566420063d91e": "property",
    "792f2eb6721e4e64ba20bc98351056db": "accessor",
    "8ac092e531284e269e7e11016c6684f2": "action",
    "a10c6218cb94436f91c6e1652575253d": "transition",
}
_HEADERS = {
    "PROGRAM": "pou",
    "FUNCTION": "pou",
    "FUNCTION_BLOCK": "pou",
    "TYPE": "dut",
    "VAR_GLOBAL": "gvl",
    "INTERFACE": "interface",
    "METHOD": "method",
    "PROPERTY": "property",
}
_SILENT = frozenset(
    [
        "413e2a7dadb14d2cbe296ae6e4fab820",  # a call of a program, which the task names, too
        "8753fe6f4a2243208103e553c4fc8e04",  # project settings
        "085afe48c5d84ea5ab0db35701fa6009",  # project information
        "8e687a047ca742d3be06fcbda676c5ef",  # the style of visualisations
    ]
)
_NOT_READ = {
    "f18bec899fef401d99532f11739a6808": "visualisations are not read",
    "4d3fdb8fab504c359d3ad4bb9bb9a628": "the visualisation manager is not read",
    "bc63f5fad2864786994e7b27e4f97bd5": "visualisations are not read",
    "0fdbf1581ae047d99269cd84be308e9d": "visualisations are not read",
    "2bef04541bd3412aac2caf0f31dbc40f": "text lists are not read",
    "63784cbb9ba045e69d69babf3f040511": "text lists are not read",
    "6507a8fd035f464abd5b7f15e8ac084a": "image pools are not read",
    "21d4fe94412343239091ead220afbd1f": "symbol configurations are not read",
    "f7aa362080734c91b6ec86ed9eb60303": "traces are not read",
}
_CFC = "32d3375ec01041e29e43b2fbf4f2b374"
_NO_ID = "0" * 32


@dataclass(slots=True)
class _Entry:
    item: Element
    id: str
    parent: str
    """Id of what it stands below in the tree."""
    name: str
    type: str
    path: tuple[str, ...]
    """Names of all that it stands below in the project."""
    held: Element | None


def read_native(source: str, content: bytes, batch: Batch, report: ImportReport) -> None:
    """Take the objects of a file in. Raises ExchangeError."""
    root = read_xml(source, content)
    entries = [entry for entry in _entries(root) if entry.type]
    if not entries:
        raise ExchangeError(
            source, "holds no objects; export them in CODESYS with Project > Export", root.line
        )
    _Reader(source, batch, report, entries).read()


def _entries(root: Element) -> Iterator[_Entry]:
    lists = (item for item in root.walk() if item.tag == "List2" and item.get("Name") == "EntryList")
    for item in (item for held in lists for item in held):
        meta = _part(item, "MetaObject")
        if meta is None:
            continue
        path = _part(item, "Path")
        yield _Entry(
            item,
            hex_id(_value(meta, "Guid")) or "",
            hex_id(_value(item, "ParentSVNodeGuid")) or _NO_ID,
            _value(meta, "Name"),
            hex_id(_value(meta, "TypeGuid")) or "",
            tuple(part.text() for part in path) if path is not None else (),
            _part(item, "Object"),
        )


class _Reader:
    def __init__(self, source: str, batch: Batch, report: ImportReport, entries: list[_Entry]) -> None:
        self.source = source
        self.batch = batch
        self.report = report
        self.entries = entries
        self.by_id = {entry.id: entry for entry in entries}
        self.drafts: dict[str, Draft] = {}
        self.pool = Draft("pous_view", "", source=source)
        """What stands in no application."""

    def read(self) -> None:
        below_logic = {entry.parent for entry in self.entries if entry.type == _LOGIC}
        for entry in self.entries:
            if entry.type == _DEVICE and entry.id not in below_logic:
                text = "the device is not read; add it here and map its channels"
                self.report.add("refused", self.source, text, name=entry.name, line=entry.item.line)
                continue
            draft = self._draft(entry)
            if draft is not None and entry.id not in self.drafts:
                self.drafts[entry.id] = draft
        for entry in self.entries:
            if entry.type == _APPLICATION and entry.parent not in self.drafts:
                self.drafts[entry.id] = self.batch.loose  # its device is not in the file
        for entry in self.entries:
            made = self.drafts.get(entry.id)
            if made is None or made is self.batch.loose or self.by_id[entry.id] is not entry:
                continue
            if not self._is_above(made, entry):
                self._place(entry, made)
        applied = bool(self.batch.devices or self.batch.loose.children)
        place = self.batch.pous if applied else self.batch.loose
        place.children += self.pool.children

    def _is_above(self, draft: Draft, entry: _Entry) -> bool:
        """Whether an object stands below itself, which only a faulty file says."""
        seen = {entry.id}
        while (above := self.by_id.get(entry.parent)) is not None:
            if above.id in seen:
                self.report.add(
                    "refused", self.source, "stands below itself", name=draft.name, line=draft.line
                )
                return True
            seen.add(above.id)
            entry = above
        return False

    def _place(self, entry: _Entry, draft: Draft) -> None:
        parent = self.drafts.get(entry.parent)
        if draft.kind == "device":
            self.batch.devices.append(draft)
        elif draft.kind == "plc_logic":
            if parent is not None:
                parent.children.append(draft)
        elif parent is not None:
            parent.children.append(draft)
        elif "PLC Logic" in entry.path or draft.kind in ("task_configuration", "library_manager", "task"):
            self._add(self._application(entry), draft)
        else:
            self._add(self.pool.below(entry.path, self.source), draft)

    def _application(self, entry: _Entry) -> Draft:
        """The place in an application that is not in the file itself."""
        names = entry.path[entry.path.index("PLC Logic") + 2 :] if "PLC Logic" in entry.path else ()
        if entry.type in (_TASK, _TASKS, _LIBRARIES):
            names = ()
        return self.batch.loose.below(names, self.source)

    def _add(self, place: Draft, draft: Draft) -> None:
        if draft.kind == "task":
            task_configuration(place).children.append(draft)
        else:
            place.children.append(draft)

    # -- objects

    def _draft(self, entry: _Entry) -> Draft | None:
        make: dict[str, Callable[[_Entry], Draft]] = {
            _FOLDER: lambda one: self._plain(one, "folder"),
            _DEVICE: lambda one: self._plain(one, "device"),
            _LOGIC: lambda one: self._plain(one, "plc_logic", "PLC Logic"),
            _APPLICATION: lambda one: self._plain(one, "application"),
            _TASKS: lambda one: self._plain(one, "task_configuration", "Task Configuration"),
            _TASK: self._task,
            _LIBRARIES: self._libraries,
        }
        if entry.type in make:
            return make[entry.type](entry)
        if entry.type in _SILENT:
            return None
        declaration = _text(_part(entry.held, "Interface"))
        kind = _KINDS.get(entry.type)
        if kind is None and declaration is not None:
            header = read_header(declaration)
            kind = _HEADERS.get(header.keyword) if header is not None else None
        if kind is None:
            text = _NOT_READ.get(entry.type, "objects of this type are not read")
            self.report.add("refused", self.source, text, name=entry.name, line=entry.item.line)
            return None
        return self._code(entry, kind, declaration or "")

    def _plain(self, entry: _Entry, kind: str, name: str = "") -> Draft:
        return Draft(kind, name or entry.name, {}, self.source, entry.item.line, [], entry.id or None)

    def _code(self, entry: _Entry, kind: str, declaration: str) -> Draft:
        draft = self._plain(entry, kind)
        if kind not in ("action", "transition"):
            draft.data = {"declaration": declaration}
        if kind == "gvl" and _value(entry.held, "IsParameterList").casefold() == "true":
            draft.data["declaration"] = as_parameter_list(declaration)
        if kind in ("pou", "method", "accessor", "action", "transition"):
            draft.data |= self._body(entry, draft.name)
        if kind == "pou":
            mark_without_result(draft, self.report)
        meta = _part(entry.item, "MetaObject")
        if meta is not None and _value(meta, "ExcludeFromBuild", deep=True).casefold() == "true":
            exclude(draft)
        return draft

    def _body(self, entry: _Entry, name: str) -> dict[str, object]:
        held = _part(entry.held, "Implementation")
        if held is None:
            return body("ST", "")
        text = _text(held)
        if text is not None:
            return body("ST", text)
        language = "CFC" if hex_id(held.get("Type")) == _CFC else "FBD"
        note = "the drawn body is kept as it is; it cannot be compiled yet"
        self.report.add("kept", self.source, note, name=name, line=entry.item.line)
        return body(language, xml_text(held))

    def _task(self, entry: _Entry) -> Draft:
        draft = self._plain(entry, "task")
        held, line = entry.held, entry.item.line
        kind = KINDS.get(_value(held, "Kindoftask").casefold(), "cyclic")
        calls = _part(held, "PouList")
        draft.data = {
            "type": kind,
            "priority": priority(self.source, line, draft.name, _value(held, "Priority"), self.report),
            "pous": [
                {"name": _value(call, "Name"), "comment": " ".join(_value(call, "Comment").split())[:4000]}
                for call in calls or ()
                if _value(call, "Name")
            ],
        }
        if kind == "cyclic":
            text = _time(_part(held, "Interval"))
            draft.data["interval"] = cycle(self.source, line, draft.name, text, self.report)
        elif kind in ("event", "status", "external"):
            draft.data["event"] = _value(held, "ExternalEvent" if kind == "external" else "Event")
        watchdog = _part(held, "Watchdog")
        if _value(watchdog, "Enabled").casefold() == "true":
            time = _time(_part(watchdog, "Time"))
            draft.data["watchdog"] = {"enabled": True} | ({"time": time} if time else {})
            if re.fullmatch(r"\d{1,6}", _value(watchdog, "Sensitivity")):
                draft.data["watchdog"]["sensitivity"] = int(_value(watchdog, "Sensitivity"))
        return draft

    def _libraries(self, entry: _Entry) -> Draft:
        holder = Draft("application", "", source=self.source)
        draft = library_manager(holder)
        draft.line, draft.id = entry.item.line, entry.id or None
        found = draft.data.setdefault("references", [])
        for item in _part(entry.held, "Items") or ():
            text = (
                _value(item, "DefaultResolution") or _value(item, "Name") or _value(item, "PlaceholderName")
            )
            name, _, rest = text.lstrip("#").partition(",")
            version = rest.partition("(")[0].strip() or "*"
            if name.strip() and not any(one["name"] == name.strip() for one in found):
                namespace = _value(item, "Namespace")
                found.append(reference(self.source, name.strip(), version, namespace, self.report, item.line))
        return draft


def _part(item: Element | None, name: str) -> Element | None:
    return next((part for part in item or () if part.get("Name") == name), None)


def _value(item: Element | None, name: str, deep: bool = False) -> str:
    found = _part(item, name)
    if found is None and deep and item is not None:
        found = next((part for part in item.walk() if part.get("Name") == name), None)
    return found.text().strip() if found is not None else ""


def _text(item: Element | None) -> str | None:
    """The text of a declaration or a body; None where it is a drawing, or missing."""
    document = _part(item, "TextDocument")
    blob = _part(document, "TextBlobForSerialisation")
    if blob is not None:
        return blob.text().replace("\r\n", "\n").replace("\r", "\n").removesuffix("\n")
    lines = _part(document, "TextLines")
    if lines is None:
        return None
    texts = [part.text() if (part := _part(line, "Text")) is not None else "" for line in lines]
    return "\n".join(texts).replace("\r", "").removesuffix("\n")


def _time(item: Element | None) -> str:
    """A time with its unit: `t#4ms`, or a bare number of the unit beside it."""
    text, unit = _value(item, "Time"), _value(item, "Unit").replace("µ", "u").replace("μ", "u")
    return f"T#{text}{unit}" if re.fullmatch(r"\d+", text) and unit in ("ms", "s", "ns", "us") else text
