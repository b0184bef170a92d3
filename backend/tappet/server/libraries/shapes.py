"""The installed libraries and their items (the shape of `tappet library show`)."""

from __future__ import annotations

from pydantic import Field

from tappet.server.shapes import Reply, Request
from tappet.translation.language import Language
from tappet.translation.library_comments import comment, table


class ParameterValue(Reply):
    """A value that a library asks for in one that it needs."""

    list: str = Field(description="The parameter list; empty: the parameter is known by its name alone.")
    name: str
    value: str


class RequiredLibrary(Reply):
    """A library that another one needs."""

    name: str
    version: str = Field(description="A version, or * for the one that the application refers to.")
    namespace: str = Field(description="Prefix of its names there; empty: its own.")
    qualified_only: bool = Field(description="Its names are used behind that prefix only.")
    parameters: list[ParameterValue] = Field(description="Values that it asks for.")


class LibrarySummary(Reply):
    """An installed library."""

    name: str
    version: str
    namespace: str
    qualified_only: bool = Field(description="Its names are used behind the namespace only.")
    company: str
    description: str
    removable: bool = Field(description="Installed besides those of the product.")
    requires: list[RequiredLibrary]
    replaces: list[str] = Field(description="Libraries of other systems that this one replaces.")


class Pin(Reply):
    """A parameter of a POU, or a member of a structure."""

    name: str
    type: str
    default: str
    comment: str


class NamedValue(Reply):
    """A value of an enumeration; `value` is empty where it counts on from the one before."""

    name: str
    value: str
    comment: str


class LibraryItem(Reply):
    """A POU or a type of a library."""

    name: str
    kind: str = Field(
        description="program, function, function_block, struct, union, enum, alias, interface, "
        "parameter_list."
    )
    summary: str
    inputs: list[Pin]
    outputs: list[Pin]
    in_out: list[Pin]
    members: list[Pin]
    values: list[NamedValue]
    returns: str | None
    methods: list[LibraryItem]

    def in_language(self, library: str, language: Language) -> LibraryItem:
        """The item of a library with comments in a language, as far as there are words for them."""
        if not table(library, language):
            return self
        changed: dict[str, object] = {"summary": comment(self.summary, library, language)}
        for field in ("inputs", "outputs", "in_out", "members", "values"):
            changed[field] = [
                part.model_copy(update={"comment": comment(part.comment, library, language)})
                for part in getattr(self, field)
            ]
        changed["methods"] = [method.in_language(library, language) for method in self.methods]
        return self.model_copy(update=changed)


class LibraryDetail(LibrarySummary):
    """A library with everything in it."""

    items: list[LibraryItem]


class LibraryUse(Reply):
    """A project that refers to a library."""

    project_id: str
    project_name: str
    version: str = Field(description="What the project asks for: a version, or * for the newest one.")


class LibrarySource(Reply):
    """The ST text of an item."""

    uri: str
    text: str


class NewLibrary(Request):
    """A project to be saved as a library."""

    name: str = Field(default="", max_length=80, description="That of the project when empty.")
    version: str = Field(description="Such as 1.2.0.0.", max_length=40)
    namespace: str = Field(default="", max_length=80, description="Prefix of its names; the name when empty.")
    qualified_only: bool = Field(default=False, description="Its names are used behind that prefix only.")
    company: str = Field(default="", max_length=200)
    description: str = Field(default="", max_length=4000)
