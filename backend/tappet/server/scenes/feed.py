"""Values of the running application for a scene: subscribed while the scene is shown, decoded, handed on."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

from tappet.codegen.symbol_map import SymbolMap, VarRef
from tappet.project.scene import Scene
from tappet.runtime.recorder import Frame
from tappet.server.online.sampler import SamplerPool
from tappet.server.runtimes.links import Change, RuntimeLink
from tappet.server.values.service import try_resolve

INTERVAL_MS = 40
"""25 pictures a second."""
log = logging.getLogger(__name__)


class SceneFeed:
    """Keeps `update` supplied with the variables of a scene. All calls are made in the event loop."""

    def __init__(
        self, link: RuntimeLink, pool: SamplerPool, scene: Scene, update: Callable[[dict[str, Any]], None]
    ) -> None:
        self._link = link
        self._pool = pool
        self._variables = scene.variables()
        self._update = update
        self._symbols: SymbolMap | None = None
        self._refs: dict[str, VarRef] = {}
        self._detach: Callable[[], None] = _nothing
        self._end_listening = link.listen(self._on_change)
        self._attach()

    def close(self) -> None:
        """Ends the subscription."""
        self._end_listening()
        self._detach()
        self._detach = _nothing

    def _on_change(self, change: Change) -> None:
        if change is Change.APPLICATION:
            self._attach()

    def _attach(self) -> None:
        self._detach()
        self._detach = _nothing
        self._symbols = symbols = self._link.symbols
        self._refs = {}
        if symbols is None:
            self._update({})
            return
        for variable in self._variables:
            ref = try_resolve(symbols, variable)
            if isinstance(ref, str):
                log.info("3D scene: %s", ref)
            elif ref.type.leaf or ref.bit is not None:
                self._refs[variable] = ref
        places = tuple((ref.offset, ref.size) for ref in self._refs.values())
        if places and self._link.connected:
            self._detach = self._pool.attach(places, INTERVAL_MS, self._take)

    def _take(self, frame: Frame) -> None:
        symbols = self._symbols
        if symbols is None or len(frame.data) < sum(ref.size for ref in self._refs.values()):
            return
        values: dict[str, Any] = {}
        at = 0
        for variable, ref in self._refs.items():
            values[variable] = symbols.decode(ref, frame.data[at : at + ref.size])
            at += ref.size
        self._update(values)


def _nothing() -> None:
    """Nothing is attached."""
