"""Flow control: executed statements of one cycle with the values after them; listed by hand, and against the
plain model of random programs."""

from collections import Counter
from collections.abc import Iterator

import pytest
from debugger_model import Program
from debugger_programs import URI, add, build_both, halted, loaded, spot, until, value
from plc_programs import MAIN
from test_debugger_steps import seeds

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.debug_build import instrument
from tappet.iec.task import Task
from tappet.lang.source import BodyText, Source
from tappet.runtime.debugger import flow_control
from tappet.runtime.debugger.flow_control import LEASE_S, FlowControl
from tappet.runtime.debugger.shapes import BreakpointOrder
from tappet.runtime.errors import DebugError, PlcError
from tappet.runtime.executive.records import Record
from tappet.runtime.plc import SoftPlc

TEXT = """FUNCTION Half : DINT
VAR_INPUT
    a : DINT;
END_VAR
Half := a / 2;
IF Half > 1000000 THEN
    RETURN;
END_IF
Half := Half + 1;
END_FUNCTION
PROGRAM PLC_PRG
VAR
    i : DINT;
    h : DINT;
    k : INT;
    list : ARRAY [1..3] OF INT;
    warm : BOOL;
    ratio : LREAL;
END_VAR
i := i + 1;
h := Half(a := i) * 10;
FOR k := 1 TO 3 DO
    list[k] := list[k] + k;
END_FOR
IF i < 0 THEN
    h := -1;
END_IF
warm := i > 2;
ratio := h / 4.0;
END_PROGRAM
"""


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    yield plc
    plc.close()


def shown(plc: SoftPlc) -> dict[int, tuple[int, dict[str, str]]]:
    """Executed lines with count and values."""
    found = plc.debugger.flow(URI).statements
    return {s.line: (s.count, {v.name: v.literal for v in s.values}) for s in found}


