"""From source texts to a code package: parse, analyse, lower, lay out, emit, optimise.

`build_application` is the driver for applications, `build_system` for ST that is part of the product and
linked by itself, `layout_of` gives Python the offsets of ST structures.
"""

from __future__ import annotations

import gc
import hashlib
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol

from tappet import libraries as installed
from tappet.codegen import layout as image_layout
from tappet.codegen.compile_pool import Compilation
from tappet.codegen.emit_module import EmitOptions, emit_module
from tappet.codegen.online import plan_online_change
from tappet.codegen.online_code import add_online_change
from tappet.codegen.optimise import ObjectCache, OptimiseOptions
from tappet.codegen.package import (
    INIT_SYMBOL,
    CodePackage,
    TaskSpec,
)
from tappet.codegen.partition import partition
from tappet.codegen.symbols_build import build_symbol_map, instance_paths, remanent_variables
from tappet.codegen.tasks import check_tasks, default_tasks, event_place
from tappet.core import passes
from tappet.core.lower import Lowered, Task, lower
from tappet.core.program import AREA_PREFIX, CONVERSION_LIBRARY, LoweringError
from tappet.lang import types as t
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.analysis.run import analyse
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.parser import ParseResult, parse
from tappet.lang.source import NOWHERE, Scope, Source, Span
from tappet.lang.symbols import PouSymbol


@dataclass(frozen=True, slots=True)
class LibraryReference:
    """A library an application uses."""

    name: str
    version: str = "*"
    namespace: str | None = None


@dataclass(frozen=True, slots=True)
class BuildOptions:
    """How an application is built."""

    application: str = "Application"
    device: str = "Device"
    """First part of instance paths."""
    level: int = 2
    """Optimisation, 0..3."""
    byte_addressing: bool = False
    system: bool = False
    libraries: tuple[LibraryReference, ...] = (LibraryReference("Standard"),)
    cache: Path | None = None
    """Folder of the object cache; None compiles everything."""
    area_sizes: tuple[tuple[str, int], ...] = (("I", 1024), ("Q", 1024), ("M", 4096))
    """Bytes of the areas at least; they grow to what the program uses."""
    defines: tuple[tuple[str, str], ...] = ()
    """Identifiers known to conditional pragmas, with their values (LPRG-06)."""
    check_only: bool = False
    """Make no object code."""
    main_program: str = "PLC_PRG"


@dataclass(slots=True)
class BuildResult:
    """Outcome: a package when there is no error."""

    package: CodePackage | None
    diagnostics: list[Diagnostic]
    analysis: Analysis | None = field(repr=False)
    timings: dict[str, float] = field(default_factory=dict)
    """Seconds per stage."""
    code_size: int = 0
    """Bytes of the objects."""
    data_size: int = 0
    """Bytes of the image."""
    functions: int = 0
    cached_objects: int = 0

    @property
    def ok(self) -> bool:
        """Whether a package was made."""
        return self.package is not None


