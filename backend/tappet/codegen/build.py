"""From source texts to a code package: parse, analyse, lower, lay out, emit, optimise.

`build_application` is the driver for applications; ST that is part of the product is built by `system`.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

from tappet.codegen.generate import Generated, GenerateOptions, Generator
from tappet.codegen.identity import program_digest, text_digest
from tappet.codegen.object_cache import ObjectCache
from tappet.codegen.package import CodePackage, TaskSpec
from tappet.codegen.tasks import default_tasks, task_specs
from tappet.core.edits.edit import Edit
from tappet.core.internal_error import At, InternalError, reason_of
from tappet.core.program import CONVERSION_LIBRARY, LoweringError
from tappet.iec.heap import DEFAULT_HEAP, HeapSettings
from tappet.iec.memory import DEFAULT_RESERVE, ChangeReserve, ImageTooLargeError
from tappet.iec.source import source_maps
from tappet.iec.task import Task
from tappet.lang.analysis.libraries import LibrarySnapshot, own_results, read_program
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.analysis.run import analyse
from tappet.lang.analysis.suppression import without_warnings
from tappet.lang.analysis.tasks import check_tasks
from tappet.lang.coding_settings import NO_RULES, StaticAnalysis
from tappet.lang.conditional import ParseOptions
from tappet.lang.deep_trees import deep_recursion
from tappet.lang.diagnostics import Diagnostic, report, with_elements
from tappet.lang.parser import ParseResult
from tappet.lang.source import NOWHERE, Source, Span
from tappet.libraries import resolve
from tappet.project.library_reference import LibraryReference

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class BuildOptions:
    """How an application is built."""

    application: str = "Application"
    project: str = ""
    """Name of the project, for programs that ask."""
    compiled: int = 0
    """Unix time in s that programs are told as that of the build."""
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
    disabled_warnings: frozenset[str] = frozenset()
    """Codes of warnings that are not reported."""
    heap: HeapSettings = DEFAULT_HEAP
    """The memory of `__NEW`."""
    reserve: ChangeReserve = DEFAULT_RESERVE
    """The memory for online changes, which the runtime sets aside."""
    once: bool = False
    """The process builds this application no more: library texts that it cannot reach are left out."""


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


class BuildSession:
    """What builds of one application keep: after an edit only what can depend on it is made again.

    Analysis fills the trees in place, so a session must not be used by two builds at once.
    """

    def __init__(self) -> None:
        self.texts: tuple[Source, ...] = ()
        self.parsed: dict[Source, ParseResult] = {}
        """Trees of the texts but for those of shared libraries."""
        self.objects: dict[Path | None, ObjectCache] = {}
        self.analysis: Analysis | None = None
        self.generated: Generated | None = None
        self.edit = Edit()
        """What is new since `generated`."""
        self.digests: dict[Source, bytes] = {}

    def analyse(
        self, parsed: Sequence[ParseResult], options: AnalysisOptions, libraries: LibrarySnapshot | None
    ) -> Analysis:
        """The program, analysed as a whole or only in the bodies that were edited."""
        self.settle()
        own = [result.unit for result in own_results(parsed, libraries)]
        analysis = analyse(own, options, self.analysis, libraries=libraries)
        self.analysis = analysis
        made, bodies = analysis.redeclared, analysis.changed
        if made is not None:
            self.edit.texts |= made.texts
            self.edit.entities |= made.entities
            bodies = made.bodies
        if bodies is None:
            self.generated, self.edit = None, Edit()
        else:
            self.edit.bodies |= {id(pou): pou for pou in bodies}
        return analysis

    def settle(self) -> None:
        """Do what the next build needs done before it: best when nobody waits."""
        if self.generated is not None:
            with deep_recursion():
                self.generated.settle()

    def digest(self, settings: object) -> bytes:
        """Digest of the program that was parsed last, and of `settings`."""
        self.digests = {text: self.digests.get(text) or text_digest(text) for text in self.texts}
        return program_digest(self.digests.values(), settings)

    def cache(self, folder: Path | None) -> ObjectCache:
        """Objects in memory, and in `folder` unless it is None."""
        if folder not in self.objects:
            self.objects = {folder: ObjectCache(folder)}
        return self.objects[folder]

    def read(
        self, sources: Sequence[Source], options: AnalysisOptions, parse_options: ParseOptions
    ) -> tuple[list[ParseResult], LibrarySnapshot | None]:
        """Trees of all texts, and the libraries among them; forgets texts that are gone."""
        results, libraries = read_program(sources, options, parse_options, self.parsed)
        self.parsed = {result.unit.source: result for result in own_results(results, libraries)}
        return results, libraries


def build_application(
    sources: Iterable[Source],
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
    texts, task_list = list(sources), list(tasks)
    with deep_recursion():
        result = _Build(options, previous, session or BuildSession()).run(texts, task_list)
        if options.once and any(d.severity == "error" for d in result.diagnostics):
            options = replace(options, once=False)  # messages propose names of all libraries
            result = _Build(options, previous, BuildSession()).run(texts, task_list)
    reported = without_warnings(result.diagnostics, options.disabled_warnings)
    result.diagnostics[:] = with_elements(reported, texts)
    if result.package is not None:
        result.package.source_maps = source_maps(texts)
        result.package.facts.project = options.project
        result.package.facts.compiled = options.compiled
        result.package.facts.reserve = (options.reserve.percent, options.reserve.least)
    return result


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

    def run(self, given: list[Source], task_list: list[Task]) -> BuildResult:
        result, options = self.result, self.options
        installed = self.library_sources()
        sources = given + installed
        if options.once:
            from tappet.libraries.named import named_texts

            with self.timed("parse"):
                reached = given + named_texts(installed, given)
        else:
            reached = sources
        with self.timed("parse"):
            names = [task.name for task in task_list]
            settings = AnalysisOptions(
                system=options.system,
                byte_addressing=options.byte_addressing,
                main_program=options.main_program,
                free_addresses=options.free_addresses,
                static=options.static,
            )
            parse_options = ParseOptions(dict(options.defines), names)
            parsed, libraries = self.session.read(reached, settings, parse_options)
            self.session.texts = tuple(sources)
        with self.timed("analyse"):
            analysis = self.session.analyse(parsed, settings, libraries)
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
            from tappet.core.lower import data_owners, size_of

            largest = max(data_owners(analysis), key=size_of)
            uri = largest.source.uri if largest.source is not None else ""
            result.diagnostics.append(report("E0901", uri, largest.span or NOWHERE, message=str(error)))
        except InternalError as error:
            self.failed(error)
        except Exception as error:
            self.failed(InternalError("code generation", At(options.application), reason_of(error)), error)
        return result

    def failed(self, error: InternalError, cause: Exception | None = None) -> None:
        """A defect of the compiler ends in a message with a place; who mends it finds the rest in the log."""
        _log.error("internal error of the compiler: %s", error, exc_info=cause or error)
        at = error.at
        span = Span(at.line - 1, 0, at.line - 1, 0) if at.line else NOWHERE
        facts = {"name": at.name, "stage": error.stage, "reason": error.reason}
        self.result.diagnostics.append(report("E0905", at.uri, span, **facts))

    def library_sources(self) -> list[Source]:
        """Texts of the libraries in use, of those they need and of the conversion library."""
        found, problems = resolve([*self.options.libraries, LibraryReference(CONVERSION_LIBRARY)])
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
            options.heap,
        )
        cache = session.cache(options.cache)
        with self.timed("package"):
            known_by = (options.level, options.byte_addressing, options.defines, options.heap)
            program = b"" if options.check_only else session.digest(known_by)
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
    "build_application",
]
