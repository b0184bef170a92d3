"""The language server on files: folders, uris, and the process that an editor starts."""

from __future__ import annotations

import asyncio
import json
import sys
from pathlib import Path
from typing import Any

import pytest
from lsp_client import Client

from tappet.lang.services.workspace import Workspace
from tappet.project import edit, folder
from tappet.project.new_project import new_project
from tappet.server.framed_messages import FrameError, frame, read_message
from tappet.server.lsp.folder_programs import FolderPrograms, canonical_uri, file_uri


def write(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.mark.parametrize(
    ("uri", "expected"),
    [
        ("file:///c%3A/a%20b/x.st", "file:///c:/a%20b/x.st"),
        ("file:///C:/a b/x.st", "file:///c:/a%20b/x.st"),
        ("FILE:///home/x.st", "file:///home/x.st"),
        ("file:///home/%C3%A4.st", "file:///home/%C3%A4.st"),
        ("untitled:Untitled-1", "untitled:Untitled-1"),
    ],
)
def test_uris_have_one_spelling(uri: str, expected: str) -> None:
    assert canonical_uri(uri) == expected
    assert canonical_uri(expected) == expected


def test_plain_folder(tmp_path: Path) -> None:
    write(
        tmp_path,
        {
            "a.st": "PROGRAM P END_PROGRAM",
            "sub/b.ST": "FUNCTION F : INT END_FUNCTION",
            "c.txt": "x",
            ".git/d.st": "",
        },
    )
    programs = FolderPrograms(tmp_path)
    (program,) = programs({})
    own = [t for t in program.texts if not t.read_only]
    assert [Path(t.source.uri).name for t in own] == ["a.st", "b.ST"]
    assert own[0].segments[0].document == file_uri(tmp_path / "a.st")
    (program,) = programs(
        {file_uri(tmp_path / "a.st"): "PROGRAM Q END_PROGRAM", file_uri(tmp_path / "new.st"): "x"}
    )
    texts = {Path(t.source.uri).name: t.source.text for t in program.texts if not t.read_only}
    assert texts["a.st"] == "PROGRAM Q END_PROGRAM"
    assert texts["new.st"] == "x"
    (tmp_path / "a.st").write_bytes("(* gr\xfcn *)".encode("latin-1"))
    assert (
        next(t for t in programs({})[0].texts if t.source.uri.endswith("a.st")).source.text == "(* gr\xfcn *)"
    )


def test_libraries_of_a_folder_find_what_they_need(tmp_path: Path) -> None:
    write(tmp_path, {"p.st": "PROGRAM P\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM"})
    (snapshot,) = Workspace(FolderPrograms(tmp_path)).snapshots()
    assert len(snapshot.program.texts) > 100
    assert snapshot.diagnostics == []


async def test_project_folder(tmp_path: Path) -> None:
    app = "Devices/PLC/PLC Logic/App"
    write(
        tmp_path,
        {
            f"{app}/FB.st": "FUNCTION_BLOCK FB\nVAR iSpeed : INT; END_VAR\nEND_FUNCTION_BLOCK\n",
            f"{app}/FB/Start.st": "METHOD Start\niSpeed := 1;\nEND_METHOD\n",
            f"{app}/FB/Speed.st": "PROPERTY Speed : INT\nEND_PROPERTY\n",
            f"{app}/FB/Speed/Get.st": "GET\nSpeed := iSpeed;\nEND_GET\n",
            f"{app}/FB/Speed/Set.st": "SET\nnothing := Speed;\nEND_SET\n",
            f"{app}/Task Configuration/Main.task.json": "{}",
            "Devices/PLC/PLC Logic/Other/P.st": "PROGRAM P\nF();\nEND_PROGRAM\n",
            "POUs/F.st": "FUNCTION F : BOOL\nEND_FUNCTION\n",
        },
    )
    programs = FolderPrograms(tmp_path)({})
    assert {program.name for program in programs} == {app, "Devices/PLC/PLC Logic/Other"}
    assert next(p for p in programs if p.name == app).tasks == ["Main"]
    async with Client(FolderPrograms(tmp_path), canonical=canonical_uri, advise=True) as client:
        await client.start()
        setter = file_uri(tmp_path / app / "FB/Speed/Set.st")
        (message,) = [d for d in await client.published(setter) if d["severity"] == 1]
        assert (message["code"], message["range"]["start"]) == ("E0201", {"line": 1, "character": 0})
        get = file_uri(tmp_path / app / "FB/Speed/Get.st")
        params = {"textDocument": {"uri": get}, "position": {"line": 1, "character": 12}}
        found = await client.ask("textDocument/definition", params)
        assert found["uri"] == file_uri(tmp_path / app / "FB.st")
        assert found["range"]["start"] == {"line": 1, "character": 4}


async def test_uris_come_back_as_the_client_spells_them(tmp_path: Path) -> None:
    write(tmp_path, {"a b.st": "PROGRAM P END_PROGRAM"})
    async with Client(FolderPrograms(tmp_path), canonical=canonical_uri) as client:
        await client.start()
        spelled = (tmp_path / "a b.st").as_uri().replace("file:///", "FILE:///")
        await client.open(spelled, "PROGRAM P\nVAR a : INT; END_VAR\na := ;\nEND_PROGRAM")
        assert "E0104" in [d["code"] for d in await client.published(spelled)]
        params = {"textDocument": {"uri": spelled}, "position": {"line": 2, "character": 0}}
        assert (await client.ask("textDocument/definition", params))["uri"] == spelled
        (tmp_path / "a b.st").write_text("PROGRAM Saved END_PROGRAM")
        await client.notify("textDocument/didClose", {"textDocument": {"uri": spelled}})
        await client.notify("workspace/didChangeWatchedFiles", {"changes": []})
        (entry,) = await client.ask("textDocument/documentSymbol", {"textDocument": {"uri": spelled}})
        assert entry["name"] == "Saved"


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"\r\n", "no Content-Length"),
        (b"hello\r\n", "no header line"),
        (b"Content-Length: x\r\n\r\n", "Content-Length is x"),
        (b"Content-Length: 999999999999\r\n\r\n", "at most"),
        (b"Content-Length: 1\r\n\r\n\xff", "not UTF-8"),
        (b"x" * 100_000, "no end"),
    ],
)
async def test_frames_that_are_none(data: bytes, problem: str) -> None:
    reader = asyncio.StreamReader()
    reader.feed_data(data)
    reader.feed_eof()
    with pytest.raises(FrameError, match=problem):
        await read_message(reader)


