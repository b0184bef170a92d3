"""From source texts to a code package: parse, analyse, lower, lay out, emit, optimise.

`build_application` is the driver for applications, `build_system` for ST that is part of the product and
linked by itself, `layout_of` gives Python the offsets of ST structures.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from tappet import libraries as installed
from tappet.codegen.generate import Generated, GenerateOptions, Generator
from tappet.codegen.identity import program_digest, text_digest
from tappet.codegen.layout import ImageTooLargeError
from tappet.codegen.optimise import ObjectCache
from tappet.codegen.package import CodePackage, TaskSpec
from tappet.codegen.system import SystemBuild, SystemBuildError, build_system, layout_of
from tappet.codegen.tasks import default_tasks, task_specs
from tappet.core.program import CONVERSION_LIBRARY, LoweringError
from tappet.core.relower import Edit
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.analysis.run import analyse
from tappet.lang.analysis.tasks import Task, check_tasks
from tappet.lang.coding_settings import NO_RULES, StaticAnalysis
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.diagnostics import Diagnostic, report
from tappet.lang.parser import ParseResult
from tappet.lang.room_for_trees import room_for_trees
from tappet.lang.source import NOWHERE, Scope, Source, Span
from tappet.project.library_reference import LibraryReference


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
    free_addresses: bool = True
    """Incomplete addresses that VAR_CONFIG does not name get a free place; False: an error (LDEC-94)."""
    static: StaticAnalysis = NO_RULES
    """The optional coding rules that are checked."""


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
    partial: bool = False
    """Only what an edit changed was generated; the rest is that of the build before."""

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
    @property
    def language(self) -> str | None: ...


class BuildSession:
    """What builds of one application keep: after an edit only what can depend on it is made again.

    Analysis fills the trees in place, so a session must not be used by two builds at once.
    """

    def __init__(self) -> None:
        self.parsed: dict[Source, ParseResult] = {}
        self.objects: dict[Path | None, ObjectCache] = {}
        self.analysis: Analysis | None = None
        self.generated: Generated | None = None
        self.edit = Edit()
        """What is new since `generated`."""
        self.digests: dict[Source, bytes] = {}

    def analyse(self, parsed: Sequence[ParseResult], options: AnalysisOptions) -> Analysis:
        """The program, analysed as a whole or only in the bodies that were edited."""
        self.settle()
        analysis = analyse([p.unit for p in parsed], options, self.analysis)
        self.analysis = analysis
        made, bodies = analysis.redeclared, analysis.changed
        if made is not None:
            self.edit.texts |= made.texts
            self.edit.things |= made.things
            bodies = made.bodies
        if bodies is None:
            self.generated, self.edit = None, Edit()
        else:
            self.edit.bodies |= {id(pou): pou for pou in bodies}
        return analysis

    def settle(self) -> None:
        """Do what the next build needs done before it: best when nobody waits."""
        if self.generated is not None:
            with room_for_trees():
                self.generated.settle()

    def digest(self, settings: object) -> bytes:
        """Digest of the program that was parsed last, and of `settings`."""
        self.digests = {text: self.digests.get(text) or text_digest(text) for text in self.parsed}
        return program_digest(self.digests.values(), settings)

    def cache(self, folder: Path | None) -> ObjectCache:
        """Objects in memory, and in `folder` unless it is None."""
        if folder not in self.objects:
            self.objects = {folder: ObjectCache(folder)}
            self.objects[folder].trim()
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
        text.language,
    )


def build_application(
    sources: Iterable[Source | SourceLike],
    tasks: Iterable[Task] = (),
    options: BuildOptions | None = None,
    previous: CodePackage | None = None,
    session: BuildSession | None = None,
) -> BuildResult:
    """Build an application. Errors of the program are diagnostics; nothing is raised for them.

    With `previous`, the package that runs now, unchanged data keep their place and the result says how to
    change over without stopping.
    """
    options = options or BuildOptions()
    with room_for_trees():
        return _Build(options, previous, session or BuildSession()).run(list(sources), list(tasks))


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
            spent = time.perf_counter() - start
            self.result.timings[stage] = self.result.timings.get(stage, 0.0) + spent

    def run(self, given: list[Source | SourceLike], task_list: list[Task]) -> BuildResult:
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
                free_addresses=options.free_addresses,
                static=options.static,
            )
            analysis = self.session.analyse(parsed, settings)
        result.analysis = analysis
        result.diagnostics += [d for p in parsed for d in p.diagnostics]
        result.diagnostics += analysis.diagnostics
        if task_list:
            result.diagnostics += check_tasks(task_list, analysis)
        if any(d.severity == "error" for d in result.diagnostics):
            return result
        specs = task_specs(task_list) or default_tasks(analysis, sources, options.main_program)
        try:
            self.generate(analysis, specs)
        except LoweringError as error:
            span = error.span if isinstance(error.span, Span) else NOWHERE
            result.diagnostics.append(report("E0901", error.uri, span, message=error.message))
        except ImageTooLargeError as error:
            result.diagnostics.append(report("E0901", "", NOWHERE, message=str(error)))
        return result

    def library_sources(self) -> list[Source]:
        """Texts of the libraries in use, of those they need and of the conversion library."""
        found, problems = installed.resolve([*self.options.libraries, LibraryReference(CONVERSION_LIBRARY)])
        self.result.diagnostics += problems
        return [source for library in found for source in library.sources]

    def generate(self, analysis: Analysis, specs: list[TaskSpec]) -> None:
        """Objects and package; after an edit only what that changed."""
        result, options, session = self.result, self.options, self.session
        settings = GenerateOptions(
            options.application,
            options.device,
            options.level,
            options.byte_addressing,
            options.area_sizes,
            options.cache,
        )
        cache = session.cache(options.cache)
        with self.timed("package"):
            program = session.digest((options.level, options.byte_addressing, options.defines))
        generator = Generator(settings, program, self.previous, cache, self.timed, result.diagnostics)
        last, session.generated = session.generated, None
        done = None
        if last is not None and (last.options, last.specs) == (settings, specs) and not options.check_only:
            done = generator.again(last, analysis, session.edit)
        result.partial = done is not None
        if done is None:
            done = generator.whole(analysis, specs, options.check_only)
        if done is None:
            return
        session.generated = done
        session.edit = Edit()
        result.package = done.package
        result.cached_objects = cache.hits
        result.code_size = sum(len(o) for o in done.objects)
        result.data_size = done.laid.placed.size
        result.functions = len(done.lowered.module.functions)


__all__ = [
    "BuildOptions",
    "BuildResult",
    "BuildSession",
    "LibraryReference",
    "SystemBuild",
    "SystemBuildError",
    "build_application",
    "build_system",
    "layout_of",
]
