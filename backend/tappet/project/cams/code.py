"""The ST that is made of cams: global variables that programs use (CAM-83, CAM-90, CAM-91; cam EX-09)."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence

from tappet.project.cams.checks import law_name
from tappet.project.cams.elements import by_bend, equidistant, xyva_points
from tappet.project.cams.table import CamTable, CamTappet, number_text

LIBRARY = "SM3_Basic"
VARIABLES = "IoConfig_{name}"
"""The list of global variables that a cam is; each has its own, so that an online change moves no other."""
LIST = "_SMC_CAM_LIST"
"""Pointers to all cams of an application."""
_LONGEST_NAME = 80
"""Characters of strCAMName."""
_LREAL = 6
"""byVarType."""
_BY_TYPE = {"one_dimensional": 1, "two_dimensional": 2, "polynomial": 3, "segments": 4}
_ACTIONS = {"on": "TAPPETACTION_on", "off": "TAPPETACTION_off", "invert": "TAPPETACTION_inv"}


def generated_code(name: str, cam: CamTable) -> str:
    """What the editor shows: the declarations of one cam."""
    lines = "\n".join(variables(name, cam))
    return f"VAR_GLOBAL\n{lines}\nEND_VAR"


def declarations(name: str, cam: CamTable) -> str:
    """The same for the compiler, without the keywords around.

    An online change takes over a cam that was edited, and leaves the others as the program has them: the
    attribute has a value that stands for the cam.
    """
    found = variables(name, cam)
    state = hashlib.blake2s("".join(found).encode(), digest_size=8).hexdigest()
    mark = f"    {{attribute 'init_on_onlchange' := '{state}'}}\n"
    return "\n".join(mark + one for one in found)


def cam_list(names: Sequence[str]) -> str:
    """The declaration of the list of all cams."""
    pointers = ", ".join(f"ADR({name})" for name in names)
    state = hashlib.blake2s(pointers.encode(), digest_size=8).hexdigest()
    return (
        f"    {{attribute 'init_on_onlchange' := '{state}'}}\n"
        f"    {LIST} : ARRAY[0..{len(names) - 1}] OF POINTER TO MC_CAM_REF := [{pointers}];"
    )


def variables(name: str, cam: CamTable) -> list[str]:
    """The declarations of the variables that a cam is."""
    elements, count = _elements(name, cam)
    tappets = [entry for track in cam.tracks for one in track.tappets for entry in _entries(track.id, one)]
    first, last = cam.domain
    facts = [f"byType:={_BY_TYPE[cam.compile_format]}", f"nElements:={count}"]
    facts += [f"xStart:={number_text(first)}", f"xEnd:={number_text(last)}", f"nTappets:={len(tappets)}"]
    facts += [f"strCAMName:='{name[:_LONGEST_NAME]}'", f"pce:=ADR({name}_A)"]
    if cam.compile_format in ("one_dimensional", "two_dimensional"):
        facts += [f"byVarType:={_LREAL}", f"byInterpolationQuality:={3 if cam.cubic else 1}"]
    found = [elements]
    if tappets:
        found.append(_array(f"{name}_T", "SMC_CAMTappet", tappets))
        facts.append(f"pt:=ADR({name}_T)")
    found.append(f"    {name} : MC_CAM_REF := ({', '.join(facts)});")
    return found


def _elements(name: str, cam: CamTable) -> tuple[str, int]:
    """The declaration of the elements, and how many there are."""
    if cam.compile_format == "polynomial":
        points = xyva_points(cam)
        rows = [_values(dX=p.x, dY=p.y, dV=p.v, dA=p.a) for p in points]
        return _array(f"{name}_A", "SMC_CAMXYVA", rows), len(rows)
    if cam.compile_format == "segments":
        rows = [
            f"({_members(dX0=left.x, dY0=left.y, dV0=left.v, dA0=left.a, dJ0=left.j)},"
            f"{_members(dX1=right.x, dY1=right.y, dV1=right.v, dA1=right.a, dJ1=right.j)},"
            f"dLambda:={number_text(segment.inflection)},"
            f"eType:=SMC_CAM_SEGMENT_TYPE.{law_name(segment.law)})"
            for left, segment, right in cam.pieces()
        ]
        return _array(f"{name}_A", "SMC_CAM_SEGMENT", rows), len(rows)
    return _table(name, cam), cam.table_size


def _table(name: str, cam: CamTable) -> str:
    """A table in the units of the editor; the slave's ranges only have to be equal and not empty."""
    pairs = cam.compile_format == "two_dimensional"
    points = (by_bend if pairs else equidistant)(cam, cam.table_size)
    if pairs:
        rows = [f"[{number_text(x)},{number_text(y)}]" for x, y in points]
    else:
        rows = [number_text(y) for _, y in points]
    first, last = cam.domain
    limits = [
        _members(fEditorMasterMin=first, fEditorMasterMax=last, fEditorSlaveMin=0.0, fEditorSlaveMax=1.0),
        _members(fTableMasterMin=first, fTableMasterMax=last, fTableSlaveMin=0.0, fTableSlaveMax=1.0),
    ]
    kind = f"SMC_CAMTable_LREAL_{cam.table_size}_{2 if pairs else 1}"
    content = ",\n        ".join(rows)
    return f"    {name}_A : {kind} := (Table:=[\n        {content}],\n        {','.join(limits)});"


def _entries(track: int, tappet: CamTappet) -> Iterable[str]:
    """One for both directions where they do the same, else one for each that does something."""
    if tappet.positive == tappet.negative:
        passes = [("TAPPET_all", tappet.positive)]
    else:
        passes = [("TAPPET_pos", tappet.positive), ("TAPPET_neg", tappet.negative)]
    for direction, action in passes:
        if action != "none":
            yield f"(ctt:={direction},cta:={_ACTIONS[action]},iGroupID:={track},x:={number_text(tappet.x)})"


def _array(name: str, kind: str, rows: Sequence[str]) -> str:
    content = ",\n        ".join(rows)
    return f"    {name} : ARRAY[0..{len(rows) - 1}] OF {kind} := [\n        {content}];"


def _values(**members: float) -> str:
    return f"({_members(**members)})"


def _members(**members: float) -> str:
    return ",".join(f"{name}:={number_text(value)}" for name, value in members.items())
