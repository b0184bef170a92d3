"""The instrumented variants that runtimes debug by: compiled when needed, from the texts that run."""

from __future__ import annotations

import asyncio
import logging
from collections import OrderedDict

from starlette.concurrency import run_in_threadpool

from tappet.runtime.operations.debugging import GetDebugState
from tappet.server.builds.builder import Application
from tappet.server.builds.commissioning import Commissioning
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink

log = logging.getLogger(__name__)
KEPT = 4
"""Variants that stay at hand: a runtime that was reset or restarted needs the same again."""


class DebugVariants:
    """Makes variants, one at a time, and keeps the newest. Lives in the event loop."""

    def __init__(self, commissioning: Commissioning) -> None:
        self._commissioning = commissioning
        self._variants: OrderedDict[str, bytes] = OrderedDict()
        self._lock = asyncio.Lock()
        self._restoring: set[asyncio.Task[None]] = set()

    async def prepare(self, link: RuntimeLink) -> None:
        """The runtime has the variant of its application when this returns. Raises problems: 409 without an
        application, or without its texts; 503 not connected."""
        async with self._lock:
            link.loaded_symbols()
            async with link.client() as client:
                if (await client.call(GetDebugState())).available:
                    return
            assert link.info is not None
            code_id = link.info.code_id or ""
            variant = await self._variant(link, code_id)
            async with link.client() as client:
                await client.load_variant(variant)

    async def _variant(self, link: RuntimeLink, code_id: str) -> bytes:
        known = self._variants.get(code_id)
        if known is None:
            packages = self._commissioning.packages
            stored = await run_in_threadpool(packages.find, code_id)
            source = await run_in_threadpool(packages.source, code_id)
            if stored is None or source is None:
                raise Problem(
                    409,
                    "no-debug-code",
                    f"This server does not have the texts of what runs in '{link.name}', so it cannot be "
                    "debugged from here; download the application again.",
                )
            application = await run_in_threadpool(
                Application.of, stored.project_id, source[0], stored.application_id
            )
            known = await self._commissioning.builder.variant(application, code_id, stored.data)
        self._variants[code_id] = known
        self._variants.move_to_end(code_id)
        while len(self._variants) > KEPT:
            self._variants.popitem(last=False)
        return known

    def restore(self, link: RuntimeLink) -> None:
        """After a download or an online change: where there are breakpoints they hold again, soon."""
        task = asyncio.create_task(self._restore(link), name=f"debug {link.name}")
        self._restoring.add(task)
        task.add_done_callback(self._restoring.discard)

    async def _restore(self, link: RuntimeLink) -> None:
        try:
            async with link.client() as client:
                state = await client.call(GetDebugState())
            if state.breakpoints and not state.available:
                await self.prepare(link)
        except Problem as problem:
            log.warning("breakpoints in '%s' do not hold: %s", link.name, problem.detail)

    async def close(self) -> None:
        """Restores nothing any more."""
        for task in list(self._restoring):
            task.cancel()
        await asyncio.gather(*self._restoring, return_exceptions=True)
