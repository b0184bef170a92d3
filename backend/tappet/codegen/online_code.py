"""Code an online change runs once: initial values of what is new, FB_Init and FB_Reinit of what has moved,
pointers that follow."""

from __future__ import annotations

import struct
from bisect import bisect_right
from collections.abc import Iterator, Mapping

from tappet.codegen.package import ONLINE_CHANGE_SYMBOL, CodePackage, DataObject, OnlineChange
from tappet.codegen.symbol_map import SymbolMap
from tappet.core import calls, initial, ir, places, templates
from tappet.core.body import Body
from tappet.core.life_cycle import holding, init_methods, life_cycle_methods
from tappet.core.lower import Lowered, complete_bodies, instances
from tappet.core.program import Program
from tappet.lang import types as t
from tappet.lang.parts import Holding, stored

_GONE = 0xFFFF_FFFF


class Fresh:
    """Ranges of the new image that did not come from the running one."""

    def __init__(self, change: OnlineChange) -> None:
        self.starts: list[int] = []
        self.ends: list[int] = []
        for start, size in sorted(change.initialise):  # some lie in others
            if self.ends and start <= self.ends[-1]:
                self.ends[-1] = max(self.ends[-1], start + size)
            else:
                self.starts.append(start)
                self.ends.append(start + size)
        places = [(target, target + size) for _, target, size in change.moves]
        places += [(c.target.offset, c.target.offset + c.target.size) for c in change.conversions]
        places.sort()
        self.move_starts = [start for start, _ in places]
        self.move_ends = [end for _, end in places]
        # with a bit its byte is kept: what FB_Init makes of new bits beside it gives way
        places = sorted({*places, *((target, target + 1) for _, _, target, _ in change.bits)})
        self.kept_starts = [start for start, _ in places]
        self.kept_ends = [end for _, end in places]

    def covers(self, offset: int) -> bool:
        """Whether the byte at `offset` is new."""
        at = bisect_right(self.starts, offset) - 1
        return at >= 0 and offset < self.ends[at]

    def kept(self, offset: int, size: int) -> list[tuple[int, int]]:
        """Parts of a range, by their offset inside it and length, that hold values of the running image."""
        return _inside(self.kept_starts, self.kept_ends, offset, size)

    def alike(self, offset: int, count: int, stride: int) -> Iterator[tuple[int, int]]:
        """The elements of an array, by number and count, of which the same parts are kept and new."""
        first, known = 0, self._parts(offset, stride)
        for number in range(1, count):
            parts = self._parts(offset + number * stride, stride)
            if parts != known:
                yield first, number - first
                first, known = number, parts
        yield first, count - first

    def _parts(self, offset: int, size: int) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
        return self.kept(offset, size), _inside(self.starts, self.ends, offset, size)

    def moved_into(self, offset: int, size: int) -> bool:
        """Whether any byte of a range was moved there."""
        at = bisect_right(self.move_starts, offset + size - 1) - 1
        return at >= 0 and self.move_ends[at] > offset


def _inside(starts: list[int], ends: list[int], offset: int, size: int) -> list[tuple[int, int]]:
    """Parts of a range that lie in sorted ranges, by their offset inside it and length."""
    found = []
    at = bisect_right(ends, offset)
    while at < len(starts) and starts[at] < offset + size:
        first, last = max(starts[at], offset), min(ends[at], offset + size)
        found.append((first - offset, last - first))
        at += 1
    return found


def add_online_change(
    lowered: Lowered,
    old: CodePackage,
    change: OnlineChange,
    objects: Mapping[str, DataObject],
    symbols: SymbolMap,
) -> None:
    """Add the function to the module when there is something for it to do."""
    program = lowered.program
    assert program is not None
    function = ir.Function(ONLINE_CHANGE_SYMBOL, exported=True, uri="", cold=True)
    b = Body(program, function, None)
    _relocate(b, program, old, change, objects, symbols)
    fresh = Fresh(change)
    for item in lowered.data:
        place = objects[item.symbol]
        base = ir.Place(ir.Data(item.symbol))
        b.own_data = base
        _run_new(b, base, item.template.steps, place.offset, fresh)
        for offset, type_ in instances(item.owner):
            _reinitialise_moved(b, places.at(base, offset), type_, place.offset + offset, fresh)
    if not b.out:
        return
    function.body = [*b.entry, *b.out]
    lowered.module.functions[function.name] = function
    complete_bodies(program)


