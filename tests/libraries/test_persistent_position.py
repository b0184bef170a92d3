"""Positions that outlast the controller: ax3000 AXIS-14, PERS-01 to PERS-03."""

from __future__ import annotations

import pytest
from tests.libraries.st_program import Program, run

PROGRAM = """
PROGRAM Main
VAR
    First   : SM3_Basic.{axis} := (fTaskCycle := 0.002, {settings});
    Again   : SM3_Basic.{axis} := (fTaskCycle := 0.002, {again});
    Virtual : SM3_Basic.AXIS_REF_VIRTUAL_SM3;
    Place   : SM3_Basic.MC_SetPosition;
    Store   : SM3_Basic.{block};
    Restore : SM3_Basic.{block};
    Wrong   : SM3_Basic.{block};
    Data    : SM3_Basic.{block}_Data;
    NoData  : SM3_Basic.{block}_Data;
    xOff    : BOOL; (* The controller was off since: it is another instance that works *)
    xError  : BOOL;
    dwCount : DWORD := {count};
END_VAR
IF NOT xOff THEN
    First.in.{counter};
    First.BeginCycle();
    Place(Axis := First);
    Store(Axis := First, PersistentData := Data, bEnable := TRUE{bits});
    First.EndCycle();
ELSE
    Again.in.{counter};
    Again.BeginCycle();
    Again.bError := Again.bError OR xError;
    Restore(Axis := Again, PersistentData := Data, bEnable := TRUE{bits});
    Again.EndCycle();
END_IF
Wrong(Axis := Virtual, PersistentData := NoData, bEnable := TRUE{bits});
END_PROGRAM
"""
LINEAR = "iMovementType := 1, iRatioTechUnitsNum := 1, dwRatioTechUnitsDenom := 10"
ROTARY = "iMovementType := 0, fPositionPeriod := 360.0, iRatioTechUnitsNum := 1, dwRatioTechUnitsDenom := 10"
INVERTED = LINEAR.replace("Num := 1", "Num := -1")
MULTITURN = "SMC3_PersistPosition"
SINGLETURN = "SMC3_PersistPositionSingleturn"


def program(
    settings: str,
    *,
    block: str = MULTITURN,
    count: int = 1000,
    again: str | None = None,
    bits: int | None = None,
    kind: str = "AXIS_REF_MAPPING_SM3",
) -> str:
    given = "" if bits is None else f", usiNumberOfAbsoluteBits := {bits}"
    again = settings if again is None else again
    counter = "diActPosition := DWORD_TO_DINT(dwCount)"
    if kind == "AXIS_REF_POSCONTROL_SM3":
        counter = "dwActPosition := dwCount"
    return PROGRAM.format(
        settings=settings, block=block, count=count, again=again, bits=given, axis=kind, counter=counter
    )


def number(running: Program, path: str) -> float:
    return float(running.literal(f"Main.{path}"))


def switched_off_and_on(running: Program, count: int) -> None:
    """The encoder says another value when the controller is on again."""
    assert running.literal("Main.Store.bPositionStored") == "TRUE"
    running.set("Main", xOff=True, dwCount=count)
    for _ in range(4):
        running.cycle()


@pytest.mark.parametrize("kind", ["AXIS_REF_MAPPING_SM3", "AXIS_REF_POSCONTROL_SM3"])
@pytest.mark.parametrize(("settings", "sign"), [(LINEAR, 1), (INVERTED, -1)])
@pytest.mark.parametrize("turned", [0, 37, -2000])
def test_a_position_is_restored_with_what_was_turned_by_hand(
    settings: str, sign: int, turned: int, kind: str
) -> None:
    with run(program(settings, kind=kind), 4) as running:
        running.set("Main.Place", Execute=True, Position=55.5)
        running.cycle()
        assert running.literal("Main.Store.bPositionRestored") == "FALSE", "nothing was stored before"
        switched_off_and_on(running, (1000 + turned) % 2**32)
        assert running.literal("Main.Restore.bPositionRestored") == "TRUE"
        assert running.literal("Main.Restore.eRestoringDiag") == "SMC3_PPD_RESTORING_OK"
        assert number(running, "Again.fActPosition") == pytest.approx(55.5 + sign * turned / 10)
        assert number(running, "Again.fSetPosition") == pytest.approx(55.5 + sign * turned / 10)


