"""An application whose declarations the tests edit: everything that code can rest on besides its own text."""

from __future__ import annotations

import re
from collections.abc import Mapping

from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source

OPTIONS = BuildOptions(level=1)
TASKS = (Task("T", programs=("PLC_PRG", "P_Second")),)

OBJECTS: dict[str, str] = {
    "Limits": "VAR_GLOBAL CONSTANT\n{limits}    nLast : DINT := 3; lrGain : LREAL := {gain};\nEND_VAR",
    "GVL": (
        "VAR_GLOBAL\n{gvl}    total : DINT; table : ARRAY [0..4] OF ST_Point; log : STRING(40);\n"
        "END_VAR\nVAR_GLOBAL RETAIN\n{retain}    kept : DINT := 5;\nEND_VAR"
    ),
    "E_State": "TYPE E_State : ({enum}) {enum_base}; END_TYPE",
    "ST_Point": "TYPE ST_Point : STRUCT\n{point}    x : DINT := {point_x}; y : LREAL;\nEND_STRUCT END_TYPE",
    "ST_Box": (
        "TYPE ST_Box : STRUCT\n    low : ST_Point; high : ST_Point := (x := nLast);\n"
        "    where : POINTER TO DINT := ADR(GVL.total);\nEND_STRUCT END_TYPE"
    ),
    "I_Shape": "INTERFACE I_Shape\nMETHOD Area : DINT\nVAR_INPUT\n{area_in}END_VAR\nEND_METHOD\n"
    "END_INTERFACE",
    "FB_Core": (
        "FUNCTION_BLOCK FB_Core\nVAR_INPUT\n{core_in}    n : DINT;\nEND_VAR\n"
        "VAR_INPUT {attribute 'initialize_on_call'} fresh : DINT := {fresh}; END_VAR\n"
        "VAR_OUTPUT q : DINT; END_VAR\nVAR\n{core}    calls : DINT; row : ARRAY [0..3] OF DINT; "
        "i : DINT;\nEND_VAR\n"
        "calls := calls + 1; q := q + n + fresh; fresh := 100;\n"
        "FOR i := 0 TO 3 DO row[i] := row[i] + n; calls := calls + 1; END_FOR\nEND_FUNCTION_BLOCK"
    ),
    "FB_Made": (
        "FUNCTION_BLOCK FB_Made\nVAR_INPUT made : DINT; {made}END_VAR\nMETHOD FB_Init : BOOL\n"
        "VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; first : DINT := {first}; END_VAR\n"
        "made := made + first;\nEND_METHOD\nEND_FUNCTION_BLOCK"
    ),
    "FB_Shape": (
        "FUNCTION_BLOCK FB_Shape IMPLEMENTS I_Shape\nVAR\n{shape}    core : FB_Core; box : ST_Box; "
        "own : FB_Made(first := 4);\n"
        "END_VAR\nVAR_STAT count : DINT; END_VAR\nVAR_TEMP t : ST_Point; END_VAR\n"
        "core(n := box.low.x + t.x); count := count + 1; own.made := own.made + 1;\nEND_FUNCTION_BLOCK"
    ),
    "FB_Shape.Area": "METHOD Area : DINT\nVAR_INPUT\n{area_in}END_VAR\n"
    "Area := core.q + {area}count;\nEND_METHOD",
    "FB_Shape.Move": (
        "METHOD Move : ST_Point\nVAR_INPUT p : ST_Point; by : DINT := {by}; END_VAR\n"
        "VAR_IN_OUT c : FB_Core; END_VAR\nVAR local : ST_Box; END_VAR\n"
        "Move := p; Move.x := Move.x + by + c.q; c.n := local.high.x; box.high := p;\nEND_METHOD"
    ),
    "FB_Square": (
        "FUNCTION_BLOCK FB_Square EXTENDS FB_Shape\nVAR\n{square}    side : DINT := 2;\nEND_VAR\n"
        "SUPER^(); side := side + core.calls;\nEND_FUNCTION_BLOCK"
    ),
    "FB_Square.Area": "METHOD Area : DINT\nVAR_INPUT\n{area_in}END_VAR\nArea := side * side;\nEND_METHOD",
    "F_Sum": (
        "FUNCTION F_Sum : DINT\nVAR_INPUT\n    a : DINT; b : DINT := {sum_b};\n{sum_in}END_VAR\n"
        "VAR i : DINT; END_VAR\n"
        "FOR i := 0 TO nLast DO F_Sum := F_Sum + GVL.table[i].x; END_FOR F_Sum := F_Sum + a + b;\n"
        "END_FUNCTION"
    ),
    "F_State": "FUNCTION F_State : DINT\nVAR_INPUT s : E_State; END_VAR\nF_State := TO_DINT(s);\n"
    "END_FUNCTION",
    "F_Far": "FUNCTION F_Far : DINT\nVAR_INPUT k : DINT; END_VAR\nF_Far := k * 2;\nEND_FUNCTION",
    "P_Second": (
        "PROGRAM P_Second\nVAR\n{second}    a : FB_Core; many : ARRAY [1..3] OF FB_Core; k : INT; "
        "s : E_State; "
        "shapes : ARRAY [0..1] OF FB_Square;\nEND_VAR\n"
        "a(n := GVL.kept); FOR k := 1 TO 3 DO many[k](n := k, fresh := k); "
        "GVL.total := GVL.total + many[k].q; "
        "END_FOR\nshapes[1](); s := E_State.Run; GVL.kept := GVL.kept + F_Far(1) + F_State(s);\nEND_PROGRAM"
    ),
    "PLC_PRG": (
        "PROGRAM PLC_PRG\nVAR\n{prg}    shape : FB_Shape; square : FB_Square; i : I_Shape; "
        "p : POINTER TO ST_Point;\n"
        "    boxes : ARRAY [0..1] OF ST_Box; core : FB_Core; sum : DINT; text : STRING(30); r : LREAL;\n"
        "    state : E_State; k : DINT; word AT %MW4 : INT;\nEND_VAR\n"
        "shape(); square(); core(n := 2);\np := ADR(boxes[1].high); p^.x := p^.x + 1; i := square;\n"
        "sum := sum + i.Area({area_args}) + F_Sum(sum{sum_args}) + boxes[1].high.x + boxes[0].where^;\n"
        "boxes[0].low := square.Move(p := boxes[1].high, c := core);\n"
        "FOR k := 0 TO nLast DO GVL.table[k].x := GVL.table[k].x + k; sum := sum + 1; END_FOR\n"
        "CASE state OF E_State.Idle: state := E_State.Run; E_State.Run: state := E_State.Idle; END_CASE\n"
        "r := r + lrGain; text := CONCAT(text, 'ab'); GVL.log := text; word := word + 1;\nEND_PROGRAM"
    ),
}
"""Texts with places for what is edited."""

