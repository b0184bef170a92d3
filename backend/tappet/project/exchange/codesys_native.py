"""CODESYS V3: `.export`, its own exchange file: a list of objects with id, id of the parent, and texts.

What the texts are follows from the type ids of the objects and, where they say nothing, by the first keyword.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from tappet.iec.sections import end_keyword, read_header
from tappet.project.data import CodeData
from tappet.project.exchange.build_properties import take_build_properties
from tappet.project.exchange.drafts import (
    Batch,
    Draft,
    body,
    hex_id,
    task_configuration,
)
from tappet.project.exchange.libraries import reference, take_access
from tappet.project.exchange.plcopen_tasks import KINDS
from tappet.project.exchange.report import ExchangeError, ImportReport
from tappet.project.exchange.standard_tasks import cycle, priority
from tappet.project.exchange.without_result import mark_without_result
from tappet.project.exchange.xml_tree import Element, read_xml, xml_text
from tappet.project.folder.texts import kind_of_text
from tappet.project.kind_registry import kinds
from tappet.project.kinds.plc_logic import PLC_LOGIC
from tappet.project.model import APPLICATION, DEVICE

_TRANSITION = "a10c6218cb94436f91c6e1652575253d"
_TRANSITION_KIND = "transition"
"""What belongs to a drawn chart; no kind of object is installed for it."""
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
_LISTS = ("List2", "List")
"""Elements that hold a list; which one depends on the version of CODESYS."""


@dataclass(slots=True)
class Entry:
    """An object in the file."""

    item: Element
    id: str
    parent: str
    """Id of what it stands below in the tree."""
    name: str
    type: str
    path: tuple[str, ...]
    """Names of all that it stands below in the project."""
    held: Element | None
    kind: str
    """The kind of object that the type denotes; empty where it says nothing."""

    def value(self, name: str) -> str:
        """A value of the object."""
        return _value(self.held, name)


def read_native(source: str, content: bytes, batch: Batch, report: ImportReport) -> None:
    """Take the objects of a file in. Raises ExchangeError."""
    root = read_xml(source, content)
    entries = [entry for entry in _entries(root) if entry.type]
    if not entries:
        raise ExchangeError(
            source, "holds no objects; export them in CODESYS with Project > Export", root.line
        )
    NativeReader(source, batch, report, entries).read()


def _entries(root: Element) -> Iterator[Entry]:
    forms = [(kind.name, kind.codesys) for kind in kinds().values()]
    by_type = {type_id: name for name, form in forms if form is not None for type_id in form.type_ids}
    by_type[_TRANSITION] = _TRANSITION_KIND
    lists = (item for item in root.walk() if item.tag in _LISTS and item.get("Name") == "EntryList")
    for item in (item for held in lists for item in held):
        meta = _part(item, "MetaObject")
        if meta is None:
            continue
        path = _part(item, "Path")
        yield Entry(
            item,
            hex_id(_value(meta, "Guid")) or "",
            hex_id(_value(item, "ParentSVNodeGuid")) or _NO_ID,
            _value(meta, "Name"),
            hex_id(_value(meta, "TypeGuid")) or "",
            tuple(part.text() for part in path) if path is not None else (),
            _part(item, "Object"),
            by_type.get(hex_id(_value(meta, "TypeGuid")) or "", ""),
        )


class NativeReader:
    """Reads a file; kinds read with it what is more than texts."""

    def __init__(self, source: str, batch: Batch, report: ImportReport, entries: list[Entry]) -> None:
        self.source = source
        self.batch = batch
        self.report = report
        self.entries = entries
        self.by_id = {entry.id: entry for entry in entries}
        self.drafts: dict[str, Draft] = {}
        self.pool = Draft("pous_view", "", source=source)
        """What stands in no application."""

    def read(self) -> None:
        """Take all objects in."""
        below_logic = {entry.parent for entry in self.entries if entry.kind == PLC_LOGIC.name}
        for entry in self.entries:
            if entry.kind == DEVICE and entry.id not in below_logic:
                text = "the device is not read; add it here and map its channels"
                self.report.add("refused", self.source, text, name=entry.name, line=entry.item.line)
                continue
            draft = self._draft(entry)
            if draft is not None and entry.id not in self.drafts:
                self.drafts[entry.id] = draft
        for entry in self.entries:
            if entry.kind == APPLICATION and entry.parent not in self.drafts:
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

    def _is_above(self, draft: Draft, entry: Entry) -> bool:
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

    def _place(self, entry: Entry, draft: Draft) -> None:
        parent = self.drafts.get(entry.parent)
        if draft.kind == DEVICE:
            self.batch.devices.append(draft)
        elif draft.kind == PLC_LOGIC.name:
            if parent is not None:
                parent.children.append(draft)
        elif parent is not None:
            parent.children.append(draft)
        elif "PLC Logic" in entry.path or _stands_directly(draft.kind):
            self._add(self._application(entry), draft)
        else:
            self._add(self.pool.below(entry.path, self.source), draft)

    def _application(self, entry: Entry) -> Draft:
        """The place in an application that is not in the file itself."""
        names = entry.path[entry.path.index("PLC Logic") + 2 :] if "PLC Logic" in entry.path else ()
        if _stands_directly(entry.kind):
            names = ()
        return self.batch.loose.below(names, self.source)

    def _add(self, place: Draft, draft: Draft) -> None:
        if draft.kind == "task":
            task_configuration(place).children.append(draft)
        else:
            place.children.append(draft)

    # -- objects

    def _draft(self, entry: Entry) -> Draft | None:
        if entry.type in _SILENT:
            return None
        name = entry.kind
        declaration = _text(_part(entry.held, "Interface"))
        if not name and declaration is not None:
            header = read_header(declaration)
            if end_keyword(declaration) or (header is not None and header.keyword == "VAR_GLOBAL"):
                name = kind_of_text(declaration) or ""
        if not name:
            text = _NOT_READ.get(entry.type, "objects of this type are not read")
            self.report.add("refused", self.source, text, name=entry.name, line=entry.item.line)
            return None
        draft = Draft(name, entry.name, {}, self.source, entry.item.line, [], entry.id or None)
        kind = kinds().get(name)
        if kind is None:
            draft.data = self._body(entry, draft.name)
            return draft
        if kind.naming.style == "fixed" and len(kind.naming.names) == 1:
            draft.name = kind.naming.names[0]
        if "declaration" in kind.data.model_fields:
            draft.data = {"declaration": declaration or ""}
        if "implementation" in kind.data.model_fields:
            draft.data |= self._body(entry, draft.name)
        if kind.codesys is not None and kind.codesys.read is not None:
            kind.codesys.read(self, entry, draft)
        mark_without_result(draft, self.report)
        meta = _part(entry.item, "MetaObject")
        take_build_properties(draft, lambda key: _value(meta, key, deep=True), self.report)
        return draft

    def _body(self, entry: Entry, name: str) -> dict[str, object]:
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

    def task(self, entry: Entry, draft: Draft) -> None:
        """When a task runs and what it calls."""
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

    def libraries(self, entry: Entry, draft: Draft) -> None:
        """The references of a library manager."""
        found = draft.data.setdefault("references", [])
        for item in _part(entry.held, "Items") or ():
            text = (
                _value(item, "DefaultResolution") or _value(item, "Name") or _value(item, "PlaceholderName")
            )
            name, _, rest = text.lstrip("#").partition(",")
            version = rest.partition("(")[0].strip() or "*"
            if name.strip() and not any(one["name"] == name.strip() for one in found):
                namespace = _value(item, "Namespace")
                made = reference(self.source, name.strip(), version, namespace, self.report, item.line)
                found.append(take_access(made, _value(item, "QualifiedOnly")))


def _stands_directly(kind: str) -> bool:
    """Whether objects of a kind stand directly in an application, or in one that stands there."""
    known = kinds().get(kind)
    return known is not None and not known.placement.in_folders and not issubclass(known.data, CodeData)


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
