"""SMC_ReadNCFile: G-code files of any length, variables, jumps and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from file_programs import FileProgram
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tappet.cnc.letters import ADDRESSES, END_OF_BLOCK, END_OF_PROGRAM, REFUSED, SKIP
from tappet.cnc.parser import decode, parse
from tappet.cnc.word_list import CodeWord, code_words

WORDS = 500
PROGRAM = f"""PROGRAM PLC_PRG
VAR
    rf       : SMC_ReadNCFile;
    dec      : SMC_NCDecoder;
    aWords   : ARRAY[0..{WORDS - 1}] OF SMC_GCODE_WORD;
    aBuffer  : ARRAY[1..50] OF SMC_GEOINFO;
    xExecute : BOOL;
    xDecode  : BOOL := TRUE;
    nWords   : UDINT := 20;
    nPointer : INT := 1;
    xVariables : BOOL;
    g_byCommand : BYTE := 1;
    g_rTest  : REAL := 12.5;
    g_stM    : SMC_M_PARAMETERS := (dP3 := 33);
    asv      : ARRAY[0..2] OF SMC_SingleVar := [
        (strVarName := 'G_BYCOMMAND', eVarType := SMC_TYPE_BYTE),
        (strVarName := 'G_RTESTX', eVarType := SMC_TYPE_REAL),
        (strVarName := 'G_STM', eVarType := SMC_TYPE_M_PARAMETERS)];
    vl       : SMC_VarList := (wNumberVars := 3);
    pGeo     : POINTER TO SMC_GEOINFO;
    nTaken   : DINT;
    fSum     : LREAL; (* Of the ends, each times its number *)
    stLast   : SMC_GEOINFO;
    stFirst  : SMC_GEOINFO;
END_VAR
asv[0].pAdr := ADR(g_byCommand);
asv[1].pAdr := ADR(g_rTest);
asv[2].pAdr := ADR(g_stM);
vl.psvVarList := ADR(asv);
rf.pvl := 0;
IF xVariables THEN
    rf.pvl := ADR(vl);
END_IF
rf.pBuffer := 0;
IF nPointer > 0 THEN
    rf.pBuffer := ADR(aWords);
END_IF
rf(bExecute := xExecute, dwBufferSize := nWords * SIZEOF(SMC_GCODE_WORD));
dec(bExecute := rf.bExecuteDecoder AND xDecode, nSizeOutQueue := SIZEOF(aBuffer),
    pbyBufferOutQueue := ADR(aBuffer), ncprog := rf.ncprog);
WHILE SMC_GetCount(dec.poqDataOut) > 0 DO
    pGeo := SMC_GetObj(dec.poqDataOut, 0);
    stLast := pGeo^;
    nTaken := nTaken + 1;
    IF nTaken = 1 THEN
        stFirst := stLast;
    END_IF
    fSum := fSum + nTaken * stLast.piDestPos.dX;
    SMC_DeleteObj(dec.poqDataOut, 0);
