"""An exception in IL names the row of the instruction that failed."""

from __future__ import annotations

import pytest
from plc_programs import build

from tappet.codegen.faults import Fault
from tappet.runtime.local import ApplicationException, LocalRuntime

TEXT = """PROGRAM PLC_PRG
VAR
    mode : INT;
    a, zero, index, result : DINT;
    values : ARRAY[1..4] OF DINT;
END_VAR
LD   mode
EQ   1
JMPC divide
LD   mode
EQ   2
JMPC subscript
LD   mode
EQ   3
JMPC deferred
RET
divide:
LD   a
ADD  5
DIV  zero
ST   result
RET
subscript:
LD   a
ADD  5
ADD  values[index]
ST   result
RET
deferred:
LD   a
DIV( a
ADD  zero
)
ST   result
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("mode", "code", "row"),
    [(1, Fault.DIV_ZERO, "DIV  zero"), (2, Fault.ARRAY_BOUNDS, "ADD  values"), (3, Fault.DIV_ZERO, "DIV( a")],
)
def test_exception_names_the_row(mode: int, code: Fault, row: str) -> None:
    with LocalRuntime(build(TEXT), cycle_limit_s=0.2) as runtime:
        runtime.run(cycles=2)
        runtime.write("PLC_PRG.mode", mode)
        with pytest.raises(ApplicationException) as caught:
            runtime.run(cycles=3)
    report = caught.value.report
    rows = [number for number, line in enumerate(TEXT.split("\n"), 1) if row in line]
    assert (report.code, [report.line]) == (code, rows)
