"""What happens to halted tasks, breakpoints and the instrumented variant when the application changes."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest
from debugger_programs import add, at_line, build_both, halted, line, loaded, step, until, value
from plc_programs import MS, watchdog

from tappet.codegen.debug_code import DebugCode
from tappet.iec.task import Task
from tappet.runtime.debugger.shapes import Settings
from tappet.runtime.errors import PlcError
from tappet.runtime.plc import SoftPlc

TEXT = """PROGRAM PLC_PRG
VAR
    i : DINT;
    done : DINT;
END_VAR
i := i + 1;
IF i > 3 THEN
    done := i;
END_IF
done := i;
END_PROGRAM
"""
CHANGED = TEXT.replace("i := i + 1;", "// a comment\n\ni := i + 2;")
GROWN = TEXT.replace("done : DINT;", "done : DINT;\n    more : ARRAY [0..9] OF LINT;")


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    add(plc, 10)
    plc.start()
    halted(plc)
    yield plc
    plc.close()


def test_stop_completes_the_cycle(plc: SoftPlc) -> None:
    plc.stop()
    assert plc.state == "stop"
    assert plc.debugger.halted_tasks() == ()
    assert value(plc, "PLC_PRG.done") == value(plc, "PLC_PRG.i") == 1
    plc.start()
    assert line(plc) == 10


@pytest.mark.parametrize("kind", ["warm", "cold"])
def test_reset_gets_the_task_out(plc: SoftPlc, kind: str) -> None:
    plc.reset(kind)
    assert plc.state == "stop"
    assert value(plc, "PLC_PRG.i") == 0
    plc.start()
    assert line(plc) == 10
    assert value(plc, "PLC_PRG.i") == 1


def test_reset_origin_removes_the_application(plc: SoftPlc) -> None:
    plc.reset("origin")
    assert plc.state == "empty"
    assert plc.debugger.state().halted == []
    assert [b.verified for b in plc.debugger.state().breakpoints] == [False]


@pytest.mark.parametrize("text", [CHANGED, GROWN])
def test_an_online_change_completes_the_cycle_and_drops_the_variant(plc: SoftPlc, text: str) -> None:
    running = plc.loaded().package
    package, variant = build_both(text, previous=running)
    plc.download(package.to_bytes(), "online_change")
    state = plc.debugger.state()
    assert not state.available
    assert state.halted == []
    assert "not loaded" in (state.breakpoints[0].reason or "")
    before = value(plc, "PLC_PRG.i")
    until(lambda: value(plc, "PLC_PRG.i") > before)
    plc.debugger.load(variant)
    assert line(plc) >= 10
    assert plc.debugger.state().breakpoints[0].verified


@pytest.mark.parametrize("text", [CHANGED, GROWN])
def test_no_task_halts_again_in_code_that_an_online_change_drops(
    plc: SoftPlc, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As soon as the tasks go on, the next cycle meets the breakpoint of whatever code it runs."""
    package, _ = build_both(text, previous=plc.loaded().package)
    tasks = plc.loaded().tasks
    standing = tasks.standing

    @contextmanager
    def then_a_cycle() -> Iterator[None]:
        with standing():
            yield
        cycles = plc.tasks()[0].cycles
        until(lambda: plc.tasks()[0].cycles > cycles + 1 or bool(plc.debugger.halted_tasks()))

    monkeypatch.setattr(tasks, "standing", then_a_cycle)
    plc.download(package.to_bytes(), "online_change")
    before = value(plc, "PLC_PRG.i")
    until(lambda: value(plc, "PLC_PRG.i") > before)


def test_a_download_places_the_breakpoints_again(plc: SoftPlc) -> None:
    package, variant = build_both(GROWN)
    plc.load(package)
    assert not plc.debugger.state().available
    plc.debugger.load(variant)
    plc.start()
    assert line(plc) == 11, "the statement behind line 10, which is END_IF now"


