"""A client of the Debug Adapter Protocol for tests."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from typing import Any


class DapClient:
    """Sends requests as an editor does, and keeps what comes back in the order in which it came."""

    def __init__(self, send: Callable[[str], Awaitable[None]]) -> None:
        self._send = send
        self._seq = 0
        self.messages: list[dict[str, Any]] = []
        self._arrived = asyncio.Event()
        self._taken = 0

    async def take(self, text: str) -> None:
        """A message of the adapter."""
        self.messages.append(json.loads(text))
        self._arrived.set()

    async def request(self, command: str, **arguments: Any) -> dict[str, Any]:
        """The answer to a request."""
        self._seq += 1
        number = self._seq
        await self._send(
            json.dumps({"seq": number, "type": "request", "command": command, "arguments": arguments})
        )
        return await self._until(
            lambda message: message["type"] == "response" and message["request_seq"] == number, 0
        )

    async def body(self, command: str, **arguments: Any) -> Any:
        """The body of the answer to a request that succeeds."""
        answer = await self.request(command, **arguments)
        assert answer["success"], answer
        return answer.get("body")

    async def refusal(self, command: str, **arguments: Any) -> str:
        """Why a request is refused."""
        answer = await self.request(command, **arguments)
        assert not answer["success"], answer
        return str(answer["message"])

    async def event(self, name: str) -> Any:
        """The body of the next event with this name, behind those that were taken before."""
        found = await self._until(
            lambda message: message["type"] == "event" and message["event"] == name, self._taken
        )
        self._taken = self.messages.index(found) + 1
        return found["body"]

    async def _until(self, wanted: Callable[[dict[str, Any]], bool], start: int) -> dict[str, Any]:
        async with asyncio.timeout(60):
            while True:
                for message in self.messages[start:]:
                    if wanted(message):
                        return message
                self._arrived.clear()
                await self._arrived.wait()

    async def begin(self, breakpoints: dict[str, list[int]], **launch: Any) -> None:
        """What VS Code sends when a session begins."""
        await self.body(
            "initialize", clientID="vscode", adapterID="tappet", linesStartAt1=True, columnsStartAt1=True
        )
        await self.body(launch.pop("command", "launch"), **launch)
        await self.event("initialized")
        for path, lines in breakpoints.items():
            await self.body(
                "setBreakpoints",
                source={"name": path.rpartition("/")[2], "path": path},
                lines=lines,
                breakpoints=[{"line": line} for line in lines],
                sourceModified=False,
            )
        await self.body("setExceptionBreakpoints", filters=[])
        await self.body("configurationDone")
