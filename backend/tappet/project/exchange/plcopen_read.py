"""PLCopen XML to drafts: TC6 0200 and 0201, with or without the namespace, from CODESYS, TwinCAT, Beremiz ...

Objects are taken wherever they stand, in `types` or in additional data of any level, because the systems
differ in that. Where the export holds the declarations as plain text, these are taken as they are.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Callable
from typing import Any

from tappet.iec.languages import is_plain_text
from tappet.iec.languages import languages as body_languages
from tappet.iec.sections import read_header
from tappet.iec.words import SECTIONS
from tappet.project.exchange.build_properties import take_build_properties
from tappet.project.exchange.drafts import (
    Batch,
    Draft,
    body,
    hex_id,
    library_manager,
    plc_logic,
    task_configuration,
)
from tappet.project.exchange.plcopen_declarations import (
    added,
    data_type_text,
    documentation,
    exact_text,
    head_lines,
    plain_text,
    section_lines,
    sections,
)
from tappet.project.exchange.plcopen_devices import controllers_below, read_devices
from tappet.project.exchange.plcopen_libraries import read_libraries
from tappet.project.exchange.plcopen_matiec import COUNTERS, is_for_matiec, rewritten, uses_counters
from tappet.project.exchange.plcopen_tasks import read_task, task_of_instance
from tappet.project.exchange.plcopen_tree import arrange
from tappet.project.exchange.report import ExchangeError, ImportReport
from tappet.project.exchange.without_result import mark_without_result
from tappet.project.exchange.xml_tree import Element, read_xml, xml_text
from tappet.project.kind_registry import kinds
from tappet.project.model import DEVICE, FOLDER

TAPPET = "https://github.com/tappet/plcopen/"
"""Where the names of our own additional data begin."""
PRODUCT = "Tappet"
"""Name of the product in the header of our own exports."""

_KEYWORDS = {"program": "PROGRAM", "function": "FUNCTION", "functionblock": "FUNCTION_BLOCK"}
_CONTAINERS = frozenset(
    ["types", "dataTypes", "pous", "instances", "configurations", "globalVarsList", "Interfaces", "project"]
)
_STRUCTURE = frozenset(["configuration", "resource", "task"])
_LISTS = "globalvars"
"""CODESYS's additional data that hold lists of variables."""
_NO_OBJECTS = frozenset(
    [
        "objectid",
        "attributes",
        "projectinformation",
        "projectstructure",
        "interfaceasplaintext",
        "pouinheritance",
        "accessmodifiers",
        "mixedattrsvarlist",
        "tasksettings",
        "buildproperties",
    ]
)
"""Additional data that say something of the element they stand in."""


def read_plcopen(source: str, content: bytes, batch: Batch, report: ImportReport) -> None:
    """Take the objects of a file in. Raises ExchangeError for what is no PLCopen XML."""
    root = read_xml(source, content)
    if root.tag != "project":
        hint = "export the project as PLCopen XML" if root.tag == "Project" else "expected <project>"
        raise ExchangeError(source, f"is no PLCopen XML: its root is <{root.tag}>; {hint}", root.line)
    PlcopenReader(source, batch, report).read(root)


