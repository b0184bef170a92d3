"""The source in the controller: in chunks, one file of one name, what is damaged or too large."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from plc_programs import MS, build

from tappet.iec.task import Task
from tappet.runtime.client import RuntimeClient, RuntimeRefused
from tappet.runtime.errors import PlcError
from tappet.runtime.operations.life_cycle import Reset
from tappet.runtime.operations.source import (
    BeginSource,
    CommitSource,
    GetSource,
    ReadSource,
    RemoveSource,
    SourceChunk,
)
from tappet.runtime.plc import SoftPlc
from tappet.runtime.service import RuntimeService
from tappet.runtime.source_archive import FILE, MAX_SOURCE, SourceNote, SourceStore
from tappet.runtime.source_transfer import SourceError, read_source, send_source

TOKEN = "a token of the tests, long enough"
FAST = (Task("Main", interval_ns=2 * MS, programs=("PLC_PRG",)),)
NOTE = SourceNote("Press", "me", 1_700_000_000_000, "code")


async def test_a_source_of_several_chunks_is_stored_read_and_deleted(tmp_path: Path) -> None:
    plc = SoftPlc(tmp_path)
    server = RuntimeService(plc, TOKEN)
    port = await server.start("127.0.0.1", 0)
    archive = os.urandom(2_500_000)
    try:
        async with await RuntimeClient.connect(f"ws://127.0.0.1:{port}", TOKEN) as client:
            assert await client.call(GetSource()) is None
            with pytest.raises(SourceError, match="there is no source"):
                await read_source(client)
            package = build("PROGRAM PLC_PRG\nEND_PROGRAM", FAST)
            await client.download(package.to_bytes())
            info = await client.store_source(
                archive, project="Press", stored_by="me", code_id=package.code_id
            )
            assert info is not None
            assert (info.project, info.size, info.current) == ("Press", len(archive), True)
            assert await read_source(client) == (info, archive)
            other = await send_source(client, b"short", project="Press", stored_by="me", code_id="old")
            assert other is not None
            assert not other.current
            with pytest.raises(RuntimeRefused, match="changed meanwhile"):
                await client.call(ReadSource(info.digest, 0, 10))
            await client.call(RemoveSource())
            assert await client.call(GetSource()) is None
            await client.store_source(archive, project="Press", stored_by="me", code_id="")
            await client.call(Reset("origin"))
            assert await client.call(GetSource()) is None
    finally:
        await server.close()
        plc.close()


async def test_what_is_not_as_announced_is_refused() -> None:
    plc = SoftPlc(None)
    server = RuntimeService(plc, TOKEN)
    port = await server.start("127.0.0.1", 0)
    try:
        async with await RuntimeClient.connect(f"ws://127.0.0.1:{port}", TOKEN) as client:
            commit = CommitSource("p", "me", 0, "")
            with pytest.raises(RuntimeRefused, match="0 of 0 bytes"):
                await client.call(commit)
            with pytest.raises(RuntimeRefused, match="no source has begun"):
                await client.call(SourceChunk(b"x"))
            await client.call(BeginSource(3))
            with pytest.raises(RuntimeRefused, match="more than the announced 3 bytes"):
                await client.call(SourceChunk(b"1234"))
            await client.call(BeginSource(3))
            await client.call(SourceChunk(b"12"))
            with pytest.raises(RuntimeRefused, match="2 of 3 bytes"):
                await client.call(commit)
            with pytest.raises(RuntimeRefused, match="source_begin: 'size'"):
                await client.call(BeginSource(MAX_SOURCE + 1))
            assert await client.call(GetSource()) is None
            with pytest.raises(SourceError, match="at most 64 MiB"):
                await send_source(client, bytes(MAX_SOURCE + 1), project="p", stored_by="me", code_id="")
    finally:
        await server.close()
        plc.close()


def test_the_archive_is_one_file_and_survives_a_restart(tmp_path: Path) -> None:
    SourceStore(tmp_path).put(SourceNote("../../etc/passwd", "/root", 1, "c"), b"archive")
    assert [path.name for path in tmp_path.iterdir()] == [FILE]
    assert (tmp_path / FILE).stat().st_mode & 0o077 == 0
    info = SourceStore(tmp_path).info("c")
    assert info is not None
    assert (info.project, info.size, info.current) == ("../../etc/passwd", 7, True)
    assert SourceStore(tmp_path).read(info.digest, 2, 100) == b"chive"
    assert SourceStore(tmp_path).read(info.digest, 100, 100) == b""


def test_a_store_without_folder_keeps_it_in_memory() -> None:
    store = SourceStore(None)
    store.put(NOTE, b"archive")
    info = store.info("other")
    assert info is not None
    assert not info.current
    assert store.read(info.digest, 0, 3) == b"arc"
    store.remove()
    assert store.info(None) is None


def test_too_large_a_source_leaves_what_is_there(tmp_path: Path) -> None:
    store = SourceStore(tmp_path)
    store.put(NOTE, b"old")
    with pytest.raises(PlcError, match="at most 64 MiB"):
        store.put(NOTE, bytes(MAX_SOURCE + 1))
    found = store.info("code")
    assert found is not None
    assert found.size == 3


@given(st.data())
def test_damaged_files_are_no_source(data: st.DataObject) -> None:
    """Cut off, changed or foreign: there is nothing, or what is told fits the digest."""
    import tempfile

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        store = SourceStore(folder)
        store.put(NOTE, b"archive" * 10)
        content = (folder / FILE).read_bytes()
        cut = data.draw(st.integers(0, len(content)))
        rest = data.draw(st.binary(max_size=20))
        (folder / FILE).write_bytes(content[:cut] + rest)
        info = store.info("code")
        if info is not None:
            assert info.size == len(store.read(info.digest, 0, 1000))
