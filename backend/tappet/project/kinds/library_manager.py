"""The library manager: the libraries of an application or of the POUs view (LIB-01)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from pydantic import Field, model_validator

from tappet.project.data import Data, Line
from tappet.project.library_reference import LibraryReference, ParameterValue
from tappet.project.naming import name_key
from tappet.project.object_kind import CODE_PLACES, Codesys, Compiled, Merging, Naming, ObjectKind, Placement


class LibraryParameterData(Data):
    """A value that a library reference gives to a parameter of the library, in place of the library's own."""

    list: Line = Field(
        default="", description="The parameter list; empty: the parameter is known by its name alone."
    )
    name: Line = Field(min_length=1)
    value: Line = Field(min_length=1, description="A constant expression of the type of the parameter.")


class LibraryReferenceData(Data):
    """A library that an application uses (LIB-02, LIB-08)."""

    name: Line = Field(min_length=1, description="The library; of a placeholder, what it is resolved by.")
    placeholder: Annotated[Line, Field(min_length=1)] | None = Field(
        default=None,
        description="Name of the placeholder: libraries that ask for it get this library.",
        exclude_if=lambda placeholder: placeholder is None,
    )
    version: Line = Field(
        default="*", min_length=1, description="A version, or * for the newest installed one."
    )
    namespace: Line = Field(
        default="", description="Prefix of the library's names; empty means its own namespace."
    )
    qualified_only: bool = Field(
        default=False,
        description="Names of the library are used behind the namespace only, also where the library itself "
        "allows them without.",
        exclude_if=lambda qualified_only: not qualified_only,
    )
    parameters: tuple[LibraryParameterData, ...] = Field(
        default=(),
        description="Parameters of the library that have another value here.",
        exclude_if=lambda parameters: not parameters,
    )

    @model_validator(mode="after")
    def _one_value_each(self) -> LibraryReferenceData:
        seen = set()
        for parameter in self.parameters:
            key = (parameter.list.upper(), parameter.name.upper())
            if key in seen:
                name = f"{parameter.list}.{parameter.name}".strip(".")
                raise ValueError(f"the parameter '{name}' of '{self.name}' has two values; one holds")
            seen.add(key)
        return self


class LibraryManagerData(Data):
    """The libraries of one application or of the POUs view."""

    references: tuple[LibraryReferenceData, ...] = ()


DEFAULT_LIBRARIES = (LibraryReferenceData(name="Standard"),)
"""Libraries of a new application (PRJ-04)."""


def _references(data: LibraryManagerData, place: str) -> list[LibraryReference]:
    return [_reference(reference, place) for reference in data.references]


def _reference(data: LibraryReferenceData, place: str) -> LibraryReference:
    return LibraryReference(
        name=data.name,
        version=data.version,
        namespace=data.namespace or None,
        placeholder=data.placeholder,
        parameters=tuple(ParameterValue(one.list, one.name, one.value) for one in data.parameters),
        qualified_only=data.qualified_only,
        place=place,
    )


def _joined(old: LibraryManagerData, new: Mapping[str, Any]) -> dict[str, Any]:
    """The references that are there, then those of an import to other libraries; parameters that only the
    import gives a value are taken over."""
    kept = old.model_dump()["references"]
    known = {name_key(reference["name"]) for reference in kept}
    read = new.get("references", ())
    more = [item for item in read if name_key(item["name"]) not in known]
    joined = [
        _with_more_parameters(
            reference, [item for item in read if name_key(item["name"]) == name_key(reference["name"])]
        )
        for reference in kept
    ]
    return {"references": [*joined, *more]}


def _with_more_parameters(reference: dict[str, Any], other: Iterable[dict[str, Any]]) -> dict[str, Any]:
    """A reference with the values of others to the same library, for parameters that it gives none."""
    kept = list(reference.get("parameters", ()))
    known = {(one["list"].casefold(), one["name"].casefold()) for one in kept}
    for one in (one for more in other for one in more.get("parameters", ())):
        key = (one["list"].casefold(), one["name"].casefold())
        if key not in known:
            known.add(key)
            kept.append(one)
    return reference | {"parameters": kept} if kept else reference


LIBRARY_MANAGER = ObjectKind(
    name="library_manager",
    words="library manager",
    description="The list of libraries of an application or of the POUs view.",
    data=LibraryManagerData,
    placement=Placement(parents=CODE_PLACES, in_folders=False, once=True),
    naming=Naming(style="fixed", names=("Library Manager",)),
    order=160,
    new=lambda name: LibraryManagerData(references=DEFAULT_LIBRARIES),
    compiled=Compiled(libraries=_references),
    merging=Merging(join=_joined),
    codesys=Codesys(
        type_ids=("adb5cb658e1d4a00b70a375ea27582f3",),
        read=lambda reader, entry, draft: reader.libraries(entry, draft),
    ),
)