class PlcopenReader:
    """Reads a file; kinds read their elements with its parts."""

    def __init__(self, source: str, batch: Batch, report: ImportReport) -> None:
        self.source = source
        self.batch = batch
        self.report = report
        self.pool = Draft("pous_view", "", source=source)
        """What stands in no application of the file."""
        self.devices: list[Draft] = []
        self.by_id: dict[str, Draft] = {}
        self.generic: list[Draft] = []
        self._readers = _readers()
        self.matiec = False
        """The bodies are for the compiler of Beremiz and OpenPLC."""

    def read(self, root: Element) -> None:
        """Take all objects in."""
        product = root.child("fileHeader")
        self.batch.complete = product is not None and product.get("productName") == PRODUCT
        self.matiec = not self.batch.complete and is_for_matiec(root)
        header = root.child("contentHeader")
        if header is not None:
            name = header.get("name")
            if not self.batch.complete:
                name = name.removesuffix(".project").removesuffix(".library")
            self.batch.name = self.batch.name or name
            comment = header.child("Comment")
            note = exact_text(comment) if comment is not None else documentation(header)
            self.batch.description = self.batch.description or note
        for item in root:
            if item.tag not in ("fileHeader", "contentHeader"):
                self._element(item, self.pool)
        for name, item in added(root):
            self._added(name, item, self.pool)
        if self.matiec and uses_counters(self.pool):
            manager = library_manager(self.pool)
            manager.data.setdefault("references", []).append(COUNTERS.model_dump())
        structure = next((item for name, item in added(root) if name == "projectstructure"), None)
        applications = [
            item for device in self.devices for logic in device.children for item in logic.children
        ]
        filled = any(_fills(item) for found in applications for item in found.children)
        if not filled and not self.batch.complete and applications:
            applications[0].children += self.pool.children
            self.pool.children = []
        arrange(structure, self.pool, self.devices, self.generic, self.by_id)
        if applications or self.batch.complete:
            self.batch.devices += self.devices
            self.batch.pous.children += self.pool.children
        else:
            self.batch.loose.children += self.pool.children

    # -- objects, wherever they stand

    def _element(self, item: Element, parent: Draft) -> None:
        tag = item.tag
        reads = self._readers.get(tag)
        if reads is not None:
            self._enter(parent, reads(self, item))
        elif tag == "configuration":
            self._configuration(item)
        elif tag == "resource":
            self._resource(item, parent)
        elif tag == "task":
            ours = next((part for name, part in added(item) if name == "object"), None)
            draft = read_task(self.source, item, self.report)
            if ours is not None:
                draft.data = _json(self.source, ours)
            draft.id = self._id(item)
            self._enter(task_configuration(parent), draft)
        elif tag == "pouInstance":
            draft = task_of_instance(self.source, item, self.report)
            self._enter(task_configuration(parent), draft)
        elif tag in _CONTAINERS:
            for inner in item:
                self._element(inner, parent)
            for name, inner in added(item):
                self._added(name, inner, parent)

    def _added(self, name: str, item: Element, parent: Draft) -> None:
        if item.tag == "Object" and name == "object":
            self._generic(item)
        elif item.tag == "Libraries":
            references = library_manager(parent).data.setdefault("references", [])
            references += read_libraries(self.source, item, self.report)
        elif item.tag in _STRUCTURE or item.tag in self._readers:
            self._element(item, parent)
        elif name not in _NO_OBJECTS:
            text = f"additional data '{name}' are not read"
            self.report.add(
                "refused", self.source, text, name=item.get("name") or item.get("Name"), line=item.line
            )

    def _enter(self, parent: Draft, draft: Draft) -> None:
        parent.children.append(draft)
        self._remember(draft)

    def _remember(self, draft: Draft) -> None:
        waiting = [draft]
        while waiting:
            item = waiting.pop()
            if item.id is not None and self.by_id.setdefault(item.id, item) is not item:
                item.id = None
            waiting += item.children

    def _id(self, item: Element) -> str | None:
        if item.get("ObjectId"):
            return hex_id(item.get("ObjectId"))
        for name, inner in added(item):
            if name == "objectid":
                return hex_id(inner.text())
        return None

    def _draft(self, kind: str, item: Element, data: dict[str, Any] | None = None) -> Draft:
        return self._marked(
            Draft(kind, item.get("name"), data or {}, self.source, item.line, [], self._id(item)), item
        )

    def _marked(self, draft: Draft, item: Element) -> Draft:
        """The draft with the build properties of its element."""
        for name, inner in added(item):
            if name == "buildproperties":
                given = defaultdict(str, {part.tag: part.text() for part in inner})
                take_build_properties(draft, given.__getitem__, self.report)
        return draft

    # -- programming objects

    def pou(self, item: Element) -> Draft:
        """A `pou` element."""
        keyword = _KEYWORDS.get(item.get("pouType").lower(), "PROGRAM")
        draft = self._draft("pou", item, {"declaration": self._declaration(keyword, item)})
        draft.data |= self._body(item, draft.name)
        if not self.batch.complete:
            mark_without_result(draft, self.report)
        self._children(item, draft)
        return draft

    def _children(self, item: Element, draft: Draft) -> None:
        holders = [
            part for tag in ("actions", "transitions", "Methods", "Properties") for part in item.children(tag)
        ]
        for holder in (item, *holders):
            for part in holder:
                self._child(part, draft)
        for name, part in added(item):
            if name == "sfcsettings" and not _uses_flags(part):
                continue
            if not self._child(part, draft) and name not in _NO_OBJECTS:
                text = f"additional data '{name}' are not read"
                self.report.add("refused", self.source, text, name=draft.name, line=part.line)

    def _child(self, item: Element, owner: Draft) -> bool:
        tag = item.tag.lower()
        name = f"{owner.name}.{item.get('name')}"
        if tag in ("action", "transition"):
            child = self._draft(tag, item, self._body(item, name))
            if tag == "transition":
                text = "transitions belong to a drawn chart, which is kept with them"
                self.report.add("kept", self.source, text, name=name, line=item.line)
        elif tag == "method":
            child = self._draft("method", item, {"declaration": self._declaration("METHOD", item)})
            child.data |= self._body(item, name)
        elif tag == "property":
            child = self._draft("property", item, {"declaration": self._declaration("PROPERTY", item)})
            for accessor, title in (("GetAccessor", "Get"), ("SetAccessor", "Set")):
                for part in item.children(accessor):
                    data = {"declaration": self._local_declaration(part)} | self._body(
                        part, f"{name}.{title}"
                    )
                    made = Draft("accessor", title, data, self.source, part.line, [], self._id(part))
                    child.children.append(self._marked(made, part))
        else:
            return False
        owner.children.append(child)
        return True

    def _declaration(self, keyword: str, item: Element) -> str:
        text = plain_text(item)
        if text is not None:
            header = read_header(text)
            if header is None or header.keyword not in SECTIONS or self.batch.complete:
                return text
            return "\n".join([*head_lines(keyword, item), text])
        return "\n".join([*head_lines(keyword, item), *sections(item.child("interface"))])

    def _local_declaration(self, item: Element) -> str:
        text = plain_text(item)
        return text if text is not None else "\n".join(sections(item.child("interface")))

    def _body(self, item: Element, name: str) -> dict[str, Any]:
        """The implementation: text, or a graphical one as the XML that it is."""
        bodies = item.children("body")
        if not bodies:
            return body("ST", "")
        if len(bodies) == 1:
            for kind, inner in added(bodies[0]):
                if kind == "implementation" and inner.tag == "Implementation":
                    return body(inner.get("language", "ST"), exact_text(inner))
        parts = [part for found in bodies for part in found if part.tag not in ("documentation", "addData")]
        languages = {part.tag for part in parts}
        if not parts and not any(True for found in bodies for _ in added(found)):
            return body("ST", "")
        if len(languages) == 1 and is_plain_text(next(iter(languages))):
            language = languages.pop()
            text = "\n".join(exact_text(part) for part in parts)
            if self.matiec and language == "ST":
                text, notes = rewritten(text)
                for note in notes:
                    self.report.add("changed", self.source, note, name=name, line=item.line)
            return body(language, text)
        language = next((part.tag for part in parts if _is_graphical(part.tag)), "CFC")
        self._kept(item, name, language)
        if len(bodies) == 1:
            return body(language, xml_text(bodies[0]))
        worksheets: list[Element | str] = list(bodies)
        return body(language, xml_text(Element("bodies", content=worksheets)))

    def _kept(self, item: Element, name: str, language: str) -> None:
        text = f"the body in {language} is kept as it is; it cannot be compiled yet"
        self.report.add("kept", self.source, text, name=name, line=item.line)

    def data_type(self, item: Element) -> Draft:
        """A `dataType` element."""
        text = plain_text(item)
        return self._draft("dut", item, {"declaration": text if text is not None else data_type_text(item)})

    def interface(self, item: Element) -> Draft:
        """An `Interface` element."""
        text = plain_text(item)
        if text is None:
            text = "\n".join(head_lines("INTERFACE", item))
        draft = self._draft("interface", item, {"declaration": text})
        self._children(item, draft)
        return draft

    def variable_list(self, item: Element) -> Draft:
        """A `globalVars` element."""
        text = plain_text(item)
        if text is None:
            mixed = [part for name, held in added(item) if name == "mixedattrsvarlist" for part in held]
            lines = [line for part in mixed or [item] for line in section_lines(part, bool(mixed))]
            notes = [f"// {line}" for line in documentation(item).strip().split("\n") if line]
            pragmas = [line for line in head_lines("", item)[:-1] if line.startswith("{")]
            text = "\n".join([*notes, *pragmas, *lines])
        draft = self._draft("gvl", item, {"declaration": text})
        draft.name = draft.name or "Global_Variables"
        if item.get("persistent").lower() in ("true", "1") and draft.name.lower().startswith("persistent"):
            draft.kind = "persistent"
        for name, part in added(item):
            if name == "object" and _additional(part.get("kind")) == _LISTS:
                draft.kind = part.get("kind")
        return draft

    # -- devices and what we add ourselves

    def _configuration(self, item: Element) -> None:
        device = self._draft("device", item)
        device.name = device.name or "Device"
        self.devices.append(device)
        for name, part in added(item):
            if name == "object":
                device.data = _json(self.source, part)
            elif part.tag not in ("Device", "configurations"):
                self._added(name, part, device)
        self._remember(device)
        own = Draft("application", "", source=self.source)
        for part in item:
            if part.tag == "resource":
                self._resource(part, device)
            elif part.tag not in ("addData", "documentation"):
                self._element(part, own)
        logic = next((part for part in device.children if part.kind == "plc_logic"), None)
        if own.children:
            logic = logic or plc_logic(device)
            if not logic.children:
                logic.children.append(Draft("application", "Application", source=self.source))
            logic.children[0].children += own.children
        read_devices(self.source, item, logic.children[0] if logic and logic.children else None, self.report)
        for below in controllers_below(item):
            self._configuration(below)

    def _resource(self, item: Element, parent: Draft) -> None:
        application = self._draft("application", item)
        application.name = application.name or "Application"
        if parent.kind != DEVICE:
            parent = Draft("device", "Device", source=self.source, line=item.line)
            self.devices.append(parent)
        plc_logic(parent).children.append(application)
        self._remember(application)
        for part in item:
            if part.tag not in ("addData", "documentation"):
                self._element(part, application)
        for name, part in added(item):
            if name == "object":
                application.data = _json(self.source, part)
            else:
                self._added(name, part, application)

    def _generic(self, item: Element) -> None:
        draft = self._draft(item.get("kind"), item, _json(self.source, item))
        self.generic.append(draft)
        self._remember(draft)


