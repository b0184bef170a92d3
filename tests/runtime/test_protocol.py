"""The wire format: what is malformed is refused by name, and nothing else ever comes out."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.runtime import protocol, recorder_wire
from tappet.runtime.operations import registry
from tappet.runtime.operations.declaration import reply_type
from tappet.runtime.operations.values import Read, Write
from tappet.runtime.protocol import ProtocolError

scalars = (
    st.none() | st.booleans() | st.integers(-(1 << 63), (1 << 64) - 1) | st.text() | st.binary() | st.floats()
)
values = st.recursive(scalars, lambda v: st.lists(v) | st.dictionaries(st.text(), v), max_leaves=20)
HOSTILE = {
    "deep arrays": b"\x91" * 1_000_000,
    "deep maps": b"\x81\xa1a" * 300_000,
    "an array of four thousand million": b"\xdd\xff\xff\xff\xff",
    "a map of four thousand million": b"\xdf\xff\xff\xff\xff",
    "four gigabytes": b"\xc6\xff\xff\xff\xff",
    "a text that is no UTF-8": b"\xa2\xff\xfe",
    "an array that ends early": b"\x93\x01",
    "nothing": b"",
}


def head(op: str, args: bytes) -> bytes:
    """A request with arguments that are any bytes."""
    return protocol.pack({"id": 1, "op": op, "args": msgspec.Raw(args)})


def parsed(data: bytes | str) -> Any:
    return protocol.parse_arguments(protocol.parse_request(data), registry.known())


@given(st.binary(max_size=300) | st.text())
def test_any_bytes_give_a_request_or_a_protocol_error(data: bytes | str) -> None:
    try:
        request = protocol.parse_request(data)
    except ProtocolError:
        return
    assert isinstance(request.op, str)


@given(st.dictionaries(st.sampled_from(["v", "id", "op", "args", "x"]), values))
def test_any_map_gives_a_request_or_a_protocol_error(message: dict[str, object]) -> None:
    try:
        request = protocol.parse_request(msgspec.msgpack.encode(message))
    except ProtocolError:
        return
    assert message["v"] == protocol.VERSION
    assert request.id == message["id"]


@given(st.sampled_from(sorted(registry.known())), values)
def test_any_arguments_give_the_operation_or_a_protocol_error(op: str, args: object) -> None:
    message = protocol.pack({"id": 1, "op": op, "args": args})
    refusal = None
    try:
        assert parsed(message).op == op
    except ProtocolError as error:
        refusal = error
    assert refusal is None or (refusal.code == "bad_request" and str(refusal).startswith(f"{op}: "))


@pytest.mark.parametrize("data", HOSTILE.values(), ids=HOSTILE)
def test_hostile_frames_are_refused(data: bytes) -> None:
    with pytest.raises(ProtocolError):
        protocol.parse_request(data)
    with pytest.raises(ProtocolError):
        protocol.parse_message(data)
    for op in registry.known():
        with pytest.raises(ProtocolError):
            parsed(head(op, data))


@pytest.mark.parametrize("data", HOSTILE.values(), ids=HOSTILE)
def test_hostile_replies_are_refused(data: bytes) -> None:
    for kind in registry.known().values():
        with pytest.raises(ProtocolError, match=f"reply to {kind.op}"):
            protocol.parse_result(kind, msgspec.Raw(data))


@pytest.mark.parametrize(
    ("op", "args", "message"),
    [
        ("read", {"places": [[1, -1]]}, r"read: 'places\[0\]\[1\]': expected 'int' >= 1"),
        ("read", {"places": [[1]]}, r"read: 'places\[0\]': expected 'array' of length 2, got 1"),
        ("read", {}, "read: object missing required field 'places'"),
        ("read", {"places": [], "x": 1}, "read: object contains unknown field 'x'"),
        ("read", {"places": [[0, 1]] * 100_001}, r"read: 'places': expected 'array' of length <= 100000"),
        ("write", {"values": [[0, b"", 8]]}, r"write: 'values\[0\]\[2\]': expected 'int' <= 7"),
        ("hello", {"token": "x" * 5000}, "hello: 'token': expected 'str' of length <= 4096"),
        ("download_begin", {"size": True}, "download_begin: 'size': expected 'int', got 'bool'"),
        ("reset", {"kind": "hot"}, "reset: 'kind': invalid enum value 'hot'"),
        ("jump", {}, "unknown operation 'jump'"),
    ],
)
def test_a_wrong_field_is_named(op: str, args: dict[str, object], message: str) -> None:
    with pytest.raises(ProtocolError, match=f"^{message}"):
        parsed(protocol.pack({"id": 1, "op": op, "args": args}))


rows = st.lists(
    st.tuples(st.integers(0, 1 << 47), st.binary(min_size=1, max_size=9), st.none() | st.integers(0, 7))
)


@given(rows)
def test_arguments_come_back_as_sent(values: list[tuple[int, bytes, int | None]]) -> None:
    operation = Write(values)
    assert parsed(protocol.pack_request(1, operation)) == operation


def test_replies_come_back_as_sent() -> None:
    message = protocol.parse_message(protocol.pack_result(1, [b"ab", b""]))
    assert protocol.parse_result(Read, message.result) == [b"ab", b""]
    with pytest.raises(ProtocolError, match="reply to read: expected 'array', got 'int'"):
        protocol.parse_result(Read, msgspec.Raw(b"\1"))


def test_every_reply_has_a_type_that_can_be_sent() -> None:
    for kind in registry.known().values():
        msgspec.msgpack.Decoder(reply_type(kind))


@given(st.binary(max_size=100))
def test_recorder_frames_are_checked(data: bytes) -> None:
    try:
        batch = protocol.unpack_frames(b"\xc1" + data)
    except ProtocolError:
        return
    assert batch.count * batch.frame_size == len(batch.data)


def test_recorder_frames_round_trip() -> None:
    ring = b"".join(
        n.to_bytes(8, "little") + (n * 5).to_bytes(8, "little") + bytes([n] * 3) + b"\0" * 5 for n in (1, 2)
    )
    message = recorder_wire.pack_frames(7, 2, 24, 3, ring)
    assert protocol.is_frames(message)
    batch = protocol.unpack_frames(message)
    assert (batch.recorder, batch.dropped) == (7, 3)
    assert [(f.cycle, f.timestamp_ns, f.data) for f in batch.frames(3)] == [
        (1, 5, b"\1\1\1"),
        (2, 10, b"\2\2\2"),
    ]


@pytest.mark.parametrize("version", [1, 3])
def test_another_version_is_refused(version: int) -> None:
    for parse in (protocol.parse_request, protocol.parse_message):
        with pytest.raises(ProtocolError, match=f"protocol version {version} is not 2") as caught:
            parse(msgspec.msgpack.encode({"v": version, "id": 1, "op": "info"}))
        assert caught.value.code == "bad_version"


def test_messages_never_look_like_recorder_frames() -> None:
    assert not protocol.is_frames(protocol.pack({"id": 1}))
