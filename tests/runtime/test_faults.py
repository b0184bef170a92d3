"""Every kind of fault ends in the state exception with POU, line and call stack; the process lives on."""

import itertools
import os

import pytest
from plc_programs import FAULTY_POUS, MAIN, MS, TASK_FUNCTIONS, build

from tappet.codegen.faults import Fault
from tappet.iec.task import Task
from tappet.runtime.local import ApplicationException, LocalRuntime

TEXT = (
    FAULTY_POUS
    + """INTERFACE I_Lamp
METHOD Blink : BOOL
END_METHOD
END_INTERFACE

FUNCTION_BLOCK FB_Lamp IMPLEMENTS I_Lamp
METHOD Blink : BOOL
Blink := TRUE;
END_METHOD
END_FUNCTION_BLOCK

PROGRAM PLC_PRG
VAR
    mode : INT;
    count : DINT;
    zero : DINT;
    values : ARRAY [1..4] OF DINT;
    index : DINT := 9;
    pValue : POINTER TO DINT;
    deep : FB_Deep;
    out AT %QB0 : BYTE;
    lamp : FB_Lamp;
    none : I_Lamp;
END_VAR
count := count + 1;
out := 16#55;
CASE mode OF
    1: count := Quotient(count, zero);
    2: values[index] := 1;
    3: pValue^ := 1;
    4: pValue := 16#13579BD0; pValue^ := 1;
    5: zero := LINT_TO_DINT(deep.Down(1));
    6: WHILE zero = 0 DO count := count + 1; END_WHILE
    7: none.Blink();
END_CASE
END_PROGRAM
"""
)


def line_of(part: str) -> int:
    """1-based line of the text that holds `part`."""
    return next(n for n, line in enumerate(TEXT.split("\n"), 1) if part in line)


CASES = {
    1: (Fault.DIV_ZERO, "Quotient", line_of("Quotient := a / b")),
    2: (Fault.ARRAY_BOUNDS, "PLC_PRG", line_of("2: values")),
    3: (Fault.NULL_REFERENCE, "PLC_PRG", line_of("3: pValue")),
    4: (Fault.ACCESS_VIOLATION, "PLC_PRG", line_of("4: pValue")),
    6: (Fault.WATCHDOG, "PLC_PRG", line_of("6: WHILE")),
    7: (Fault.NULL_REFERENCE, "PLC_PRG", line_of("7: none")),
}


@pytest.fixture(scope="module")
def runtime():
    with LocalRuntime(build(TEXT), cycle_limit_s=2.0) as local:
        yield local


def fail(runtime: LocalRuntime, mode: int) -> ApplicationException:
    if runtime.state != "run":
        runtime.reset("cold")
        runtime.start()
    runtime.run(cycles=3)
    runtime.write("PLC_PRG.mode", mode)
    with pytest.raises(ApplicationException) as caught:
        runtime.run(cycles=5)
    return caught.value


@pytest.mark.parametrize("mode", CASES)
def test_fault_names_code_pou_and_line(runtime: LocalRuntime, mode: int) -> None:
    code, pou, line = CASES[mode]
    report = fail(runtime, mode).report
    assert (report.code, report.name, report.task) == (code, code.name, "Main")
    assert (report.pou, report.uri, report.line) == (pou, "PLC_PRG", line)
    assert runtime.state == "exception"


def test_the_log_has_the_place_of_an_exception(runtime: LocalRuntime) -> None:
    fail(runtime, 1)
    entry = next(e for e in reversed(runtime.plc.log.since()) if e.severity == "exception")
    line = line_of("Quotient := a / b")
    assert entry.message == f"task Main: division by zero in Quotient, line {line}"


def test_call_stack_leads_to_the_program(runtime: LocalRuntime) -> None:
    report = fail(runtime, 1).report
    assert [(f.pou, f.line) for f in report.call_stack] == [
        ("Quotient", line_of("Quotient := a / b")),
        ("PLC_PRG", line_of("1: count")),
    ]


def test_numbers_and_variables_are_reported(runtime: LocalRuntime) -> None:
    error = fail(runtime, 2)
    assert error.report.values["index"] == "9"
    assert error.report.values["PLC_PRG.index"] == "9"
    assert "array index 9 outside 1..4" in str(error)
    assert fail(runtime, 4).report.values["address"] == "16#13579BD0"


def test_endless_recursion_is_a_stack_overflow(runtime: LocalRuntime) -> None:
    report = fail(runtime, 5).report
    assert report.code == Fault.STACK_OVERFLOW
    assert {f.pou for f in itertools.islice(report.call_stack, 10)} == {"FB_Deep.Down"}


def test_reset_and_start_recover(runtime: LocalRuntime) -> None:
    fail(runtime, 3)
    runtime.reset("warm")
    assert runtime.exception is None
    assert runtime.state == "stop"
    runtime.start()
    runtime.run(cycles=4)
    assert runtime.read("PLC_PRG.count") == 4


