"""G-code through the parser and SMC_NCDecoder on virtual time: the path objects that come out."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
from tests.libraries.st_program import Program, run

from tappet.cnc.parser import parse
from tappet.cnc.word_list import CodeWord, code_words

WORDS = 600
OBJECTS = 120
AXES = ("X", "Y", "Z", "A", "B", "C", "P", "Q", "U", "V", "W")
TYPES = {
    "LIN": 1, "CLW": 2, "CCLW": 3, "SPLINE": 5, "ELLCLW": 8, "ELLCCLW": 9, "LINPOS": 100, "LINNODELTA": 101,
    "LINADDAXES": 102, "INITPOS": 110, "MCOMMAND": 120,
}  # fmt: skip
_SCALARS = (
    "iMoveType", "iSourceLine_No", *(f"dP{n}" for n in range(1, 9)), "dT1", "dT2", "dToolRadius", "dVel",
    "dVelEnd", "dAccel", "dDecel", "dLength", "byInternMark", *(f"dHelpPos[{n}]" for n in range(3)),
    *(f"iHelpID[{n}]" for n in range(3)), *(f"vX.d{a}" for a in "XYZ"), *(f"vY.d{a}" for a in "XYZ"), "b3D",
    *(f"adZ[{n}]" for n in range(4)), *(f"adVelAddAx[{n}]" for n in range(7)),
    *(f"adAccAddAx[{n}]" for n in range(7)),
    *(f"adDecAddAx[{n}]" for n in range(7)), "piDestPos.wAuxData", "piDestPos.wSProfile",
    "wSmoothAxes", "dwFlags", *(f"vToolLength.d{a}" for a in "XYZ"),
)  # fmt: skip
_MEMBERS = ("dX", "dY", "dZ", "dA", "dB", "dC", "dA1", "dA2", "dA3", "dA4", "dA5")
_FIELDS = (
    *_SCALARS,
    *(f"piStartPos.{name}" for name in _MEMBERS),
    *(f"piDestPos.{name}" for name in _MEMBERS),
)


def _stored(name: str) -> str:
    value = f"pGeo^.{name}"
    return f"BOOL_TO_LREAL({value})" if name == "b3D" else f"TO_LREAL({value})"


PROGRAM = f"""
PROGRAM Main
VAR
    dec      : SM3_CNC.SMC_NCDecoder;
    ncprog   : SM3_CNC.SMC_CNC_REF;
    aWords   : ARRAY[0..{WORDS - 1}] OF SM3_CNC.SMC_GCODE_WORD;
    aBuffer  : ARRAY[1..50] OF SM3_CNC.SMC_GEOINFO;
    start    : SM3_CNC.SMC_POSINFO;
    xExecute, xAbort, xAppend, xSuppress : BOOL;
    fBudget  : LREAL := 0.2;
    nSize    : UDINT := SIZEOF(aBuffer);
    nTake    : INT := 100;  (* Objects taken a call *)
    xPass    : BOOL := TRUE; (* Synchronisations are passed *)
    nObjects : DINT;
    k        : INT;
    pGeo     : POINTER TO SM3_CNC.SMC_GEOINFO;
    aFound   : ARRAY[0..{OBJECTS * len(_FIELDS) - 1}] OF LREAL;
    iError, iStatus, iCount, iLines, iGenerator : DINT;
    xEnd     : BOOL;
    rValue   : REAL; lrValue : LREAL; byValue : BYTE; iValue : INT; uiValue : UINT; diValue : DINT;
    parameters : SM3_CNC.SMC_M_PARAMETERS;
    sNothing : STRING;
END_VAR
ncprog.pgc := ADR(aWords);
dec(ncprog := ncprog, bExecute := xExecute, bAbort := xAbort, bAppend := xAppend, bStepSuppress := xSuppress,
    piStartPosition := start, nSizeOutQueue := nSize, pbyBufferOutQueue := ADR(aBuffer),
    fTimeBudget := fBudget);
iError := dec.wErrorID;
iStatus := dec.iStatus;
iLines := iLines + dec.GCodeText.iLines;
iGenerator := dec.poqDataOut^.byGenerator;
xEnd := dec.poqDataOut^.bEndOfList;
k := 0;
WHILE k < nTake AND SM3_CNC.SMC_GetCount(dec.poqDataOut) > 0 AND nObjects < {OBJECTS} DO
    pGeo := SM3_CNC.SMC_GetObj(dec.poqDataOut, 0);
    {
    "".join(
        f"aFound[nObjects * {len(_FIELDS)} + {index}] := {_stored(name)};"
        for index, name in enumerate(_FIELDS)
    )
}
    IF pGeo^.pPassed <> 0 AND xPass THEN
        pGeo^.pPassed^ := TRUE;
    END_IF
    SM3_CNC.SMC_DeleteObj(dec.poqDataOut, 0);
    nObjects := nObjects + 1;
    k := k + 1;
