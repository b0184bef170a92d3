"""Conditions of ELSIF and UNTIL and the heads of loops: places of their own for flow control, breakpoints and
commands."""

import pytest
from debugger_programs import URI, add, halted, loaded, spot, until, value

from tappet.runtime.errors import DebugError

CHOICE = """PROGRAM PLC_PRG
VAR
    i : DINT;
    rest : DINT;
    n : DINT;
    xOdd : BOOL;
END_VAR
i := i + 1;
rest := i MOD 4;
IF rest = 0 THEN
    n := 10;
ELSIF rest = 1
    OR xOdd THEN
    n := 20;
ELSIF n > 15 THEN
    n := 15;
ELSE
    xOdd := FALSE;
END_IF
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("rest", "lines"),
    [
        (0, {8: 8, 9: 9, 10: 10, 11: 11}),
        (1, {8: 8, 9: 9, 10: 10, 12: 13, 14: 14}),
        (2, {8: 8, 9: 9, 10: 10, 12: 13, 15: 15, 16: 16}),
        (3, {8: 8, 9: 9, 10: 10, 12: 13, 15: 15, 18: 18}),
    ],
)
def test_the_conditions_that_are_looked_at(rest: int, lines: dict[int, int]) -> None:
    """Of a chain of ELSIF those up to the one that holds, with the values that decided."""
    text = CHOICE.replace("i : DINT;", f"i : DINT := {rest};", 1).replace("i + 1", "i + 4")
    plc = loaded(
        text.replace("n : DINT;", f"n : DINT := {30 if rest == 2 else 0};").replace("n := 15", "n := n")
    )
    try:
        plc.debugger.set_flow([URI])
        plc.start()
        until(lambda: plc.debugger.flow(URI).cycle > 3)
        plc.stop()
        statements = plc.debugger.flow(URI).statements
        assert {s.line: s.end_line for s in statements} == lines
        values = {s.line: {v.name: v.literal for v in s.values} for s in statements}
        assert values[10] == {"rest": str(rest)}
        if rest:
            assert values[12] == {"rest": str(rest), "xOdd": "FALSE"}
        if rest > 1:
            assert values[15] == {"n": "30" if rest == 2 else "0"}
    finally:
        plc.close()


def test_a_breakpoint_at_an_elsif() -> None:
    """It halts where the condition is looked at, and not where the one before holds."""
    plc = loaded(CHOICE)
    try:
        assert add(plc, 13).actual.line == 12, "the second line of a condition belongs to it"
        plc.start()
        halted(plc)
        assert value(plc, "PLC_PRG.rest") == 1
        for rest in (2, 3, 1, 2):  # 0 takes the first branch
            plc.debugger.control("continue")
            halted(plc)
            assert value(plc, "PLC_PRG.rest") == rest
    finally:
        plc.close()


LOOPS = """PROGRAM PLC_PRG
VAR
    i : DINT;
    k : DINT;
    n : DINT;
    xMore : BOOL;
END_VAR
n := 3;
REPEAT
    n := n - 1;
    IF n = 1 THEN
        CONTINUE;
    END_IF
    i := i + 1;
UNTIL n <= 0
    AND NOT xMore
END_REPEAT
WHILE n < 2
    OR xMore DO
    n := n + 1;
END_WHILE
FOR k := n TO 8
    BY 2 DO
    IF k = 6 THEN
        EXIT;
    END_IF
END_FOR
FOR k := 5 TO 4 DO
    n := 0;
END_FOR
END_PROGRAM
"""


def test_heads_of_loops() -> None:
    """Each look whether there is another pass is one, with the values that the last one decided by."""
    plc = loaded(LOOPS)
    try:
        plc.debugger.set_flow([URI])
        plc.start()
        until(lambda: plc.debugger.flow(URI).cycle > 3)
        plc.stop()
        statements = {s.line: s for s in plc.debugger.flow(URI).statements}
        counts = {line: (s.end_line, s.count) for line, s in statements.items()}
        assert counts == {
            8: (8, 1), 9: (9, 1), 10: (10, 3), 11: (11, 3), 12: (12, 1), 14: (14, 2), 15: (16, 3),
            18: (19, 3), 20: (20, 2), 22: (23, 3), 24: (24, 3), 25: (25, 1), 28: (28, 1),
        }  # fmt: skip
        values = {line: {v.name: v.literal for v in s.values} for line, s in statements.items()}
        assert values[9] == {}
        assert values[15] == {"n": "0", "xMore": "FALSE"}
        assert values[18] == {"n": "2", "xMore": "FALSE"}
        assert values[22] == {"k": "6", "n": "2"}
        assert values[28] == {"k": "5"}
    finally:
        plc.close()


@pytest.mark.parametrize(
    ("wanted", "line", "names"),
    [
        (15, 15, {"n": [2, 1, 0, 2]}),
        (16, 15, {"n": [2, 1, 0, 2]}),
        (18, 18, {"n": [0, 1, 2, 0]}),
        (19, 18, {"n": [0, 1, 2, 0]}),
        (23, 22, {"n": [2, 2, 2, 2], "k": [5, 2, 4, 5]}),
    ],
)
def test_a_breakpoint_at_the_head_of_a_loop(wanted: int, line: int, names: dict[str, list[int]]) -> None:
    """It halts at each look whether there is another pass, as a step does; at FOR before it counts."""
    plc = loaded(LOOPS.replace("k : DINT;", "k : DINT := 5;"))
    try:
        assert add(plc, wanted).actual.line == line
        plc.start()
        for turn in range(4):
            assert halted(plc).halted[0].place.line == line
            assert {name: value(plc, f"PLC_PRG.{name}") for name in names} == {
                name: values[turn] for name, values in names.items()
            }
            plc.debugger.control("continue")
    finally:
        plc.close()


def test_until_is_set_as_the_next_statement() -> None:
    """Inside its loop; from outside it is refused, as other statements of the loop are."""
    plc = loaded(LOOPS)
    try:
        add(plc, 10)
        add(plc, 18)
        plc.start()
        halted(plc)
        plc.debugger.control("next_statement", None, spot(15))
        assert halted(plc).halted[0].place.line == 15
        assert value(plc, "PLC_PRG.n") == 3
        plc.debugger.remove(None)
        add(plc, 18)
        plc.debugger.control("continue")
        halted(plc)
        with pytest.raises(DebugError, match="inside a loop"):
            plc.debugger.control("next_statement", None, spot(15))
    finally:
        plc.close()
