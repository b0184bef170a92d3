"""Channels of drives that are bound to addresses and variables (devices.md AXIS-05, 22, 46 and 47)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.project.axis_projects import DECLARATION, application_id, build, errors, moving, values, with_axes

from tappet.project import edit
from tappet.project.axes.channels import CHANNELS, CIA402, Binding, assignment, table
from tappet.project.errors import InvalidDataError
from tappet.project.model import Project
from tappet.project.sources import application_sources
from tappet.runtime.local import LocalRuntime

NEEDED = {
    "in.wStatusWord": {"place": "%IW0", "type": "UINT"},
    "in.byModesOfOperationDisplay": {"place": "%IB2", "type": "SINT"},
    "in.diActPosition": {"place": "%ID4", "type": "DINT"},
    "out.wControlWord": {"place": "%QW0", "type": "UINT"},
    "out.byModesOfOperation": {"place": "%QB2", "type": "SINT"},
    "out.diSetPosition": {"place": "%QD4", "type": "DINT"},
}
DRIVE_BY_ADDRESSES = """
fbServo.stOut.wControlWord := uiControl;
fbServo.stOut.byModesOfOperation := SINT_TO_BYTE(siMode);
fbServo.stOut.diSetPosition := diSet;
fbServo(fCycle := 0.02);
uiStatus := WORD_TO_UINT(fbServo.stIn.wStatusWord);
siShown := BYTE_TO_SINT(fbServo.stIn.byModesOfOperationDisplay);
diActual := fbServo.stIn.diActPosition;
"""
DRIVE_VARIABLES = """
    fbServo : SM3_Basic.SimulatedDrive;
    uiControl AT %QW0 : UINT;
    siMode AT %QB2 : SINT;
    diSet AT %QD4 : DINT;
    uiStatus AT %MW0 : UINT;
    siShown AT %MB2 : SINT;
    diActual AT %MD4 : DINT;