END_WHILE
iCount := SM3_CNC.SMC_GetCount(dec.poqDataOut);
END_PROGRAM
"""
VARIABLES = {
    "RVALUE": "REAL", "LRVALUE": "LREAL", "BYVALUE": "BYTE", "IVALUE": "INT", "UIVALUE": "UINT",
    "DIVALUE": "DINT", "PARAMETERS": "SMC_M_PARAMETERS",
}  # fmt: skip


@dataclass
class Geo:
    """An SMC_GEOINFO as numbers."""

    values: dict[str, float]
    start: np.ndarray = field(init=False)
    dest: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        self.start = np.array([self.values[f"piStartPos.{name}"] for name in _MEMBERS])
        self.dest = np.array([self.values[f"piDestPos.{name}"] for name in _MEMBERS])

    def __getitem__(self, name: str) -> float:
        return self.values[name]

    @property
    def kind(self) -> str:
        return next(name for name, number in TYPES.items() if number == self.values["iMoveType"])

    @property
    def length(self) -> float:
        return self.values["dLength"]

    @property
    def mark(self) -> int:
        return int(self.values["byInternMark"])

    def at(self, u: float) -> np.ndarray:
        """The place in space by the rules of cnc_runtime 2; Z of curves in 2D mode is linear in u here."""
        v = self.values
        along = self.start[:3] + u * (self.dest[:3] - self.start[:3])
        if self.kind in ("CLW", "CCLW"):
            x = np.array([v[f"vX.d{a}"] for a in "XYZ"])
            y = np.array([v[f"vY.d{a}"] for a in "XYZ"])
            normal = np.cross(x, y)
            phi = np.radians(v["dT1"] - u * v["dT2"])
            in_plane = (v["dP1"] + v["dP3"] * np.cos(phi)) * x + (v["dP2"] + v["dP3"] * np.sin(phi)) * y
            return np.asarray(in_plane + normal * (along @ normal))
        if self.kind in ("ELLCLW", "ELLCCLW"):
            phi = np.radians(v["dT1"] - u * v["dT2"] - v["dP7"])
            turn = np.radians(v["dP7"])
            e1, e2 = (np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))
            x = v["dP1"] + v["dP5"] * np.cos(phi) * e1[0] + v["dP6"] * np.sin(phi) * e2[0]
            y = v["dP2"] + v["dP5"] * np.cos(phi) * e1[1] + v["dP6"] * np.sin(phi) * e2[1]
            return np.array([x, y, along[2]])
        if self.kind == "SPLINE":
            powers = np.array([u**3, u**2, u, 1.0])
            z = along[2]
            if v["b3D"]:
                z = powers @ [v[f"adZ[{n}]"] for n in range(4)]
            return np.array(
                [powers @ [v[f"dP{n}"] for n in range(1, 5)], powers @ [v[f"dP{n}"] for n in range(5, 9)], z]
            )
        return along

    def tangent(self, u: float) -> np.ndarray:
        """A unit vector along the path, by a difference."""
        h = 1e-6
        low, high = (u, u + h) if u < 0.5 else (u - h, u)
        way = self.at(high) - self.at(low)
        if not self["b3D"]:
            way[2] = 0.0
        return np.asarray(way / np.linalg.norm(way))

    def drawn_length(self, pieces: int = 4000) -> float:
        """Length of a fine polygon on the path."""
        points = np.array([self.at(u) for u in np.linspace(0.0, 1.0, pieces + 1)])
        if not self["b3D"]:
            points[:, 2] = 0.0
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


@dataclass
class Decoded:
    """What became of a program."""

    objects: list[Geo]
    error: int
    word: str
    ended: bool
    line: int


def write_words(program: Program, words: list[CodeWord]) -> None:
    """Puts words into the program."""
    assert len(words) <= WORDS
    for n, word in enumerate(words):
        program.set("Main", **{f"aWords[{n}].byLetter": word.letter, f"aWords[{n}].fValue": word.value})
        program.set(
            "Main", **{f"aWords[{n}].diValue": round(word.value) if -(2**31) < word.value < 2**31 else 0}
        )
    program.set("Main", **{"ncprog.nElements": len(words)})


@contextmanager
def decoder(text: str, cycles: int = 0, **settings: float | bool) -> Iterator[Program]:
    """The program with a G-code text, before its first cycle."""
    with run(PROGRAM, cycles=0) as program:
        write_words(program, list(code_words(parse(text).lines)))
        program.set("Main", **settings)
        for _ in range(cycles):
            program.cycle()
        yield program


def objects(program: Program) -> list[Geo]:
    """The objects that were taken from the queue."""
    count = int(program.literal("Main.nObjects"))
    numbers = program.numbers("Main.aFound")
    width = len(_FIELDS)
    return [Geo(dict(zip(_FIELDS, numbers[n * width : (n + 1) * width], strict=True))) for n in range(count)]


def outcome(program: Program, cycles: int = 100) -> Decoded:
    """Runs the program until the decoder is done or stops."""
    program.set("Main", xExecute=True)
    for _ in range(cycles):
        program.cycle()
        if program.literal("Main.dec.bBusy") == "FALSE":
            break
    program.cycle()
    return Decoded(
        objects(program),
        int(program.literal("Main.iError")),
        program.literal("Main.dec.sErrorWord").strip("'"),
        program.literal("Main.xEnd") == "TRUE",
        int(program.literal("Main.dec.iLineNumberDecoded")),
    )


def decode(text: str, **settings: float | bool) -> Decoded:
    """Decodes a text on virtual time."""
    with decoder(text, **settings) as program:
        return outcome(program)


def path(text: str, **settings: float | bool) -> list[Geo]:
    """The objects of a text without errors."""
    decoded = decode(text, **settings)
    assert (decoded.error, decoded.word) == (0, "")
    assert decoded.ended
    return decoded.objects
