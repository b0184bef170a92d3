"""What the checks of CNC programs find: the same lines that the decoder refuses."""

from __future__ import annotations

import pytest

from tappet.cnc.checks import check
from tappet.cnc.parser import parse


def found(text: str) -> list[tuple[int, int, str]]:
    return [(problem.line, problem.column, problem.message) for problem in check(parse(text).lines)]


@pytest.mark.parametrize(
    ("text", "column", "part"),
    [
        ("G77 X1", 0, "G77 is no command"),
        ("G31 X1 I1", 7, "G31 has no use for 'I'"),
        ("G1 X1 PROBE1 H1 L1", 13, "A probing movement has no switch points"),
        ("G1 X1 PROBE0", 6, "A probe has a number from 1"),
        ("G38 L33", 4, "L of G38 is a number from 1 to 32"),
        ("G71 L3", 4, "L of G71 is a number from 4 to 11"),
        ("G70", 0, "G70 needs one of L"),
        ("X10", 0, "No line before has a travel command"),
        ("G1 X1 M3", 6, "A line has one G or M command"),
        ("G90 X5", 4, "G90 has no use for 'X'"),
        ("G1 X5 I3", 6, "G1 has no use for 'I'"),
        ("G1 X5 L1", 6, "G1 has no use for 'L'"),
        ("G1 X5 X6", 6, "The line has 'X' already"),
        ("E1 E2", 3, "The line has 'E' already"),
        ("G2 X5 Y5", 0, "G2 needs one of I, J, K, R"),
        ("G4", 0, "G4 needs one of T"),
        ("G20 K1", 0, "G20 needs one of L"),
        ("G36 O$v$", 0, "G36 needs one of D"),
        ("G1 X5 FA10", 6, "Axis A has no limits of its own"),
        ("G0 X5 PROBE1", 6, "G0 has no use for 'PROBE'"),
        ("G1 X5 H1", 6, "The switch point has no place"),
        ("G1 X5 H1 H2 L1", 6, "The switch point has no place"),
        ("G1 X5 H0 L1", 6, "A switch has a number from 1"),
        ("G1 X5 H1 L1 H2 L1 H3 L1 H4 L1", 24, "A line has 3 switch points at most"),
        ("G2 X5 K1", 0, "G2 needs one of I, J, R; K is no centre in 2D mode"),
        ("G2 X5 R9 I1", 0, "G2 has a radius R, or a centre"),
        ("G17\nG8 X5 I1 R1", 0, "There is no G8 in 3D mode"),
        ("G36 O5 D1", 4, "O of G36 is a variable"),
        ("G92 X1 L1", 7, "G92 has no use for 'L'"),
        ("G1 X1 F-5", 6, "'F' is not below 0"),
        ("G2 X1 R-5", 6, "'R' is not below 0"),
        ("M0", 0, "The number behind M reaches from 1 to 65532"),
        ("M3 X1", 3, "M has no use for 'X'"),
        ("M3 O5", 3, "O of an M line is a variable"),
        ("N1 G20 L7", 7, "No line has the block number N7"),
        ("N1 G1 X1\nN1 X2", 0, "Line 1 has the block number N1 too"),
    ],
)
def test_problems(text: str, column: int, part: str) -> None:
    """Spec GC-05 to GC-08, CNC-37."""
    messages = [(at, message) for _, at, message in found(text)]
    assert [at for at, message in messages if message.startswith(part)] == [column]
    assert len(messages) == 1


@pytest.mark.parametrize(
    "text",
    [
        "N10 G1 X10 F50 E20 E-30\nN20 X5\nN30 G2 X10 R5\nX15 I5",
        "G1 F100\nX1",
        "G18\nG2 X5 K1",
        "G2\nI5 T90",
        "G36 D4\nN5 G37 D-1\nG20 L5",
        "M7 K1 L2 O$p$",
        "G$g$ X1\nY2",
        "G1 X5 H1 O0.5 H-1 L-2",
        "G20 L$v$",
        "G16 K1\nG75\nG4 T1\nG54 X1\nG92 X1 H1 O1\nG41 D3\n(nothing)\n",
    ],
)
def test_what_is_right(text: str) -> None:
    assert found(text) == []


def test_a_problem_of_the_parser_hides_others_of_its_line() -> None:
    assert [message[:16] for _, _, message in found("G1 X Q? M3")] == [
        "'X' has no value",
        "'Q' has no value",
        "'?' does not beg",
    ]
