"""The descriptor of a kind of project object: one value that says all there is to say of the kind.

Contract: a module of `kinds`, or a plug-in by an entry point of the group `tappet.kinds`, holds one
`ObjectKind`. What the tree, the store, the folder format, the exchange formats, the compiler and the REST API
need to know of a kind they ask its descriptor; none of them keeps a list of kinds. Fields with defaults may
be left out: a kind of plain data needs a name, words, a data model, a place and a template. Functions of a
descriptor are pure and do not raise; they get data of the kind's own model, never data that did not validate.

Cost: a descriptor is made once when the kinds are first asked for (see `kind_registry`), so a module of a
kind imports nothing that takes long; a function that needs such a thing imports it itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Generic, Literal, TypeVar, cast

from tappet.iec.sections import rename_header
from tappet.iec.task import Task
from tappet.project.data import BodyData, Data, DeclarationData
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.source_text import SourceWriter

DEVICES_VIEW = "devices_view"
"""Stands among the parents of a kind for the root of the Devices view."""
POUS_VIEW = "pous_view"
"""Stands among the parents of a kind for the root of the POUs view."""
ANY_SUBKIND = "*"
"""In the name of a place: whatever the parent's declaration says."""
IN_FOLDER = "/"
"""At the end of the name of a place: in a folder there."""
CODE_PLACES = ("application", POUS_VIEW)
"""Where code of an application, or of all applications, may be."""

D = TypeVar("D", bound=Data)
NameStyle = Literal["identifier", "free", "fixed"]


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Where objects of a kind may be."""

    parents: tuple[str, ...]
    """Kinds of parent, `DEVICES_VIEW`, `POUS_VIEW`. The first is the one that messages advise."""
    parent_subkinds: tuple[str, ...] = ()
    """Where the parent's declaration says what it is: what it may be; empty means anything."""
    in_folders: bool = True
    """May stand in a folder of such a parent."""
    once: bool = False
    """At most one below one parent, its folders included."""

    @cached_property
    def places(self) -> frozenset[str]:
        """The same as a table: `pou.program`, `application.*`, and `application.*/` for a folder in one."""
        subkinds = ("", *self.parent_subkinds) if self.parent_subkinds else (ANY_SUBKIND,)
        endings = ("", IN_FOLDER) if self.in_folders else ("",)
        return frozenset(
            f"{parent}.{subkind}{ending}"
            for parent in self.parents
            for subkind in subkinds
            for ending in endings
        )

    def accepts(self, parent: str, subkind: str | None, in_folder: bool) -> bool:
        """Whether objects may be below a parent, or in a folder below it: a look into the table."""
        ending = IN_FOLDER if in_folder else ""
        return any(f"{parent}.{one}{ending}" in self.places for one in (subkind or "", ANY_SUBKIND))


@dataclass(frozen=True, kw_only=True)
class Naming:
    """How objects of a kind may be named."""

    style: NameStyle = "identifier"
    """An identifier, free text, or one of `names`."""
    names: tuple[str, ...] = ()
    """The possible names where they are fixed."""
    proposal: str = ""
    """The name that the dialog proposes."""
    first: str = ""
    """The name that it proposes for the first object of the kind in an application."""
    unique: Literal["scope", "place"] = "scope"
    """Unique in the application or POUs view, across folders, because code refers to it by name alone; or
    among the siblings only."""
    from_imports: Literal["exact", "adapted"] = "exact"
    """Whether an import may adapt an impossible name, because nothing refers to the object by it."""


@dataclass(frozen=True, slots=True)
class Child:
    """An object that comes with a new one."""

    kind: str
    name: str


@dataclass(frozen=True, slots=True)
class Renaming:
    """An object that got another name."""

    kind: str
    subkind: str | None
    old: str
    new: str


@dataclass(frozen=True, kw_only=True)
class Compiled(Generic[D]):
    """What objects of a kind give the compiler; nothing by default."""

    source: Callable[[Project, ProjectObject, SourceWriter], None] | None = None
    """Writes the text of an object, of nothing but the object and what is below it; only for kinds whose data
    are `CodeData`."""
    members: Literal["none", "beside", "inside"] = "none"
    """Whether what is below an object are its members, and where they stand in a text of the whole object."""
    in_parent: bool = False
    """The text is a part of the parent's, whose `source` writes it."""
    in_library: bool = False
    """A library made of the project holds the object, and an export as ST texts."""
    task: Callable[[ProjectObject], Task] | None = None
    """The task that an object is; only for objects below an application."""
    around_tasks: Callable[[Project, ProjectObject, Sequence[Task], SourceWriter], list[Task]] | None = None
    """The tasks of the application with what an object has them call around their programs; writes the text
    of the programs that are called. In tree order; only for objects of an application."""
    variable_in: tuple[str, ...] = ()
    """The lists in which the object is a global variable of its name, `{name}` in theirs being that name;
    texts follow when it is renamed."""
    variable_endings: tuple[str, ...] = ("",)
    """What is behind that name in the names of all variables that the object is."""
    together: Callable[[Project, Sequence[ProjectObject], SourceWriter], None] | None = None
    """Writes one text for all objects of the kind that an application sees, in tree order, its own first."""
    libraries: Callable[[D, str], Iterable[LibraryReference]] | None = None
    """The libraries that an object needs or lists, from its data and its path in the tree."""


