"""The inputs and outputs of a panel: a block of the application that a page of commissioning writes to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.codegen.symbol_map import SymbolError, VarRef
from tappet.runtime.errors import PlcError
from tappet.runtime.forces import PlacedValue
from tappet.runtime.operations.declaration import OperationError
from tappet.runtime.places import Place

if TYPE_CHECKING:
    from tappet.codegen.values import Value
    from tappet.runtime.plc import SoftPlc

COUNTERS = 1 << 32
"""Values of a counter, a UDINT."""


class PanelInputs:
    """The variables of one panel; `missing` is said where the application has none at that path.

    Raises PlcError when the application does not run, OperationError when it has no such panel.
    """

    def __init__(self, plc: SoftPlc, path: str, missing: str) -> None:
        self._plc = plc
        self._path = path
        self._missing = missing
        self._symbols = plc.symbols()
        if plc.state != "run":
            raise PlcError("the application does not run; start it before moving its axes by hand")
        self._ref("xUsed")

    def next(self, counter: str) -> int:
        """Another value of a counter than it has."""
        return (int(self.literal(counter)) + 1) % COUNTERS

    def write(self, **inputs: Value) -> None:
        """Store inputs together, in this order."""
        placed = []
        for name, value in inputs.items():
            ref = self._ref(name)
            placed.append(PlacedValue(Place(ref.offset, ref.size, ref.bit), self._symbols.encode(ref, value)))
        self._plc.write(placed)

    def literal(self, name: str) -> str:
        """A value as the program would write it."""
        ref = self._ref(name)
        (data,) = self._plc.read([(ref.offset, ref.size)])
        return self._symbols.format_literal(ref, self._symbols.decode(ref, data))

    def _ref(self, name: str) -> VarRef:
        try:
            return self._symbols.resolve(f"{self._path}.{name}")
        except SymbolError:
            raise OperationError("not_found", self._missing) from None
