"""Replays of random programs with random inputs, writes and forces are equal to what was recorded."""

from __future__ import annotations

from random import Random

import pytest
import write_st
from compared import LIBRARIES, SESSION

from programs import ProgramMaker
from tappet.codegen.build import BuildOptions, build_application
from tappet.codegen.faults import Fault
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.flight import FlightSettings
from tappet.runtime.flight_recording import FlightRecording, read_recording, write_recording
from tappet.runtime.forces import PlacedValue
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.places import Place
from tappet.runtime.replay import replay

CYCLES = 40
MS = 1_000_000
INPUTS = """
PROGRAM Inputs
VAR
    words AT %IW0 : ARRAY [0..7] OF WORD; sum : LWORD; i : INT;
    timer : TON; flips : DINT; value : REAL; elapsed : TIME;
END_VAR
FOR i := 0 TO 7 DO sum := ROL(sum, 7) XOR words[i]; END_FOR
timer(IN := sum.3, PT := T#30ms);
IF timer.Q THEN flips := flips + 1; END_IF
value := value * 0.5 + DINT_TO_REAL(flips);
elapsed := TIME();
END_PROGRAM
"""


def _package(r: Random) -> CodePackage | None:
    """A random program, another one that reads inputs, the clock and a timer, in one or two tasks."""
    text = write_st.program(ProgramMaker(r, size=r.choice((4, 10))).program())
    tasks = [Task("Main", interval_ns=10 * MS, priority=2, programs=("Inputs", "PLC_PRG"))]
    if r.random() < 0.4:
        second = Task(
            "Other", interval_ns=r.choice((10, 20, 70)) * MS, priority=r.randrange(4), programs=("PLC_PRG",)
        )
        tasks = [Task("Main", interval_ns=10 * MS, priority=2, programs=("Inputs",)), second]
        r.shuffle(tasks)
    options = BuildOptions(level=2, libraries=LIBRARIES)
    result = build_application([Source("a.st", text + INPUTS)], tasks, options, session=SESSION)
    return result.package


def _recorded(r: Random, package: CodePackage) -> FlightRecording | None:
    """Random bytes for the inputs in every cycle, for random variables now and then, and forces of some."""
    settings = FlightSettings(memory=4 << 20, seconds=r.choice((0.15, 10.0)))
    with LocalRuntime(package, flight=settings) as runtime:
        application = runtime.plc.application
        assert application is not None
        places = _places(package)
        try:
            for _ in range(CYCLES):
                application.put_inputs(0, r.randbytes(16))
                if r.random() < 0.2:
                    runtime.plc.write([_random(r, place) for place in r.sample(places, min(3, len(places)))])
                if r.random() < 0.1:
                    runtime.plc.force([_random(r, r.choice(places))])
                if r.random() < 0.05:
                    runtime.plc.unforce(None)
                runtime.run(1)
        except ApplicationException:
            pass
        recording = runtime.plc.flight_recording() if runtime.flight_status().count > 1 else None
    return None if recording is None else read_recording(write_recording(recording))


def _places(package: CodePackage) -> list[Place]:
    """Bytes of the numbers of the random program: what is no pointer, enumeration or text."""
    symbols, found = package.symbols, []
    for child in symbols.children("PLC_PRG"):
        if child.kind in ("int", "uint", "bits", "bool") and child.section == "VAR":
            ref = symbols.resolve(child.path)
            if "CONSTANT" not in ref.flags:
                found.append(Place(ref.offset, ref.size, ref.bit))
    ref = symbols.resolve("Inputs.flips")
    return [*found, Place(ref.offset, ref.size, ref.bit)]


def _random(r: Random, place: Place) -> PlacedValue:
    size = place.size
    data = bytes([r.randrange(2)]) if size == 1 else bytes([r.randrange(8)]) + bytes(size - 1)
    return PlacedValue(place, data)


def check(seed: int) -> bool:
    """Whether there was something to compare; AssertionError where a replay differs."""
    r = Random(seed)
    package = _package(r)
    recording = _recorded(r, package) if package is not None else None
    if recording is None:
        return False
    if recording.exception is not None and recording.exception.name == Fault.WATCHDOG.name:
        return False  # whether a cycle of some seconds is too long is a matter of the machine
    played = replay(recording)
    assert played.difference is None, f"seed {seed}: {played.difference}"
    assert played.same_fault, f"seed {seed}: {played.recorded} became {played.fault}"
    if recording.exception is not None and played.fault is not None:
        assert played.fault.cycle == recording.exception.cycle, f"seed {seed}"
    return True


def test_replays_of_random_programs_are_equal() -> None:
    assert sum(check(seed) for seed in range(25)) > 12


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_replays_of_many_random_programs_are_equal(block: int) -> None:
    assert sum(check(seed) for seed in range(1000 + 100 * block, 1100 + 100 * block)) > 50