def test_start_in_exception_says_what_to_do(runtime: LocalRuntime) -> None:
    fail(runtime, 3)
    with pytest.raises(RuntimeError, match="reset it"):
        runtime.start()


def test_outputs_go_to_safe_values(runtime: LocalRuntime) -> None:
    runtime.reset("cold")
    runtime.start()
    runtime.run(cycles=2)
    application = runtime.plc.application
    assert application is not None
    assert application.outputs()[0] == 0x55
    fail(runtime, 3)
    assert application.outputs()[0] == 0
    assert runtime.read("PLC_PRG.out") == 0x55  # the image keeps it for diagnosis


def test_fault_of_another_thread_ends_the_process_as_before() -> None:
    """The handlers chain: a crash outside of tasks is not swallowed."""
    child = os.fork()
    if child == 0:
        import ctypes

        ctypes.string_at(8)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert os.WIFSIGNALED(status)
    assert os.WTERMSIG(status) == 11


def test_fault_in_an_initialiser_is_reported() -> None:
    text = """
    FUNCTION Broken : DINT
    VAR_INPUT d : DINT; END_VAR
    Broken := 10 / d;
    END_FUNCTION
    PROGRAM PLC_PRG
    VAR zero : DINT; x : DINT := Broken(zero); END_VAR
    END_PROGRAM
    """
    with LocalRuntime(build(text)) as runtime:
        report = runtime.exception
        assert report is not None
        assert (report.code, report.task, report.pou) == (Fault.DIV_ZERO, "initialisation", "Broken")


def test_endless_initialiser_is_reported() -> None:
    text = """
    FUNCTION Endless : DINT
    WHILE TRUE DO Endless := Endless + 1; END_WHILE
    END_FUNCTION
    PROGRAM PLC_PRG
    VAR x : DINT := Endless(); END_VAR
    END_PROGRAM
    """
    with LocalRuntime(build(text), cycle_limit_s=0.1) as runtime:
        report = runtime.exception
        assert report is not None
        assert (report.name, report.pou) == ("WATCHDOG", "Endless")


def test_other_tasks_stop_at_their_cycle_boundary() -> None:
    text = """
    PROGRAM PLC_PRG
    VAR n : DINT; zero : DINT; END_VAR
    n := n + 1;
    IF n = 5 THEN zero := n / zero; END_IF
    END_PROGRAM
    PROGRAM Other
    VAR n : DINT; END_VAR
    n := n + 1;
    END_PROGRAM
    """
    tasks = (
        Task("Main", interval_ns=10 * MS, priority=1, programs=("PLC_PRG",)),
        Task("Second", interval_ns=10 * MS, priority=2, programs=("Other",)),
    )
    with LocalRuntime(build(text, tasks), virtual=False) as runtime:
        with pytest.raises(ApplicationException):
            runtime.run(time_ns=60_000 * MS)
        before = runtime.read("Other.n")
        statistics = {t.name: t for t in runtime.statistics()}
        assert statistics["Main"].status == "exception"
        assert statistics["Second"].status == "valid"
        runtime.plc.stop()
        assert runtime.state == "exception"
        assert runtime.read("Other.n") == before


def test_endless_loop_in_real_time() -> None:
    with LocalRuntime(build(TEXT), virtual=False, cycle_limit_s=0.2) as runtime:
        runtime.run(cycles=2)
        runtime.write("PLC_PRG.mode", 6)
        with pytest.raises(ApplicationException) as caught:
            runtime.run(time_ns=60_000 * MS)
        assert caught.value.report.code == Fault.WATCHDOG
        assert caught.value.report.line == CASES[6][2]


def test_raise_by_number_of_any_code() -> None:
    text = """
    {attribute 'tappet_external' := 'tappet_fault'}
    FUNCTION Raise
    VAR_INPUT code : DINT; a : LINT; b : LINT; c : LINT; END_VAR
    END_FUNCTION
    PROGRAM PLC_PRG
    VAR code : DINT; END_VAR
    IF code > 0 THEN Raise(code, 77, 2, 3); END_IF
    END_PROGRAM
    """
    with LocalRuntime(build(text, MAIN)) as runtime:
        for code in (Fault.ASSERT, Fault.ILLEGAL_CONVERSION, Fault.USER):
            runtime.write("PLC_PRG.code", int(code))
            with pytest.raises(ApplicationException) as caught:
                runtime.run(cycles=1)
            assert caught.value.report.name == code.name
            runtime.reset("cold")
            runtime.start()


def test_task_functions_are_offered() -> None:
    text = (
        TASK_FUNCTIONS
        + "PROGRAM PLC_PRG VAR handle : LWORD; wrong : DINT; END_VAR\n"
        + "handle := TaskCurrent(); wrong := DisableWatchdog(12345); END_PROGRAM"
    )
    with LocalRuntime(build(text)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.handle") != 0
        assert runtime.read("PLC_PRG.wrong") == 16
