"""Files of an application: blocks through the mailbox, functions that work at once, paths."""

from __future__ import annotations

import os
import resource
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from library_programs import MS, TASK, TC2_SYSTEM, compiled

from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime


def blocks(calls: str, variables: str = "") -> str:
    """A program that runs the steps of `calls` one after the other, each until its block is not busy."""
    return f"""PROGRAM PLC_PRG
VAR
    step : INT; error : UDINT; failed : INT;
    fbOpen : FB_FileOpen; fbClose : FB_FileClose; fbRead : FB_FileRead; fbWrite : FB_FileWrite;
    fbSeek : FB_FileSeek; fbTell : FB_FileTell; fbEnd : FB_FileEOF;
    fbGets : FB_FileGets; fbPuts : FB_FilePuts;
    fbDelete : FB_FileDelete; fbRename : FB_FileRename; fbMake : FB_CreateDir; fbRemove : FB_RemoveDir;
    {variables}
END_VAR
CASE step OF
{calls}
END_CASE
END_PROGRAM
"""


def step(number: int, block: str, arguments: str, after: str = "") -> str:
    return f"""{number}:
    {block}({arguments}, bExecute := TRUE);
    IF NOT {block}.bBusy THEN
        IF {block}.bError THEN error := {block}.nErrId; failed := step; step := 1000;
        ELSE step := step + 1; END_IF
        {after}
        {block}(bExecute := FALSE);
    END_IF
"""


WRITE = blocks(
    step(0, "fbMake", "sPathName := 'log'")
    + step(1, "fbOpen", "sPathName := 'log/data.bin', nMode := FOPEN_MODEWRITE OR FOPEN_MODEBINARY")
    + step(2, "fbWrite", "hFile := fbOpen.hFile, pWriteBuff := ADR(data), cbWriteLen := SIZEOF(data)")
    + step(3, "fbTell", "hFile := fbOpen.hFile")
    + step(4, "fbClose", "hFile := fbOpen.hFile"),
    "data : ARRAY [0..99999] OF BYTE := [50000(1), 50000(2)];",
)


@pytest.mark.parametrize("virtual", [True, False])
def test_a_block_writes_a_file_in_pieces(tmp_path: Path, virtual: bool) -> None:
    with LocalRuntime(compiled(WRITE, TC2_SYSTEM), virtual=virtual, folder=tmp_path) as runtime:
        for _ in range(100):
            runtime.run(cycles=5)
            if runtime.read("PLC_PRG.step") in (5, 1000):
                break
        assert [runtime.read(f"PLC_PRG.{v}") for v in ("step", "error")] == [5, 0]
        assert runtime.read("PLC_PRG.fbTell.nSeekPos") == 100_000
        assert runtime.read("PLC_PRG.fbWrite.cbWrite") == 100_000
    assert (tmp_path / "files/log/data.bin").read_bytes() == b"\1" * 50_000 + b"\2" * 50_000


def outcome(runtime: LocalRuntime, steps: int) -> tuple[object, object, object]:
    """Last step, error and the step that failed, after all steps or an error."""
    for _ in range(200):
        runtime.run(cycles=5)
        if runtime.read("PLC_PRG.step") in (steps, 1000):
            break
    step_, error, failed = (runtime.read(f"PLC_PRG.{v}") for v in ("step", "error", "failed"))
    return step_, error, failed


