"""Cams of SM3_Basic, given as bytes, and their values at many positions of the master."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
import numpy.typing as npt
from tests.libraries.st_program import Program, run

Numbers = npt.NDArray[np.float64]
POSITIONS = 400
"""Of the master in one cycle."""
BYTES = 16384
POLY, X, XY, XYVA, SEGMENT = range(5)
VARIABLES = {"int16": 1, "uint16": 2, "int32": 3, "uint32": 4, "float32": 5, "float64": 6}
"""MC_CAM_REF.byVarType."""
LINEAR, CUBIC = 1, 3
LAWS = ("Line", "Poly3", "Poly5", "Poly7", "Sine", "InclinedSine", "ModifiedSine", "Harmonic")
SEGMENT_BYTES = np.dtype([("numbers", "<f8", 11), ("law", "<i2"), ("padding", "V6")])

PROGRAM = f"""
PROGRAM Main
VAR
    afElements : ARRAY [0..{BYTES // 8 - 1}] OF LREAL;
    stCam      : SM3_Basic.MC_CAM_REF := (pce := ADR(afElements));
    afX        : ARRAY [0..{POSITIONS - 1}] OF LREAL;
    afOut      : ARRAY [0..{4 * POSITIONS - 1}] OF LREAL;
    stValues   : SM3_Basic.SMC_CAMValues;
    nElement   : INT;
    n          : INT;
    uElements, uX, uOut, uSegment : ULINT;
END_VAR
uElements := ADR(afElements);
uX := ADR(afX);
uOut := ADR(afOut);
uSegment := SIZEOF(SM3_Basic.SMC_CAM_SEGMENT);
FOR n := 0 TO {POSITIONS - 1} DO
    stValues := SM3_Basic.SMC_CAMEvaluate(stCam, afX[n], nElement);
    afOut[4 * n] := stValues.dY;
    afOut[4 * n + 1] := stValues.dV;
    afOut[4 * n + 2] := stValues.dA;
    afOut[4 * n + 3] := stValues.dJ;
END_FOR
END_PROGRAM
"""


def _at(address: int, count: int) -> Numbers:
    """Memory of the program as numbers."""
    return np.frombuffer((ctypes.c_double * count).from_address(address), dtype=np.float64)


class Cams:
    """Takes a cam after the other."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._elements = int(program.literal("Main.uElements"))
        self._x = _at(int(program.literal("Main.uX")), POSITIONS)
        self._out = _at(int(program.literal("Main.uOut")), 4 * POSITIONS)
        assert int(program.literal("Main.uSegment")) == SEGMENT_BYTES.itemsize

    def take(
        self,
        kind: int,
        elements: bytes,
        count: int,
        domain: tuple[float, float],
        variables: int = 0,
        quality: int = 1,
    ) -> None:
        """Makes a cam of the bytes of its elements."""
        assert len(elements) <= BYTES
        ctypes.memmove(self._elements, elements, len(elements))
        self._program.set(
            "Main.stCam",
            byType=kind,
            byVarType=variables,
            nElements=count,
            xStart=domain[0],
            xEnd=domain[1],
            byInterpolationQuality=quality,
        )

    def xyva(self, points: Numbers) -> None:
        """Points in rows."""
        data = np.ascontiguousarray(points, dtype="<f8")
        self.take(XYVA, data.tobytes(), len(data), (data[0, 0], data[-1, 0]))

    def table(self, values: Numbers, limits: Sequence[float], kind: str, quality: int) -> None:
        """Slaves, or pairs in rows; limits are editor and table, master and slave, from and to."""
        numbers = np.concatenate([np.ravel(values), limits]).astype(kind)
        byte_type = X if values.ndim == 1 else XY
        self.take(byte_type, numbers.tobytes(), len(values), (limits[0], limits[1]), VARIABLES[kind], quality)

    def segments(self, *segments: tuple[str, Sequence[float], Sequence[float], float]) -> None:
        """Each with its law, the states x, y, v, a and j at its ends and the inflection point."""
        data = np.zeros(len(segments), SEGMENT_BYTES)
        for row, (law, left, right, inflection) in zip(data, segments, strict=True):
            row["numbers"] = [*left, *right, inflection]
            row["law"] = LAWS.index(law)
        self.take(SEGMENT, data.tobytes(), len(data), (segments[0][1][0], segments[-1][2][0]))

    def values(self, x: Numbers | Sequence[float]) -> Numbers:
        """Position and three derivatives, a row for each position of the master."""
        x = np.asarray(x, dtype=np.float64)
        assert len(x) <= POSITIONS
        self._x[: len(x)] = x
        self._program.cycle()
        return self._out.reshape(POSITIONS, 4)[: len(x)].copy()


@contextmanager
def cams() -> Iterator[Cams]:
    with run(PROGRAM, cycles=1) as program:
        yield Cams(program)
