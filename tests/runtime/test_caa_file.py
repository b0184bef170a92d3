"""CAA File: files and folders with the handshake of the CAA libraries, through the mailbox of the runtime."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime

MS = 1_000_000
SESSION = BuildSession()
TASK = Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",))
BLOCKS = (
    *("Open", "Close", "Read", "Write", "SetPos", "GetPos", "EOF", "Flush", "GetSize", "GetTime"),
    *("Delete", "Rename", "Copy"),
    *("DirCreate", "DirOpen", "DirList", "DirClose", "DirRemove", "DirRename", "DirCopy"),
)


def compiled(text: str, previous: CodePackage | None = None) -> CodePackage:
    references = (LibraryReference("CAA File, * (CAA Technical Workgroup)"), LibraryReference("CAA Types"))
    options = BuildOptions(libraries=references, level=1)
    result = build_application(
        [Source("PLC_PRG", text)], (TASK,), options, previous=previous, session=SESSION
    )
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


def steps(*calls: tuple[str, str] | tuple[str, str, str], variables: str = "") -> str:
    """A program that runs one block after the other until it is done or fails; `errors` has their outcomes.

    A call is the block, its arguments, and what to do with its outputs.
    """
    cases = []
    for number, (block, arguments, *after) in enumerate(calls):
        comma = ", " if arguments else ""
        cases.append(
            f"{number}:\n    fb{block}({arguments}{comma}xExecute := TRUE);\n"
            f"    IF fb{block}.xDone OR fb{block}.xError THEN\n"
            f"        errors[step] := fb{block}.eError;\n"
            f"        wrong := wrong OR fb{block}.xBusy OR fb{block}.xDone = fb{block}.xError\n"
            f"            OR fb{block}.xError <> (fb{block}.eError <> 0);\n"
            f"        {''.join(after)}\n        step := step + 1;\n        fb{block}(xExecute := FALSE);\n"
            f"        wrong := wrong OR fb{block}.xDone OR fb{block}.xError OR fb{block}.eError <> 0;\n"
            "    END_IF\n"
        )
    instances = " ".join(f"fb{block} : FILE.{block};" for block in BLOCKS)
    return (
        "PROGRAM PLC_PRG\nVAR\n    step : INT; wrong : BOOL; handle : CAA.HANDLE;\n"
        f"    errors : ARRAY [0..{len(calls)}] OF INT;\n    {instances}\n    {variables}\n"
        f"END_VAR\nCASE step OF\n{''.join(cases)}END_CASE\nEND_PROGRAM\n"
    )


def outcome(runtime: LocalRuntime, count: int) -> list[int]:
    """The errors of all steps."""
    for _ in range(300):
        runtime.run(cycles=5)
        if runtime.read("PLC_PRG.step") == count:
            break
    assert runtime.read("PLC_PRG.step") == count
    assert runtime.read("PLC_PRG.wrong") is False
    errors = runtime.read("PLC_PRG.errors")
    assert isinstance(errors, list)
    return [int(error) for error in errors[:count]]


TEXT = "'log/text.txt'"
HANDLE = "hFile := handle"
KEEP = "handle := fbOpen.hFile;"
WHOLE = steps(
    ("DirCreate", "sDirName := 'log'"),
    ("Open", f"sFileName := {TEXT}, eFileMode := FILE.MODE.MRDWR, xExclusive := TRUE", KEEP),
    ("Write", f"{HANDLE}, pBuffer := ADR(data), szSize := SIZEOF(data)"),
    ("GetPos", HANDLE, "position := fbGetPos.udiPos;"),
    ("EOF", HANDLE, "ends[0] := fbEOF.xEOF;"),
    ("SetPos", f"{HANDLE}, udiPos := 49998"),
    ("EOF", HANDLE, "ends[1] := fbEOF.xEOF;"),
    ("Read", f"{HANDLE}, pBuffer := ADR(back), szBuffer := 4", "got := fbRead.szSize;"),
    ("SetPos", f"{HANDLE}, udiPos := 99999"),
    ("Read", f"{HANDLE}, pBuffer := ADR(rest), szBuffer := 4", "last := fbRead.szSize;"),
    ("Flush", HANDLE),
    ("Close", HANDLE),
    ("GetSize", f"sFileName := {TEXT}", "size := fbGetSize.szSize;"),
    ("GetTime", f"sFileName := {TEXT}", "changed := fbGetTime.dtLastModification;"),
    ("Copy", f"sFileNameSource := {TEXT}, sFileNameDest := 'copy.txt'", "copied := fbCopy.szSize;"),
    ("Copy", f"sFileNameSource := {TEXT}, sFileNameDest := 'copy.txt', xOverWrite := FALSE"),
    ("Copy", f"sFileNameSource := {TEXT}, sFileNameDest := 'copy.txt', xOverWrite := TRUE"),
    ("Rename", "sFileNameOld := 'copy.txt', sFileNameNew := 'moved.txt'"),
    ("Delete", f"sFileName := {TEXT}"),
    ("DirRename", "sDirNameOld := 'log', sDirNameNew := 'old'"),
    ("DirRemove", "sDirName := 'old'"),
    variables="data : ARRAY [1..100000] OF BYTE := [50000(1), 50000(2)]; back, rest : ARRAY [0..3] OF BYTE;"
    " ends : ARRAY [0..1] OF BOOL; position, got, last, size, copied : CAA.SIZE; changed : DT;",
)


@pytest.mark.parametrize("virtual", [True, False])
def test_a_file_from_its_making_to_its_end(tmp_path: Path, virtual: bool) -> None:
    with LocalRuntime(compiled(WHOLE), virtual=virtual, folder=tmp_path) as runtime:
        errors = outcome(runtime, 21)
        assert errors == [0] * 15 + [5105] + [0] * 5
        wanted = {"position": 100_000, "ends": [True, False], "back": [1, 1, 2, 2], "got": 4, "last": 1,
                  "rest": [2, 0, 0, 0], "size": 100_000, "copied": 100_000}  # fmt: skip
        assert {name: runtime.read(f"PLC_PRG.{name}") for name in wanted} == wanted
        assert runtime.literal("PLC_PRG.changed") > "DT#2020"
    assert [path.name for path in (tmp_path / "files").iterdir()] == ["moved.txt"]
    assert (tmp_path / "files/moved.txt").read_bytes() == b"\1" * 50_000 + b"\2" * 50_000


@pytest.mark.parametrize(
    ("mode", "before", "after", "error"),
    [
        ("MWRITE", b"12345", b"ab", 0),
        ("MWRITE", None, b"ab", 0),
        ("MREAD", b"12345", b"12345", 5103),
        ("MREAD", None, None, 5104),
        ("MRDWR", b"12345", b"ab", 0),
        ("MAPPD", b"12345", b"12345ab", 0),
        ("MAPPD", None, b"ab", 0),
        ("MREADPLUS", b"12345", b"ab345", 0),
        ("MREADPLUS", None, None, 5104),
        ("MWRITEPLUS", b"12345", b"ab", 0),
        ("MAPPENDPLUS", b"12345", b"12345ab", 0),
        ("MAPPENDPLUS", None, b"ab", 0),
    ],
)
def test_modes(tmp_path: Path, mode: str, before: bytes | None, after: bytes | None, error: int) -> None:
    text = steps(
        ("Open", f"sFileName := 'f', eFileMode := FILE.MODE.{mode}", KEEP),
        ("Write", f"{HANDLE}, pBuffer := ADR(data), szSize := 2"),
        ("Close", HANDLE),
        variables="data : STRING := 'ab';",
    )
    (tmp_path / "files").mkdir()
    file = tmp_path / "files/f"
    if before is not None:
        file.write_bytes(before)
    with LocalRuntime(compiled(text), folder=tmp_path) as runtime:
        opened, written, closed = outcome(runtime, 3)
    assert (opened or written) == error
    assert closed == (5103 if opened else 0)
    assert (file.read_bytes() if file.exists() else None) == after


@pytest.mark.parametrize(
    ("call", "error"),
    [
        (("Open", "sFileName := 'missing', eFileMode := FILE.MODE.MREAD"), 5104),
        (("Open", "sFileName := 'missing/f', eFileMode := FILE.MODE.MWRITE"), 5104),
        (("Open", "sFileName := '../f', eFileMode := FILE.MODE.MREAD"), 5114),
        (("Open", "sFileName := '/etc/hostname', eFileMode := FILE.MODE.MREAD"), 5114),
        (("Open", "sFileName := 'full', eFileMode := FILE.MODE.MREAD"), 5109),
        (("Close", ""), 5103),
        (("Close", "hFile := 12345"), 5103),
        (("Read", "hFile := 0, pBuffer := ADR(data), szBuffer := 1"), 5103),
        (("Read", "hFile := 12345, pBuffer := 0, szBuffer := 1"), 5109),
        (("Write", "hFile := 12345, pBuffer := 0, szSize := 1"), 5109),
        (("SetPos", "hFile := 77"), 5103),
        (("GetSize", "sFileName := 'missing'"), 5104),
        (("GetSize", "sFileName := 'full'"), 5109),
        (("GetTime", "sFileName := 'missing'"), 5104),
        (("Delete", "sFileName := 'missing'"), 5104),
        (("Rename", "sFileNameOld := 'f', sFileNameNew := 'full/f'"), 5105),
        (("Rename", "sFileNameOld := 'missing', sFileNameNew := 'g'"), 5104),
        (("Copy", "sFileNameSource := 'missing', sFileNameDest := 'g'"), 5104),
        (("Copy", "sFileNameSource := 'full/f', sFileNameDest := 'full/f'"), 5109),
        (("Copy", "sFileNameSource := 'full/f', sFileNameDest := 'full'"), 5109),
        (("DirCreate", "sDirName := 'full'"), 5105),
        (("DirCreate", "sDirName := 'a/b/c'"), 5104),
        (("DirOpen", "sDirName := 'f'"), 5104),
        (("DirOpen", "sDirName := 'missing'"), 5104),
        (("DirList", "hDir := 12345"), 5103),
        (("DirRemove", "sDirName := 'full'"), 5107),
        (("DirRemove", "sDirName := 'missing', xRecursive := TRUE"), 5104),
        (("DirCopy", "sDirNameSource := 'missing', sDirNameDest := 'g'"), 5104),
        (("DirCopy", "sDirNameSource := 'full', sDirNameDest := '../g'"), 5114),
    ],
)
def test_what_fails_tells_why(tmp_path: Path, call: tuple[str, str], error: int) -> None:
    folder = tmp_path / "files"
    (folder / "full").mkdir(parents=True)
    for name in ("f", "full/f"):
        (folder / name).write_text(name)
    with LocalRuntime(compiled(steps(call, variables="data : BYTE;")), folder=tmp_path) as runtime:
        assert outcome(runtime, 1) == [error]
    assert (folder / "full/f").read_text() == "full/f"


def test_folders_are_listed_entry_by_entry(tmp_path: Path) -> None:
    calls = [("DirOpen", "sDirName := 'plant'", "handle := fbDirOpen.hDir;")]
    entry = "fbDirList.deDirEntry"
    keep = (
        f"IF {entry}.xDirectory THEN folders := folders + 1; ELSE size := size + {entry}.szSize; END_IF"
        f" named := named OR {entry}.sEntry = 'b.bin';"
    )
    more = [("DirList", "hDir := handle", keep)] * 4
    text = steps(
        *calls,
        *more,
        ("DirClose", "hDir := handle"),
        ("DirList", "hDir := handle"),
        variables="folders : INT; size : CAA.SIZE; named : BOOL;",
    )
    folder = tmp_path / "files/plant"
    (folder / "sub").mkdir(parents=True)
    (folder / "a.bin").write_bytes(b"1" * 10)
    (folder / "b.bin").write_bytes(b"1" * 7)
    with LocalRuntime(compiled(text), folder=tmp_path) as runtime:
        assert outcome(runtime, 7) == [0, 0, 0, 0, 5106, 0, 5103]
        assert [runtime.read(f"PLC_PRG.{name}") for name in ("folders", "size", "named")] == [1, 17, True]


@pytest.mark.parametrize("virtual", [True, False])
def test_trees_of_folders_are_made_copied_and_removed(tmp_path: Path, virtual: bool) -> None:
    folder = tmp_path / "files"
    (folder / "plant/sub/deep").mkdir(parents=True)
    (folder / "plant/empty").mkdir()
    for name in ("plant/a", "plant/b", "plant/sub/c", "plant/sub/deep/d"):
        (folder / name).write_text(name)
    (folder / "flat").mkdir()
    (folder / "flat/a").write_text("kept")
    text = steps(
        ("DirCreate", r"sDirName := './x/y\z', xParent := TRUE"),
        ("DirCreate", "sDirName := 'x/y/z', xParent := TRUE"),
        ("DirCopy", "sDirNameSource := 'plant', sDirNameDest := 'back/up/1', xRecursive := TRUE"),
        ("DirCopy", "sDirNameSource := 'plant', sDirNameDest := 'flat', xRecursive := FALSE"),
        ("DirCopy", "sDirNameSource := 'plant/sub', sDirNameDest := 'over', xOverWrite := TRUE"),
        ("DirRemove", "sDirName := 'plant', xRecursive := TRUE"),
    )
    open_before = len(os.listdir("/proc/self/fd"))
    with LocalRuntime(compiled(text), virtual=virtual, folder=tmp_path) as runtime:
        assert outcome(runtime, 6) == [0, 5105, 0, 0, 0, 0]
    assert len(os.listdir("/proc/self/fd")) <= open_before
    found = {str(p.relative_to(folder)) for p in folder.rglob("*")}
    copy = {"a", "b", "sub", "sub/c", "sub/deep", "sub/deep/d", "empty"}
    assert found == {
        *("x", "x/y", "x/y/z", "back", "back/up", "back/up/1", "flat", "flat/a", "flat/b", "over", "over/c"),
        *(f"back/up/1/{name}" for name in copy),
    }
    assert (folder / "flat/a").read_text() == "kept"
    assert (folder / "back/up/1/sub/deep/d").read_text() == "plant/sub/deep/d"


def test_a_tree_that_is_too_deep_ends_in_an_error_and_leaves_nothing_open(tmp_path: Path) -> None:
    deepest = tmp_path / "files" / "/".join(["d"] * 20)
    deepest.mkdir(parents=True)
    text = steps(
        ("DirRemove", "sDirName := 'd', xRecursive := TRUE"),
        ("DirOpen", "sDirName := 'd'", "handle := fbDirOpen.hDir;"),
        ("DirClose", "hDir := handle"),
    )
    with LocalRuntime(compiled(text), folder=tmp_path) as runtime:
        runtime.run(cycles=1)
        before = len(os.listdir("/proc/self/fd"))
        assert outcome(runtime, 3) == [5110, 0, 0]
        assert len(os.listdir("/proc/self/fd")) <= before
    assert deepest.is_dir()


HANDSHAKE = """PROGRAM PLC_PRG
VAR
    n : INT; fb : FILE.GetSize; seen : ARRAY [1..12] OF INT; f : FILE.Open; w : FILE.Write;
    aborted : ARRAY [1..12] OF INT; late : ARRAY [1..12] OF INT; opened : CAA.HANDLE;
    data : ARRAY [1..200000] OF BYTE;