END_VAR"""


def mapped(channels: dict[str, Any], drive: str = "SM_Drive_GenericDSP402", **data: Any) -> Project:
    mapping = {"automatic": False, "channels": channels}
    return moving(with_axes("Drive", drive=drive, axis_type="finite", mapping=mapping, **data))


def with_servo(project: Project) -> Project:
    """PLC_PRG also simulates the drive at its addresses."""
    (program,) = project.find_kind("pou")
    implementation = program.data.model_dump()["implementation"] + DRIVE_BY_ADDRESSES
    declaration = DECLARATION.removesuffix("END_VAR") + DRIVE_VARIABLES
    return edit.change_data(
        project, program.id, {"declaration": declaration, "implementation": implementation}
    )


def messages(project: Project) -> list[tuple[str | None, str]]:
    """Errors with the row that they are at."""
    found = []
    sources = {source.uri: source for source in application_sources(project, application_id(project))}
    for one in build(project).diagnostics:
        if one.severity == "error":
            place = sources[one.uri].map.place(one.span)
            found.append((place.element, one.message))
    return found


def test_a_drive_at_addresses_moves_its_axis() -> None:
    """The program that simulates the drive knows nothing of the axis, nor the axis of the program.

    As a bus does, the test carries what the drive says into the inputs, which no program writes.
    """
    result = build(with_servo(mapped(NEEDED)))
    assert [str(one) for one in result.diagnostics if one.severity == "error"] == []
    assert result.package is not None
    with LocalRuntime(result.package) as plc:
        plc.start()
        for _ in range(700):
            told = {"%IW0": "uiStatus", "%IB2": "siShown", "%ID4": "diActual"}
            plc.write_all({address: plc.read(f"PLC_PRG.{name}") for address, name in told.items()})
            plc.run(1)
        assert plc.read("PLC_PRG.fbMove.Done") is True
        assert plc.read("Drive.fActPosition") == pytest.approx(50.0, abs=0.05)
        assert plc.read("PLC_PRG.diActual") == pytest.approx(50.0 / 360.0 * 65536, abs=10)


def test_a_drive_in_the_memory_area_moves_its_axis() -> None:
    rows = {
        name: row | {"place": row["place"].replace("%I", "%M")} if name.startswith("in.") else row
        for name, row in NEEDED.items()
    }
    done, axis = values(with_servo(mapped(rows)), 700, "PLC_PRG.fbMove.Done", "Drive.fActPosition")
    assert done
    assert axis == pytest.approx(50.0, abs=0.05)


def test_a_drive_by_its_members_moves_its_axis() -> None:
    """Mapped automatically: the same drive, called with `in` and `out`."""
    project = moving(with_axes("Drive", drive="SM_Drive_GenericDSP402", axis_type="finite"))
    (program,) = project.find_kind("pou")
    declaration = DECLARATION.removesuffix("END_VAR") + "    fbServo : SM3_Basic.SimulatedDrive;\nEND_VAR"
    implementation = program.data.model_dump()["implementation"]
    implementation += "\nfbServo(stOut := Drive.out, fCycle := 0.02);\nDrive.in := fbServo.stIn;"
    project = edit.change_data(
        project, program.id, {"declaration": declaration, "implementation": implementation}
    )
    done, axis = values(project, 700, "PLC_PRG.fbMove.Done", "Drive.fActPosition")
    assert done
    assert axis == pytest.approx(50.0, abs=0.05)


def test_a_drive_that_follows_a_speed_is_bound_to_variables_and_bits() -> None:
    channels = {
        "in.dwActPosition": {"place": "PLC_PRG.diCounter", "type": "DINT"},
        "in.bRegulatorRealState": {"place": "%MX0.0", "type": "BOOL"},
        "in.bDriveStartRealState": {"place": "PLC_PRG.abReady[1]", "type": "BOOL"},
        "out.diSetVelocity": {"place": "PLC_PRG.diSpeed", "type": "DINT"},
        "out.bRegulatorOn": {"place": "%QX0.1", "type": "BOOL"},
    }
    project = mapped(channels, "SM_Drive_PosControl", position_control={"gain": 5.0})
    (program,) = project.find_kind("pou")
    declaration = DECLARATION.removesuffix("END_VAR") + (
        "    diCounter : DINT;\n    abReady : ARRAY[0..1] OF BOOL := [2(TRUE)];\n"
        "    xOn AT %MX0.0 : BOOL := TRUE;\nEND_VAR\n"
        "VAR_INPUT\n    diSpeed : DINT;\nEND_VAR"
    )
    body = program.data.model_dump()["implementation"] + (
        "\ndiCounter := diCounter + LREAL_TO_DINT(diSpeed / 32767.0 * 1000.0 / 360.0 * 65536 * 0.02);"
    )
    project = edit.change_data(project, program.id, {"declaration": declaration, "implementation": body})
    done, place, on = values(project, 700, "PLC_PRG.fbMove.Done", "Drive.fActPosition", "%QX0.1")
    assert done
    assert place == pytest.approx(50.0, abs=0.2)
    assert on is True


def test_channels_are_carried_around_the_cycle_of_the_axis() -> None:
    project = mapped(NEEDED)
    texts = [source.text for source in application_sources(project, application_id(project))]
    text = next(text for text in texts if "SM3_Begin_MainTask" in text)
    begin, end = text.index("Drive.BeginCycle"), text.index("Drive.EndCycle")
    assert text.index("Drive.in.wStatusWord := UINT_TO_WORD(WORD_TO_UINT(%IW0));") < begin
    assert text.index("%QD4 := DINT_TO_DWORD(Drive.out.diSetPosition);") > end


@pytest.mark.parametrize("automatic", [True, False])
def test_rows_of_no_use_are_left_out(automatic: bool) -> None:
    """Those of an automatic mapping, empty ones, and those that the drive does not have."""
    channels = {
        "in.wStatusWord": {"place": " ", "type": "WORD"},
        "in.wOther": {"place": "%IW0", "type": "WORD"},
    }
    if automatic:
        channels |= NEEDED
    mapping = {"automatic": automatic, "channels": channels}
    project = moving(with_axes("Drive", drive="SM_Drive_GenericDSP402", mapping=mapping))
    assert errors(project) == []
    assert not any("%IW0" in source.text for source in application_sources(project, application_id(project)))


@pytest.mark.parametrize(
    ("channel", "place", "type_name", "message"),
    [
        ("in.wStatusWord", "%IW", "WORD", "%IW is no address; write one such as %IW0"),
        ("in.wStatusWord", "%IB0", "WORD", "%IB0 is no place of WORD; write one such as %IW0"),
        ("in.wStatusWord", "%IX0.0", "UINT", "%IX0.0 is no place of UINT; write one such as %IW0"),
        ("in.wStatusWord", "1st", "UINT", "1st is neither an address nor the name of a variable"),
        ("in.wStatusWord", "a; b := 1", "UINT", "a; b := 1 is neither an address nor the name"),
        ("in.wStatusWord", "x'}", "UINT", "is neither an address nor the name"),
        (
            "in.wStatusWord",
            "%ID0",
            "UDINT",
            "UDINT has more bits than in.wStatusWord takes; choose BYTE, SINT",
        ),
        ("in.wStatusWord", "%IX0.0", "BOOL", "in.wStatusWord is WORD, so BOOL does not fit"),
        ("in.bOffline", "%IB0", "BYTE", "in.bOffline is BOOL, so BYTE does not fit; choose BOOL"),
        ("in.bOffline", "%IX0", "BOOL", "%IX0 is no place of BOOL; write one such as %IX0.0"),
        ("in.wStatusWord", "PLC_PRG.nowhere", "UINT", "'nowhere' is no component of 'PLC_PRG'"),
        ("in.wStatusWord", "%IW999999999", "UINT", "ends beyond"),
        ("in.wStatusWord", "PLC_PRG.fbMove.Velocity", "UINT", "LREAL"),
        ("out.diSetPosition", "%QW0", "INT", "INT has less bits than out.diSetPosition needs; choose DWORD"),
        (
            "out.diSetPosition",
            "%ID0",
            "DINT",
            "%ID0 is an input; out.diSetPosition goes to an output such as %QD0",
        ),
        ("out.diSetPosition", "PLC_PRG.fbMove.Done", "DINT", "BOOL"),
    ],
)
def test_a_wrong_row_is_an_error_at_the_row(channel: str, place: str, type_name: str, message: str) -> None:
    found = messages(mapped(NEEDED | {channel: {"place": place, "type": type_name}}))
    assert [row for row, _ in found] == [channel] * len(found)
    assert any(message in text for _, text in found), found


def test_every_channel_is_a_member_of_its_type() -> None:
    """All channels of both kinds bound to addresses of every type that fits: the compiler takes them."""
    for drive, channels in CHANNELS.items():
        rows = {}
        for number, channel in enumerate(channels):
            area = "I" if channel.is_input else "Q"
            size = {
                "BOOL": "X",
                "BYTE": "B",
                "WORD": "W",
                "INT": "W",
                "DINT": "D",
                "UDINT": "D",
                "DWORD": "D",
            }[channel.type]
            place = f"%{area}{size}{number * (1 if size != 'X' else 4)}{'.0' if size == 'X' else ''}"
            rows[channel.name] = {"place": place, "type": channel.type}
        assert errors(mapped(rows, drive)) == []


def test_the_table_of_the_editor_is_the_one_of_the_build() -> None:
    """`make generate` writes it."""
    shown = Path(__file__).parents[2] / "frontend/src/kinds/axis/channels.json"
    assert shown.read_text() == table()


def test_values_are_converted_by_their_sign() -> None:
    (torque,) = [one for one in CIA402 if one.name == "in.wActTorque"]
    assert (
        assignment("A", torque, Binding(place="G.b", type="SINT")) == "A.in.wActTorque := SINT_TO_INT(G.b);"
    )
    assert (
        assignment("A", torque, Binding(place="%IB3", type="SINT"))
        == "A.in.wActTorque := SINT_TO_INT(BYTE_TO_SINT(%IB3));"
    )


def test_a_type_that_no_channel_has_is_refused() -> None:
    with pytest.raises(InvalidDataError, match="type"):
        mapped({"in.wStatusWord": {"place": "%IW0", "type": "REAL"}})
