"""SM3_CNC: SMC_GCodeViewer behind a decoder. Spec CNCR-45 to CNCR-47."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from tests.libraries.cnc_decoder import write_words
from tests.libraries.st_program import Program, run

from tappet.cnc.parser import parse
from tappet.cnc.word_list import code_words

PROGRAM = """
PROGRAM Main
VAR
    dec      : SM3_CNC.SMC_NCDecoder;
    ncprog   : SM3_CNC.SMC_CNC_REF;
    aWords   : ARRAY[0..599] OF SM3_CNC.SMC_GCODE_WORD;
    aBuffer  : ARRAY[1..50] OF SM3_CNC.SMC_GEOINFO;
    view     : SM3_CNC.SMC_GCodeViewer;
    aLines   : ARRAY[0..9] OF SM3_CNC.SMC_GCODEVIEWER_DATA;
    uiLines  : UINT := 10;
    xDecode  : BOOL := TRUE;
    xEnable  : BOOL := TRUE;
    diLine   : DINT := -1;
    iError   : DINT;
END_VAR
ncprog.pgc := ADR(aWords);
dec(ncprog := ncprog, bExecute := xDecode, nSizeOutQueue := SIZEOF(aBuffer),
    pbyBufferOutQueue := ADR(aBuffer));
view(GCodeText := dec.GCodeText, bEnable := xEnable, iActObjectSourceNo := diLine,
    uiNumberOfBufferEntries := uiLines, pBuffer := ADR(aLines));
iError := view.wErrorID;
END_PROGRAM
"""
TEXT = """(start)
N10 g1 x 10 F50 E-3.50 (go)

N20 G02 X20 Y0 I5 FZ7 H1 L-2.5
G1 X30
/N40 X40
"""


@contextmanager
def viewer(text: str) -> Iterator[Program]:
    with run(PROGRAM, cycles=0) as program:
        write_words(program, list(code_words(parse(text).lines)))
        yield program


def shown(program: Program, count: int) -> list[str]:
    return [program.literal(f"Main.view.asGCode[{n}]").strip("'") for n in range(count)]


LINES = ["N10 G1 X10 F50 E-3.5", "N20 G2 X20 Y0 I5 FZ7 H1 L-2.5", "G1 X30", "/ N40 X40", ""]


def test_lines_and_the_current_one() -> None:
    """All lines of a call; those that were passed go; a line without N has its place as number."""
    with viewer(TEXT) as program:
        program.cycle()
        assert shown(program, 5) == LINES
        for line, first in ((10, 0), (20, 1), (5, 2), (40, 3)):
            program.set("Main", diLine=line)
            program.cycle()
            assert shown(program, 5 - first) == LINES[first:]
        assert program.literal("Main.iError") == "0"


def test_decoder_that_begins_again() -> None:
    """The viewer begins with it."""
    with viewer(TEXT) as program:
        program.cycle()
        program.set("Main", xDecode=False)
        program.cycle()
        assert shown(program, 5) == LINES
        program.set("Main", xDecode=True)
        program.cycle()
        assert shown(program, 5) == LINES


def test_errors() -> None:
    """Spec cnc 13: 1300, 1301, 1302; they go with bEnable."""
    with viewer(TEXT) as program:
        program.set("Main", uiLines=3)
        program.cycle()
        assert program.literal("Main.iError") == "1300"
        program.set("Main", xEnable=False, xDecode=False, uiLines=10)
        program.cycle()
        assert program.literal("Main.iError") == "0"
        program.set("Main", **{"aLines[9].wGCodeViewerStructID": 5, "xEnable": True})
        program.cycle()
        assert program.literal("Main.iError") == "1301"
        program.set("Main", **{"aLines[9].wGCodeViewerStructID": 0x6911, "xEnable": False})
        program.cycle()
        program.set("Main", xEnable=True, xDecode=True, diLine=77)
        program.cycle()
        assert program.literal("Main.iError") == "1302"
        assert program.literal("Main.view.bBusy") == "FALSE"
