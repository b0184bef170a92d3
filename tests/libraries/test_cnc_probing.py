"""SM3_CNC: probing movements (G31, PROBE): they stop at the signal, the program goes on there. Spec cnc 8."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_decoder import WORDS, write_words
from tests.libraries.st_program import run

from tappet.cnc.parser import parse
from tappet.cnc.word_list import code_words

CALLS = 3000
CYCLE = 0.01
PROGRAM = f"""
PROGRAM Main
VAR
    dec    : SM3_CNC.SMC_NCDecoder;
    check  : SM3_CNC.SMC_CheckVelocities;
    ipo    : SM3_CNC.SMC_Interpolator := (dwIpoTime := 10000);
    ncprog : SM3_CNC.SMC_CNC_REF;
    aWords : ARRAY[0..{WORDS - 1}] OF SM3_CNC.SMC_GCODE_WORD;
    aBuffer : ARRAY[1..20] OF SM3_CNC.SMC_GEOINFO;
    fSignal : LREAL := 1E9;  (* X and Y together at which the signal comes *)
    xAcknowledges : BOOL;    (* The application stops and acknowledges instead *)
    dQuick  : LREAL;
    n, iNumber : DINT;
    xStarts : BOOL;
    afX, afY, afV : ARRAY[0..{CALLS - 1}] OF LREAL;
    fProbeX, fProbeY : LREAL;
    iError : DINT;
END_VAR
ncprog.pgc := ADR(aWords);
WHILE n < {CALLS} AND NOT ipo.bDone AND NOT ipo.bError DO
    dec(ncprog := ncprog, bExecute := TRUE, nSizeOutQueue := SIZEOF(aBuffer),
        pbyBufferOutQueue := ADR(aBuffer));
    check(bExecute := TRUE, poqDataIn := dec.poqDataOut);
    IF xAcknowledges THEN
        ipo.bSlow_Stop := ipo.iProbe > 0 AND ipo.piSetPosition.dX + ipo.piSetPosition.dY >= fSignal;
        ipo.bAcknProbe := ipo.bSlow_Stop AND ipo.dVel = 0.0;
    ELSE
        ipo.bProbe := ipo.piSetPosition.dX + ipo.piSetPosition.dY >= fSignal;
    END_IF
    ipo(bExecute := TRUE, poqDataIn := check.poqDataOut, dQuickDeceleration := dQuick);
    iNumber := MAX(iNumber, ipo.iProbe);
    afX[n] := ipo.piSetPosition.dX;
    afY[n] := ipo.piSetPosition.dY;
    afV[n] := ipo.dVel;
    n := n + 1;
END_WHILE
fProbeX := ipo.piProbePosition.dX;
fProbeY := ipo.piProbePosition.dY;
iError := ipo.wErrorID;
END_PROGRAM
"""


def play(text: str, **values: float | bool) -> tuple[dict[str, float], np.ndarray, np.ndarray]:
    """What the blocks say after the text; places and velocities of their cycles."""
    with run(PROGRAM, cycles=0) as program:
        write_words(program, list(code_words(parse(text).lines)))
        program.set("Main", **values)
        program.cycle()
        count = int(program.literal("Main.n"))
        x, y, v = (np.array(program.numbers(f"Main.{name}")[:count]) for name in ("afX", "afY", "afV"))
        result = {
            name: float(program.literal(f"Main.{name}"))
            for name in ("iError", "iNumber", "fProbeX", "fProbeY")
        }
        return result, np.column_stack([x, y]), v


@settings(max_examples=12, deadline=None)
@given(
    signal=st.floats(1, 70),
    velocity=st.floats(5, 50).map(lambda value: round(value, 3)),
    deceleration=st.floats(20, 500).map(lambda value: round(value, 3)),
    acknowledges=st.booleans(),
)
def test_the_path_stops_at_the_signal_and_goes_on_from_there(
    signal: float, velocity: float, deceleration: float, acknowledges: bool
) -> None:
    """The stop is as long as the deceleration says; the next movement is relative to where it ended."""
    text = f"F{velocity} E500 E-{deceleration}\nG31 X100 PROBE7\nG91\nG1 X0 Y10"
    result, places, speeds = play(text, fSignal=signal, xAcknowledges=acknowledges)
    assert result["iError"] == 0
    assert result["iNumber"] == 7
    stop = places[np.flatnonzero(places[:, 1] == 0)[-1], 0]
    seen = places[np.flatnonzero(places[:, 0] >= signal)[0], 0]
    if not acknowledges:
        assert result["fProbeX"] == pytest.approx(seen)
        speed = speeds[np.flatnonzero(places[:, 0] >= signal)[0]]
        assert stop - seen == pytest.approx(speed**2 / 2 / deceleration, rel=1e-6, abs=1e-6)
    assert places[-1] == pytest.approx([stop, 10])
    jumps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert jumps.max() <= velocity * CYCLE * (1 + 1e-9)


def test_a_quick_stop_has_its_own_deceleration() -> None:
    _, places, speeds = play("F20 E500 E-50\nG31 X100", fSignal=30.0, dQuick=400.0)
    first = np.flatnonzero(places[:, 0] >= 30)[0]
    assert places[-1, 0] - places[first, 0] == pytest.approx(speeds[first] ** 2 / 800)


def test_no_signal_is_an_error_at_the_end() -> None:
    """The movement has come to its end; what follows does not move."""
    result, places, _ = play("F20 E500 E-50\nG1 X10 PROBE2\nG1 Y5")
    assert result["iError"] == 10022
    assert places[-1] == pytest.approx([10, 0])


def test_an_arc_with_a_probe() -> None:
    """G2 with PROBE stops on its circle."""
    result, places, _ = play("F20 E500 E-50\nG2 X20 Y0 R10 PROBE3\nG1 X30 Y0", fSignal=12.0)
    assert result["iError"] == 0
    turn = np.flatnonzero(np.hypot(places[:, 0] - 10, places[:, 1]) > 10 - 1e-9)[-1]
    assert places[turn, 0] + places[turn, 1] >= 12
    assert places[-1] == pytest.approx([30, 0])


def test_a_signal_before_the_start_moves_nothing() -> None:
    result, places, _ = play("F20 E500 E-50\nG31 X100\nG91\nG1 Y5", fSignal=-1.0)
    assert result["iError"] == 0
    assert places[-1] == pytest.approx([0, 5])
