"""Short transactions on the server's own tables, from routes and from background work."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from sqlalchemy import Connection, Engine
from starlette.concurrency import run_in_threadpool

T = TypeVar("T")


class Database:
    """The engine shared with the project store."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine

    def run(self, work: Callable[[Connection], T]) -> T:
        """Calls `work` in one transaction: committed on return, rolled back on an exception. Blocks."""
        with self.engine.begin() as connection:
            return work(connection)

    async def run_async(self, work: Callable[[Connection], T]) -> T:
        """`run` on a thread, for coroutines."""
        return await run_in_threadpool(self.run, work)