async def test_frames_and_the_end() -> None:
    reader = asyncio.StreamReader()
    reader.feed_data(
        frame("{ä}") + b"content-length: 2\nContent-Type: x\n\nab" + b"Content-Length: 9\r\n\r\ncut"
    )
    reader.feed_eof()
    assert await read_message(reader) == "{ä}"
    assert await read_message(reader) == "ab"
    assert await read_message(reader) is None
    assert await read_message(reader) is None


async def test_the_process_an_editor_starts(tmp_path: Path) -> None:
    write(tmp_path, {"p.st": "PROGRAM P\nVAR a : INT; END_VAR\na := 1 +;\nEND_PROGRAM"})
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-m", "tappet", "lsp", str(tmp_path), "--stdio",
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    assert process.stdin is not None
    assert process.stdout is not None

    async def notify(**message: Any) -> None:
        assert process.stdin is not None
        process.stdin.write(frame(json.dumps({"jsonrpc": "2.0", **message})))
        await process.stdin.drain()

    async def hear() -> dict[str, Any]:
        assert process.stdout is not None
        text = await asyncio.wait_for(read_message(process.stdout), 30)
        assert text is not None
        message: dict[str, Any] = json.loads(text)
        return message

    await notify(id=1, method="initialize", params={"processId": None, "rootUri": None, "capabilities": {}})
    assert (await hear())["result"]["serverInfo"]["name"] == "tappet"
    await notify(method="initialized", params={})
    published = await hear()
    assert published["params"]["uri"] == file_uri(tmp_path / "p.st")
    (message,) = [d for d in published["params"]["diagnostics"] if d["code"] == "E0104"]
    assert message["message"] == "An expression expected before ';'. Write a value or a variable."
    await notify(id=2, method="shutdown")
    assert (await hear())["id"] == 2
    await notify(method="exit")
    assert await asyncio.wait_for(process.wait(), 30) == 0
    assert process.stderr is not None
    assert await process.stderr.read() == b""


def test_what_a_project_folder_excludes_and_its_coding_rules_count(tmp_path: Path) -> None:
    project = new_project("Press")
    application = project.applications()[0]
    chosen: dict[str, object] = {
        "static_analysis": {"rules": {"S1211": "error"}, "limits": {"nesting": 2}},
        "disabled_warnings": ["W1122"],
    }
    project = edit.change_data(project, application.id, chosen)
    project, old = edit.add_object(project, application.id, "pou", "Old", subkind="function_block")
    project, _ = edit.add_object(project, old.id, "method", "Start")
    project = edit.exclude_object(project, old.id, True)
    folder.save(project, tmp_path)
    (program,) = FolderPrograms(tmp_path)({})
    own = [text.source.name for text in program.texts if not text.read_only]
    assert own == ["PLC_PRG"]
    assert program.static.errors == {"S1211"}
    assert program.static.settings.nesting == 2
    assert program.disabled_warnings == {"W1122"}