LINES = blocks(
    step(0, "fbOpen", "sPathName := 'text.txt', nMode := FOPEN_MODEWRITE OR FOPEN_MODEPLUS OR FOPEN_MODETEXT")
    + step(1, "fbPuts", "hFile := fbOpen.hFile, sLine := 'first$N'")
    + step(2, "fbPuts", "hFile := fbOpen.hFile, sLine := 'second'")
    + step(3, "fbSeek", "hFile := fbOpen.hFile, nSeekPos := 0")
    + step(4, "fbGets", "hFile := fbOpen.hFile", "line1 := fbGets.sLine; end1 := fbGets.bEOF;")
    + step(5, "fbGets", "hFile := fbOpen.hFile", "line2 := fbGets.sLine; end2 := fbGets.bEOF;")
    + step(6, "fbEnd", "hFile := fbOpen.hFile")
    + step(7, "fbGets", "hFile := fbOpen.hFile", "end3 := fbGets.bEOF;")
    + step(8, "fbSeek", "hFile := fbOpen.hFile, nSeekPos := -6, eOrigin := SEEK_END")
    + step(9, "fbRead", "hFile := fbOpen.hFile, pReadBuff := ADR(data), cbReadLen := 20")
    + step(10, "fbClose", "hFile := fbOpen.hFile")
    + step(11, "fbRename", "sOldName := 'text.txt', sNewName := 'other.txt'")
    + step(12, "fbMake", "sPathName := 'empty'")
    + step(13, "fbRemove", "sPathName := 'empty'"),
    "line1, line2 : T_MaxString; end1, end2, end3 : BOOL; data : STRING(30);",
)


def test_lines_positions_and_names(tmp_path: Path) -> None:
    with LocalRuntime(compiled(LINES, TC2_SYSTEM), folder=tmp_path) as runtime:
        assert outcome(runtime, 14) == (14, 0, 0)
        wanted = {"line1": "first\n", "line2": "second", "end1": False, "end2": False, "end3": True,
                  "data": "second", "fbEnd.bEOF": True, "fbRead.cbRead": 6, "fbRead.bEOF": True}  # fmt: skip
        assert {name: runtime.read(f"PLC_PRG.{name}") for name in wanted} == wanted
    assert [p.name for p in (tmp_path / "files").iterdir()] == ["other.txt"]
    assert (tmp_path / "files/other.txt").read_bytes() == b"first\nsecond"


ONE_PATH = blocks(
    step(0, "fbOpen", "sPathName := name, nMode := mode") + step(1, "fbClose", "hFile := fbOpen.hFile"),
    "name : T_MaxString; mode : DWORD;",
)
READ, WRITTEN = 0x11, 0x12
INVALID_ACCESS, NOT_FOUND, PARAMETER = 0x704, 0x70C, 0x70B


@pytest.mark.parametrize(
    ("path", "mode", "error"),
    [
        ("../secret", READ, INVALID_ACCESS),
        ("../secret", WRITTEN, INVALID_ACCESS),
        ("a/../../secret", READ, INVALID_ACCESS),
        ("a/..", READ, INVALID_ACCESS),
        ("..\\secret", READ, INVALID_ACCESS),
        ("a\\..\\..\\secret", READ, INVALID_ACCESS),
        ("/etc/hostname", READ, INVALID_ACCESS),
        ("\\etc\\hostname", READ, INVALID_ACCESS),
        ("C:\\TwinCAT\\data.txt", WRITTEN, INVALID_ACCESS),
        ("$PlcLogic$/../../secret", READ, INVALID_ACCESS),
        ("$PlcLogic$x", READ, NOT_FOUND),
        ("link", READ, INVALID_ACCESS),
        ("link", WRITTEN, INVALID_ACCESS),
        ("folderlink/secret", READ, NOT_FOUND),
        ("pipe", READ, INVALID_ACCESS),
        ("a", READ, INVALID_ACCESS),
        ("", READ, INVALID_ACCESS),
        ("missing", READ, NOT_FOUND),
        ("missing/x", WRITTEN, NOT_FOUND),
        ("inside", 0, PARAMETER),
        ("inside", 0x13, PARAMETER),
        ("x" * 255, WRITTEN, PARAMETER),
        ("inside", READ, 0),
        ("./a/./inside", READ, 0),
        ("a\\inside", READ, 0),
        ("$PlcLogic$/inside", READ, 0),
        ("$plclogic$\\a//inside", READ, 0),
        ("...", WRITTEN, 0),
    ],
)
def test_no_path_leads_out_of_the_folder(tmp_path: Path, path: str, mode: int, error: int) -> None:
    folder = tmp_path / "files"
    (folder / "a").mkdir(parents=True)
    for place in (tmp_path / "secret", folder / "inside", folder / "a/inside"):
        place.write_text("content")
    (folder / "link").symlink_to(tmp_path / "secret")
    (folder / "folderlink").symlink_to(tmp_path)
    os.mkfifo(folder / "pipe")
    with LocalRuntime(compiled(ONE_PATH, TC2_SYSTEM), folder=tmp_path, start=False) as runtime:
        runtime.write_all({"PLC_PRG.name": path, "PLC_PRG.mode": mode})
        runtime.start()
        assert outcome(runtime, 2) == ((1000, error, 0) if error else (2, 0, 0))
    assert (tmp_path / "secret").read_text() == "content"


