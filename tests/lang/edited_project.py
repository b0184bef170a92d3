"""A project in pieces that can be edited, and what an analysis knows of it, for comparison."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields

from tappet.iec.task import Task
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import Analysis
from tappet.lang.analysis.tasks import check_tasks
from tappet.lang.parser import parse
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import PouSymbol, Symbol, VarSymbol

OBJECTS: dict[str, str] = {
    "GVL": """{lead}{gvl_head}VAR_GLOBAL
{gvl}    go : BOOL;
    rows : ARRAY [0..nRows] OF ST_Row;
END_VAR""",
    "Limits": """VAR_GLOBAL CONSTANT
{limits}END_VAR""",
    "Common": """VAR_GLOBAL
    shared : DINT;
    axis : FB_Axis;
    sel : E_Mode;
{shared}END_VAR""",
    "E_Mode": """{enum_head}TYPE E_Mode : (
{enum}) {enum_base};
END_TYPE""",
    "ST_Row": """{row_head}TYPE ST_Row : STRUCT
{row}    x : REAL;
END_STRUCT END_TYPE""",
    "ST_Wide": """TYPE ST_Wide EXTENDS ST_Row : STRUCT
    mode : E_Mode;
{wide}END_STRUCT END_TYPE""",
    "T_Alias": "TYPE T_Alias : {alias}; END_TYPE",
    "I_Move": """INTERFACE I_Move
{i_move}END_INTERFACE""",
    "I_Fast": """INTERFACE I_Fast EXTENDS I_Move
METHOD Rush : INT
VAR_INPUT
{rush_in}END_VAR
END_METHOD
END_INTERFACE""",
    "I_Move.Go": """METHOD Go : {go_type}
VAR_INPUT
{go_in}END_VAR""",
    "FB_Base": """{base_head}FUNCTION_BLOCK FB_Base
VAR CONSTANT
    nDeep : INT := {deep};
END_VAR
VAR_INPUT
{base_in}END_VAR
VAR_OUTPUT
    q : INT;
END_VAR
VAR
{base}    iState : INT;
END_VAR
{base_body}
END_FUNCTION_BLOCK""",
    "FB_Axis": """FUNCTION_BLOCK FB_Axis EXTENDS FB_Base IMPLEMENTS I_Move
VAR
    row : ST_Row; buffer : ARRAY [0..nDeep] OF INT;
{axis}END_VAR
{axis_body}
END_FUNCTION_BLOCK""",
    "FB_Axis.Go": """{lead}METHOD {go_access}{go_name} : {axis_go_type}
VAR_INPUT
{axis_go_in}END_VAR
VAR
{axis_go}END_VAR
{axis_go_body}""",
    "FB_Axis.Speed": """PROPERTY Speed : {speed}
GET
{speed_get}
END_GET
{speed_set}END_PROPERTY""",
    "FB_Axis.Stop": """ACTION Stop
{stop_body}
END_ACTION""",
    "FB_Axis.Ptr": """METHOD Ptr : POINTER TO {ptr}
VAR_INST
    kept : {ptr};
END_VAR
Ptr := ADR(kept);""",
    "FB_Derived": """FUNCTION_BLOCK FB_Derived EXTENDS FB_Axis
VAR_STAT
    made : {alias};
END_VAR
VAR
    di {at}: INT;
{derived}END_VAR
{derived_body}
METHOD Rush : INT
VAR_INPUT
{rush_in}END_VAR
iState := 1;
END_METHOD
END_FUNCTION_BLOCK""",
    "ST_Nest": """TYPE ST_Nest : STRUCT
    axis : FB_Axis; rows : ARRAY [1..2] OF ST_Row; own : (up, {nest});
END_STRUCT END_TYPE""",
    "Pool": """VAR_GLOBAL
{pool}    pooled : INT;
END_VAR""",
    "Config": """VAR_CONFIG
    P_Other.derived.di AT %IW{config} : INT;
END_VAR""",
    "F_Uses": """FUNCTION F_Uses : INT
