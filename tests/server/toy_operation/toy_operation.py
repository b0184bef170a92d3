"""A wire operation of another package: adds to an INT of the image and forces the sum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from msgspec import Meta, Struct

from tappet.runtime.forces import PlacedValue
from tappet.runtime.operations.declaration import Fact, Offset, Operation, OperationError, Rest
from tappet.runtime.places import Place

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc

SIZE = 2
MOST = (1 << 15) - 1


class Nudged(Struct, frozen=True):
    """What the variable holds now."""

    value: int


class Nudge(Operation[Nudged], frozen=True):
    """Add to the INT at a place of the image."""

    op: ClassVar[str] = "toy_nudge"
    rest: ClassVar[Rest | None] = Rest(
        "POST",
        "/toy/{offset}/nudge",
        "engineer",
        lambda n: Fact("toy-nudge", f"offset {n.offset}", str(n.by)),
    )
    offset: Offset
    by: Annotated[int, Meta(ge=-100, le=100, description="How much.")]

    def run(self, plc: SoftPlc) -> Nudged:
        """Read and force: the value stays."""
        (data,) = plc.read([(self.offset, SIZE)])
        value = int.from_bytes(data, "little", signed=True) + self.by
        if not -MOST <= value <= MOST:
            raise OperationError("toy_overflow", f"{value} is no INT")
        data = value.to_bytes(SIZE, "little", signed=True)
        plc.force([PlacedValue(Place(self.offset, SIZE), data)])
        return Nudged(value)
