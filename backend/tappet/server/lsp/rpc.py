"""JSON-RPC 2.0 as the Language Server Protocol uses it, whatever carries the messages.

Requests and notifications of one endpoint are carried out one after the other in the order they came, so
that a request sees every edit before it. Endpoints may share a thread: each has one piece of work in it at
a time, so that one with a thousand requests does not keep the others waiting. A request that waits can be
cancelled.
"""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Awaitable, Callable
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any, Literal, TypeVar

import msgspec

from tappet.server.lsp.utf16 import without_half_pairs

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

Id = Annotated[int, msgspec.Meta(ge=-(2**63), le=2**63 - 1)] | str
_T = TypeVar("_T")


class Message(msgspec.Struct, frozen=True):
    """A request, or without an id a notification; without a method an answer."""

    jsonrpc: Literal["2.0"]
    method: str | None = None
    id: Id | None = None
    params: msgspec.Raw = msgspec.Raw(b"null")
    """As JSON, which is read when the type is known: see `params_as`."""


class _Cancel(msgspec.Struct):
    """Params of `$/cancelRequest`."""

    id: Id


class _Result(msgspec.Struct):
    id: Id
    result: msgspec.Raw
    jsonrpc: str = "2.0"


class _Fault(msgspec.Struct):
    code: int
    message: str


class _Failure(msgspec.Struct):
    id: Id | None
    error: _Fault
    jsonrpc: str = "2.0"


class _Notification(msgspec.Struct):
    method: str
    params: Any
    jsonrpc: str = "2.0"


@dataclass(frozen=True, slots=True)
class Outgoing:
    """A message for the client, and what who carries it may want to know."""

    text: str
    answers: Id | None = None
    """The request that this is the answer to."""
    replaces: str = ""
    """An unsent message with the same key is out of date now: the document whose messages these are."""


Send = Callable[[Outgoing], Awaitable[None]]
Work = Callable[[msgspec.Raw], Any]
"""Carries out one method with its params as JSON and gives its result; runs in the thread of the endpoint."""


