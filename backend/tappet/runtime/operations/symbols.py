"""The symbol map of the loaded application."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from msgspec import Struct

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.operations.declaration import Operation

if TYPE_CHECKING:
    from tappet.runtime.plc import SoftPlc


class LoadedSymbols(Struct, frozen=True):
    """Symbols, and the code they belong to."""

    code_id: str
    symbols: SymbolMap


class GetSymbols(Operation[LoadedSymbols], frozen=True):
    """Where the variables of the loaded application lie."""

    op: ClassVar[str] = "symbols"

    def run(self, plc: SoftPlc) -> LoadedSymbols:
        """Code and symbols of one package."""
        return LoadedSymbols(*plc.symbols_with_code())
