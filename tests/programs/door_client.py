"""A WebSocket client that sends what no library would: broken frames, raw bytes, half a conversation."""

from __future__ import annotations

import base64
import select
import socket
import struct
import time
from collections.abc import Iterable
from dataclasses import dataclass, field

TEXT, BINARY, PING = 1, 2, 9
MASK = b"\x01\x02\x03\x04"
PAUSE_S = 30
"""So long a door may take to answer."""


class DoorError(AssertionError):
    """A door does not do what it should."""


@dataclass(frozen=True)
class Door:
    """Where a socket is, and what opens it."""

    host: str
    port: int
    path: str
    headers: dict[str, str] = field(default_factory=dict)
    source: str = "127.0.0.1"
    """Address of the client."""


def masked(data: bytes) -> bytes:
    mask = (MASK * (len(data) // 4 + 1))[: len(data)]
    return (int.from_bytes(data, "little") ^ int.from_bytes(mask, "little")).to_bytes(len(data), "little")


def frame(opcode: int, data: bytes, *, final: bool = True, length: int | None = None) -> bytes:
    """A frame of a client; `length` lies about its size."""
    size = len(data) if length is None else length
    head = bytes([(0x80 if final else 0) | opcode])
    if size < 126:
        head += bytes([0x80 | size])
    elif size < 1 << 16:
        head += bytes([0x80 | 126]) + struct.pack(">H", size)
    else:
        head += bytes([0x80 | 127]) + struct.pack(">Q", size & ((1 << 64) - 1))
    return head + MASK + masked(data)


class Connection:
    """One socket; reads while it sends, so that neither side waits for the other."""

    def __init__(self, door: Door, *, asks: bool = True) -> None:
        self.heard = b""
        self.ended = False
        self._socket = socket.create_connection((door.host, door.port), PAUSE_S, (door.source, 0))
        self._socket.setblocking(False)
        self._poll = select.poll()
        self._poll.register(self._socket)
        if asks:
            try:
                self._ask(door)
            except DoorError:
                self.close()
                raise

    def _ask(self, door: Door) -> None:
        lines = {
            "Host": f"{door.host}:{door.port}",
            "Connection": "Upgrade",
            "Upgrade": "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": base64.b64encode(bytes(16)).decode(),
            **door.headers,
        }
        head = f"GET {door.path} HTTP/1.1\r\n" + "".join(f"{k}: {v}\r\n" for k, v in lines.items())
        self.send(head.encode() + b"\r\n")
        self.until(b"\r\n\r\n")
        if b" 101 " not in self.heard.split(b"\r\n")[0]:
            raise DoorError(f"{door.path} does not open: {self.heard[:500]!r}")

    def send(self, data: bytes) -> None:
        """All of it, or as much as the other side takes before it closes."""
        end, rest = time.monotonic() + PAUSE_S, memoryview(data)
        while rest and not self.ended:
            if time.monotonic() > end:
                raise DoorError("what is sent is not taken")
            self._wait(select.POLLIN | select.POLLOUT)
            self._hear()
            if not self.ended:
                try:
                    rest = rest[self._socket.send(rest[: 1 << 16]) :]
                except BlockingIOError:
                    continue
                except OSError:
                    self.ended = True

    def push(self, data: bytes) -> bool:
        """Sends and never reads; False when the other side takes no more."""
        try:
            return self._socket.send(data) == len(data)
        except OSError:
            return False

    def until(self, sign: bytes) -> bool:
        """Waits for some bytes; whether they came before the end."""
        end = time.monotonic() + PAUSE_S
        while sign not in self.heard and not self.ended:
            if time.monotonic() > end:
                raise DoorError(f"no answer; heard {len(self.heard)} bytes")
            self._wait(select.POLLIN)
            self._hear()
        return sign in self.heard

    def answers(self) -> bool:
        """Asks for a sign of life; False when the other side has closed."""
        self.heard = b""
        self.send(frame(PING, b"alive?"))
        return self.until(b"\x8a\x06alive?")

    def close(self) -> None:
        self._socket.close()

    def _wait(self, events: int) -> None:
        self._poll.modify(self._socket, events)
        self._poll.poll(1000)

    def _hear(self) -> None:
        while not self.ended:
            try:
                data = self._socket.recv(1 << 16)
            except BlockingIOError:
                return
            except OSError:
                data = b""
            self.ended = not data
            self.heard = (self.heard + data)[-(1 << 20) :]


def play(door: Door, pieces: Iterable[bytes], *, whole: bool) -> None:
    """Sends pieces over a connection of their own. `whole`: they end with a frame, so that it must answer."""
    connection = Connection(door)
    try:
        for piece in pieces:
            connection.send(piece)
        if whole and not connection.ended:
            connection.answers()
    finally:
        connection.close()
