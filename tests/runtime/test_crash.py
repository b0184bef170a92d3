"""A program that ends the process of the runtime: the next process knows, and does not start it by itself."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from plc_programs import build

from tappet.codegen.package import CodePackage
from tappet.runtime import crash
from tappet.runtime.plc import SoftPlc

DESTROYING = """{attribute 'tappet_external' := 'tappet_task_current'}
FUNCTION TaskHandle : LWORD
END_FUNCTION
FUNCTION Destroy : BOOL
VAR_INPUT p : POINTER TO BYTE; END_VAR
VAR i : DINT; END_VAR
FOR i := 0 TO 5999 DO p[i] := 255; END_FOR
p := 0;
p^ := 1;
END_FUNCTION
"""
PROGRAM = """PROGRAM PLC_PRG
VAR n : DINT; last : DINT := 0; END_VAR
VAR RETAIN kept : DINT; END_VAR
n := n + 1;
kept := kept + 1;
IF n = last THEN Destroy(TaskHandle()); END_IF
END_PROGRAM
"""
IN_CYCLE = f"{DESTROYING}{PROGRAM}".replace("DINT := 0", "DINT := 5")
IN_FB_INIT = f"""{DESTROYING}FUNCTION_BLOCK Part
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
Destroy(TaskHandle());
END_METHOD
END_FUNCTION_BLOCK
{PROGRAM}""".replace("VAR n", "VAR part : Part; n")
SOUND = DESTROYING + PROGRAM

CHILD = """
import os, signal, sys, time
from pathlib import Path
from tappet.runtime.plc import SoftPlc
what, folder = sys.argv[1], Path(sys.argv[2])
plc = SoftPlc(folder)
if what == "download":
    plc.download((folder / "package").read_bytes())
    plc.start()
else:
    plc.boot()
    if what == "start":
        plc.start()
    elif what == "reset":
        plc.reset("cold")
        plc.start()
if what == "kill":
    os.kill(os.getpid(), signal.SIGKILL)
if what == "abort":
    os.abort()
end = time.monotonic() + 60
while plc.state != "exception" and time.monotonic() < end:
    time.sleep(0.01)
