"""A project as PLCopen XML (TC6 0201): for other systems, and complete for our own import.

Every declaration stands there twice: as sections of variables, as the standard has it, and as plain text,
which CODESYS and our import prefer. Folders, order and ids are in CODESYS's project structure. What the
standard has no place for (devices, libraries, scenes) is in additional data of our own.
"""

from __future__ import annotations

import json
import uuid
from collections.abc import Iterator

from tappet.iec.languages import is_plain_text
from tappet.project.data import BodyData, DeclarationData
from tappet.project.durations import duration_ns
from tappet.project.exchange.declaration_sections import (
    Head,
    Notes,
    Section,
    read_head,
    read_sections,
    return_type,
)
from tappet.project.exchange.drafts import has_members
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
from tappet.project.kind_registry import kind_of
from tappet.project.kinds.accessor import AccessorData
from tappet.project.kinds.action import ActionData
from tappet.project.kinds.application import ApplicationData
from tappet.project.kinds.device import DeviceData
from tappet.project.kinds.method import MethodData
from tappet.project.kinds.task import TaskData
from tappet.project.model import APPLICATION, DEVICE, FOLDER, Project, ProjectObject
from tappet.project.object_kind import Plcopen

NAMESPACE = "http://www.plcopen.org/xml/tc6_0201"
_POU_TYPES = {"program": "program", "function": "function", "function_block": "functionBlock"}
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
    return PlcopenWriter(project).whole().encode()


