"""Places in memory: variables of an activation, data of the image, instances, targets of pointers."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.core.ir.nodes import Expr
from tappet.core.ir.types import Scalar


@dataclass(eq=False, slots=True)
class Local:
    """A variable of one function activation."""

    name: str
    size: int
    align: int
    type: Scalar | None = None
    """None for aggregates."""
    once: bool = False
    """A temporary that every reader finds as its one store left it."""


@dataclass(frozen=True, slots=True)
class Data:
    """Base of a place: a data object of the image (`tappet.data.PLC_PRG`) or a module constant."""

    symbol: str


@dataclass(frozen=True, slots=True)
class Self:
    """Base of a place: the function block instance the function works on; `type` is its upper-case name."""

    type: str


@dataclass(eq=False, slots=True)
class Indirect:
    """Base of a place: where a pointer value points to."""

    pointer: Expr
    align: int = 1
    own: bool = False
    """Memory that only this function reaches: the space for its result."""


Base = Data | Self | Local | Indirect


@dataclass(eq=False, slots=True)
class Subscript:
    """One dynamic index of a place: adds `(index - low) * stride` bytes."""

    index: Expr
    low: int
    high: int
    stride: int
    checked: bool = True
    """Whether an index outside low..high has to fault; cleared by `ranges` when it cannot happen."""


@dataclass(eq=False, slots=True)
class Place:
    """A memory location: base, constant byte offset and dynamic subscripts."""

    base: Base
    offset: int = 0
    subscripts: tuple[Subscript, ...] = ()
    root: int = -1
    """Offset of the outermost variable this is part of, inside base; -1 if unknown. Accesses with different
    roots on one base never overlap, because subscripts are checked."""
