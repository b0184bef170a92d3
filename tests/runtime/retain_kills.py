"""Kills a soft PLC at random instants, thousands of times; `test_retain_kills` runs this as a process.

Each round is a child of this process, which has everything imported and linked already, so that the time goes
into what is killed: a boot, cycles, a save, a download, an online change or a reset. The program keeps an
invariant over all its remanent variables: counters and mirrors, a table that is a function of the counter,
and a sum that the program makes of it. The next child says what it has found.
"""

from __future__ import annotations

import json
import mmap
import os
import random
import signal
import sys
import threading
import time
import traceback
from collections import Counter
from ctypes import Structure, c_int64
from pathlib import Path

from plc_programs import MS, build

from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.runtime.executive.loader import Executive
from tappet.runtime.flight import FlightSettings
from tappet.runtime.plc import SoftPlc
from tappet.whole_file import remove_unfinished

SLOTS = 10_000
"""Words of the table: copying them takes so long that many kills come in the midst of it."""
TEXT = f"""PROGRAM PLC_PRG
VAR RETAIN count, mirror, sum : LINT; words : ARRAY[1..{SLOTS}] OF LINT; END_VAR
VAR n, first, firstHours, torn, i, s : LINT; END_VAR
IF n = 0 THEN
    first := count;
    firstHours := hours;
    s := 0;
    FOR i := 1 TO {SLOTS} DO
        s := s + words[i];
        IF words[i] <> count * i THEN torn := torn + 1; END_IF
    END_FOR
    IF s <> sum THEN torn := torn + 1000; END_IF
    IF mirror <> count THEN torn := torn + 10000; END_IF
    IF hours <> twin THEN torn := torn + 100000; END_IF
END_IF
n := n + 1;
count := count + 1;
hours := hours + 1;
sum := 0;
FOR i := 1 TO {SLOTS} DO words[i] := count * i; sum := sum + words[i]; END_FOR
twin := hours;
mirror := count;
END_PROGRAM
PROGRAM Second
VAR RETAIN a : LINT; text : STRING(200); b : LINT; END_VAR
VAR n, torn : LINT; END_VAR
IF n = 0 AND (a <> b OR (a <> 0 AND text <> CONCAT('count ', LINT_TO_STRING(a)))) THEN torn := 1; END_IF
n := n + 1;
a := a + 1;
text := CONCAT('count ', LINT_TO_STRING(a));
b := a;
END_PROGRAM
"""
LISTS = {"Persistent": "VAR_GLOBAL PERSISTENT RETAIN hours, twin : LINT; END_VAR"}
LONGER = {"Persistent": "VAR_GLOBAL PERSISTENT RETAIN added : LREAL; hours, twin, last : LINT; END_VAR"}
TASKS = (
    Task("Main", interval_ns=MS // 4, priority=1, programs=("PLC_PRG",)),
    Task("Other", interval_ns=2 * MS, priority=2, programs=("Second",)),
)
CHANGES = 4
"""Online changes in a row, each of which adds or removes remanent variables; then comes a download."""
ACTS = {
    "boot": 4, "run": 6, "save": 6, "download": 4, "online change": 6, "warm": 4, "cold": 3, "origin": 1,
}  # fmt: skip
"""What the kill interrupts, and how often."""
NAMES = {
    "found": "PLC_PRG.first",
    "found_hours": "PLC_PRG.firstHours",
    "torn": "PLC_PRG.torn",
    "torn_second": "Second.torn",
    "cycles": "PLC_PRG.n",
    "cycles_second": "Second.n",
    "count": "PLC_PRG.count",
    "hours": "Persistent.hours",
}
PATIENCE_S = 60.0


class Seen(Structure):
    """What a child says, in memory that outlives it; each field is stored as a whole."""

    _fields_ = [
        ("reported", c_int64),  # it has looked at what it found
        ("found", c_int64),
        ("found_hours", c_int64),
        ("torn", c_int64),
        ("count", c_int64),  # of the last completed cycle that was observed
        ("hours", c_int64),
        ("begun", c_int64),  # the act is on
        ("done", c_int64),  # and over
        ("failed", c_int64),
    ]


def packages() -> list[CodePackage]:
    """Applications, each of which is an online change of the one before."""
    made = [build(TEXT, TASKS, gvls=LISTS)]
    for number in range(CHANGES):
        lists = LISTS if number % 2 else LONGER
        made.append(build(TEXT, TASKS, gvls=lists, previous=made[-1]))
    return made


def observed(plc: SoftPlc) -> dict[str, int]:
    """Values between two cycles of both tasks."""
    application = plc.application
    assert application is not None
    symbols = plc.symbols()
    places = {name: symbols.resolve(path).offset for name, path in NAMES.items()}
    cells = [task.place("sequence") for task in application.contexts.tasks]
    while True:
        before = [plc.executive.load(cell) for cell in cells]
        values = {
            name: int.from_bytes(application.image.read(offset, 8), "little")
            for name, offset in places.items()
        }
        if all(n % 2 == 0 for n in before) and before == [plc.executive.load(cell) for cell in cells]:
            return values
        time.sleep(0)


def look(plc: SoftPlc, seen: Seen) -> None:
    """What the first cycle has found."""
    values = observed(plc)
    while not values["cycles"] or not values["cycles_second"]:
        time.sleep(0.0005)
        values = observed(plc)
    seen.found, seen.found_hours = values["found"], values["found_hours"]
    seen.torn = values["torn"] + values["torn_second"] * 1_000_000
    seen.count, seen.hours = values["count"], values["hours"]
    seen.reported = 1


def watch(plc: SoftPlc, seen: Seen, stop: threading.Event) -> None:
    while not stop.is_set():
        values = observed(plc)
        seen.count, seen.hours = values["count"], values["hours"]


def act(plc: SoftPlc, name: str, made: list[CodePackage], seen: Seen) -> None:
    """What is going on when the kill comes; it comes before the end of this."""
    if name in ("run", "boot"):
        seen.begun = 1
        watch(plc, seen, threading.Event())
    if name == "save":
        ended = threading.Event()
        watching = threading.Thread(target=watch, args=(plc, seen, ended), daemon=True)
        watching.start()
        seen.begun = 1
        while True:
            plc.stop()
            plc.sync_retain()
            plc.start()
    seen.begun = 1
    if name == "download":
        plc.download(made[0].to_bytes())
    elif name == "online change":
        change(plc, made)
    else:
        plc.reset(name)
        if name == "origin":
            plc.download(made[0].to_bytes())
    plc.start()
    seen.done = 1
    threading.Event().wait()


def change(plc: SoftPlc, made: list[CodePackage]) -> None:
    info = plc.info()
    for package in made[1:]:
        assert package.online_change is not None
        base = (package.online_change.base_code_id, package.online_change.base_data_id)
        if base == (info.code_id, info.data_id):
            plc.download(package.to_bytes(), "online_change")
            return
    plc.download(made[0].to_bytes())  # the end of the chain; its persistent values go on


def child(folder: Path, name: str, made: list[CodePackage], seen: Seen) -> None:
    try:
        remove_unfinished(folder)
        plc = SoftPlc(folder, flight=FlightSettings(0))
        if not plc.boot():
            plc.download(made[0].to_bytes())
        plc.start()
        assert plc.state == "run", plc.state
        look(plc, seen)
        act(plc, name, made, seen)
    except BaseException:
        (folder.parent / "problem").write_text(traceback.format_exc())
        seen.failed = 1
    threading.Event().wait()


def kills(folder: Path, wanted: int, seed: int) -> dict[str, object]:
    """Kills `wanted` times; what was done, and what was found to be wrong."""
    chance = random.Random(seed)
    Executive.shared()
    made = packages()
    memory = mmap.mmap(-1, mmap.PAGESIZE)
    seen = Seen.from_buffer(memory)
    done: Counter[str] = Counter()
    wrong: list[str] = []
    looked, completed = 0, 0
    least, least_hours = 0, 0
    took = dict.fromkeys(ACTS, 0.02)
    folder.mkdir(mode=0o700, exist_ok=True)
    begun = time.monotonic()
    while sum(done.values()) < wanted and not wrong:
        (name,) = chance.choices(tuple(ACTS), tuple(ACTS.values()))
        memory.seek(0)
        memory.write(bytes(mmap.PAGESIZE))
        pid = os.fork()
        if pid == 0:
            child(folder, name, made, seen)
        end = time.monotonic() + PATIENCE_S
        if name != "boot":
            while not seen.begun and not seen.failed and time.monotonic() < end:
                time.sleep(0.0002)
            acted = time.monotonic()
        time.sleep(chance.uniform(0, {"boot": 0.06, "run": 0.02, "save": 0.03}.get(name, took[name])))
        if seen.done:  # later kills of this kind come sooner, those that came too soon come later
            took[name] *= 0.9
        elif name != "boot":
            took[name] = min(0.5, took[name] * 1.05 + (time.monotonic() - acted) * 0.01)
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        done[name] += 1
        if seen.failed:
            wrong.append((folder.parent / "problem").read_text())
        completed += seen.done
        if seen.reported:
            looked += 1
            if seen.torn:
                wrong.append(f"torn: {seen.torn}")
            if seen.found < least or seen.found_hours < least_hours:
                wrong.append(
                    f"found {seen.found} and {seen.found_hours}, but {least} and {least_hours} had been seen"
                )
            least, least_hours = max(seen.count, seen.found), max(seen.hours, seen.found_hours)
        if seen.begun and name in ("download", "online change", "cold", "origin"):
            least = 0  # RETAIN variables begin anew
        if seen.begun and name == "origin":
            least_hours = 0
    return {
        "kills": sum(done.values()),
        "done": dict(done),
        "starts that were looked at": looked,
        "commands that were over": completed,
        "wrong": wrong,
        "seconds": round(time.monotonic() - begun, 1),
        "count": least,
        "hours": least_hours,
    }


if __name__ == "__main__":
    print(json.dumps(kills(Path(sys.argv[1]) / "plc", int(sys.argv[2]), int(sys.argv[3]))))
