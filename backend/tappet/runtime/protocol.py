"""The wire between a runtime and its clients: MessagePack in binary WebSocket frames, and recorder frames.

    request   {v: 2, id: n, op: "read", args: {...}}      `args` are the fields of the operation (operations/)
    reply     {v: 2, id: n, result: ...}   or   {v: 2, id: n, error: {code, message}}
    event     {v: 2, event: "state", ...}
    recorder  0xC1, version, 0, 0, u32 recorder, u32 count, u32 frame size, u64 dropped, then `count` frames
of u64 cycle, i64 unix time in ns, values; little endian. 0xC1 begins no MessagePack value.

The first message is `hello` with the token. What comes from outside is checked against the types of the
operation before its handler sees it; a message of another version is refused by its number.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta, Raw, Struct

from tappet.runtime import recorder_wire
from tappet.runtime.operations.declaration import OperationError, Reply, WireOperation, reply_type
from tappet.runtime.recorder import Frame, split_frames

M = TypeVar("M")
VERSION = recorder_wire.VERSION
MAX_MESSAGE = 4 << 20
"""Largest message a runtime accepts, bytes; a package is sent in chunks."""
HELLO_TIMEOUT_S = 5.0

_NOTHING, _EMPTY = Raw(b"\xc0"), Raw(b"\x80")

CLOSE_HELLO, CLOSE_BAD_TOKEN, CLOSE_PROTOCOL, CLOSE_BUSY = 4400, 4401, 4402, 4429
"""WebSocket close codes: no proper hello in time, wrong token, too many malformed messages, too many
connections.
"""


class ProtocolError(OperationError):
    """A message is malformed; `code` is for programs, the text for people."""


class Request(Struct):
    """The head of a request; its arguments are read when the operation is known."""

    v: int
    id: Annotated[int, Meta(ge=0, lt=1 << 53)]
    op: str
    args: Raw = _EMPTY


class Refusal(Struct):
    """Why a request was not served."""

    code: str
    message: str


class Message(Struct):
    """A reply or an event, as a client reads it."""

    v: int
    id: int | None = None
    result: Raw = _NOTHING
    error: Refusal | None = None
    event: str | None = None
    state: str = "unknown"
    recorder: int = 0


class _Versioned(Struct):
    v: int


_REQUEST = msgspec.msgpack.Decoder(Request)
_MESSAGE = msgspec.msgpack.Decoder(Message)
_VERSIONED = msgspec.msgpack.Decoder(_Versioned)


def pack(message: Mapping[str, Any]) -> bytes:
    """A message as bytes."""
    return msgspec.msgpack.encode({"v": VERSION, **message})


def pack_request(number: int, operation: WireOperation[Any]) -> bytes:
    """A request."""
    return pack({"id": number, "op": operation.op, "args": operation})


def pack_result(number: int, result: Any) -> bytes:
    """Reply to a request that succeeded."""
    return pack({"id": number, "result": result})


def pack_error(number: int | None, code: str, text: str) -> bytes:
    """Reply to a request that failed; `number` None when it could not be read."""
    return pack({"id": number, "error": Refusal(code, text)})


def parse_request(data: bytes | str) -> Request:
    """The head of a request; ProtocolError when it is none of this version."""
    return _decoded(_REQUEST, data)


def parse_message(data: bytes | str) -> Message:
    """A reply or an event; ProtocolError when it is none of this version."""
    return _decoded(_MESSAGE, data)


def _decoded(decoder: msgspec.msgpack.Decoder[M], data: bytes | str) -> M:
    if isinstance(data, str):
        raise ProtocolError("bad_frame", "messages are binary frames")
    try:
        version = _VERSIONED.decode(data).v
        if version != VERSION:
            raise ProtocolError("bad_version", f"protocol version {version} is not {VERSION}")
        return decoder.decode(data)
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
        raise ProtocolError("bad_frame", f"no message of this protocol: {_plain(error)}") from error


def parse_arguments(request: Request, known: Mapping[str, type[WireOperation[Any]]]) -> WireOperation[Any]:
    """The operation a request asks for. ProtocolError names the operation and the field that is wrong."""
    kind = known.get(request.op)
    if kind is None:
        raise ProtocolError("unknown_op", f"unknown operation '{request.op[:40]}'")
    try:
        return _decoder(kind).decode(request.args)
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
        raise ProtocolError("bad_request", f"{request.op}: {_plain(error)}") from error


def parse_result(kind: type[WireOperation[Reply]], result: Raw) -> Reply:
    """The reply to an operation. ProtocolError when it is none: the runtime is of another release."""
    try:
        reply: Reply = _reply_decoder(kind).decode(result)
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
        raise ProtocolError("bad_reply", f"reply to {kind.op}: {_plain(error)}") from error
    return reply


@cache
def _decoder(kind: type[WireOperation[Any]]) -> msgspec.msgpack.Decoder[WireOperation[Any]]:
    return msgspec.msgpack.Decoder(kind)


@cache
def _reply_decoder(kind: type[WireOperation[Any]]) -> msgspec.msgpack.Decoder[Any]:
    return msgspec.msgpack.Decoder(reply_type(kind))


def _plain(error: Exception) -> str:
    where, what = place_and_reason(error)
    return f"'{where}': {what}" if where else what


def place_and_reason(error: Exception) -> tuple[str, str]:
    """Which field is wrong, '' for the whole, and what is expected there."""
    if isinstance(error, RecursionError):
        return "", "nested too deeply"
    text, _, where = str(error).partition(" - at ")
    field = where.strip("`").removeprefix("$").lstrip(".")
    return field, text.replace("`", "'")[:1].lower() + text.replace("`", "'")[1:]


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
    if len(data) < recorder_wire.HEAD.size:
        raise ProtocolError("bad_frame", "recorder frame shorter than its head")
    _, version, _, recorder, count, frame_size, dropped = recorder_wire.HEAD.unpack_from(data)
    if version != VERSION:
        raise ProtocolError("bad_version", f"recorder frames of version {version} are not known")
    body = data[recorder_wire.HEAD.size :]
    if frame_size < 16 or count * frame_size != len(body):
        raise ProtocolError("bad_frame", f"{len(body)} bytes are not {count} frames of {frame_size}")
    return FrameBatch(recorder, dropped, frame_size, count, body)