VAR_IN_OUT
    nest : ST_Nest;
END_VAR
VAR
    f : FB_Base; d : INT;
END_VAR
{uses_body}
END_FUNCTION""",
    "FB_Init": """FUNCTION_BLOCK FB_Init1
VAR
    n : INT;
END_VAR
METHOD FB_Init : BOOL
VAR_INPUT
    bInitRetains : BOOL; bInCopyCode : BOOL;
{init_in}END_VAR
END_METHOD
END_FUNCTION_BLOCK""",
    "F_Scale": """FUNCTION F_Scale : {scale_type}
VAR_INPUT
{scale_in}END_VAR
{scale_body}
END_FUNCTION""",
    "F_Row": """FUNCTION F_Row : ST_Row
VAR_INPUT
    r : ST_Row; a : T_Alias;
END_VAR
F_Row := r;
END_FUNCTION""",
    "P_Other": """PROGRAM P_Other
VAR
{other}    own : FB_Base;
    early : (first, {early}); derived : FB_Derived; nests : ARRAY [0..1] OF ST_Nest;
END_VAR
VAR_EXTERNAL
    shared : DINT;
END_VAR
{other_body}
END_PROGRAM""",
    "PLC_PRG": """PROGRAM PLC_PRG
VAR
    ax : FB_Axis; axes : ARRAY [1..2] OF FB_Axis; b : FB_Base; i1 : FB_Init1{init_args};
    mover : I_Move; fast : I_Fast; row : ST_Row := (x := 1.0); wide : ST_Wide; mode : E_Mode;
    p : POINTER TO ST_Row;
    alias : T_Alias; i : INT; r : REAL; s : UDINT; w AT %QW2 : WORD;
{prg}END_VAR
{prg_body}
END_PROGRAM""",
    "P_List": """PROGRAM P_List
VAR
    ax : FB_Axis; i : INT;
END_VAR
LD i
ADD {il}
ST i
CAL ax(a := i)
LD ax.q
ST GVL.count
END_PROGRAM""",
    "POUS": """FUNCTION F_Pool : INT