assert plc.state == "exception", "neither the process nor the application has ended"
"""


def process(what: str, folder: Path) -> int:
    """A runtime process that does what is asked for until it ends by itself; its return code."""
    return subprocess.run([sys.executable, "-c", CHILD, what, str(folder)], timeout=90).returncode


def left_by(folder: Path, package: CodePackage, *whats: str) -> None:
    """Let runtime processes end one after the other, the first of which downloads the package."""
    (folder / "package").write_bytes(package.to_bytes())
    for what in whats:
        assert process(what, folder) < 0


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path


def booted(folder: Path) -> SoftPlc:
    plc = SoftPlc(folder)
    plc.boot()
    return plc


@pytest.mark.parametrize("whats", [("download",), ("download", "start"), ("download", "reset")])
def test_the_next_process_tells_the_place_and_waits(folder: Path, whats: tuple[str, ...]) -> None:
    left_by(folder, build(IN_CYCLE), *whats)
    plc = booted(folder)
    try:
        assert plc.state == "exception"
        report = plc.exception()
        assert report is not None
        assert (report.name, report.task, report.pou) == ("PROCESS_ENDED", "Main", "Destroy")
        assert [frame.pou for frame in report.call_stack] == ["Destroy", "PLC_PRG"]
        assert report.line in (7, 8, 9)
        assert report.values["signal"] == "SIGSEGV"
        assert "download a corrected application, or start this one anyway" in report.message
        entry = next(e for e in plc.log.since() if e.severity == "exception")
        assert "SIGSEGV" in entry.message
        assert "Destroy" in entry.message
    finally:
        plc.close()


ABOVE = """PROGRAM PLC_PRG
VAR n : DINT; p : POINTER TO BYTE; i : DINT; END_VAR
n := n + 1;
IF n = 4 THEN p := OnItsStack(); END_IF
IF n = 5 THEN FOR i := 0 TO {count} DO p[i] := {value}; END_FOR END_IF
END_PROGRAM
FUNCTION OnItsStack : POINTER TO BYTE
VAR here : ARRAY[0..9] OF BYTE; END_VAR
OnItsStack := ADR(here);
END_FUNCTION
"""
"""A cycle finds the place, the next one writes: what a function writes to its own variables is left out."""


@pytest.mark.parametrize("count", [6_000, 3_000_000])
@pytest.mark.parametrize("value", [0, 65, 255])
def test_what_it_overwrites_above_its_stack_hides_no_reason(folder: Path, count: int, value: int) -> None:
    """There lies what the C library and the kernel know of the thread; in the end there is no memory."""
    package = build(ABOVE.format(count=count, value=value))
    (folder / "package").write_bytes(package.to_bytes())
    if process("download", folder) == 0:
        return  # an exception of the application: the process lives
    plc = booted(folder)
    try:
        report = plc.exception()
        assert report is not None
        assert report.name == "PROCESS_ENDED"
        assert report.values["signal"] in ("SIGSEGV", "SIGBUS", "SIGILL", "SIGABRT")
    finally:
        plc.close()


def test_initialisation_that_ends_the_process_is_not_repeated(folder: Path) -> None:
    """The package is not the boot application yet when its FB_Init runs for the first time."""
    package = build(IN_FB_INIT)
    left_by(folder, package, "download")
    (folder / "boot.tappet").write_bytes(package.to_bytes())
    plc = booted(folder)
    try:
        report = plc.exception()
        assert report is not None
        assert (report.name, report.task, report.pou) == ("PROCESS_ENDED", "initialisation", "Destroy")
    finally:
        plc.close()


def test_it_waits_as_long_as_nobody_starts_it(folder: Path) -> None:
    left_by(folder, build(IN_CYCLE), "download")
    for _ in range(2):
        plc = booted(folder)
        assert plc.state == "exception"
        plc.close()


def test_retained_values_are_there_before_and_after_the_start(folder: Path) -> None:
    left_by(folder, build(IN_CYCLE), "download")
    plc = booted(folder)
    try:
        assert plc.application is not None
        place = plc.application.package.symbols.resolve("PLC_PRG.kept")
        before = int.from_bytes(plc.read([(place.offset, place.size)])[0], "little")
        assert before >= 4
        plc.reset("warm")
        assert plc.state == "stop"
        assert int.from_bytes(plc.read([(place.offset, place.size)])[0], "little") == before
    finally:
        plc.close()


def test_a_download_ends_the_waiting(folder: Path) -> None:
    left_by(folder, build(IN_CYCLE), "download")
    plc = booted(folder)
    plc.download(build(SOUND).to_bytes())
    plc.start()
    plc.close()
    plc = booted(folder)
    try:
        assert plc.state == "run"
    finally:
        plc.close()


def test_one_that_was_not_yet_stored_does_not_keep_the_one_before_from_starting(folder: Path) -> None:
    plc = SoftPlc(folder)
    plc.download(build(SOUND).to_bytes())
    plc.close()
    left_by(folder, build(IN_FB_INIT, name="Other"), "download")
    plc = booted(folder)
    try:
        assert plc.state == "run"
        assert any("Other" in e.message and "SIGSEGV" in e.message for e in plc.log.since())
    finally:
        plc.close()


def test_a_kill_is_not_held_against_the_application_until_it_repeats(folder: Path) -> None:
    """Nobody wrote why: power may have failed once, but not at each start."""
    plc = SoftPlc(folder)
    plc.download(build(SOUND).to_bytes())
    plc.close()
    for _ in range(crash.MOST_STARTS):
        assert process("kill", folder) == -signal.SIGKILL
    plc = booted(folder)
    try:
        report = plc.exception()
        assert report is not None
        assert report.name == "PROCESS_ENDED"
        assert "without a reason that is known" in report.message
        plc.start()
        assert plc.state == "run"
    finally:
        plc.close()


def test_starts_that_went_well_do_not_count(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(crash, "STABLE_S", 0.0)
    plc = SoftPlc(folder)
    plc.download(build(SOUND).to_bytes())
    plc.close()
    for _ in range(2 * crash.MOST_STARTS):
        if (child := os.fork()) == 0:
            plc = booted(folder)
            plc.poll()
            os.kill(os.getpid(), signal.SIGKILL)
        os.waitpid(child, 0)
    plc = booted(folder)
    try:
        assert plc.state == "run"
        assert any("started again" in e.message for e in plc.log.since())
    finally:
        plc.close()


def test_an_abort_of_the_process_itself_is_told(folder: Path) -> None:
    plc = SoftPlc(folder)
    plc.download(build(SOUND).to_bytes())
    plc.close()
    assert process("abort", folder) == -signal.SIGABRT
    plc = booted(folder)
    try:
        report = plc.exception()
        assert report is not None
        assert (report.values["signal"], report.task, report.pou) == ("SIGABRT", "", "")
    finally:
        plc.close()


@pytest.mark.parametrize("content", [b"", b"x" * 10_000, bytes(4096), bytes(4096) + b"\x81"])
def test_a_damaged_mark_is_no_obstacle(folder: Path, content: bytes) -> None:
    plc = SoftPlc(folder)
    plc.download(build(SOUND).to_bytes())
    plc.close()
    (folder / crash.FILE).write_bytes(content)
    plc = booted(folder)
    try:
        assert plc.state == "run"
    finally:
        plc.close()


def test_a_proper_end_leaves_no_mark(folder: Path) -> None:
    plc = SoftPlc(folder)
    plc.download(build(SOUND).to_bytes())
    assert (folder / crash.FILE).exists()
    plc.start()
    plc.close()
    assert not (folder / crash.FILE).exists()
