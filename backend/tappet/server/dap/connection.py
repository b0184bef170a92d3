"""Requests in, answers and events out: what every command of the protocol has in common."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

from tappet.server.dap import messages as m
from tappet.server.dap.debuggee import Refused
from tappet.translation.language import Language
from tappet.translation.sentences import sentence

Send = Callable[[str], Awaitable[None]]
Handler = Callable[[m.Request], Awaitable[Any]]
"""Carries a request out; the body of the answer. Raises Refused, MessageError, ConnectionError."""


class Connection:
    """The messages of one client."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._number = 0
        self.language: Language = "en"
        """In which refusals and events are said."""

    async def serve(self, text: str, handlers: dict[str, Handler]) -> m.Request | None:
        """Answer one message; the request, where it was carried out. Raises ConnectionError behind the
        answer.
        """
        try:
            request = m.read_request(text)
        except m.MessageError as error:
            await self.output(str(error), "stderr")
            return None
        if request is None:
            return None
        try:
            handler = handlers.get(request.command)
            if handler is None:
                raise m.MessageError(f"There is no request '{request.command}'")
            body = await handler(request)
        except (Refused, m.MessageError) as error:
            await self._refuse(request, str(error))
            return None
        except ConnectionError as error:
            await self._refuse(request, str(error))
            raise
        await self._answer(request, {"success": True} | ({"body": body} if body is not None else {}))
        return request

    async def _refuse(self, request: m.Request, english: str) -> None:
        reason = sentence(english, self.language)
        error = {"id": 1, "format": "{reason}", "variables": {"reason": reason}, "showUser": True}
        await self._answer(request, {"success": False, "message": reason, "body": {"error": error}})

    async def _answer(self, request: m.Request, result: dict[str, Any]) -> None:
        answer = {"type": "response", "request_seq": request.seq, "command": request.command}
        await self._write(answer | result)

    async def event(self, name: str, body: dict[str, Any]) -> None:
        """Something happened."""
        await self._write({"type": "event", "event": name, "body": body})

    async def output(self, text: str, category: str = "console") -> None:
        """A line in the client's debug console."""
        said = sentence(text.removesuffix("\n"), self.language)
        await self.event("output", {"category": category, "output": f"{said}\n"})

    async def _write(self, message: dict[str, Any]) -> None:
        self._number += 1
        await self._send(m.encode({"seq": self._number, **message}))