def test_the_counter_may_run_over_in_between() -> None:
    with run(program(LINEAR, count=2**31 - 10), 4) as running:
        running.set("Main.Place", Execute=True, Position=5.0)
        running.cycle()
        switched_off_and_on(running, 2**31 + 20)
        assert number(running, "Again.fActPosition") == pytest.approx(8.0)


def test_a_rotary_axis_stays_in_its_period() -> None:
    with run(program(ROTARY, count=36_000 * 7), 4) as running:
        running.set("Main.Place", Execute=True, Position=350.0)
        running.cycle()
        switched_off_and_on(running, 36_000 * 7 + 250)
        assert number(running, "Again.fActPosition") == pytest.approx(15.0)
        assert number(running, "Again.fSetPosition") == pytest.approx(15.0)


@pytest.mark.parametrize(("turned", "moved"), [(100, 100), (-100, -100), (4000, 4000), (-30_000, -30_000)])
def test_of_a_single_turn_encoder_only_the_lowest_bits_stay(turned: int, moved: int) -> None:
    start = 5 * 65536 + 20_000
    with run(program(LINEAR, block=SINGLETURN, count=start, bits=16), 4) as running:
        running.set("Main.Place", Execute=True, Position=700.0)
        running.cycle()
        switched_off_and_on(running, (start + turned) % 65536)
        assert number(running, "Again.fActPosition") == pytest.approx(700.0 + moved / 10)


def test_the_position_goes_on_from_the_restored_one() -> None:
    with run(program(LINEAR), 4) as running:
        running.set("Main.Place", Execute=True, Position=0.0)
        running.cycle()
        switched_off_and_on(running, 1000)
        running.set("Main", dwCount=1500)
        running.cycle()
        assert number(running, "Again.fActPosition") == pytest.approx(50.0)
        assert number(running, "Data.lIncrements") == 500


def test_another_scaling_is_told_and_nothing_restored() -> None:
    with run(program(LINEAR, again=LINEAR.replace(":= 10", ":= 20")), 4) as running:
        running.set("Main.Place", Execute=True, Position=5.0)
        running.cycle()
        switched_off_and_on(running, 1000)
        assert running.literal("Main.Restore.bPositionRestored") == "FALSE"
        assert running.literal("Main.Restore.eRestoringDiag") == "SMC3_PPD_AXIS_PROP_CHANGED"
        assert number(running, "Again.fActPosition") == pytest.approx(50.0)


def test_data_that_were_being_written_are_not_restored() -> None:
    with run(program(LINEAR), 4) as running:
        running.set("Main", xOff=True)
        running.set("Main.Data", bValid=False)
        for _ in range(3):
            running.cycle()
        assert running.literal("Main.Restore.bPositionRestored") == "FALSE"
        assert running.literal("Main.Restore.eRestoringDiag") == "SMC3_PPD_DATA_STORED_DURING_WRITING"


def test_only_an_axis_with_an_encoder_will_do() -> None:
    """PERS-03."""
    with run(program(LINEAR), 3) as running:
        assert running.literal("Main.Wrong.bError") == "TRUE"
        assert running.literal("Main.Wrong.eErrorID") == "SMC_PP_WRONG_AXIS_TYPE"
        assert running.literal("Main.Wrong.bBusy") == "FALSE"


@pytest.mark.parametrize(("bits", "valid"), [(7, False), (8, True), (32, True), (33, False)])
def test_a_number_of_bits_out_of_range_is_an_error(bits: int, valid: bool) -> None:
    with run(program(LINEAR, block=SINGLETURN, bits=bits), 3) as running:
        assert running.literal("Main.Store.bError") == ("FALSE" if valid else "TRUE")
        error = "SMC_NO_ERROR" if valid else "SMC_PP_NUMBER_OF_ABSOLUTE_BITS_INVALID"
        assert running.literal("Main.Store.eErrorID") == error


def test_an_error_of_the_axis_is_told_while_the_position_is_stored() -> None:
    with run(program(LINEAR), 4) as running:
        switched_off_and_on(running, 1000)
        running.set("Main", xError=True, dwCount=1234)
        running.cycle()
        assert running.literal("Main.Restore.eErrorID") == "SMC_DI_AXIS_ERROR"
        assert number(running, "Data.dwEncoderValue") == 1234
