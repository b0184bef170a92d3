"""SM3_CNC: the queue of path objects, against a list."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.st_program import run

CAPACITY = 10
OPERATIONS = 200
APPEND, DELETE, RESTORE, INITIALISE = range(4)
PROGRAM = f"""
PROGRAM Main
VAR
    queue   : SM3_CNC.SMC_OUTQUEUE;
    aBuffer : ARRAY[1..{CAPACITY}] OF SM3_CNC.SMC_GEOINFO;
    geo     : SM3_CNC.SMC_GEOINFO;
    pGeo    : POINTER TO SM3_CNC.SMC_GEOINFO;
    nSteps, n, k : DINT;
    aKind, aWhich, aAnswer, aCount, aLast : ARRAY[0..{OPERATIONS - 1}] OF DINT;
    aFull, aEnd : ARRAY[0..{OPERATIONS - 1}] OF DINT;
    aPicture : ARRAY[0..{OPERATIONS - 1}] OF LREAL; (* Of the objects: a sum of place times number *)
    nNext : DINT;
END_VAR
queue.pbyBuffer := ADR(aBuffer);
SM3_CNC.SMC_SetQueueCapacity(ADR(queue), SIZEOF(aBuffer));
SM3_CNC.SMC_OutQueueInit(ADR(queue));
nNext := 0;
FOR n := 0 TO nSteps - 1 DO
    CASE aKind[n] OF
        {APPEND}:
            nNext := nNext + 1;
            geo.iObjNo := nNext;
            pGeo := SM3_CNC.SMC_AppendObj(ADR(queue), ADR(geo));
            aAnswer[n] := 0;
            IF pGeo <> 0 THEN
                aAnswer[n] := pGeo^.iObjNo;
            END_IF
        {DELETE}:
            aAnswer[n] := BOOL_TO_DINT(SM3_CNC.SMC_DeleteObj(ADR(queue), DINT_TO_UINT(aWhich[n])));
        {RESTORE}:
            aAnswer[n] := BOOL_TO_DINT(SM3_CNC.SMC_RestoreQueue(TRUE, ADR(queue)));
        {INITIALISE}:
            SM3_CNC.SMC_OutQueueInit(ADR(queue));
    END_CASE
    aCount[n] := SM3_CNC.SMC_GetCount(ADR(queue));
    aFull[n] := BOOL_TO_DINT(queue.bFull);
    aEnd[n] := BOOL_TO_DINT(queue.bEndOfList);
    aPicture[n] := 0;
    FOR k := 0 TO aCount[n] DO
        pGeo := SM3_CNC.SMC_GetObj(ADR(queue), DINT_TO_UINT(k));
        IF pGeo <> 0 THEN
            aPicture[n] := aPicture[n] + (k + 1) * pGeo^.iObjNo;
        END_IF
    END_FOR
    pGeo := SM3_CNC.SMC_GetObjFromEnd(ADR(queue), 0);
    aLast[n] := 0;
    IF pGeo <> 0 THEN
        aLast[n] := pGeo^.iObjNo;
    END_IF
