"""Constants after an online change: memory has what the code uses."""

from __future__ import annotations

import pytest
from compiled_programs import build, change_over
from linked_application import loaded

TEXT = """
TYPE E_Mode : (eOff := {off}, eOn) INT; END_TYPE
TYPE ST_Pair : STRUCT a : INT := 1; b : LREAL; END_STRUCT END_TYPE
VAR_GLOBAL CONSTANT
    cNumber : INT := {n}; cText : STRING(20) := '{text}'; cReal : LREAL := {n}.5; cTime : TIME := T#{n}ms;
    cList : ARRAY[0..3] OF INT := [{n}, 2, 3, 4]; cPair : ST_Pair := (a := {n}, b := 2.5);
    cPairs : ARRAY[0..1] OF ST_Pair := [(a := 7), (a := {n})]; cMode : E_Mode := E_Mode.eOff;
    cSum : INT := cNumber + 1; cSame : INT := 5;
END_VAR
VAR_GLOBAL vKept : INT := {n}; END_VAR
FUNCTION_BLOCK FB_Limits
VAR CONSTANT cLow : INT := {n}; cRow : ARRAY[0..1] OF INT := [{n}, 9]; cHigh : INT := cNumber * 2; END_VAR
VAR_INPUT CONSTANT cGiven : INT := 3; END_VAR
VAR_STAT CONSTANT cShared : INT := {n}; END_VAR
VAR n, low, row, high : INT; {more} END_VAR
n := n + 1; low := cLow; row := cRow[n MOD 1]; high := cHigh;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR CONSTANT cOwn : DINT := {n}; END_VAR
VAR
    fb : FB_Limits; given : FB_Limits := (cGiven := {n}); many : ARRAY[0..2] OF FB_Limits;
    i, list, pair : INT; text : STRING(20); cycles : INT; own : DINT;
END_VAR
fb(); given(); cycles := cycles + 1; own := cOwn; text := cText; pair := cPairs[cycles MOD 1 + 1].a;
FOR i := 0 TO 2 DO many[i](); END_FOR
i := 0; list := cList[i];
END_PROGRAM
"""


def text(n: int = 10, word: str = "old", off: int = 1, more: str = "") -> str:
    return TEXT.format(n=n, text=word, off=off, more=more)


@pytest.mark.parametrize("more", ["", "extra : DINT := 4;"], ids=["layout kept", "layout changed"])
def test_changed_constants_are_in_memory(more: str) -> None:
    old = build(text())
    new = build(text(n=20, word="new", off=3, more=more), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        try:
            for path in ("cNumber", "cList[0]", "cPair.a", "cPairs[1].a", "PLC_PRG.cOwn", "PLC_PRG.fb.cLow"):
                assert changed.read(path) == 20, path
            assert changed.read("cText") == "new"
            assert changed.read("cReal") == 20.5
            assert changed.literal("cTime") == "T#20ms"
            assert changed.literal("cMode") == "eOff"
            assert changed.read("cSum") == 21
            assert changed.read("cSame") == 5
            for path in ("many[2].cRow[0]", "many[1].cLow", "given.cLow", "given.cGiven", "fb.cShared"):
                assert changed.read(f"PLC_PRG.{path}") == 20, path
            assert changed.read("PLC_PRG.many[0].cHigh") == 40
            assert changed.read("vKept") == 10
            assert changed.read("PLC_PRG.fb.n") == 1
            changed.cycle()
            assert changed.read("PLC_PRG.list") == changed.read("PLC_PRG.many[1].row") == 20
            assert changed.read("PLC_PRG.own") == changed.read("PLC_PRG.pair") == 20
            assert changed.read("PLC_PRG.fb.high") == 40
            assert changed.read("PLC_PRG.text") == "new"
            assert changed.read("PLC_PRG.cycles") == 2
        finally:
            changed.close()


def test_other_code_leaves_constants_alone() -> None:
    old = build(text())
    new = build(text().replace("cycles + 1", "cycles + 2"), old)
    assert new.online_change is not None
    assert (new.online_change.moves, new.online_change.initialise) == ((), ())


def test_a_variable_that_becomes_a_constant_has_its_declared_value() -> None:
    head = "PROGRAM PLC_PRG\nVAR {word} limit : INT := 5; END_VAR VAR n : INT; END_VAR\n{body}\nEND_PROGRAM"
    old = build(head.format(word="", body="limit := limit + 1;"))
    new = build(head.format(word="CONSTANT", body="n := limit;"), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        try:
            assert changed.read("PLC_PRG.limit") == 5
        finally:
            changed.close()


def test_a_constant_that_fb_init_has_set_stays() -> None:
    block = """
FUNCTION_BLOCK FB
VAR_INPUT CONSTANT size : INT := 3; END_VAR
VAR CONSTANT factor : INT := {factor}; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
THIS^.size := 8;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR fb : FB; END_VAR
fb();
END_PROGRAM
"""
    old = build(block.format(factor=2))
    new = build(block.format(factor=4), old)
    with loaded(old) as application:
        changed = change_over(application, new)
        try:
            assert (changed.read("PLC_PRG.fb.size"), changed.read("PLC_PRG.fb.factor")) == (8, 4)
        finally:
            changed.close()


def test_bits_of_constants_whose_structure_changes() -> None:
    """A BIT of a variable goes with its byte, that of a constant has its declared value."""
    head = """
TYPE ST_Bits : STRUCT first : BIT; {member} second : BIT := TRUE; END_STRUCT END_TYPE
VAR_GLOBAL CONSTANT cBits : ST_Bits := (first := {value}, second := {value}); END_VAR
VAR_GLOBAL vBits : ST_Bits := (first := {value}, second := {value}); END_VAR
PROGRAM PLC_PRG
VAR CONSTANT cOwn : ARRAY[0..1] OF ST_Bits := [(first := {value}), (second := {value})]; END_VAR
VAR n : INT; END_VAR
n := n + 1;
END_PROGRAM
"""
    old = build(head.format(member="", value="FALSE"))
    new = build(head.format(member="third : BIT;", value="TRUE"), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        try:
            for path in ("cBits.first", "cBits.second", "PLC_PRG.cOwn[0].first", "PLC_PRG.cOwn[1].second"):
                assert changed.read(path) is True, path
            assert (changed.read("vBits.first"), changed.read("vBits.second")) == (False, False)
            assert changed.read("cBits.third") is False
        finally:
            changed.close()
