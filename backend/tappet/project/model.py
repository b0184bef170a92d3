"""What a project is: a tree of objects, each of a kind with its own data (CON-05, PRJ-01).

Everything here is a frozen value. `edit` makes changed projects from it; `placement` says what may be where.
"""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Annotated, Any, Literal

from pydantic import (
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    StrictInt,
    Tag,
    TypeAdapter,
    ValidationError,
)

from tappet.project.data import (
    AccessorData,
    ActionData,
    ApplicationData,
    CodeData,
    DeclarationData,
    DeviceData,
    LibraryManagerData,
    MethodData,
    NoData,
    PouData,
    TaskData,
    UnknownData,
)
from tappet.project.declaration_text import is_parameter_list, subkind_of
from tappet.project.errors import InvalidDataError, UnknownObjectError
from tappet.project.naming import name_key
from tappet.project.scene import Scene


class ObjectHead(BaseModel):
    """What every object has."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: str = Field(pattern=r"^[0-9a-f]{32}$", description="uuid4 as 32 hexadecimal digits.")
    parent_id: str | None = Field(
        default=None, description="None for the roots of the Devices and the POUs view."
    )
    kind: str = Field(min_length=1, max_length=64, pattern=r"^[a-z][a-z0-9_]*$")
    name: str = Field(min_length=1)
    index: StrictInt = Field(
        0, ge=0, description="Order among the children of one parent (roots: of one view), from 0."
    )
    revision: StrictInt = Field(
        0, ge=0, description="Number of the last save in the store; 0 = never stored."
    )
    data: BaseModel

    @property
    def subkind(self) -> str | None:
        """What the declaration text says this is (`program`, `struct` ...), None where kind says it all."""
        return None

    @property
    def excluded(self) -> bool:
        """The compiler does not get this object, nor what is below it."""
        return isinstance(self.data, CodeData) and self.data.exclude_from_build


class FolderObject(ObjectHead):
    """Groups objects; says nothing to the compiler."""

    kind: Literal["folder"] = "folder"
    data: NoData = NoData()


class DeviceObject(ObjectHead):
    """A device of the Devices view."""

    kind: Literal["device"] = "device"
    data: DeviceData = DeviceData()


class PlcLogicObject(ObjectHead):
    """The node below a programmable device that holds its applications."""

    kind: Literal["plc_logic"] = "plc_logic"
    data: NoData = NoData()


class ApplicationObject(ObjectHead):
    """An application: what is compiled and downloaded as one."""

    kind: Literal["application"] = "application"
    data: ApplicationData = ApplicationData()


class PouObject(ObjectHead):
    """A program, function block or function."""

    kind: Literal["pou"] = "pou"
    data: PouData = PouData()

    @property
    def subkind(self) -> str | None:
        """Of program, function_block, function; None while the declaration says nothing."""
        return subkind_of(self.data.declaration)


class MethodObject(ObjectHead):
    """A method."""

    kind: Literal["method"] = "method"
    data: MethodData = MethodData()


class ActionObject(ObjectHead):
    """An action."""

    kind: Literal["action"] = "action"
    data: ActionData = ActionData()


class PropertyObject(ObjectHead):
    """A property; its accessors are its children."""

    kind: Literal["property"] = "property"
    data: DeclarationData = DeclarationData()


class AccessorObject(ObjectHead):
    """Get or Set of a property."""

    kind: Literal["accessor"] = "accessor"
    data: AccessorData = AccessorData()


class InterfaceObject(ObjectHead):
    """An interface; its methods and properties are its children."""

    kind: Literal["interface"] = "interface"
    data: DeclarationData = DeclarationData()


class DutObject(ObjectHead):
    """A data unit type: structure, enumeration, alias, union, subrange (DUT-03)."""

    kind: Literal["dut"] = "dut"
    data: DeclarationData = DeclarationData()

    @property
    def subkind(self) -> str | None:
        """Of struct, enum, union, alias, subrange; None while the declaration says nothing."""
        return subkind_of(self.data.declaration)


class GvlObject(ObjectHead):
    """A global variable list (GVL-01), or the parameter list of a library."""

    kind: Literal["gvl"] = "gvl"
    data: DeclarationData = DeclarationData()

    @property
    def subkind(self) -> str | None:
        """Of parameter_list; None for other lists."""
        return "parameter_list" if is_parameter_list(self.data.declaration) else None


class PersistentObject(ObjectHead):
    """The list of persistent variables of an application (PERS-02)."""

    kind: Literal["persistent"] = "persistent"
    data: DeclarationData = DeclarationData()


class TaskConfigurationObject(ObjectHead):
    """Holds the tasks of an application (TASK-01)."""

    kind: Literal["task_configuration"] = "task_configuration"
    data: NoData = NoData()


class TaskObject(ObjectHead):
    """A task."""

    kind: Literal["task"] = "task"
    data: TaskData = TaskData()


class LibraryManagerObject(ObjectHead):
    """The list of libraries of an application or of the POUs view (LIB-01)."""

    kind: Literal["library_manager"] = "library_manager"
    data: LibraryManagerData = LibraryManagerData()


class SceneObject(ObjectHead):
    """A 3D scene of the machine, bound to variables of the application."""

    kind: Literal["scene"] = "scene"
    data: Scene = Scene()


class UnknownObjectKind(ObjectHead):
    """An object of a plug-in that is not installed; shown as such and kept unchanged (CON-03)."""

    data: UnknownData = UnknownData()


KIND_CLASSES: Mapping[str, type[ObjectHead]] = MappingProxyType(
    {
        "folder": FolderObject,
        "device": DeviceObject,
        "plc_logic": PlcLogicObject,
        "application": ApplicationObject,
        "pou": PouObject,
        "method": MethodObject,
        "action": ActionObject,
        "property": PropertyObject,
        "accessor": AccessorObject,
        "interface": InterfaceObject,
        "dut": DutObject,
        "gvl": GvlObject,
        "persistent": PersistentObject,
        "task_configuration": TaskConfigurationObject,
        "task": TaskObject,
        "library_manager": LibraryManagerObject,
        "scene": SceneObject,
    }
)
"""The class of each kind that is installed."""


def _tag(value: Any) -> str:
    kind = value.get("kind") if isinstance(value, dict) else getattr(value, "kind", None)
    return kind if isinstance(kind, str) and kind in KIND_CLASSES else "unknown"


ProjectObject = Annotated[
    Annotated[FolderObject, Tag("folder")]
    | Annotated[DeviceObject, Tag("device")]
    | Annotated[PlcLogicObject, Tag("plc_logic")]
    | Annotated[ApplicationObject, Tag("application")]
    | Annotated[PouObject, Tag("pou")]
    | Annotated[MethodObject, Tag("method")]
    | Annotated[ActionObject, Tag("action")]
    | Annotated[PropertyObject, Tag("property")]
    | Annotated[AccessorObject, Tag("accessor")]
    | Annotated[InterfaceObject, Tag("interface")]
    | Annotated[DutObject, Tag("dut")]
    | Annotated[GvlObject, Tag("gvl")]
    | Annotated[PersistentObject, Tag("persistent")]
    | Annotated[TaskConfigurationObject, Tag("task_configuration")]
    | Annotated[TaskObject, Tag("task")]
    | Annotated[LibraryManagerObject, Tag("library_manager")]
    | Annotated[SceneObject, Tag("scene")]
    | Annotated[UnknownObjectKind, Tag("unknown")],
    Discriminator(_tag),
]
"""Any object, told apart by `kind`; a kind that is not known here is an UnknownObjectKind."""

_ANY_OBJECT: TypeAdapter[ProjectObject] = TypeAdapter(ProjectObject)


def new_id() -> str:
    """A fresh object id."""
    return uuid.uuid4().hex


def make_object(**fields: Any) -> ProjectObject:
    """The object of the class that `kind` names. Raises InvalidDataError naming each wrong field."""
    try:
        return _ANY_OBJECT.validate_python(fields)
    except ValidationError as error:
        kind, name = fields.get("kind", "?"), fields.get("name", "?")
        raise InvalidDataError(f"{kind} '{name}': {describe(error)}") from error


def changed_object(item: ProjectObject, **fields: Any) -> ProjectObject:
    """The object with other fields; `data` may be a dict of the kind's data. Raises InvalidDataError."""
    kept = {name: getattr(item, name) for name in ObjectHead.model_fields}
    return make_object(**(kept | fields))


