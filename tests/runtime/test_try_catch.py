"""__TRY in a real task: signals are caught, the watchdog is not, and what passes on keeps its place."""

from __future__ import annotations

import pytest
from plc_programs import FAULTY_POUS, build

from tappet.codegen.faults import Fault
from tappet.core.guarded import RECORD_SIZE
from tappet.lang.exceptions import CODES
from tappet.runtime.local import ApplicationException, LocalRuntime

TEXT = (
    FAULTY_POUS
    + """PROGRAM PLC_PRG
VAR
    mode : INT;
    cycles, caught, finals : DINT;
    zero : DINT;
    pValue : POINTER TO DINT;
    deep : FB_Deep;
    exc : __SYSTEM.ExceptionCode;
END_VAR
cycles := cycles + 1;
exc := __SYSTEM.ExceptionCode.RTSEXCPT_NOEXCEPTION;
__TRY
    CASE mode OF
        1: zero := Quotient(cycles, zero);
        2: pValue := 0; pValue^ := 1;
        3: pValue := 16#13579BD0; pValue^ := 1;
        4: zero := LINT_TO_DINT(deep.Down(1));
        5: WHILE zero = 0 DO cycles := cycles + 1; END_WHILE
    END_CASE
__CATCH(exc)
    caught := caught + 1;
__ENDTRY
IF mode = 6 THEN
    __TRY
        zero := Quotient(cycles, zero);
    __FINALLY
        finals := finals + 1;
    __ENDTRY
ELSIF mode = 7 THEN
    zero := Quotient(cycles, zero);     // behind the __TRY
END_IF
END_PROGRAM
"""
)


@pytest.fixture(scope="module")
def runtime():
    with LocalRuntime(build(TEXT), cycle_limit_s=0.5) as local:
        yield local


@pytest.fixture
def running(runtime: LocalRuntime) -> LocalRuntime:
    runtime.reset("cold")
    runtime.start()
    return runtime


@pytest.mark.parametrize(
    ("mode", "code"),
    [
        (1, "DIVIDEBYZERO"),
        (2, "ACCESS_VIOLATION"),
        (3, "ACCESS_VIOLATION"),
        (4, "STACK_OVERFLOW"),
    ],
)
def test_the_application_runs_on_cycle_for_cycle(running: LocalRuntime, mode: int, code: str) -> None:
    running.write("PLC_PRG.mode", mode)
    running.run(cycles=50)
    assert running.state == "run"
    assert running.read("PLC_PRG.cycles") == running.read("PLC_PRG.caught") == 50
    assert running.read("PLC_PRG.exc") == CODES[code]
    running.write("PLC_PRG.mode", 0)
    running.run(cycles=1)
    assert running.read("PLC_PRG.exc") == CODES["NOEXCEPTION"]


def test_an_endless_loop_is_ended_by_the_watchdog_all_the_same(running: LocalRuntime) -> None:
    running.write("PLC_PRG.mode", 5)
    with pytest.raises(ApplicationException) as ended:
        running.run(cycles=5)
    assert ended.value.report.code == Fault.WATCHDOG


@pytest.mark.parametrize("mode", [6, 7])
def test_what_nobody_catches_is_reported_with_its_first_place(running: LocalRuntime, mode: int) -> None:
    running.write("PLC_PRG.mode", mode)
    with pytest.raises(ApplicationException) as ended:
        running.run(cycles=5)
    report = ended.value.report
    line = next(n for n, text in enumerate(TEXT.split("\n"), 1) if "Quotient := a / b" in text)
    assert (report.code, report.pou, report.line) == (Fault.DIV_ZERO, "Quotient", line)
    assert running.read("PLC_PRG.finals") == (1 if mode == 6 else 0)
    assert running.state == "exception"


def test_what_an_initialiser_catches_does_not_end_the_application() -> None:
    text = (
        FAULTY_POUS
        + """FUNCTION_BLOCK FB_Careful
VAR value : DINT; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
__TRY
    value := Quotient(1, value);
__CATCH
    value := -1;
__ENDTRY
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR careful : FB_Careful; END_VAR
END_PROGRAM
"""
    )
    with LocalRuntime(build(text)) as runtime:
        assert runtime.exception is None
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.careful.value") == -1


def test_a_fault_keeps_its_place_while_finally_catches_another() -> None:
    text = (
        FAULTY_POUS
        + """PROGRAM PLC_PRG
VAR zero, n : DINT; END_VAR
__TRY
    n := Quotient(1, zero);
__FINALLY
    __TRY
        n := 2 / zero;
    __CATCH
        n := 3;
    __ENDTRY
__ENDTRY
END_PROGRAM
"""
    )
    with LocalRuntime(build(text)) as runtime:
        with pytest.raises(ApplicationException) as ended:
            runtime.run(cycles=1)
        assert (ended.value.report.code, ended.value.report.pou) == (Fault.DIV_ZERO, "Quotient")
        assert runtime.read("PLC_PRG.n") == 3


def test_what_is_kept_of_a_fault_has_room(running: LocalRuntime) -> None:
    application = running.plc.application
    assert application is not None
    assert application.executive.layouts["FAULT_RECORD"].size <= RECORD_SIZE
