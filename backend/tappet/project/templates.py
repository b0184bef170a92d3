"""What new objects begin with: declaration texts, children that come with them, and the new project."""

from __future__ import annotations

from tappet.project.data import (
    AccessorData,
    ActionData,
    ApplicationData,
    Data,
    DeclarationData,
    DeviceData,
    LibraryManagerData,
    LibraryReferenceData,
    MethodData,
    NoData,
    PouData,
    ProgramCall,
    TaskData,
)
from tappet.project.declaration_text import PARAMETER_LIST
from tappet.project.errors import InvalidDataError
from tappet.project.model import Project, ProjectObject, make_object, new_id
from tappet.project.placement import RULES
from tappet.project.scene import Scene

_POU_TEXTS = {
    "program": "PROGRAM {name}\nVAR\nEND_VAR",
    "function_block": ("FUNCTION_BLOCK {name}\nVAR_INPUT\nEND_VAR\nVAR_OUTPUT\nEND_VAR\nVAR\nEND_VAR"),
    "function": "FUNCTION {name} : BOOL\nVAR_INPUT\nEND_VAR\nVAR\nEND_VAR",
}
_DUT_TEXTS = {
    "struct": "TYPE {name} :\nSTRUCT\nEND_STRUCT\nEND_TYPE",
    "enum": "{{attribute 'qualified_only'}}\nTYPE {name} :\n(\n    enum_member := 0\n);\nEND_TYPE",
    "union": "TYPE {name} :\nUNION\nEND_UNION\nEND_TYPE",
    "alias": "TYPE {name} : INT;\nEND_TYPE",
    "subrange": "TYPE {name} : INT (0..100);\nEND_TYPE",
}
_LIST_TEXTS = {
    "variable_list": "VAR_GLOBAL\nEND_VAR",
    "parameter_list": (f"{{attribute 'qualified_only'}}\n{PARAMETER_LIST}\nVAR_GLOBAL CONSTANT\nEND_VAR"),
}
_DECLARATIONS = {
    "property": "PROPERTY {name} : BOOL",
    "interface": "INTERFACE {name}",
    "persistent": "VAR_GLOBAL PERSISTENT RETAIN\nEND_VAR",
}

DEFAULT_LIBRARIES = (LibraryReferenceData(name="Standard"),)
"""Libraries of a new application (PRJ-04)."""

DEFAULT_DEVICE = "Tappet Soft PLC"
"""Name of the device of a new project."""


def new_data(kind: str, name: str, subkind: str | None = None, language: str | None = None) -> Data:
    """The data of a new object. `subkind` chooses among the templates of POUs and DUTs, the first by default;
    `language` is the one of its body (FBD-02).

    Raises InvalidDataError for a subkind or a language that the kind does not have.
    """
    data = _template(kind, name, subkind)
    if language is None:
        return data
    offered = RULES[kind].languages if kind in RULES else ()
    if language not in offered:
        possible = ", ".join(offered) or "none"
        raise InvalidDataError(f"A new {kind} cannot be written in '{language}'; possible: {possible}")
    return data.model_copy(update={"language": language})


def _template(kind: str, name: str, subkind: str | None) -> Data:
    subkinds = RULES[kind].subkinds if kind in RULES else ()
    if subkind is not None and subkind not in subkinds:
        offered = ", ".join(subkinds) or "none"
        raise InvalidDataError(f"A new {kind} cannot be a '{subkind}'; possible: {offered}")
    if kind == "pou":
        return PouData(declaration=_POU_TEXTS[subkind or subkinds[0]].format(name=name))
    if kind == "dut":
        return DeclarationData(declaration=_DUT_TEXTS[subkind or subkinds[0]].format(name=name))
    if kind == "gvl":
        return DeclarationData(declaration=_LIST_TEXTS[subkind or subkinds[0]])
    if kind == "method":
        return MethodData(declaration=f"METHOD {name} : BOOL\nVAR_INPUT\nEND_VAR")
    if kind == "library_manager":
        return LibraryManagerData(references=DEFAULT_LIBRARIES)
    if kind in _DECLARATIONS:
        return DeclarationData(declaration=_DECLARATIONS[kind].format(name=name))
    return _DEFAULTS.get(kind, NoData)()


def children_of_new(kind: str) -> tuple[tuple[str, str], ...]:
    """Kinds and names of the objects that come with a new object of this kind."""
    return _CHILDREN.get(kind, ())


_DEFAULTS: dict[str, type[Data]] = {
    "device": DeviceData,
    "application": ApplicationData,
    "action": ActionData,
    "accessor": AccessorData,
    "task": TaskData,
    "scene": Scene,
}
_CHILDREN = {
    "device": (("plc_logic", "PLC Logic"),),
    "plc_logic": (("application", "Application"),),
    "application": (
        ("library_manager", "Library Manager"),
        ("task_configuration", "Task Configuration"),
    ),
    "property": (("accessor", "Get"), ("accessor", "Set")),
}


def new_project(name: str, description: str = "") -> Project:
    """A project with one soft PLC, PLC_PRG and the cyclic MainTask that calls it (POU-07)."""
    objects: dict[str, ProjectObject] = {}

    def add(
        parent: ProjectObject | None, kind: str, object_name: str, index: int, data: Data
    ) -> ProjectObject:
        item = make_object(
            id=new_id(),
            parent_id=parent.id if parent else None,
            kind=kind,
            name=object_name,
            index=index,
            data=data,
        )
        objects[item.id] = item
        return item

    device = add(None, "device", DEFAULT_DEVICE, 0, DeviceData())
    logic = add(device, "plc_logic", "PLC Logic", 0, NoData())
    application = add(logic, "application", "Application", 0, ApplicationData())
    libraries = new_data("library_manager", "Library Manager")
    add(application, "library_manager", "Library Manager", 0, libraries)
    add(application, "pou", "PLC_PRG", 1, new_data("pou", "PLC_PRG"))
    tasks = add(application, "task_configuration", "Task Configuration", 2, NoData())
    add(tasks, "task", "MainTask", 0, TaskData(pous=(ProgramCall(name="PLC_PRG"),)))
    return Project(name=name, description=description, objects=objects)