class RpcError(Exception):
    """An error that is answered to the client with its code and text."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


def read(text: str) -> Message:
    """A message as it has come. Raises RpcError for one that is no JSON, or JSON that is no message."""
    try:
        message = _MESSAGES.decode(without_half_pairs(text))
    except msgspec.ValidationError as error:
        expected = "A message is an object with jsonrpc: '2.0', a method and, if it is a request, an id"
        raise RpcError(INVALID_REQUEST, f"{expected}: {error}") from error
    except (msgspec.DecodeError, UnicodeError, RecursionError) as error:
        raise RpcError(PARSE_ERROR, f"This is no JSON: {error}") from error
    if message.method is None and message.id is None:
        raise RpcError(INVALID_REQUEST, "A request has a method and an id")
    return message


def params_as(kind: type[_T], method: str | None, params: msgspec.Raw) -> _T:
    """The params of a method. Raises RpcError that names the field that is wrong."""
    try:
        return msgspec.json.decode(params, type=kind)
    except (msgspec.DecodeError, RecursionError) as error:
        text = f"The parameters of '{method}' are not as they should be: {error}"
        raise RpcError(INVALID_PARAMS, text) from error


_MESSAGES = msgspec.json.Decoder(Message)
_ENCODER = msgspec.json.Encoder()


def failure(identifier: Id | None, code: int, message: str) -> str:
    """The answer to a request that cannot be carried out; without an id to what is no request."""
    return _ENCODER.encode(_Failure(identifier, _Fault(code, message))).decode()


def notification(method: str, params: Any) -> str:
    """A message without an answer."""
    return _ENCODER.encode(_Notification(method, params)).decode()


class Endpoint:
    """One side of a JSON-RPC connection. Made in the event loop that serves it."""

    def __init__(
        self,
        send: Send,
        find: Callable[[str, bool], Work | None],
        thread: Executor,
        say: Callable[[str], str] = str,
    ) -> None:
        """`send` writes a message; `find` gives the work of a method (flag: a request), None if unknown;
        `say` puts a refusal into the language of the client."""
        self._send = send
        self._find = find
        self._say = say
        self._loop = asyncio.get_running_loop()
        self._thread = thread
        self._queue: deque[tuple[asyncio.Future[Any], Callable[[], Any]]] = deque()
        self._at_work: asyncio.Future[Any] | None = None
        self._waiting: dict[Id, asyncio.Future[Any]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def receive(self, text: str) -> None:
        """Take one message. Never raises for what it says; answers follow later."""
        try:
            message = read(text)
        except RpcError as error:
            await self._answer_error(None, error.code, str(error))
            return
        if message.method is None:
            return  # an answer to a request of ours; we ask nothing whose answer matters
        if message.id is None:
            self._notification(message.method, message.params)
        else:
            await self._request(message.id, message.method, message.params)

    def _notification(self, method: str, params: msgspec.Raw) -> None:
        if method == "$/cancelRequest":
            with suppress(RpcError):
                waiting = self._waiting.get(params_as(_Cancel, method, params).id)
                if waiting is not None:
                    waiting.cancel()
            return
        work = self._find(method, False)
        if work is not None:
            self.post(lambda: work(params), method)

    def post(self, work: Callable[[], Any], name: str) -> None:
        """Have something done behind what has come so far, without an answer; `name` is for the log."""
        self._keep(self._report(self._in_turn(work), name))

    async def _request(self, identifier: Id, method: str, params: msgspec.Raw) -> None:
        work = self._find(method, True)
        if work is None:
            await self._answer_error(identifier, METHOD_NOT_FOUND, f"There is no method '{method}'")
        elif identifier in self._waiting:
            await self._answer_error(identifier, INVALID_REQUEST, f"The id {identifier} is in use")
        elif len(self._waiting) >= MAX_WAITING:
            await self._answer_error(identifier, REQUEST_FAILED, "Too many requests are waiting")
        else:
            self._keep(self._reply(identifier, method, self._submit(identifier, work, params)))

    def _submit(self, identifier: Id, work: Work, params: msgspec.Raw) -> asyncio.Future[Any]:
        future = self._in_turn(lambda: msgspec.Raw(_ENCODER.encode(work(params))))
        self._waiting[identifier] = future
        return future

    def _in_turn(self, work: Callable[[], Any]) -> asyncio.Future[Any]:
        """The result of work behind what has come so far."""
        future: asyncio.Future[Any] = self._loop.create_future()
        self._queue.append((future, work))
        self._next()
        return future

    def _next(self) -> None:
        """Give the thread the next piece of work, if it has none of this endpoint."""
        while self._at_work is None and self._queue:
            future, work = self._queue.popleft()
            if not future.cancelled():
                self._at_work = self._loop.run_in_executor(self._thread, work)
                self._at_work.add_done_callback(partial(self._done, future))

    def _done(self, future: asyncio.Future[Any], done: asyncio.Future[Any]) -> None:
        self._at_work = None
        error = None if done.cancelled() else done.exception()
        if done.cancelled():
            future.cancel()
        elif not future.done():
            if error is not None:
                future.set_exception(error)
            else:
                future.set_result(done.result())
        self._next()

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
            answer = _ENCODER.encode(_Result(identifier, result)).decode()
            await self._send(Outgoing(answer, identifier))
        finally:
            self._waiting.pop(identifier, None)

    async def _report(self, future: asyncio.Future[Any], name: str) -> None:
        try:
            await future
        except RpcError as error:
            log.info("notification '%s': %s", name, error)
        except Exception:
            log.exception("notification '%s' failed", name)

    async def notify(self, method: str, params: Any, replaces: str = "") -> None:
        """Send a notification; `replaces`: in place of an unsent one with this key."""
        await self._send(Outgoing(notification(method, params), replaces=replaces))

    async def close(self) -> None:
        """Drop what waits; what is done in the thread now ends without an answer."""
        self._queue.clear()
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def settle(self) -> None:
        """Wait until everything received so far is answered."""
        while self._tasks:
            await asyncio.gather(*list(self._tasks), return_exceptions=True)

    def _keep(self, work: Any) -> None:
        task: asyncio.Task[None] = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answer_error(self, identifier: Id | None, code: int, message: str) -> None:
        await self._send(Outgoing(failure(identifier, code, self._say(message)), identifier))
