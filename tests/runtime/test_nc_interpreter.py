"""SMC_ReadNCFile2 and SMC_NCInterpreter: expressions, subprograms, functions of the application."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from nc_interpreter import Interpreter


@pytest.fixture
def program(tmp_path: Path) -> Iterator[Interpreter]:
    with Interpreter.running(tmp_path) as running:
        yield running


def test_example_of_subprograms(program: Interpreter) -> None:
    """Spec cnc EX-31: a line, two half circles that come back; 10 and 125.6637 long."""
    found = program.run(
        {
            "main.cnc": "N0 G1 X10 F50\nN10 ARCS{20}",
            "arcs.cnc": "SUBPROGRAM ARCS{#R : LREAL}\nN0 G91\nN10 G2 X#R*2 Y0 R#R\nN20 G2 X-#R*2 Y0 R#R\n"
            "END_SUBPROGRAM\n",
        }
    )
    assert found.done, found
    assert found.kinds == [1, 2, 2]
    assert found.xs == pytest.approx([10, 50, 10])
    assert sum(found.lengths) == pytest.approx(10 + 125.66370614359172)


def test_values_of_words(program: Interpreter) -> None:
    """Spec VAR-05 to VAR-07: each line an end of X, computed here by hand; MOD is stronger than *."""
    cases: list[tuple[str, float]] = [
        ("G1 X#a F9", 3),
        ("G1 X2*7 MOD 4", 6),
        ("G1 X-2+3*4/2-1", 3),
        ("G1 X{1 + 2} * 3 Y1", 9),
        ("G1 X-{-4}", 4),
        ("G1 X sin 0 + cos{0}", 1),
        ("G1 X sqrt{16} Y abs -3", 4),
        ("G1 X expt{2, 3} Y min{1, 2}", 8),
        ("G1 X max{1, {2}}", 2),
        ("G1 X trunc{-2.7}", -2),
        ("G1 X ln exp 3 - tan{0} + log 100 + asin 0 + acos 1 + atan 0", 5),
        ("G1 X pi/pi", 1),
        ("G1 X#A", 3),
        ("N5 G20 L7 K #b OR NOT {1 > 2}\nG1 X99\nN7 G1 X1", 1),
        ("N8 G20 L9 K #s <> 'ab'\nG1 X12\nN9 G4 T0", 12),
        ("N10 G20 L11 K concat{#s, 'c'} = 'abc' AND TRUE XOR FALSE\nG1 X99\nN11 G1 X17", 17),
        ("G36 O#a D#a * 2 + 1\nG1 X#a", 7),
        ("G37 O#a D-2\nG1 X#a", 5),
        (
            "G36 O#b D TRUE\nG36 O#s D concat{#s, $g_s$}\nN12 G20 L13 K #b AND #s = 'abpart'\n"
            "G1 X99\nN13 G1 X4",
            4,
        ),
        ("G36 O$g_i$ D 2.4 + 3\nG1 X$g_i$ * $g_lr$", 12.5),
        ("G36 O$g_s$ D 'next'\nG36 O$g_x$ D $g_x$ = FALSE\nG1 X8", 8),
        ("G1 X1.5E1 Y.5", 15),
        ("G1X20Y30Z40", 20),
        ("/G1 X21 H1 O0.25 // comment", 21),
        ("(comment) G1 (another) X22 (last)", 22),
    ]
    declarations = "LET #a : LREAL := 3\nLET #b : BOOL\nLET #s : STRING := 'ab'\n"
    found = program.run(declarations + "\n".join(text for text, _ in cases))
    assert found.done, found
    moved = [x for x, kind in zip(found.xs, found.kinds, strict=True) if kind != 120]
    assert [round(x, 9) for x in moved] == [x for _, x in cases]
    assert program.literal("g_s") == "'next'"
    assert program.literal("g_x") == "FALSE"
    assert program.literal("g_i") == "5"


WRONG = {
    "G1 X": (1, 4, "a value is missing"),
    "G1 X1 +": (1, 7, "a value is missing"),
    "G1 X{1": (1, 5, "the brackets do not match"),
    "G1 X1}": (1, 6, "the brackets do not match"),
    "G1 X{1, 2}": (1, 7, "wrong number of arguments"),
    "G1 Xmin{1, 2}": (1, 4, "no address of a word"),
    "G1 X min{1}": (1, 6, "wrong number of arguments"),
    "G1 X min 1": (1, 6, "wrong number of arguments"),
    "G1 X sinus{1}": (1, 6, "the function is not known"),
    "G1 X sin TRUE": (1, 6, "a value of another type is expected"),
    "G1 X 1 < 2": (1, 4, "a value of another type is expected"),
    "G1 X 'a'": (1, 4, "a value of another type is expected"),
    "G1 X 1 + 'a'": (1, 8, "a value of another type is expected"),
    "G20 L5 K 1 AND TRUE": (1, 12, "a value of another type is expected"),
    "G1 X#a": (1, 5, "the variable is not known"),
    "G1 X$nothing$": (1, 5, "the variable is not known"),
    "G1 X1 ?": (1, 7, "no part of a program"),
    "G1 X1 (open": (1, 7, "comment, text or variable without its end"),
    "G1 X1 N5": (1, 7, "not possible as a number here"),
    "N1.5 G1": (1, 1, "not possible as a number here"),
    "G1 X1\nLET #a : LREAL": (2, 1, "declarations stand in front of the first block"),
    "LET #a : INT": (1, 10, "no declaration"),
    "LET #a : LREAL\nLET #A : BOOL": (2, 5, "the name is declared already"),
    "LET #a : BOOL := 1": (1, 18, "a value of another type is expected"),
    "LET #a : BOOL\nG36 O#a D1": (2, 9, "a value of another type is expected"),
    "LET #a : BOOL\nG37 O#a D TRUE": (2, 9, "a value of another type is expected"),
    "G36 O$g_lr$ D TRUE": (1, 13, "a value of another type is expected"),
    "G1 X10\nRETURN": (2, 1, "only in a subprogram"),
    "SUBPROGRAM Name": (1, 1, "not expected here"),
    "G1 X10\nN20 Nowhere{}": (2, 1, "there is no file of this subprogram"),
    "G1 X{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{1": (1, 37, "the block is too long"),
}
"""Line and column from 1, and what is said."""
NUMBERS = {
    "the variable is not known": "SMC_RNCF_VAR_COULDNT_BE_REPLACED",
    "there is no file of this subprogram": "SMC_RNCF_FILE_DOESNT_EXIST",
}


def test_what_the_reader_refuses(program: Interpreter) -> None:
    """Spec VAR-05 to VAR-08, GC-02: by number, with file, line, column and word."""
    for text, (line, column, why) in WRONG.items():
        found = program.run(text)
        local = "#" in text and why == "the variable is not known"
        number = (
            NUMBERS.get(why, "SMC_DEC_INVALID_SYNTAX") if not local else "SMC_RNCF_VAR_COULDNT_BE_REPLACED"
        )
        assert found.reader == number, (text, found)
        said = found.messages[0]
        assert said.startswith(f"main.cnc, line {line}, column {column}: "), (text, said)
        assert said.endswith(why), (text, said)
        assert program.literal("rf.errorPos.nLine") == str(line - 1)


def test_what_the_interpreter_refuses(program: Interpreter) -> None:
    """Spec cnc EX-32 and results that are no numbers: number, line, column, word; what came before stays."""
    cases = {
        "G1 X5\nN0 G77 X1": (
            "SMC_DEC_INVALID_SYNTAX",
            "main.cnc, line 2, column 4: G77: makes no sense here",
        ),
        "G1 X5\nX{1/0}": ("SMC_DEC_INVALID_SYNTAX", "main.cnc, line 2, column 1: the result is no number"),
        "G1 X5\nG1 X sqrt -1": (
            "SMC_DEC_INVALID_SYNTAX",
            "main.cnc, line 2, column 4: the result is no number",
        ),
        "G1 X5\nN0 G20 L999 K1": (
            "SMC_DEC_JUMP_TO_UNKNOWN_LINE",
            "main.cnc, line 2, column 8: L999: makes no sense here",
        ),
        "G1 X5\nG1 X6 E0": ("SMC_DEC_ACC_TOO_LITTLE", "main.cnc, line 2, column 1: G1: makes no sense here"),
    }
    for text, (number, said) in cases.items():
        found = program.run(text)
        assert (found.reader, found.interpreter) == ("SMC_NO_ERROR", number), (text, found)
        assert found.messages[1] == said
        assert found.xs == [5]
    program.runtime.write("PLC_PRG.nci.bEnableSyntaxChecks", False)
    found = program.run("G1 X5\nN0 G77 X1\nG1 X6")
    assert found.done
    assert found.xs == [5, 6]


def test_subprograms(program: Interpreter) -> None:
    """Spec VAR-08: folders in their order, parameters of all types, early return, jumps inside, modes."""
    files = {
        "main.cnc": "LET #n : LREAL := 1\nN1 Drill_A1{#n + 1, TRUE, 'deep'}\n"
        "N2 Drill_A1{5, NOT TRUE, 'flat'}\nG1 X1 F9\n"
        "N3 Keeps{}\nG1 X1\nN4 Lasts{}\nG1 X1\nN5 LOOPS{3}\nG90\nG1 X0",
        "own/drill_a1.cnc": "% header\n(comment)\n"
        "SUBPROGRAM Drill_A1{#d : LREAL, #on : BOOL, #s : STRING}\nLET #x : LREAL := #d * 10\n"
        "N10 G20 L30 K#on\nG1 X-1 F9\nN20 RETURN\nN30 G1 X#x Y2\nN40 G20 L50 K #s = 'deep'\nG1 X99\n"
        "N50 G1 Y3\nEND_SUBPROGRAM\nG1 X98",
        "other/drill_a1.cnc": "SUBPROGRAM Drill_A1{#d : LREAL, #on : BOOL, #s : STRING}\nG1 X97\n"
        "END_SUBPROGRAM",
        "other/keeps.cnc": "SUBPROGRAM KEEPS{} RESTORE_MODES\nG91\nG1 X2 F3\nEND_SUBPROGRAM",
        "other/lasts.cnc": "SUBPROGRAM Lasts\nG91\nG1 X2\nEND_SUBPROGRAM",
        "other/loops.cnc": "SUBPROGRAM Loops{#n : LREAL}\nN1 G1 X1\nG37 O#n D-1\nG20 L1 K#n > 0\n"
        "END_SUBPROGRAM",
    }
    for place, name in enumerate(("own", "other")):
        program.runtime.write(f"PLC_PRG.rf.aSubProgramDirs[{place}]", name)
    found = program.run(files)
    assert found.done, found
    assert found.plane == [
        *((20, 2), (20, 3)),
        (-1, 3),
        (1, 3),
        *((3, 3), (1, 3)),
        *((3, 3), (4, 3)),
        *((5, 3), (6, 3), (7, 3)),
        (0, 3),
    ]


def test_wrong_calls(program: Interpreter) -> None:
    """Spec VAR-08: wrong parameters, files that are no such subprogram, too many open calls."""
    files = {
        "good.cnc": "SUBPROGRAM Good{#a : LREAL, #b : BOOL}\nG1 X1\nEND_SUBPROGRAM",
        "empty.cnc": "",
        "other.cnc": "SUBPROGRAM Another{}\nEND_SUBPROGRAM",
        "plain.cnc": "G1 X1",
        "endless.cnc": "SUBPROGRAM Endless{}\nG1 X1",
        "again.cnc": "SUBPROGRAM Again{#n : LREAL}\nG91\nG1 X1\nN9 Again{#n + 1}\nEND_SUBPROGRAM",
    }
    calls = {
        "N1 Good{1}": ("line 1, column 1: GOOD: wrong number of arguments", "main"),
        "N1 Good{1, 2}": ("line 1, column 1: GOOD: a value of another type is expected", "main"),
        "N1 Empty{}": (
            "line 1, column 1: EMPTY: the file does not begin with the declaration of this subprogram",
            "main",
        ),
        "N1 Other{}": (
            "line 1, column 1: OTHER: the file does not begin with the declaration of this subprogram",
            "main",
        ),
        "N1 Plain{}": (
            "line 1, column 1: PLAIN: the file does not begin with the declaration of this subprogram",
            "main",
        ),
        "N1 Endless{}": ("line 2, column 1: END_SUBPROGRAM is missing", "endless"),
        "N1 Again{1}": ("line 4, column 1: AGAIN: too many open calls of subprograms", "again"),
        "N1 Good{1, TRUE} X1": ("line 1, column 18: X: not expected here", "main"),
    }
    for text, (said, file) in calls.items():
        found = program.run({"main.cnc": text, **files})
        assert found.reader == "SMC_DEC_INVALID_SYNTAX", (text, found)
        assert found.messages[0] == f"{file}.cnc, {said}"
        if "Again" in text:
            assert found.xs == list(range(1, 15))  # 14 calls, spec VAR-08


def test_functions_of_the_application(program: Interpreter) -> None:
    """SMC_NC_IFunction: types by the signature, any type the same wherever it stands, what it refuses."""
    assert program.run("G1 X SEL{TRUE, 1, 2}").messages[0].endswith("SEL: the function is not known")
    program.set(xFunctions=True)
    found = program.run(
        "G1 X SEL{$g_i$ > 5, 1, 2} Y SEL{FALSE, 1, 2} + next{}\n"
        "N1 G20 L2 K SEL{TRUE, 'a', 'b'} = 'b'\nG1 X99\nN2 G1 X4 + next {}"
    )
    assert found.done, found
    assert found.plane == [(2, 2), (6, 2)]
    wrong = {
        "G1 X SEL{1, 1, 2}": "a value of another type is expected",
        "G1 X SEL{TRUE, 1, 'b'}": "a value of another type is expected",
        "G1 X SEL{TRUE, TRUE, FALSE}": "a value of another type is expected",
        "G1 X SEL{TRUE, 1}": "wrong number of arguments",
        "G1 X next{1}": "wrong number of arguments",
    }
    for text, why in wrong.items():
        assert program.run(text).messages[0].endswith(why), text
    found = program.run("G1 X next{}\nG1 X next{}")
    assert found.xs == [3]
    assert found.messages[1] == "main.cnc, line 2, column 4: the result is no number"


def test_token_modifier(program: Interpreter) -> None:
    """SMC_ITokenModifier: F in units per minute; a token that it refuses is named."""
    program.set(xModify=True)
    found = program.run("G1 X1000 F6000\nG1 X2000 F $g_lr$ * 2")
    assert found.done, found
    assert float(program.literal("stLast.dVel")) == pytest.approx(2.5 * 2 / 60)
    assert (
        program.run("G1 X1\nG1 Q2").messages[0]
        == "main.cnc, line 2, column 4: Q: refused by the token modifier"
    )


def test_comments_between_parentheses_with_asterisks(program: Interpreter) -> None:
    """bParenthesesAsComments FALSE: parentheses are brackets, also with braces; comments go over lines."""
    program.runtime.write("PLC_PRG.rf.bParenthesesAsComments", False)
    found = program.run("G1 X(1 + 2} * 3 (* a comment\nG1 X99\n*) Y{2 * (3)}\n(**)G1 X2 (* *) Y1 // (* none")
    assert found.done, found
    assert found.plane == [(9, 0), (9, 6), (2, 1)]


def test_pins_of_the_reader(program: Interpreter) -> None:
    """Default values, 3D mode, suppressed blocks; a list that is none; a file that is not there."""
    found = program.run("% Part 7\nG1 X3 Z4\n/N2 G1 X9\nG1 X5 F3")
    assert found.done, found
    assert (found.lengths[0], found.xs) == (3, [3, 9, 5])
    assert program.literal("rf.sentences.stProgram") == "'Part 7'"
    assert program.literal("nci.iLineNumberDecoded") == "3"
    for pin in ("b3DMode", "bStepSuppress"):
        program.runtime.write(f"PLC_PRG.rf.{pin}", True)
    program.runtime.write("PLC_PRG.rf.fDefaultAccelFF", 77.0)
    found = program.run("G1 X3 Z4\n/G1 X9\nG0 X5")
    assert (found.lengths[0], found.xs) == (5, [3, 5])
    assert float(program.literal("stLast.dAccel")) == 77
    assert program.run("/N2 G20 L99 K1\nN3 G1 X1").done
    program.runtime.write("PLC_PRG.vl.wVarListID", 7)
    assert program.run("G1 X3").reader == "SMC_RNCF_NOT_VARLIST"
    program.runtime.write("PLC_PRG.vl.wVarListID", 0xC51A)
    (program.folder / "main.cnc").unlink()
    assert program.run({"other.cnc": ""}).reader == "SMC_RNCF_FILE_DOESNT_EXIST"


def test_a_program_that_continues_another(program: Interpreter) -> None:
    """bAppend of both blocks: modes and position of the program before hold on, the default values do not."""
    assert program.run("G91\nG1 X5 F33").xs == [5]
    for block in ("rf", "nci"):
        program.runtime.write(f"PLC_PRG.{block}.bAppend", True)
    found = program.run("G1 X2")
    assert found.done, found
    assert found.xs == [7]
    assert float(program.literal("stLast.dVel")) == 33


def test_tool_length_and_start(program: Interpreter) -> None:
    """vStartToolLength until G43 gives another one; piStartPosition."""
    program.runtime.write("PLC_PRG.nci.vStartToolLength.dZ", 12.0)
    program.runtime.write("PLC_PRG.nci.piStartPosition.dX", 4.0)
    found = program.run("G91\nG1 X1")
    assert found.xs == [5]
    assert float(program.literal("stLast.vToolLength.dZ")) == 12
    program.run("G43 I1 J2 K3\nG38 L1\nG38 L32\nG71 L4\nG71 L11\nG1 X1")
    offset = [float(program.literal(f"stLast.vToolLength.{name}")) for name in ("dX", "dY", "dZ")]
    assert offset == [1, 2, 3]
    assert int(program.literal("stLast.dwFlags")) == 0x80000001
    assert int(program.literal("stLast.wSmoothAxes")) == 0b10000001000
    program.run("G43\nG38 L5\nG39 L5\nG71 L7\nG70 L7\nG1 X1")
    assert [float(program.literal(f"stLast.vToolLength.{name}")) for name in ("dX", "dZ")] == [0, 0]
    assert (program.literal("stLast.dwFlags"), program.literal("stLast.wSmoothAxes")) == ("0", "0")


def test_a_jump_in_a_subprogram_stays_there(program: Interpreter) -> None:
    """The block number of the caller is no target; the error names the file of the subprogram."""
    found = program.run(
        {
            "main.cnc": "N5 G1 X1\nN6 Lost{}\nN7 G1 X2",
            "lost.cnc": "SUBPROGRAM Lost{}\nG1 Y1\nG20 L7 K1\nEND_SUBPROGRAM",
        }
    )
    assert found.interpreter == "SMC_DEC_JUMP_TO_UNKNOWN_LINE"
    assert found.messages[1] == "lost.cnc, line 3, column 5: L7: makes no sense here"
    assert found.plane == [(1, 0), (1, 1)]