def test_a_full_disk_and_the_limit_of_open_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tappet.runtime.files.SIZE_LIMIT", 70_000)
    with LocalRuntime(compiled(WRITE, TC2_SYSTEM), folder=tmp_path) as runtime:
        assert outcome(runtime, 5) == (1000, 0x700, 2)
    assert (tmp_path / "files/log/data.bin").stat().st_size == 65_536  # two pieces
    again = "IF step = 2 AND fbOpen.hFile <> 0 THEN step := 1; END_IF"
    many = WRITE.replace("END_PROGRAM", f"{again}\nEND_PROGRAM").replace("'log'", "'log2'")
    with LocalRuntime(compiled(many.replace("log/", "log2/"), TC2_SYSTEM), folder=tmp_path) as runtime:
        assert outcome(runtime, 5) == (1000, 0x70A, 1)
        before = len(os.listdir("/proc/self/fd"))
        assert before >= 64
        runtime.reset("cold")
        assert len(os.listdir("/proc/self/fd")) == before - 64


def test_reset_online_change_and_download_end_requests(tmp_path: Path) -> None:
    first = compiled(WRITE, TC2_SYSTEM)
    with LocalRuntime(first, folder=tmp_path, virtual=False) as runtime:
        runtime.reset("cold")
        runtime.start()
        changed = WRITE.replace("step : INT;", "more : LREAL := 1.5; step : INT;")
        runtime.plc.download(compiled(changed, TC2_SYSTEM, previous=first).to_bytes(), "online_change")
        got = outcome(runtime, 5)
        assert got in ((5, 0, 0), (1000, 0x70F, 0))  # the folder may be there from before the reset
        runtime.plc.load(compiled(LINES, TC2_SYSTEM))
        runtime.start()
        assert outcome(runtime, 14) == (14, 0, 0)
    assert (tmp_path / "files/other.txt").read_bytes() == b"first\nsecond"


def test_equal_runs_on_virtual_time_see_equal_replies(tmp_path: Path) -> None:
    counted = WRITE.replace("END_PROGRAM", "IF step < 5 THEN cycles := cycles + 1; END_IF\nEND_PROGRAM")
    package = compiled(counted.replace("step : INT;", "cycles : INT; step : INT;"), TC2_SYSTEM)
    seen = []
    for run in range(3):
        with LocalRuntime(package, folder=tmp_path / str(run)) as runtime:
            assert outcome(runtime, 5)[0] == 5
            seen.append(runtime.read("PLC_PRG.cycles"))
    assert len(set(seen)) == 1


def test_without_a_data_folder_files_are_temporary() -> None:
    with LocalRuntime(compiled(WRITE, TC2_SYSTEM)) as runtime:
        assert outcome(runtime, 5)[0] == 5
        application = runtime.plc.application
        assert application is not None
        folder = application.files.folder
        assert folder is not None
        assert (folder / "log/data.bin").stat().st_size == 100_000
    assert not folder.exists()