END_FOR
END_PROGRAM
"""


class Reference:
    """A queue as a list; what was removed can come back until its place is needed."""

    def __init__(self) -> None:
        self.stored: list[int] = []
        self.first = 0
        self.restorable = True
        self.number = 0
        self.end = False

    @property
    def waiting(self) -> list[int]:
        return self.stored[self.first :]

    def step(self, kind: int, which: int) -> int:
        if kind == APPEND:
            self.number += 1
            if len(self.waiting) >= CAPACITY - 1:
                return 0
            self.stored.append(self.number)
            if len(self.stored) >= CAPACITY:
                self.restorable = False
            return self.number
        if kind == DELETE:
            if which >= len(self.waiting):
                return 0
            removed = self.stored.pop(self.first + which)
            self.stored.insert(self.first, removed)
            self.first += 1
            self.restorable = self.restorable and which == 0
            return 1
        if kind == RESTORE:
            if not self.restorable:
                return 0
            self.first = 0
            self.end = True
            return 1
        number = self.number
        self.__init__()  # type: ignore[misc]
        self.number = number
        return 0


STEP = st.tuples(
    st.sampled_from([APPEND] * 6 + [DELETE] * 4 + [RESTORE, INITIALISE]), st.sampled_from([0, 0, 0, 1, 5, 9])
)


@settings(max_examples=60, deadline=None)
@given(st.lists(STEP, min_size=1, max_size=OPERATIONS))
def test_any_use_agrees_with_a_list(steps: list[tuple[int, int]]) -> None:
    """Spec CNCR-10, CNCR-11, CNCR-16, CNCR-17: count, order, bFull, removal at any place, restoring."""
    with run(PROGRAM, cycles=0) as program:
        program.set("Main", nSteps=len(steps))
        for n, (kind, which) in enumerate(steps):
            program.set("Main", **{f"aKind[{n}]": kind, f"aWhich[{n}]": which})
        program.cycle()
        found = {
            name: program.numbers(f"Main.{name}")
            for name in ("aAnswer", "aCount", "aFull", "aEnd", "aPicture", "aLast")
        }
    reference = Reference()
    full = False
    for n, (kind, which) in enumerate(steps):
        answer = reference.step(kind, which)
        waiting = reference.waiting
        if kind == INITIALISE:
            full = False
        elif answer:
            full = len(waiting) + 3 >= CAPACITY
        assert found["aAnswer"][n] == answer
        assert found["aCount"][n] == len(waiting)
        assert found["aFull"][n] == full
        assert found["aEnd"][n] == reference.end
        assert found["aPicture"][n] == sum((k + 1) * number for k, number in enumerate(waiting))
        assert found["aLast"][n] == (waiting[-1] if waiting else 0)


def test_the_example_of_the_specification() -> None:
    """Spec cnc_runtime EX-02."""
    steps = [(APPEND, 0)] * 7 + [(DELETE, 7), (DELETE, 0)]
    with run(PROGRAM, cycles=0) as program:
        program.set("Main", nSteps=len(steps))
        for n, (kind, which) in enumerate(steps):
            program.set("Main", **{f"aKind[{n}]": kind, f"aWhich[{n}]": which})
        program.cycle()
        assert program.numbers("Main.aFull")[5:9] == [0, 1, 1, 0]
        assert program.numbers("Main.aCount")[5:9] == [6, 7, 7, 6]
        assert program.numbers("Main.aAnswer")[7:9] == [0, 1]


USES = {
    "poq": "POINTER TO SM3_CNC.SMC_OUTQUEUE := 0",
    "no buffer": "SM3_CNC.SMC_OUTQUEUE",
    "other tag": "SM3_CNC.SMC_OUTQUEUE := (wOUTQUEUEStructID := 1)",
}


@pytest.mark.parametrize("what", USES)
def test_what_is_no_queue_holds_nothing(what: str) -> None:
    """Spec CNCR-14: a pointer to nothing, a queue without a buffer, a wrong tag."""
    pointer = "q" if what == "poq" else "ADR(q)"
    buffer = "q.pbyBuffer := ADR(aBuffer); q.nCapacity := 10;" if what == "other tag" else ""
    text = f"""
PROGRAM Main
VAR
    q : {USES[what]};
    aBuffer : ARRAY[1..10] OF SM3_CNC.SMC_GEOINFO;
    geo : SM3_CNC.SMC_GEOINFO;
    xNothing : BOOL;
END_VAR
{buffer}
xNothing := SM3_CNC.SMC_AppendObj({pointer}, ADR(geo)) = 0 AND NOT SM3_CNC.SMC_DeleteObj({pointer}, 0)
    AND SM3_CNC.SMC_GetCount({pointer}) = 0 AND SM3_CNC.SMC_GetObj({pointer}, 0) = 0
    AND SM3_CNC.SMC_GetObjFromEnd({pointer}, 0) = 0 AND NOT SM3_CNC.SMC_RestoreQueue(TRUE, {pointer});
END_PROGRAM
"""
    with run(text, cycles=1) as program:
        assert program.literal("Main.xNothing") == "TRUE"
