"""The wire between a runtime and its clients: msgpack messages in binary WebSocket frames, and recorder
frames.

    request   {v: 1, id: n, op: "read", ...arguments}
    reply     {v: 1, id: n, result: ...}   or   {v: 1, id: n, error: {code, message}}
    event     {v: 1, event: "state", ...}
    recorder  0xC1, version, 0, 0, u32 recorder, u32 count, u32 frame size, u64 dropped, then `count` frames
of u64 cycle, i64 unix time in ns, values; little endian. 0xC1 begins no msgpack value.

The first message is `hello` with the token. Everything that comes from outside is checked here and in
`Fields`.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import msgpack

from tappet.runtime.recorder import Frame, split_frames

VERSION = 1
MAX_MESSAGE = 4 << 20
"""Largest message a runtime accepts, bytes; a package is sent in chunks."""
CHUNK = 1 << 20
"""Bytes of a package per message."""
MAX_PACKAGE = 512 << 20
MAX_ITEMS = 100_000
"""Largest number of places in one request."""
HELLO_TIMEOUT_S = 5.0

_RECORDER_MARK = 0xC1
_RECORDER_HEAD = struct.Struct("<BBHIIIQ")

CLOSE_HELLO, CLOSE_BAD_TOKEN, CLOSE_PROTOCOL, CLOSE_BUSY = 4400, 4401, 4402, 4429
"""WebSocket close codes: no proper hello in time, wrong token, too many malformed messages, too many
connections.
"""


class ProtocolError(ValueError):
    """A message is malformed or not permitted; `code` is for programs, the text for people."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


@dataclass(frozen=True, slots=True)
class Request:
    """A checked request head and its arguments."""

    id: int
    op: str
    fields: Fields


class Fields:
    """Arguments of a request, taken out one by one with their type."""

    def __init__(self, op: str, values: dict[str, Any]) -> None:
        self._op = op
        self._values = values

    def _bad(self, name: str, expected: str) -> ProtocolError:
        return ProtocolError("bad_request", f"{self._op}: '{name}' must be {expected}")

    def text(self, name: str, *, limit: int = 4096) -> str:
        """A string."""
        value = self._values.get(name)
        if not isinstance(value, str) or len(value) > limit:
            raise self._bad(name, f"a text of at most {limit} characters")
        return value

    def optional_text(self, name: str) -> str | None:
        """A string, or None when it is absent or nil."""
        return None if self._values.get(name) is None else self.text(name)

    def integer(
        self, name: str, default: int | None = None, *, low: int = 0, high: int = (1 << 63) - 1
    ) -> int:
        """An integer within bounds."""
        value = self._values.get(name, default)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise self._bad(name, f"an integer {low}..{high}")
        return value

    def flag(self, name: str) -> bool:
        """A boolean, false when absent."""
        value = self._values.get(name, False)
        if not isinstance(value, bool):
            raise self._bad(name, "true or false")
        return value

    def data(self, name: str, *, limit: int = CHUNK) -> bytes:
        """Bytes."""
        value = self._values.get(name)
        if not isinstance(value, bytes) or len(value) > limit:
            raise self._bad(name, f"at most {limit} bytes")
        return value

    def rows(self, name: str, width: int) -> list[list[Any]]:
        """A list of lists of `width` values."""
        value = self._values.get(name)
        if not isinstance(value, list) or len(value) > MAX_ITEMS:
            raise self._bad(name, f"a list of at most {MAX_ITEMS} entries")
        if not all(isinstance(row, list) and len(row) == width for row in value):
            raise self._bad(name, f"a list of entries with {width} values each")
        return value

    def optional_rows(self, name: str, width: int) -> list[list[Any]] | None:
        """Rows, or None when absent or nil."""
        return None if self._values.get(name) is None else self.rows(name, width)

    def places(self, name: str) -> list[tuple[int, int]]:
        """(offset, size) pairs of at least one byte each."""
        result = []
        for offset, size in self.rows(name, 2):
            if not _is_natural(offset) or not _is_natural(size) or size == 0:
                raise self._bad(name, "pairs of offset and size")
            result.append((offset, size))
        return result

    def values(self, name: str) -> list[tuple[int, bytes, int | None]]:
        """(offset, bytes, bit or nil) triples."""
        result = []
        for offset, data, bit in self.rows(name, 3):
            if not _is_natural(offset) or not isinstance(data, bytes) or not _is_bit(bit):
                raise self._bad(name, "triples of offset, bytes and bit (0..7 or nil)")
            result.append((offset, data, bit))
        return result

    def keys(self, name: str) -> list[tuple[int, int | None]] | None:
        """(offset, bit or nil) pairs, or None."""
        rows = self.optional_rows(name, 2)
        if rows is None:
            return None
        for offset, bit in rows:
            if not _is_natural(offset) or not _is_bit(bit):
                raise self._bad(name, "pairs of offset and bit (0..7 or nil)")
        return [(offset, bit) for offset, bit in rows]