SYSFILE = """PROGRAM PLC_PRG
VAR
    h, gone : RTS_IEC_HANDLE; result, opened : RTS_IEC_RESULT;
    data : ARRAY [0..9] OF BYTE := [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
    back : ARRAY [0..9] OF BYTE; written, got, size, copied, position : __XWORD;
    end1, end2, end3 : RTS_IEC_RESULT; n : INT; name : STRING(255); modes : ARRAY [0..5] OF DINT;
    pName : POINTER TO STRING(255); state : SYS_FILE_STATUS;
    times : SYS_FILETIME; codes : ARRAY [0..9] OF RTS_IEC_RESULT; status : ARRAY [0..1] OF SYS_FILE_STATUS;
    moved : ARRAY [0..4] OF RTS_IEC_RESULT; hDir : RTS_IEC_HANDLE; entry : STRING;
    info : DirInfo; files, folders : INT; sizes : LWORD;
END_VAR
n := n + 1;
IF n > 1 THEN RETURN; END_IF
modes[0] := ACCESS_MODE.AM_READ; modes[1] := ACCESS_MODE.AM_WRITE; modes[2] := ACCESS_MODE.AM_APPEND;
modes[3] := ACCESS_MODE.AM_READ_PLUS; modes[4] := ACCESS_MODE.AM_WRITE_PLUS;
modes[5] := ACCESS_MODE.AM_APPEND_PLUS;
codes[0] := SysDirCreate('$$PlcLogic$$/logs');
h := SysFileOpen('logs/a.bin', ACCESS_MODE.AM_WRITE_PLUS, ADR(opened));
written := SysFileWrite(h, ADR(data), 10, ADR(result));
codes[1] := SysFileSetPos(h, 4);
got := SysFileRead(h, ADR(back), 3, ADR(result));
codes[2] := SysFileGetPos(h, ADR(position));
end1 := SysFileEOF(h);
status[0] := SysFileGetStatus(h);
got := got + SysFileRead(h, ADR(back[3]), 10, ADR(result));
end2 := SysFileEOF(h);
codes[3] := SysFileTruncate(h, ulSizeNew := 8);
pName := SysFileGetName(h);
name := pName^;
size := SysFileGetSizeByHandle(h, ADR(result));
codes[4] := SysFileClose(h);
codes[5] := SysFileClose(h);
status[1] := SysFileGetStatus2(h, ADR(result));
end3 := SysFileEOF(h);
pName := SysFileGetName(h);
h := SysFileOpen('logs/a.bin', ACCESS_MODE.AM_APPEND, ADR(opened));
SysFileWrite(h, ADR(data), 2, 0);
SysFileClose(h);
codes[6] := SysFileCopy('logs/b.bin', 'logs/a.bin', ADR(copied));
codes[7] := SysFileRename('logs/b.bin', 'logs/a.bin');
gone := SysFileOpen('../a.bin', ACCESS_MODE.AM_WRITE, ADR(codes[8]));
SysFileOpen('none', ACCESS_MODE.AM_APPEND, ADR(codes[9]));
SysFileGetTime('logs/a.bin', ADR(times));
SysDirCreate('logs/inner');
hDir := SysDirOpen('logs', entry, 80, ADR(info), ADR(result));
WHILE result = 0 DO
    IF info.diDirectory = DWORD_TO_DINT(DF_DIRECTORY) THEN folders := folders + 1;
    ELSE files := files + 1; sizes := sizes + info.ulSize; END_IF
    result := SysDirRead(hDir, entry, 80, ADR(info));
END_WHILE
SysDirClose(hDir);
moved[0] := SysDirRename('logs/inner', 'logs/other');
moved[1] := SysDirRename('logs/inner', 'logs/third');
moved[2] := SysDirDelete('logs/other');
h := SysFileOpen('logs/short.lived', ACCESS_MODE.AM_WRITE, 0);
moved[3] := SysFileDeleteByHandle(h);
moved[4] := SysFileDeleteByHandle(h);
END_PROGRAM
"""