def describe(error: ValidationError) -> str:
    """The first problems of a validation as one line: `watchdog.time: 'abc' is no time ...`."""
    lines = []
    for problem in error.errors(include_url=False, include_input=False)[:5]:
        place = [str(part) for part in problem["loc"] if part not in KIND_CLASSES and part != "unknown"]
        if place[:1] == ["data"] and len(place) > 1:
            place = place[1:]
        message = problem["msg"].removeprefix("Value error, ")
        lines.append(f"{'.'.join(place)}: {message}" if place else message)
    return "; ".join(lines)


def is_pous_root(parent_id: str | None, kind: str) -> bool:
    """Whether an object is a root of the POUs view; the roots of the two views are counted apart."""
    return parent_id is None and kind != "device"


@dataclass(frozen=True)
class Project:
    """A project: its name and its objects by id. A value: `edit` returns changed copies."""

    name: str
    description: str = ""
    objects: Mapping[str, ProjectObject] = field(default_factory=dict)
    extra_files: Mapping[str, bytes] = field(default_factory=dict)
    """Files of the project folder that are no objects (README.md, drawings), by path; kept as they are."""

    @cached_property
    def _children(self) -> dict[str | None, list[ProjectObject]]:
        children: dict[str | None, list[ProjectObject]] = {}
        for item in self.objects.values():
            children.setdefault(item.parent_id, []).append(item)
        for siblings in children.values():
            siblings.sort(
                key=lambda item: (
                    is_pous_root(item.parent_id, item.kind),
                    item.index,
                    name_key(item.name),
                    item.id,
                )
            )
        return children

    def get(self, object_id: str) -> ProjectObject:
        """The object with this id. Raises UnknownObjectError."""
        try:
            return self.objects[object_id]
        except KeyError:
            raise UnknownObjectError(
                f"The project '{self.name}' has no object with the id {object_id}"
            ) from None

    def children(self, object_id: str | None) -> list[ProjectObject]:
        """The children of an object in their order; of None the roots of both views, devices first."""
        return list(self._children.get(object_id, ()))

    def siblings(self, parent_id: str | None, kind: str) -> list[ProjectObject]:
        """The objects among which one of this kind below `parent_id` is counted by its index."""
        view = is_pous_root(parent_id, kind)
        return [
            item for item in self._children.get(parent_id, ()) if is_pous_root(parent_id, item.kind) == view
        ]

    def child(self, object_id: str | None, name: str) -> ProjectObject | None:
        """The child with this name in any case, None when there is none."""
        key = name_key(name)
        return next((item for item in self._children.get(object_id, ()) if name_key(item.name) == key), None)

    def walk(self, object_id: str | None = None) -> Iterator[ProjectObject]:
        """The objects below an object (of None: all), depth first, in tree order."""
        waiting = list(reversed(self._children.get(object_id, ())))
        while waiting:
            item = waiting.pop()
            yield item
            waiting.extend(reversed(self._children.get(item.id, ())))

    def ancestors(self, object_id: str) -> Iterator[ProjectObject]:
        """The parent of an object, its parent, and so on up to a root."""
        parent_id = self.get(object_id).parent_id
        while parent_id is not None:
            parent = self.get(parent_id)
            yield parent
            parent_id = parent.parent_id

    def path_of(self, object_id: str) -> str:
        """Names from the root to the object, joined by `/`: `PLC/PLC Logic/Application/PLC_PRG`."""
        names = [self.get(object_id).name, *(item.name for item in self.ancestors(object_id))]
        return "/".join(reversed(names))

    def find(self, path: str) -> ProjectObject | None:
        """The object at a path as `path_of` gives it, in any case; None when there is none."""
        found: list[ProjectObject | None] = [None]
        for name in path.split("/"):
            key = name_key(name)
            found = [
                child
                for parent in found
                for child in self._children.get(parent.id if parent else None, ())
                if name_key(child.name) == key
            ]
        return found[0] if found and path else None

    def find_kind(self, kind: str) -> list[ProjectObject]:
        """All objects of a kind, in tree order."""
        return [item for item in self.walk() if item.kind == kind]

    def applications(self) -> list[ProjectObject]:
        """All applications, in tree order."""
        return self.find_kind("application")
