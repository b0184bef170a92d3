"""Which kinds of project objects there are: the modules of `kinds`, and the plug-ins that are installed.

A kind is added by a file in `kinds` that holds an `ObjectKind`, or by a package with an entry point of the
group `tappet.kinds` that leads to one; nothing else names it. A plug-in that cannot be loaded, breaks the
contract or takes a name that exists is left out with a line in the log, and its objects are kept unchanged
like those of a plug-in that is not installed (CON-03): they hold `UnknownData` until the plug-in is there,
and are validated then.

Cost: the first question imports all kinds and reads the metadata of the installed packages, some ten
milliseconds once a process; each further one is a look into a dict.
"""

from __future__ import annotations

import importlib
import logging
import pkgutil
import re
from collections.abc import Iterator, Mapping
from functools import lru_cache
from types import MappingProxyType, ModuleType
from typing import Any

from tappet.plug_ins import entry_points
from tappet.project import kinds as own_kinds
from tappet.project.data import Data
from tappet.project.model import ProjectObject
from tappet.project.object_kind import DEVICES_VIEW, IecText, ObjectKind

ENTRY_POINTS = "tappet.kinds"
"""The group of entry points; each leads to an `ObjectKind`."""

_NAME = re.compile(r"[a-z][a-z0-9_]{0,63}")
_ENDING = re.compile(r"[a-z0-9]{1,16}")
_log = logging.getLogger(__name__)


@lru_cache(maxsize=1)
def kinds() -> Mapping[str, ObjectKind[Any]]:
    """All kinds that are installed, by name, in the order of the dialog that adds objects."""
    found = {kind.name: kind for kind in _own()}
    for kind in _plugged_in():
        try:
            _check(kind)
            if kind.name in found:
                raise ValueError(f"a kind named '{kind.name}' exists already")
        except ValueError as error:
            _log.warning("a plug-in's kind of object is left out: %s", error)
            continue
        found[kind.name] = kind
    return MappingProxyType(dict(sorted(found.items(), key=lambda one: (one[1].order, one[0]))))


def look_again() -> None:
    """Forget what is installed, so that the next question finds plug-ins that came or went."""
    kinds.cache_clear()


def kind_of(item: ProjectObject) -> ObjectKind[Any] | None:
    """The kind of an object; None while its plug-in is missing or its data do not fit the kind."""
    kind = kinds().get(item.kind)
    return kind if kind is not None and isinstance(item.data, kind.data) else None


def _own() -> Iterator[ObjectKind[Any]]:
    for module in pkgutil.iter_modules(own_kinds.__path__, f"{own_kinds.__name__}."):
        yield _descriptor(importlib.import_module(module.name))


def _descriptor(module: ModuleType) -> ObjectKind[Any]:
    found = [value for value in vars(module).values() if isinstance(value, ObjectKind)]
    here = [kind for kind in found if module.__name__.endswith(f".{kind.name}")]
    if len(here) != 1:
        raise TypeError(f"{module.__name__} should hold one ObjectKind with the name of the file")
    return here[0]


def _plugged_in() -> Iterator[ObjectKind[Any]]:
    for entry in entry_points(ENTRY_POINTS):
        try:
            kind = entry.load()
        except Exception:
            _log.exception("the plug-in %s of %s cannot be loaded", entry.name, entry.value)
            continue
        if isinstance(kind, ObjectKind):
            yield kind
        else:
            _log.warning("the plug-in %s is no ObjectKind but a %s", entry.value, type(kind).__name__)


def _check(kind: ObjectKind[Any]) -> None:
    """Raise ValueError for a descriptor of a plug-in that would harm projects."""
    if not _NAME.fullmatch(kind.name):
        raise ValueError(f"'{kind.name}' is no name of a kind: lower case letters, digits, underscores")
    if not (isinstance(kind.data, type) and issubclass(kind.data, Data)):
        raise ValueError(f"the data of '{kind.name}' are no model derived from Data")
    needed = [name for name, field in kind.data.model_fields.items() if field.is_required()]
    if needed:
        raise ValueError(f"the data of '{kind.name}' need a default for '{needed[0]}'")
    if not kind.placement.parents or DEVICES_VIEW in kind.placement.parents:
        raise ValueError(f"'{kind.name}' needs a parent; the roots of the Devices view are devices alone")
    if isinstance(kind.folder, IecText):
        raise ValueError(
            f"'{kind.name}' keeps its texts in JsonFile.texts, which can be read without the plug-in"
        )
    endings = list(kind.folder.texts.values())
    if len(set(endings)) < len(endings) or not all(
        _ENDING.fullmatch(one) and one != "json" for one in endings
    ):
        raise ValueError(f"'{kind.name}' needs an ending of its own for each text: small letters, not json")
    if kind.naming.style == "fixed" and not kind.naming.names:
        raise ValueError(f"'{kind.name}' has fixed names but names none")