@pytest.mark.parametrize("virtual", [True, False])
def test_files_and_folders_at_once(tmp_path: Path, virtual: bool) -> None:
    package = compiled(SYSFILE, "SysFile, * (System)", "SysDir, * (System)")
    with LocalRuntime(package, virtual=virtual, folder=tmp_path) as runtime:
        runtime.run(cycles=2)
        assert runtime.literal("PLC_PRG.back") == "[5, 6, 7, 8, 9, 10, 0, 0, 0, 0]"
        wanted = {"written": 10, "got": 6, "position": 7, "size": 8, "copied": 10, "end1": 1,
                  "end2": 0, "end3": 2, "opened": 0, "name": "logs/a.bin", "pName": 0, "result": 21,
                  "files": 2, "folders": 1, "sizes": 20}  # fmt: skip
        assert {name: runtime.read(f"PLC_PRG.{name}") for name in wanted} == wanted
        assert runtime.literal("PLC_PRG.codes") == "[0, 0, 0, 0, 0, 20, 0, 18, 25, 16]"
        assert runtime.read("PLC_PRG.gone") == 2**64 - 1
        assert runtime.literal("PLC_PRG.modes") == "[1, 2, 4, 8, 16, 32]"
        assert runtime.literal("PLC_PRG.moved") == "[0, 16, 0, 0, 20]"
        modified = runtime.read("PLC_PRG.times.tLastModification")
    assert (tmp_path / "files/logs/a.bin").read_bytes() == bytes([1, 2, 3, 4, 5, 6, 7, 8, 1, 2])
    assert int((tmp_path / "files/logs/a.bin").stat().st_mtime) == modified
    assert sorted(p.name for p in (tmp_path / "files/logs").iterdir()) == ["a.bin", "b.bin"]


COPIES = """PROGRAM PLC_PRG
VAR codes : ARRAY [0..2] OF RTS_IEC_RESULT; copied : __XWORD; END_VAR
codes[0] := SysFileCopy('long', 'short', ADR(copied));
codes[1] := SysFileCopy('new', 'short', 0);
codes[2] := SysFileCopy('short', 'short', 0);
END_PROGRAM
"""


def test_a_copy_replaces_what_is_there_but_never_its_source(tmp_path: Path) -> None:
    folder = tmp_path / "files"
    folder.mkdir()
    (folder / "short").write_bytes(b"abc")
    (folder / "long").write_bytes(b"0123456789")
    with LocalRuntime(compiled(COPIES, "SysFile, * (System)"), folder=tmp_path) as runtime:
        runtime.run(cycles=2)
        assert [runtime.literal("PLC_PRG.codes"), runtime.read("PLC_PRG.copied")] == ["[0, 0, 2]", 3]
    assert {path.read_bytes() for path in folder.iterdir()} == {b"abc"}


DELETED = blocks(
    step(0, "fbDelete", "sPathName := 'old.txt'") + step(1, "fbDelete", "sPathName := 'old.txt'")
)


def test_a_file_is_deleted_once(tmp_path: Path) -> None:
    (tmp_path / "files").mkdir()
    (tmp_path / "files/old.txt").write_text("old")
    with LocalRuntime(compiled(DELETED, TC2_SYSTEM), folder=tmp_path) as runtime:
        assert outcome(runtime, 2) == (1000, NOT_FOUND, 1)
    assert list((tmp_path / "files").iterdir()) == []


