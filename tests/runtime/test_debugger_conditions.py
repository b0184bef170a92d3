"""Conditions, hit counts, instances, tasks, log points, data breakpoints and the next statement."""

from collections.abc import Iterator

import pytest
from debugger_programs import add, at_line, halted, line, loaded, spot, step, until, value
from msgspec import structs

from tappet.runtime.debugger.shapes import BreakpointOrder, Hits
from tappet.runtime.errors import PlcError
from tappet.runtime.plc import SoftPlc

TEXT = """TYPE Tempo : (Off := 0, Slow := 3, Fast := 7); END_TYPE
FUNCTION_BLOCK FB_Sum
VAR_INPUT
    x : DINT;
END_VAR
VAR
    sum : DINT;
    half : LREAL;
    mode : Tempo;
END_VAR
VAR_TEMP
    square : DINT;
END_VAR
square := x * x;
sum := sum + square;
half := sum / 2.0;
mode := Tempo.Slow;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    i : DINT;
    k : INT;
    list : ARRAY [1..4] OF INT := [10, 20, 30, 40];
    one : FB_Sum;
    two : FB_Sum;
    skipped : DINT;
END_VAR
i := i + 1;
one(x := i);
two(x := -i);
FOR k := 1 TO 4 DO
    list[k] := list[k] + 1;
END_FOR
skipped := skipped + 1;
i := i;
END_PROGRAM
"""
"""14: square, 15: sum, 28: i, 29, 30: calls, 31: FOR, 32: its body, 34: skipped, 35: the last one."""


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    yield plc
    plc.close()


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("i = 5", 5),
        ("PLC_PRG.i MOD 7 = 0 AND i > 3", 7),
        ("one.sum > 20", 5),
        ("list[2] >= 24 AND_THEN list[3] > 0", 5),
        ("two.half > 6.9 OR i > 100", 4),
    ],
)
def test_a_condition_is_looked_at_in_the_cycle(plc: SoftPlc, condition: str, expected: int) -> None:
    """one.sum and list are those of the cycle before: 1 + 4 + 9 + 16 = 30 is the first sum above 20."""
    plc.debugger.add(structs.replace(at_line(29), condition=condition))
    plc.start()
    halted(plc)
    assert value(plc, "PLC_PRG.i") == expected


def test_names_in_a_condition_are_those_of_the_body(plc: SoftPlc) -> None:
    found = plc.debugger.add(structs.replace(at_line(15), condition="square = 9 AND x < 0"))
    assert found.verified, found.reason
    plc.start()
    (halt,) = halted(plc).halted
    assert halt.instance == "PLC_PRG.two"
    assert value(plc, "PLC_PRG.i") == 3


@pytest.mark.parametrize(
    ("condition", "why"),
    [("nothing > 3", "nothing"), ("i >", "expected"), ("list", "no single number"), ("", None)],
)
def test_a_wrong_condition_is_not_verified(plc: SoftPlc, condition: str, why: str | None) -> None:
    found = plc.debugger.add(structs.replace(at_line(29), condition=condition))
    assert found.verified is (why is None)
    assert why is None or why in (found.reason or "")


@pytest.mark.parametrize(
    ("hits", "cycles"),
    [
        (Hits(), [1, 2, 3]),
        (Hits("equal", 3), [3]),
        (Hits("from", 4), [4, 5, 6]),
        (Hits("every", 3), [3, 6, 9]),
    ],
)
def test_hit_counts(plc: SoftPlc, hits: Hits, cycles: list[int]) -> None:
    found = plc.debugger.add(at_line(29, hits))
    plc.start()
    for expected in cycles:
        halted(plc)
        assert value(plc, "PLC_PRG.i") == expected
        plc.debugger.control("continue")
    if hits.mode == "equal":
        until(lambda: value(plc, "PLC_PRG.i") > 6)
        assert plc.debugger.halted_tasks() == ()
        assert plc.debugger.state().breakpoints[0].hit_count > 5
    assert plc.debugger.state().breakpoints[0].id == found.id


def test_only_in_one_instance(plc: SoftPlc) -> None:
    plc.debugger.add(at_line(15, instance="PLC_PRG.two"))
    plc.start()
    for _ in range(3):
        assert halted(plc).halted[0].instance == "PLC_PRG.two"
        plc.debugger.control("continue")
    wrong = plc.debugger.add(at_line(15, instance="PLC_PRG.i"))
    assert "no instance" in (wrong.reason or "")
    wrong = plc.debugger.add(at_line(15, task="Nobody"))
    assert "no task 'Nobody'" in (wrong.reason or "")


