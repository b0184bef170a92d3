"""SM3_CNC: SMC_NCDecoder, its handshake, modes, marks, jumps, variables and M functions."""

from __future__ import annotations

import numpy as np
import pytest
from tests.libraries.cnc_decoder import VARIABLES, decode, decoder, objects, outcome, path
from tests.libraries.st_program import run

from tappet.cnc.letters import LETTERS
from tappet.cnc.parser import parse
from tappet.cnc.word_list import array_initialiser, code_words

THREE = "N10 G1 X10 F50\nN20 G1 Y10\nN30 G1 X0"


def number(program: object, name: str) -> int:
    return int(program.literal(f"Main.{name}"))  # type: ignore[attr-defined]


def test_handshake_with_a_line_a_call() -> None:
    """Spec cnc_runtime EX-03: counts of calls, the end, both ways to begin again. Spec CNCR-20 to CNCR-26."""
    with decoder(THREE, fBudget=0, nTake=0) as program:
        program.set("Main", xExecute=True)
        counts = []
        for _ in range(4):
            program.cycle()
            counts.append(number(program, "iCount"))
        assert counts == [1, 2, 3, 3]
        assert program.literal("Main.dec.bDone") == "TRUE"
        assert program.literal("Main.xEnd") == "TRUE"
        assert number(program, "iStatus") == 2
        program.set("Main", xExecute=False)
        program.cycle()
        assert program.literal("Main.dec.bDone") == "FALSE"
        assert number(program, "iCount") == 3
        for append, expected in ((False, 3), (True, 6)):
            program.set("Main", xExecute=True, xAppend=append)
            for _ in range(4):
                program.cycle()
            assert number(program, "iCount") == expected
            assert number(program, "iGenerator") == 1
            program.set("Main", xExecute=False)
            program.cycle()


def test_a_buffer_too_small() -> None:
    """Spec CNCR-18."""
    with decoder(THREE) as program:
        size = int(program.literal("Main.nSize")) // 50
        program.set("Main", nSize=4 * size, xExecute=True)
        program.cycle()
        assert program.literal("Main.dec.bBusy") == "FALSE"
        assert number(program, "nObjects") == 0


def test_abort() -> None:
    """Spec CNCR-22: no result, no error; the next edge begins anew."""
    with decoder(THREE, fBudget=0) as program:
        program.set("Main", xExecute=True)
        program.cycle()
        program.set("Main", xAbort=True)
        program.cycle()
        program.set("Main", xAbort=False)
        for _ in range(5):
            program.cycle()
        assert [program.literal(f"Main.dec.{pin}") for pin in ("bBusy", "bDone", "bError")] == ["FALSE"] * 3
        assert number(program, "nObjects") == 1
        program.set("Main", xExecute=False)
        program.cycle()
        program.set("Main", nObjects=0)
        assert len(outcome(program).objects) == 3


def test_many_lines_in_a_call() -> None:
    """Spec CNCR-04, CNCR-33: as many as there is room for; the decoder waits and goes on."""
    text = "\n".join(f"N{n} G1 X{n} F1" for n in range(1, 101))
    with decoder(text, nTake=0) as program:
        program.set("Main", xExecute=True)
        for _ in range(5):
            program.cycle()
        assert number(program, "iCount") == 47
        assert program.literal("Main.dec.bBusy") == "TRUE"
        program.set("Main", nTake=7)
        outcome(program)
        for _ in range(10):
            program.cycle()
        found = objects(program)
        assert [geo.dest[0] for geo in found] == [*range(1, 101)]
        assert [geo["iSourceLine_No"] for geo in found] == [*range(1, 101)]


def test_wrong_structure() -> None:
    """Spec cnc 13: 1500."""
    with decoder(THREE) as program:
        program.set("Main", **{"ncprog.wCNCREFStructID": 1})
        assert outcome(program).error == 1500


def test_waits_for_a_program() -> None:
    """Spec CNCR-34."""
    with decoder("") as program:
        program.set("Main", xExecute=True)
        program.cycle()
        assert (number(program, "iStatus"), program.literal("Main.dec.bBusy")) == (0, "TRUE")


def test_start_position() -> None:
    """Spec GEO-01, CNCR-33: the input, else that of the program."""
    with decoder("G1 X5 F1", **{"ncprog.piStartPosition.dY": 7.0}) as program:
        assert [*outcome(program).objects[0].start[:2]] == [0, 7]
    with decoder("G1 X5 F1", **{"ncprog.piStartPosition.dY": 7.0, "start.dX": 1.0}) as program:
        assert [*outcome(program).objects[0].start[:2]] == [1, 0]


