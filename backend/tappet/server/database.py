"""Short transactions on the server's own tables, from routes and from background work."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from sqlalchemy import Connection, Engine
from starlette.concurrency import run_in_threadpool

from tappet.project.store.engine import reading

T = TypeVar("T")


class Database:
    """The engine shared with the project store. `work` is called in one transaction, which is committed
    when it returns and rolled back when it raises."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self._reading = reading(engine)

    def read(self, work: Callable[[Connection], T]) -> T:
        """Calls `work`, which must not write. Blocks."""
        with self._reading.begin() as connection:
            return work(connection)

    def write(self, work: Callable[[Connection], T]) -> T:
        """Calls `work`, which may write; SQLite lets one such call run at a time. Blocks."""
        with self.engine.begin() as connection:
            return work(connection)

    async def read_async(self, work: Callable[[Connection], T]) -> T:
        """`read` on a thread, for coroutines."""
        return await run_in_threadpool(self.read, work)

    async def write_async(self, work: Callable[[Connection], T]) -> T:
        """`write` on a thread, for coroutines."""
        return await run_in_threadpool(self.write, work)
