"""MC_ReadDigitalInput, MC_ReadDigitalOutput, MC_WriteDigitalOutput and MC_ReadAxisInfo (PLCopen part 1)."""

from __future__ import annotations

import pytest
from tests.libraries.mapped_axis import axis, cycles, switch_on
from tests.libraries.st_program import Program, run

PROGRAM = """
PROGRAM Main
VAR
    dwInputs : DWORD := 16#8000_0004;
    aOutputs : SM3_Basic.MC_OUTPUT_REF;
    Input    : SM3_Basic.MC_ReadDigitalInput;
    Output   : SM3_Basic.MC_ReadDigitalOutput;
    Write    : SM3_Basic.MC_WriteDigitalOutput;
    Info     : SM3_Basic.MC_ReadAxisInfo;
    Homing   : SM3_Basic.MC_Home;
    Power    : SM3_Basic.MC_Power;
    Axis     : SM3_Basic.AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.01);
END_VAR
Axis.BeginCycle();
Input(Input := dwInputs);
Write(Output := aOutputs);
Output(Output := aOutputs);
Power(Axis := Axis, Enable := TRUE, bDriveStart := TRUE);
Homing(Axis := Axis);
Info(Axis := Axis);
Axis.EndCycle();
END_PROGRAM
"""


def text(program: Program, path: str) -> str:
    return program.literal(f"Main.{path}")


@pytest.mark.parametrize(("number", "value"), [(0, False), (2, True), (3, False), (31, True)])
def test_an_input_is_read_by_its_bit(number: int, value: bool) -> None:
    with run(PROGRAM, 1) as program:
        program.set("Main.Input", Enable=True, InputNumber=number)
        program.cycle()
        assert text(program, "Input.Valid") == "TRUE"
        assert text(program, "Input.Value") == str(value).upper()
        program.set("Main.Input", Enable=False)
        program.cycle()
        assert {text(program, f"Input.{pin}") for pin in ("Valid", "Busy", "Value")} == {"FALSE"}


def test_an_output_is_written_once_and_read_back() -> None:
    with run(PROGRAM, 1) as program:
        program.set("Main.Output", Enable=True, OutputNumber=31)
        program.set("Main.Write", Execute=True, OutputNumber=31, Value=True)
        program.cycle()
        assert text(program, "Write.Done") == "TRUE"
        assert text(program, "Output.Value") == "TRUE"
        program.set("Main.Write", Value=False)
        program.cycle()
        assert text(program, "Output.Value") == "TRUE", "an edge writes"
        program.set("Main.Write", Execute=False)
        program.cycle()
        assert text(program, "Write.Done") == "FALSE"
        program.set("Main.Write", Execute=True)
        program.cycle()
        assert text(program, "Output.Value") == "FALSE"


@pytest.mark.parametrize("number", [-1, 32, 32767])
def test_a_number_that_is_none_is_an_error(number: int) -> None:
    with run(PROGRAM, 1) as program:
        program.set("Main.Input", Enable=True, InputNumber=number)
        program.set("Main.Output", Enable=True, OutputNumber=number)
        program.set("Main.Write", Execute=True, OutputNumber=number, Value=True)
        program.cycle()
        for block in ("Input", "Output", "Write"):
            assert text(program, f"{block}.Error") == "TRUE"
            assert text(program, f"{block}.ErrorID") == "SMC_DIO_INVALID_NUMBER"
        assert text(program, "Write.Done") == "FALSE"
        assert "TRUE" not in text(program, "aOutputs")


def test_an_axis_without_a_drive_tells_how_it_stands() -> None:
    with run(PROGRAM, 3) as program:
        program.set("Main.Info", Enable=True)
        program.cycle()
        for pin in ("Simulation", "CommunicationReady", "ReadyForPowerOn"):
            assert text(program, f"Info.{pin}") == "TRUE", pin
        for pin in ("PowerOn", "IsHomed", "AxisWarning", "HomeAbsSwitch", "LimitSwitchPos", "LimitSwitchNeg"):
            assert text(program, f"Info.{pin}") == "FALSE", pin
        program.set("Main.Power", bRegulatorOn=True)
        for _ in range(3):
            program.cycle()
        program.set("Main.Homing", Execute=True, Position=12.0)
        for _ in range(3):
            program.cycle()
        assert text(program, "Info.PowerOn") == "TRUE"
        assert text(program, "Info.IsHomed") == "TRUE"


def test_an_axis_with_a_drive_is_homed_by_it() -> None:
    with axis(place=700) as program:
        switch_on(program)
        assert text(program, "Info.Simulation") == "FALSE"
        assert text(program, "Info.PowerOn") == "TRUE"
        assert text(program, "Info.IsHomed") == "FALSE"
        program.set("Main.Axis", **{"in.dwDigitalInputs": 0b101})
        cycles(program, 1)
        assert text(program, "Info.HomeAbsSwitch") == "TRUE"
        assert text(program, "Info.LimitSwitchNeg") == "TRUE"
        assert text(program, "Info.LimitSwitchPos") == "FALSE"
        program.set("Main.Home", Execute=True)
        cycles(program, 50)
        assert text(program, "Home.Done") == "TRUE"
        assert text(program, "Info.IsHomed") == "TRUE"
        program.set("Main.Axis", **{"in.bOffline": True})
        cycles(program, 2)
        assert text(program, "Info.CommunicationReady") == "FALSE"
        assert text(program, "Info.ReadyForPowerOn") == "FALSE"