def _readers() -> dict[str, Callable[[PlcopenReader, Element], Draft]]:
    """What reads an element, by its tag."""
    forms = [kind.plcopen for kind in kinds().values() if kind.plcopen is not None]
    return {tag: form.read for form in forms if form.read is not None for tag in form.tags}


def _additional(kind: str) -> str:
    """The additional data of CODESYS that hold objects of a kind; empty where it has none."""
    known = kinds().get(kind)
    return known.plcopen.data if known is not None and known.plcopen is not None else ""


def _fills(draft: Draft) -> bool:
    """Whether an object shows that the file keeps code in its application; lists are there in any case."""
    return draft.kind == FOLDER or _additional(draft.kind) not in ("", _LISTS)


def _uses_flags(settings: Element) -> bool:
    """Whether settings of SFC switch a flag on: without one they are what every chart has."""
    return any(item.get("Use").lower() == "true" for item in settings.walk())


def _json(source: str, item: Element) -> dict[str, Any]:
    try:
        data = json.loads(item.text() or "{}")
    except (ValueError, RecursionError) as error:
        raise ExchangeError(source, f"the data of '{item.get('name')}' are no JSON", item.line) from error
    if not isinstance(data, dict):
        raise ExchangeError(source, f"the data of '{item.get('name')}' should be a JSON object", item.line)
    return data


def _is_graphical(tag: str) -> bool:
    """Whether an element holds a body in a language that is drawn."""
    return tag in body_languages() and not is_plain_text(tag)