def test_modal_words() -> None:
    """Spec GC-06, GC-07, GC-11, GC-12, CNCR-36."""
    first, second, third, fast = path(
        "G1 X10 F50 E20 E-30 FF200 EF9 EF-8 FZ3 EW4 EW-5\nY5\nF7\nD2\nX0\nG0 Z3"
    )
    assert [geo.kind for geo in (first, second, third, fast)] == ["LIN", "LIN", "LIN", "LINPOS"]
    assert (first["dVel"], first["dAccel"], first["dDecel"], first["dToolRadius"]) == (50, 20, 30, 0)
    assert (second["dVel"], [*second.dest[:2]]) == (50, [10, 5])
    assert (third["dVel"], third["dToolRadius"], [*third.dest[:2]]) == (7, 2, [0, 5])
    assert (fast["dVel"], fast["dAccel"], fast["dDecel"]) == (200, 9, 8)
    for geo in (first, fast):
        assert [geo[f"adVelAddAx[{n}]"] for n in range(7)] == [200, 3, 0, 0, 0, 0, 0]
        assert [geo[f"adAccAddAx[{n}]"] for n in range(7)] == [9, 0, 0, 0, 0, 0, 4]
        assert [geo[f"adDecAddAx[{n}]"] for n in range(7)] == [8, 0, 0, 0, 0, 0, 5]


def test_velocities_at_ends() -> None:
    """Spec GEO-14: 0 at G0, a dwell, a repeated position, the end; a stop at M is for SMC_CheckVelocities."""
    found = path("G1 X1 F9\nG1 X2\nG0 X3\nG1 X4\nM3\nG1 X5\nG1 X5\nG1 X6\nG1 F8\nG1 X7\nG4 T1\nG1 X8")
    assert [geo.kind for geo in found] == [
        *("LIN", "LIN", "LINPOS", "LIN", "MCOMMAND", "LIN", "LIN", "LIN", "MCOMMAND", "LIN"),
    ]
    assert [geo["dVelEnd"] for geo in found] == [9, 0, 0, 9, 0, 0, 9, 0, 0, 0]
    assert (found[8]["iHelpID[0]"], found[8]["dP1"]) == (-1, 1)


def test_kinds_of_lines() -> None:
    """Spec GEO-02: by what they move, and their lengths in both modes."""
    found = path("G1 X3 Y4 Z12 F1\nG1 Z15\nG1 P3 Q4\nG0 Z10\nG0 Q9\nG17\nG1 X0 Y0 Z22\nG1 Z20\nG1 U2")
    assert [geo.kind for geo in found] == [
        *("LIN", "LINNODELTA", "LINADDAXES", "LINPOS", "LINADDAXES", "LIN", "LIN", "LINADDAXES"),
    ]
    assert [geo.length for geo in found] == pytest.approx([5, 3, 5, 5, 5, 13, 2, 2])
    assert [geo["dVelEnd"] for geo in found] == [1, 1, 0, 0, 0, 1, 1, 0]
    assert [geo["b3D"] for geo in found] == [0, 0, 0, 1, 0, 1, 1, 1]


@pytest.mark.parametrize(
    ("mode", "normal"),
    [
        ("G17", (0, 0, 1)),
        ("G18", (0, 1, 0)),
        ("G19", (1, 0, 0)),
        ("G16 I1 J2 K3", (1, 2, 3)),
        ("G16 I0 J0 K-2", (0, 0, -1)),
        ("G16 I-3 J0.1 K1", (-3, 0.1, 1)),
    ],
)
def test_planes(mode: str, normal: tuple[float, float, float]) -> None:
    """Spec CNCR-C18: arcs stand in their plane; G16 has the planes of G17 to G19."""
    n = np.array(normal) / np.linalg.norm(normal)
    (geo,) = path(f"{mode}\nG2 I1 J2 K-1 T90 F9")
    x, y = (np.array([geo[f"{v}.d{a}"] for a in "XYZ"]) for v in ("vX", "vY"))
    assert np.cross(x, y) == pytest.approx(n)
    centre = np.array([1.0, 2.0, -1.0])
    in_plane = centre - n * (centre @ n)
    start = -in_plane
    turned = np.cross(n, start) * -1.0
    assert geo.dest[:3] == pytest.approx(in_plane + turned)
    assert geo.at(1) == pytest.approx(geo.dest[:3])
    assert geo.length == pytest.approx(np.linalg.norm(in_plane) * np.pi / 2)
    if mode in ("G17", "G18", "G19"):
        axes = np.eye(3)[{"G17": [0, 1], "G18": [2, 0], "G19": [1, 2]}[mode]]
        assert np.array([x, y]) == pytest.approx(axes)


