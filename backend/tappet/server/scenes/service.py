"""Scenes of projects as 3D views: a viser server each, fed only while a browser looks at it."""

from __future__ import annotations

import asyncio
import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tappet.project.scene import Scene
from tappet.server.online.sampler import SamplerPool
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.scenes.feed import SceneFeed
from tappet.server.scenes.view import SceneView
from tappet.server.views.service import ViewRegistry


class SceneServer:
    """A `ViewServer` that draws one scene with the values of one runtime."""

    def __init__(
        self,
        scene: Scene,
        link: RuntimeLink,
        pool: SamplerPool,
        loop: asyncio.AbstractEventLoop,
        *,
        dark: bool,
    ) -> None:
        """Starts viser and draws; blocks, so call it in a thread."""
        # viser takes longer to import than the whole server: only for who looks at a scene
        from tappet.server.views.private_viser import PrivateViser

        self._scene = scene
        self._link = link
        self._pool = pool
        self._loop = loop
        self._feed: SceneFeed | None = None
        self._viser = PrivateViser()
        self._view = SceneView(self._viser, scene, dark=dark)
        self._viser.on_client_connect(self._on_clients)
        self._viser.on_client_disconnect(self._on_clients)

    @property
    def socket(self) -> Path:
        """Where viser listens."""
        return self._viser.socket

    def stop(self) -> None:
        """Ends subscription and server."""
        self._in_loop(self._close_feed)
        self._viser.stop()

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


async def open_scene(
    views: ViewRegistry, scene: Scene, link: RuntimeLink, pool: SamplerPool, *, dark: bool
) -> str:
    """Id of the view that shows `scene` with values of `link`; begun if nobody else looks at the same one."""
    facts = f"{scene.model_dump_json()} {link.id} {dark}"
    view_id = hashlib.blake2b(facts.encode(), digest_size=9).hexdigest()
    loop = asyncio.get_running_loop()
    await views.start_view(view_id, lambda: SceneServer(scene, link, pool, loop, dark=dark))
    return view_id
