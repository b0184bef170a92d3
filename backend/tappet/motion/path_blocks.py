"""Blocks of path preprocessing that SM3_CNC offers, read off the library (CNCS-08, CNCS-09)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from tappet import libraries
from tappet.libraries.catalog import Item, NamedValue, Pin, items

LIBRARY = "SM3_CNC"
INPUT, OUTPUT, EXECUTE = "poqDataIn", "poqDataOut", "bExecute"
CYCLE = "dwIpoTime"
SIZE, BUFFER = "nSizeOutQueue", "pbyBufferOutQueue"
_WIRED = frozenset((INPUT, EXECUTE, "bAbort", "bAppend", SIZE, BUFFER))
"""Inputs that the chain itself sets."""
_NUMBERS = frozenset(
    (
        *("REAL", "LREAL", "SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT"),
        *("BYTE", "WORD", "DWORD", "LWORD"),
    )
)


@dataclass(frozen=True, slots=True)
class PathParameter:
    """An input of a block that a person chooses; of a structure one of its members."""

    name: str
    """`dRadius`, or `vec.dX`."""
    type: str
    initial: str
    """Literal of its initial value."""
    comment: str
    values: tuple[str, ...] = ()
    """Of a BOOL or an enumeration; empty for a number."""


@dataclass(frozen=True, slots=True)
class PathBlock:
    """A function block that reads a path queue and writes another one, or changes the objects in it."""

    name: str
    comment: str
    parameters: tuple[PathParameter, ...]
    buffered: bool
    """It has a queue of its own, for which it is given memory."""


@cache
def path_blocks() -> dict[str, PathBlock]:
    """All blocks by name: those that start with bExecute, take poqDataIn and give poqDataOut.

    What has a cycle time runs the path, or tells how it will be run.
    """
    found: dict[str, Item] = {}
    for name in (LIBRARY, "SM3_Basic"):
        for item in items(libraries.load(name)):
            found.setdefault(item.name, item)
    return {
        item.name: PathBlock(
            item.name,
            _first_sentence(item.summary),
            tuple(_parameters(item, found)),
            _has(item.inputs, BUFFER),
        )
        for item in items(libraries.load(LIBRARY))
        if item.kind == "function_block"
        and _has(item.inputs, EXECUTE)
        and _has(item.inputs, INPUT)
        and _has(item.outputs, OUTPUT)
        and not _has(item.inputs, CYCLE)
        and not item.in_out
    }


def _has(pins: tuple[Pin, ...], name: str) -> bool:
    return any(pin.name == name for pin in pins)


def _first_sentence(text: str) -> str:
    return text.split(" Spec ")[0].strip()


def _parameters(block: Item, types: dict[str, Item]) -> list[PathParameter]:
    return [
        parameter
        for pin in block.inputs
        if pin.name not in _WIRED
        for parameter in _of_pin(pin.name, pin, types)
    ]


def _of_pin(path: str, pin: Pin, types: dict[str, Item]) -> list[PathParameter]:
    """The parameters that an input is: none for a pointer, several for a structure."""
    kind = pin.type.rpartition(".")[2]
    initial = pin.default.rpartition(".")[2] if not _is_number(pin.default) else pin.default
    if kind == "BOOL":
        return [PathParameter(path, kind, initial or "FALSE", pin.comment, ("FALSE", "TRUE"))]
    if kind in _NUMBERS:
        return [PathParameter(path, kind, _plain_number(pin.default), pin.comment)]
    known = types.get(kind)
    if known is not None and known.kind == "enum":
        names = tuple(value.name for value in known.values)
        return [PathParameter(path, kind, initial or _first(known.values), pin.comment, names)]
    if known is not None and known.kind == "struct":
        return [one for member in known.members for one in _of_pin(f"{path}.{member.name}", member, types)]
    return []


def _first(values: tuple[NamedValue, ...]) -> str:
    """The value that a variable of an enumeration starts with."""
    return values[0].name


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _plain_number(text: str) -> str:
    """A number without base and underscores."""
    text = text.replace("_", "")
    if not text:
        return "0"
    base, sharp, digits = text.partition("#")
    return str(int(digits, int(base))) if sharp else text
