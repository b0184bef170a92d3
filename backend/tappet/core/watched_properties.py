"""Get of properties with `{attribute 'monitoring' := 'call'}`, called at the end of a task's cycle (LPRG-33).

Beside the variable that shows the value lies one byte: the runtime puts ASKED there while somebody watches,
and finds CALLED once the value is there, or FAILED when Get has ended in a fault, which goes no further.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from tappet.core import guarded, initial, ir, places
from tappet.core.assign import assign
from tappet.core.body import Body
from tappet.core.guard import Guard
from tappet.core.program import Program, data_symbol
from tappet.core.scalars import scalar_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.monitored import monitoring_name
from tappet.lang.parts import Holding
from tappet.lang.symbols import GvlSymbol, PouSymbol, PropertySymbol, Storage, VarSymbol

ASKED, FAILED, CALLED = 1, 2, 3
_WATCHED = 1
"""The bit that ASKED and CALLED have."""
MONITOR = "__MONITOR"


def is_watchable(type_: t.Type) -> bool:
    """Whether Get is called for values of a type: not for structures, arrays and instances."""
    return scalar_of(type_) is not None or isinstance(type_, t.String)


def watched_members(type_: t.FunctionBlock) -> Iterator[tuple[t.Member, t.Member]]:
    """The values of a block that Get is called for, and the bytes that ask for them: of a property that a
    derived block replaces, its own."""
    found: dict[str, tuple[t.Member, t.Member]] = {}
    for member in type_.members.values():
        monitored = member.decl.monitored if member.decl is not None else None
        if monitored is not None and monitored.request is not None and is_watchable(member.type):
            request = type_.members[monitored.request.upper()]
            found[monitored.property_name.upper()] = (member, request)
    yield from found.values()


def monitors_by_call(pous: Iterable[PouSymbol]) -> bool:
    """Whether a program has such properties at all."""
    return any(
        f"{monitoring_name(pou.name, name)}?".upper() in pou.locals for pou in pous for name in pou.properties
    )


def watched(program: Program) -> Holding[t.Type]:
    """Which types have such properties inside."""
    return program.holds(
        "watched",
        lambda type_: isinstance(type_, t.FunctionBlock) and next(watched_members(type_), None) is not None,
    )


def refresh(program: Program, programs: Sequence[PouSymbol], lists: Sequence[GvlSymbol]) -> list[ir.Stmt]:
    """The end of a cycle: the watched properties of all instances in some programs and lists."""
    if not monitors_by_call(program.analysis.pous):
        return []
    b = Body(program, ir.Function("", uri=""), None)
    for pou in programs:
        if pou.instance is not None:
            _object(b, ir.Place(ir.Data(data_symbol(pou))), pou.instance)
    for gvl in lists:
        for member in gvl.members.values():
            if member.storage is Storage.GLOBAL and member.type is not None:
                _object(b, places.at(ir.Place(ir.Data(data_symbol(gvl))), member.offset), member.type)
    return [*b.entry, *b.out]


def _object(b: Body, place: ir.Place, type_: t.Type) -> None:
    if not watched(b.program).holds(type_):
        return
    if isinstance(type_, t.FunctionBlock):
        address = places.address_of(place)
        b.emit(ir.Evaluate(ir.Call(ir.VOID, _monitor(b.program, type_), [address])))
        return
    for inner, part, _ in initial.each_part(b, place, type_):
        _object(b, inner, part)


def _monitor(program: Program, type_: t.FunctionBlock) -> str:
    """Name of the function that serves one instance of a block, with the instances inside."""
    key = f"{program.block_name(type_)}.{MONITOR}"
    if key in program.taken:
        return key
    program.taken.add(key)
    pou = type_.pou.symbol if type_.pou is not None else None
    assert isinstance(pou, PouSymbol)

    def lower() -> None:
        function = ir.Function(
            key,
            [ir.Parameter("self", ir.PTR)],
            uri=pou.source.uri if pou.source else "",
            self_type=program.block_name(type_),
            cold=True,
        )
        b = Body(program, function, pou.source)
        b.block, b.pou = type_, pou
        b.own_data = ir.Place(ir.Self(function.self_type))
        for value, asking in watched_members(type_):
            _serve(b, pou, value, asking)
        for inner, part, _ in initial.each_part(b, b.own_data, type_):
            _object(b, inner, part)
        function.body = [*b.entry, *b.out]
        program.module.functions[key] = function

    program.make_for(type_, key, lower)
    return key


def _serve(b: Body, pou: PouSymbol, value: t.Member, asking: t.Member) -> None:
    monitored = value.decl.monitored if value.decl is not None else None
    property_ = _property(pou, monitored.property_name) if monitored is not None else None
    kept = value.decl.symbol if value.decl is not None else None
    if property_ is None or not isinstance(kept, VarSymbol):
        return
    assert b.own_data is not None
    state = places.at(b.own_data, asking.offset)
    watched = ir.Binary(ir.U8, "and", ir.Load(ir.U8, state), ir.Const(ir.U8, _WATCHED))
    target, got = ast.Name(name=kept.name), ast.Name(name=property_.name)
    target.symbol, target.type = kept, kept.type
    got.symbol, got.type = property_, kept.type

    def call() -> None:
        assign(b, ":=", target, got)
        b.emit(ir.Store(state, ir.Const(ir.U8, CALLED)))

    def failed(guard: Guard, fault: ir.Local) -> None:
        b.emit(ir.Store(state, ir.Const(ir.U8, FAILED)))

    with b.block_of() as body:
        guarded.guarded(b, frozenset(), call, failed)
    b.emit(ir.If(ir.Compare(ir.BOOL, "ne", watched, ir.Const(ir.U8, 0)), body, []))


def _property(pou: PouSymbol, name: str) -> PropertySymbol | None:
    walk: PouSymbol | None = pou
    while walk is not None:
        found = walk.properties.get(name.upper())
        if found is not None:
            return found
        walk = walk.base
    return None
