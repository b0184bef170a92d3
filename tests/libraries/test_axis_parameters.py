"""Parameters of an axis by their numbers, against the numbers of the specification."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.libraries.st_program import Program, run

DATA = Path(__file__).parents[1] / "spec" / "data"
PROGRAM = """
PROGRAM Main
VAR
    Axis      : SM3_Basic.AXIS_REF_VIRTUAL_SM3;
    Read      : SM3_Basic.MC_ReadParameter;
    ReadBool  : SM3_Basic.MC_ReadBoolParameter;
    Write     : SM3_Basic.MC_WriteParameter;
    WriteBool : SM3_Basic.MC_WriteBoolParameter;
END_VAR
Read(Axis := Axis);
ReadBool(Axis := Axis);
Write(Axis := Axis);
WriteBool(Axis := Axis);
END_PROGRAM
"""
WRITABLE = {
    *("fMaxVelocity", "fSWMaxVelocity", "fMaxAcceleration", "fSWMaxAcceleration", "fMaxDeceleration"),
    *("fSWMaxDeceleration", "fMaxJerk", "fSWMaxJerk", "fMaxCurrent", "fSWMaxCurrent", "fMaxTorque"),
    *("fSWLimitPositive", "fSWLimitNegative", "fSWLimitDeceleration", "bSWLimitEnable", "bHWLimitEnable"),
    *("bDisableErrorLogging", "fReference", "fSWErrorMaxDistance"),
}
"""Settings and limits; what the axis tells and what blocks command is read only."""
STRUCTURED = "fbeFBError"
"""The one member that is no number."""


def _numbered() -> Iterator[tuple[int, str, str]]:
    """The numbers, members and types of both catalogs."""
    found: dict[tuple[int, str], str] = {}
    for name in ("AX3000", "SM3_Basic"):
        for item in json.loads((DATA / f"{name}.json").read_text())["items"]:
            if item["name"] != "AXIS_REF_SM3":
                continue
            for member in item["members"]:
                said = str(member.get("parameter") or "")
                said = said or ", ".join(re.findall(r"parameter (\d+)", member.get("comment") or ""))
                for number in re.findall(r"\d+", said):
                    found[int(number), member["name"]] = member["type"]
    for (number, member), type_name in sorted(found.items()):
        yield number, member, type_name


NUMBERED = [*_numbered()]


@pytest.fixture(scope="module")
def shared() -> Iterator[Program]:
    with run(PROGRAM, 0) as running:
        yield running


@pytest.fixture
def program(shared: Program) -> Iterator[Program]:
    yield shared
    for block, enable in (
        ("Read", "Enable"),
        ("ReadBool", "Enable"),
        ("Write", "Execute"),
        ("WriteBool", "Execute"),
    ):
        shared.set(f"Main.{block}", **{enable: False})
    shared.cycle()


def asked(program: Program, block: str, number: int, value: float | bool | None = None) -> tuple[str, ...]:
    """The outputs of a block after an edge: those that are TRUE, and the error."""
    enable = "Enable" if block.startswith("Read") else "Execute"
    program.set(f"Main.{block}", **{enable: False})
    program.cycle()
    inputs: dict[str, float | bool | str] = {enable: True, "ParameterNumber": number}
    if value is not None:
        inputs["Value"] = value
    program.set(f"Main.{block}", **inputs)
    program.cycle()
    says = ("Valid" if enable == "Enable" else "Done", "Busy", "Error")
    true = [name for name in says if program.literal(f"Main.{block}.{name}") == "TRUE"]
    return (*true, program.literal(f"Main.{block}.ErrorID"))


def test_the_catalogs_number_most_of_an_axis() -> None:
    assert len(NUMBERED) > 60
    assert {(9, "fMaxVelocity"), (1112, "fMaxVelocity"), (1140, "fSetJerk")} <= {row[:2] for row in NUMBERED}


@pytest.mark.parametrize(("number", "member", "type_name"), NUMBERED)
def test_parameters_are_read_by_their_number(
    program: Program, number: int, member: str, type_name: str
) -> None:
    """PAR-01, PAR-04."""
    if member == STRUCTURED:
        assert asked(program, "Read", number) == ("Error", "SMC_RP_PARAM_CONVERSION_ERROR")
        return
    before = program.literal(f"Main.Axis.{member}")
    value: float | bool = True if type_name == "BOOL" else 3.25 if type_name == "LREAL" else 1
    program.set("Main.Axis", **{member: value})
    assert asked(program, "Read", number) == ("Valid", "Busy", "SMC_NO_ERROR")
    assert float(program.literal("Main.Read.Value")) == float(value)
    if type_name == "BOOL":
        assert asked(program, "ReadBool", number) == ("Valid", "Busy", "SMC_NO_ERROR")
        assert program.literal("Main.ReadBool.Value") == "TRUE"
        program.set("Main.Axis", **{member: False})
        program.cycle()
        assert program.literal("Main.ReadBool.Value") == "FALSE"
        assert float(program.literal("Main.Read.Value")) == 0.0
        program.set("Main.Axis", **{member: before == "TRUE"})
    else:
        assert asked(program, "ReadBool", number) == ("Error", "SMC_RP_PARAM_UNKNOWN")


@pytest.mark.parametrize(("number", "member", "type_name"), NUMBERED)
def test_parameters_that_are_settings_are_written_by_their_number(
    program: Program, number: int, member: str, type_name: str
) -> None:
    """PAR-02: the others are read only."""
    if member not in WRITABLE:
        before = "" if member == STRUCTURED else program.literal(f"Main.Axis.{member}")
        assert asked(program, "Write", number, 3.0) == ("Error", "SMC_WP_PARAM_INVALID")
        assert asked(program, "WriteBool", number, True) == ("Error", "SMC_WP_PARAM_INVALID")
        assert member == STRUCTURED or program.literal(f"Main.Axis.{member}") == before
    elif type_name == "BOOL":
        for value in (True, False):
            assert asked(program, "WriteBool", number, value) == ("Done", "SMC_NO_ERROR")
            assert program.literal(f"Main.Axis.{member}") == str(value).upper()
            assert asked(program, "Write", number, float(not value)) == ("Done", "SMC_NO_ERROR")
            assert program.literal(f"Main.Axis.{member}") == str(not value).upper()
    else:
        assert asked(program, "Write", number, 512.5) == ("Done", "SMC_NO_ERROR")
        assert float(program.literal(f"Main.Axis.{member}")) == 512.5
        assert asked(program, "WriteBool", number, True) == ("Error", "SMC_WP_PARAM_INVALID")
        assert float(program.literal(f"Main.Axis.{member}")) == 512.5


def test_worked_example() -> None:
    """motion_semantics EX-28."""
    with run(PROGRAM, 0) as program:
        for number in (1112, 9):
            assert asked(program, "Read", number) == ("Valid", "Busy", "SMC_NO_ERROR")
            assert float(program.literal("Main.Read.Value")) == 100.0
        assert asked(program, "Write", 1113, 500.0) == ("Done", "SMC_NO_ERROR")
        assert float(program.literal("Main.Axis.fSWMaxVelocity")) == 500.0
        assert asked(program, "Read", 1113) == ("Valid", "Busy", "SMC_NO_ERROR")
        assert float(program.literal("Main.Read.Value")) == 500.0
        assert asked(program, "Read", 99999) == ("Error", "SMC_RP_PARAM_UNKNOWN")
        assert asked(program, "Write", 1000, 3.0) == ("Error", "SMC_WP_PARAM_INVALID")
        assert program.literal("Main.Axis.nAxisState") == "power_off"
        kept = [program.literal(f"Main.Axis.fbeFBError[{entry}].eErrorID") for entry in range(3)]
        assert kept == ["SMC_RP_PARAM_UNKNOWN", "SMC_WP_PARAM_INVALID", "SMC_NO_ERROR"]


@pytest.mark.parametrize("number", [0, 17, 999, 1001, 99999])
def test_unknown_numbers(program: Program, number: int) -> None:
    """PAR-02."""
    for block in ("Read", "ReadBool"):
        assert asked(program, block, number) == ("Error", "SMC_RP_PARAM_UNKNOWN")
    for block in ("Write", "WriteBool"):
        assert asked(program, block, number) == ("Error", "SMC_WP_PARAM_INVALID")


@pytest.mark.parametrize("number", [-23093248, -39862528, -73465345, -1])
def test_objects_of_a_drive_need_a_bus(program: Program, number: int) -> None:
    """PAR-03: an axis without a bus has nobody who answers."""
    for block in ("Read", "ReadBool"):
        assert asked(program, block, number) == ("Error", "SMC_RP_REQUESTING_ERROR")
    for block in ("Write", "WriteBool"):
        assert asked(program, block, number) == ("Error", "SMC_WP_SENDING_ERROR")


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e200])
def test_what_is_no_number_is_not_written(program: Program, value: float) -> None:
    program.set("Main.Axis", fSWMaxJerk=70.0)
    assert asked(program, "Write", 1143, value) == ("Error", "SMC_WP_PARAM_CONVERSION_ERROR")
    assert float(program.literal("Main.Axis.fSWMaxJerk")) == 70.0


@pytest.mark.parametrize("value", [0.0, -5.0])
def test_limits_of_dynamics_are_positive(program: Program, value: float) -> None:
    program.set("Main.Axis", fMaxAcceleration=70.0)
    assert asked(program, "Write", 1122, value) == ("Error", "SMC_WP_PARAM_CONVERSION_ERROR")
    assert float(program.literal("Main.Axis.fMaxAcceleration")) == 70.0
    assert asked(program, "Write", 1201, value) == ("Done", "SMC_NO_ERROR")


def test_a_value_is_written_at_the_edge_only(program: Program) -> None:
    assert asked(program, "Write", 1113, 40.0) == ("Done", "SMC_NO_ERROR")
    program.set("Main.Write", Value=60.0)
    program.cycle()
    assert float(program.literal("Main.Axis.fSWMaxVelocity")) == 40.0
    program.set("Main.Write", Execute=False)
    program.cycle()
    assert program.literal("Main.Write.Done") == "FALSE"


def test_a_value_is_read_in_each_cycle_while_enabled(program: Program) -> None:
    """ENA-01, ENA-02."""
    program.set("Main.Axis", fSWMaxVelocity=40.0)
    asked(program, "Read", 1113)
    program.set("Main.Axis", fSWMaxVelocity=41.0)
    program.cycle()
    assert float(program.literal("Main.Read.Value")) == 41.0
    program.set("Main.Read", Enable=False)
    program.set("Main.Axis", fSWMaxVelocity=42.0)
    program.cycle()
    assert program.literal("Main.Read.Valid") == "FALSE"
    assert float(program.literal("Main.Read.Value")) == 41.0