VAR_INPUT
{pool_in}END_VAR
F_Pool := 1;
END_FUNCTION""",
}
"""Texts with places for what is edited."""

CHOICES: dict[str, list[str]] = {
    "gvl_head": ["", "{attribute 'qualified_only'}\n"],
    "gvl": [
        "    count : INT;\n",
        "    count : DINT;\n",
        "\n    count : INT; speed : REAL;\n",
        "    count : INT; shared : DINT;\n",
        "    total : INT;\n",
        "    count : INT; E_Mode : INT;\n",
        "    count AT %QW2 : INT;\n",
        "    count : (on, off);\n",
    ],
    "limits": [
        "    nRows : INT := 3;\n",
        "    nRows : INT := 5; nMore : INT := nRows + 1;\n",
        "    nRows : DINT := 2 * 4;\n",
        "    nRow : INT := 3;\n",
    ],
    "shared": [
        "",
        "    count : INT;\n",
        "    idle : BOOL;\n",
        "    i : INT;\n",
        "    fresh : FB_Base;\n",
        "    input AT %I* : INT;\n",
    ],
    "enum_head": ["", "{attribute 'qualified_only'}\n", "{attribute 'strict'}\n"],
    "enum": [
        "    idle, run\n",
        "    idle, run, fault\n",
        "\n    idle := 2, run := 7\n",
        "    run, idle\n",
        "    idle, Run, count\n",
    ],
    "enum_base": ["", "UINT", "INT := run"],
    "row_head": ["", "{attribute 'pack_mode' := '1'}\n"],
    "row": [
        "",
        "    y : INT;\n",
        "    y : DINT; b : BOOL;\n",
        "    y : REAL;\n",
        "    y : E_Mode;\n",
        "    y AT %I* : INT;\n",
    ],
    "wide": ["", "    z : ARRAY [0..nRows] OF INT;\n", "    y : BOOL;\n"],
    "alias": ["INT", "REAL", "ST_Row", "E_Mode", "INT (0..10)", "ARRAY [0..nRows] OF INT"],
    "lead": ["", "// moved\n\n"],
    "go_name": ["Go", "Move"],
    "go_access": ["", "PRIVATE ", "FINAL "],
    "rush_in": ["", "    far : REAL;\n", "    far : T_Alias;\n"],
    "ptr": ["ST_Row", "FB_Base", "INT"],
    "derived": ["", "    count : INT;\n", "    hidden2 : FB_Init1;\n", "    wrong : ;\n"],
    "derived_body": ["", "SUPER^(a := 2); hidden := 1; made := 1;", "THIS^.Go(); SUPER^.Go(1.0); i := di;"],
    "at": ["AT %I* ", "", "AT %IW60 "],
    "nest": ["down", "first", "count"],
    "pool": ["", "    count : INT;\n", "    speed : BOOL;\n", "    E_Mode : INT;\n"],
    "config": ["3", "4"],
    "uses_body": [
        "",
        "nest.rows[1].y := 1; nest.axis.hidden := 2; f();",
        "nest.own := up; F_Uses := pooled + count;",
        "nest.axis.Go(1.0); nest.axis.Ptr()^.y := 1; d := 1;",
    ],
    "i_move": ["", "METHOD Halt : BOOL\nEND_METHOD\n", "PROPERTY Speed : REAL\nGET\nEND_GET\nEND_PROPERTY\n"],
    "go_type": ["BOOL", "INT"],
    "go_in": ["", "    to : REAL;\n"],
    "base_head": ["", "{attribute 'obsolete' := 'old'}\n"],
    "deep": ["4", "7", "nRows"],
    "base_in": [
        "    a : INT;\n",
        "    a : REAL;\n",
        "    a : INT; fast : BOOL;\n",
        "    aa : INT;\n",
        "    a : INT; END_VAR VAR_IN_OUT link : INT;\n",
    ],
    "base": ["", "    hidden : INT;\n", "    hidden : REAL; count : INT;\n", "    Stop1 : TON1;\n"],
    "base_body": ["", "q := a + iState;", "q := count;", "hidden := 1;"],
    "axis": ["", "    more : INT;\n", "    i : T_Alias;\n", "    inner : FB_Init1(3);\n"],
    "axis_body": ["", "SUPER^(a := 1); q := hidden;", "i := count; Stop();", "row.y := buffer[2];"],
    "axis_go_type": ["BOOL", "INT"],
    "axis_go_in": ["", "    to : REAL;\n"],
    "axis_go": ["", "    iState : INT;\n", "    to2 : E_Mode := run;\n"],
    "axis_go_body": ["", "Go := TRUE;", "iState := 1; q := more;", "row.x := Speed; Speed := 2;"],
    "speed": ["REAL", "INT", "ST_Row"],
    "speed_get": ["Speed := row.x;", "Speed := 1;"],
    "speed_set": ["", "SET\nrow.x := Speed;\nEND_SET\n"],
    "stop_body": ["iState := 0;", "iState := idle; count := 0;"],
    "init_in": ["", "    n1 : INT;\n", "    n1 : INT := 2; n2 : REAL := 1;\n"],
    "init_args": ["", "(3)", "(n1 := 4)"],
    "scale_type": ["INT", "REAL", "ST_Row"],
    "scale_in": ["    n : INT;\n", "    n : INT; k : INT := 2;\n", "    n : REAL;\n", "    m : E_Mode;\n"],
    "scale_body": ["", "F_Scale := n;", "F_Scale := count;"],
    "other": ["", "    out : INT;\n", "    out : ST_Row;\n", "    shared2 : INT;\n"],
    "early": ["second", "third", "idle"],
    "other_body": ["", "shared := shared + 1;", "out := 1; own(a := 2);", "early := first; own();"],
    "prg": ["", "    speed : INT;\n", "    count : T_Alias;\n", "    local : ARRAY [0..nRows] OF INT;\n"],
    "prg_body": [
        "",
        "ax(a := i); r := ax.Speed; mover := ax; mover.Go(1.0);",
        "CASE mode OF idle: i := 1; run: i := 2; END_CASE\ncount := idle;",
        "s := SIZEOF(row); s := SIZEOF(GVL.rows); s := s + SIZEOF(ax);",
        "row.y := i; wide.y := 1; p := ADR(row); p^.y := F_Scale(i); row := F_Row(row, alias);",
        "axes[1](a := 2); b.hidden := 3; b(); ax.Stop(); P_Other.out := 1; P_Other();",
        "i := F_Scale(3); r := F_Scale(n := 2); i := F_Pool(1); speed := 2; GVL.count := 3;",
        "i := Limits.nRows; i := nMore; FOR i := 0 TO nRows DO local[i] := i; END_FOR",
        "mode := E_Mode.run; alias := 3; i := early; go := E_Mode; sel := run; fresh();",
        "unknown1 := nRow; ax.Spee := 1; fault := 2; w := 3; Common.axis.Go(); Common.axis(a := 1);",
        "row := F_Row(r := (x := 1.0, y := 2), a := 1); mover.Halt(); ax.row.x := ax.buffer[5];",
        "fast.Rush(1); fast.Go();\nIF __QUERYINTERFACE(fast, mover) THEN i := ax.Ptr()^.y; END_IF",
        "F_Uses(P_Other.nests[0]); P_Other.nests[1].rows[2].y := 2; P_Other.derived.made := 1; Move := 1;",
        "ax.Move(2.0); ax.Ptr()^.hidden := 3; P_Other.derived.Rush(far := 2); i := pooled + speed;",
        "{warning disable W1204}\ni := ax.Go(); i := ax.more; %QW2 := 4; shared := 1; ax.iState := 2;",
    ],
    "il": ["1", "nRows", "F_Scale(i)"],
    "pool_in": ["", "    n : INT;\n", "    count : INT;\n"],
}
_LISTS = ("GVL", "Limits", "Common", "Pool", "Config")
_POOL = ("POUS", "Pool")
_IN_PARTS = ("FB_Base", "FB_Axis", "FB_Axis.Go", "F_Scale", "P_Other", "PLC_PRG")
TASKS = (
    Task("Fast", "cyclic", 1_000_000, 1, None, None, ("PLC_PRG",), None),
    Task("Slow", "cyclic", 9_000_000, 9, None, None, ("P_Other", "P_List"), None),
)


def text_of(name: str, chosen: Mapping[str, int]) -> Source:
    """One text with what is chosen for its places; the first choice where nothing is."""
    filled = re.sub(r"\{(\w+)\}", lambda m: CHOICES[m[1]][chosen.get(m[1], 0)], OBJECTS[name])
    owner, _, child = name.partition(".")
    end = filled.rfind("END_VAR")
    return Source(
        name,
        filled,
        Scope.POUS if name in _POOL else Scope.APPLICATION,
        owner if child else None,
        name if name in _LISTS else None,
        body_line=filled.count("\n", 0, end) + 1 if name in _IN_PARTS else 0,
    )


def units_of(chosen: Mapping[str, int]) -> dict[str, ast.Unit]:
    """All texts, parsed."""
    return {name: parse(text_of(name, chosen)).unit for name in OBJECTS}


def parse_edited(units: dict[str, ast.Unit], chosen: Mapping[str, int]) -> None:
    """The texts that are other ones now."""
    for name in OBJECTS:
        source = text_of(name, chosen)
        if source != units[name].source:
            units[name] = parse(source).unit


# -- what an analysis knows ---------------------------------------------------------------------------


def messages(analysis: Analysis) -> list[str]:
    """Messages with their places and related places, those about tasks as well."""
    found = [*analysis.diagnostics, *check_tasks(TASKS, analysis)]
    return [f"{d} {d.span} {[(r.uri, r.span, r.message) for r in d.related]}" for d in found]


def knowledge(analysis: Analysis, units: Iterable[ast.Unit]) -> list[str]:
    """Everything that is resolved: a line for each node and symbol, with type, value and meaning."""
    found = [_node(unit, node) for unit in units for node in _nodes(unit)]
    for pou in analysis.pous:
        found += [_pou(part) for part in pou.with_children()]
    for gvl in analysis.gvls:
        found.append(f"list {gvl.name} {gvl.size} {[_variable(v) for v in gvl.members.values()]}")
    for name, symbol in sorted(analysis.scope.items()):
        found.append(f"scope {name} {_symbol(symbol)}")
    found += [f"type {name} {_type(type_)} {_inside(type_)}" for name, type_ in analysis.types.items()]
    for place in analysis.configured:
        address = (place.area, place.address, place.bit, place.agreed)
        found.append(f"configured {place.path} {place.owner} {place.offset} {_type(place.type)} {address}")
    return found


def _node(unit: ast.Unit, node: ast.Node) -> str:
    parts = [unit.source.uri, node.__class__.__name__, str(tuple(node.span))]
    types = [name for name in ("type", "operand_type", "carried") if hasattr(node, name)]
    parts += [f"{name}={_type(getattr(node, name))}" for name in types]
    values = [name for name in ("constant", "is_constant", "bit", "number") if hasattr(node, name)]
    parts += [f"{name}={getattr(node, name)!r}" for name in values]
    for name in ("symbol", "target", "parameter"):
        value = getattr(node, name, None)
        if isinstance(value, Symbol):
            parts.append(f"{name}={_symbol(value)}")
    return " ".join(parts)


def _symbol(symbol: Symbol) -> str:
    place = (symbol.source.uri if symbol.source else None, symbol.span)
    detail = _variable(symbol) if isinstance(symbol, VarSymbol) else ""
    return f"{symbol.__class__.__name__} {symbol.name} {place} {symbol.comment!r} {detail}"


def _variable(v: VarSymbol) -> str:
    live = v.decl is None or v.decl.symbol is v
    flags = (v.storage, v.home, v.section, sorted(v.flags), v.owner, v.offset, v.bit, v.area)
    return f"{v.name}:{_type(v.type)} {v.constant!r} {v.is_constant} {flags} {live} {v.span}"


def _pou(pou: PouSymbol) -> str:
    instance = pou.instance
    members = _inside(instance) if instance is not None else ""
    own = [_variable(v) for v in pou.locals.values()]
    table = {name: target.qualified_name for name, target in pou.vtable.items()}
    live = pou.pou is not None and pou.pou.symbol is pou
    pins = [p.name for p in pou.parameters]
    return f"pou {pou.qualified_name} {_type(pou.return_type)} {members} {own} {table} {pins} {live}"


def _type(type_: t.Type | None) -> str:
    """A type with its size, and whether it is the one that its declaration stands for now."""
    inner = type_
    while isinstance(inner, (t.Array, t.Pointer, t.Reference)):
        inner = inner.element if isinstance(inner, t.Array) else inner.base
    live = True
    if isinstance(inner, t.FunctionBlock):
        symbol = inner.pou.symbol if inner.pou is not None else None
        live = isinstance(symbol, PouSymbol) and symbol.instance is inner
    elif isinstance(inner, (t.Struct, t.Enum)) and inner.decl is not None:
        live = inner.decl.type is inner
    return f"{type_}/{type_.size if type_ is not None else None}/{live}"


def _inside(type_: t.Type) -> str:
    if isinstance(type_, (t.Struct, t.FunctionBlock)):
        return str([(m.name, str(m.type), m.offset, m.bit, m.section) for m in type_.members.values()])
    return str(type_.values) if isinstance(type_, t.Enum) else ""


def _nodes(unit: ast.Unit) -> Iterator[ast.Node]:
    todo: list[object] = [unit]
    while todo:
        node = todo.pop()
        if isinstance(node, (list, tuple)):
            todo += node
        elif isinstance(node, ast.Node):
            yield node
            todo += [getattr(node, f.name) for f in fields(node) if f.name not in ("owner", "type")]