def test_helix() -> None:
    """Spec GEO-07: in 2D mode Z follows, in 3D mode it belongs to the length."""
    (flat,) = path("G2 I5 T540 Z9 F9")
    (space,) = path("G17\nG2 I5 T540 Z9 F9")
    assert flat.length == pytest.approx(15 * np.pi)
    assert space.length == pytest.approx(np.hypot(15 * np.pi, 9))
    for geo in (flat, space):
        assert geo.dest[:3] == pytest.approx([10, 0, 9])


def test_deviating_centre() -> None:
    """Spec GEO-06: up to a tenth it moves onto the bisector, beyond that there is a line."""
    (arc,) = path("G2 X10 Y0 I5.2 J-1 F9")
    assert arc.kind == "CLW"
    assert (arc["dP1"], arc["dP2"]) == pytest.approx((5, -1))
    assert arc.at(1)[:2] == pytest.approx([10, 0])
    (line,) = path("G2 X10 Y0 I6 J-1 F9")
    assert line.kind == "LIN"


def test_marks() -> None:
    """Spec CNCR-35, PRE-06: "on" at the first object behind the command, "off" at the last one before it."""
    found = path(
        "G41 D2\nG1 X1 F9\nG1 X2\nG51 D3\nG61\nG1 X3\nG1 X4\nG40\nG60\nG50\nG42\nG52\nG1 X5\nG1 X6\nG40\nG50"
    )
    assert [geo.mark for geo in found] == [2, 0, 16 | 128, 1 | 64 | 8, 4 | 32, 1 | 8]
    assert [geo["dToolRadius"] for geo in found] == [2, 2, 3, 3, 3, 3]


def test_modes_of_preprocessing() -> None:
    """Spec G38, G39, G43, G70, G71: what is on stays until it is switched off, for M functions too."""
    found = path(
        "G1 X1 F9\nG43 K5\nG71 L8\nG1 X2\nG71 L4\nM3\nG38 L3\nG1 X3\nG70 L8\nG43 I1 J2\nG38 L32 D1\n"
        "G1 X4 D9\nG39 L3\nG70 L4\nG38 L32 D0\nG43\nG1 X5"
    )
    assert [int(geo["wSmoothAxes"]) for geo in found] == [0, 0x80, 0x88, 0x88, 0x08, 0]
    assert [int(geo["dwFlags"]) for geo in found] == [0, 0, 0, 4, 1 << 31 | 4, 0]
    assert [[geo[f"vToolLength.d{axis}"] for axis in "XYZ"] for geo in found] == [
        [0, 0, 0],
        [0, 0, 5],
        [0, 0, 5],
        [0, 0, 5],
        [1, 2, 0],
        [0, 0, 0],
    ]
    assert [geo["dToolRadius"] for geo in found] == [0, 0, 0, 0, 9, 9]


def test_marks_that_take_each_other_back() -> None:
    """A command behind another one without an object between them."""
    found = path("G1 X1 F9\nG41\nG40\nG51\nG52\nG42\nG41\nG1 X2")
    assert [geo.mark for geo in found] == [1, 2 | 32]


def test_synchronisation() -> None:
    """Spec GEO-18: the decoder stands still until the interpolator has come there; no mark is lost."""
    with decoder("G41\nG1 X1 F9\nG75\nG40\nG1 X2", xPass=False) as program:
        program.set("Main", xExecute=True)
        for _ in range(5):
            program.cycle()
        assert [geo.kind for geo in objects(program)] == ["LIN", "MCOMMAND"]
        assert program.literal("Main.dec.bBusy") == "TRUE"
    found = path("G41\nG1 X1 F9\nG75\nG40\nG1 X2")
    assert [geo.kind for geo in found] == ["LIN", "MCOMMAND", "MCOMMAND", "LIN"]
    assert [geo["iHelpID[0]"] for geo in found] == [0, -2, -2, 0]
    assert [geo.mark for geo in found] == [2, 0, 1, 0]


