"""Finds the operations: in the modules of this folder, and in those of entry points `tappet.operations`."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from types import ModuleType
from typing import Any

from tappet.plug_ins import entry_points
from tappet.runtime import operations
from tappet.runtime.operations.declaration import WireOperation, missing_handler, reply_type

GROUP = "tappet.operations"
"""Entry points of this group name modules with operations."""


class RegistrationError(RuntimeError):
    """Two operations of one name, one without handler, or an entry point that cannot be loaded."""


@cache
def known() -> Mapping[str, type[WireOperation[Any]]]:
    """All operations by name."""
    return collect(_modules())


def collect(modules: Iterable[ModuleType]) -> dict[str, type[WireOperation[Any]]]:
    """The operations that modules declare. RegistrationError when two have one name or one has no handler."""
    found: dict[str, type[WireOperation[Any]]] = {}
    for module in modules:
        for kind in _declared(module):
            other = found.setdefault(kind.op, kind)
            if other is not kind:
                raise RegistrationError(
                    f"the operation '{kind.op}' is declared twice: in {other.__module__}"
                    f" and {kind.__module__}"
                )
            if (handler := missing_handler(kind)) is not None:
                raise RegistrationError(
                    f"the operation '{kind.op}' has no handler: {kind.__module__}.{kind.__name__}"
                    f" does not define '{handler}'"
                )
            reply_type(kind)
    return found


def _declared(module: ModuleType) -> Iterator[type[WireOperation[Any]]]:
    for value in vars(module).values():
        kind = value if inspect.isclass(value) and issubclass(value, WireOperation) else None
        if kind is not None and kind.op and kind.__module__ == module.__name__:
            yield kind


def _modules() -> Iterator[ModuleType]:
    for entry in pkgutil.iter_modules(operations.__path__):
        yield importlib.import_module(f"{operations.__name__}.{entry.name}")
    for point in entry_points(GROUP):
        try:
            module = point.load()
        except Exception as error:
            raise RegistrationError(
                f"the entry point '{point.name}' of {GROUP} ({point.value}) cannot be loaded: {error}"
            ) from error
        if not isinstance(module, ModuleType):
            raise RegistrationError(f"the entry point '{point.name}' of {GROUP} names no module")
        yield module