def _run_new(b: Body, base: ir.Place, steps: list[templates.Step], offset: int, fresh: Fresh) -> None:
    """Dynamic initial values of new variables, and FB_Init of blocks that have moved."""
    initialiser = templates.initialiser_of(b.program)
    for step in steps:
        at = offset + step.offset
        extent = step.count * step.stride if step.inner else step.type.size
        if not fresh.moved_into(at, extent):
            if fresh.covers(at):
                initial.run_steps(b, base, [step])
            continue
        if step.inner:
            start = places.at(base, step.offset)
            for place, first in _elements(b, start, at, step.count, step.stride, fresh):
                _run_new(b, place, step.inner, first, fresh)
        elif step.value is None and not step.after and isinstance(step.type, t.FunctionBlock):
            place = places.at(base, step.offset)
            outer, b.own_data = b.own_data, place
            template = initialiser.of_type(step.type)
            _run_new(b, place, template.steps, at, fresh)
            if init_methods(step.type):
                _initialise_moved(b, place, step, template, fresh.kept(at, extent))
            b.own_data = outer


def _elements(
    b: Body, start: ir.Place, at: int, count: int, stride: int, fresh: Fresh
) -> Iterator[tuple[ir.Place, int]]:
    """What is emitted for each place is done for the elements of an array, which lies at `at` of the image;
    those of which the same parts are kept share a loop. With each place the offset of the first of them."""
    for first, number in fresh.alike(at, count, stride):
        shift = first * stride
        if number == 1:
            yield places.at(start, shift), at + shift
            continue
        with initial.each_element(b, places.at(start, shift), number, stride) as element:
            yield element, at + shift


def _initialise_moved(
    b: Body, place: ir.Place, step: templates.Step, template: templates.Template, kept: list[tuple[int, int]]
) -> None:
    """FB_Init of a moved instance finds initial values; then those it had are put back (LDEC-106)."""
    assert isinstance(step.type, t.FunctionBlock)
    externals = b.program.module.externals
    externals.setdefault("tappet_set_aside", ir.External("tappet_set_aside", [ir.U64], ir.PTR))
    externals.setdefault("tappet_take_back", ir.External("tappet_take_back", [ir.PTR]))
    pointer = b.temp(ir.PTR)
    read = ir.Load(ir.PTR, ir.Place(pointer))
    size = ir.Const(ir.U64, max(step.type.size, 1))
    b.emit(ir.Store(ir.Place(pointer), ir.Call(ir.PTR, "tappet_set_aside", [size])))
    bytes_ = b.program.string_constant(bytes(template.data), 8)
    initial_values = ir.Place(ir.Data(bytes_.symbol))
    aside = ir.Place(ir.Indirect(read))
    with b.block_of() as body:
        for offset, length in kept:
            b.emit(ir.Copy(places.at(aside, offset), places.at(place, offset), length))
            b.emit(ir.Copy(places.at(place, offset), places.at(initial_values, offset), length))
        initial.run_steps(b, place, [s for s in template.steps if s.value is not None and not s.inner])
        initial.construct_moved(b, place, step.type, step.args)
        for offset, length in kept:
            b.emit(ir.Copy(places.at(place, offset), places.at(aside, offset), length))
        b.emit(ir.Evaluate(ir.Call(ir.VOID, "tappet_take_back", [read])))
    b.emit(ir.If(ir.Compare(ir.BOOL, "ne", read, ir.Const(ir.PTR, 0)), body, []))


