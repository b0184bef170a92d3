"""G-code of anybody: the reader with its checks, and the reader and decoder of SM3_CNC, natively compiled.

Both readers have to make the same words of a text; the decoder has to come to an end, with an error
that names a line of the text, or with path objects of finite numbers.
"""

from __future__ import annotations

import ctypes
from functools import cache, partial

import numpy as np
from linked_application import LoadedApplication
from mutations import mutated
from tests.libraries.st_program import package

from tappet.cnc.checks import check
from tappet.cnc.letters import AXES, REFUSED
from tappet.cnc.parser import decode, parse
from tappet.cnc.word_list import code_words

LONGEST = 16384
"""Characters of an input that the controller's side reads."""
WORDS = 8000
OBJECTS = 20_000
"""More of them, or more calls, are an endless program: the decoder is stopped."""
PROGRAM = f"""
FUNCTION_BLOCK TextLines EXTENDS FileLines
METHOD Give
VAR_INPUT
    pFrom   : POINTER TO BYTE;
    iCount  : INT;
    diPlace : DINT;
END_VAR
VAR
    i : INT;
END_VAR
FOR i := 0 TO iCount - 1 DO
    aLine[i] := pFrom[i];
END_FOR
aLine[iCount] := 0;
iLine := iCount;
diLine := diPlace;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR
    aText    : ARRAY[0..{LONGEST}] OF BYTE;
    diLength : DINT;
    fbLines  : TextLines;
    fbLexer  : NcLexer;
    dec      : SMC_NCDecoder;
    ncprog   : SMC_CNC_REF;
    start    : SMC_POSINFO;
    aWords   : ARRAY[0..{WORDS}] OF SMC_GCODE_WORD;
    aLetters : ARRAY[0..{WORDS}] OF LREAL;
    aValues  : ARRAY[0..{WORDS}] OF LREAL;
    diWords  : DINT;
    xFull    : BOOL;
    aBuffer  : ARRAY[1..50] OF SMC_GEOINFO;
    pGeo     : POINTER TO SMC_GEOINFO;
    diObjects, diCalls, diLines, diAt, diFrom, diError, diErrorLine : DINT;
    xBegins, xStopped, xWrong, xDone : BOOL;
END_VAR
VAR_TEMP
    stWord : SMC_GCODE_WORD;
END_VAR
IF xBegins THEN
    dec(ncprog := ncprog, bExecute := FALSE, piStartPosition := start, nSizeOutQueue := SIZEOF(aBuffer),
        pbyBufferOutQueue := ADR(aBuffer));
    xBegins := FALSE;
    fbLexer.Start();
    diAt := 0;
    diLines := 0;
    diWords := 0;
    xFull := FALSE;
    WHILE diAt <= diLength DO
        diFrom := diAt;
        WHILE diAt < diLength AND_THEN aText[diAt] <> 10 DO
            diAt := diAt + 1;
        END_WHILE
        diLines := diLines + 1;
        IF diAt - diFrom > 4095 THEN
            xFull := TRUE;
        ELSE
            fbLines.Give(ADR(aText[diFrom]), DINT_TO_INT(diAt - diFrom), diLines);
            fbLexer.Take(fbLines);
            WHILE fbLexer.Next(stWord, fbLines, 0) DO
                IF diWords < {WORDS} THEN
                    aWords[diWords] := stWord;
                    aLetters[diWords] := stWord.byLetter;
                    aValues[diWords] := SEL(stWord.byLetter = 0, stWord.fValue, stWord.diValue);
                    diWords := diWords + 1;
                ELSE
                    xFull := TRUE;
                END_IF
            END_WHILE
        END_IF
        diAt := diAt + 1;
    END_WHILE
    ncprog.pgc := ADR(aWords);
    ncprog.nElements := diWords;
    diObjects := 0;
    diCalls := 0;
    xStopped := FALSE;
    xWrong := FALSE;
    xDone := FALSE;
END_IF
WHILE NOT xDone AND diWords > 0 DO (* The decoder waits for words *)
    diCalls := diCalls + 1;
    dec(ncprog := ncprog, bExecute := TRUE, bAbort := xStopped, piStartPosition := start,
        nSizeOutQueue := SIZEOF(aBuffer), pbyBufferOutQueue := ADR(aBuffer), fTimeBudget := 1.0);
    WHILE SMC_GetCount(dec.poqDataOut) > 0 DO
        pGeo := SMC_GetObj(dec.poqDataOut, 0);
        diObjects := diObjects + 1;
        xWrong := xWrong OR NOT Finite(pGeo);
        IF pGeo^.pPassed <> 0 THEN
            pGeo^.pPassed^ := TRUE;
        END_IF
        SMC_DeleteObj(dec.poqDataOut, 0);
    END_WHILE
    xStopped := diObjects > {OBJECTS} OR diCalls > {OBJECTS};
    xDone := NOT dec.bBusy OR diCalls > {OBJECTS} + 2;
END_WHILE
diError := dec.wErrorID;
diErrorLine := dec.iLineNumberDecoded;
END_PROGRAM
FUNCTION Finite : BOOL
VAR_INPUT
    pGeo : POINTER TO SMC_GEOINFO;
END_VAR
VAR
    pfStart, pfEnd : POINTER TO LREAL;
    i : INT;
END_VAR
pfStart := ADR(pGeo^.piStartPos.dX);
pfEnd := ADR(pGeo^.piDestPos.dX);
Finite := ABS(pGeo^.dLength) < 1E300 AND ABS(pGeo^.dVel) < 1E300;
FOR i := 0 TO {len(AXES) - 1} DO
    Finite := Finite AND ABS(pfStart[i]) < 1E300 AND ABS(pfEnd[i]) < 1E300;
END_FOR
END_FUNCTION
"""
SEEDS = (
    "% Part one\nN10 G0 X10 Y20 Z-5 (rapid) F1000\nN20 G1 X.5 Y-2.5 F50 E100 E-120\nN30 G2 X10 Y0 I5 J0\n"
    "N40 G3 X0 Y0 R7.5\nM30 K1 L2\n",
    "N1 G36 D3 O$n$\nN2 G1 X1 Y1 F10\nN3 G37 D-1\nN4 G20 L2\nN5 G4 T0.5\nN6 G75\n",
    "G17\nG1 X1 Z2 F1\nG18\nG2 X2 Z0 I1 K0\nG19\nG3 Y1 Z1 R1\nG15\nG8 X3 Y3 I1 J1 K0.5 L2 R30\n",
    "G5 X1 Y1\nX2 Y0\nX3 Y1\nG6 X4 Y4 I1 J2\nG10 X1 Y0 Z0 I1 J1\n",
    "G51 D2\nG1 X10 F5\nG1 Y10\nG50\nG52 D1\nX0\nY0\nG50\nG41 D3\nX5\nG40\nG61\nY5\nG60\n",
    "/N10 G1 X10 H1 L2.5 H-1 O0.5 // switch points\nG54 X1 Y2\nG55 X3\nG53\nG92 X0 Y0\nG91\nX1\nG90\n",
    "G1 X1e3 FX10 EX20 FF100 EF200 EF-50 P1 Q2 U3 V4 W5 A1 B2 C3 S1\nG98\nG99\nM3 S500\n",
)
SPICE = (
    "", "0", "-", "+", ".", "1e9", "-1E-300", "2147483648", "99999999999999999999", "1E400", "NaN", "G", "M",
    "N", "N10", "G1", "G2", "G3", "G5", "G8", "G20 L10", "G36 O$n$ D5", "G37 D-1", "H1 L5", "H32768", "R0",
    "I0 J0", "$", "$$", "$a.b[1,2].c$", "#1",
    "{1 + 2}", "(", ")", "//", "/", "%", "\n", "\r\n", "\r", "\t", "\0", "\ufeff",
    "é", "\u212a", "\u0661", "PROBE1", "FF", "EFX", "F-1", "E-0", "O1", "T0",
)  # fmt: skip

