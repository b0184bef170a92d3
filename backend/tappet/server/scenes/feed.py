"""Values of the running application for a scene: subscribed while the scene is shown, decoded, handed on."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tappet.project.scene import Scene
from tappet.runtime.recorder import Frame
from tappet.server.online.sampler import SamplerPool
from tappet.server.runtimes.links import Change, RuntimeLink
from tappet.server.scenes.values import SceneVariables

INTERVAL_MS = 40
"""25 pictures a second."""


class SceneFeed:
    """Keeps `update` supplied with the variables of a scene. All calls are made in the event loop."""

    def __init__(
        self, link: RuntimeLink, pool: SamplerPool, scene: Scene, update: Callable[[dict[str, Any]], None]
    ) -> None:
        self._link = link
        self._pool = pool
        self._names = scene.variables()
        self._update = update
        self._variables: SceneVariables | None = None
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
        symbols = self._link.symbols
        self._variables = None if symbols is None else SceneVariables(symbols, self._names)
        if self._variables is None:
            self._update({})
        elif self._variables.places and self._link.connected:
            self._detach = self._pool.attach(self._variables.places, INTERVAL_MS, self._take)

    def _take(self, frame: Frame) -> None:
        values = None if self._variables is None else self._variables.decode(frame.data)
        if values is not None:
            self._update(values)


def _nothing() -> None:
    """Nothing is attached."""