def test_a_log_point_writes_and_does_not_halt(plc: SoftPlc) -> None:
    text = "x={x} square={square} mode={mode} half={half} {{{PLC_PRG.list[x + 3]}}}"
    found = plc.debugger.add(structs.replace(at_line(17), log=text, instance="PLC_PRG.two"))
    assert found.verified, found.reason

    def said() -> list[str]:
        plc.poll()
        return [e.message for e in plc.log.since(0) if e.component == "debugger"]

    plc.start()
    until(lambda: len(said()) >= 3)
    assert plc.debugger.halted_tasks() == ()
    lines = said()[:3]
    expected, total = [], 0
    for i in (1, 2, 3):
        total += i * i
        element = {1: 20, 2: 10 + 1}.get(i)
        shown = "???" if element is None else str(element)
        mode = "Off" if i == 1 else "Slow"
        expected.append((f"x=-{i} square={i * i}", mode, total / 2, shown))
    for text, (head, mode, half, shown) in zip(lines, expected, strict=True):
        assert text.startswith(head + " ")
        assert mode in text
        assert f"half={half}" in text
        assert text.endswith("{" + shown + "}")


@pytest.mark.parametrize("text", ["{", "a } b", "{nothing}", "{x}" * 9])
def test_a_wrong_log_text_is_not_verified(plc: SoftPlc, text: str) -> None:
    assert not plc.debugger.add(structs.replace(at_line(17), log=text)).verified


def test_a_data_breakpoint_halts_behind_the_statement_that_changes(plc: SoftPlc) -> None:
    found = plc.debugger.add(BreakpointOrder("data", expression="PLC_PRG.list[3]"))
    assert found.verified, found.reason
    plc.start()
    (halt,) = halted(plc).halted
    assert (halt.reason, halt.breakpoint_id) == ("data", found.id)
    assert "PLC_PRG.list[3]" in (halt.message or "")
    assert (halt.place.line, value(plc, "PLC_PRG.k"), value(plc, "PLC_PRG.list[3]")) == (31, 3, 31)
    plc.debugger.control("continue")
    until(lambda: value(plc, "PLC_PRG.list[3]") == 32)
    assert line(plc) == 31


def test_a_data_breakpoint_with_a_condition(plc: SoftPlc) -> None:
    plc.debugger.add(BreakpointOrder("data", expression="PLC_PRG.i", condition="PLC_PRG.i = 6"))
    plc.start()
    assert line(plc) == 29
    assert value(plc, "PLC_PRG.i") == 6


def test_a_disabled_breakpoint_does_not_halt(plc: SoftPlc) -> None:
    found = plc.debugger.add(structs.replace(at_line(29), enabled=False))
    plc.start()
    until(lambda: value(plc, "PLC_PRG.i") > 3)
    assert not plc.debugger.state().active
    plc.debugger.change(found.id, at_line(29))
    assert line(plc) == 29


def test_the_next_statement_is_set(plc: SoftPlc) -> None:
    add(plc, 29)
    plc.start()
    halted(plc)
    state = plc.debugger.control("next_statement", None, spot(34))
    assert state.halted[0].place.line == 34
    assert value(plc, "PLC_PRG.one.x") == 0, "what was passed over did not run"
    plc.debugger.control("next_statement", None, spot(34))
    assert step(plc, "step_over") == 35
    assert value(plc, "PLC_PRG.skipped") == 1
    plc.debugger.control("next_statement", None, spot(34))
    assert step(plc, "step_over") == 35
    assert value(plc, "PLC_PRG.skipped") == 2
    plc.debugger.control("next_statement", None, spot(28))
    assert [step(plc, "step_over") for _ in range(4)] == [29, 30, 31, 32]
    assert value(plc, "PLC_PRG.i") == 2
    plc.debugger.control("next_statement", None, spot(32))
    assert line(plc) == 32, "inside the loop that the task is in"


@pytest.mark.parametrize(
    ("target", "why"), [(32, "inside a loop"), (15, "is not in 'PLC_PRG'"), (9000, "is not in 'PLC_PRG'")]
)
def test_where_the_next_statement_cannot_be(plc: SoftPlc, target: int, why: str) -> None:
    add(plc, 29)
    plc.start()
    halted(plc)
    with pytest.raises(PlcError, match=why):
        plc.debugger.control("next_statement", None, spot(target))
    assert line(plc) == 29


def test_an_endless_loop_in_instrumented_code_can_be_paused() -> None:
    declaration = "PROGRAM PLC_PRG\nVAR\n n : LINT;\n go : BOOL;\nEND_VAR\n"
    text = f"{declaration}n := n + 1;\nWHILE NOT go DO\nEND_WHILE\nn := -1;\nEND_PROGRAM"
    plc = loaded(text)
    try:
        found = add(plc, 6)
        plc.start()
        halted(plc)
        plc.debugger.control("continue")
        until(lambda: value(plc, "PLC_PRG.n") == 1)
        plc.debugger.control("pause")
        assert line(plc) == 7
        assert plc.debugger.state().breakpoints[0].id == found.id
        plc.debugger.control("next_statement", None, spot(9))
        assert step(plc, "step_into") == 6
        assert value(plc, "PLC_PRG.n") == -1
    finally:
        plc.close()
