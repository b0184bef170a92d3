"""SM3_CNC: G-code through decoder, velocity check and interpolator. Spec CNCR-01, CNCR-02, GEO-14, GEO-18."""

from __future__ import annotations

import pytest
from tests.libraries.cnc_decoder import write_words
from tests.libraries.st_program import run

from tappet.cnc.parser import parse
from tappet.cnc.word_list import code_words

CYCLE_MS = 4
PROGRAM = f"""
PROGRAM Main
VAR
    dec     : SM3_CNC.SMC_NCDecoder;
    smooth  : SM3_CNC.SMC_SmoothPath;
    ahead   : SM3_CNC.SMC_PreAcknowledgeMFunctions;
    iAhead  : INT; (* The M function that is acknowledged in advance *)
    check   : SM3_CNC.SMC_CheckVelocities;
    ipo     : SM3_CNC.SMC_Interpolator;
    ncprog  : SM3_CNC.SMC_CNC_REF;
    aWords  : ARRAY[0..599] OF SM3_CNC.SMC_GCODE_WORD;
    aFirst, aSecond : ARRAY[1..50] OF SM3_CNC.SMC_GEOINFO;
    xRun    : BOOL := TRUE;
    nCycles : DINT; (* That the interpolator worked *)
    nWait   : DINT; (* With an M function *)
    diM     : DINT;
    fX, fY, fFastest, fSpeed : LREAL;
    xDone   : BOOL;
    xBefore : BOOL;
    iError  : DINT;
END_VAR
ncprog.pgc := ADR(aWords);
dec(ncprog := ncprog, bExecute := xRun, nSizeOutQueue := SIZEOF(aFirst), pbyBufferOutQueue := ADR(aFirst));
smooth(bExecute := xRun, poqDataIn := dec.poqDataOut, nSizeOutQueue := SIZEOF(aSecond),
    pbyBufferOutQueue := ADR(aSecond));
ahead(bEnable := xRun AND iAhead > 0, iM := iAhead, poqDataIn := smooth.poqDataOut);
check(bExecute := xRun, poqDataIn := smooth.poqDataOut, dAngleTol := 1);
ipo(bExecute := xRun, poqDataIn := check.poqDataOut, dwIpoTime := {CYCLE_MS * 1000}, dOverride := 1,
    bAcknM := nWait > 1);
IF ipo.bWorking THEN
    nCycles := nCycles + 1;
END_IF
IF ipo.wM <> 0 THEN
    diM := ipo.wM;
    nWait := nWait + 1;
END_IF
IF xBefore THEN
    fSpeed := SQRT(EXPT(ipo.piSetPosition.dX - fX, 2) + EXPT(ipo.piSetPosition.dY - fY, 2));
    fSpeed := fSpeed / {CYCLE_MS / 1000};
    fFastest := MAX(fFastest, fSpeed);
END_IF
xBefore := TRUE;
fX := ipo.piSetPosition.dX;
fY := ipo.piSetPosition.dY;
xDone := ipo.bDone;
iError := dec.wErrorID + smooth.wErrorID + check.wErrorID + ipo.wErrorID;
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("text", "seconds", "end", "fastest"),
    [
        # cnc_runtime EX-01: 2.5 s, M5 acknowledged, 1.5 s
        ("N10 G1 X100 Y0 F50 E100 E-100\nN20 M5\nN30 G1 X100 Y50", 4.0, (100, 50), 50),
        # cnc EX-23: the same with a corner, and through a transition
        ("G1 X50 F10 E10 E-10\nG1 Y50", 12.0, (50, 50), 10),
        ("G1 X50 F10 E10 E-10\nG1 X100", 11.0, (100, 0), 10),
        ("G1 X50 F10 E10 E-10\nG1 X100 F20", 9.25, (100, 0), 20),
        # a dwell, and a synchronisation that lets the decoder go on
        ("G1 X50 F10 E10 E-10\nG4 T2\nG1 X100", 14.0, (100, 0), 10),
        ("G1 X50 F10 E10 E-10\nG75\nG1 X100", 12.0, (100, 0), 10),
        # a position that is set: the way back is one of positioning, from where the interpolator stands
        ("G1 X50 F10 E10 E-10\nG92 X0\nG1 X30", 16.0, (30, 0), 10),
        ("G1 X50 F10 E10 E-10\nG92 X90\nG92 X0\nG1 X30", 16.0, (30, 0), 10),
        # positioning of Z and of an additional axis alone takes its time
        ("G1 X50 F10 E10 E-10\nG0 Z50\nG0 P30", 16.0, (50, 0), 10),
        # both halves of a circle: one movement
        ("G2 X100 R50 F50 E100 E-100\nG2 X0 R50", 314.159265358979 / 50 + 0.5, (0, 0), 50),
        # jumps: four lines in a row
        ("N0 G36 D4\nG91\nN20 G1 X5 F10 E10 E-10\nG37 D-1\nG20 L20", 3.0, (20, 0), 10),
    ],
)
def test_time_and_end(text: str, seconds: float, end: tuple[float, float], fastest: float) -> None:
    """How long a program takes by its trapezoids, where it ends, and that it is never faster than F."""
    with run(PROGRAM, cycles=0) as program:
        write_words(program, list(code_words(parse(text).lines)))
        for _ in range(round(seconds * 1000 / CYCLE_MS) + 40):
            program.cycle()
        assert program.literal("Main.iError") == "0"
        assert program.literal("Main.xDone") == "TRUE"
        assert (float(program.literal("Main.fX")), float(program.literal("Main.fY"))) == pytest.approx(end)
        cycles = int(program.literal("Main.nCycles"))
        assert cycles * CYCLE_MS / 1000 == pytest.approx(seconds, abs=8 * CYCLE_MS / 1000)
        assert float(program.literal("Main.fFastest")) <= fastest * (1 + 1e-6)
        assert float(program.literal("Main.fFastest")) > fastest * 0.95
        assert program.literal("Main.diM") == ("5" if "M5" in text else "0")


@pytest.mark.parametrize(("ahead", "seconds", "seen"), [(5, 11.0, "0"), (6, 12.0, "5")])
def test_an_m_function_acknowledged_in_advance(ahead: int, seconds: float, seen: str) -> None:
    """Spec CNCR-152: one movement where it is the acknowledged one, else a stop."""
    with run(PROGRAM, cycles=0) as program:
        write_words(program, list(code_words(parse("G1 X50 F10 E10 E-10\nM5\nG1 X100").lines)))
        program.set("Main", iAhead=ahead)
        for _ in range(round(seconds * 1000 / CYCLE_MS) + 40):
            program.cycle()
        assert program.literal("Main.xDone") == "TRUE"
        assert program.literal("Main.diM") == seen
        assert int(program.literal("Main.nCycles")) * CYCLE_MS / 1000 == pytest.approx(seconds, abs=0.032)
