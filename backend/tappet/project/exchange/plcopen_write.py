"""A project as PLCopen XML (TC6 0201): for other systems, and complete for our own import.

Every declaration stands there twice: as sections of variables, as the standard has it, and as plain text,
which CODESYS and our import prefer. Folders, order and ids are in CODESYS's project structure. What the
standard has no place for (devices, libraries, scenes) is in additional data of our own.
"""

from __future__ import annotations

import json
import uuid
from collections.abc import Iterator

from tappet.project.data import (
    AccessorData,
    ActionData,
    ApplicationData,
    BodyData,
    DeclarationData,
    DeviceData,
    TaskData,
)
from tappet.project.durations import duration_ns
from tappet.project.exchange.declaration_sections import (
    Head,
    Notes,
    Section,
    read_head,
    read_sections,
    return_type,
)
from tappet.project.exchange.plcopen_declarations import CODESYS
from tappet.project.exchange.plcopen_read import PRODUCT, TAPPET
from tappet.project.exchange.plcopen_type_xml import (
    attributes_data,
    definition,
    documentation_element,
    enum_comments,
    type_element,
    value_element,
    variable_element,
)
from tappet.project.exchange.report import ExchangeError
from tappet.project.exchange.xml_lines import OpenElement, XmlLines
from tappet.project.exchange.xml_tree import (
    escape_attribute,
    escape_text,
    is_legal,
    read_xml,
    xml_text,
)
from tappet.project.model import Project, ProjectObject

NAMESPACE = "http://www.plcopen.org/xml/tc6_0201"
_POU_TYPES = {"program": "program", "function": "function", "function_block": "functionBlock"}
_CODE = frozenset(["pou", "dut", "gvl", "persistent", "interface"])
_SECTION_TAGS = {
    "VAR": "localVars",
    "VAR_TEMP": "tempVars",
    "VAR_INPUT": "inputVars",
    "VAR_OUTPUT": "outputVars",
    "VAR_IN_OUT": "inOutVars",
    "VAR_EXTERNAL": "externalVars",
}
_ADDED_SECTION_TAGS = {"VAR_STAT": "staticVars", "VAR_INST": "instVars"}
"""Sections that the standard does not have."""
_DATE = "1980-01-01T00:00:00"
"""Stands where the format wants a time, so that the same project always gives the same bytes."""


def write_plcopen(project: Project) -> bytes:
    """The project as one XML file; the same project always gives the same bytes."""
    return _Writer(project).whole().encode()