mutate = partial(mutated, spice=SPICE)


def seeds() -> list[bytes]:
    return [text.encode() for text in SEEDS]


def own_reader(data: bytes) -> tuple[str, list[tuple[float, float]], bool]:
    """The text by the parser, with its words as numbers; whether all of them can be read.

    Raises AssertionError for a message that names no place of the text.
    """
    text = decode(data)
    program = parse(text)
    lines = text.split("\n")
    for problem in check(program.lines):
        assert problem.message
        assert 0 <= problem.line < len(lines)
        assert 0 <= problem.column <= len(lines[problem.line])
        assert problem.length > 0
    readable = not any(p.severity == "error" for p in program.problems)
    variables = any(word.variable is not None for line in program.lines for word in line.words)
    numbers = [] if not readable or variables else [word[:2] for word in code_words(program.lines)]
    return text, numbers, readable and not variables


class Controller:
    """The reader and the decoder of the library on virtual time."""

    def __init__(self) -> None:
        code = package(PROGRAM, "SM3_CNC")
        self.application = LoadedApplication(code)
        self.application.start()
        self._at = {
            name: self.application.address + code.symbols.resolve(f"Main.{name}").offset
            for name in ("aText", "aLetters", "aValues")
        }

    def number(self, name: str) -> int:
        return int(self.application.read(f"Main.{name}"))

    def run(self, data: bytes) -> None:
        """Reads and decodes a text; raises ApplicationFault where the code fails."""
        ctypes.memmove(self._at["aText"], data, len(data))
        self.application.write("Main.diLength", len(data))
        self.application.write("Main.xBegins", True)
        self.application.cycle()

    def words(self) -> np.ndarray:
        """Letters and values of the words, one a row."""
        count = self.number("diWords")
        columns = [
            np.frombuffer(ctypes.string_at(self._at[name], 8 * count)) for name in ("aLetters", "aValues")
        ]
        return np.column_stack(columns)


controller = cache(Controller)


def gcode(data: bytes) -> None:
    """Both readers, and the decoder."""
    text, numbers, readable = own_reader(data)
    data = text.encode("utf-8", "replace")[:LONGEST]
    side = controller()
    side.run(data)
    words = side.words()
    if side.number("xFull"):
        return
    if len(text.encode("utf-8", "replace")) <= LONGEST:
        refused = bool((words[:, 0] == REFUSED).any())
        assert refused is not readable, "the readers do not agree whether the text can be read"
        if readable:
            np.testing.assert_array_equal(words, np.array(numbers).reshape(-1, 2))
    assert side.number("diCalls") <= OBJECTS + 2, "the decoder cannot be stopped"
    assert not side.number("xWrong"), "an object has numbers that are not finite"
    if side.number("diWords") and side.number("diError"):
        assert 0 < side.number("diErrorLine") <= side.number("diLines")