def test_the_variant_of_another_application_is_refused(plc: SoftPlc) -> None:
    _, other = build_both(GROWN)
    with pytest.raises(PlcError, match="another application"):
        plc.debugger.load(other)
    with pytest.raises(PlcError, match="refused"):
        plc.debugger.load(b"rubbish")
    damaged = DebugCode.from_bytes(other)
    damaged.objects[0] = b"no object"
    with pytest.raises(PlcError, match="ELF"):
        plc.debugger.load(damaged.to_bytes())


def test_single_cycle_of_a_halted_application_runs_to_the_end_of_the_cycle(plc: SoftPlc) -> None:
    plc.single_cycle()
    until(lambda: not plc.debugger.halted_tasks())
    assert plc.state == "stop"
    plc.stop()
    assert value(plc, "PLC_PRG.done") == 1
    plc.single_cycle()
    assert line(plc) == 10, "breakpoints hold in a single cycle, too"
    assert plc.state == "stop"
    plc.single_cycle()
    until(lambda: not plc.debugger.halted_tasks())
    plc.stop()
    assert value(plc, "PLC_PRG.done") == 2


def test_writes_and_forces_act_while_halted(plc: SoftPlc) -> None:
    from tappet.runtime.forces import PlacedValue
    from tappet.runtime.places import Place

    place = plc.symbols().resolve("PLC_PRG.i")
    plc.write([PlacedValue(Place(place.offset, place.size), (70).to_bytes(4, "little"))])
    assert value(plc, "PLC_PRG.i") == 70
    plc.force([PlacedValue(Place(place.offset, place.size), (5).to_bytes(4, "little"))])
    assert value(plc, "PLC_PRG.i") == 5


def test_halted_time_is_no_overrun_and_no_watchdog() -> None:
    slow = Task("Main", interval_ns=5 * MS, programs=("PLC_PRG",), watchdog=watchdog(2, 1))
    plc = loaded(TEXT, (slow,))
    try:
        add(plc, 10)
        plc.start()
        for _ in range(3):
            halted(plc)
            start = plc.tasks()[0].cycles
            seen = 0

            def waited() -> bool:
                nonlocal seen
                seen += 1
                return seen > 30

            until(waited)
            assert plc.tasks()[0].cycles == start
            plc.debugger.control("continue")
        plc.debugger.remove(None)
        assert plc.state == "run"
        assert plc.tasks()[0].max_ns < 20 * MS
    finally:
        plc.close()


def test_close_ends_a_halted_task() -> None:
    plc = loaded(TEXT)
    add(plc, 6)
    plc.start()
    halted(plc)
    plc.close()
    assert plc.application is None


FAULTY = """FUNCTION Quotient : DINT
VAR_INPUT
    a : DINT;
    b : DINT;
END_VAR
VAR
    c : DINT;
END_VAR
c := a + 1;
Quotient := c / b;
END_FUNCTION
PROGRAM PLC_PRG
VAR
    i : DINT := 5;
    q : DINT;
END_VAR
i := i - 1;
q := Quotient(i * 10, i);
END_PROGRAM
"""


def test_the_frames_of_an_exception_have_values() -> None:
    plc = loaded(FAULTY)
    try:
        plc.debugger.add(at_line(9, task=None))
        plc.start()
        while plc.state == "run":
            if plc.debugger.halted_tasks():
                plc.debugger.control("continue")
        report = plc.exception()
        assert report is not None
        assert (report.pou, report.line) == ("Quotient", 10)
        stack = plc.debugger.stack("Main")
        assert [(f.place.pou, f.place.line) for f in stack.frames] == [("Quotient", 10), ("PLC_PRG", 18)]
        values = {v.name: v.value for v in plc.debugger.variables("Main", 0).variables}
        assert values == {"a": 0, "b": 0, "Quotient": 0, "c": 1}
        plc.reset("cold")
        plc.start()
        assert line(plc) == 9
        assert [f.place.pou for f in plc.debugger.stack("Main").frames] == ["Quotient", "PLC_PRG"]
    finally:
        plc.close()


