"""JSON-RPC 2.0 as the Language Server Protocol uses it, whatever carries the messages.

Requests and notifications are carried out one after the other in one thread of their own, in the order they
came, so that a request sees every edit before it. A request that waits can be cancelled.
"""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

log = logging.getLogger(__name__)

PARSE_ERROR = -32700
INVALID_REQUEST = -32600
METHOD_NOT_FOUND = -32601
INVALID_PARAMS = -32602
INTERNAL_ERROR = -32603
NOT_INITIALIZED = -32002
REQUEST_FAILED = -32803
REQUEST_CANCELLED = -32800

MAX_WAITING = 1000
"""Requests that may wait; a client that sends more without reading answers is refused."""

Send = Callable[[str], Awaitable[None]]
Work = Callable[[Any], Any]
"""Carries out one method with its raw params and gives its raw result; runs in the thread of the endpoint."""
Id = int | str


class RpcError(Exception):
    """An error that is answered to the client with its code and text."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


class Endpoint:
    """One side of a JSON-RPC connection. Made in the event loop that serves it."""

    def __init__(self, send: Send, find: Callable[[str, bool], Work | None]) -> None:
        """`send` writes a message; `find` gives the work of a method (flag: a request), None if unknown."""
        self._send = send
        self._find = find
        self._loop = asyncio.get_running_loop()
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lsp")
        self._waiting: dict[Id, asyncio.Future[Any]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def receive(self, text: str) -> None:
        """Take one message. Never raises for what it says; answers follow later."""
        try:
            message = json.loads(text)
        except (ValueError, RecursionError) as error:
            await self._answer_error(None, PARSE_ERROR, f"This is no JSON: {error}")
            return
        if not isinstance(message, dict) or message.get("jsonrpc") != "2.0":
            await self._answer_error(None, INVALID_REQUEST, "A message is an object with jsonrpc: '2.0'")
            return
        method = message.get("method")
        identifier = message.get("id")
        if method is None and identifier is not None:
            return  # an answer to a request of ours; we ask nothing whose answer matters
        if not isinstance(method, str) or isinstance(identifier, bool | float | dict | list):
            await self._answer_error(None, INVALID_REQUEST, "A request has a method and an id")
            return
        params = message.get("params")
        if identifier is None:
            self._notification(method, params)
        else:
            await self._request(identifier, method, params)

    def _notification(self, method: str, params: Any) -> None:
        if method == "$/cancelRequest":
            identifier = params.get("id") if isinstance(params, dict) else None
            waiting = self._waiting.get(identifier) if isinstance(identifier, int | str) else None
            if waiting is not None:
                waiting.cancel()
            return
        work = self._find(method, False)
        if work is not None:
            self.post(lambda: work(params), method)

    def post(self, work: Callable[[], Any], name: str) -> None:
        """Have something done behind what has come so far, without an answer; `name` is for the log."""
        self._keep(self._report(self._loop.run_in_executor(self._worker, work), name))

    async def _request(self, identifier: Id, method: str, params: Any) -> None:
        work = self._find(method, True)
        if work is None:
            await self._answer_error(identifier, METHOD_NOT_FOUND, f"There is no method '{method}'")
        elif identifier in self._waiting:
            await self._answer_error(identifier, INVALID_REQUEST, f"The id {identifier} is in use")
        elif len(self._waiting) >= MAX_WAITING:
            await self._answer_error(identifier, REQUEST_FAILED, "Too many requests are waiting")
        else:
            self._keep(self._reply(identifier, method, self._submit(identifier, work, params)))

    def _submit(self, identifier: Id, work: Work, params: Any) -> asyncio.Future[Any]:
        future = self._loop.run_in_executor(self._worker, work, params)
        self._waiting[identifier] = future
        return future

    async def _reply(self, identifier: Id, method: str, future: asyncio.Future[Any]) -> None:
        try:
            result = await future
        except asyncio.CancelledError:
            if not future.cancelled():  # the connection is closing
                raise
            await self._answer_error(identifier, REQUEST_CANCELLED, "Cancelled")
        except RpcError as error:
            await self._answer_error(identifier, error.code, str(error))
        except Exception:
            log.exception("'%s' failed", method)
            await self._answer_error(
                identifier, INTERNAL_ERROR, f"'{method}' failed; the server's log says more"
            )
        else:
            await self._write({"jsonrpc": "2.0", "id": identifier, "result": result})
        finally:
            self._waiting.pop(identifier, None)

    async def _report(self, future: asyncio.Future[Any], name: str) -> None:
        try:
            await future
        except RpcError as error:
            log.info("notification '%s': %s", name, error)
        except Exception:
            log.exception("notification '%s' failed", name)

    async def run(self, work: Callable[[], Any]) -> Any:
        """Run something between the requests, in their thread."""
        return await self._loop.run_in_executor(self._worker, work)

    async def notify(self, method: str, params: Any) -> None:
        """Send a notification."""
        await self._write({"jsonrpc": "2.0", "method": method, "params": params})

    async def close(self) -> None:
        """Drop what waits and end the thread when it is done with what it does."""
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self._worker.shutdown(wait=False, cancel_futures=True)

    async def settle(self) -> None:
        """Wait until everything received so far is answered."""
        while self._tasks:
            await asyncio.gather(*list(self._tasks), return_exceptions=True)

    def _keep(self, work: Any) -> None:
        task: asyncio.Task[None] = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answer_error(self, identifier: Id | None, code: int, message: str) -> None:
        error = {"code": code, "message": message}
        await self._write({"jsonrpc": "2.0", "id": identifier, "error": error})

    async def _write(self, message: dict[str, Any]) -> None:
        await self._send(json.dumps(message, ensure_ascii=False, separators=(",", ":")))
