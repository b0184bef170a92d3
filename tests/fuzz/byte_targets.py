"""Readers of files and frames: what a person uploads, and what comes over the wire."""

from __future__ import annotations

import base64
import contextlib
import hashlib
import io
import zipfile
import zlib
from functools import cache
from pathlib import Path

import msgspec

from tappet.codegen.build import build_application
from tappet.codegen.literals import format_string, format_time, parse_string, parse_time
from tappet.codegen.package import CodePackage, PackageError
from tappet.lang.source import Source
from tappet.libraries import archive as library_archive
from tappet.project.errors import FolderFormatError
from tappet.project.folder import archive as project_archive
from tappet.project.folder import codec
from tappet.runtime import protocol, recorder_wire
from tappet.runtime.flight_recording import RecordingError, read_recording, write_recording
from tappet.runtime.local import LocalRuntime
from tappet.runtime.operations import registry
from tappet.runtime.operations.download import DownloadChunk
from tappet.runtime.operations.life_cycle import Reset
from tappet.runtime.operations.recording import Record
from tappet.runtime.operations.symbols import GetSymbols, LoadedSymbols
from tappet.runtime.operations.values import Read, Unforce, Write

ROOT = Path(__file__).resolve().parents[2]
SEPARATOR = b"\n=== "
"""Begins the path of the next file of a folder that is one text."""
TIMES = ("time", "ltime", "date", "ldate", "tod", "ltod", "dt", "ldt")


def folder(data: bytes) -> None:
    """The files of a project folder, one behind the other."""
    files = {}
    for part in (b"\n" + data).split(SEPARATOR)[1:]:
        path, _, content = part.partition(b"\n")
        files[path.decode("utf-8", "replace")] = content
    with contextlib.suppress(FolderFormatError):
        codec.encode(codec.decode(files).project)


@cache
def _example() -> dict[str, bytes]:
    root = ROOT / "projects" / "bottling"
    return {str(p.relative_to(root)): p.read_bytes() for p in sorted(root.rglob("*")) if p.is_file()}


def folders() -> list[bytes]:
    files = _example()
    few = {path: content for path, content in files.items() if len(content) < 3000}
    return [b"".join(SEPARATOR + p.encode() + b"\n" + c for p, c in some.items()) for some in (files, few)]


def archive(data: bytes) -> None:
    """A packed project."""
    with contextlib.suppress(FolderFormatError):
        project_archive.read_zip(data)


def archives() -> list[bytes]:
    stored = io.BytesIO()
    with zipfile.ZipFile(stored, "w") as packed:
        packed.writestr("tappet-project.json", _example()["tappet-project.json"])
    return [project_archive.zip_files(_example()), stored.getvalue()]


def library_file(data: bytes) -> None:
    """A library to install."""
    with contextlib.suppress(library_archive.LibraryFileError):
        library_archive.unpack(data)


def library_files() -> list[bytes]:
    texts = {"F": "FUNCTION F : INT\nEND_FUNCTION\n"}
    facts = library_archive.manifest("Mine", "1.0.0.0", company="Me", requires=[])
    return [library_archive.pack(facts, texts)]


def package(data: bytes) -> None:
    """Code that is sent to a runtime."""
    with contextlib.suppress(PackageError):
        CodePackage.from_bytes(data).to_bytes()


@cache
def packages() -> list[bytes]:
    text = (
        "PROGRAM PLC_PRG\nVAR RETAIN n : INT; END_VAR VAR t : TON; END_VAR\nt(); n := n + 1;\nEND_PROGRAM\n"
    )
    built = build_application([Source("a.st", text)]).package
    assert built is not None
    return [built.to_bytes()]


def flight(data: bytes) -> None:
    """A recording of the flight recorder: as its content in a file, and as a file."""
    for text in (data.decode("utf-8", "replace"), _flight_file(data)):
        with contextlib.suppress(RecordingError):
            read_recording(text).code()


def _flight_file(content: bytes) -> str:
    packed = zlib.compress(content)
    head = f"TAPPET-FLIGHT 2 sha256={hashlib.sha256(packed).hexdigest()}"
    return f"{head}\n{base64.b64encode(packed).decode()}\n"


def flights() -> list[bytes]:
    with LocalRuntime(CodePackage.from_bytes(packages()[0])) as runtime:
        runtime.run(5)
        recording = runtime.plc.flight_recording()
    return [msgspec.msgpack.encode(recording), write_recording(recording).encode()]


def frame(data: bytes) -> None:
    """A message to a runtime, or recorder data; the same bytes as a reply to a client."""
    with contextlib.suppress(protocol.ProtocolError):
        if protocol.is_frames(data):
            batch = protocol.unpack_frames(data)
            batch.frames(batch.frame_size - 16)
            return
        protocol.parse_arguments(protocol.parse_request(data), registry.known())
    with contextlib.suppress(protocol.ProtocolError):
        message = protocol.parse_message(data)
        protocol.parse_result(GetSymbols, message.result)


def frames() -> list[bytes]:
    orders = [
        Read([(0, 4), (8, 1)]), Write([(0, b"abcd", None), (8, b"x", 3)]), Unforce([(0, None), (8, 7)]),
        Record([(0, 4)], "Main", 2), Reset("warm"), DownloadChunk(b"bytes"),
    ]  # fmt: skip
    requests = [protocol.pack_request(number, order) for number, order in enumerate(orders)]
    symbols = CodePackage.from_bytes(packages()[0]).symbols
    reply = protocol.pack_result(1, LoadedSymbols("code", symbols))
    return [*requests, reply, recorder_wire.pack_frames(1, 2, 20, 0, bytes(40))]


def literal(data: bytes) -> None:
    """A value that a person types."""
    text = data.decode("utf-8", "replace")
    for kind in TIMES:
        with contextlib.suppress(ValueError):
            format_time(kind, parse_time(kind, text))
    for wide in (False, True):
        with contextlib.suppress(ValueError):
            format_string(parse_string(text, wide), wide)


def literals() -> list[bytes]:
    texts = ["T#1d2h3m4s5ms", "LTIME#1us2ns", "D#2020-02-29", "DT#1999-12-31-23:59:59.5", "TOD#12:00:00.001"]
    return [text.encode() for text in [*texts, "'a$'b$0A'", '"\u00e4$00e4"', "t#-5ms", "T#1.5h"]]
