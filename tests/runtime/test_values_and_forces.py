"""Reading, writing and forcing variables, inputs and outputs."""

import pytest
from plc_programs import MS, build

from tappet.iec.task import Task
from tappet.runtime.errors import PlcError
from tappet.runtime.local import LocalRuntime

TEXT = """
PROGRAM PLC_PRG
VAR
    i : INT;
    seen : INT;
    w : WORD;
    seenBit : BOOL;
    s : STRING(20);
    inp AT %IB2 : BYTE;
    inBit AT %IX0.1 : BOOL;
    out AT %QW0 : WORD;
    seenInput : BYTE;
END_VAR
seen := i;
seenBit := w.3;
seenInput := inp;
i := i + 1;
w.3 := FALSE;
out := INT_TO_WORD(i);
END_PROGRAM
"""


@pytest.fixture
def runtime():
    with LocalRuntime(build(TEXT)) as local:
        yield local


def test_ex_03_forces(runtime: LocalRuntime) -> None:
    """views_watch EX-03: a force is there at the begin and at the end of each cycle."""
    runtime.run(cycles=40)
    runtime.force("PLC_PRG.i", 5)
    runtime.run(cycles=3)
    assert (runtime.read("PLC_PRG.seen"), runtime.read("PLC_PRG.i")) == (5, 5)
    assert [(f.value.data, path) for f, path in runtime.plc.forces()] == [(b"\x05\0", "PLC_PRG.i")]
    runtime.unforce("PLC_PRG.i")
    runtime.run(cycles=2)
    assert runtime.read("PLC_PRG.i") == 7


def test_release_and_restore(runtime: LocalRuntime) -> None:
    runtime.run(cycles=40)
    runtime.force("PLC_PRG.i", 5)
    runtime.force("PLC_PRG.i", 6)
    runtime.run(cycles=3)
    runtime.unforce(restore=True)
    assert runtime.plc.forces() == []
    runtime.run(cycles=1)
    assert runtime.read("PLC_PRG.i") == 41


def test_written_value_is_there_once(runtime: LocalRuntime) -> None:
    runtime.write("PLC_PRG.i", 3)
    runtime.run(cycles=1)
    assert (runtime.read("PLC_PRG.seen"), runtime.read("PLC_PRG.i")) == (3, 4)


def test_single_bits(runtime: LocalRuntime) -> None:
    runtime.write("PLC_PRG.w", 0xFF00)
    runtime.force("PLC_PRG.w.3", True)
    runtime.run(cycles=2)
    assert (runtime.read("PLC_PRG.seenBit"), runtime.read("PLC_PRG.w")) == (True, 0xFF08)
    runtime.unforce("PLC_PRG.w.3")
    runtime.write("PLC_PRG.w.15", False)
    runtime.run(cycles=1)
    assert runtime.read("PLC_PRG.w") == 0x7F00


def test_strings(runtime: LocalRuntime) -> None:
    runtime.write("PLC_PRG.s", "'hello'")
    runtime.force("PLC_PRG.s", "'forced'")
    runtime.run(cycles=1)
    assert runtime.literal("PLC_PRG.s") == "'forced'"


def test_written_inputs_stay(runtime: LocalRuntime) -> None:
    """Without a driver a written input is a simulated one; the image takes it over in each cycle."""
    runtime.write("%IB2", 17)
    runtime.write("PLC_PRG.inBit", True)
    runtime.run(cycles=3)
    assert runtime.read("PLC_PRG.seenInput") == 17
    assert runtime.read("PLC_PRG.inBit") is True
    application = runtime.plc.application
    assert application is not None
    application.put_inputs(2, b"\x22")
    runtime.run(cycles=1)
    assert runtime.read("PLC_PRG.seenInput") == 0x22


def test_forced_input_wins_over_the_driver(runtime: LocalRuntime) -> None:
    runtime.force("PLC_PRG.inp", 99)
    application = runtime.plc.application
    assert application is not None
    application.put_inputs(2, b"\x22")
    runtime.run(cycles=1)
    assert runtime.read("PLC_PRG.seenInput") == 99


def test_outputs_leave_at_the_end_of_the_cycle(runtime: LocalRuntime) -> None:
    runtime.run(cycles=3)
    application = runtime.plc.application
    assert application is not None
    assert application.outputs()[:2] == b"\x03\0"
    runtime.force("%QW0", 0x1234)
    runtime.run(cycles=1)
    assert application.outputs()[:2] == b"\x34\x12"


def test_places_outside_the_image_are_refused(runtime: LocalRuntime) -> None:
    with pytest.raises(ValueError, match="outside the image"):
        runtime.plc.read([(runtime.package.image_size, 1)])


def test_values_of_one_call_arrive_together_in_real_time() -> None:
    text = """
    PROGRAM PLC_PRG
    VAR a, b : DINT; torn : DINT; n : DINT; END_VAR
    n := n + 1;
    IF a <> b THEN torn := torn + 1; END_IF
    END_PROGRAM
    """
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(text, (task,)), virtual=False) as runtime:
        for number in range(200):
            runtime.write_all({"PLC_PRG.a": number, "PLC_PRG.b": number})
        assert runtime.read("PLC_PRG.a") == 199
        assert runtime.read("PLC_PRG.torn") == 0


def test_a_full_queue_says_which_task_does_not_run() -> None:
    text = "PROGRAM PLC_PRG VAR a : DINT; END_VAR END_PROGRAM"
    task = Task("Slow", interval_ns=3_600_000 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(text, (task,)), virtual=False) as runtime:
        ref = runtime.package.symbols.resolve("PLC_PRG.a")
        runtime.run(cycles=1)
        value = runtime._placed("PLC_PRG.a", 1)
        assert ref.size == 4
        for _ in range(256):
            runtime.plc.write([value])
        with pytest.raises(PlcError, match="task Slow"):
            runtime.plc.write([value])


def test_forces_and_writes_work_while_stopped() -> None:
    with LocalRuntime(build(TEXT), virtual=False, start=False) as runtime:
        runtime.write("PLC_PRG.w", 7)
        assert runtime.read("PLC_PRG.w") == 7
        runtime.force("PLC_PRG.i", 12)
        trace = runtime.trace(["PLC_PRG.i"])
        runtime.plc.poll()
        while not trace.collect():
            pass
        assert trace.samples[-1].values == {"PLC_PRG.i": 12}
        assert runtime.state == "stop"
