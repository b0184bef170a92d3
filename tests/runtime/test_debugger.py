"""Breakpoints, steps and call stacks; the lines expected are listed by hand."""

from collections.abc import Iterator

import pytest
from debugger_programs import add, halted, line, loaded, spot, step, until, value

from tappet.runtime.plc import SoftPlc

TEXT = """FUNCTION Twice : DINT
VAR_INPUT
    a : DINT;
END_VAR
VAR
    k : DINT;
END_VAR
FOR k := 1 TO 2 DO
    Twice := Twice + a;
END_FOR
END_FUNCTION
FUNCTION_BLOCK FB_Count
VAR_INPUT
    x : DINT;
END_VAR
VAR
    n : DINT;
END_VAR
IF x > 0 THEN
    n := n + Twice(x);
END_IF
n := n + 1;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    i : DINT;
    first : FB_Count;
    second : FB_Count;
END_VAR
i := i + 1;
first(x := i);
second(x := -i);
END_PROGRAM
"""
"""Statements stand in the lines 8, 9 (Twice), 19, 20, 22 (FB_Count), 30, 31, 32 (PLC_PRG)."""


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    yield plc
    plc.close()


def test_a_breakpoint_halts_before_its_statement(plc: SoftPlc) -> None:
    add(plc, 31)
    plc.start()
    state = halted(plc)
    assert state.active
    (halt,) = state.halted
    assert (halt.task, halt.reason, halt.place.pou, halt.place.line) == ("Main", "breakpoint", "PLC_PRG", 31)
    assert [task.status for task in plc.tasks()] == ["halted"]
    first = value(plc, "PLC_PRG.i")
    assert value(plc, "PLC_PRG.first.x") == first - 1
    plc.debugger.control("continue")
    assert line(plc) == 31
    assert value(plc, "PLC_PRG.i") == first + 1
    assert value(plc, "PLC_PRG.first.x") == first


@pytest.mark.parametrize(
    ("command", "start", "lines"),
    [
        ("step_into", 30, [31, 19, 20, 8, 9, 8, 9, 8, 22, 32, 19, 22, 30, 31]),
        ("step_over", 30, [31, 32, 30, 31]),
        ("step_over", 19, [20, 22, 32, 30, 31, 32, 30]),
        ("step_over", 9, [8, 9, 8, 22, 32, 30]),
        ("step_out", 9, [22, 32, 30, 30]),
        ("step_out", 19, [32, 30, 30]),
    ],
)
def test_steps(plc: SoftPlc, command: str, start: int, lines: list[int]) -> None:
    add(plc, start)
    plc.start()
    assert line(plc) == start
    plc.debugger.remove(None)
    assert [step(plc, command) for _ in lines] == lines


def test_the_call_stack_names_places_and_instances(plc: SoftPlc) -> None:
    add(plc, 9)
    plc.start()
    halted(plc)
    stack = plc.debugger.stack("Main")
    assert [(f.place.pou, f.place.line, f.instance) for f in stack.frames] == [
        ("Twice", 9, None),
        ("FB_Count", 20, "PLC_PRG.first"),
        ("PLC_PRG", 31, None),
    ]


def test_variables_of_every_frame(plc: SoftPlc) -> None:
    add(plc, 9)
    plc.start()
    halted(plc)
    plc.debugger.control("continue")
    halted(plc)
    i = value(plc, "PLC_PRG.i")

    def shown(frame: int) -> dict[str, object]:
        return {v.name: v.value for v in plc.debugger.variables("Main", frame).variables}

    assert shown(0) == {"a": i, "Twice": i, "k": 2}
    assert shown(1) == {"x": i, "n": 0}
    assert shown(2)["i"] == i
    paths = [v.path for v in plc.debugger.variables("Main", 1).variables]
    assert paths == ["PLC_PRG.first.x", "PLC_PRG.first.n"]


def test_a_local_is_written_while_halted(plc: SoftPlc) -> None:
    add(plc, 9)
    plc.start()
    halted(plc)
    written = plc.debugger.write("Main", 0, "a", "DINT#1000")
    assert (written.value, written.literal) == (1000, "1000")
    plc.debugger.write("Main", 0, "k", 2)
    plc.debugger.remove(None)
    assert step(plc, "step_out") == 22
    assert value(plc, "PLC_PRG.first.n") == 1000
    with pytest.raises(ValueError, match="no local variable 'zz'"):
        plc.debugger.write("Main", 0, "zz", 1)


def test_without_breakpoints_the_normal_code_runs(plc: SoftPlc) -> None:
    found = add(plc, 30)
    plc.start()
    halted(plc)
    plc.debugger.remove(found.id)
    assert plc.debugger.state().active
    plc.debugger.control("continue")
    until(lambda: not plc.debugger.state().active)
    before = value(plc, "PLC_PRG.i")
    until(lambda: value(plc, "PLC_PRG.i") > before)


def test_pause_and_run_to(plc: SoftPlc) -> None:
    plc.start()
    until(lambda: value(plc, "PLC_PRG.i") > 1)
    plc.debugger.control("pause")
    assert line(plc) == 30
    assert halted(plc).halted[0].reason == "pause"
    state = plc.debugger.control("run_to", None, spot(22))
    assert state.halted[0].reason == "run_to"
    assert line(plc) == 22
    assert plc.debugger.state().breakpoints == []
    plc.debugger.control("continue")
    before = value(plc, "PLC_PRG.i")
    until(lambda: value(plc, "PLC_PRG.i") > before + 1)


IL = """PROGRAM PLC_PRG
VAR
    i : DINT;
    j : DINT;
END_VAR
LD i
ADD 1
ST i
LD i
MUL 2
ST j
GT 6
JMPC over
LD 7
ST j
over:
LD j
ST j
END_PROGRAM
"""


def test_steps_in_il() -> None:
    """From LD to LD and JMP; what lies between belongs to them."""
    plc = loaded(IL)
    try:
        add(plc, 6)
        plc.start()
        assert line(plc) == 6
        plc.debugger.remove(None)
        seen = [step(plc, "step_over") for _ in range(12)]
        first = seen[: seen.index(6)]
        assert first == sorted(first)
        assert {9, 13, 14, 17} <= set(first), "not more than 6 yet, so the jump is not taken"
        assert value(plc, "PLC_PRG.i") >= 2
    finally:
        plc.close()


def test_a_halted_task_on_virtual_time() -> None:
    """Virtual time stands still while the task is halted; what is advanced goes on behind it."""
    from threading import Thread

    plc = SoftPlc(None, virtual=True)
    loaded(TEXT, plc=plc)
    try:
        add(plc, 31)
        plc.start()
        tasks = plc.loaded().tasks
        ten_cycles = Thread(target=lambda: tasks.run_virtual(100_000_000))
        ten_cycles.start()
        for cycle in range(1, 11):
            halted(plc)
            assert value(plc, "PLC_PRG.i") == cycle
            assert plc.loaded().contexts.application["virtualNow"] == (cycle - 1) * 10_000_000
            plc.debugger.control("continue")
        ten_cycles.join()
        assert plc.debugger.halted_tasks() == ()
        assert value(plc, "PLC_PRG.i") == 10
    finally:
        plc.close()