CHOICES: dict[str, list[str]] = {
    "limits": ["", "    nOther : DINT := 7;\n", "    aNames : ARRAY [0..1] OF STRING(5) := ['a', 'b'];\n"],
    "gain": ["0.5", "0.25", "2.0"],
    "gvl": ["", "    first : DINT := 9;\n", "    first : FB_Made(3); second : STRING(200) := 'x';\n"],
    "retain": ["", "    more : LREAL := 1.5;\n"],
    "enum": ["Idle, Run", "Idle, Wait, Run", "Idle := 3, Run := 2", "Run, Idle"],
    "enum_base": ["", "UINT", "LINT"],
    "point": ["", "    tag : STRING(6) := 'tag';\n", "    z : LREAL := 0.5;\n", "    state : E_State;\n"],
    "point_x": ["0", "4", "nLast + 1"],
    "area_in": ["", "    scale : DINT;\n", "    scale : LREAL; off : DINT;\n"],
    "area_args": ["", "scale := 3", "4, off := nLast"],
    "area": ["", "10 * "],
    "core_in": ["", "    more : DINT := 1;\n", "    text : STRING(10);\n"],
    "fresh": ["7", "8", "nLast"],
    "core": ["", "    deep : FB_Made(first := 2);\n", "    last : LREAL;\n", "    when : TON;\n"],
    "made": ["", "more : LREAL; ", "point : ST_Point; "],
    "first": ["1", "nLast"],
    "shape": ["", "    lead : BOOL;\n", "    points : ARRAY [0..nLast] OF ST_Point;\n"],
    "by": ["1", "nLast"],
    "square": ["", "    extra : DINT := 6;\n", "    square2 : FB_Core;\n"],
    "sum_in": ["", "    z : DINT := 1;\n", "    z : ST_Point;\n"],
    "sum_args": ["", "", ", z := boxes[0].low"],
    "sum_b": ["2", "nLast", "TO_DINT(lrGain * 4.0)"],
    "second": ["", "    lead : INT;\n", "    lead : FB_Shape;\n", "    lead AT %MW8 : INT := 4;\n"],
    "prg": [
        "", "    lead : LREAL;\n", "    lead : ARRAY [0..nLast] OF FB_Core;\n",
        "    m AT %MD20 : DINT := 6;\n",
    ],
}  # fmt: skip
_TIED = {"area_args": "area_in", "sum_args": "sum_in"}
"""Places that follow the choice for another one."""
EDITS = [(p, number) for p, texts in CHOICES.items() if p not in _TIED for number in range(len(texts))]
VALUES = [
    "PLC_PRG.sum", "PLC_PRG.text", "PLC_PRG.r", "PLC_PRG.state", "PLC_PRG.k", "PLC_PRG.word",
    "PLC_PRG.core.q", "PLC_PRG.core.calls", "PLC_PRG.core.row", "PLC_PRG.boxes[0].low.x",
    "PLC_PRG.boxes[1].high.x", "PLC_PRG.shape.own.made", "PLC_PRG.square.side", "PLC_PRG.square.core.q",
    "P_Second.a.q", "P_Second.many[2].q", "P_Second.shapes[1].side", "P_Second.shapes[1].own.made",
    "P_Second.s",
    "GVL.total", "GVL.kept", "GVL.log", "GVL.table[3].x", "Limits.lrGain",
]  # fmt: skip


def sources(chosen: Mapping[str, int]) -> list[Source]:
    """All texts; the first choice where nothing is chosen."""
    found = []
    for name, text in OBJECTS.items():
        filled = re.sub(r"\{(\w+)\}", lambda m: CHOICES[m[1]][chosen.get(_TIED.get(m[1], m[1]), 0)], text)
        owner, _, child = name.partition(".")
        named = name if name in ("Limits", "GVL") else None
        found.append(Source(name, filled, name=named, owner=owner if child else None))
    return found


def build(
    chosen: Mapping[str, int], session: BuildSession, previous: CodePackage | None = None
) -> BuildResult:
    """One build of the application."""
    return build_application(sources(chosen), TASKS, OPTIONS, previous, session)
