"""A path through blocks of SM3_CNC: objects in, objects out, with buffers of any size."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from tests.libraries.cnc_paths import AXES, Geo, line, position
from tests.libraries.st_program import run

LEFT, RIGHT, CORRECTION_OFF = 2, 4, 1
SMOOTH, ROUND, CORNERS_OFF = 16, 32, 8
LOOPS, LOOPS_OFF = 128, 64
"""Bits of byInternMark: where correction, corners and loop avoidance begin and end."""

OBJECTS_IN = 24
OBJECTS_OUT = 120
LARGE = 100
TINY = 5
_TOKEN = re.compile(r"\(|\)|\[|\]|,|:=|[^\s(),\[\]:]+(?::(?!=)[^\s(),\[\]:]+)*")


@dataclass(frozen=True)
class Block:
    """A block of the chain: its type and the literals of its inputs."""

    name: str
    inputs: str = ""


def program(blocks: Sequence[Block]) -> str:
    """The path goes through the blocks in their order."""
    buffers = "".join(
        f"    fb{n} : SM3_CNC.{b.name}; a{n} : ARRAY[1..{LARGE}] OF SM3_CNC.SMC_GEOINFO;\n"
        for n, b in enumerate(blocks)
    )
    calls = ""
    before = "ADR(queue)"
    for n, block in enumerate(blocks):
        inputs = f", {block.inputs}" if block.inputs else ""
        calls += (
            f"fb{n}(bExecute := TRUE, poqDataIn := {before}, nSizeOutQueue := nCapacity * "
            f"SIZEOF(SM3_CNC.SMC_GEOINFO), pbyBufferOutQueue := ADR(a{n}){inputs});\n"
            f"xError := xError OR fb{n}.bError;\n"
            f"IF fb{n}.bError THEN\n    nError := fb{n}.wErrorID;\nEND_IF\n"
        )
        before = f"fb{n}.poqDataOut"
    return f"""
PROGRAM Main
VAR
    aIn  : ARRAY[0..{OBJECTS_IN - 1}] OF SM3_CNC.SMC_GEOINFO;
    aOut : ARRAY[0..{OBJECTS_OUT - 1}] OF SM3_CNC.SMC_GEOINFO;
    nIn, nGiven, nOut, n : DINT;
    nGives, nTakes : DINT := {LARGE};
    nCapacity : UDINT := {LARGE};
    queue   : SM3_CNC.SMC_OUTQUEUE;
    aBuffer : ARRAY[1..{LARGE}] OF SM3_CNC.SMC_GEOINFO;
{buffers}    pOut : POINTER TO SM3_CNC.SMC_OUTQUEUE;
    xOver, xError, xBegun : BOOL;
    nError, nGenerator : INT;
    vec : SM3_CNC.SMC_VECTOR3D; (* Inputs of a block *)
    pi  : SM3_CNC.SMC_POSINFO;
END_VAR
IF NOT xBegun THEN
    queue.pbyBuffer := ADR(aBuffer);
    SM3_CNC.SMC_SetQueueCapacity(ADR(queue), nCapacity * SIZEOF(SM3_CNC.SMC_GEOINFO));
    FOR n := 0 TO nIn - 1 DO
        IF aIn[n].dLength = 0.0 THEN
            SM3_CNC.SMC_CalcLengthGeo(ADR(aIn[n]));
        END_IF
    END_FOR
    xBegun := TRUE;
END_IF
FOR n := 1 TO nGives DO
    IF nGiven < nIn AND NOT queue.bFull THEN
        IF SM3_CNC.SMC_AppendObj(ADR(queue), ADR(aIn[nGiven])) <> 0 THEN
            nGiven := nGiven + 1;
        END_IF
    END_IF
END_FOR
queue.bEndOfList := nGiven = nIn;
{calls}pOut := {before};
FOR n := 1 TO nTakes DO
    IF pOut <> 0 AND_THEN SM3_CNC.SMC_GetCount(pOut) > 0 AND_THEN nOut < {OBJECTS_OUT} THEN
        aOut[nOut] := SM3_CNC.SMC_GetObj(pOut, 0)^;
        SM3_CNC.SMC_DeleteObj(pOut, 0);
        nOut := nOut + 1;
    END_IF
