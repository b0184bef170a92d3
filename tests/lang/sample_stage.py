"""A sample as sources and tasks, and what the compiler reports about it."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from tappet.codegen.build import BuildOptions, LibraryReference
from tappet.codegen.check import check_application
from tappet.lang.analysis import AnalysisOptions, analyse, check_tasks
from tappet.lang.coding_settings import StaticAnalysis
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.rules import coding_rules
from tappet.lang.source import BodyText, Scope, Source
from tappet.project.library_reference import ParameterValue

_OBJECT = re.compile(
    r"^\s*(?:\{[^}]*\}\s*)*"
    r"(PROGRAM|FUNCTION|FUNCTION_BLOCK|INTERFACE|METHOD|ACTION|PROPERTY|VAR_GLOBAL|VAR_CONFIG)\b",
    re.MULTILINE,
)
ALL_CODING_RULES = frozenset(code for rule in coding_rules() for code in rule.CODES)


@dataclass(frozen=True, slots=True)
class SampleWatchdog:
    """See `analysis.tasks.Watchdog`."""

    time_ns: int
    sensitivity: int


@dataclass(slots=True)
class SampleTask:
    """See `analysis.tasks.Task`."""

    name: str
    kind: str
    interval_ns: int
    priority: int
    event: str | None
    programs: list[str]
    watchdog: SampleWatchdog | None = None


@dataclass(slots=True)
class Stage:
    """What the `@` lines of a sample say, and its texts."""

    sources: list[Source] = field(default_factory=list)
    tasks: list[SampleTask] = field(default_factory=list)
    references: list[LibraryReference] = field(default_factory=list)
    static: bool = False
    build: bool = False
    configured: bool = False
    """Whether every incomplete address needs a line of VAR_CONFIG."""
    frames: int | None = None
    main: bool = False
    """Whether the tasks are checked although there are none."""


def stage(text: str) -> Stage:
    """The texts of a sample as sources, and what its `@` lines say."""
    made = Stage()
    head: list[str] = []
    language: str | None = None
    lines: list[str] = []

    def end() -> None:
        nonlocal language
        if "".join(lines).strip():
            made.sources.append(_source(head, "\n".join(lines) + "\n", language))
        lines.clear()
        language = None

    for line in text.splitlines():
        word, *rest = line.split() or [""]
        if word == "@source":
            end()
            head = rest
        elif word == "@task":
            name, kind, interval, priority, event, *programs = rest
            period = int(float(interval) * 1_000_000)
            made.tasks.append(
                SampleTask(name, kind, period, int(priority), None if event == "-" else event, programs)
            )
        elif word == "@watchdog":
            task = next(t for t in made.tasks if t.name == rest[0])
            task.watchdog = SampleWatchdog(int(rest[1]) * 1_000_000, int(rest[2]))
        elif word == "@language":
            language = rest[0]
        elif word == "@references":
            made.references += [LibraryReference(name) for name in rest]
        elif word == "@given":
            last = made.references[-1]
            value = ParameterValue(rest[0], rest[1], " ".join(rest[2:]))
            made.references[-1] = replace(last, parameters=(*last.parameters, value))
        elif word == "@static":
            made.static = True
        elif word == "@configured":
            made.configured = True
        elif word == "@build":
            made.build = True
        elif word == "@frames":
            made.frames = int(rest[0])
        elif word == "@tasks":
            made.main = True
        else:
            lines.append(line)
    end()
    return made


def _source(head: list[str], text: str, language: str | None) -> Source:
    name, kind, *rest = [*head, "", ""] if head else ["Sample", ""]
    text = _whole(text)
    bodies = () if language is None else (BodyText(0, language),)
    if kind == "pous":
        return Source(name, text, Scope.POUS, bodies=bodies)
    if kind == "library":
        qualified_only = "qualified_only" in rest
        return Source(
            name,
            text,
            Scope.LIBRARY,
            library=rest[0],
            namespace=rest[0],
            qualified_only=qualified_only,
            bodies=bodies,
        )
    if kind == "owner":
        return Source(f"{rest[0]}.{name}", text, owner=rest[0], bodies=bodies)
    return Source(name, text, bodies=bodies, name=name if "VAR_GLOBAL" in text else None)


def _whole(text: str) -> str:
    """A sample without an object is the inside of a program, behind its types."""
    if _OBJECT.search(text):
        return text
    types, found, rest = text.rpartition("END_TYPE\n")
    if found and not rest.strip():
        return text
    return f"{types}{found}PROGRAM Sample\n{rest}END_PROGRAM\n"


@contextmanager
def _frames_left(frames: int | None) -> Iterator[None]:
    """Limits the depth of Python's stack to so many calls from here."""
    limit = sys.getrecursionlimit()
    if frames is not None:
        sys.setrecursionlimit(len(inspect.stack(0)) + frames)
    yield
    sys.setrecursionlimit(limit)


def diagnose(text: str) -> list[Diagnostic]:
    """What parsing, analysis and the checks of tasks report about a sample."""
    made = stage(text)
    static = StaticAnalysis(ALL_CODING_RULES if made.static else frozenset())
    if made.build or made.references:
        options = BuildOptions(libraries=tuple(made.references), static=static)
        return check_application(made.sources, made.tasks, options)
    results = parse_sources(made.sources, ParseOptions())
    options = AnalysisOptions(static=static, free_addresses=not made.configured)
    with _frames_left(made.frames):
        analysis = analyse([r.unit for r in results], options)
    found = [d for r in results for d in r.diagnostics] + analysis.diagnostics
    if made.tasks or made.main:
        found += check_tasks(made.tasks, analysis)
    return found
