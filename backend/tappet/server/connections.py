"""How many connections the server takes, from where, and how long they may be silent.

uvicorn waits without end for the first request of a connection, and takes as many as there are file
descriptors; then nobody gets in. Here a connection must send the head of a request within `HEAD_S`, go on
sending its body and taking the answer, each within `SILENCE_S`, and there are at most `limits.total` of them,
`limits.of_address` of one address. WebSockets count too; uvicorn's pings end those that are silent.
"""

from __future__ import annotations

import asyncio
import logging
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from tappet.server.connection_limits import ConnectionLimits

log = logging.getLogger(__name__)
HEAD_S = 15.0
"""For the head of a request, whether the connection is new or was used before."""
SILENCE_S = 60.0
"""Between two pieces of a body that is sent, or of an answer that is taken."""


class LimitedProtocol(H11Protocol):
    """HTTP of one connection, within `limits`; `limited_protocol` makes the class for a server."""

    limits = ConnectionLimits()
    head_s = HEAD_S
    silence_s = SILENCE_S

    def __init__(self, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        self._timer: asyncio.TimerHandle | None = None
        self._writing: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Refuses what exceeds the limits, at once and without an answer."""
        address = (transport.get_extra_info("peername") or ("",))[0]
        clients = [getattr(one, "client", None) for one in self.connections]
        same = sum(client is not None and client[0] == address for client in clients)
        if len(self.connections) >= self.limits.total or same >= self.limits.of_address:
            log.warning(
                "a connection from %s was refused: %d are open, %d of them from there",
                address,
                len(self.connections),
                same,
            )
            self.transport = transport
            transport.abort()
            return
        super().connection_made(transport)
        self._expect(self.head_s)

    def data_received(self, data: bytes) -> None:
        """Watches over the next piece, if one must come."""
        if self.flow is None:  # refused
            return
        waited_for_head = self._waits_for_head()
        super().data_received(data)
        if self.transport.is_closing() or self.transport.get_protocol() is not self:
            self._expect(None)
        elif self._waits_for_head():
            if not waited_for_head or self._timer is None:  # pieces of a head do not prolong its time
                self._expect(self.head_s)
        elif self.conn.their_state is h11.SEND_BODY:
            self._expect(self.silence_s)
        else:
            self._expect(None)

    def connection_lost(self, exc: Exception | None) -> None:
        """Ends the timers."""
        self._expect(None)
        self._stop_writing_timer()
        if self.flow is None:
            return
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """The client takes its answer no longer."""
        super().pause_writing()
        self._stop_writing_timer()
        self._writing = self.loop.call_later(self.silence_s, self._give_up)

    def resume_writing(self) -> None:
        """It does again."""
        self._stop_writing_timer()
        super().resume_writing()

    def _waits_for_head(self) -> bool:
        return self.conn.their_state is h11.IDLE

    def _expect(self, seconds: float | None) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if seconds is not None:
            self._timer = self.loop.call_later(seconds, self._too_late)

    def _too_late(self) -> None:
        self._timer = None
        if self.flow is not None and self.flow.read_paused:  # the server is behind, not the client
            self._expect(self.silence_s)
        else:
            self._give_up()

    def _give_up(self) -> None:
        log.debug("a connection from %s was closed: it was silent", self.client)  # browsers keep spare ones
        self.transport.abort()

    def _stop_writing_timer(self) -> None:
        if self._writing is not None:
            self._writing.cancel()
            self._writing = None


def limited_protocol(given: ConnectionLimits) -> type[LimitedProtocol]:
    """The protocol of a server with these limits."""

    class Protocol(LimitedProtocol):
        limits = given

    return Protocol
