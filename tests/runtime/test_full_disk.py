"""A disk without room: every library for files says so, and the application goes on."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from library_programs import TC2_SYSTEM, compiled

from tappet.runtime.local import LocalRuntime

DISK = 128 * 1024
LIBRARIES = (TC2_SYSTEM, "SysFile, * (System)", "SysDir, * (System)", "CAA File, * (System)")
PROGRAM = """PROGRAM PLC_PRG
VAR
    n : INT; abData : ARRAY [0..199999] OF BYTE; r : ARRAY [0..4] OF RTS_IEC_RESULT; h : RTS_IEC_HANDLE;
    written, short, copied : __XWORD; size : ARRAY [0..1] OF __XWORD;
    fbOpen : FB_FileOpen; fbWrite : FB_FileWrite; fbClose : FB_FileClose; step : INT;
    caaOpen : FILE.Open; caaWrite : FILE.Write;
END_VAR
n := n + 1;
CASE n OF
1:
    h := SysFileOpen('sys', ACCESS_MODE.AM_WRITE, ADR(r[0]));
    written := SysFileWrite(h, ADR(abData), SIZEOF(abData), ADR(r[0]));
    short := SysFileWrite(h, ADR(abData), 10, ADR(r[1]));
    SysFileClose(h);
    size[0] := SysFileGetSize('sys', 0);
    SysFileCopy('copy', 'sys', ADR(copied));
    r[2] := SysFileCopy('copy', 'sys', ADR(copied));
    SysFileDelete('copy');
    SysFileDelete('sys');
    h := SysFileOpen('sys', ACCESS_MODE.AM_WRITE, ADR(r[3]));
    r[4] := SEL(SysFileWrite(h, ADR(abData), 10, 0) = 10, 99, 0);
    SysFileClose(h);
END_CASE
CASE step OF
0:
    fbOpen(sPathName := 'ads', nMode := FOPEN_MODEWRITE, bExecute := n > 1);
    IF fbOpen.hFile <> 0 THEN step := 1; END_IF
1:
    fbWrite(hFile := fbOpen.hFile, pWriteBuff := ADR(abData), cbWriteLen := SIZEOF(abData), bExecute := TRUE);
    IF NOT fbWrite.bBusy THEN step := 2; END_IF
2:
    fbClose(hFile := fbOpen.hFile, bExecute := TRUE);
    IF NOT fbClose.bBusy THEN size[1] := SysFileGetSize('ads', 0); SysFileDelete('ads'); step := 3; END_IF
3:
    caaOpen(sFileName := 'caa', eFileMode := FILE.MODE.MWRITE, xExecute := TRUE);
    IF caaOpen.xDone THEN step := 4; END_IF
4:
    caaWrite(hFile := caaOpen.hFile, pBuffer := ADR(abData), szSize := SIZEOF(abData), xExecute := TRUE);
    IF caaWrite.xError THEN step := 5; END_IF
END_CASE
END_PROGRAM
"""
VALUES = ("r", "written", "short", "size", "fbWrite.bError", "fbWrite.nErrId", "fbWrite.cbWrite", "step", "n")


def run_on(folder: Path) -> dict[str, str]:
    """What the program found on the disk of `folder`."""
    with LocalRuntime(compiled(PROGRAM, *LIBRARIES), folder=folder) as runtime:
        runtime.run(cycles=100)
        found = {name: runtime.literal(f"PLC_PRG.{name}") for name in VALUES}
        found["caa"] = runtime.literal("PLC_PRG.caaWrite.eError")
        found["state"] = runtime.state
    return found


def mounted(folder: Path) -> list[str]:
    """Command with which a command runs where a small disk of its own lies at `folder`."""
    mount = f'mount -t tmpfs -o size={DISK} tmpfs "{folder}" && exec "$@"'
    return ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", mount, "sh"]


def test_every_library_tells_of_a_full_disk(tmp_path: Path) -> None:
    disk = tmp_path / "disk"
    disk.mkdir()
    try:
        possible = subprocess.run([*mounted(disk), "true"], capture_output=True, check=False).returncode == 0
    except OSError:
        possible = False
    if not possible:
        pytest.skip("a file system cannot be mounted here")
    script = [*mounted(disk), sys.executable, __file__, str(disk)]
    search = os.pathsep.join(path for path in sys.path if path)
    done = subprocess.run(script, capture_output=True, env={**os.environ, "PYTHONPATH": search}, check=False)
    assert done.returncode == 0, done.stderr.decode()
    found = json.loads(done.stdout)
    room = int(found["written"])
    assert 0 < room <= DISK
    page = os.sysconf("SC_PAGE_SIZE")  # what is left of the first file takes one
    assert found == {
        # ERR_FAILED: the runtime system has no code of its own for it
        "r": "[1, 1, 1, 0, 0]", "written": str(room), "short": "0", "size": f"[{room}, {room - page}]",
        "fbWrite.bError": "TRUE", "fbWrite.nErrId": str(0x700), "fbWrite.cbWrite": str(room - page),
        "step": "5", "n": "100", "caa": "WRITE_INCOMPLETE", "state": "run",
    }  # fmt: skip


if __name__ == "__main__":
    sys.stdout.write(json.dumps(run_on(Path(sys.argv[1]))))