class _Writer(XmlLines):
    def __init__(self, project: Project) -> None:
        super().__init__()
        self.project = project

    def whole(self) -> str:
        project = self.project
        self.lines.append('<?xml version="1.0" encoding="utf-8"?>')
        with self.tag("project", xmlns=NAMESPACE):
            self.empty(
                "fileHeader",
                companyName="",
                productName=PRODUCT,
                productVersion="1",
                creationDateTime=_DATE,
            )
            with self.tag("contentHeader", name=project.name, modificationDateTime=_DATE):
                if project.description:
                    self.text_element("Comment", project.description, html=False)
                with self.tag("coordinateInfo"):
                    for language in ("fbd", "ld", "sfc"):
                        with self.tag(language):
                            self.empty("scaling", x="1", y="1")
            pool = [item for item in self._code(None) if not self._application_of(item)]
            with self.tag("types"):
                with self.tag("dataTypes"):
                    self._objects(pool, "dut")
                with self.tag("pous"):
                    self._objects(pool, "pou")
            with self.tag("instances"), self.tag("configurations"):
                for device in project.find_kind("device"):
                    self._device(device)
            with self.tag("addData"):
                self._added_code(pool)
                for item in project.walk():
                    if item.kind not in _OWN_PLACE:
                        self._object_data(item, item.data.model_dump(mode="json"))
                with self._data("projectstructure"), self.tag("ProjectStructure"):
                    self._structure()
        return "\n".join(self.lines) + "\n"

    # -- where objects stand

    def _application_of(self, item: ProjectObject) -> str | None:
        above = [found.id for found in self.project.ancestors(item.id) if found.kind == "application"]
        return above[0] if above else None

    def _code(self, application_id: str | None) -> list[ProjectObject]:
        return [
            item
            for item in self.project.walk()
            if item.kind in _CODE and self._application_of(item) == application_id
        ]

    def _objects(self, items: list[ProjectObject], kind: str) -> None:
        for item in items:
            if item.kind == kind:
                self._object(item)

    def _added_code(self, items: list[ProjectObject], kinds: tuple[str, ...] = ()) -> None:
        """Objects in additional data: lists and interfaces always, the others where `kinds` says so."""
        for item in items:
            if item.kind in ("gvl", "persistent"):
                with self._data("globalvars"):
                    self._object(item)
            elif item.kind == "interface" or item.kind in kinds:
                with self._data({"dut": "datatype"}.get(item.kind, item.kind)):
                    self._object(item)

    def _device(self, device: ProjectObject) -> None:
        assert isinstance(device.data, DeviceData)
        applications = [item for item in self.project.walk(device.id) if item.kind == "application"]
        with self.tag("configuration", name=device.name):
            for application in applications:
                self._application(application)
            with self.tag("addData"):
                self._object_id(device)
                self._object_data(device, device.data.model_dump(mode="json"))

    def _application(self, application: ProjectObject) -> None:
        code = self._code(application.id)
        with self.tag("resource", name=application.name):
            for item in self.project.walk(application.id):
                if isinstance(item.data, TaskData) and self._application_of(item) == application.id:
                    self._task(item, item.data)
            with self.tag("addData"):
                self._added_code(code, ("dut", "pou"))
                self._object_id(application)
                if application.data != ApplicationData():
                    self._object_data(application, application.data.model_dump(mode="json"))

    def _structure(self, parent_id: str | None = None) -> None:
        for item in self.project.children(parent_id):
            tag = "Folder" if item.kind == "folder" else "Object"
            if self.project.children(item.id):
                with self.tag(tag, Name=item.name, ObjectId=_guid(item.id)):
                    self._structure(item.id)
            else:
                self.empty(tag, Name=item.name, ObjectId=_guid(item.id))

    # -- programming objects

    def _object(self, item: ProjectObject) -> None:
        if item.kind == "dut":
            self._data_type(item)
        elif item.kind == "interface":
            self._interface(item)
        elif item.kind == "pou":
            self._pou(item)
        else:
            self._globals(item)

    def _pou(self, item: ProjectObject) -> None:
        assert isinstance(item.data, BodyData)
        kind = _POU_TYPES.get(item.subkind or "", "program")
        children = list(self._members(item))
        actions = [child for child in children if isinstance(child.data, ActionData)]
        with self.tag("pou", name=item.name, pouType=kind):
            self._interface_of(item.data.declaration, kind == "function")
            if actions:
                with self.tag("actions"):
                    for action in actions:
                        assert isinstance(action.data, ActionData)
                        with self.tag("action", name=action.name):
                            self._body(action.data)
                            with self.tag("addData"):
                                self._build_properties(action)
                                self._object_id(action)
            self._body(item.data)
            with self.tag("addData"):
                self._plain_text(item.data.declaration)
                self._children(children)
                self._build_properties(item)
                self._object_id(item)

    def _members(self, item: ProjectObject) -> Iterator[ProjectObject]:
        """What is below a POU or interface, its folders included, but not below one of these again."""
        waiting = list(reversed(self.project.children(item.id)))
        while waiting:
            child = waiting.pop()
            yield child
            if child.kind not in ("pou", "interface"):
                waiting.extend(reversed(self.project.children(child.id)))

    def _children(self, children: list[ProjectObject]) -> None:
        for child in children:
            data = child.data
            if child.kind == "method" and isinstance(data, BodyData):
                with self._data("method"), self.tag("Method", name=child.name, ObjectId=_guid(child.id)):
                    self._interface_of(data.declaration, True)
                    self._body(data)
                    self._plain_text_element(data.declaration)
                    self._added_properties(child)
            elif child.kind == "property" and isinstance(data, DeclarationData):
                with self._data("property"):
                    self._property(child, data)

    def _property(self, item: ProjectObject, data: DeclarationData) -> None:
        with self.tag("Property", name=item.name, ObjectId=_guid(item.id)):
            self._interface_of(data.declaration, True)
            for accessor in self._members(item):
                if isinstance(accessor.data, AccessorData):
                    with self.tag(f"{accessor.name}Accessor", ObjectId=_guid(accessor.id)):
                        self._interface_of(accessor.data.declaration, False)
                        self._body(accessor.data)
                        self._plain_text_element(accessor.data.declaration)
                        self._added_properties(accessor)
            self._plain_text_element(data.declaration)
            self._added_properties(item)

    def _interface(self, item: ProjectObject) -> None:
        assert isinstance(item.data, DeclarationData)
        head = read_head(item.data.declaration)
        with self.tag("Interface", name=item.name, ObjectId=_guid(item.id)):
            self._plain_text_element(item.data.declaration)
            with self.tag("addData"):
                self._head_data(head)
                self._children(list(self._members(item)))
                self._build_properties(item)
            self._some(documentation_element(head.notes.comment))

    def _data_type(self, item: ProjectObject) -> None:
        assert isinstance(item.data, DeclarationData)
        head = read_head(item.data.declaration)
        kind, initial = definition(item.data.declaration)
        with self.tag("dataType", name=item.name):
            self.line(type_element("baseType", kind))
            if initial:
                with self.tag("initialValue"):
                    self.line(value_element(initial))
            with self.tag("addData"):
                self._some(enum_comments(kind))
                self._head_data(head, "datatypeinheritance")
                self._plain_text(item.data.declaration)
                self._build_properties(item)
                self._object_id(item)
            self._some(documentation_element(head.notes.comment))

    def _globals(self, item: ProjectObject) -> None:
        assert isinstance(item.data, DeclarationData)
        sections = read_sections(item.data.declaration)
        flags = sections[0].flags if len(sections) == 1 else ()
        notes = sections[0].notes if sections else Notes()
        with self.tag("globalVars", name=item.name, **dict.fromkeys(flags, "true")):
            for section in sections:
                self._variables(section)
            with self.tag("addData"):
                if len(sections) > 1:
                    self._mixed(item.name, sections)
                self._some(attributes_data(notes.attributes))
                self._plain_text(item.data.declaration)
                self._build_properties(item)
                self._object_id(item)
                with self._own_data(), self.tag("Object", kind=item.kind):
                    pass
            self._some(documentation_element(notes.comment))

    def _mixed(self, name: str, sections: list[Section]) -> None:
        """The sections of a list one by one, as CODESYS has them when their qualifiers differ."""
        with self._data("mixedattrsvarlist"), self.tag("MixedAttrsVarList"):
            for number, section in enumerate(sections):
                with self.tag("globalVars", name=name, **dict.fromkeys(section.flags, "true")):
                    self._variables(section)
                    if number:  # what stands before the first belongs to the list
                        with self.optional("addData"):
                            self._some(attributes_data(section.notes.attributes))

    # -- declarations and bodies

    def _interface_of(self, declaration: str, returns: bool) -> None:
        kind = return_type(declaration) if returns else ""
        sections = read_sections(declaration)
        head = read_head(declaration)
        with self.tag("interface"):
            if kind:
                self.line(type_element("returnType", kind))
            for section in sections:
                if section.keyword in _SECTION_TAGS:
                    self._section(_SECTION_TAGS[section.keyword], section)
            with self.optional("addData"):
                self._head_data(head)
                for section in sections:
                    if section.keyword in _ADDED_SECTION_TAGS:
                        tag = _ADDED_SECTION_TAGS[section.keyword]
                        with self._data(tag.lower()):
                            self._section(tag, section)
            self._some(documentation_element(head.notes.comment))

    def _section(self, tag: str, section: Section) -> None:
        with self.tag(tag, **dict.fromkeys(section.flags, "true")):
            self._variables(section)
            with self.optional("addData"):
                self._some(attributes_data(section.notes.attributes))

    def _head_data(self, head: Head, inheritance: str = "pouinheritance") -> None:
        if head.extends or head.implements:
            with self._data(inheritance), self.tag("Inheritance"):
                for tag, names in (("Extends", head.extends), ("Implements", head.implements)):
                    for name in names:
                        self.line(f"<{tag}>{escape_text(name)}</{tag}>")
        if head.modifiers:
            words = {word.capitalize(): "true" for word in head.modifiers}
            with self._data("accessmodifiers"):
                self.empty("AccessModifiers", **words)
        self._some(attributes_data(head.notes.attributes))

    def _variables(self, section: Section) -> None:
        for variable in section.variables:
            self.line(variable_element(variable))

    def _some(self, text: str) -> None:
        if text:
            self.line(text)

    def _body(self, data: BodyData | ActionData) -> None:
        text, language = data.implementation, data.language
        if language in ("ST", "IL"):
            with self.tag("body"):
                self.text_element(language, text)
        elif _is_body(text):
            self.line(text)
        else:
            with self.tag("body"), self.tag("addData"), self._data("implementation"):
                self.text_element("Implementation", text, language=language)

    def _plain_text(self, declaration: str) -> None:
        with self._data("interfaceasplaintext"):
            self._plain_text_element(declaration)

    def _plain_text_element(self, declaration: str) -> None:
        self.text_element("InterfaceAsPlainText", declaration)

    # -- tasks and our own data

    def _task(self, item: ProjectObject, data: TaskData) -> None:
        kinds = {"external": "ExternalEvent"}
        cyclic = data.type == "cyclic"
        attributes = {"interval": _iso(data.interval)} if cyclic else {}
        if data.event and data.type == "event":
            attributes["single"] = data.event
        with self.tag("task", name=item.name, **attributes, priority=str(data.priority)):
            for call in data.pous:
                self.empty("pouInstance", name=call.name, typeName="")
            with self.tag("addData"):
                with self._data("tasksettings"):
                    times = {"Interval": data.interval} if cyclic else {}
                    kind = kinds.get(data.type, data.type.capitalize())
                    with self.tag("TaskSettings", KindOfTask=kind, **times):
                        watchdog = data.watchdog
                        self.empty(
                            "Watchdog",
                            Enabled=str(watchdog.enabled).lower(),
                            Time=watchdog.time,
                            Sensitivity=str(watchdog.sensitivity),
                        )
                self._object_id(item)
                self._object_data(item, data.model_dump(mode="json"))

    def _build_properties(self, item: ProjectObject) -> None:
        if item.excluded:
            with self._data("buildproperties"), self.tag("BuildProperties"):
                self.line("<ExcludeFromBuild>true</ExcludeFromBuild>")

    def _added_properties(self, item: ProjectObject) -> None:
        if item.excluded:
            with self.tag("addData"):
                self._build_properties(item)

    def _object_id(self, item: ProjectObject) -> None:
        with self._data("objectid", "discard"):
            self.line(f"<ObjectId>{_guid(item.id)}</ObjectId>")

    def _object_data(self, item: ProjectObject, data: object) -> None:
        text = json.dumps(data, sort_keys=True, ensure_ascii=True, allow_nan=False)
        place = f'name="{escape_attribute(item.name)}" kind="{item.kind}" ObjectId="{_guid(item.id)}"'
        with self._own_data():
            self.line(f"<Object {place}>{escape_text(text)}</Object>")

    # -- writing

    def _own_data(self) -> OpenElement:
        return self.tag("data", name=f"{TAPPET}object", handleUnknown="discard")

    def _data(self, name: str, unknown: str = "implementation") -> OpenElement:
        return self.tag("data", name=f"{CODESYS}{name}", handleUnknown=unknown)


_OWN_PLACE = frozenset(
    ["folder", "device", "application", "task", "method", "action", "property", "accessor", *_CODE]
)
"""Kinds that are written where the standard or CODESYS has a place for them."""


def _guid(object_id: str) -> str:
    return str(uuid.UUID(object_id))


def _iso(interval: str) -> str:
    seconds = duration_ns(interval) / 1e9
    return f"PT{seconds:.9f}".rstrip("0").rstrip(".") + "S"


def _is_body(text: str) -> bool:
    """Whether a graphical body is the XML that an import kept, and may stand as it is."""
    if not text.startswith("<body>") or not is_legal(text):
        return False
    try:
        root = read_xml("body", text.encode())
    except ExchangeError:
        return False
    return xml_text(root) == text