@contextmanager
def largest_file(size: int) -> Iterator[None]:
    """The host takes no more than so many bytes in a file."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.parametrize("virtual", [True, False])
def test_a_host_that_takes_no_more_bytes_is_an_error_and_no_end(tmp_path: Path, virtual: bool) -> None:
    with LocalRuntime(compiled(WRITE, TC2_SYSTEM), virtual=virtual, folder=tmp_path) as runtime:
        with largest_file(70_000):
            assert outcome(runtime, 5) == (1000, 0x700, 2)
        assert runtime.state == "run"
    assert (tmp_path / "files/log/data.bin").stat().st_size == 70_000


def open_files(folder: Path) -> list[str]:
    """Files below a folder that this process has open, without folders."""
    found = []
    for number in os.listdir("/proc/self/fd"):
        with suppress(OSError):
            target = os.readlink(f"/proc/self/fd/{number}")
            if target.startswith(str(folder)) and not os.path.isdir(target):
                found.append(target)
    return found


IN_FLIGHT = """PROGRAM PLC_PRG
VAR n : INT; {before} {block} END_VAR
n := n + 1;
{call}
END_PROGRAM
"""
OPENING = "fbOpen(sPathName := 'f', nMode := FOPEN_MODEWRITE, bExecute := TRUE);"


@pytest.mark.parametrize("asks", [True, False], ids=["moved", "removed"])
def test_an_online_change_with_a_request_on_its_way(tmp_path: Path, asks: bool) -> None:
    first = IN_FLIGHT.format(before="", block="fbOpen : FB_FileOpen;", call=OPENING)
    block, call = ("fbOpen : FB_FileOpen;", OPENING) if asks else ("", "")
    second = IN_FLIGHT.format(before="more : ARRAY [1..99] OF LREAL;", block=block, call=call)
    package = compiled(first, TC2_SYSTEM)
    with LocalRuntime(package, folder=tmp_path) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.fbOpen.bBusy") is True
        changed = compiled(second, TC2_SYSTEM, previous=package)
        runtime.plc.download(changed.to_bytes(), "online_change")
        runtime.run(cycles=2)
        assert runtime.read("PLC_PRG.n") == 3
        if asks:
            assert runtime.read("PLC_PRG.fbOpen.hFile") != 0
            assert runtime.read("PLC_PRG.fbOpen.bError") is False
        assert len(open_files(tmp_path)) == int(asks)


FOLDER = """PROGRAM PLC_PRG
VAR
    n : INT; h : RTS_IEC_HANDLE; entry : STRING; none : REFERENCE TO STRING; info : DirInfo;
    opened, read, ended : RTS_IEC_RESULT;
END_VAR
n := n + 1;
IF n > 1 THEN RETURN; END_IF
h := SysDirOpen('', none, 0, 0, ADR(opened));
read := SysDirRead(h, entry, 80, ADR(info));
ended := SysDirRead(h, entry, 80, ADR(info));
SysDirClose(h);
END_PROGRAM
"""


def test_the_folder_of_files_itself_is_read_from_its_first_entry(tmp_path: Path) -> None:
    (tmp_path / "files").mkdir()
    (tmp_path / "files/only").write_text("12345")
    with LocalRuntime(compiled(FOLDER, "SysDir, * (System)"), folder=tmp_path) as runtime:
        runtime.run(cycles=2)
        wanted = {
            "opened": 0,
            "read": 0,
            "ended": 21,
            "entry": "only",
            "info.ulSize": 5,
            "info.diDirectory": 0,
        }
        assert {name: runtime.read(f"PLC_PRG.{name}") for name in wanted} == wanted


TWO_TASKS = """PROGRAM PLC_PRG
VAR h : RTS_IEC_HANDLE; n : INT; data : DWORD := 16#11111111; written : __XWORD; END_VAR
IF n = 0 THEN h := SysFileOpen('one', ACCESS_MODE.AM_WRITE, 0); END_IF
IF n < 20 THEN written := written + SysFileWrite(h, ADR(data), 4, 0); n := n + 1; END_IF
END_PROGRAM
PROGRAM Other
VAR h : RTS_IEC_HANDLE; n : INT; data : DWORD := 16#22222222; written : __XWORD; END_VAR
IF n = 0 THEN h := SysFileOpen('two', ACCESS_MODE.AM_WRITE, 0); END_IF
IF n < 20 THEN written := written + SysFileWrite(h, ADR(data), 4, 0); n := n + 1; END_IF
END_PROGRAM
"""


def test_two_tasks_write_at_once(tmp_path: Path) -> None:
    tasks = (TASK, Task("Second", interval_ns=3 * MS, programs=("Other",)))
    package = compiled(TWO_TASKS, "SysFile, * (System)", tasks=tasks)
    with LocalRuntime(package, virtual=False, folder=tmp_path) as runtime:
        while [runtime.read("PLC_PRG.n"), runtime.read("Other.n")] != [20, 20]:
            runtime.run(cycles=1)
        assert [runtime.read("PLC_PRG.written"), runtime.read("Other.written")] == [80, 80]
    assert (tmp_path / "files/one").read_bytes() == b"\x11" * 80
    assert (tmp_path / "files/two").read_bytes() == b"\x22" * 80
