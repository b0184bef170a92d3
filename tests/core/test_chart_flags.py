"""Times of steps and the SFC flags, call by call: timeouts, reset, pause, tip mode (language_sfc.md)."""

from __future__ import annotations

from chart_runs import Run, chart

TIMED = """
INITIAL_STEP S: MAX_TIME := T#100ms; END_STEP
STEP Next: END_STEP
TRANSITION FROM S TO Next := bReady AND iCount > 5; END_TRANSITION
TRANSITION FROM Next TO S := FALSE; END_TRANSITION"""


def test_timeout() -> None:
    """language_sfc EX-07; LSFC-24, LSFC-63..LSFC-66, LSFC-70, LSFC-71."""
    flags = """SFCError, SFCQuitError : BOOL; SFCErrorStep, SFCErrorPOU, SFCErrorAnalyzation : STRING;
SFCErrorAnalyzationTable : ARRAY[0..15] OF ExpressionResult; bReady : BOOL; iCount : INT := 7;"""
    run = Run(chart(TIMED, flags))
    assert run.active("SFCError", 12) == [12]  # S.t is 100 ms in call 11 and exceeds it in call 12
    assert [run["SFCErrorStep"], run["SFCErrorPOU"]] == ["'S'", "'P'"]
    assert run["SFCErrorAnalyzation"] == "'bReady'"
    assert run["SFCErrorAnalyzationTable[0].name"] == "'bReady'"
    assert run["SFCErrorAnalyzationTable[0].value"] == "FALSE"
    assert run["SFCErrorAnalyzationTable[1].name"] == "''"
    run["SFCErrorStep"] = "'kept'"
    run.call()
    assert run["SFCErrorStep"] == "'kept'", "LSFC-63: no further timeout before the acknowledgement"
    run["SFCQuitError"] = "TRUE"
    run["bReady"] = "TRUE"
    run.call(3)
    assert [run["SFCError"], run["SFCErrorStep"], run["S.x"], run["Next.x"]] == [
        "FALSE",
        "''",
        "TRUE",
        "FALSE",
    ]
    run["SFCQuitError"] = "FALSE"
    run["bReady"] = "FALSE"
    run.call()
    assert run["S.t"] == "T#0ms"


def test_several_operands_are_listed() -> None:
    """LSFC-70, LSFC-71: NOT turns a value that blocks."""
    steps = TIMED.replace("bReady AND iCount > 5", "(a OR b) AND NOT c AND d")
    run = Run(chart(steps, "SFCError, a, b : BOOL; c, d : BOOL := TRUE; SFCErrorAnalyzation : STRING;"))
    run.call(12)
    assert run["SFCErrorAnalyzation"] == "'a, b, c'"


def test_timeouts_can_be_ignored() -> None:
    """LSFC-62: with SFCEnableLimit declared they count only while it is TRUE."""
    run = Run(chart(TIMED, "SFCError, SFCEnableLimit, bReady : BOOL; iCount : INT;"))
    assert run.active("SFCError", 15) == []
    run["SFCEnableLimit"] = "TRUE"
    assert run.active("SFCError", 1) == [16]


def test_minimum_time() -> None:
    """LSFC-24: the transition is not evaluated before it has elapsed."""
    steps = TIMED.replace("MAX_TIME := T#100ms", "MIN_TIME := wait").replace("bReady AND iCount > 5", "TRUE")
    run = Run(chart(steps, "wait : TIME := T#25ms;"))
    assert run.active("S.x", 6) == [1, 2, 3, 4]


RESETS = """
INITIAL_STEP Init: Counting(STEP); END_STEP
STEP S2: store(S); END_STEP
STEP S3: END_STEP
TRANSITION FROM Init TO S2 := go; END_TRANSITION
TRANSITION FROM S2 TO S3 := TRUE; END_TRANSITION
TRANSITION FROM S3 TO Init := FALSE; END_TRANSITION
ACTION Counting: n := n + 1; {BACK} END_ACTION"""
RESET_FLAGS = "SFCInit, SFCReset, SFCPause, SFCError, go, store : BOOL; n : INT;"


def at_third_step(steps: str) -> Run:
    run = Run(chart(steps, RESET_FLAGS))
    run["go"] = "TRUE"
    run.call(4)
    assert [run["S3.x"], run["store"]] == ["TRUE", "TRUE"]
    run["go"] = "FALSE"
    run["n"] = "10"
    return run


def test_init_holds_the_initial_step() -> None:
    """language_sfc EX-08; LSFC-60: the initial step is active but not executed, the other flags are reset."""
    run = at_third_step(RESETS.replace("{BACK}", ""))
    run["SFCError"] = "TRUE"
    run["SFCInit"] = "TRUE"
    run.call(5)
    values = [run[v] for v in ("Init.x", "S3.x", "n", "SFCError", "store")]
    assert values == ["TRUE", "FALSE", "10", "FALSE", "FALSE"]
    run["SFCInit"] = "FALSE"
    run.call(2)
    assert [run["n"], run["store"]] == ["12", "FALSE"]


def test_reset_executes_the_initial_step() -> None:
    """language_sfc EX-08; LSFC-61."""
    run = at_third_step(RESETS.replace("{BACK}", ""))
    run["SFCReset"] = "TRUE"
    run.call(5)
    assert [run["Init.x"], run["n"]] == ["TRUE", "15"]
    run = at_third_step(RESETS.replace("{BACK}", "SFCReset := FALSE;"))
    run["SFCReset"] = "TRUE"
    run.call()
    assert [run["Init.x"], run["n"], run["SFCReset"]] == ["TRUE", "11", "FALSE"]
    run["go"] = "TRUE"
    run.call(2)
    assert run["S2.x"] == "TRUE"


def test_pause() -> None:
    """LSFC-67."""
    run = Run(chart(RESETS.replace("{BACK}", ""), RESET_FLAGS))
    run.call(2)
    run["SFCPause"] = "TRUE"
    run["go"] = "TRUE"
    run.call(5)
    assert [run["n"], run["Init.x"]] == ["2", "TRUE"]
    run["SFCPause"] = "FALSE"
    run.call(2)
    assert [run["n"], run["S2.x"]] == ["3", "TRUE"]


def test_tip_mode() -> None:
    """LSFC-72..LSFC-74: a rising edge goes one step on, whatever the transitions say."""
    run = Run(chart(RESETS.replace("{BACK}", ""), f"{RESET_FLAGS} SFCTipMode, SFCTip : BOOL;"))
    run["SFCTipMode"] = "TRUE"
    run["go"] = "TRUE"
    run.call(3)
    assert run["Init.x"] == "TRUE"
    for tip, active in [("TRUE", "S2"), ("TRUE", "S2"), ("FALSE", "S2"), ("TRUE", "S3"), ("FALSE", "S3")]:
        run["SFCTip"] = tip
        run.call(2)
        assert run[f"{active}.x"] == "TRUE"