class PlcopenWriter(XmlLines):
    """Writes a project; kinds write their objects with its parts."""

    def __init__(self, project: Project) -> None:
        super().__init__()
        self.project = project

    def whole(self) -> str:
        """The document."""
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
                    self._standard(pool, "dataTypes")
                with self.tag("pous"):
                    self._standard(pool, "pous")
            with self.tag("instances"), self.tag("configurations"):
                for device in project.find_kind(DEVICE):
                    self._device(device)
            with self.tag("addData"):
                self._added_code(pool)
                for item in project.walk():
                    if _form(item) is None:
                        self.object_data(item, item.data.model_dump(mode="json"))
                with self.data_of_codesys("projectstructure"), self.tag("ProjectStructure"):
                    self._structure()
        return "\n".join(self.lines) + "\n"

    # -- where objects stand

    def _application_of(self, item: ProjectObject) -> str | None:
        above = [found.id for found in self.project.ancestors(item.id) if found.kind == APPLICATION]
        return above[0] if above else None

    def _code(self, application_id: str | None) -> list[ProjectObject]:
        return [
            item
            for item in self.project.walk()
            if _is_code(item) and self._application_of(item) == application_id
        ]

    def _standard(self, items: list[ProjectObject], container: str) -> None:
        """The objects that the standard has this container for."""
        for item in items:
            form = _form(item)
            if form is not None and form.container == container and form.write is not None:
                form.write(self, item)

    def _added_code(self, items: list[ProjectObject], *, in_application: bool = False) -> None:
        """Objects in additional data: those that the standard has no place for, or none there."""
        for item in items:
            form = _form(item)
            if form is not None and form.write is not None and (in_application or not form.container):
                with self.data_of_codesys(form.data):
                    form.write(self, item)

    def _device(self, device: ProjectObject) -> None:
        assert isinstance(device.data, DeviceData)
        applications = [item for item in self.project.walk(device.id) if item.kind == APPLICATION]
        with self.tag("configuration", name=device.name):
            for application in applications:
                self._application(application)
            with self.tag("addData"):
                self.object_id(device)
                self.object_data(device, device.data.model_dump(mode="json"))

    def _application(self, application: ProjectObject) -> None:
        code = self._code(application.id)
        with self.tag("resource", name=application.name):
            for item in self.project.walk(application.id):
                if isinstance(item.data, TaskData) and self._application_of(item) == application.id:
                    self._task(item, item.data)
            with self.tag("addData"):
                self._added_code(code, in_application=True)
                self.object_id(application)
                if application.data != ApplicationData():
                    self.object_data(application, application.data.model_dump(mode="json"))

    def _structure(self, parent_id: str | None = None) -> None:
        for item in self.project.children(parent_id):
            tag = "Folder" if item.kind == FOLDER else "Object"
            if self.project.children(item.id):
                with self.tag(tag, Name=item.name, ObjectId=_guid(item.id)):
                    self._structure(item.id)
            else:
                self.empty(tag, Name=item.name, ObjectId=_guid(item.id))

    # -- programming objects

    def pou(self, item: ProjectObject) -> None:
        """A POU with its actions."""
        assert isinstance(item.data, BodyData)
        kind = _POU_TYPES.get(item.subkind or "", "program")
        children = list(self._members(item))
        actions = [child for child in children if isinstance(child.data, ActionData)]
        with self.tag("pou", name=item.name, pouType=kind):
            self.interface_of(item.data.declaration, kind == "function")
            if actions:
                with self.tag("actions"):
                    for action in actions:
                        assert isinstance(action.data, ActionData)
                        with self.tag("action", name=action.name):
                            self.body(action.data)
                            with self.tag("addData"):
                                self.build_properties(action)
                                self.object_id(action)
            self.body(item.data)
            with self.tag("addData"):
                self.plain_text(item.data.declaration)
                self._children(children)
                self.build_properties(item)
                self.object_id(item)

    def _members(self, item: ProjectObject) -> Iterator[ProjectObject]:
        """What is below a POU or interface, its folders included, but not below one of these again."""
        waiting = list(reversed(self.project.children(item.id)))
        while waiting:
            child = waiting.pop()
            yield child
            if not has_members(child.kind):
                waiting.extend(reversed(self.project.children(child.id)))

    def _children(self, children: list[ProjectObject]) -> None:
        for child in children:
            form = _form(child)
            if form is not None and form.member and form.write is not None:
                with self.data_of_codesys(form.data):
                    form.write(self, child)

    def method(self, item: ProjectObject) -> None:
        """A method."""
        data = item.data_as(MethodData)
        with self.tag("Method", name=item.name, ObjectId=_guid(item.id)):
            self.interface_of(data.declaration, True)
            self.body(data)
            self.plain_text_element(data.declaration)
            self.added_properties(item)

    def property(self, item: ProjectObject) -> None:
        """A property with its accessors."""
        data = item.data_as(DeclarationData)
        with self.tag("Property", name=item.name, ObjectId=_guid(item.id)):
            self.interface_of(data.declaration, True)
            for accessor in self._members(item):
                if isinstance(accessor.data, AccessorData):
                    with self.tag(f"{accessor.name}Accessor", ObjectId=_guid(accessor.id)):
                        self.interface_of(accessor.data.declaration, False)
                        self.body(accessor.data)
                        self.plain_text_element(accessor.data.declaration)
                        self.added_properties(accessor)
            self.plain_text_element(data.declaration)
            self.added_properties(item)

    def interface(self, item: ProjectObject) -> None:
        """An interface."""
        assert isinstance(item.data, DeclarationData)
        head = read_head(item.data.declaration)
        with self.tag("Interface", name=item.name, ObjectId=_guid(item.id)):
            self.plain_text_element(item.data.declaration)
            with self.tag("addData"):
                self._head_data(head)
                self._children(list(self._members(item)))
                self.build_properties(item)
            self._some(documentation_element(head.notes.comment))

    def data_type(self, item: ProjectObject) -> None:
        """A data type."""
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
                self.plain_text(item.data.declaration)
                self.build_properties(item)
                self.object_id(item)
            self._some(documentation_element(head.notes.comment))

    def variable_list(self, item: ProjectObject) -> None:
        """A list of variables."""
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
                self.plain_text(item.data.declaration)
                self.build_properties(item)
                self.object_id(item)
                with self._own_data(), self.tag("Object", kind=item.kind):
                    pass
            self._some(documentation_element(notes.comment))

    def _mixed(self, name: str, sections: list[Section]) -> None:
        """The sections of a list one by one, as CODESYS has them when their qualifiers differ."""
        with self.data_of_codesys("mixedattrsvarlist"), self.tag("MixedAttrsVarList"):
            for number, section in enumerate(sections):
                with self.tag("globalVars", name=name, **dict.fromkeys(section.flags, "true")):
                    self._variables(section)
                    if number:  # what stands before the first belongs to the list
                        with self.optional("addData"):
                            self._some(attributes_data(section.notes.attributes))

    # -- declarations and bodies

    def interface_of(self, declaration: str, returns: bool) -> None:
        """The variables of a declaration, section by section."""
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
                        with self.data_of_codesys(tag.lower()):
                            self._section(tag, section)
            self._some(documentation_element(head.notes.comment))

    def _section(self, tag: str, section: Section) -> None:
        with self.tag(tag, **dict.fromkeys(section.flags, "true")):
            self._variables(section)
            with self.optional("addData"):
                self._some(attributes_data(section.notes.attributes))

    def _head_data(self, head: Head, inheritance: str = "pouinheritance") -> None:
        if head.extends or head.implements:
            with self.data_of_codesys(inheritance), self.tag("Inheritance"):
                for tag, names in (("Extends", head.extends), ("Implements", head.implements)):
                    for name in names:
                        self.line(f"<{tag}>{escape_text(name)}</{tag}>")
        if head.modifiers:
            words = {word.capitalize(): "true" for word in head.modifiers}
            with self.data_of_codesys("accessmodifiers"):
                self.empty("AccessModifiers", **words)
        self._some(attributes_data(head.notes.attributes))

    def _variables(self, section: Section) -> None:
        for variable in section.variables:
            self.line(variable_element(variable))

    def _some(self, text: str) -> None:
        if text:
            self.line(text)

    def body(self, data: BodyData | ActionData) -> None:
        """An implementation."""
        text, language = data.implementation, data.language
        if is_plain_text(language):
            with self.tag("body"):
                self.text_element(language, text)
        elif _is_body(text):
            self.line(text)
        else:
            with self.tag("body"), self.tag("addData"), self.data_of_codesys("implementation"):
                self.text_element("Implementation", text, language=language)

    def plain_text(self, declaration: str) -> None:
        """A declaration as text, in additional data."""
        with self.data_of_codesys("interfaceasplaintext"):
            self.plain_text_element(declaration)

    def plain_text_element(self, declaration: str) -> None:
        """A declaration as text."""
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
                with self.data_of_codesys("tasksettings"):
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
                self.object_id(item)
                self.object_data(item, data.model_dump(mode="json"))

    def build_properties(self, item: ProjectObject) -> None:
        """That an object is excluded from the build."""
        if item.excluded:
            with self.data_of_codesys("buildproperties"), self.tag("BuildProperties"):
                self.line("<ExcludeFromBuild>true</ExcludeFromBuild>")

    def added_properties(self, item: ProjectObject) -> None:
        """The same as additional data."""
        if item.excluded:
            with self.tag("addData"):
                self.build_properties(item)

    def object_id(self, item: ProjectObject) -> None:
        """The id of an object."""
        with self.data_of_codesys("objectid", "discard"):
            self.line(f"<ObjectId>{_guid(item.id)}</ObjectId>")

    def object_data(self, item: ProjectObject, data: object) -> None:
        """Data of an object as additional data of our own."""
        text = json.dumps(data, sort_keys=True, ensure_ascii=True, allow_nan=False)
        place = f'name="{escape_attribute(item.name)}" kind="{item.kind}" ObjectId="{_guid(item.id)}"'
        with self._own_data():
            self.line(f"<Object {place}>{escape_text(text)}</Object>")

    # -- writing

    def _own_data(self) -> OpenElement:
        return self.tag("data", name=f"{TAPPET}object", handleUnknown="discard")

    def data_of_codesys(self, name: str, unknown: str = "implementation") -> OpenElement:
        """Additional data as CODESYS names them."""
        return self.tag("data", name=f"{CODESYS}{name}", handleUnknown=unknown)


def _form(item: ProjectObject) -> Plcopen | None:
    """The place of an object in the standard or in CODESYS's additions to it."""
    kind = kind_of(item)
    return kind.plcopen if kind is not None else None


def _is_code(item: ProjectObject) -> bool:
    form = _form(item)
    return form is not None and bool(form.data) and not form.member


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
