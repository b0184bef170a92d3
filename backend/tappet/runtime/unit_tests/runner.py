"""Builds an application with its tests and runs them on virtual time until all have finished.

An exception or an endless loop ends only the test it happens in: the application is started again without
that test, and what had finished before keeps its result. What a test does to the whole process is seen by
`attempts`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.source import Source
from tappet.libraries import as_called, resolve
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.unit_tests.bench import MOST_CHOSEN, Bench
from tappet.runtime.unit_tests.discovery import PROGRAM, TEST_LIBRARY, discover, program_text
from tappet.runtime.unit_tests.instrument import instrument
from tappet.runtime.unit_tests.known import NOTHING, Known, Mark
from tappet.runtime.unit_tests.memory import USED_UP, MemoryLimit, MemoryLimitReachedError
from tappet.runtime.unit_tests.order import TestLimits
from tappet.runtime.unit_tests.results import NO_TESTS, Report

DEFAULT_INTERVAL_NS = 10_000_000
NS_PER_S = 1_000_000_000
CHUNK = 100
"""Cycles between two looks whether all tests have finished."""


@dataclass(frozen=True, slots=True)
class TestProcess:
    """What a run in a process of its own needs, so that another one can continue where it ends."""

    known: Known
    """Outcomes of the processes before."""
    place: int
    """Address where the application keeps which test runs."""
    memory: MemoryLimit
    marks: Callable[[Sequence[Mark]], None]
    """Gets the marked places of the texts."""
    report: Callable[[Report, Known], None]
    """Gets what is known before and after each start of the application."""

    __test__ = False


def run_tests(
    sources: Iterable[Source],
    tasks: Sequence[Task] = (),
    options: BuildOptions | None = None,
    *,
    test_filter: str = "",
    only: Sequence[str] = (),
    limits: TestLimits | None = None,
    process: TestProcess | None = None,
) -> Report:
    """Run the tests of an application; nothing is raised for what is wrong with it.

    `test_filter` runs only tests with this text in `suite.test` (`*` for any text), `only` those with these
    very names (at most MOST_CHOSEN; with more, all run). Raises MemoryLimitReachedError when the limit of
    `process` is reached.
    """
    options = with_library(options or BuildOptions(), sources := list(sources))
    found = discover(result.unit for result in parse_sources(sources, ParseOptions(dict(options.defines))))
    if not found.suites and not found.programs:
        return Report(options.application, problem=NO_TESTS)
    marks: list[Mark] = []
    texts = [instrument(source, marks) for source in sources]
    programs = found.programs
    if not programs:
        texts.append(Source(PROGRAM, program_text(found.suites)))
        programs = (PROGRAM,)
    task = Task("Tests", interval_ns=_interval(tasks, programs), programs=programs)
    result = build_application(texts, (task,), options)
    if result.package is None:
        # as the engineer wrote it: the columns of what was put in are nobody's business
        plain = build_application(sources, tasks, replace(options, check_only=True))
        errors = [d for d in (plain.diagnostics or result.diagnostics) if d.severity == "error"]
        errors = errors or [d for d in result.diagnostics if d.severity == "error"]
        return Report(options.application, diagnostics=tuple(d.record() for d in errors))
    chosen = tuple(only) if len(only) <= MOST_CHOSEN else ()
    if process is not None:
        process.marks(marks)
    run = _Run(
        options.application, result.package, marks, limits or TestLimits(), test_filter, chosen, process
    )
    return run.all()


def with_library(options: BuildOptions, sources: Iterable[Source]) -> BuildOptions:
    """Options with the test library, under the name that the texts call it by."""
    libraries, _ = resolve(options.libraries)
    if any(library.name == TEST_LIBRARY for library in libraries):
        return options
    reference = LibraryReference(as_called(TEST_LIBRARY, [source.text for source in sources]))
    return replace(options, libraries=(*options.libraries, reference))


def _interval(tasks: Sequence[Task], programs: Sequence[str]) -> int:
    """That of the task which calls the tests in the application."""
    wanted = {name.upper() for name in programs}
    for task in tasks:
        if task.interval_ns and wanted & {name.upper() for name in task.programs}:
            return task.interval_ns
    return DEFAULT_INTERVAL_NS


class _Run:
    """The starts of one application until every test has an outcome."""

    def __init__(
        self,
        application: str,
        package: CodePackage,
        marks: Sequence[Mark],
        limits: TestLimits,
        test_filter: str,
        only: Sequence[str],
        process: TestProcess | None,
    ) -> None:
        self.application = application
        self.package = package
        self.limits = limits
        self.bench = Bench(package.symbols, marks, process.known if process is not None else NOTHING)
        self.filter = test_filter
        self.only = only
        self.process = process

    def all(self) -> Report:
        bench = self.bench
        for _ in range(self.limits.restarts):
            problem = self._start()
            report = Report(self.application, bench.suites(), problem)
            if problem is not None or bench.complete:
                return report
            self._report()
            if self.process is not None and self.process.memory.used_up:
                raise MemoryLimitReachedError
        return Report(self.application, bench.suites(), f"given up after {self.limits.restarts} exceptions")

    def _report(self) -> None:
        if self.process is not None:
            self.process.report(Report(self.application, self.bench.suites()), self.bench.known())

    def _start(self) -> str | None:
        """One start: runs until all tests have finished or one ends in an exception."""
        bench = self.bench
        no_flight = FlightSettings(memory=0)  # nobody looks back here, and the results make a large image
        limit = self.limits.cycle_s
        with LocalRuntime(self.package, start=False, cycle_limit_s=limit, flight=no_flight) as runtime:
            if runtime.exception is not None:
                return f"the application does not start: {ApplicationException(runtime.exception)}"
            bench.prepare(runtime, self.filter, self.only, self.process.place if self.process else 0)
            if self.process is not None:
                self.process.memory.begin()
            self._report()
            runtime.start()
            end_ns = runtime.now_ns + int(self.limits.simulated_s * NS_PER_S)
            cycles = 1
            try:
                while not bench.finished(runtime):
                    if runtime.now_ns >= end_ns:
                        bench.collect(runtime)
                        bench.give_up(self.limits.simulated_s)
                        return None
                    runtime.run(cycles)
                    cycles = CHUNK
            except ApplicationException as error:
                note = self._memory_note(runtime)
                bench.collect(runtime)
                return bench.broken(runtime, error.report, note)
            bench.collect(runtime)
            bench.complete = True
            return bench.overflow(runtime)

    def _memory_note(self, runtime: LocalRuntime) -> str:
        """What is to be said of an exception that came when memory was used up."""
        if self.process is None:
            return ""
        memory = self.process.memory
        memory.lift()
        if memory.used_up:
            return f"; the memory for tests is used up ({memory.mib} MiB)"
        heap = runtime.plc.application.heap if runtime.plc.application is not None else None
        if heap is not None and heap.used[1] > USED_UP * heap.limit:
            return f"; the memory of __NEW is used up ({heap.limit >> 20} MiB)"
        return ""
