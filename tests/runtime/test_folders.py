"""Folders of an application: the current one, copies and removals of whole trees, paths of files."""

from __future__ import annotations

from pathlib import Path

from library_programs import compiled

from tappet.runtime.local import LocalRuntime

LIBRARIES = ("SysFile, * (System)", "SysDir, * (System)")
NO_OBJECT, DUPLICATE, PARAMETER, BUFFER, DENIED, FAILED = 16, 18, 2, 15, 25, 1


def outcome(folder: Path, declared: str, steps: str, wanted: dict[str, object]) -> None:
    """Runs the steps once with the files in `folder`/files and compares variables."""
    text = f"""PROGRAM PLC_PRG
VAR once : BOOL; r : ARRAY [0..9] OF RTS_IEC_RESULT; h : RTS_IEC_HANDLE; {declared} END_VAR
IF once THEN RETURN; END_IF
once := TRUE;
{steps}
END_PROGRAM
"""
    with LocalRuntime(compiled(text, *LIBRARIES), folder=folder) as runtime:
        runtime.run(cycles=2)
        found = {name: runtime.literal(f"PLC_PRG.{name}") for name in wanted}
    assert found == {name: str(value) for name, value in wanted.items()}


def tree(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def filled(folder: Path) -> Path:
    files = folder / "files"
    (files / "from/deep/deeper").mkdir(parents=True)
    (files / "from/empty").mkdir()
    for name in ("a.txt", "deep/b.txt", "deep/deeper/c.txt"):
        (files / "from" / name).write_text(name)
    return files


def test_paths_begin_in_the_current_folder(tmp_path: Path) -> None:
    files = filled(tmp_path)
    outcome(
        tmp_path,
        "before, inside, back : STRING; name : STRING(80); pName : POINTER TO STRING(255);",
        """r[0] := SysDirGetCurrent(before, SIZEOF(before)); r[1] := SysDirSetCurrent('from/deep');
        r[2] := SysDirGetCurrent(inside, SIZEOF(inside)); r[3] := SysFileCopy('new.txt', 'b.txt', 0);
        h := SysFileOpen('deeper/c.txt', ACCESS_MODE.AM_READ, ADR(r[4])); pName := SysFileGetName(h);
        name := pName^; SysFileClose(h);
        r[5] := SysFileRename('$$PlcLogic$$/from/a.txt', 'moved.txt');
        r[6] := SysDirSetCurrent('deeper'); r[7] := SysFileDelete('c.txt');
        r[8] := SysDirSetCurrent(''); r[9] := SysDirGetCurrent(back, SIZEOF(back));""",
        {
            "r": [0] * 10, "before": "'$$PlcLogic$$'", "inside": "'$$PlcLogic$$/from/deep'",
            "back": "'$$PlcLogic$$'", "name": "'from/deep/deeper/c.txt'",
        },
    )  # fmt: skip
    assert tree(files) == [
        "from", "from/deep", "from/deep/b.txt", "from/deep/deeper", "from/deep/moved.txt",
        "from/deep/new.txt", "from/empty",
    ]  # fmt: skip


def test_what_no_current_folder_can_be(tmp_path: Path) -> None:
    files = filled(tmp_path)
    (files / "link").symlink_to(tmp_path)
    (tmp_path / "outside").write_text("secret")
    outcome(
        tmp_path,
        "current, tiny, none : STRING; i : INT; long : STRING(255);",
        """r[0] := SysDirSetCurrent('none'); r[1] := SysDirSetCurrent('..'); r[2] := SysDirSetCurrent('/etc');
        r[3] := SysDirSetCurrent('from/a.txt'); r[4] := SysDirSetCurrent('link');
        r[5] := SysDirSetCurrent('from'); h := SysFileOpen('../../outside', ACCESS_MODE.AM_READ, ADR(r[6]));
        FOR i := 0 TO 252 DO long[i] := 65; END_FOR
        h := SysFileOpen(long, ACCESS_MODE.AM_READ, ADR(r[7]));
        r[8] := SysDirGetCurrent(tiny, 5); r[9] := SysDirGetCurrent(none, 0);
        SysDirGetCurrent(current, SIZEOF(current));""",
        {
            "r": [NO_OBJECT, DENIED, DENIED, NO_OBJECT, NO_OBJECT, 0, DENIED, PARAMETER, BUFFER, PARAMETER],
            "tiny": "'$$Plc'", "current": "'$$PlcLogic$$/from'",
        },
    )  # fmt: skip


def test_a_reset_goes_back_to_the_folder_of_files(tmp_path: Path) -> None:
    filled(tmp_path)
    text = """PROGRAM PLC_PRG
VAR once : BOOL; before : STRING; END_VAR
IF NOT once THEN SysDirGetCurrent(before, SIZEOF(before)); SysDirSetCurrent('from'); END_IF
once := TRUE;
END_PROGRAM
"""
    with LocalRuntime(compiled(text, *LIBRARIES), folder=tmp_path) as runtime:
        runtime.run(cycles=2)
        runtime.reset("warm")
        runtime.start()
        runtime.run(cycles=2)
        assert runtime.read("PLC_PRG.before") == "$PlcLogic$"


def test_copies_of_trees(tmp_path: Path) -> None:
    files = filled(tmp_path)
    (files / "kept").mkdir()
    (files / "kept/a.txt").write_text("older")
    outcome(
        tmp_path,
        "",
        """r[0] := SysDirCopy('x/y/all', 'from', TRUE, FALSE);
        r[1] := SysDirCopy('flat', 'from', FALSE, FALSE);
        r[2] := SysDirCopy('kept', 'from', FALSE, FALSE); r[3] := SysDirCopy('over', 'kept', FALSE, FALSE);
        r[4] := SysDirCopy('over', 'from', FALSE, TRUE); r[5] := SysDirCopy('new', 'none', TRUE, TRUE);
        r[6] := SysDirCopy('../new', 'from', TRUE, TRUE);""",
        {"r": [0, 0, 0, 0, 0, NO_OBJECT, DENIED, 0, 0, 0]},
    )
    assert tree(files / "x/y/all") == tree(files / "from")
    assert (files / "x/y/all/deep/deeper/c.txt").read_text() == "deep/deeper/c.txt"
    assert tree(files / "flat") == ["a.txt"]
    assert (files / "kept/a.txt").read_text() == "older"
    assert (files / "over/a.txt").read_text() == "a.txt"
    assert not (files / "new").exists()
    assert not (tmp_path / "new").exists()


def test_folders_are_made_and_removed_with_those_around_and_in_them(tmp_path: Path) -> None:
    files = filled(tmp_path)
    (files / "other/in").mkdir(parents=True)
    outcome(
        tmp_path,
        "",
        """r[0] := SysDirCreate2('m/n/o', FALSE); r[1] := SysDirCreate2('m/n/o', TRUE);
        r[2] := SysDirCreate2('m/n/o', TRUE); r[3] := SysDirDelete2('from', FALSE, FALSE);
        r[4] := SysDirDelete2('from', TRUE, TRUE); r[5] := SysDirDelete2('other', TRUE, FALSE);
        r[6] := SysDirDelete2('none', TRUE, FALSE); r[7] := SysDirDelete2('m/n/o', FALSE, TRUE);""",
        {"r": [NO_OBJECT, 0, DUPLICATE, FAILED, 0, 0, NO_OBJECT, 0, 0, 0]},
    )
    assert tree(files) == ["from", "m", "m/n"]


def test_no_handle_stays_open_behind_a_walk_that_fails(tmp_path: Path) -> None:
    deep = tmp_path / "files/d"
    for _ in range(20):
        deep = deep / "d"
    deep.mkdir(parents=True)
    outcome(
        tmp_path,
        "i : INT; name : STRING;",
        """FOR i := 0 TO 9 DO r[0] := SysDirCopy('copy', 'd', TRUE, TRUE); END_FOR
        h := SysDirOpen('d', name, 80, 0, ADR(r[1]));""",
        {"r": [FAILED, *[0] * 9], "name": "'d'"},
    )


def test_paths_of_files(tmp_path: Path) -> None:
    filled(tmp_path)
    outcome(
        tmp_path,
        "p : ARRAY [0..4] OF STRING; tiny : STRING;",
        """r[0] := SysFileGetPath('from/deep/none.txt', p[0], 81); r[1] := SysFileGetPath('a.txt', p[1], 81);
        r[2] := SysFileGetPath('$$PlcLogic$$/a.txt', p[2], 81); r[3] := SysFileGetPath('x\\y', p[3], 81);
        r[4] := SysFileGetPath('from/a.txt', tiny, 4); SysDirSetCurrent('from');
        r[5] := SysFileGetPath('a.txt', p[4], 81);""",
        {
            "r": [0, 0, 0, 0, BUFFER, 0, 0, 0, 0, 0],
            "p": ["from/deep", "$$PlcLogic$$", "$$PlcLogic$$", "x", "$$PlcLogic$$/from"], "tiny": "'fro'",
        },
    )  # fmt: skip