END_WHILE
END_PROGRAM
"""


class Reader(FileProgram):
    text = PROGRAM

    def run(self, content: str | bytes, name: str = "part.cnc", cycles: int = 2000) -> tuple[str, str]:
        """Reads and decodes a file; the errors of both blocks."""
        data = content.encode() if isinstance(content, str) else content
        (self.folder / "part.cnc").write_bytes(data)
        self.set(xExecute=False)
        self.runtime.run(cycles=2)
        self.set(nTaken=0, fSum=0.0, xExecute=True)
        self.runtime.write("PLC_PRG.rf.sFileName", name)
        self.runtime.run(cycles=2)
        for _ in range(cycles):
            busy = [self.runtime.read(f"PLC_PRG.{block}.bBusy") for block in ("rf", "dec")]
            if not busy[0] and (not busy[1] or self.literal("xDecode") == "FALSE"):
                break
            self.runtime.run(cycles=3)
        else:
            raise AssertionError("neither done nor an error")
        self.runtime.run(cycles=1)
        return self.literal("rf.ErrorID"), self.literal("dec.wErrorID")


DONE = ("SMC_NO_ERROR", "SMC_NO_ERROR")


def test_a_file_longer_than_the_buffer(tmp_path: Path) -> None:
    """Spec CNCR-30: the buffer of 20 words is filled while the decoder takes words."""
    text = "% Long part\n" + "".join(f"N{n} G1 X{n} Y{n % 7} (piece {n})\r\n" for n in range(1, 1001))
    with Reader.running(tmp_path) as program:
        defaults(program)
        assert program.run(text) == DONE
        assert program.literal("nTaken") == "1000"
        assert float(program.literal("fSum")) == sum(n * n for n in range(1, 1001))
        assert program.literal("dec.bDone") == "TRUE"
        assert program.literal("rf.ncprog.strProgramName") == "'Long part'"
        assert program.literal("dec.iLineNumberDecoded") == "1001"


def test_defaults(tmp_path: Path) -> None:
    """Spec CNCR-30: where the file has no F and E words; 3D mode."""
    with Reader.running(tmp_path) as program:
        for pin, value in {
            "fDefaultVel": 50.0, "fDefaultAccel": 60.0, "fDefaultDecel": 70.0, "fDefaultVelFF": 500.0,
            "fDefaultAccelFF": 600.0, "fDefaultDecelFF": 700.0, "b3DMode": True,
        }.items():  # fmt: skip
            program.runtime.write(f"PLC_PRG.rf.{pin}", value)
        assert program.run("G1 X3 Z4\nG0 X0") == DONE
        first, last = (
            [float(program.literal(f"{geo}.{name}")) for name in ("dVel", "dAccel", "dDecel", "dLength")]
            for geo in ("stFirst", "stLast")
        )
        assert first == [50, 60, 70, 5]
        assert last == [500, 600, 700, 3]
        program.runtime.write("PLC_PRG.rf.fDefaultAccel", 0.0)
        assert program.run("G1 X3") == ("SMC_NO_ERROR", "SMC_DEC_ACC_TOO_LITTLE")
        assert program.run("G1 X3 E9") == DONE


def defaults(program: Reader) -> None:
    for pin in ("fDefaultVel", "fDefaultAccel", "fDefaultDecel"):
        program.runtime.write(f"PLC_PRG.rf.{pin}", 9.0)


def test_variables(tmp_path: Path) -> None:
    """Spec cnc_runtime EX-04, cnc EX-15, CNCR-31, VAR-03: by a list; an unknown one is an error."""
    text = "N0 G$g_byCommand$ X$g_rTestX$"
    with Reader.running(tmp_path) as program:
        defaults(program)
        program.set(xVariables=True)
        assert program.run(text) == DONE
        assert program.literal("stLast.piDestPos.dX") == "12.5"
        assert program.literal("stLast.iMoveType") == "LIN"
        program.set(g_byCommand=0, g_rTest=3.0)
        assert program.run(text) == DONE
        assert program.literal("stLast.piDestPos.dX") == "3.0"
        assert program.literal("stLast.iMoveType") == "LINPOS"
        assert program.run("M5 O$g_stM$") == DONE
        assert program.literal("stLast.dP3") == "33.0"
        program.runtime.write("PLC_PRG.vl.wNumberVars", 1)
        assert program.run(text)[0] == "SMC_RNCF_VAR_COULDNT_BE_REPLACED"
        assert program.literal("rf.bExecuteDecoder") == "FALSE"
        program.runtime.write("PLC_PRG.vl.wVarListID", 1)
        assert program.run(text)[0] == "SMC_RNCF_NOT_VARLIST"
        program.set(xVariables=False)
        assert program.run(text)[0] == "SMC_RNCF_VAR_COULDNT_BE_REPLACED"


def test_errors(tmp_path: Path) -> None:
    """Spec cnc 13: 2000 to 2002, and 1204 of what is no word."""
    with Reader.running(tmp_path) as program:
        defaults(program)
        assert program.run("G1 X1", name="other.cnc")[0] == "SMC_RNCF_FILE_DOESNT_EXIST"
        program.set(nPointer=0)
        assert program.run("G1 X1")[0] == "SMC_RNCF_NO_BUFFER"
        program.set(nPointer=1, nWords=9)
        assert program.run("G1 X1")[0] == "SMC_RNCF_BUFFER_TOO_SMALL"
        program.set(nWords=20)
        for text, word in (
            ("G1 X1\nARCS{20}", "column 1"),
            ("G1 X1\n G1 X2 Y#r", "column 8"),
            ("G1 X", "column 4"),
        ):
            assert program.run(text) == ("SMC_NO_ERROR", "SMC_DEC_INVALID_SYNTAX")
            assert program.literal("dec.sErrorWord") == f"'{word}'"
        assert program.run("(" + "x" * 5000 + ")\nG1 X1") == ("SMC_NO_ERROR", "SMC_DEC_INVALID_SYNTAX")
        assert program.run("(" + "x" * 4000 + ")\nG1 X1") == DONE


def test_jumps_read_the_file_again(tmp_path: Path) -> None:
    """Spec CNCR-37, GEO-19: before the end of the file and behind it."""
    filler = "(" + "x" * 3000 + ")\n"
    text = f"N1 G36 D3\nN2 G91\nN3 G1 X1\n{filler * 3}N4 G37 D-1\nN5 G20 L3\n{filler * 3}N6 G1 X10"
    with Reader.running(tmp_path) as program:
        defaults(program)
        assert program.run(text) == DONE
        assert program.literal("nTaken") == "4"
        assert program.literal("stLast.piDestPos.dX") == "13.0"
        assert program.run("N1 G36 D2\nN3 G1 X1\nX2\nN4 G37 D-1\nN5 G20 L3") == DONE
        assert program.literal("nTaken") == "4"
        assert program.run("N1 G1 X1\nN5 G20 L9 K1") == ("SMC_NO_ERROR", "SMC_DEC_JUMP_TO_UNKNOWN_LINE")


def read_words(program: Reader) -> list[tuple[int, float]]:
    """The words in the buffer behind the default values, without the end of the program."""
    count = int(program.literal("rf.ncprog.nElements"))
    letters = [int(program.literal(f"aWords[{n}].byLetter")) for n in range(count)]
    values = [float(program.literal(f"aWords[{n}].fValue")) for n in range(count)]
    numbers = [int(program.literal(f"aWords[{n}].diValue")) for n in range(count)]
    assert letters.pop() == END_OF_PROGRAM
    first = letters.index(END_OF_BLOCK) + 1
    return [
        (letter, float(number) if letter in (END_OF_BLOCK, REFUSED) else value)
        for letter, value, number in list(zip(letters, values, numbers, strict=False))[first:]
    ]


LETTERS = st.sampled_from("GXYNFEMHLOPROBE0123456789.-+(/% \t\n")
LINES = st.lists(
    st.one_of(
        st.text(LETTERS, max_size=12),
        st.tuples(st.sampled_from(sorted(ADDRESSES.values())), st.integers(-99, 99)).map(
            lambda w: f"{w[0]}{w[1]}"
        ),
        st.sampled_from(["\n", " ", "//", "(c)", "/", "N5", "X1e3", "\n/"]),
    ),
    max_size=12,
).map("".join)


def expected_words(text: str) -> list[CodeWord]:
    """What the parser reads; a line with errors ends with what is refused."""
    words: list[CodeWord] = []
    for line, content in zip(parse(text).lines, text.split("\n"), strict=True):
        wrong = sorted(problem.column for problem in line.problems if problem.severity == "error")
        if not wrong:
            words += code_words([line])
            continue
        if line.suppressed:
            words.append(CodeWord(SKIP))
        if line.number is not None and "N" in content[: wrong[0]].upper():
            words.append(CodeWord(ord("N"), float(line.number)))
        before = [word for word in line.words if word.column < wrong[0]]
        words += [CodeWord(code, word.value) for word in before for code in [_code(word.address)]]
        words += [CodeWord(REFUSED, wrong[0] + 1.0), CodeWord(END_OF_BLOCK, line.place + 1.0)]
    return words


def _code(address: str) -> int:
    return next(code for code, name in ADDRESSES.items() if name == address)


@pytest.mark.slow
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(LINES, min_size=1, max_size=8))
def test_the_lexer_reads_what_the_parser_reads(tmp_path: Path, texts: list[str]) -> None:
    """Spec GC-01 to GC-04, GC-09, GC-10, GC-13: words, values, places of lines and of what is refused."""
    text = decode("\n".join(texts).encode())
    with Reader.running(tmp_path) as program:
        program.set(nWords=WORDS, xDecode=False)
        assert program.run(text)[0] == "SMC_NO_ERROR"
        found, expected = read_words(program), [(word.letter, word.value) for word in expected_words(text)]
        assert found == expected, repr(text)
