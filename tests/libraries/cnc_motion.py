"""Hand-made objects through SMC_CheckVelocities and an interpolator, and what came out in every cycle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
from tests.libraries.st_program import Program, run

CAPACITY = 400
CALLS = 2000
"""Calls of the interpolator that a program records at most."""
LIN, LINPOS, LINADDAXES, INITPOS, MCOMMAND = 1, 100, 102, 110, 120
ACCEL, CONSTANT, DECEL, FINISHED, WAIT = 2, 3, 4, 5, 6


def chain(capacity: int) -> str:
    """Declarations of a queue with a buffer for so many objects, and the velocity check."""
    return f"""queue   : SM3_CNC.SMC_OUTQUEUE;
    aBuffer : ARRAY[1..{capacity}] OF SM3_CNC.SMC_GEOINFO;
    geo     : SM3_CNC.SMC_GEOINFO;
    check   : SM3_CNC.SMC_CheckVelocities;"""


BUFFER = """queue.pbyBuffer := ADR(aBuffer);
    SM3_CNC.SMC_SetQueueCapacity(ADR(queue), SIZEOF(aBuffer));
    SM3_CNC.SMC_OutQueueInit(ADR(queue));"""
"""Gives the queue its buffer."""
_RECORDED = {
    "aS": "ipo.piSetPosition.dX",
    "aY": "ipo.piSetPosition.dY",
    "aV": "ipo.dVel",
    "aWay": "dWay",
    "aStatus": "ipo.iStatus",
    "aError": "ipo.wErrorID",
    "aM": "ipo.wM",
    "aSwitches": "ipo.dwSwitches",
    "aLastSwitch": "ipo.iLastSwitch",
    "aLine": "ipo.iActObjectSourceNo",
    "aTangent": "ABS(ipo.vecActTangent.dX) + ABS(ipo.vecActTangent.dY) + ABS(ipo.vecActTangent.dZ)",
    "aLeft": "SM3_CNC.SMC_GetCount(ADR(queue))",
    "aWorking": "BOOL_TO_INT(ipo.bWorking)",
}
_ARRAYS = ", ".join([*_RECORDED, "aDone"])
_STORES = "\n    ".join(f"{name}[n] := {expression};" for name, expression in _RECORDED.items())


def program_text(
    block: str = "SMC_Interpolator", declarations: str = "", calls: str = "", producer: str = ""
) -> str:
    """The program with another interpolator, other calls in front of it, or more before the check."""
    done = "bEndOfPath" if block == "SMC_Interpolator2Dir" else "bDone"
    return f"""
PROGRAM Main
VAR
    {chain(CAPACITY)}
    aPath   : ARRAY[0..{CAPACITY - 1}] OF SM3_CNC.SMC_GEOINFO;
    ipo     : SM3_CNC.{block} := (dwIpoTime := 10000);
    {declarations}
    xStarts : BOOL := TRUE;
    xChecks : BOOL := TRUE;
    xCloses : BOOL := TRUE;
    xExecutes : BOOL := TRUE;
    nObjects, nCalls, n, nFed : DINT;
    nPerCall  : DINT := {CAPACITY};  (* Objects that the producer appends before a call *)
    nCheckEvery : DINT := 1;
    nEveryCalls : DINT;
    dWay, dTime : LREAL;
    {_ARRAYS} : ARRAY[0..{CALLS - 1}] OF LREAL;
END_VAR
IF xStarts THEN
    xStarts := FALSE;
    {BUFFER}
    nFed := 0;
    nEveryCalls := 0;
END_IF
FOR n := 0 TO nCalls - 1 DO
    Feed();
    {producer}
    nEveryCalls := nEveryCalls + 1;
    IF xChecks AND nEveryCalls MOD nCheckEvery = 0 THEN
        check(bExecute := TRUE, poqDataIn := ADR(queue));
    END_IF
    {calls}
    ipo(bExecute := xExecutes, poqDataIn := ADR(queue), dLastWayPos := dWay);
    dWay := ipo.dWayPos;
    {_STORES}
    aDone[n] := BOOL_TO_INT(ipo.{done});
END_FOR
END_PROGRAM

METHOD Feed
VAR
    k : DINT;
END_VAR
FOR k := 1 TO nPerCall DO
    IF nFed < nObjects AND NOT queue.bFull THEN
        SM3_CNC.SMC_AppendObj(ADR(queue), ADR(aPath[nFed]));
        nFed := nFed + 1;
    END_IF
END_FOR
queue.bEndOfList := xCloses AND nFed >= nObjects;
END_METHOD
"""


PROGRAM = program_text()


@dataclass(frozen=True)
class Object:
    """An object on the X axis unless `dy` is given; the default dynamics are those of the examples."""

    length: float = 0.0
    velocity: float = 50.0
    acceleration: float = 100.0
    deceleration: float = 100.0
    end: float = 1e9
    kind: int = LIN
    dy: float = 0.0
    members: dict[str, float] = field(default_factory=dict)


class Motion:
    """The running program."""

    def __init__(self, program: Program) -> None:
        self.program = program

    def load(self, path: Sequence[Object]) -> None:
        x = y = 0.0
        for n, item in enumerate(path):
            members: dict[str, float] = {
                "iMoveType": item.kind,
                "piStartPos.dX": x,
                "piStartPos.dY": y,
                "piDestPos.dX": x + (item.length if item.dy == 0.0 else 0.0),
                "piDestPos.dY": y + item.dy,
                "dLength": item.length if item.dy == 0.0 else abs(item.dy),
                "dVel": item.velocity,
                "dVelEnd": item.end,
                "dAccel": item.acceleration,
                "dDecel": item.deceleration,
                "iSourceLine_No": 10 * (n + 1),
                **item.members,
            }
            self.program.set("Main", **{f"aPath[{n}].{name}": value for name, value in members.items()})
            x += item.length if item.dy == 0.0 else 0.0
            y += item.dy
        self.program.set("Main", nObjects=len(path))

    def set(self, **inputs: float | bool | str) -> None:
        self.program.set("Main.ipo", **inputs)

    def calls(self, count: int) -> dict[str, np.ndarray]:
        """So many calls of the interpolator; what it said in each."""
        assert count <= CALLS
        self.program.set("Main", nCalls=count)
        self.program.cycle()
        return {
            name: np.array(self.program.numbers(f"Main.{name}")[:count]) for name in [*_RECORDED, "aDone"]
        }

    def end_velocities(self, count: int) -> list[float]:
        return [float(self.program.literal(f"Main.aBuffer[{n + 1}].dVelEnd")) for n in range(count)]


@contextmanager
def motion(path: Sequence[Object], text: str = PROGRAM, **inputs: float | bool | str) -> Iterator[Motion]:
    """`path` ready to be interpolated."""
    with run(text, cycles=0) as program:
        found = Motion(program)
        found.load(path)
        found.set(**inputs)
        yield found
