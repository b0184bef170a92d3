"""The values that references give to parameters of a library, put to the texts of its parameter lists."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.nearest import nearest
from tappet.lang.source import NOWHERE, GivenValue, Source
from tappet.libraries.catalog import Item, parameter_lists
from tappet.project.library_reference import ParameterValue


@dataclass(frozen=True, slots=True)
class Given:
    """A value, and the path of the library manager whose reference gives it."""

    parameter: ParameterValue
    place: str


def with_values(
    sources: Iterable[Source], given: Iterable[Given], library: str
) -> tuple[tuple[Source, ...], list[Diagnostic]]:
    """The texts of a library with the values in them, and which values are for no parameter that it has.

    Of two values for one parameter the first one holds.
    """
    texts = list(sources)
    lists = [(index, item) for index, source in enumerate(texts) for item in parameter_lists(source)]
    values: dict[int, dict[str, GivenValue]] = {}
    unknown = []
    for one in given:
        found = _find(lists, one.parameter)
        if found is None:
            unknown.append(_unknown(lists, one, library))
        else:
            index, name = found
            value = GivenValue(name, one.parameter.value, one.place)
            values.setdefault(index, {}).setdefault(name.upper(), value)
    for index, of_list in values.items():
        texts[index] = replace(texts[index], given=tuple(of_list.values()))
    return tuple(texts), unknown


def _find(lists: list[tuple[int, Item]], wanted: ParameterValue) -> tuple[int, str] | None:
    """The text that declares a parameter, and its name there."""
    for index, item in lists:
        if not wanted.list or item.name.upper() == wanted.list.upper():
            for pin in item.members:
                if pin.name.upper() == wanted.name.upper():
                    return index, pin.name
    return None


def _unknown(lists: list[tuple[int, Item]], given: Given, library: str) -> Diagnostic:
    wanted = given.parameter
    offered = {
        f"{item.name}.{pin.name}".upper(): f"{item.name}.{pin.name}"
        for _, item in lists
        for pin in item.members
    }
    close = nearest(f"{wanted.list}.{wanted.name}", offered)
    hint = f"Did you mean '{offered[close[0]]}'? Else remove the value." if close else ""
    where = f" in a list '{wanted.list}'" if wanted.list else ""
    fields = {"library": library, "name": wanted.name, "where": where, "value": wanted.value, "hint": hint}
    return report("W1411", given.place, NOWHERE, **fields)
