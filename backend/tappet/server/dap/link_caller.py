"""Operations of a debug session on a runtime of the server: what changes something is in the audit log."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from starlette.concurrency import run_in_threadpool

from tappet.runtime.client import ConnectionLost, RuntimeRefused
from tappet.runtime.operations.declaration import WireOperation
from tappet.runtime.operations.values import Write
from tappet.runtime.places import Place, path_at
from tappet.server.audit import Act, Result
from tappet.server.audited import ActRecord
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink

T = TypeVar("T")


class LinkCaller:
    """Calls over the connection that the server has."""

    def __init__(self, link: RuntimeLink, record: Callable[[], ActRecord]) -> None:
        """`record` makes the record of one act of the user."""
        self._link = link
        self._record = record
        self._ends: list[Callable[[], None]] = []

    async def call(self, operation: WireOperation[T]) -> T:
        """The reply. Raises RuntimeRefused, ConnectionLost."""
        acts = self._acts(operation)
        record = self._record() if acts else None
        try:
            if record is not None:
                await record.begin_async(*acts)
            async with self._link.client() as client:
                reply = await client.call(operation)
        except Problem as problem:
            if record is not None:
                await run_in_threadpool(record.stop, problem, acts[0])
            if problem.status == 503:
                raise ConnectionLost(problem.detail) from problem
            raise RuntimeRefused(problem.kind, problem.detail) from problem
        if record is not None:
            await run_in_threadpool(record.end, Result.OK)
        return reply

    def _acts(self, operation: WireOperation[T]) -> list[Act]:
        """What the audit log keeps of an operation; nothing for one that only reads."""
        link = self._link
        if isinstance(operation, Write):
            symbols = link.loaded_symbols()
            paths = [path_at(symbols, Place(at, len(data), bit)) for at, data, bit in operation.values]
            shown = [data.hex() for _, data, _ in operation.values]
            return [
                Act("write", path or "?", None, value, None, link.id)
                for path, value in zip(paths, shown, strict=True)
            ]
        rest = operation.rest
        if rest is None or rest.audit is None:
            return []
        fact = rest.audit(operation)
        return [Act(fact.action, fact.subject or link.name, None, fact.new_value, None, link.id)]

    def on_event(self, callback: Callable[[], None]) -> None:
        """At every change of the runtime."""
        self._ends.append(self._link.listen(lambda _change: callback()))

    def close(self) -> None:
        """Hear of nothing any more."""
        for end in self._ends:
            end()