TWO = """PROGRAM Fast
VAR
    n : DINT;
END_VAR
n := n + 1;
END_PROGRAM
PROGRAM Slow
VAR
    m : DINT;
END_VAR
m := m + 1;
m := m + 1;
END_PROGRAM
"""
TASKS = (
    Task("FastTask", "cyclic", 2 * MS, 1, programs=("Fast",)),
    Task("SlowTask", "cyclic", 20 * MS, 2, programs=("Slow",)),
)


def test_other_tasks_run_or_halt() -> None:
    plc = loaded(TWO, TASKS)
    try:
        add(plc, 12)
        plc.start()
        assert halted(plc).halted[0].task == "SlowTask"
        before = value(plc, "Fast.n")
        until(lambda: value(plc, "Fast.n") > before + 2)
        plc.debugger.set_settings(Settings(other_tasks="halt"))
        plc.debugger.control("continue")
        until(lambda: len(plc.debugger.halted_tasks()) == 2)
        stands = {halt.task: halt.place.line for halt in plc.debugger.state().halted}
        assert stands == {"SlowTask": 12, "FastTask": 5}
        assert step(plc, "step_into", "FastTask") >= 5
        plc.debugger.control("continue", "FastTask")
        plc.debugger.control("continue", "SlowTask")
        until(lambda: len(plc.debugger.halted_tasks()) == 2)
    finally:
        plc.close()


OUTPUTS = """PROGRAM PLC_PRG
VAR
    q AT %QB0 : BYTE;
    i : DINT;
END_VAR
q := 77;
i := i + 1;
i := i + 1;
END_PROGRAM
"""


@pytest.mark.parametrize(("outputs", "expected"), [("keep", 77), ("safe", 0)])
def test_outputs_while_halted(outputs: str, expected: int) -> None:
    plc = loaded(OUTPUTS)
    try:
        plc.debugger.set_settings(Settings(outputs=outputs))  # type: ignore[arg-type]
        plc.start()
        sent: Callable[[], int] = lambda: plc.loaded().outputs()[0]  # noqa: E731
        until(lambda: sent() == 77)
        add(plc, 8)
        halted(plc)
        assert sent() == expected
        plc.debugger.remove(None)
        plc.debugger.control("continue")
        until(lambda: sent() == 77)
    finally:
        plc.close()


THREE = """PROGRAM Writer
VAR q AT %QB0 : BYTE; END_VAR
q := 77;
END_PROGRAM
PROGRAM First
VAR i : DINT; END_VAR
i := i + 1;
END_PROGRAM
PROGRAM Second
VAR i : DINT; END_VAR
i := i + 1;
END_PROGRAM
"""


def test_outputs_stay_safe_until_the_task_that_made_them_so_goes_on() -> None:
    """Another task, which had halted while outputs were kept, ends nothing."""
    tasks = (
        Task("WriterTask", "cyclic", 2 * MS, 1, programs=("Writer",)),
        Task("FirstTask", "cyclic", 3 * MS, 2, programs=("First",)),
        Task("SecondTask", "cyclic", 4 * MS, 3, programs=("Second",)),
    )
    plc = loaded(THREE, tasks)
    sent: Callable[[], int] = lambda: plc.loaded().outputs()[0]  # noqa: E731
    try:
        plc.start()
        until(lambda: sent() == 77)
        add(plc, 7)
        halted(plc)
        assert sent() == 77
        plc.debugger.set_settings(Settings(outputs="safe"))
        add(plc, 11)
        until(lambda: len(plc.debugger.halted_tasks()) == 2)
        until(lambda: sent() == 0)
        plc.debugger.remove(1)
        plc.debugger.control("continue", "FirstTask")
        for name in ("FirstTask", "WriterTask"):
            at = [task.name for task in plc.tasks()].index(name)
            cycles = plc.tasks()[at].cycles
            until(lambda at=at, cycles=cycles: plc.tasks()[at].cycles > cycles + 3)  # type: ignore[misc]
        assert sent() == 0
        plc.debugger.remove(None)
        plc.debugger.control("continue")
        until(lambda: sent() == 77)
    finally:
        plc.close()