END_VAR
VAR_TEMP i : INT; END_VAR
n := n + 1;
(* 1: xBusy, 2: xDone, 4: xError, 8: xAborted *)
fb(xExecute := n <> 2 AND n < 6, sFileName := 'f');
IF n <= 12 THEN
    seen[n] := BOOL_TO_INT(fb.xBusy) + 2 * BOOL_TO_INT(fb.xDone) + 4 * BOOL_TO_INT(fb.xError);
END_IF
f(xExecute := TRUE, sFileName := 'big', eFileMode := FILE.MODE.MWRITE);
IF f.xDone AND n <= 12 THEN
    w(xExecute := n < 8, xAbort := n = 5 OR n = 6, hFile := f.hFile, pBuffer := ADR(data), szSize := 200000);
    aborted[n] := BOOL_TO_INT(w.xBusy) + 2 * BOOL_TO_INT(w.xDone) + 4 * BOOL_TO_INT(w.xError)
        + 8 * BOOL_TO_INT(w.xAborted);
    late[n] := w.eError;
END_IF
END_PROGRAM
"""


def test_outputs_hold_for_one_call_after_the_edge_went_and_a_command_is_aborted(tmp_path: Path) -> None:
    (tmp_path / "files").mkdir()
    (tmp_path / "files/f").write_text("12345")
    with LocalRuntime(compiled(HANDSHAKE), folder=tmp_path) as runtime:
        runtime.run(cycles=12)
        # started at 1, done at 2 without xExecute: one call; again from 3 on, done at 4 until it goes at 6
        assert runtime.read("PLC_PRG.seen") == [1, 2, 1, 2, 2, 0, 0, 0, 0, 0, 0, 0]
        # started at 2, aborted at 5, until xExecute goes at 8
        assert runtime.read("PLC_PRG.aborted") == [0, 1, 1, 1, 8, 8, 8, 0, 0, 0, 0, 0]
        assert runtime.read("PLC_PRG.late") == [0, 0, 0, 0, 5102, 5102, 5102, 0, 0, 0, 0, 0]


def test_a_command_ends_after_its_time(tmp_path: Path) -> None:
    text = HANDSHAKE.replace("xAbort := n = 5 OR n = 6", "udiTimeOut := 20000")
    with LocalRuntime(compiled(text), folder=tmp_path) as runtime:
        runtime.run(cycles=12)
        # pieces of 32 KiB, one a cycle of 10 ms
        assert runtime.read("PLC_PRG.aborted") == [0, 1, 1, 4, 4, 4, 4, 0, 0, 0, 0, 0]
        assert runtime.read("PLC_PRG.late") == [0, 0, 0, 5101, 5101, 5101, 5101, 0, 0, 0, 0, 0]


def test_a_full_disk_is_an_incomplete_write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tappet.runtime.files.SIZE_LIMIT", 70_000)
    with LocalRuntime(compiled(WHOLE), folder=tmp_path) as runtime:
        assert outcome(runtime, 21)[:3] == [0, 0, 5111]
    assert (tmp_path / "files/moved.txt").stat().st_size == 65_536
