"""Conversations over a socket as one value, and how they are spoilt.

A conversation is a msgpack list of [kind, data]: `text` and `binary` frames, `lie` a frame that says another
length, `part` one that has no end, `code` one of an unknown opcode, `raw` bytes that are no frame.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from random import Random
from typing import Any

import msgpack
from door_client import BINARY, TEXT, frame
from mutations import change, mutated_bytes

Piece = tuple[str, bytes]
OVERSIZED = 5 << 20
"""More than any door takes in one message."""
TEXT_SPICE = (
    10**400, -1, 0, 1.5, 2**63, 2**64, -(2**63) - 1, "", "x" * 5000, "\ud800", "\udfff\ud800", "\0", None,
    True, [], {}, [[[[[[]]]]]], float("nan"), float("inf"), "../../etc/passwd", "PLC_PRG", "tappet:/",
)  # fmt: skip
DEPTH = 3000


def packed(pieces: Iterable[Piece]) -> bytes:
    return bytes(msgpack.packb(list(pieces)))


def texts(*messages: Any) -> bytes:
    return packed(("text", json.dumps(message).encode()) for message in messages)


def unpacked(data: bytes) -> list[Piece]:
    return [(kind, content) for kind, content in msgpack.unpackb(data)]


def spoilt(r: Random, seeds: list[bytes]) -> bytes:
    """A conversation with some of its messages changed, repeated, lost, in another order, or broken."""
    pieces = unpacked(r.choice(seeds))
    for _ in range(r.choice((1, 1, 2, 4, 8))):
        at = r.randrange(len(pieces) + 1)
        match r.randrange(10):
            case 0:
                del pieces[at : at + r.choice((1, 1, 3))]
            case 1:
                pieces[at:at] = pieces[at : at + 3] * r.choice((1, 2, 20))
            case 2:
                pieces.insert(at, r.choice(unpacked(r.choice(seeds))))
            case 3:
                r.shuffle(pieces)
            case 4:
                pieces.insert(at, _broken(r, pieces))
            case _:
                if at < len(pieces):
                    pieces[at] = _changed(r, pieces[at], seeds)
    return packed(pieces)


def _broken(r: Random, pieces: list[Piece]) -> Piece:
    content = r.choice(pieces)[1] if pieces else b"x"
    match r.randrange(12):
        case 0:
            return "text", b"[" * DEPTH
        case 1:
            return "text", b'{"op":' * DEPTH
        case 2 if r.randrange(8) == 0:
            return r.choice(("text", "binary")), b"9" * OVERSIZED
        case 3:
            return "lie", content
        case 4:
            return "part", content
        case 5:
            return "code", content
        case 6:
            return "raw", r.randbytes(r.choice((1, 20, 300)))
        case 7:
            return "text", b"\xff\xfe" + content
        case 8:
            return "text", content[: r.randrange(len(content) + 1)]
        case 9:
            return "binary", r.randbytes(r.choice((0, 1, 60, 5000)))
        case 10:
            return "binary", content
    return "text", content.decode("utf-8", "replace").encode()


def _changed(r: Random, piece: Piece, seeds: list[bytes]) -> Piece:
    kind, content = piece
    if r.randrange(5) == 0:
        return kind, mutated_bytes(r, [content, *(inner for _, inner in unpacked(r.choice(seeds)))])
    try:
        value = json.loads(content) if kind == "text" else msgpack.unpackb(content, strict_map_key=False)
        if not isinstance(value, dict | list):
            raise ValueError(value)
        for _ in range(r.choice((1, 1, 2, 5))):
            change(r, value, TEXT_SPICE if kind == "text" else None)
        encoded = json.dumps(value).encode() if kind == "text" else bytes(msgpack.packb(value))
    except (ValueError, msgpack.UnpackException, TypeError, OverflowError, RecursionError):
        encoded = mutated_bytes(r, [content])
    return kind, encoded


def wire(pieces: Iterable[Piece]) -> Iterator[bytes]:
    """What goes over the connection."""
    for kind, content in pieces:
        match kind:
            case "text":
                yield frame(TEXT, content)
            case "binary":
                yield frame(BINARY, content)
            case "lie":
                yield frame(TEXT, content, length=len(content) + 70_000)
            case "part":
                yield frame(TEXT, content, final=False)
            case "code":
                yield frame(5, content)
            case _:
                yield content


def is_whole(pieces: Iterable[Piece]) -> bool:
    """Whether a further frame behind them is one."""
    return all(kind in ("text", "binary") for kind, _ in pieces)