def test_too_many_functions_one_behind_the_other() -> None:
    """Spec GEO-18: 64 go, more do not, unless something moves between them."""
    assert len(path("\n".join(["M3"] * 64))) == 64
    assert decode("\n".join(["M3"] * 65)).error == 1202
    assert len(path("\n".join(["M3"] * 40 + ["G1 X1 F9"] + ["M3"] * 40))) == 81
    assert len(path("\n".join(["M3"] * 40 + ["G75"] + ["M3"] * 40))) == 81


def test_set_position() -> None:
    """Spec GEO-20: in front of everything a new start; later one object; of several the last one counts."""
    found = path("G92 X5\nG92 Y6\nG1 X10 F9\nG92 X1\nG92 X2 Y3\nG1 X4")
    assert [geo.kind for geo in found] == ["LIN", "INITPOS", "LIN"]
    assert [*found[0].start[:2]] == [5, 6]
    assert found[0]["dVelEnd"] == 0
    assert [*found[1].dest[:2]] == [2, 3]
    assert [*found[2].start[:2], *found[2].dest[:2]] == [2, 3, 4, 3]


def test_jumps() -> None:
    """Spec GEO-19, CNCR-37: forward and backward, by a condition; the program is told of it."""
    assert [geo.dest[0] for geo in path("N1 G1 X1 F9\nN2 G20 L4 K1\nN3 G1 X3\nN4 G1 X4")] == [1, 4]
    assert [geo.dest[0] for geo in path("N1 G1 X1 F9\nN2 G20 L4 K0\nN3 G1 X3\nN4 G1 X4")] == [1, 3, 4]
    text = "N1 G36 D3\nN2 G91\nN3 G1 X1 F9\nN4 G37 D-1\nN5 G20 L3\nN6 G1 Y1"
    assert [geo.dest[1] for geo in path(text)] == [0, 0, 0, 1]
    with decoder("N1 G1 X1 F9\nN2 G20 L1 K1", nTake=0) as program:
        program.set("Main", xExecute=True)
        program.cycle()
        assert program.literal("Main.ncprog.bRestart") == "TRUE"
    assert decode("N1 G1 X1 F9\nN2 G20 L7 K1").error == 1203


def test_an_endless_loop_ends_each_call() -> None:
    """A jump to itself neither makes an object nor stops the task."""
    with decoder("N1 G20 L1 K1") as program:
        program.set("Main", xExecute=True)
        for _ in range(3):
            program.cycle()
        assert program.literal("Main.dec.bBusy") == "TRUE"


def test_switch_points_where_nothing_moves() -> None:
    """They happen at the end of the object before."""
    (geo,) = path("G1 X10 F9 H1 O0.5\nG1 X10 H-1 O0.2")
    assert [(geo[f"iHelpID[{n}]"], geo[f"dHelpPos[{n}]"]) for n in range(3)] == [(1, 0.5), (-1, 1), (0, 0)]


def test_switch_points_are_clamped() -> None:
    """Spec CNCR-39."""
    (geo,) = path("G1 X10 F9 H1 L12 H2 L-12 H3 O1.5")
    assert [geo[f"dHelpPos[{n}]"] for n in range(3)] == [1, 0, 1]


def test_switch_points_of_a_spline() -> None:
    """Their distance is part of a length that is known later."""
    first, _ = path("G5 X10 Y0 F9 H1 L2\nG5 X20 Y10")
    assert first["dHelpPos[0]"] == pytest.approx(2 / first.length)


