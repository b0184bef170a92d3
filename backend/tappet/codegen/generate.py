"""From a checked program to a code package, as a whole or only what an edit changed."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Set
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import structs

from tappet.codegen import layout as image_layout
from tappet.codegen.compile_options import LlvmError, OptimiseOptions
from tappet.codegen.identity import code_id
from tappet.codegen.llvm_place import place_in
from tappet.codegen.object_cache import ObjectCache
from tappet.codegen.online import code_change, plan_online_change
from tappet.codegen.package import ONLINE_CHANGE_SYMBOL, CodePackage, Facts, OnlineChange, TaskSpec
from tappet.codegen.symbol_map import SymbolMap
from tappet.codegen.symbols_build import (
    Remanence,
    TypeTable,
    build_symbol_map,
    instance_paths,
    remanent_variables,
)
from tappet.codegen.tasks import event_place
from tappet.codegen.watched import watched_values
from tappet.core.edits.edit import Edit
from tappet.core.internal_error import At, InternalError
from tappet.core.life_cycle import life_cycle_of
from tappet.core.lower import Lowered, lower, task_symbol
from tappet.core.program import AREA_PREFIX
from tappet.iec.heap import KIB, HeapSettings
from tappet.iec.task import Task
from tappet.lang import types as t
from tappet.lang.analysis.result import Analysis
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.symbols import GvlSymbol, PouSymbol

if TYPE_CHECKING:
    from tappet.codegen.partition import Part
    from tappet.core.edits.dependencies import Dependencies
    from tappet.core.effects import EffectsTable

Timed = Callable[[str], AbstractContextManager[None]]


@dataclass(frozen=True, slots=True)
class GenerateOptions:
    """What generation depends on besides the program."""

    application: str
    device: str
    level: int
    byte_addressing: bool
    area_sizes: tuple[tuple[str, int], ...]
    cache: Path | None
    heap: HeapSettings


@dataclass(slots=True)
class Laid:
    """The data of an application, placed."""

    placed: image_layout.Layout
    signatures: dict[str, str]
    """Digests of what the bytes of each data object mean, by symbol."""
    symbols: SymbolMap
    tasks: list[TaskSpec]
    remanence: Remanence
    change: OnlineChange | None
    image: bytes
    """Initial bytes."""
    types: image_layout.Signatures
    table: TypeTable
    """What is known of types."""


@dataclass(slots=True)
class Generated:
    """A generated application with what the next generation may reuse."""

    options: GenerateOptions
    specs: list[TaskSpec]
    lowered: Lowered
    laid: Laid
    effects: EffectsTable
    parts: list[Part]
    keys: list[str]
    """Names of the objects in the cache."""
    objects: list[bytes]
    package: CodePackage
    dependencies: Dependencies | None = None
    """Made by `settle`."""

    def settle(self) -> Dependencies:
        """Note what the code depends on, before another analysis changes what declarations denote."""
        from tappet.core.edits.dependencies import Dependencies

        program = self.lowered.program
        assert program is not None
        if self.dependencies is None:
            self.dependencies = Dependencies(program)
        self.dependencies.complete()
        return self.dependencies


@dataclass(slots=True)
class Generator:
    """One generation."""

    options: GenerateOptions
    program: bytes
    """Digest of the program (`identity.program_digest`)."""
    previous: CodePackage | None
    cache: ObjectCache
    timed: Timed
    diagnostics: list[Diagnostic]

    # -- as a whole ----------------------------------------------------------------------------------

    def whole(self, analysis: Analysis, specs: list[TaskSpec], check_only: bool) -> Generated | None:
        """Everything; None when only the messages are wanted, or there are errors.

        Raises LoweringError and ImageTooLargeError.
        """
        previous = self.previous
        with self.timed("lower"):
            known = previous.type_ids if previous is not None else None
            lowered = lower(analysis, [Task(s.name, programs=s.programs) for s in specs], known)
        with self.timed("layout"):
            laid = self.lay_out(lowered, analysis, specs, self.diagnostics, check_only)
            if laid is None:
                return None
        from tappet.codegen.partition import partition
        from tappet.core import passes

        with self.timed("passes"):
            effects = passes.run(lowered.module)
        parts = partition(lowered.module)
        everything = list(range(len(parts)))
        keys, objects = self.compile(lowered, parts, everything, [""] * len(parts), [b""] * len(parts))
        with self.timed("package"):
            package = self.package(lowered, laid, objects)
        return Generated(self.options, specs, lowered, laid, effects, parts, keys, objects, package)

    def package(self, lowered: Lowered, laid: Laid, objects: list[bytes]) -> CodePackage:
        """The package of placed data and finished objects."""
        remanence = laid.remanence
        package = CodePackage(
            application=self.options.application,
            code_id="",
            data_id=laid.placed.data_id,
            triple=OptimiseOptions().triple,
            objects=objects,
            image_size=laid.placed.size,
            data_objects=laid.placed.objects,
            initial_image=laid.image,
            tasks=[structs.replace(s, symbol=task_symbol(s.name)) for s in laid.tasks],
            symbols=laid.symbols,
            retain=remanence.retain,
            persistent=remanence.persistent,
            no_init=remanence.no_init,
            exports=[f.name for f in lowered.module.functions.values() if f.exported],
            type_ids=dict(lowered.type_ids),
            online_change=laid.change,
            facts=Facts(
                byte_addressing=self.options.byte_addressing,
                signatures=laid.signatures,
                created=self.created(lowered),
                watched=watched_values(lowered, laid.placed.objects),
                life_cycle=life_cycle_of(laid.table.described.values()),
                heap_limit=self.options.heap.limit,
                heap_poison=self.options.heap.poison,
            ),
        )
        package.code_id = code_id(package, self.program)
        return package

    # -- data ----------------------------------------------------------------------------------------

    def lay_out(
        self,
        lowered: Lowered,
        analysis: Analysis,
        specs: list[TaskSpec],
        messages: list[Diagnostic],
        check_only: bool = False,
        known: Laid | None = None,
        entities: Set[int] = frozenset(),
        filled: Set[str] = frozenset(),
    ) -> Laid | None:
        """Places of all data and how to get there from the running application; None after errors.

        `known`: what was laid out before, of which only the types in `entities`, given by id(), and the data
        objects with symbols in `filled` are new.
        """
        previous = self.previous
        types = known.types if known is not None else image_layout.Signatures()
        types.forget(entities)
        signatures = self.sign(lowered, types, known, filled)
        placed = self.place(lowered, signatures)
        symbols, table = build_symbol_map(
            lowered.data,
            placed.objects,
            self.options.byte_addressing,
            analysis.configured,
            known.table if known is not None else None,
            entities,
            filled,
        )
        events = [event_place(spec, symbols, messages) for spec in specs]
        if check_only or any(d.severity == "error" for d in messages):
            return None
        remanence = remanent_variables(lowered.data, placed.objects, types, table)
        image = self.image(lowered, placed, table)
        change = None
        if previous is not None:
            from tappet.codegen.online_code import add_online_change

            change = plan_online_change(previous, symbols, placed, image)
            add_online_change(lowered, previous, change, placed.objects, symbols)
            change = structs.replace(change, refused=self.refusal(lowered))
        return Laid(placed, signatures, symbols, events, remanence, change, image, types, table)

    def sign(
        self, lowered: Lowered, types: image_layout.Signatures, known: Laid | None, filled: Set[str]
    ) -> dict[str, str]:
        """Digests of what the bytes of all data objects mean, in the order in which they are placed."""
        found: dict[str, str] = {}
        for area, size in self.area_sizes(lowered).items():
            lowered.module.data[AREA_PREFIX + area] = (size, 64)
            found[AREA_PREFIX + area] = _digest(f"area:{size}")
        for item in lowered.data:
            if known is not None and item.symbol not in filled:
                found[item.symbol] = known.signatures[item.symbol]
            else:
                found[item.symbol] = _digest(f"{item.size}:{_meaning(types, item.owner)}")
        return found

    def place(self, lowered: Lowered, signatures: dict[str, str]) -> image_layout.Layout:
        """Offsets of all data objects."""
        sizes = {item.symbol: max(item.size, 1) for item in lowered.data}
        wanted = [
            image_layout.Wanted(
                symbol,
                sizes.get(symbol) or lowered.module.data[symbol][0],
                lowered.module.data[symbol][0],
                text,
            )
            for symbol, text in signatures.items()
        ]
        if self.previous is None:
            return image_layout.place(wanted)
        known = self.previous.facts.signatures
        return image_layout.place(wanted, self.previous.data_objects, known)

    def area_sizes(self, lowered: Lowered) -> dict[str, int]:
        """Bytes of each area: the configured size, or more when the program reaches further."""
        assert lowered.program is not None
        sizes = dict(self.options.area_sizes)
        for area, used in lowered.program.area_need().items():
            sizes[area] = max(sizes.get(area, 0), (used + 63) // 64 * 64)
        return sizes

    def created(self, lowered: Lowered) -> dict[str, str]:
        """Signatures of what __NEW makes: the memory of such objects keeps its form over online changes."""
        assert lowered.program is not None
        return {name: _signature(type_) for name, type_ in sorted(lowered.program.created.items())}

    def refusal(self, lowered: Lowered) -> str:
        """Why no online change leads here: objects made by __NEW would have another form (LOPR-101), or the
        memory that they lie in another size."""
        assert self.previous is not None
        before_limit, limit = self.previous.facts.heap_limit, self.options.heap.limit
        if limit != before_limit:
            sizes = f"{before_limit // KIB} KiB to {limit // KIB} KiB"
            return f"the limit of the memory of __NEW has changed from {sizes}: download it"
        assert lowered.program is not None
        analysis = lowered.program.analysis
        known = {pou.qualified_name.upper(): pou.instance for pou in analysis.pous}
        types: dict[str, t.Type | None] = {**known, **analysis.types}
        for name, before in self.previous.facts.created.items():
            type_ = types.get(name)
            if type_ is not None and _signature(type_) != before:
                return f"'{type_}' is created with __NEW and its declaration has changed: download it"
        return ""

    def image(self, lowered: Lowered, placed: image_layout.Layout, table: TypeTable) -> bytes:
        """Initial bytes of the whole image."""
        image = bytearray(placed.size)
        for item in lowered.data:
            start = placed.objects[item.symbol].offset
            image[start : start + item.size] = item.template.data
        prefix = f"{self.options.device}.{self.options.application}"
        for offset, type_, path in instance_paths(lowered.data, placed.objects, prefix, table):
            text = path.encode("latin-1", "replace")[: type_.length]
            image[offset : offset + type_.size] = text.ljust(type_.size, b"\0")
        return bytes(image)

    # -- after an edit -------------------------------------------------------------------------------

    def again(self, last: Generated, analysis: Analysis, edit: Edit) -> Generated | None:
        """Only what is in `edit` is new; None when that is not all.

        Raises LoweringError and ImageTooLargeError.
        """
        from tappet.codegen.emit_module import same_code
        from tappet.codegen.partition import SMALL, refreshed
        from tappet.core.edits.relower import Relowering

        lowered, program, previous = last.lowered, last.lowered.program, self.previous
        assert program is not None
        if previous is not None and not previous.type_ids.items() <= program.type_ids.items():
            return None
        dependencies = last.settle()
        data, caught = dict(lowered.module.data), lowered.module.catches_faults
        with self.timed("lower"):
            lowered.module.functions.pop(ONLINE_CHANGE_SYMBOL, None)
            work = Relowering(lowered, last.effects, dependencies)
            if edit.texts and not work.declarations(analysis, edit):
                return None
            work.bodies(edit.bodies.values())
            work.complete()
            if lowered.module.catches_faults != caught:
                return None
        laid = last.laid
        areas = {AREA_PREFIX + area: size for area, size in self.area_sizes(lowered).items()}
        moved = edit.texts or any(data[symbol][0] != size for symbol, size in areas.items())
        if moved or (previous is not None and previous.data_id != laid.placed.data_id):
            with self.timed("layout"):
                found = self.lay_out(
                    lowered, analysis, last.specs, [], False, laid, edit.entities, work.filled
                )
            if found is None:
                return None
            laid = found
        else:
            laid = replace(laid, change=self.code_change(lowered, laid))
        with self.timed("passes"):
            fresh = work.finish(lambda old, new: new.weight <= SMALL and same_code(lowered.module, old, new))
            fresh.add(ONLINE_CHANGE_SYMBOL)
        resized = {symbol for symbol, size in lowered.module.data.items() if data.get(symbol) != size}
        parts, dirty = refreshed(lowered.module, last.parts, fresh, resized)
        more = len(parts) - len(last.parts)
        keys, objects = self.compile(
            lowered, parts, dirty, [*last.keys, *[""] * more], [*last.objects, *[b""] * more]
        )
        program.keep_strings(set().union(*(part.used for part in parts)))
        with self.timed("package"):
            package = self.package(lowered, laid, objects)
        return replace(last, laid=laid, parts=parts, keys=keys, objects=objects, package=package)

    def code_change(self, lowered: Lowered, laid: Laid) -> OnlineChange | None:
        """How to get from the running application, whose data are the same, to this one."""
        previous = self.previous
        if previous is None:
            return None
        change = code_change(previous, laid.symbols)
        if change.initialise:
            from tappet.codegen.online_code import add_online_change

            add_online_change(lowered, previous, change, laid.placed.objects, laid.symbols)
        return structs.replace(change, refused=self.refusal(lowered))

    # -- objects -------------------------------------------------------------------------------------

    def compile(
        self, lowered: Lowered, parts: list[Part], dirty: list[int], keys: list[str], objects: list[bytes]
    ) -> tuple[list[str], list[bytes]]:
        """Objects of all parts with their keys; only those of `dirty` are not known."""
        try:
            return self._compile(lowered, parts, dirty, keys, objects)
        except LlvmError as error:
            at = place_in(error.text, str(error)) or At(self.options.application)
            reason = " ".join(str(error).splitlines()[:2])
            raise InternalError("machine code", at, reason) from error

    def _compile(
        self, lowered: Lowered, parts: list[Part], dirty: list[int], keys: list[str], objects: list[bytes]
    ) -> tuple[list[str], list[bytes]]:
        from tappet.codegen.compile_pool import Compilation, is_warm
        from tappet.codegen.emit_module import EmitOptions, emit_module

        options = OptimiseOptions(level=self.options.level)
        emit_options = EmitOptions(triple=options.triple)
        self.cache.hits = len(parts) - len(dirty)
        compilation = Compilation(self.cache, options, parallel=len(dirty) > (1 if is_warm() else 2))
        for number in dirty:
            part = parts[number]
            with self.timed("emit"):
                part.used = set()
                whole = len(parts) == 1
                text = emit_module(lowered.module, part.names, emit_options, whole, part.copies, part.used)
            with self.timed("compile"):
                keys[number] = compilation.add(text)
        with self.timed("compile"):
            for number, data in zip(dirty, compilation.objects(), strict=True):
                objects[number] = data
        self.cache.forget(keys)
        return keys, objects


def _signature(type_: t.Type) -> str:
    """A short form of the layout of a type."""
    return _digest(image_layout.Signatures().of(type_))


def _digest(text: str) -> str:
    return hashlib.blake2b(text.encode(), digest_size=12).hexdigest()


def _meaning(types: image_layout.Signatures, owner: GvlSymbol | PouSymbol) -> str:
    """What the bytes of a program or list mean."""
    if isinstance(owner, PouSymbol):
        assert owner.instance is not None
        return types.of(owner.instance)
    return ";".join(
        f"{m.name.upper()}@{m.offset}:{types.of(m.type)}"
        for m in owner.members.values()
        if m.type is not None
    )
