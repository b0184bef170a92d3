"""A library as a build takes it: what a reference of a library manager says, as plain data.

Nothing of the other rooms is imported, so that the compiler, the server and its processes share it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class ParameterValue:
    """A value that a reference gives to a parameter of the library."""

    list: str
    """The parameter list; '' where the reference has none, then the parameter is known by its name."""
    name: str
    value: str
    """A constant expression as written."""


@dataclass(frozen=True, slots=True)
class LibraryReference:
    """A library an application uses."""

    name: str
    version: str = "*"
    namespace: str | None = None
    """Prefix of its names; None: its own."""
    placeholder: str | None = None
    """The name that libraries which need it know it by, where that is another one."""
    parameters: tuple[ParameterValue, ...] = ()
    qualified_only: bool = False
    """The application uses its names behind the namespace only, whatever the library asks for."""
    place: str = ""
    """Path of the library manager that holds the reference, for messages about it."""

    @classmethod
    def of(cls, fields: Mapping[str, Any]) -> LibraryReference:
        """The reference of `dataclasses.asdict`, as it comes from another process."""
        parameters = tuple(ParameterValue(**one) for one in fields["parameters"])
        return cls(**{**fields, "parameters": parameters})
