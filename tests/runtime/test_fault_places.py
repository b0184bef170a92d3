"""An exception names POU and line whatever the code is like that raised it."""

from __future__ import annotations

import pytest
from plc_programs import build

from tappet.codegen.faults import Fault
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.local import ApplicationException, LocalRuntime

INTERFACE = """INTERFACE I_Lamp
METHOD Blink : INT
VAR_INPUT a : INT; END_VAR
END_METHOD
PROPERTY Hue : INT
GET
END_GET
END_PROPERTY
END_INTERFACE
"""
LAMP = """FUNCTION_BLOCK Lamp{number} IMPLEMENTS I_Lamp
VAR x : INT; END_VAR
METHOD Blink : INT
VAR_INPUT a : INT; END_VAR
Blink := a + {number}; x := x + {number};
END_METHOD
PROPERTY Hue : INT
GET
Hue := {number} + x;
END_GET
END_PROPERTY
END_FUNCTION_BLOCK
"""
VIA = """FUNCTION Via : INT
VAR_INPUT lamp : I_Lamp; END_VAR
Via := lamp.Blink(4);    // via
END_FUNCTION
"""
MAIN = """PROGRAM PLC_PRG
VAR v : INT; lamp : I_Lamp; lamps : ARRAY[0..3] OF I_Lamp; pLamp : POINTER TO I_Lamp; {instances} END_VAR
pLamp := ADR(lamp);
{call}    // here
v := v + 1;
END_PROGRAM
"""
CALLS = {
    "v := lamp.Blink(v);": "PLC_PRG",
    "lamp.Blink(1);": "PLC_PRG",
    "v := lamp.Hue;": "PLC_PRG",
    "v := lamps[v].Blink(3);": "PLC_PRG",
    "v := pLamp^.Blink(3);": "PLC_PRG",
    "v := Via(lamp);": "Via",
}


def line_of(text: str, mark: str) -> int:
    return next(number for number, line in enumerate(text.split("\n"), 1) if mark in line)


def report_of(text: str) -> ExceptionReport:
    with LocalRuntime(build(text)) as runtime:
        with pytest.raises(ApplicationException) as caught:
            runtime.run(cycles=2)
        return caught.value.report


@pytest.mark.parametrize("blocks", [0, 1, 2, 12])
@pytest.mark.parametrize("call", CALLS)
def test_a_call_through_an_unset_interface(call: str, blocks: int) -> None:
    """Whether no block implements it, or one, or so many that the calls go through a table."""
    lamps = "".join(LAMP.format(number=n) for n in range(blocks))
    instances = "".join(f"lamp{n} : Lamp{n};" for n in range(blocks))
    text = INTERFACE + lamps + VIA + MAIN.format(instances=instances, call=call)
    report = report_of(text)
    where = CALLS[call]
    assert (report.code, report.pou) == (Fault.NULL_REFERENCE, where)
    assert report.line == line_of(text, "// via" if where == "Via" else "// here")
    assert [frame.pou for frame in report.call_stack] == [where, "PLC_PRG"][: 1 + (where == "Via")]


POINTERS = """PROGRAM PLC_PRG
VAR v, n : DINT; s : INT; b : BOOL; x : LREAL;
    p : POINTER TO DINT; pShort : POINTER TO INT; pReal : POINTER TO LREAL; END_VAR
p := {address}; pShort := p; pReal := p;
n := n + 1;
{statement}    // here
n := n + 2;
END_PROGRAM
"""
STATEMENTS = (
    "v := p^;", "p^ := v;", "v := v + p^;", "v := v * p^;", "v := p^ - v;", "v := v AND p^;", "v := v / p^;",
    "v := p[v + 3] + v;", "b := p^ > v;", "b := v = p^ OR b;", "x := x + pReal^;", "x := x * pReal^;",
    "b := x < pReal^;", "x := p^;", "v := pShort^;", "s := s + pShort^;", "x := DINT_TO_LREAL(p^) + x;",
    "v := REAL_TO_DINT(LREAL_TO_REAL(pReal^));", "v := -p^;", "v := SHL(p^, 2) + v;", "v := MAX(p^, v);",
    "IF p^ > 4 THEN v := 3; END_IF", "CASE p^ OF 1: v := 2; 2: v := 5; END_CASE",
)  # fmt: skip
WIDE = (
    "16#8000_0000_0000_0000",
    "16#0001_0000_0000_0000",
    "16#7FFF_FFFF_FFFF_F000",
    "16#FF00_0000_0000_0000",
)


@pytest.mark.parametrize("statement", STATEMENTS)
def test_the_line_of_every_kind_of_access(statement: str) -> None:
    text = POINTERS.format(address="16#10", statement=statement)
    report = report_of(text)
    assert (report.code, report.pou, report.line) == (
        Fault.NULL_REFERENCE, "PLC_PRG", line_of(text, "// here"),
    )  # fmt: skip


@pytest.mark.parametrize("statement", ["v := p^;", "p^ := v;", "v := v + p^;", "x := x + pReal^;"])
@pytest.mark.parametrize("address", WIDE)
def test_an_address_of_more_than_47_bits_is_no_null_pointer(address: str, statement: str) -> None:
    text = POINTERS.format(address=address, statement=statement)
    report = report_of(text)
    assert (report.code, report.pou, report.line) == (
        Fault.ACCESS_VIOLATION, "PLC_PRG", line_of(text, "// here"),
    )  # fmt: skip
    assert "more than 47 bits" in report.message
    assert "address" not in report.values


LEAVING = """FUNCTION_BLOCK Part
VAR_INPUT zero : DINT; fail, again : BOOL; {more} END_VAR
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
IF fail THEN zero := 5 / zero; END_IF    // exit
END_METHOD
METHOD FB_Reinit : BOOL
IF again THEN zero := 6 / zero; END_IF    // reinit
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Sound
VAR_INPUT n : DINT; {more} END_VAR
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
n := n + 1;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM First
VAR part : Part; END_VAR
part();
END_PROGRAM
PROGRAM PLC_PRG
VAR sound : Sound; END_VAR
sound();
First();
END_PROGRAM
"""


@pytest.mark.parametrize(("cause", "method"), [("fail", "FB_Exit"), ("again", "FB_Reinit")])
def test_methods_of_an_online_change(cause: str, method: str) -> None:
    """FB_Exit is code of before, which is gone when somebody asks; later calls end well."""
    before, after = LEAVING.format(more=""), LEAVING.format(more="x : LREAL;")
    first = build(before)
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=1)
        runtime.write(f"First.part.{cause}", True)
        runtime.plc.download(build(after, previous=first).to_bytes(), "online_change")
        assert runtime.state == "exception"
        report = runtime.exception
        assert report is not None
        assert (report.code, report.pou, report.task) == (Fault.DIV_ZERO, f"Part.{method}", "online change")
        assert report.line == line_of(before, "// exit" if cause == "fail" else "// reinit")
        said = [e.message for e in runtime.plc.log.since() if e.severity == "exception"]
        assert len(said) == 1
        assert f"Part.{method}, line {report.line}" in said[0]


def test_fb_exit_at_a_download() -> None:
    text = LEAVING.format(more="")
    with LocalRuntime(build(text)) as runtime:
        runtime.run(cycles=1)
        runtime.write("First.part.fail", True)
        runtime.plc.download(build(text).to_bytes())
        assert runtime.state == "stop"
        line = line_of(text, "// exit")
        wanted = f"task FB_Exit: division by zero in Part.FB_Exit, line {line}"
        assert any(wanted in e.message for e in runtime.plc.log.since())
