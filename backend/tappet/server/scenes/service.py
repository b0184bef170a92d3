"""Scenes of projects as 3D views: a viser server each, fed only while a browser looks at it.

All who look at the present of a scene share one view. Who looks at its past has a view of his own, since
everybody stands at another cycle.
"""

from __future__ import annotations

import asyncio
import hashlib
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tappet.project.scene import Scene
from tappet.runtime.operations.flight import ReadFlight
from tappet.server.online.sampler import SamplerPool
from tappet.server.problems import not_found
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.scenes.feed import SceneFeed
from tappet.server.scenes.values import SceneVariables
from tappet.server.scenes.view import SceneView
from tappet.server.views.service import ViewRegistry


class SceneServer:
    """A `ViewServer` that draws one scene with the values of one runtime."""

    def __init__(self, scene: Scene, link: RuntimeLink, *, dark: bool) -> None:
        """Starts viser and draws; blocks, so call it in a thread."""
        # viser takes longer to import than the whole server: only for who looks at a scene
        from tappet.server.views.private_viser import PrivateViser

        self._scene = scene
        self._link = link
        self._viser = PrivateViser()
        self._view = SceneView(self._viser, scene, dark=dark)

    @property
    def socket(self) -> Path:
        """Where viser listens."""
        return self._viser.socket

    def stop(self) -> None:
        """Ends the server."""
        self._viser.stop()


class LiveScene(SceneServer):
    """Moved by the values of the present."""

    def __init__(
        self,
        scene: Scene,
        link: RuntimeLink,
        pool: SamplerPool,
        loop: asyncio.AbstractEventLoop,
        *,
        dark: bool,
    ) -> None:
        super().__init__(scene, link, dark=dark)
        self._pool = pool
        self._loop = loop
        self._feed: SceneFeed | None = None
        self._viser.on_client_connect(self._on_clients)
        self._viser.on_client_disconnect(self._on_clients)

    def stop(self) -> None:
        """Ends subscription and server."""
        self._in_loop(self._close_feed)
        super().stop()

    def _on_clients(self, _: Any) -> None:
        self._in_loop(self._adjust_feed)

    def _in_loop(self, call: Callable[[], None]) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(call)

    def _adjust_feed(self) -> None:
        watched = bool(self._viser.get_clients())
        if watched and self._feed is None:
            self._feed = SceneFeed(self._link, self._pool, self._scene, self._view.update)
        elif not watched:
            self._close_feed()

    def _close_feed(self) -> None:
        if self._feed is not None:
            self._feed.close()
            self._feed = None


class PastScene(SceneServer):
    """Stands in the cycle of the flight recorder that it was told to show."""

    async def show(self, cycle: int) -> None:
        """Puts everything where it was at the end of `cycle`; raises problems for one that is not kept."""
        variables = SceneVariables(self._link.loaded_symbols(), self._scene.variables())
        code_id = self._link.code_id
        async with self._link.client() as client:
            parts = await client.call(ReadFlight(cycle, list(variables.places), code_id))
        values = variables.decode(b"".join(parts))
        if values is not None:
            self._view.update(values)


async def open_scene(
    views: ViewRegistry, scene: Scene, link: RuntimeLink, pool: SamplerPool, *, dark: bool
) -> str:
    """Id of the view that shows `scene` with values of `link`; begun if nobody else looks at the same one."""
    facts = f"{scene.model_dump_json()} {link.id} {dark}"
    view_id = hashlib.blake2b(facts.encode(), digest_size=9).hexdigest()
    loop = asyncio.get_running_loop()
    await views.start_view(view_id, lambda: LiveScene(scene, link, pool, loop, dark=dark))
    return view_id


async def open_past_scene(
    views: ViewRegistry, scene: Scene, link: RuntimeLink, cycle: int, *, dark: bool
) -> str:
    """Id of a new view of `scene` at a past cycle of `link`."""
    view_id = secrets.token_hex(9)
    server = await views.start_view(view_id, lambda: PastScene(scene, link, dark=dark))
    try:
        await _past(server, view_id).show(cycle)
    except BaseException:
        await views.stop_view(view_id)
        raise
    return view_id


async def show_past_scene(views: ViewRegistry, view_id: str, cycle: int) -> None:
    """Moves a view of the past to another cycle; a 404 problem when it does not run any more."""
    await _past(views.server_of(view_id), view_id).show(cycle)


def _past(server: object, view_id: str) -> PastScene:
    if not isinstance(server, PastScene):
        raise not_found("open 3D view", view_id)
    return server
