"""The ST of the program that makes a path: decoder, preprocessing blocks, velocity check, interpolator.

One text for each chain of blocks; what the blocks are given is written into the running program.
"""

from __future__ import annotations

from collections.abc import Sequence

from tappet.motion.path_blocks import PathBlock

RING = 65_536
"""Words of a longer program go through a ring of so many."""
WINDOW = 4096
"""Objects that the velocity check looks ahead at most; a quarter less when objects are taken."""
TAKEN = 1024
"""Objects that one cycle gives at most."""
SAMPLES = 2048
"""Positions that one cycle gives at most."""
SAMPLE_FIELDS = (
    *("piSetPosition.dX", "piSetPosition.dY", "piSetPosition.dZ", "piSetPosition.dA", "piSetPosition.dB"),
    *("piSetPosition.dC", "piSetPosition.dA1", "piSetPosition.dA2", "piSetPosition.dA3"),
    *("piSetPosition.dA4", "piSetPosition.dA5", "dVel", "iActObjectSourceNo", "iStatus"),
)
"""Outputs of SMC_Interpolator that a sample has."""
MOST_VARIABLES = 10_000
MOST_ROUNDS = 1000
"""Rounds of one cycle, so that a program without movements ends the cycle, too."""


def program_text(blocks: Sequence[PathBlock], queue: int) -> str:
    """The program for a chain; `queue`: objects of the queues in it."""
    declarations, calls = [], []
    source = "fbDecoder"
    last = max((n for n, block in enumerate(blocks) if block.buffered), default=-1)
    for number, block in enumerate(blocks):
        size = WINDOW if number == last else queue
        declarations.append(f"    fb{number} : {block.name};")
        facts = f"bExecute := xExecute, poqDataIn := {source}.poqDataOut"
        if block.buffered:
            declarations.append(f"    aBuffer{number} : ARRAY[0..{size - 1}] OF SMC_GEOINFO;")
            facts += f", nSizeOutQueue := SIZEOF(aBuffer{number}), pbyBufferOutQueue := ADR(aBuffer{number})"
        calls.append(f"fb{number}({facts});")
        calls.append(f"Watch(fb{number}.bError, fb{number}.wErrorID, {number + 1});")
        source = f"fb{number}"
    declared, chain = "\n".join(declarations), "\n".join(calls)
    samples = "\n".join(
        f"    afSamples[diSamples, {n}] := fbInterpolator.{field};" for n, field in enumerate(SAMPLE_FIELDS)
    )
    return f"""PROGRAM Main
VAR
    xExecute      : BOOL;
    xInterpolates : BOOL; (* Positions are wanted, not objects *)
    dwIpoTime     : DWORD; (* [us] *)
    xStepSuppress : BOOL;
    prog          : SMC_CNC_REF;
    aWords        : ARRAY[0..{RING - 1}] OF SMC_GCODE_WORD;
    afVariables   : ARRAY[0..{MOST_VARIABLES - 1}] OF LREAL;
    stParameters  : SMC_M_PARAMETERS; (* Of M functions whose parameters are a variable *)
    pVariables, pParameters : LWORD;
    fbDecoder     : SMC_NCDecoder;
    aDecoded      : ARRAY[0..{(queue if last >= 0 else WINDOW) - 1}] OF SMC_GEOINFO;
{declared}
    fbCheck       : SMC_CheckVelocities;
    fbInterpolator : SMC_Interpolator;
    poqLast       : POINTER TO SMC_OUTQUEUE;
    aTaken        : ARRAY[0..{TAKEN - 1}] OF SMC_GEOINFO;
    diTaken       : DINT;
    afSamples     : ARRAY[0..{SAMPLES - 1}, 0..{len(SAMPLE_FIELDS) - 1}] OF LREAL;
    diSamples     : DINT;
    diRounds      : DINT;
    xEnded        : BOOL; (* Nothing more comes *)
    xHungry       : BOOL; (* The decoder waits for words *)
    iFault        : INT := -1; (* Who failed: 0 decoder, from 1 blocks, -2 velocity check, -3 interpolator *)
    eFault        : SM3_Basic.SMC_ERROR;
    sFault        : STRING(255);
    diFaultLine   : DINT;
END_VAR
prog.pgc := ADR(aWords);
pVariables := ADR(afVariables);
pParameters := ADR(stParameters);
diTaken := 0;
diSamples := 0;
diRounds := 0;
xHungry := FALSE;
IF NOT xExecute THEN
    Prepare();
    fbInterpolator(bExecute := FALSE);
    RETURN;
END_IF
WHILE NOT xEnded AND NOT xHungry AND (iFault = -1 OR iFault = 0)
      AND diRounds < {MOST_ROUNDS} AND diTaken < {TAKEN} AND diSamples < {SAMPLES}
DO
    diRounds := diRounds + 1;
    IF NOT IsReady() AND NOT IsClosed() THEN
        Prepare();
    END_IF
    IF IsReady() OR IsClosed() THEN
        xHungry := FALSE;
        IF SMC_GetCount(poqLast) = 0 AND NOT fbInterpolator.bWorking THEN
            xEnded := TRUE;
        ELSIF xInterpolates THEN
            Move();
        ELSE
            Take();
        END_IF
    END_IF
END_WHILE

(* Whether objects may be taken: the queue is full, closed, or ends with a synchronisation. *)
METHOD PRIVATE IsReady : BOOL
VAR
    pObject : POINTER TO SMC_GEOINFO;
END_VAR
IF poqLast <> 0 THEN
    pObject := SMC_GetObjFromEnd(poqLast, 0);
    IsReady := pObject <> 0 AND_THEN (poqLast^.bEndOfList OR poqLast^.bFull OR pObject^.pPassed <> 0);
END_IF
END_METHOD

(* Whether nothing more comes into the queue. *)
METHOD PRIVATE IsClosed : BOOL
IsClosed := poqLast <> 0 AND_THEN poqLast^.bEndOfList;
END_METHOD

(* One call of each block that makes the path. *)
METHOD PRIVATE Prepare
fbDecoder(ncprog := prog, bExecute := xExecute, bStepSuppress := xStepSuppress,
          nSizeOutQueue := SIZEOF(aDecoded), pbyBufferOutQueue := ADR(aDecoded));
IF fbDecoder.bError AND iFault = -1 THEN
    diFaultLine := fbDecoder.iLineNumberDecoded;
    fbDecoder.poqDataOut^.bEndOfList := TRUE; (* What comes before is a path *)
END_IF
Watch(fbDecoder.bError, fbDecoder.wErrorID, 0);
{chain}
poqLast := {source}.poqDataOut;
fbCheck(bExecute := xExecute, poqDataIn := poqLast);
Watch(fbCheck.bError, fbCheck.wErrorID, -2);
xHungry := fbDecoder.bBusy AND prog.udiBuffer <> 16#FFFFFFFF
           AND (prog.bRestart OR prog.diReadPos = prog.nElements);
END_METHOD

(* The first fault counts. *)
METHOD PRIVATE Watch
VAR_INPUT
    xError : BOOL;
    eError : SM3_Basic.SMC_ERROR;
    iWho   : INT;
END_VAR
IF xError AND iFault = -1 THEN
    iFault := iWho;
    eFault := eError;
    sFault := SM3_Basic.SMC_ErrorString(eError, SM3_Basic.SMC_LANGUAGE_TYPE.english);
END_IF
END_METHOD

(* Takes objects from the front, and leaves enough that the next ones are planned with the path in view. *)
METHOD PRIVATE Take
VAR
    pObject : POINTER TO SMC_GEOINFO;
    diBatch : DINT;
END_VAR
diBatch := {WINDOW // 4};
pObject := SMC_GetObj(poqLast, 0);
WHILE pObject <> 0 AND diTaken < {TAKEN} AND diBatch > 0 DO
    IF pObject^.pPassed <> 0 THEN
        pObject^.pPassed^ := TRUE;
        pObject^.pPassed := 0;
    END_IF
    aTaken[diTaken] := pObject^;
    diTaken := diTaken + 1;
    diBatch := diBatch - 1;
    SMC_DeleteObj(poqLast, 0);
    pObject := SMC_GetObj(poqLast, 0);
END_WHILE
END_METHOD

(* The position of the next cycle of the interpolator; M functions are acknowledged at once. *)
METHOD PRIVATE Move
fbInterpolator(bExecute := TRUE, poqDataIn := poqLast, dwIpoTime := dwIpoTime,
               bAcknM := fbInterpolator.wM <> 0);
IF fbInterpolator.bError AND iFault = -1 THEN
    diFaultLine := fbInterpolator.iActObjectSourceNo;
END_IF
Watch(fbInterpolator.bError, fbInterpolator.wErrorID, -3);
xEnded := fbInterpolator.bDone OR fbInterpolator.bError;
IF fbInterpolator.bWorking OR fbInterpolator.bDone THEN
{samples}
    diSamples := diSamples + 1;
END_IF
END_METHOD
END_PROGRAM
"""