class SourceLike(Protocol):
    """What `project.sources` hands over: the fields of `lang.source.Source`."""

    @property
    def uri(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def scope(self) -> str: ...
    @property
    def owner(self) -> str | None: ...
    @property
    def name(self) -> str | None: ...
    @property
    def library(self) -> str | None: ...
    @property
    def namespace(self) -> str | None: ...
    @property
    def body_line(self) -> int: ...


class TaskLike(Protocol):
    """What `project.sources.tasks` hands over."""

    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def interval_ns(self) -> int: ...
    @property
    def priority(self) -> int: ...
    @property
    def event(self) -> str | None: ...
    @property
    def programs(self) -> tuple[str, ...]: ...


class BuildSession:
    """What builds of one application keep: after an edit only one text is parsed and one module compiled.

    Analysis fills the trees in place, so a session must not be used by two builds at once.
    """

    def __init__(self) -> None:
        self.parsed: dict[Source, ParseResult] = {}
        self.objects: dict[Path | None, ObjectCache] = {}

    def cache(self, folder: Path | None) -> ObjectCache:
        """Objects in memory, and in `folder` unless it is None."""
        if folder not in self.objects:
            self.objects = {folder: ObjectCache(folder)}
        return self.objects[folder]

    def parse_all(self, sources: Sequence[Source], options: ParseOptions) -> list[ParseResult]:
        """Trees of all texts; forgets texts that are gone."""
        results = parse_sources(sources, options, plain=self.parsed)
        self.parsed = dict(zip(sources, results, strict=True))
        return results


def as_source(text: Source | SourceLike) -> Source:
    """A text of the project model as the compiler's own type."""
    if isinstance(text, Source):
        return text
    return Source(
        text.uri,
        text.text,
        Scope(text.scope),
        text.owner,
        text.name,
        text.library,
        text.namespace,
        text.body_line,
    )


def build_application(
    sources: Iterable[Source | SourceLike],
    tasks: Iterable[TaskLike] = (),
    options: BuildOptions | None = None,
    previous: CodePackage | None = None,
    session: BuildSession | None = None,
) -> BuildResult:
    """Build an application. Errors of the program are diagnostics; nothing is raised for them.

    With `previous`, the package that runs now, unchanged data keep their place and the result says how to
    change over without stopping.
    """
    options = options or BuildOptions()
    with _no_collection():
        return _Build(options, previous, session or BuildSession()).run(list(sources), list(tasks))


@contextmanager
def _no_collection() -> Iterator[None]:
    """Trees have no garbage while they grow; looking for it takes a third of the time."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


class _Build:
    """One build: its options, timings and messages."""

    def __init__(self, options: BuildOptions, previous: CodePackage | None, session: BuildSession) -> None:
        self.options = options
        self.previous = previous
        self.session = session
        self.result = BuildResult(None, [], None)

    @contextmanager
    def timed(self, stage: str) -> Iterator[None]:
        start = time.perf_counter()
        try:
            yield
        finally:
            self.result.timings[stage] = time.perf_counter() - start

    def run(self, given: list[Source | SourceLike], task_list: list[TaskLike]) -> BuildResult:
        result, options = self.result, self.options
        sources = [as_source(s) for s in given] + self.library_sources()
        with self.timed("parse"):
            names = [task.name for task in task_list]
            parsed = self.session.parse_all(sources, ParseOptions(dict(options.defines), names))
        with self.timed("analyse"):
            settings = AnalysisOptions(
                system=options.system,
                byte_addressing=options.byte_addressing,
                main_program=options.main_program,
            )
            analysis = analyse([p.unit for p in parsed], settings)
        result.analysis = analysis
        result.diagnostics += [d for p in parsed for d in p.diagnostics]
        result.diagnostics += analysis.diagnostics
        specs = check_tasks(task_list, analysis, result.diagnostics)
        if not task_list:
            specs = default_tasks(analysis, sources, options.main_program)
        if any(d.severity == "error" for d in result.diagnostics):
            return result
        try:
            self.generate(analysis, specs)
        except LoweringError as error:
            span = error.span if isinstance(error.span, Span) else NOWHERE
            result.diagnostics.append(report("E0901", error.uri, span, message=error.message))
        except image_layout.ImageTooLargeError as error:
            result.diagnostics.append(report("E0901", "", NOWHERE, message=str(error)))
        return result

    def library_sources(self) -> list[Source]:
        """Texts of the libraries in use and of the conversion library."""
        texts: list[Source] = []
        wanted = [*self.options.libraries, LibraryReference(CONVERSION_LIBRARY)]
        for reference in wanted:
            try:
                found = installed.load(reference.name, reference.version, reference.namespace)
            except installed.UnknownLibraryError as error:
                self.result.diagnostics.append(report("E0902", "", NOWHERE, message=str(error)))
                continue
            texts += found.sources
        return texts

    def generate(self, analysis: Analysis, specs: list[TaskSpec]) -> None:
        result, options, previous = self.result, self.options, self.previous
        with self.timed("lower"):
            lowered = lower(
                analysis,
                [Task(s.name, s.programs) for s in specs],
                previous.type_ids if previous is not None else None,
            )
        with self.timed("layout"):
            placed = self.place(lowered)
            symbols = build_symbol_map(lowered.data, placed.objects, options.byte_addressing)
            specs = [event_place(spec, symbols, result.diagnostics) for spec in specs]
            if options.check_only or any(d.severity == "error" for d in result.diagnostics):
                return
            remanence = remanent_variables(lowered.data, placed.objects)
            change = None
            if previous is not None:
                change = plan_online_change(previous, symbols, placed)
                add_online_change(lowered, previous, change, placed.objects, symbols)
        with self.timed("passes"):
            passes.run(lowered.module)
        objects = self.compile(lowered)
        image = bytearray(placed.size)
        for item in lowered.data:
            start = placed.objects[item.symbol].offset
            image[start : start + item.size] = item.template.data
        prefix = f"{options.device}.{options.application}"
        for offset, type_, path in instance_paths(lowered.data, placed.objects, prefix):
            text = path.encode("latin-1", "replace")[: type_.length]
            image[offset : offset + type_.size] = text.ljust(type_.size, b"\0")
        functions = lowered.module.functions
        package = CodePackage(
            application=options.application,
            code_id="",
            data_id=placed.data_id,
            triple=OptimiseOptions().triple,
            objects=objects,
            image_size=placed.size,
            data_objects=placed.objects,
            initial_image=bytes(image),
            tasks=[replace(s, symbol=Task(s.name, ()).symbol) for s in specs],
            symbols=symbols,
            retain=remanence.retain,
            persistent=remanence.persistent,
            exports=[f.name for f in functions.values() if f.exported],
            type_ids=lowered.type_ids,
            no_init=remanence.no_init,
            runtime={"byte_addressing": options.byte_addressing, "signatures": self.signatures},
        )
        package.code_id = _code_id(package)
        package.online_change = change
        result.package = package
        result.code_size = sum(len(o) for o in objects)
        result.data_size = placed.size
        result.functions = len(functions)

    def place(self, lowered: Lowered) -> image_layout.Layout:
        """Sizes and signatures of all data objects, then their offsets."""
        signatures = image_layout.Signatures()
        wanted = [
            image_layout.Wanted(AREA_PREFIX + area, size, f"area:{size}")
            for area, size in self.area_sizes(lowered).items()
        ]
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
        return image_layout.place(
            wanted, self.previous.data_objects, self.previous.runtime.get("signatures", {})
        )

    def area_sizes(self, lowered: Lowered) -> dict[str, int]:
        """Bytes of each area: the configured size, or more when the program reaches further."""
        assert lowered.program is not None
        sizes = dict(self.options.area_sizes)
        for area, used in lowered.program.area_use.items():
            sizes[area] = max(sizes.get(area, 0), (used + 63) // 64 * 64)
        for area, size in sizes.items():
            lowered.module.data[AREA_PREFIX + area] = (size, 64)
        return sizes

    def compile(self, lowered: Lowered) -> list[bytes]:
        """Objects of the module, in parts when it is large."""
        options = OptimiseOptions(level=self.options.level)
        emit_options = EmitOptions(triple=options.triple)
        cache = self.session.cache(self.options.cache)
        cache.hits = cache.misses = 0
        parts = partition(lowered.module)
        with self.timed("compile"):
            compilation = Compilation(cache, options, parallel=len(parts) > 2)
            for part in parts:
                compilation.add(
                    emit_module(lowered.module, part.names, emit_options, len(parts) == 1, part.copies)
                )
            objects = compilation.objects()
        self.result.cached_objects = cache.hits
        return objects


def _code_id(package: CodePackage) -> str:
    digest = hashlib.blake2b(package.data_id.encode(), digest_size=12)
    for data in package.objects:
        digest.update(data)
    for task in package.tasks:
        digest.update(repr(task).encode())
    digest.update(package.initial_image)
    return digest.hexdigest()


# -- system code ------------------------------------------------------------------------------------


@dataclass(slots=True)
class SystemBuild:
    """Compiled ST of the product with the layouts of its structures."""

    object: bytes = field(repr=False)
    analysis: Analysis = field(repr=False)

    def size_of(self, type_name: str) -> int:
        """Bytes of a type."""
        return _named_type(self.analysis, type_name).size

    def members_of(self, type_name: str) -> dict[str, tuple[int, int, str]]:
        """Members of a structure: name to (offset, size, type name)."""
        return layout_of(self.analysis, type_name)


class SystemBuildError(RuntimeError):
    """ST of the product does not compile; the message lists the errors."""


def build_system(
    sources: Iterable[Source], level: int = 2, conversions: bool = False, absolute_data: bool = False
) -> SystemBuild:
    """Compile ST that stands alone: functions with attribute tappet_export and what they call, one object.

    Raises SystemBuildError. Global variables become imports `tappet.data.*` that the linker has to provide.
    """
    texts = list(sources)
    if conversions:
        texts += installed.load(CONVERSION_LIBRARY).sources
    parsed = [parse(source) for source in texts]
    analysis = analyse([p.unit for p in parsed], AnalysisOptions(system=True))
    found = [d for p in parsed for d in p.diagnostics] + analysis.diagnostics
    errors = [d for d in found if d.severity == "error"]
    if errors:
        raise SystemBuildError("\n".join(str(d) for d in errors))
    try:
        lowered = lower(analysis)
    except LoweringError as error:
        raise SystemBuildError(f"{error.uri}: {error.message}") from error
    passes.run(lowered.module)
    names = list(lowered.module.functions)
    text = emit_module(lowered.module, names, EmitOptions(absolute_data=absolute_data), whole=True)
    return SystemBuild(ObjectCache(None).compile(text, OptimiseOptions(level=level)), analysis)


def _named_type(analysis: Analysis, type_name: str) -> t.Type:
    found = analysis.types.get(type_name.upper())
    if found is None:
        for pou in analysis.pous:
            if pou.name.upper() == type_name.upper() and pou.instance is not None:
                return pou.instance
        raise KeyError(f"there is no type {type_name}")
    return found


def layout_of(analysis: Analysis, type_name: str) -> dict[str, tuple[int, int, str]]:
    """Members of a structure or function block: name as declared to (offset, size, type name).

    Raises KeyError when there is no such type, TypeError when it has no members.
    """
    type_ = _named_type(analysis, type_name)
    if not isinstance(type_, t.Struct | t.FunctionBlock):
        raise TypeError(f"{type_name} has no members")
    return {m.name: (m.offset, m.type.size, str(m.type)) for m in type_.members.values()}


__all__ = [
    "INIT_SYMBOL",
    "BuildOptions",
    "BuildResult",
    "LibraryReference",
    "build_application",
    "build_system",
]
