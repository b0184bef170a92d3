"""__TRY around pointers that lead nowhere: what stands before the access is done, nothing behind."""

from __future__ import annotations

import re

import pytest
from plc_programs import MAIN

from tappet.codegen import partition
from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, build_application
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime

PARTS = {
    "G": "VAR_GLOBAL inStraight, inLoop, inCalled : INT; END_VAR",
    "Straight": """FUNCTION Straight : INT
VAR_INPUT p : POINTER TO DINT; END_VAR
inStraight := 1;
p^ := 5;
inStraight := 2;
END_FUNCTION""",
    "Loop": """FUNCTION Loop : INT
VAR_INPUT p : POINTER TO DINT; END_VAR
VAR i : INT; END_VAR
FOR i := 0 TO 9 DO
    inLoop := inLoop + 1;
    IF i = 5 THEN p := 0; END_IF
    p^ := i;
END_FOR
END_FUNCTION""",
    "Called": """FUNCTION Called : INT
VAR_INPUT block : POINTER TO FB_Steps; END_VAR
inCalled := 1;
block^.Walk(0);
inCalled := 2;
END_FUNCTION""",
    "FB_Steps": """FUNCTION_BLOCK FB_Steps
VAR step, walked : INT; END_VAR
METHOD Go
VAR_INPUT p : POINTER TO DINT; END_VAR
step := 1;
p^ := 4;
step := 2;
END_METHOD
METHOD Walk
VAR_INPUT p : POINTER TO DINT; END_VAR
VAR i : INT; END_VAR
FOR i := 0 TO 9 DO
    walked := walked + 1;
    p^ := i;
    IF i = 5 THEN p := 0; END_IF
END_FOR
END_METHOD
END_FUNCTION_BLOCK""",
}
CATCHING = """PROGRAM PLC_PRG
VAR number : DINT; steps : FB_Steps; part, caught : INT; END_VAR
part := part + 1;
__TRY
    CASE part OF
        1: Straight(0);
        2: Loop(ADR(number));
        3: Called(0);
        4: steps.Go(0);
        5: steps.Walk(ADR(number));
    END_CASE
__CATCH
    caught := caught + 1;
__ENDTRY
END_PROGRAM"""
WITHOUT = re.sub(r"__TRY|__CATCH[^_]*__ENDTRY", "", CATCHING)
DONE = {
    "PLC_PRG.caught": 5,
    "PLC_PRG.number": 5,
    "G.inStraight": 1,
    "G.inLoop": 6,
    "G.inCalled": 1,
    "PLC_PRG.steps.step": 1,
    "PLC_PRG.steps.walked": 7,
}


def built(main: str, session: BuildSession | None = None) -> BuildResult:
    sources = [Source(uri=name, text=text, name=name) for name, text in (PARTS | {"PLC_PRG": main}).items()]
    return build_application(sources, MAIN, BuildOptions(), session=session)


def values_after(result: BuildResult) -> dict[str, object]:
    assert result.package is not None, result.diagnostics
    with LocalRuntime(result.package) as runtime:
        runtime.run(cycles=5)
        return {path: runtime.read(path) for path in DONE}


def test_memory_is_as_the_text_says() -> None:
    assert values_after(built(CATCHING)) == DONE


def test_a_new_try_concerns_code_that_was_built_without_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(partition, "WHOLE", 0)
    monkeypatch.setattr(partition, "PART", 2)
    session = BuildSession()
    before, after = built(WITHOUT, session), built(CATCHING, session)
    assert before.functions == after.functions
    assert values_after(after) == DONE


DEEP = """
FUNCTION_BLOCK FB_Deep
VAR calls : INT; END_VAR
METHOD Count
calls := calls + 1;
END_METHOD
METHOD Down : LINT      // touches no memory: nothing but the stack ends it
VAR_INPUT n : LINT; END_VAR
IF n < 0 THEN Down := 1; ELSE Down := THIS^.Down(n + 1) * 3 + n; END_IF
END_METHOD
END_FUNCTION_BLOCK
FUNCTION Work : INT     // adds what its loop has done when the fault came, found by each part of __TRY
VAR_INPUT kind : INT; zero : INT; pDeep : POINTER TO FB_Deep; pNumber : POINTER TO INT; END_VAR
VAR i, done, straight : INT; list : ARRAY[0..5] OF INT; END_VAR
__TRY
    straight := 1;
    FOR i := 0 TO 9 DO
        done := done + 1;
        G.done := G.done + 1;
        CASE kind OF
            1: IF i = 4 THEN pNumber := 0; END_IF
               pNumber^ := i;
            2: IF i = 4 THEN pDeep^.Down(0); END_IF
            3: list[i + 1] := i;
            4: straight := 10 / (4 - i);
            5: IF i = 4 THEN pDeep := 0; END_IF
               pDeep^.Count();
        END_CASE
        straight := 2;
    END_FOR
__CATCH
    Work := 100 * done;
__FINALLY
    Work := Work + 10 * i;
__ENDTRY
Work := Work + straight;
END_FUNCTION
PROGRAM PLC_PRG
VAR kind, number : INT; deep : FB_Deep; found : ARRAY[1..5] OF INT; END_VAR
kind := kind + 1;
found[kind] := Work(kind, 0, ADR(deep), ADR(number));
END_PROGRAM
"""


def test_variables_of_loops_are_what_they_were_when_the_fault_came() -> None:
    """In __CATCH, in __FINALLY and behind: pointers, the end of the stack, bounds, division, no instance."""
    sources = [Source("m", DEEP), Source("G", "VAR_GLOBAL done : INT; END_VAR", name="G")]
    result = build_application(sources, MAIN, BuildOptions())
    assert result.package is not None, result.diagnostics
    with LocalRuntime(result.package) as runtime:
        runtime.run(cycles=5)
        assert [runtime.read(f"PLC_PRG.found[{kind}]") for kind in range(1, 6)] == [542, 542, 652, 542, 542]
        assert runtime.read("G.done") == 5 + 5 + 6 + 5 + 5
        assert runtime.read("PLC_PRG.number") == 3
