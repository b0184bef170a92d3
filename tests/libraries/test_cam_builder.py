"""SM3_CamBuilder: cams that a program builds; and SMC_CamEditor, which watches one."""

from __future__ import annotations

import pytest
from tests.libraries.st_program import Program, run

EDGES = "left := SMCB.Bound(1, 2, 3, 4, 5), right := SMCB.Bound(2, 3, 4, 5, 6)"


def _built(appended: str, more: str = "", segments: int = 4) -> str:
    """A program that builds a cam once, and reads it at fX."""
    return f"""
PROGRAM Main
VAR
    camBuilder   : SMCB.CamBuilder;
    camRef       : SM3_Basic.MC_CAM_REF;
    aCamSegments : ARRAY[1..{segments}] OF SM3_Basic.SMC_CAM_SEGMENT;
    eAppended, eWritten : SM3_Basic.SMC_ERROR;
    xPending, xSmooth   : BOOL;
    aValues      : ARRAY[0..9] OF SM3_Basic.SMC_CAMValues;
    n, nElement  : INT;
END_VAR
camBuilder.Init();
{appended}
xPending := camBuilder.IsErrorPending();
SMCB.InitCamRef(camRef, ADR(aCamSegments), {segments});
xSmooth := camBuilder.CheckContinuity();
eWritten := camBuilder.Write(camRef);
{more}
END_PROGRAM
"""


def _values(program: Program, index: int) -> list[float]:
    return [float(program.literal(f"Main.aValues[{index}].{name}")) for name in ("dY", "dV", "dA", "dJ")]


READ = "FOR n := 0 TO 6 DO aValues[n] := SM3_Basic.SMC_CAMEvaluate(camRef, 60 * n, nElement); END_FOR"


def test_the_default_cam_as_a_program_builds_it() -> None:
    """Spec cam EX-01; the example of today's SoftMotion."""
    text = _built(
        """
camBuilder.Append(SMCB.Poly5(SMCB.BoundImplicit(), SMCB.Bound(120, 120, 1)));
camBuilder.Append(SMCB.Poly5(SMCB.BoundImplicit(), SMCB.Bound(240, 240, 1)));
eAppended := camBuilder.Append(SMCB.Poly5(SMCB.BoundImplicit(), SMCB.Bound(360, 360)));
""",
        READ,
    )
    with run(text, cycles=1) as program:
        assert program.literal("Main.eAppended") == "SMC_NO_ERROR"
        assert program.literal("Main.eWritten") == "SMC_NO_ERROR"
        assert program.literal("Main.xPending") == "FALSE"
        assert program.literal("Main.xSmooth") == "TRUE"
        assert _values(program, 1)[:3] == pytest.approx([41.25, 1.4375, 0.0125], abs=1e-12)
        assert [_values(program, n)[0] for n in (0, 2, 3, 5, 6)] == pytest.approx(
            [0, 120, 180, 318.75, 360], abs=1e-9
        )
        assert program.literal("Main.camRef.xEnd") == "360.0"
        assert program.literal("Main.camRef.nElements") == "3"


def test_every_law_becomes_a_segment() -> None:
    laws = ("Line", "Poly3", "Poly5", "Poly7", "Sine", "InclinedSine", "Harmonic", "ModifiedSine_Lambda")
    for law in laws:
        more = ", lambda := 0.25" if law.endswith("Lambda") else ""
        text = _built(f"eAppended := camBuilder.Append(SMCB.{law}({EDGES}{more}));", segments=1)
        with run(text, cycles=1) as program:
            assert program.literal("Main.eWritten") == "SMC_NO_ERROR"
            found = program.literal("Main.aCamSegments[1]")
            assert f"eType := {law.removesuffix('_Lambda')}" in found
            assert found.startswith("(dX0 := 1.0, dY0 := 2.0, dV0 := 3.0, dA0 := 4.0, dJ0 := 5.0, dX1 := 2.0")
            assert f"dLambda := {0.25 if more else 0.5}" in found


