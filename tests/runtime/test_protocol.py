"""The wire format: what is malformed is refused by name, and nothing else ever comes out."""

import contextlib

import msgpack
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.runtime import protocol
from tappet.runtime.protocol import Fields, ProtocolError

scalars = (
    st.none() | st.booleans() | st.integers(-(1 << 63), (1 << 64) - 1) | st.text() | st.binary() | st.floats()
)
values = st.recursive(scalars, lambda v: st.lists(v) | st.dictionaries(st.text(), v), max_leaves=20)


@given(st.binary(max_size=300) | st.text())
def test_any_bytes_give_a_request_or_a_protocol_error(data: bytes | str) -> None:
    try:
        request = protocol.parse_request(data)
    except ProtocolError:
        return
    assert isinstance(request.op, str)


@given(st.dictionaries(st.sampled_from(["v", "id", "op", "x"]), values))
def test_any_map_gives_a_request_or_a_protocol_error(message: dict[str, object]) -> None:
    try:
        data = msgpack.packb(message)
    except (OverflowError, ValueError):
        return
    try:
        request = protocol.parse_request(data)
    except ProtocolError:
        return
    assert message["v"] == 1
    assert request.id == message["id"]


@given(values)
def test_fields_return_their_type_or_a_protocol_error(value: object) -> None:
    fields = Fields("test", {"x": value})
    for take in (
        fields.text,
        fields.integer,
        fields.data,
        fields.places,
        fields.values,
        fields.keys,
        fields.flag,
    ):
        with contextlib.suppress(ProtocolError):
            take("x")


def test_a_wrong_field_is_named() -> None:
    with pytest.raises(ProtocolError, match="read: 'places' must be pairs of offset and size"):
        Fields("read", {"places": [[1, -1]]}).places("places")


@given(
    st.lists(
        st.tuples(st.integers(0, 1 << 47), st.binary(min_size=1, max_size=9), st.none() | st.integers(0, 7))
    )
)
def test_values_come_back_as_sent(rows: list[tuple[int, bytes, int | None]]) -> None:
    message = protocol.pack({"id": 1, "op": "write", "values": [list(r) for r in rows]})
    assert protocol.parse_request(message).fields.values("values") == rows


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
    message = protocol.pack_frames(7, 2, 24, 3, ring)
    assert protocol.is_frames(message)
    batch = protocol.unpack_frames(message)
    assert (batch.recorder, batch.dropped) == (7, 3)
    assert [(f.cycle, f.timestamp_ns, f.data) for f in batch.frames(3)] == [
        (1, 5, b"\1\1\1"),
        (2, 10, b"\2\2\2"),
    ]


def test_another_version_is_refused() -> None:
    with pytest.raises(ProtocolError) as caught:
        protocol.parse_request(msgpack.packb({"v": 2, "id": 1, "op": "info"}))
    assert caught.value.code == "bad_version"


def test_messages_never_look_like_recorder_frames() -> None:
    assert not protocol.is_frames(protocol.pack({"id": 1}))