END_FOR
nGenerator := SEL(pOut <> 0, 0, pOut^.byGenerator);
xOver := pOut <> 0 AND_THEN (pOut^.bEndOfList AND SM3_CNC.SMC_GetCount(pOut) = 0);
END_PROGRAM
"""


@dataclass(frozen=True)
class Result:
    """What came out."""

    objects: list[Geo]
    error: int
    byte: int
    literals: list[str]


def through(
    objects: Sequence[Geo],
    *blocks: Block,
    capacity: int = LARGE,
    gives: int = LARGE,
    takes: int = LARGE,
    cycles: int = 400,
    vec: tuple[float, float, float] = (0.0, 0.0, 0.0),
    pi: Mapping[str, float] | None = None,
) -> Result:
    """The objects behind the blocks, and the error of the block that stopped, 0 for none."""
    with run(program(blocks), cycles=0) as application:
        application.set("Main", nIn=len(objects), nCapacity=capacity, nGives=gives, nTakes=takes)
        application.set("Main", **{f"vec.{axis}": value for axis, value in zip(AXES, vec, strict=False)})
        application.set("Main", **{f"pi.{axis}": value for axis, value in (pi or {}).items()})
        for n, geo in enumerate(objects):
            application.set("Main", **{f"aIn[{n}].{name}": value for name, value in geo.values().items()})
        for _ in range(cycles):
            application.cycle()
            if "TRUE" in (application.literal("Main.xOver"), application.literal("Main.xError")):
                break
        else:
            raise AssertionError("the path does not come to its end")
        count = int(application.literal("Main.nOut"))
        literals = [application.literal(f"Main.aOut[{n}]") for n in range(count)]
        generator = int(application.literal("Main.nGenerator"))
        error = int(application.literal("Main.nError"))
    return Result([parsed(text) for text in literals], error, generator, literals)


def parsed(literal: str) -> Geo:
    """An object from its literal."""
    values = _parse(literal)
    members: dict[str, float] = {}
    for name, value in values.items():
        if isinstance(value, bool | int | float) and name not in ("iMoveType", "b3D", "pPassed"):
            members[name] = float(value)
        elif isinstance(value, list):
            members |= {f"{name}[{n}]": float(item) for n, item in enumerate(value)}
        elif name in ("v4", "v5"):
            members |= {f"{name}.{axis}": float(item) for axis, item in value.items()}
    start, end = (np.array([float(values[p][a]) for a in AXES]) for p in ("piStartPos", "piDestPos"))
    plane = tuple(np.array([float(values[v][a]) for a in AXES[:3]]) for v in ("vX", "vY"))
    return Geo(int(values["iMoveType"]), start, end, members, bool(values["b3D"]), (plane[0], plane[1]))


def _parse(text: str) -> dict[str, Any]:
    tokens = _TOKEN.findall(text)
    place = 0

    def value() -> Any:
        nonlocal place
        token = tokens[place]
        place += 1
        if token == "(":
            found: dict[str, Any] = {}
            while tokens[place] != ")":
                if tokens[place] == ",":
                    place += 1
                    continue
                name = tokens[place]
                place += 2
                found[name] = value()
            place += 1
            return found
        if token == "[":
            items = []
            while tokens[place] != "]":
                if tokens[place] == ",":
                    place += 1
                    continue
                items.append(value())
            place += 1
            return items
        if token in ("TRUE", "FALSE"):
            return token == "TRUE"
        if "#" in token:
            kind, _, digits = token.rpartition("#")
            if kind.rsplit(".", 1)[-1].startswith("16"):
                return int(digits, 16)
            token = digits
        token = token.rsplit(".", 1)[-1] if token[0].isalpha() else token
        return (
            KINDS[token]
            if token in KINDS
            else float(token)
            if not token.lstrip("-").isdigit()
            else int(token)
        )

    found = value()
    assert isinstance(found, dict)
    return found


KINDS = {
    "LIN": 1, "CLW": 2, "CCLW": 3, "SPLINE": 5, "ELLCLW": 8, "ELLCCLW": 9,
    "LINPOS": 100, "LINNODELTA": 101, "LINADDAXES": 102, "INITPOS": 110, "MCOMMAND": 120,
}  # fmt: skip


def length_of(geo: Geo) -> float:
    return geo.member("dLength")


def gaps(objects: Sequence[Geo]) -> float:
    """The largest step between the objects of a path, and between their positions and their curves."""
    largest = 0.0
    moving = [geo for geo in objects if geo.kind != 120]
    for first, second in pairwise(moving):
        largest = max(largest, float(np.abs(first.end - second.start).max()))
    for geo in moving:
        axes = 3 if geo.space else 2
        for u, place in ((0.0, geo.start), (1.0, geo.end)):
            largest = max(largest, float(np.abs(geo.curve(u)[:axes] - place[:axes]).max()))
    return largest


def turn(first: Geo, second: Geo) -> float:
    """Angle between the end of an object and the start of the next [deg]."""
    a, b = first.slope(1.0), second.slope(0.0)
    return math.degrees(math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b)))


def polyline(*points: tuple[float, ...], marks: dict[int, int] | None = None, **members: float) -> list[Geo]:
    """Lines from point to point; marks are byInternMark by the number of the line."""
    given = {"dVel": 100.0, "dVelEnd": 100.0} | members
    return [
        line(position(*first), position(*second), byInternMark=(marks or {}).get(n, 0), **given)
        for n, (first, second) in enumerate(pairwise(points))
    ]


def shape(result: Result) -> list[tuple[int, tuple[float, ...], tuple[float, ...]]]:
    assert result.error == 0
    assert gaps(result.objects) < 1e-9
    return [
        (geo.kind, tuple(geo.start[:2].round(9) + 0.0), tuple(geo.end[:2].round(9) + 0.0))
        for geo in result.objects
    ]


def switches(geo: Geo) -> dict[int, float]:
    return {
        int(geo.member(f"iHelpID[{n}]")): geo.member(f"dHelpPos[{n}]")
        for n in range(3)
        if geo.member(f"iHelpID[{n}]")
    }