def test_executed_lines_with_the_values_they_had(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    plc.start()
    until(lambda: plc.debugger.flow(URI).cycle > 0 and 20 in shown(plc) and shown(plc)[20][1] != {})
    until(lambda: int(shown(plc)[20][1]["i"]) > 5)
    lines = shown(plc)
    i = int(lines[20][1]["i"])
    assert sorted(lines) == [5, 6, 9, 20, 21, 22, 23, 25, 28, 29], "26 and 7 are not executed"
    assert lines[5] == (1, {"Half": str(i // 2), "a": str(i)})
    assert lines[9] == (1, {"Half": str(i // 2 + 1)}), "the last statement of a function has values, too"
    h = (i // 2 + 1) * 10
    assert lines[21] == (1, {"h": str(h), "i": str(i)})
    assert lines[23] == (3, {"list[k]": str(3 * i), "k": "3"})
    assert lines[28] == (1, {"warm": "TRUE", "i": str(i)})
    assert lines[29][1]["ratio"] == str(h / 4.0)


def test_the_present_cycle_of_a_halted_task(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    add(plc, 25)
    plc.start()
    halted(plc)
    lines = shown(plc)
    assert sorted(lines) == [5, 6, 9, 20, 21, 22, 23, 25]
    assert lines[20][1] == {"i": str(value(plc, "PLC_PRG.i"))}


def test_a_cycle_that_had_begun_before_is_no_complete_one(plc: SoftPlc) -> None:
    """Flow control set in the midst of a cycle knows nothing of the statements before."""
    add(plc, 25)
    plc.start()
    halted(plc)
    plc.debugger.set_flow([URI])
    variant = plc.debugger.variant
    assert variant is not None
    flow = Record(variant.executive.layouts["FLOW_TABLE"], variant.tasks[0]["pFlow"])
    for complete in (False, True):
        plc.debugger.control("continue")
        cycle = halted(plc).halted[0].cycle
        assert flow["doneCycle"] == (cycle - 1 if complete else 0)


def test_it_ends(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    plc.start()
    until(lambda: plc.debugger.flow(URI).cycle > 0)
    with pytest.raises(PlcError, match="not under flow control"):
        plc.debugger.flow("Other")
    plc.debugger.set_flow([])
    until(lambda: not plc.debugger.state().active)
    with pytest.raises(PlcError, match="not under flow control"):
        plc.debugger.flow(URI)


def test_it_goes_on_after_a_download(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    package, variant = build_both(TEXT.replace("i + 1", "i + 2"))
    plc.load(package)
    plc.debugger.load(variant)
    plc.start()
    until(lambda: plc.debugger.flow(URI).cycle > 0 and 20 in shown(plc))


COUNTS = "PROGRAM PLC_PRG\nVAR\n    i : DINT;\nEND_VAR\ni := i + 1;\nEND_PROGRAM"
SLOW = """PROGRAM Slow
VAR
    n : DINT;
    b : BOOL;
END_VAR
IF n < 100
    AND NOT b THEN
    n := n + 1;
ELSIF b THEN
    n := 0;
END_IF
CASE n OF
    1: b := FALSE;
    2: b := b;
END_CASE
END_PROGRAM
"""
TASKS = [
    Task("Fast", interval_ns=1_000_000, programs=("PLC_PRG",)),
    Task("Slow", interval_ns=2_000_000, priority=2, programs=("Slow",)),
]


@pytest.fixture
def two_tasks() -> Iterator[SoftPlc]:
    plc = SoftPlc(None)
    package, variant = build_both(COUNTS, TASKS, gvls={"Slow": SLOW})
    plc.load(package)
    plc.debugger.load(variant)
    yield plc
    plc.close()


def test_each_task_is_recorded(two_tasks: SoftPlc) -> None:
    plc = two_tasks
    plc.debugger.set_flow([URI, "Slow"])
    plc.start()
    until(lambda: bool(plc.debugger.flow(URI).statements) and bool(plc.debugger.flow("Slow").statements))
    plc.debugger.add(BreakpointOrder(place=spot(8, "Slow")))
    assert [halt.task for halt in halted(plc).halted] == ["Slow"]
    before = plc.debugger.flow(URI).cycle
    until(lambda: plc.debugger.flow(URI).cycle > before)


def test_of_a_statement_with_others_inside_the_head_counts(two_tasks: SoftPlc) -> None:
    two_tasks.debugger.set_flow(["Slow"])
    two_tasks.start()

    def ends() -> dict[int, int]:
        return {s.line: s.end_line for s in two_tasks.debugger.flow("Slow").statements}

    until(lambda: 8 in ends())
    assert {line: ends()[line] for line in (6, 12)} == {6: 7, 12: 12}


def test_what_several_clients_want_is_recorded_until_they_are_gone() -> None:
    now = 0.0
    control = FlowControl(lambda: now)
    control.hold("a", ["x", "y"])
    control.hold("b", ["y", "z"])
    control.hold("", ["w"])
    assert control.objects == {"w", "x", "y", "z"}
    now = LEASE_S - 1
    with pytest.raises(DebugError):  # no code is loaded, but it was heard
        control.snapshot("z", "b")
    assert not control.expired()
    now = LEASE_S + 1
    assert control.expired()
    assert control.objects == {"w", "y", "z"}, "b has read; who has no name need not"
    control.hold("b", [])
    assert control.objects == {"w"}


def test_normal_code_runs_again_when_a_client_is_gone(plc: SoftPlc, monkeypatch: pytest.MonkeyPatch) -> None:
    plc.debugger.set_flow([URI], "browser")
    plc.start()
    until(lambda: plc.debugger.flow(URI, "browser").cycle > 0)
    assert plc.debugger.state().active
    monkeypatch.setattr(flow_control, "LEASE_S", 0.0)
    until(lambda: not plc.debugger.state().active)
    with pytest.raises(PlcError, match="not under flow control"):
        plc.debugger.flow(URI, "browser")


@pytest.mark.parametrize("seed", seeds(40, 5))
def test_random_programs(seed: int) -> None:
    program = Program(seed)
    cycles = [program.cycle() for _ in range(60)]
    plc = loaded(program.text)
    try:
        plc.debugger.set_flow([URI])
        first = plc.loaded().contexts.tasks[0]["cycle"]
        plc.start()
        until(lambda: plc.debugger.flow(URI).cycle > first + 3)
        plc.stop()
        ran = plc.tasks()[0].iec_cycles
        snapshot = plc.debugger.flow(URI)
        found = {s.line: s.count for s in snapshot.statements}
        expected = [Counter(line for line, _ in events) for events in cycles[:ran]]
        assert found in expected[-4:], program.text
    finally:
        plc.close()


INSTRUCTIONS = """PROGRAM PLC_PRG
VAR
    xAlways : BOOL := TRUE;
    nCount : INT;
    nIdle : INT;
END_VAR
        LD      xAlways
        JMPC    onward
        LD      nIdle
        ST      nIdle
onward: LD      nCount
        ADD     1
        ST      nCount
END_PROGRAM
"""


def test_rows_of_instruction_list() -> None:
    """The rows that make a value belong to the one that takes it."""
    session = BuildSession()
    source = Source(URI, INSTRUCTIONS, bodies=(BodyText(0, "IL"),))
    package = build_application([source], list(MAIN), BuildOptions(application="App"), None, session).package
    assert package is not None
    assert session.generated is not None
    plc = SoftPlc(None)
    try:
        plc.load(package)
        plc.debugger.load(instrument(session.generated).to_bytes())
        plc.debugger.set_flow([URI])
        plc.start()
        until(lambda: 11 in shown(plc) and plc.debugger.flow(URI).cycle > 1)
        assert {s.line: s.end_line for s in plc.debugger.flow(URI).statements} == {7: 8, 11: 13}
        assert shown(plc)[7][1] == {"xAlways": "TRUE"}
        (row,) = {add(plc, line).actual.line for line in (11, 12, 13)}
        assert row == 11
    finally:
        plc.close()
