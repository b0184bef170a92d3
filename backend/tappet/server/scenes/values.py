"""The variables of a scene in an application: where they lie, and their values out of bytes."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Any

from tappet.codegen.symbol_map import SymbolMap, VarRef
from tappet.server.values.service import try_resolve

log = logging.getLogger(__name__)


class SceneVariables:
    """Those of a scene that an application has."""

    def __init__(self, symbols: SymbolMap, names: Sequence[str]) -> None:
        self._symbols = symbols
        self._refs: dict[str, VarRef] = {}
        for name in names:
            ref = try_resolve(symbols, name)
            if isinstance(ref, str):
                log.info("3D scene: %s", ref)
            elif ref.type.leaf or ref.bit is not None:
                self._refs[name] = ref
        self.places = tuple((ref.offset, ref.size) for ref in self._refs.values())

    def decode(self, data: bytes) -> dict[str, Any] | None:
        """Values out of the bytes at `places`, one behind the other; None where some are missing."""
        if len(data) < sum(size for _, size in self.places):
            return None
        values: dict[str, Any] = {}
        at = 0
        for name, ref in self._refs.items():
            values[name] = self._symbols.decode(ref, data[at : at + ref.size])
            at += ref.size
        return values
