"""Replays: equal to the recording bit by bit; the same fault at the same line; today's code on old inputs."""

from __future__ import annotations

import struct
import time
from dataclasses import replace

import msgspec
import pytest
from plc_programs import MS, build

from tappet.codegen.build import BuildOptions, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.flight import FlightSettings
from tappet.runtime.flight_recording import FlightRecording, read_recording, write_recording
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.replay import replay
from tappet.runtime.replay_comparison import Difference, SameProgram
from tappet.runtime.replay_result import Replayed, ReplayError

BOTTLE = """
TYPE E_State : (Idle, Filling, Done); END_TYPE
FUNCTION_BLOCK FB_Filler
VAR_INPUT run : BOOL; speed : REAL; END_VAR
VAR_OUTPUT level : REAL; END_VAR
VAR state : E_State; timer : TON; pLevel : POINTER TO REAL; END_VAR
pLevel := ADR(level);
timer(IN := run, PT := T#50ms);
CASE state OF
    E_State.Idle: IF timer.Q THEN state := E_State.Filling; END_IF
    E_State.Filling: pLevel^ := pLevel^ + speed; IF level > 100 THEN state := E_State.Done; END_IF
    E_State.Done: IF NOT run THEN state := E_State.Idle; level := 0; END_IF
END_CASE
END_FUNCTION_BLOCK
FUNCTION Share : DINT
VAR_INPUT a, b : DINT; END_VAR
Share := a / b;
END_FUNCTION

PROGRAM PLC_PRG
VAR
    start AT %IX0.0 : BOOL; weight AT %IW1 : INT; valve AT %QX0.0 : BOOL;
    filler : ARRAY [1..3] OF FB_Filler; i : INT; recipe : DINT := 10; pieces : DINT; text : STRING(20);
    pFiller : POINTER TO FB_Filler; elapsed : TIME;
END_VAR
pFiller := ADR(filler[2]);
FOR i := 1 TO 3 DO filler[i](run := start, speed := INT_TO_REAL(weight) / 10 + i); END_FOR
pieces := pieces + Share(100, recipe);
valve := pFiller^.level > 50;
text := CONCAT('n', DINT_TO_STRING(pieces));
elapsed := TIME();
END_PROGRAM
"""
MAIN = [Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",))]
FIXED = BOTTLE.replace("Share := a / b;", "IF b <> 0 THEN Share := a / b; END_IF")
"""The same program after the bug was mended."""


def _record(
    package: CodePackage, *, fail: bool = True, settings: FlightSettings | None = None
) -> FlightRecording:
    """A run with changing inputs, a written value and a force; a recipe of 0 ends it."""
    with LocalRuntime(package, flight=settings) as runtime:
        application = runtime.plc.application
        assert application is not None
        for cycle in range(60):
            application.put_inputs(0, struct.pack("<BBh", 1 if cycle % 37 else 0, 0, cycle * 7 % 100))
            if cycle == 20:
                runtime.write("PLC_PRG.recipe", 4)
            if cycle == 30:
                runtime.force("PLC_PRG.filler[3].level", 77.5)
            if cycle == 40:
                runtime.unforce()
            runtime.run(1)
        if fail:
            runtime.write_all({"PLC_PRG.recipe": 0, "PLC_PRG.filler[1].state": "E_State.Done"})
            with pytest.raises(ApplicationException):
                runtime.run(1)
        return read_recording(write_recording(runtime.plc.flight_recording()))


def test_a_fault_comes_again_at_its_line_and_cycle() -> None:
    recording = _record(build(BOTTLE, MAIN))
    assert recording.exception is not None
    played = replay(recording, show=["PLC_PRG.pieces", "PLC_PRG.filler[1].state", "PLC_PRG.text"])
    assert played.difference is None
    assert played.same_fault
    assert played.fault is not None
    assert (played.fault.name, played.fault.pou, played.fault.line) == ("DIV_ZERO", "Share", 17)
    assert (played.fault.cycle, played.last_cycle) == (recording.exception.cycle, recording.exception.cycle)
    assert played.cycles == len(recording.cycles) - 1
    # 20 cycles with a tenth of 100 each, 40 with a quarter, by the text of the program
    assert played.values == {
        "PLC_PRG.pieces": str(20 * 10 + 40 * 25),
        "PLC_PRG.filler[1].state": "Done",
        "PLC_PRG.text": f"'n{20 * 10 + 40 * 25}'",
    }


def test_another_image_address_changes_nothing() -> None:
    """The pointers of the recorded image are moved with it."""
    recording = _record(build(BOTTLE, MAIN))
    with LocalRuntime(build(BOTTLE, MAIN), image_address=recording.image_address) as other:
        application = other.plc.application
        assert application is not None
        assert application.image.address == recording.image_address, (
            "it takes the place of the recorded image"
        )
        played = replay(recording)
    assert played.difference is None
    assert played.same_fault


def test_it_stops_where_it_is_told_to() -> None:
    recording = _record(build(BOTTLE, MAIN))
    played = replay(recording, until=25, show=["PLC_PRG.pieces"])
    assert (played.last_cycle, played.fault) == (25, None)
    assert played.values == {"PLC_PRG.pieces": str(20 * 10 + 5 * 25)}


def test_a_run_without_fault_ends_as_it_did() -> None:
    recording = _record(build(BOTTLE, MAIN), fail=False)
    played = replay(recording)
    assert (played.difference, played.fault, played.recorded, played.same_fault) == (None, None, None, True)


def test_the_first_cycle_and_variable_that_differ_are_named() -> None:
    recording = _record(build(BOTTLE, MAIN))
    assert any(write.cycle == 21 for write in recording.writes)
    lost = msgspec.structs.replace(recording, writes=[w for w in recording.writes if w.cycle != 21])
    played = replay(lost)
    assert played.difference is not None
    assert played.difference.cycle == 21
    found = {name: (then, now) for name, then, now in played.difference.variables}
    assert found["PLC_PRG.recipe"] == ("4", "10")
    assert found["PLC_PRG.pieces"] == ("225", "210")
    assert played.same_fault, "the last write, which leads to the fault, is still there"


def test_what_lies_behind_the_end_of_a_text_is_no_difference() -> None:
    """It is left over from where the text was put together."""
    package = build(BOTTLE, MAIN)
    symbols = package.symbols
    text = symbols.resolve("PLC_PRG.text")
    then = bytearray(package.image_size)
    now = bytearray(then)
    comparison = SameProgram(symbols, [], 0, 0)
    then[text.offset : text.offset + 6] = b"n1\0abc"
    now[text.offset : text.offset + 6] = b"n1\0xyz"
    assert comparison.difference(7, bytes(then), bytes(now)) is None
    now[text.offset + 1] = ord("2")
    assert comparison.difference(7, bytes(then), bytes(now)) == Difference(
        7, (("PLC_PRG.text", "'n1'", "'n2'"),)
    )


def test_several_tasks_run_in_their_order() -> None:
    text = """
VAR_GLOBAL a, b, c : DINT; trigger : BOOL; END_VAR
PROGRAM Fast a := a * 3 + b; trigger := a MOD 5 = 0; END_PROGRAM
PROGRAM Slow b := b + a MOD 17 + c; END_PROGRAM
PROGRAM Same c := c + a + b; END_PROGRAM
PROGRAM OnEvent c := c XOR a; END_PROGRAM
"""
    tasks = [
        Task("Slow", interval_ns=30 * MS, priority=5, programs=("Slow",)),
        Task("Fast", interval_ns=10 * MS, priority=3, programs=("Fast",)),
        Task("Same", interval_ns=20 * MS, priority=1, programs=("Same",)),
        Task("OnEvent", kind="event", event="trigger", priority=9, programs=("OnEvent",)),
    ]
    package = build(text, tasks)
    for seconds in (
        10.0,
        0.25,
    ):  # from the first cycle on; from the midst, where the tasks have no common start
        with LocalRuntime(package, flight=FlightSettings(seconds=seconds)) as runtime:
            runtime.run(103)
            recording = runtime.plc.flight_recording()
        assert recording.cycles[0].cycle == 1 or seconds < 1
        played = replay(recording)
        assert played.difference is None, played.difference


@pytest.mark.parametrize("after", range(8, 14))
def test_forces_hold_from_the_first_kept_moment_on(after: int) -> None:
    """Also in a task that comes behind the bus cycle task in that moment, wherever in the recording it is
    that they end."""
    count = "VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"
    tasks = [
        Task("Fast", interval_ns=10 * MS, priority=1, programs=("Fast",)),
        Task("Late", interval_ns=10 * MS, priority=2, programs=("Late",)),
    ]
    package = build(f"PROGRAM Fast {count} PROGRAM Late {count}", tasks)
    with LocalRuntime(package, flight=FlightSettings(seconds=0.1)) as runtime:
        runtime.force("Late.n", 3)
        runtime.run(20)
        runtime.unforce()
        runtime.run(after)
        recording = runtime.plc.flight_recording()
    played = replay(recording, show=["Late.n"])
    assert (played.difference, played.values) == (None, {"Late.n": str(3 + after)})


def test_code_that_was_mended_no_longer_fails() -> None:
    recording = _record(build(BOTTLE, MAIN))
    mended = _built_on(recording.code(), FIXED)
    played = replay(recording, code=mended, show=["PLC_PRG.pieces"])
    assert (played.fault, played.same_fault) == (None, False)
    assert played.values == {"PLC_PRG.pieces": str(20 * 10 + 40 * 25)}
    still = replay(recording, code=_built_on(recording.code(), BOTTLE.replace("a / b;", "a / b; // why?")))
    assert still.fault is not None
    assert still.same_fault


def test_variables_of_mended_code_are_found_by_name() -> None:
    """A variable before all others moves them: inputs, writes and forces still reach their own."""
    recording = _record(build(BOTTLE, MAIN))
    text = FIXED.replace("pieces : DINT;", "extra : ARRAY [0..99] OF LREAL; pieces : DINT; more : INT := 3;")
    text = text.replace("VAR state :", "VAR before : LWORD; state :")
    played = replay(
        recording,
        code=_built_on(recording.code(), text),
        show=["PLC_PRG.pieces", "PLC_PRG.recipe", "PLC_PRG.more"],
    )
    assert played.fault is None
    pieces = str(20 * 10 + 40 * 25)
    assert played.values == {"PLC_PRG.pieces": pieces, "PLC_PRG.recipe": "0", "PLC_PRG.more": "3"}


def test_what_other_code_does_otherwise_is_told() -> None:
    """Of the variables that both programs have, wherever they lie; pointers and new ones do not count."""
    recording = _record(build(BOTTLE, MAIN))
    text = FIXED.replace("pieces : DINT;", "extra : ARRAY [0..99] OF LREAL; pieces : DINT;")
    same = replay(recording, code=_built_on(recording.code(), text))
    assert (same.fault, same.difference) == (None, None)
    other = text.replace("IF b <> 0 THEN", "IF b = 4 THEN Share := 26; ELSIF b <> 0 THEN")
    played = replay(recording, code=_built_on(recording.code(), other))
    assert played.difference is not None
    assert played.difference.cycle == 21, "in which the recipe becomes 4"
    found = {name: (then, now) for name, then, now in played.difference.variables}
    # 20 cycles with a tenth of 100, then a quarter, which is 25 in the one and 26 in the other
    assert found == {"PLC_PRG.pieces": ("225", "226"), "PLC_PRG.text": ("'n225'", "'n226'")}


def _built_on(package: CodePackage, text: str) -> CodePackage:
    result = build_application([Source("a.st", text)], MAIN, BuildOptions(), previous=package)
    assert result.package is not None, result.diagnostics
    return result.package


def test_code_of_something_else_is_refused() -> None:
    recording = _record(build(BOTTLE, MAIN))
    with pytest.raises(ReplayError, match="no online change"):
        replay(recording, code=build(FIXED, MAIN))


@pytest.mark.parametrize(
    ("change", "says"),
    [({"bus": None}, "no bus cycle task"), ({"period": 2}, "every 2th"), ({"parts": 3}, "a part of it")],
)
def test_what_lacks_cycles_is_refused(change: dict[str, object], says: str) -> None:
    recording = _record(build(BOTTLE, MAIN), fail=False)
    with pytest.raises(ReplayError, match=says):
        replay(msgspec.structs.replace(recording, **change))


def test_a_cycle_that_takes_too_long_is_the_same_fault_at_any_line() -> None:
    """Where it was when its time was over is chance."""
    recording = _record(build(BOTTLE, MAIN))
    fault = recording.exception
    assert fault is not None
    slow = replace(fault, name="WATCHDOG", line=5)
    assert Replayed(1, 1, slow, replace(slow, line=9, pou="Share")).same_fault
    assert not Replayed(1, 1, slow, replace(slow, task="Other")).same_fault
    assert not Replayed(1, 1, fault, replace(fault, line=fault.line + 1)).same_fault


def test_a_real_run_ends_in_its_fault_again() -> None:
    """Recorded in real time, with writes that arrive whenever they do."""
    package = build(BOTTLE.replace("elapsed := TIME();", ""), MAIN)
    with LocalRuntime(package, virtual=False) as runtime:
        for value in (5, 20, 50, 0):
            time.sleep(0.03)
            runtime.write("PLC_PRG.recipe", value)
        due = time.monotonic() + 10
        while runtime.exception is None and time.monotonic() < due:
            time.sleep(0.005)
        recording = read_recording(write_recording(runtime.plc.flight_recording()))
    assert recording.exception is not None
    played = replay(recording, show=["PLC_PRG.recipe"])
    assert played.same_fault
    assert played.difference is None, played.difference
    assert played.fault is not None
    assert played.fault.cycle == recording.exception.cycle
    assert played.values == {"PLC_PRG.recipe": "0"}


BESIDE = """
VAR_GLOBAL a, b, order : DINT; END_VAR
PROGRAM Bus a := a + 1; order := order * 3 + b; END_PROGRAM
PROGRAM Other b := b + a; order := order * 5 + 1; END_PROGRAM
"""
BUS = Task("Bus", interval_ns=10 * MS, priority=3, programs=("Bus",))


def test_tasks_of_events_run_where_they_ran() -> None:
    """What raised them is not recorded: neither the inputs nor a grid of time say when they came."""
    task = Task("Signal", "external", 0, 1, event="SIGUSR1", programs=("Other",))
    with LocalRuntime(build(BESIDE, (BUS, task))) as runtime:
        for times in (3, 1, 0, 2, 4, 1, 1, 0, 5):
            runtime.plc.happen("SIGUSR1")
            runtime.run(cycles=max(times, 1))
        assert runtime.read("b") != 0
        recording = read_recording(write_recording(runtime.plc.flight_recording()))
        values = {name: str(runtime.read(name)) for name in ("a", "b", "order")}
    played = replay(recording, show=list(values))
    assert (played.difference, played.notes, played.values) == (None, (), values)


@pytest.mark.parametrize("interval", [3, 7, 10, 25])
def test_other_tasks_of_a_real_run_come_where_they_came(interval: int) -> None:
    """Each at its own time, never in the midst of another: one processor, and cycles that take no time."""
    other = Task("Other", interval_ns=interval * MS, priority=5, programs=("Other",))
    with LocalRuntime(build(BESIDE, (BUS, other)), virtual=False) as runtime:
        due = time.monotonic() + 20
        while int(str(runtime.read("a"))) < 60 and time.monotonic() < due:
            time.sleep(0.01)
        runtime.stop()
        recording = read_recording(write_recording(runtime.plc.flight_recording()))
        values = {name: str(runtime.read(name)) for name in ("a", "b", "order")}
    beside = [one.cycle for one in recording.cycles[1:] if one.tasks[1].beside]
    played = replay(recording, show=list(values))
    if beside:  # the machine was busy: two cycles met
        assert played.difference is None or played.difference.cycle >= beside[0]
    else:
        assert (played.difference, played.notes, played.values) == (None, (), values)


def test_a_difference_behind_tasks_that_ran_at_the_same_time_says_so() -> None:
    slow = Task("Slow", interval_ns=30 * MS, priority=5, programs=("Other",))
    with LocalRuntime(build(BESIDE, (BUS, slow))) as runtime:
        runtime.run(20)
        runtime.write("a", 1000)
        runtime.run(5)
        recording = runtime.plc.flight_recording()
    assert (replay(recording).difference, replay(recording).notes) == (None, ())
    lost = msgspec.structs.replace(recording, writes=[])
    alone = replay(lost)
    assert alone.difference is not None
    assert (alone.difference.cycle, alone.notes) == (21, ())
    for cycle, told in ((12, True), (24, False)):
        cycles = [
            msgspec.structs.replace(
                one,
                tasks=[one.tasks[0], msgspec.structs.replace(one.tasks[1], before=one.tasks[1].after + 1)],
            )
            if one.cycle == cycle
            else one
            for one in recording.cycles
        ]
        played = replay(msgspec.structs.replace(lost, cycles=cycles))
        found = [
            note for note in played.notes if f"from cycle {cycle} on, tasks ran at the same time" in note
        ]
        assert len(found) == told