def _is_natural(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1 << 48


def _is_bit(value: object) -> bool:
    return value is None or (isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= 7)


def pack(message: dict[str, Any]) -> bytes:
    """A message as bytes."""
    packed: bytes = msgpack.packb({"v": VERSION, **message}, use_bin_type=True)
    return packed


def unpack(data: bytes | str) -> dict[str, Any]:
    """A message out of a frame; ProtocolError when it is none of this version."""
    if isinstance(data, str):
        raise ProtocolError("bad_frame", "messages are binary frames")
    try:
        message = msgpack.unpackb(data, raw=False, strict_map_key=True, max_array_len=MAX_ITEMS * 4)
    except (ValueError, TypeError, RecursionError, msgpack.UnpackException) as error:
        raise ProtocolError("bad_frame", f"not a msgpack message: {error}") from error
    if not isinstance(message, dict):
        raise ProtocolError("bad_frame", "a message is a map")
    if message.get("v") != VERSION or isinstance(message.get("v"), bool):
        raise ProtocolError("bad_version", f"protocol version {message.get('v')!r} is not {VERSION}")
    return message


def parse_request(data: bytes | str) -> Request:
    """A request out of a frame."""
    message = unpack(data)
    number, op = message.get("id"), message.get("op")
    if not isinstance(number, int) or isinstance(number, bool) or not 0 <= number < 1 << 53:
        raise ProtocolError("bad_frame", "'id' must be an integer 0..2^53")
    if not isinstance(op, str):
        raise ProtocolError("bad_frame", "'op' must be a text")
    return Request(number, op, Fields(op[:40], message))


def pack_result(number: int, result: Any) -> bytes:
    """Reply to a request that succeeded."""
    return pack({"id": number, "result": result})


def pack_error(number: int | None, code: str, text: str) -> bytes:
    """Reply to a request that failed; `number` None when it could not be read."""
    return pack({"id": number, "error": {"code": code, "message": text}})


def pack_frames(recorder: int, count: int, frame_size: int, dropped: int, data: bytes) -> bytes:
    """Frames of a recorder as one binary message."""
    return _RECORDER_HEAD.pack(_RECORDER_MARK, VERSION, 0, recorder, count, frame_size, dropped) + data


def is_frames(data: bytes | str) -> bool:
    """Whether a frame carries recorder data."""
    return isinstance(data, bytes) and data[:1] == b"\xc1"


@dataclass(frozen=True, slots=True)
class FrameBatch:
    """Recorder data as received."""

    recorder: int
    dropped: int
    frame_size: int
    count: int
    data: bytes

    def frames(self, data_size: int) -> list[Frame]:
        """The frames, oldest first."""
        return split_frames(self.data, self.count, self.frame_size, data_size)


def unpack_frames(data: bytes) -> FrameBatch:
    """Recorder data out of a frame; ProtocolError when lengths do not fit."""
    if len(data) < _RECORDER_HEAD.size:
        raise ProtocolError("bad_frame", "recorder frame shorter than its head")
    _, version, _, recorder, count, frame_size, dropped = _RECORDER_HEAD.unpack_from(data)
    if version != VERSION:
        raise ProtocolError("bad_version", f"recorder frames of version {version} are not known")
    body = data[_RECORDER_HEAD.size :]
    if frame_size < 16 or count * frame_size != len(body):
        raise ProtocolError("bad_frame", f"{len(body)} bytes are not {count} frames of {frame_size}")
    return FrameBatch(recorder, dropped, frame_size, count, body)