@dataclass(frozen=True, kw_only=True)
class JsonFile:
    """The folder format of a kind whose data are `<name>.<kind>.json`."""

    optional: bool = False
    """No file is needed as long as all data are as they are by default."""
    texts: Mapping[str, str] = field(default_factory=dict)
    """Data fields that are text files of their own beside the JSON, `<name>.<ending>`, by field: the
    ending."""
    flat: bool = False
    """Objects that hold no lists and no other objects stand in one line each, like rows of a table."""


@dataclass(frozen=True, kw_only=True)
class IecText:
    """The folder format of a kind whose data are one plain IEC text, `<name>.st`.

    The text is `opening`, the declaration, the implementation and `end`, each from a line of its own.
    """

    declaration: bool = True
    implementation: bool = False
    opening: Callable[[str], str] | None = None
    """The first line, from the object's name, where the declaration does not name it."""
    end: Callable[[str, str], str | None] | None = None
    """The last line, from the name and the declaration."""
    declared_as: tuple[str, ...] = ()
    """What `iec.sections.subkind_of` says of a text of this kind: a file that no index lists is of it."""
    claims: Callable[[str], bool] | None = None
    """Of kinds that are declared in the same way: whether a text is of this one; None: the rest is."""


@dataclass(frozen=True, kw_only=True)
class Merging(Generic[D]):
    """What an import does with an object whose like is at its place already: its content goes into that
    one."""

    by_name: bool = False
    """The like has the same name; otherwise it is the one of the kind that is there."""
    join: Callable[[D, Mapping[str, Any]], Mapping[str, Any]] | None = None
    """The data of the one that is there, joined with those that are imported; None: they stay."""
    note: str = ""
    """What the report says of joined data; `{name}` is the one that was there."""


@dataclass(frozen=True, kw_only=True)
class Plcopen:
    """The place of a kind in PLCopen XML.

    Objects of a kind without one are written, and read again, complete as additional data of our own.
    """

    tags: tuple[str, ...] = ()
    """Elements that are such an object wherever they stand."""
    read: Callable[[Any, Any], Any] | None = None
    """From `plcopen_read.PlcopenReader` and such an `Element` to a `Draft`."""
    write: Callable[[Any, ProjectObject], None] | None = None
    """Writes the element with a `plcopen_write.PlcopenWriter`; None: the one of another object holds it."""
    container: str = ""
    """Element of `types` that holds objects of no application."""
    data: str = ""
    """Name of CODESYS's additional data that hold the element elsewhere."""
    member: bool = False
    """Stands in the additional data of the POU or interface it belongs to."""


@dataclass(frozen=True, kw_only=True)
class TwinCat:
    """The element of TwinCAT's files that is an object of a kind; texts are read as the data have them."""

    tag: str
    other_tags: tuple[str, ...] = ()
    """Of elements that are read as this kind, too."""
    not_read: Mapping[str, str] = field(default_factory=dict)
    """Parts of such elements that are left out, by tag, with what the report says about it."""
    member: bool = False
    """Stands in the element of its owner."""
    read: Callable[[Any, Any], None] | None = None
    """Reads what is more than texts, from `twincat.TwinCatElement` into a `Draft`."""


@dataclass(frozen=True, kw_only=True)
class Codesys:
    """What CODESYS's export files hold of a kind; texts are read as the data have them."""

    type_ids: tuple[str, ...]
    """The ids of the types of such objects, as 32 hexadecimal digits."""
    read: Callable[[Any, Any, Any], None] | None = None
    """Reads what is more than texts, with `codesys_native.NativeReader` from an `Entry` into a `Draft`."""


@dataclass(frozen=True, kw_only=True)
class ObjectKind(Generic[D]):
    """A kind of project object."""

    name: str
    """Lower case with underscores; stands in the database and in files, so it never changes."""
    words: str
    """What messages call an object of this kind: `POU`, `task configuration`."""
    description: str
    """One sentence, for the API document."""
    data: type[D]
    """The model of the data; all fields have defaults."""
    placement: Placement
    naming: Naming = Naming()
    order: int = 1000
    """Where the kind stands in the dialog that adds objects; smaller ones first."""
    templates: Mapping[str, Callable[[str], D]] = field(default_factory=dict)
    """The data of a new object, from its name, by subkind; the first is usual. Empty: the data's defaults."""
    new: Callable[[str], D] | None = None
    """The same for a kind without subkinds."""
    written: bool = False
    """The data hold a body in a language; that of a new object can be in any language that is offered."""
    children: tuple[Child, ...] = ()
    """Objects that come with a new one."""
    companion: str = ""
    """The kind of which one object stands below the owner as long as there are objects of this kind: it
    comes with the first and is not deleted before the last."""
    compiled: Compiled[D] = field(default_factory=lambda: Compiled[D]())
    renamed: Callable[[D, str], D] | None = None
    """The data of an object that gets another name, where the name stands in them."""
    follow: Callable[[D, Renaming], D] | None = None
    """The data of an object of this kind after another one of its application was renamed."""
    folder: JsonFile | IecText = JsonFile()
    plcopen: Plcopen | None = None
    twincat: TwinCat | None = None
    codesys: Codesys | None = None
    merging: Merging[D] | None = None
    reported: bool = False
    """A report of an import names each object, not just what was changed in it."""


def with_header_name(data: D, name: str) -> D:
    """The data with another name in the header of the declaration."""
    assert isinstance(data, BodyData | DeclarationData)
    text = rename_header(data.declaration, name)
    return cast("D", data.model_copy(update={"declaration": text}))
