"""The ST that is made of cams: global variables that programs use (CAM-83, CAM-90, CAM-91; cam EX-09)."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

from tappet.project.cams.checks import law_name
from tappet.project.cams.table import LAWS, CamTable, number_text
from tappet.project.cams.variables import BY_TYPE, ELEMENTS, Row, is_table, variables_of

LIBRARY = "SM3_Basic"
VARIABLES = "IoConfig_{name}"
"""The list of global variables that a cam is; each has its own, so that an online change moves no other."""
LIST_VARIABLES = "IoConfig_CamList"
LIST = "_SMC_CAM_LIST"
"""Pointers to all cams of an application, in a list of variables of its own."""
_LONGEST_NAME = 80
"""Characters of strCAMName."""
_LREAL = 6
"""byVarType."""
_ENUMERATORS = {
    "eType": tuple(f"SMC_CAM_SEGMENT_TYPE.{law_name(law)}" for law in LAWS),
    "ctt": ("TAPPET_pos", "TAPPET_all", "TAPPET_neg"),
    "cta": ("TAPPETACTION_on", "TAPPETACTION_off", "TAPPETACTION_inv"),
}


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
    values = variables_of(cam)
    facts = [
        f"byType:={BY_TYPE[cam.compile_format]}",
        *_assignments(_but(values.cam, "byInterpolationQuality")),
    ]
    facts += [f"strCAMName:='{name[:_LONGEST_NAME]}'", f"pce:=ADR({name}_A)"]
    if is_table(cam):
        facts += [f"byVarType:={_LREAL}", f"byInterpolationQuality:={values.cam['byInterpolationQuality']}"]
        found = [_table(name, cam, values.elements[0])]
    else:
        found = [_array(f"{name}_A", ELEMENTS[cam.compile_format], values.elements)]
    if values.tappets:
        found.append(_array(f"{name}_T", "SMC_CAMTappet", values.tappets))
        facts.append(f"pt:=ADR({name}_T)")
    found.append(f"    {name} : MC_CAM_REF := ({', '.join(facts)});")
    return found


def _table(name: str, cam: CamTable, values: Row) -> str:
    pairs = cam.compile_format == "two_dimensional"
    table = values["Table"]
    assert isinstance(table, list)
    rows = [_pair(row) if isinstance(row, list) else number_text(row) for row in table]
    kind = f"SMC_CAMTable_LREAL_{cam.table_size}_{2 if pairs else 1}"
    content = ",\n        ".join(rows)
    limits = _members(_but(values, "Table"))
    return f"    {name}_A : {kind} := (Table:=[\n        {content}],\n        {limits});"


def _pair(row: list[float]) -> str:
    return f"[{','.join(map(number_text, row))}]"


def _but(row: Row, name: str) -> Row:
    return {key: value for key, value in row.items() if key != name}


def _array(name: str, kind: str, rows: Sequence[Row]) -> str:
    content = ",\n        ".join(f"({_members(row)})" for row in rows)
    return f"    {name} : ARRAY[0..{len(rows) - 1}] OF {kind} := [\n        {content}];"


def _members(row: Row) -> str:
    return ",".join(_assignments(row))


def _assignments(row: Row) -> list[str]:
    return [f"{name}:={_member(name, value)}" for name, value in row.items() if not isinstance(value, list)]


def _member(name: str, value: float) -> str:
    known = _ENUMERATORS.get(name)
    return number_text(float(value)) if known is None else known[int(value)]
