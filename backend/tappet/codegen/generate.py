"""From a checked program to a code package, as a whole or only what an edit of bodies changed."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path

from tappet.codegen import layout as image_layout
from tappet.codegen.compile_pool import Compilation, is_warm
from tappet.codegen.emit_module import EmitOptions, emit_module
from tappet.codegen.identity import code_id
from tappet.codegen.online import code_change, plan_online_change
from tappet.codegen.online_code import add_online_change
from tappet.codegen.optimise import ObjectCache, OptimiseOptions
from tappet.codegen.package import ONLINE_CHANGE_SYMBOL, CodePackage, TaskSpec
from tappet.codegen.partition import Part, copies_for, partition
from tappet.codegen.symbols_build import (
    Remanence,
    build_symbol_map,
    instance_paths,
    remanent_variables,
)
from tappet.codegen.tasks import event_place
from tappet.core import passes
from tappet.core.effects import EffectsTable
from tappet.core.lower import Lowered, Task, lower
from tappet.core.program import AREA_PREFIX
from tappet.core.relower import relower
from tappet.lang import types as t
from tappet.lang.analysis.result import Analysis
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.symbols import PouSymbol

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


@dataclass(slots=True)
class Generated:
    """A generated application with what the next generation may reuse."""

    options: GenerateOptions
    specs: list[TaskSpec]
    lowered: Lowered
    placed: image_layout.Layout
    effects: EffectsTable
    parts: list[Part]
    keys: list[str]
    """Names of the objects in the cache."""
    objects: list[bytes]
    package: CodePackage


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
    signatures: dict[str, str] = field(default_factory=dict)

    # -- as a whole ----------------------------------------------------------------------------------

    def whole(self, analysis: Analysis, specs: list[TaskSpec], check_only: bool) -> Generated | None:
        """Everything; None when only the messages are wanted, or there are errors.

        Raises LoweringError and ImageTooLargeError.
        """
        previous = self.previous
        with self.timed("lower"):
            known = previous.type_ids if previous is not None else None
            lowered = lower(analysis, [Task(s.name, s.programs) for s in specs], known)
        with self.timed("layout"):
            placed = self.place(lowered)
            symbols = build_symbol_map(
                lowered.data, placed.objects, self.options.byte_addressing, analysis.configured
            )
            events = [event_place(spec, symbols, self.diagnostics) for spec in specs]
            if check_only or any(d.severity == "error" for d in self.diagnostics):
                return None
            remanence = remanent_variables(lowered.data, placed.objects)
            change = None
            if previous is not None:
                change = plan_online_change(previous, symbols, placed)
                add_online_change(lowered, previous, change, placed.objects, symbols)
                change = replace(change, refused=self.refusal(lowered))
        with self.timed("passes"):
            effects = passes.run(lowered.module)
        parts = partition(lowered.module)
        everything = list(range(len(parts)))
        keys, objects = self.compile(lowered, parts, everything, [""] * len(parts), [b""] * len(parts))
        with self.timed("package"):
            package = CodePackage(
                application=self.options.application,
                code_id="",
                data_id=placed.data_id,
                triple=OptimiseOptions().triple,
                objects=objects,
                image_size=placed.size,
                data_objects=placed.objects,
                initial_image=self.image(lowered, placed),
                tasks=[replace(s, symbol=Task(s.name, ()).symbol) for s in events],
                symbols=symbols,
                exports=_exports(lowered),
                type_ids=dict(lowered.type_ids),
                online_change=change,
                runtime={
                    "byte_addressing": self.options.byte_addressing,
                    "signatures": self.signatures,
                    "created": self.created(lowered),
                },
            )
            _take_remanence(package, remanence)
            package.code_id = code_id(package, self.program)
        return Generated(self.options, specs, lowered, placed, effects, parts, keys, objects, package)

    def place(self, lowered: Lowered) -> image_layout.Layout:
        """Sizes and signatures of all data objects, then their offsets."""
        signatures = image_layout.Signatures()
        wanted = []
        for area, size in self.area_sizes(lowered).items():
            lowered.module.data[AREA_PREFIX + area] = (size, 64)
            wanted.append(image_layout.Wanted(AREA_PREFIX + area, size, f"area:{size}"))
        for item in lowered.data:
            owner = item.owner
            if isinstance(owner, PouSymbol):
                assert owner.instance is not None
                text = signatures.of(owner.instance)
            else:
                text = ";".join(
                    f"{m.name.upper()}@{m.offset}:{signatures.of(m.type)}"
                    for m in owner.members.values()
                    if m.type is not None
                )
            wanted.append(image_layout.Wanted(item.symbol, max(item.size, 1), f"{item.size}:{text}"))
        self.signatures = {
            w.symbol: hashlib.blake2b(w.signature.encode(), digest_size=12).hexdigest() for w in wanted
        }
        wanted = [replace(w, signature=self.signatures[w.symbol]) for w in wanted]
        if self.previous is None:
            return image_layout.place(wanted)
        known = self.previous.runtime.get("signatures", {})
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
        """Why no online change leads here: objects made by __NEW would have another form (LOPR-101)."""
        assert self.previous is not None
        assert lowered.program is not None
        analysis = lowered.program.analysis
        known = {pou.qualified_name.upper(): pou.instance for pou in analysis.pous}
        types: dict[str, t.Type | None] = {**known, **analysis.types}
        for name, before in self.previous.runtime.get("created", {}).items():
            type_ = types.get(name)
            if type_ is not None and _signature(type_) != before:
                return f"'{type_}' is created with __NEW and its declaration has changed: download it"
        return ""

    def image(self, lowered: Lowered, placed: image_layout.Layout) -> bytes:
        """Initial bytes of the whole image."""
        image = bytearray(placed.size)
        for item in lowered.data:
            start = placed.objects[item.symbol].offset
            image[start : start + item.size] = item.template.data
        prefix = f"{self.options.device}.{self.options.application}"
        for offset, type_, path in instance_paths(lowered.data, placed.objects, prefix):
            text = path.encode("latin-1", "replace")[: type_.length]
            image[offset : offset + type_.size] = text.ljust(type_.size, b"\0")
        return bytes(image)

    # -- after an edit -------------------------------------------------------------------------------

    def again(self, last: Generated, changed: list[PouSymbol]) -> Generated | None:
        """Only the bodies in `changed` are new; None when that is not all. Raises LoweringError."""
        lowered, program = last.lowered, last.lowered.program
        assert program is not None
        change = None
        if self.previous is not None:
            if self.previous.data_id != last.placed.data_id or self.previous.type_ids != program.type_ids:
                return None
            change = code_change(self.previous, last.package.symbols)
            change = replace(change, refused=self.refusal(lowered))
        with self.timed("lower"):
            lowered.module.functions.pop(ONLINE_CHANGE_SYMBOL, None)
            caught = lowered.module.catches_faults
            fresh = relower(lowered, last.effects, changed)
            if lowered.module.catches_faults != caught:
                return None
            fresh.add(ONLINE_CHANGE_SYMBOL)
            data, sizes = lowered.module.data, self.area_sizes(lowered)
            if any(data[AREA_PREFIX + area][0] != size for area, size in sizes.items()):
                return None
            parts, dirty = _refreshed(lowered, last.parts, fresh)
        more = len(parts) - len(last.parts)
        keys, objects = self.compile(
            lowered, parts, dirty, [*last.keys, *[""] * more], [*last.objects, *[b""] * more]
        )
        with self.timed("package"):
            package = replace(
                last.package,
                objects=objects,
                exports=_exports(lowered),
                type_ids=dict(lowered.type_ids),
                online_change=change,
                runtime={**last.package.runtime, "created": self.created(lowered)},
            )
            package.code_id = code_id(package, self.program)
        return replace(last, parts=parts, keys=keys, objects=objects, package=package)

    # -- objects -------------------------------------------------------------------------------------

    def compile(
        self, lowered: Lowered, parts: list[Part], dirty: list[int], keys: list[str], objects: list[bytes]
    ) -> tuple[list[str], list[bytes]]:
        """Objects of all parts with their keys; only those of `dirty` are not known."""
        options = OptimiseOptions(level=self.options.level)
        emit_options = EmitOptions(triple=options.triple)
        self.cache.hits = len(parts) - len(dirty)
        compilation = Compilation(self.cache, options, parallel=len(dirty) > (1 if is_warm() else 2))
        for number in dirty:
            part = parts[number]
            with self.timed("emit"):
                text = emit_module(lowered.module, part.names, emit_options, len(parts) == 1, part.copies)
            with self.timed("compile"):
                keys[number] = compilation.add(text)
        with self.timed("compile"):
            for number, data in zip(dirty, compilation.objects(), strict=True):
                objects[number] = data
        self.cache.forget(keys)
        return keys, objects


def _refreshed(lowered: Lowered, parts: list[Part], fresh: set[str]) -> tuple[list[Part], list[int]]:
    """Modules after an edit: new functions get one of their own. The numbers of those to compile."""
    functions = lowered.module.functions
    placed = {name for part in parts for name in part.names}
    result: list[Part] = []
    dirty: list[int] = []
    for number, part in enumerate(parts):
        if fresh.isdisjoint(part.names) and fresh.isdisjoint(part.copies):
            result.append(part)
            continue
        names = [name for name in part.names if name in functions]
        result.append(Part(names))
        dirty.append(number)
    added = sorted(functions.keys() - placed)
    if added and len(result) == 1:
        result[0].names += added
        dirty = [0]
    elif added:
        dirty.append(len(result))
        result.append(Part(added))
    if len(result) > 1:
        for number in dirty:
            result[number].copies = copies_for(lowered.module, result[number].names)
    return result, dirty


def _signature(type_: t.Type) -> str:
    """A short form of the layout of a type."""
    return hashlib.blake2b(image_layout.Signatures().of(type_).encode(), digest_size=12).hexdigest()


def _exports(lowered: Lowered) -> list[str]:
    return [f.name for f in lowered.module.functions.values() if f.exported]


def _take_remanence(package: CodePackage, remanence: Remanence) -> None:
    package.retain = remanence.retain
    package.persistent = remanence.persistent
    package.no_init = remanence.no_init
