"""Every cell of the table of remanent variables: class, place and type by command, in real and virtual time
(language_declarations 5.1; PERS-01, PERS-02, PERS-03)."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from plc_programs import MS, build
from reset_table import CELLS, COMMANDS, KEPT, Cell, package

from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.runtime.forces import PlacedValue
from tappet.runtime.places import Place
from tappet.runtime.plc import SoftPlc
from tappet.runtime.retain import load_retain


def write(plc: SoftPlc) -> None:
    """Gives every variable of the table another value, and lets a cycle end."""
    symbols = plc.symbols()
    values = []
    for cell in CELLS:
        ref = symbols.resolve(cell.path)
        values.append(
            PlacedValue(Place(ref.offset, ref.size, ref.bit), symbols.encode(ref, cell.case.written))
        )
    done = plc.write(values)
    until = time.monotonic() + 30
    while not done():
        assert time.monotonic() < until
        time.sleep(0.001)
    cycle(plc)


def cycle(plc: SoftPlc) -> None:
    """At least one cycle of the task ends."""
    application = plc.application
    assert application is not None
    if plc.virtual:
        application.tasks.run_virtual(application.contexts.application["virtualNow"] + 20_000_000)
        return
    task = application.contexts.tasks[0]
    before, until = task["cycle"], time.monotonic() + 30
    while task["cycle"] < before + 2:
        assert time.monotonic() < until
        time.sleep(0.001)


def value(plc: SoftPlc, cell: Cell) -> object:
    symbols = plc.symbols()
    ref = symbols.resolve(cell.path)
    return symbols.decode(ref, plc.read([(ref.offset, ref.size)])[0])


def wrong(plc: SoftPlc, command: str) -> list[str]:
    """Cells with another value than the table says."""
    found = []
    for cell in CELLS:
        want = cell.case.written if command in KEPT[cell.kind] else cell.case.initial
        got = value(plc, cell)
        if got != want:
            found.append(f"{command} {cell.kind} {cell.path}: {got!r} instead of {want!r}")
    return found


def moved(previous: CodePackage | None = None) -> CodePackage:
    """The application with all its variables at other places."""
    return package(added=3, previous=previous)


def after(plc: SoftPlc, command: str, folder: Path) -> SoftPlc:
    """The soft PLC behind the command; it is another one when the process ended."""
    if command in ("warm", "cold"):
        plc.reset(command)
    elif command == "origin":
        plc.reset("origin")
        assert plc.state == "empty"
        plc.download(package().to_bytes())
    elif command == "download":
        plc.download(moved().to_bytes())
    elif command == "online change":
        assert plc.application is not None
        change = moved(plc.application.package)
        assert change.online_change is not None
        assert change.online_change.moves
        plc.download(change.to_bytes(), "online_change")
    elif command == "stop and run":
        plc.stop()
        plc.start()
        cycle(plc)
    else:
        if command == "reboot":
            plc.close()
        plc = SoftPlc(folder, virtual=plc.virtual)
        assert plc.boot()
    return plc


@pytest.mark.parametrize("virtual", [False, True], ids=["real", "virtual"])
@pytest.mark.parametrize("state", ["run", "stop"])
@pytest.mark.parametrize("command", COMMANDS)
def test_what_a_command_leaves(tmp_path: Path, command: str, state: str, virtual: bool) -> None:
    plc = SoftPlc(tmp_path, virtual=virtual)
    plc.download(package().to_bytes())
    assert wrong(plc, "origin") == [], "at first all have their initial values"
    if state == "run":
        plc.start()
    write(plc)
    assert wrong(plc, "stop and run") == [], "then the written ones"
    left = plc
    try:
        plc = after(plc, command, tmp_path)
        assert wrong(plc, command) == []
    finally:
        plc.close()
        if left is not plc:
            left.close()


def test_every_class_is_in_every_place_it_may_be() -> None:
    assert {cell.kind for cell in CELLS} == set(KEPT)
    assert len(CELLS) == len({cell.path for cell in CELLS}) > 300


EVENT = """PROGRAM PLC_PRG
VAR RETAIN kept : INT; END_VAR
VAR go : BOOL; END_VAR
kept := kept;
END_PROGRAM
PROGRAM Other
VAR n : INT; END_VAR
n := n + 1;
END_PROGRAM"""
ON_EVENT = Task("OnEvent", kind="event", event="PLC_PRG.go", programs=("PLC_PRG",))
CYCLIC = Task("Cyclic", interval_ns=10 * MS, programs=("Other",))


@pytest.mark.parametrize("tasks", [(), (ON_EVENT,), (ON_EVENT, CYCLIC)], ids=["none", "event", "both"])
def test_a_written_value_is_kept_also_when_its_task_does_not_run(
    tmp_path: Path, tasks: tuple[Task, ...]
) -> None:
    plc = SoftPlc(tmp_path)
    plc.download(build(EVENT, tasks).to_bytes())
    plc.start()
    ref = plc.symbols().resolve("PLC_PRG.kept")
    done = plc.write([PlacedValue(Place(ref.offset, ref.size, None), (77).to_bytes(2, "little"))])
    until = time.monotonic() + 30
    while not done():
        assert time.monotonic() < until
        time.sleep(0.001)
    kept, _ = load_retain(tmp_path)
    assert kept["PLC_PRG.KEPT"].data == (77).to_bytes(2, "little")
    plc.close()


MOVED = """PROGRAM PLC_PRG
VAR RETAIN kept : DINT; END_VAR
kept := kept + 1;
END_PROGRAM
PROGRAM Other
VAR n : INT; END_VAR
n := n + 1;
END_PROGRAM"""


def test_a_program_that_moves_to_another_task_is_kept_by_that_one(tmp_path: Path) -> None:
    def tasks(slow: str, fast: str) -> tuple[Task, Task]:
        return (
            Task("Slow", interval_ns=60_000 * MS, programs=(slow,)),
            Task("Fast", interval_ns=1 * MS, priority=2, programs=(fast,)),
        )

    plc = SoftPlc(tmp_path)
    first = build(MOVED, tasks("PLC_PRG", "Other"))
    plc.download(first.to_bytes())
    plc.start()
    plc.download(build(MOVED, tasks("Other", "PLC_PRG"), previous=first).to_bytes(), "online_change")
    ref = plc.symbols().resolve("PLC_PRG.kept")
    until = time.monotonic() + 30
    seen = 0
    while seen < 20:
        assert time.monotonic() < until
        seen = int.from_bytes(plc.read([(ref.offset, 4)])[0], "little")
    kept, _ = load_retain(tmp_path)
    assert int.from_bytes(kept["PLC_PRG.KEPT"].data, "little") >= seen - 1
    plc.close()
