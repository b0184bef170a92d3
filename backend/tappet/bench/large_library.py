"""A made-up library of any size, built like a motion library: axes, derived blocks, enumerations."""

from __future__ import annotations

import json
from pathlib import Path

VERSION = "1.0.0.0"
_AXIS = """TYPE {p}AXIS_REF : STRUCT
    eState : {p}State := {p}State.Standstill;
    fPosition, fVelocity, fAcceleration : LREAL;
    aPlan : ARRAY[0..7] OF {p}Segment;
END_STRUCT END_TYPE
"""
_SEGMENT = """TYPE {p}Segment : STRUCT
    fStart, fEnd, fDuration : LREAL;
    eKind : {p}Kind;
END_STRUCT END_TYPE
"""
_STATES = "TYPE {p}State : (Standstill, Discrete, Continuous, Synchronized, Stopping, ErrorStop) END_TYPE\n"
_KINDS = "TYPE {p}Kind : ({p}Rest := 0, {p}Ramp := 10, {p}Cruise := 20) INT; END_TYPE\n"
_LIMITS = "VAR_GLOBAL CONSTANT\n    {p}cMaxVelocity : LREAL := 1E6;\n    {p}cSegments : INT := 7;\nEND_VAR\n"
_AXIS_INTERFACE = """INTERFACE {p}IAxis
METHOD Advance : LREAL
VAR_INPUT fStep : LREAL; END_VAR
END_METHOD
END_INTERFACE
"""
_CLAMP = """FUNCTION {p}Clamp : LREAL
VAR_INPUT fValue, fLimit : LREAL; END_VAR
{p}Clamp := LIMIT(-fLimit, fValue, fLimit);
END_FUNCTION
"""
_BASE = """FUNCTION_BLOCK {p}Base IMPLEMENTS {p}IAxis
VAR_INPUT bExecute : BOOL; END_VAR
VAR_OUTPUT bDone, bBusy, bError : BOOL; nErrorId : DINT; END_VAR
VAR bBefore : BOOL; nStep : INT; END_VAR
bBusy := bExecute AND NOT bDone;
bBefore := bExecute;
METHOD Advance : LREAL
VAR_INPUT fStep : LREAL; END_VAR
Advance := {p}Clamp(fStep, {p}cMaxVelocity);
END_METHOD
END_FUNCTION_BLOCK
"""
_BLOCK_HEAD = """(* Block number {n}: moves an axis in {steps} steps. *)
FUNCTION_BLOCK {p}Move{n} EXTENDS {base}
VAR_IN_OUT Axis : {p}AXIS_REF; END_VAR
VAR_INPUT
    fTarget{n} : LREAL; // end of the movement
    fSpeed : LREAL := 10.0; // velocity
    eKind : {p}Kind := {p}Ramp;
END_VAR
VAR_OUTPUT fRest : LREAL; END_VAR
VAR
    fSum, fPart : LREAL;
    nIndex : INT;
    tWait : TON;
END_VAR
SUPER^();
tWait(IN := bExecute, PT := T#10MS);
"""
_STEP = """IF nStep = {k} AND Axis.eState <> {p}State.ErrorStop THEN
    FOR nIndex := 0 TO {p}cSegments DO
        fPart := Axis.aPlan[nIndex].fEnd - Axis.aPlan[nIndex].fStart;
        fSum := fSum + {p}Clamp(fPart, fSpeed) * {k}.5;
    END_FOR
    nStep := nStep + 1;
END_IF
"""
_BLOCK_END = """Axis.fPosition := THIS^.Advance(fTarget{n});
fRest := fTarget{n} - Axis.fPosition;
END_FUNCTION_BLOCK
"""


def texts(blocks: int, lines: int, prefix: str = "MX_") -> dict[str, str]:
    """So many function blocks with about so many lines in all, by file name."""
    p = prefix
    found = {
        f"{p}AXIS_REF": _AXIS, f"{p}Segment": _SEGMENT, f"{p}State": _STATES, f"{p}Kind": _KINDS,
        f"{p}Limits": _LIMITS, f"{p}IAxis": _AXIS_INTERFACE, f"{p}Clamp": _CLAMP, f"{p}Base": _BASE,
    }  # fmt: skip
    found = {name: text.format(p=p) for name, text in found.items()}
    steps = max(1, (lines // max(blocks, 1) - 18) // 7)
    for n in range(blocks):
        base = f"{p}Base" if n % 5 == 0 else f"{p}Move{n - n % 5}" if n % 5 == 1 else f"{p}Base"
        head = _BLOCK_HEAD.format(n=n, p=p, base=base, steps=steps)
        if n % 5 == 1:  # the block below has these pins already
            head = _without_pins(head, n)
        body = "".join(_STEP.format(k=k, p=p) for k in range(steps))
        found[f"{p}Move{n}"] = head + body + _BLOCK_END.format(n=n, p=p)
    return found


def _without_pins(head: str, n: int) -> str:
    """The head of a block whose base has the pins and variables already."""
    lines = head.splitlines(keepends=True)
    start = next(i for i, line in enumerate(lines) if line.startswith("VAR_IN_OUT"))
    end = next(i for i, line in enumerate(lines) if line.startswith("SUPER"))
    own = f"VAR_INPUT fTarget{n} : LREAL; END_VAR\n"
    return "".join([*lines[:start], own, "SUPER^(Axis := Axis);\n", *lines[end + 1 :]])


def install(folder: Path, blocks: int, lines: int, name: str = "MotionLike", prefix: str = "MX_") -> None:
    """Writes the library where `TAPPET_LIBRARIES` points to."""
    place = folder / name / VERSION
    place.mkdir(parents=True)
    facts = {
        "name": name,
        "version": VERSION,
        "namespace": name,
        "company": "Tests",
        "description": "Blocks as a motion library has them",
        "requires": [{"name": "Standard", "version": "*"}],
    }
    (place / "library.json").write_text(json.dumps(facts), encoding="utf-8")
    for stem, text in texts(blocks, lines, prefix).items():
        (place / f"{stem}.st").write_text(text, encoding="utf-8")