VARIABLE_PROGRAM = """
PROGRAM Main
VAR
    rValue : REAL := 12.5; lrValue : LREAL := -3.25; byValue : BYTE := 1; iValue : INT := -7;
    uiValue : UINT := 65535; diValue : DINT := -70000; wValue : WORD := 40000; dwValue : DWORD := 80000;
    siValue : SINT := -5; usiValue : USINT := 200; udiValue : UDINT := 100000;
    parameters : SM3_CNC.SMC_M_PARAMETERS := (dP1 := 1, dP8 := 8);
    aWords : ARRAY[0..{last}] OF SM3_CNC.SMC_GCODE_WORD := {words};
    ncprog : SM3_CNC.SMC_CNC_REF;
    dec : SM3_CNC.SMC_NCDecoder;
    aBuffer : ARRAY[1..50] OF SM3_CNC.SMC_GEOINFO;
    afX : ARRAY[0..19] OF LREAL;
    afP : ARRAY[0..19] OF LREAL;
    pGeo : POINTER TO SM3_CNC.SMC_GEOINFO;
    n : INT;
    xRun : BOOL;
    xChanges : BOOL;
END_VAR
ncprog.pgc := ADR(aWords);
ncprog.nElements := {count};
dec(ncprog := ncprog, bExecute := xRun, nSizeOutQueue := SIZEOF(aBuffer), pbyBufferOutQueue := ADR(aBuffer));
IF xChanges THEN
    rValue := 99;
END_IF
FOR n := 0 TO 19 DO
    pGeo := SM3_CNC.SMC_GetObj(dec.poqDataOut, INT_TO_UINT(n));
    IF pGeo <> 0 THEN
        afX[n] := pGeo^.piDestPos.dX;
        afP[n] := pGeo^.dP8;
    END_IF
END_FOR
END_PROGRAM
"""
TYPES = {
    **VARIABLES,
    "WVALUE": "WORD",
    "DWVALUE": "DWORD",
    "SIVALUE": "SINT",
    "USIVALUE": "USINT",
    "UDIVALUE": "UDINT",
}


def variable_program(text: str) -> str:
    """The words of a text as initialisers in ST."""
    words = list(code_words(parse(text).lines))
    return VARIABLE_PROGRAM.format(
        last=len(words) - 1, count=len(words), words=array_initialiser(words, TYPES)
    )


def test_variables_of_all_types() -> None:
    """Spec VAR-01, VAR-02, CNCR-09, cnc EX-15: read when the line is decoded, whatever they become later."""
    names = [
        "rValue",
        "lrValue",
        "byValue",
        "iValue",
        "uiValue",
        "diValue",
        "wValue",
        "dwValue",
        "siValue",
        "usiValue",
        "udiValue",
    ]
    text = (
        "\n".join(f"N{n} G$byValue$ X${name}$ F9" for n, name in enumerate(names, 1)) + "\nM1 O$parameters$"
    )
    with run(variable_program(text), cycles=0) as program:
        program.set("Main", xRun=True, xChanges=True)
        program.cycle()
        program.cycle()
        assert program.literal("Main.dec.wErrorID") in ("0", "SMC_NO_ERROR")
        expected = [12.5, -3.25, 1, -7, 65535, -70000, 40000, 80000, -5, 200, 100000]
        assert program.numbers("Main.afX")[:11] == expected
        assert program.numbers("Main.afP")[11] == 8
        assert program.literal("Main.dec.GCodeText.str") == "'M1 O'"


def test_writing_variables() -> None:
    """Spec VAR-04: G36 and G37 with a variable; what is too large for it becomes its largest value."""
    text = (
        "G36 O$lrValue$ D2\nG37 O$lrValue$ D0.5\nG36 O$byValue$ D300\nG37 O$siValue$ D-200\nG37 O$uiValue$ D1"
    )
    with run(variable_program(text), cycles=0) as program:
        program.set("Main", xRun=True)
        program.cycle()
        found = {
            name: program.literal(f"Main.{name}") for name in ("lrValue", "byValue", "siValue", "uiValue")
        }
        assert float(found["lrValue"]) == 2.5
        assert [found[name] for name in ("byValue", "siValue", "uiValue")] == ["255", "-128", "65535"]


def test_loop_by_a_variable() -> None:
    """Spec cnc EX-18: K$v$ with v = 0 does not jump."""
    text = "N10 G91\nN20 G1 X5 F9\nN30 G37 O$iValue$ D1\nN40 G20 L20 K$iValue$"
    with run(variable_program(text), cycles=0) as program:
        program.set("Main", xRun=True, iValue=-3)
        program.cycle()
        assert program.numbers("Main.afX")[:4] == [5, 10, 15, 0]


def test_no_words() -> None:
    """What no parser makes: unknown letters, numbers that are none, too many words."""
    for letters in ([LETTERS["N"]] * 65, [LETTERS["G"], 3], [254]):
        with decoder("") as program:
            for n, letter in enumerate(letters):
                program.set("Main", **{f"aWords[{n}].byLetter": letter})
            program.set("Main", **{"ncprog.nElements": len(letters)})
            assert outcome(program).error == 1204