def _reinitialise_moved(b: Body, place: ir.Place, type_: t.Type, at: int, fresh: Fresh) -> None:
    """FB_Reinit of all instances inside an object that were copied, inner ones first (LDEC-104, LDEC-107)."""
    if not holding(b.program, "FB_REINIT").holds(type_):
        return
    if isinstance(type_, t.Array):
        for element, first in _elements(b, place, at, type_.count, type_.element.size, fresh):
            _reinitialise_moved(b, element, type_.element, first, fresh)
    for member in stored(type_):
        inner = places.at(place, member.offset)
        _reinitialise_moved(b, inner, member.type, at + member.offset, fresh)
    if isinstance(type_, t.FunctionBlock) and fresh.moved_into(at, type_.size):
        for method in life_cycle_methods(type_, "FB_REINIT"):
            prepared = calls.Prepared()
            calls.finish(b, prepared, method, [], places.address_of(place), None)
            b.out.extend(prepared.statements())


# -- pointers ---------------------------------------------------------------------------------------


def _relocate(
    b: Body,
    program: Program,
    old: CodePackage,
    change: OnlineChange,
    objects: Mapping[str, DataObject],
    symbols: SymbolMap,
) -> None:
    ranges = relocation_ranges(old, change, objects)
    if not ranges:
        return
    offsets = list(pointers(symbols))
    target = program.library_function("RELOCATE")
    if not offsets or target is None:
        return
    slots = program.string_constant(struct.pack(f"<{len(offsets)}I", *offsets), 4)
    table = program.string_constant(b"".join(struct.pack("<3I", *r) for r in ranges), 4)
    anchor, place = next(iter(objects.items()))
    address = ir.Convert(ir.U64, ir.Address(ir.PTR, ir.Place(ir.Data(anchor))))
    base = ir.Binary(ir.U64, "sub", address, ir.Const(ir.U64, place.offset))
    args: list[ir.Expr] = [
        base,
        ir.Address(ir.PTR, ir.Place(ir.Data(slots.symbol))),
        ir.Const(ir.I32, len(offsets)),
        ir.Address(ir.PTR, ir.Place(ir.Data(table.symbol))),
        ir.Const(ir.I32, len(ranges)),
    ]
    b.emit(ir.Evaluate(ir.Call(ir.I32, program.function(target), args)))


def relocation_ranges(
    old: CodePackage, change: OnlineChange, objects: Mapping[str, DataObject]
) -> list[tuple[int, int, int]]:
    """(old start, old end, new start) of everything that is not where it was; start 2^32 - 1 = gone."""
    moved = sorted(change.moves)
    found: list[tuple[int, int, int]] = []
    for symbol, place in sorted(old.data_objects.items(), key=lambda item: item[1].offset):
        if objects.get(symbol) == place and not any(
            place.offset <= source < place.offset + place.size for source, _, _ in moved
        ):
            kept = not any(
                start < place.offset + place.size and start + n > place.offset
                for start, n in change.initialise
            )
            if kept:
                continue
        at, end = place.offset, place.offset + place.size
        for source, target, size in moved:
            if source + size <= at or source >= end:
                continue
            if source > at:
                found.append((at, source, _GONE))
            found.append((source, source + size, target))
            at = source + size
        if at < end:
            found.append((at, end, _GONE))
    return [r for r in found if r[0] != r[2]]


_POINTERS = ("pointer", "reference", "interface")


def pointers(symbols: SymbolMap) -> Iterator[int]:
    """Offsets of all pointers, references and interfaces of an application."""
    holding = Holding[int](
        lambda number: symbols.types[number].kind in _POINTERS,
        lambda number: (part for part, _ in symbols.parts(number)),
        key=int,
    )
    for root in symbols.roots.values():
        yield from _pointers(symbols, holding, root.type, root.offset)


def _pointers(symbols: SymbolMap, holding: Holding[int], number: int, offset: int) -> Iterator[int]:
    if not holding.holds(number):
        return
    if symbols.types[number].kind in _POINTERS:
        yield offset
    else:
        for part, at in symbols.parts(number):
            yield from _pointers(symbols, holding, part, offset + at)