def test_coefficients_give_their_polynomial() -> None:
    """y = 1 + 2 x - 3 x^2 + 0.5 x^3 ..., x from the start of the segment."""
    five = "camBuilder.Append(SMCB.Poly5_Coeffs(60, 62, 1, 2, -3, 0.5, 0.25, -0.125));"
    seven = "camBuilder.Append(SMCB.Poly7_Coeffs(62, 63.5, 1, -2, 3, 0.5, 0.25, -0.125, 0.5, -0.2));"
    reads = "\n".join(
        f"aValues[{n}] := SM3_Basic.SMC_CAMEvaluate(camRef, {x}, nElement);"
        for n, x in enumerate((61.3, 63.1))
    )
    with run(_built(five + seven, reads), cycles=1) as program:
        assert program.literal("Main.xSmooth") == "FALSE"
        for index, (x, powers) in enumerate(
            [(1.3, (1, 2, -3, 0.5, 0.25, -0.125)), (1.1, (1, -2, 3, 0.5, 0.25, -0.125, 0.5, -0.2))]
        ):
            expected = []
            terms = [(float(c), k) for k, c in enumerate(powers)]
            for _ in range(4):
                expected.append(sum(c * x**k for c, k in terms))
                terms = [(c * k, k - 1) for c, k in terms if k > 0]
            assert _values(program, index) == pytest.approx(expected, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize(
    ("appended", "error"),
    [
        ("Line(SMCB.BoundImplicit(), SMCB.Bound(0, 1))", "SMC_CAM_INVALID_SEGMENT"),
        ("Line(SMCB.Bound(5, 1), SMCB.Bound(4, 1))", "SMC_CAM_INVALID_SEGMENT"),
        ("Line(SMCB.BoundImplicit(), SMCB.BoundImplicit())", "SMC_CAM_INVALID_SEGMENT"),
        ("ModifiedSine_Lambda(SMCB.BoundImplicit(), SMCB.Bound(4, 1), 1.0)", "SMC_CAM_INVALID_SEGMENT"),
        ("ModifiedSine_Lambda(SMCB.BoundImplicit(), SMCB.Bound(4, 1), 0.0)", "SMC_CAM_INVALID_SEGMENT"),
    ],
)
def test_segments_that_are_none_stop_the_cam(appended: str, error: str) -> None:
    text = _built(
        f"eAppended := camBuilder.Append(SMCB.{appended});\n"
        "camBuilder.Append(SMCB.Line(SMCB.BoundImplicit(), SMCB.Bound(10, 1)));"
    )
    with run(text, cycles=1) as program:
        assert program.literal("Main.eAppended") == error
        assert program.literal("Main.eWritten") == error
        assert program.literal("Main.xPending") == "TRUE"
        assert program.literal("Main.camRef.nElements") == "0"


def test_segments_join_and_fit() -> None:
    line = "camBuilder.Append(SMCB.Line(SMCB.BoundImplicit(), SMCB.Bound({0}, {0})));"
    gap = "eAppended := camBuilder.Append(SMCB.Line(SMCB.Bound(11, 10), SMCB.Bound(20, 20)));"
    with run(_built(line.format(10) + gap), cycles=1) as program:
        assert program.literal("Main.eAppended") == "SMC_CAM_INVALID_SEGMENT"
    with run(_built("".join(line.format(n) for n in (1, 2, 3)), segments=2), cycles=1) as program:
        assert program.literal("Main.eWritten") == "SMC_NO_CAM_REF_TYPE"
    many = f"FOR n := 1 TO 101 DO eAppended := {line.format('n')} END_FOR"
    with run(_built(many), cycles=1) as program:
        assert program.literal("Main.eAppended") == "SMC_CAM_TOO_MANY_SEGMENTS"


def test_a_smooth_transition_begins_as_the_cam_ends() -> None:
    text = _built(
        "camBuilder.Append(SMCB.Poly5(SMCB.BoundImplicit(), SMCB.Bound(120, 10, 0.5, 0.1)));\n"
        "camBuilder.Append(SMCB.Poly5(SMCB.BoundImplicit(), SMCB.Bound(360, 5, 0.25, 0.01)));",
        "eWritten := camBuilder.Write(camRef, createSmoothPeriodicTransition := TRUE);\n" + READ,
    )
    with run(text, cycles=1) as program:
        assert program.literal("Main.eWritten") == "SMC_NO_ERROR"
        assert _values(program, 0)[:3] == pytest.approx(_values(program, 6)[:3], abs=1e-12)
        assert _values(program, 0)[0] == 5.0


EDITED = """
PROGRAM Main
VAR
    aPoints : ARRAY[0..2] OF SM3_Basic.SMC_CAMXYVA := [(dX := 0), (dX := 180, dY := 10), (dX := 360)];
    Cam     : SM3_Basic.MC_CAM_REF := (byType := 3, nElements := 3, xEnd := 360, pce := ADR(aPoints));
    Editor  : SM3_Basic.SMC_CamEditor;
END_VAR
Editor(cam := Cam);
END_PROGRAM
"""


def test_a_watched_cam_keeps_or_takes_what_is_written() -> None:
    def said(program: Program) -> tuple[str, str, str]:
        changed, error, number = (
            program.literal(f"Main.Editor.{name}") for name in ("bCAMchanged", "bError", "nErrorID")
        )
        return changed, error, number

    with run(EDITED, cycles=2) as program:
        assert said(program) == ("FALSE", "FALSE", "SMC_NO_ERROR")
        program.set("Main.aPoints[1]", dY=20.0)
        program.cycle()
        assert program.literal("Main.aPoints[1].dY") == "10.0"
        assert said(program) == ("FALSE", "FALSE", "SMC_NO_ERROR")
        program.set("Main.Editor", bEnable=True)
        program.cycle()
        program.set("Main.aPoints[1]", dY=20.0)
        program.cycle()
        assert program.literal("Main.aPoints[1].dY") == "20.0"
        assert said(program) == ("TRUE", "FALSE", "SMC_NO_ERROR")
        program.cycle()
        assert said(program) == ("FALSE", "FALSE", "SMC_NO_ERROR")
        program.set("Main.aPoints[1]", dX=400.0)
        program.cycle()
        assert program.literal("Main.aPoints[1].dX") == "180.0"
        assert said(program) == ("FALSE", "TRUE", "SMC_NO_CAM_REF_TYPE")
        program.set("Main.Cam", nElements=0)
        program.cycle()
        assert program.literal("Main.Cam.nElements") == "3"


def test_a_cam_as_the_compiler_generates_it() -> None:
    """Spec cam EX-09, CAM-90 and CAM-93 to CAM-95: global variables, a cam that another variable takes."""
    text = """
VAR_GLOBAL
    Cam_A : ARRAY[0..3] OF SMC_CAMXYVA := [(dX:=0,dY:=0,dV:=0,dA:=0), (dX:=120,dY:=120,dV:=1,dA:=0),
                                           (dX:=240,dY:=240,dV:=1,dA:=0), (dX:=360,dY:=360,dV:=0,dA:=0)];
    Cam_T : ARRAY[0..1] OF SMC_CAMTappet := [(ctt:=TAPPET_pos, cta:=TAPPETACTION_on, iGroupID:=1, x:=90),
                                             (ctt:=TAPPET_neg, cta:=TAPPETACTION_off, iGroupID:=1, x:=90)];
    Cam : MC_CAM_REF := (byType:=3, nElements:=4, xStart:=0, xEnd:=360, nTappets:=2, strCAMName:='Cam',
                         pce:=ADR(Cam_A), pt:=ADR(Cam_T));
    _SMC_CAM_LIST : ARRAY[0..0] OF POINTER TO MC_CAM_REF := [ADR(Cam)];
END_VAR
PROGRAM Main
VAR
    pCam     : MC_CAM_REF;
    nElement : INT;
    stBefore, stBehind : SMC_CAMValues;
    sName    : STRING;
END_VAR
pCam := Cam;
stBefore := SMC_CAMEvaluate(pCam, 60, nElement);
Cam_A[1].dY := 60;
stBehind := SMC_CAMEvaluate(pCam, 120, nElement);
sName := _SMC_CAM_LIST[0]^.strCAMName;
END_PROGRAM
"""
    with run(text, cycles=1) as program:
        assert program.literal("Main.stBefore.dY") == "41.25"
        assert program.literal("Main.stBehind.dY") == "60.0"
        assert program.literal("Main.sName") == "'Cam'"
