"""The documents of one project with their unsaved texts, and the checked programs they make.

`Workspace` keeps what was parsed and analyses again only when a text has changed. A `Snapshot` is what one
analysis knows; every service works on one. One thread at a time may use a workspace.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, Protocol

from tappet.lang import ast
from tappet.lang.analysis import Analysis, AnalysisOptions, analyse, prepare, resume
from tappet.lang.analysis.libraries import LibrarySnapshot, are_analysed, own_results, read_program
from tappet.lang.analysis.suppression import without_warnings
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.lexer import Lexed, lex
from tappet.lang.parser import ParseResult
from tappet.lang.services.documents import Place, Position, Program, Programs, Text
from tappet.lang.services.results import ServiceError
from tappet.lang.source import Scope, Source, Span
from tappet.lang.symbols import InterfaceSymbol, PouSymbol

SLOW_S = 0.15
"""From here on, an analysis is too slow to be repeated at every key; completion then uses the last one."""


class LibraryIndex(Protocol):
    """Knows which texts of libraries a program can reach."""

    def reached(self, libraries: Sequence[Source], own: Sequence[Source]) -> Collection[Source] | None:
        """Those texts; None when that is not known, or it is all of them."""

    def make(self, libraries: Sequence[Source]) -> None:
        """These libraries are analysed: find out what is to be known of them the next time."""


class View:
    """A text with its tokens, its tree and a position in it: where a service starts."""

    def __init__(
        self, snapshot: Snapshot, index: int, text: Text, result: ParseResult, position: Position
    ) -> None:
        self.snapshot = snapshot
        self.index = index
        """Number of the text in the program."""
        self.text = text
        self.result = result
        self.position = position

    @property
    def source(self) -> Source:
        """The text for the compiler."""
        return self.text.source

    @property
    def unit(self) -> ast.Unit:
        """Its tree."""
        return self.result.unit

    @cached_property
    def lexed(self) -> Lexed:
        """Its tokens."""
        return lex(self.source.text, self.source.uri)

    def place(self, span: Span) -> Place:
        """A range of the text in its document."""
        return self.text.place(span)


class Snapshot:
    """One analysis of one program."""

    def __init__(
        self,
        program: Program,
        results: list[ParseResult],
        analysis: Analysis,
        libraries: LibrarySnapshot | None,
        is_reduced: bool = False,
    ) -> None:
        self.program = program
        self.results = results
        self.analysis = analysis
        self.libraries = libraries
        """Those of the program, shared with other programs; None: they are analysed with it."""
        self.is_reduced = is_reduced
        """Library texts that the program does not reach are left out: messages cannot propose their names."""
        self.published: dict[str, Any] = {}
        """The messages of texts as they were shown last, by uri; goes from snapshot to snapshot."""
        self.derived: dict[str, Any] = {}
        """What services have worked out and keep for their next request."""
        self._by_source: dict[str, int] = {}
        self._by_document: dict[str, int] = {}
        for index, text in enumerate(program.texts):
            self._by_source.setdefault(text.source.uri, index)
            for segment in text.segments:
                self._by_document.setdefault(segment.document, index)

    def shows(self, document: str) -> bool:
        """Whether a document is part of the program."""
        return document in self._by_document

    def documents(self) -> Iterator[str]:
        """All documents of the program."""
        return iter(self._by_document)

    def view(self, document: str, position: Position) -> View:
        """What stands at a position of a document. Raises ServiceError for a document of another program."""
        index = self._by_document.get(document)
        if index is None:
            raise ServiceError(f"'{document}' is no document of {self.program.name}")
        text = self.program.texts[index]
        inside = text.position(document, position)
        assert inside is not None
        return View(self, index, text, self.results[index], inside)

    def place(self, source_uri: str, span: Span) -> Place | None:
        """A range of a source in its document."""
        index = self._by_source.get(source_uri)
        return None if index is None else self.program.texts[index].place(span)

    def text_of(self, source_uri: str) -> Text | None:
        """The text with this source uri."""
        index = self._by_source.get(source_uri)
        return None if index is None else self.program.texts[index]

    def units(self) -> Iterator[tuple[Text, ast.Unit]]:
        """Every text with its tree."""
        for text, result in zip(self.program.texts, self.results, strict=True):
            yield text, result.unit

    @property
    def is_waiting(self) -> bool:
        """Whether something is left for later: bodies, or texts of libraries."""
        return self.analysis.is_waiting or self.is_reduced

    @cached_property
    def diagnostics(self) -> list[Diagnostic]:
        """All messages that the program reports, those of the parser first."""
        found = [item for result in self.results for item in result.diagnostics]
        return without_warnings(found + self.analysis.diagnostics, self.program.disabled_warnings)

    @cached_property
    def pous(self) -> dict[str, PouSymbol]:
        """Programs, functions, blocks, and `BLOCK.METHOD`, by upper-case name."""
        found: dict[str, PouSymbol] = {}
        for pou in self.analysis.pous:
            found.setdefault(pou.qualified_name.upper(), pou)
            for child in pou.children():
                found.setdefault(f"{pou.name}.{child.name}".upper(), child)
        for interface in self.analysis.interfaces.values():
            for method in interface.methods.values():
                found.setdefault(f"{interface.name}.{method.name}".upper(), method)
        return found

    @cached_property
    def interfaces(self) -> dict[str, InterfaceSymbol]:
        """Interfaces by upper-case name."""
        return {name.upper(): symbol for name, symbol in self.analysis.interfaces.items()}


class Workspace:
    """The programs of a project and the documents open in an editor."""

    def __init__(self, programs: Programs, index: LibraryIndex | None = None) -> None:
        self._programs = programs
        self._index = index
        self._unsaved: dict[str, str] = {}
        self._parsed: dict[str, dict[Source, ParseResult]] = {}
        self._snapshots: dict[str, Snapshot] = {}
        self._seconds: dict[str, float] = {}
        self._composed: list[Program] | None = None
        self._showing: dict[str, list[tuple[Program, Text]]] | None = None
        """Texts of the composed programs by the documents that they show."""
        self.generation = 0
        """Grows with every change."""
        self.whole_analyses = 0
        """Analyses so far that had to look at more than edited bodies."""
        self._analysed: dict[str, int] = {}

    # -- documents

    def open(self, document: str, text: str) -> None:
        """Use `text` for a document until it is closed."""
        if self._unsaved.get(document) != text:
            self._unsaved[document] = text
            self.refresh()

    def close(self, document: str) -> None:
        """Use the stored text of a document again."""
        if self._unsaved.pop(document, None) is not None:
            self.refresh()

    def unsaved(self, document: str) -> str | None:
        """The text of the editor for a document."""
        return self._unsaved.get(document)

    def refresh(self) -> None:
        """Something has changed: compose the programs again at the next request."""
        self.generation += 1
        self._composed = self._showing = None

    # -- programs

    def programs(self) -> list[Program]:
        """The programs with all unsaved texts in them."""
        if self._composed is None:
            self._composed = list(self._programs(self._unsaved))
        return self._composed

    def program_of(self, document: str) -> Program:
        """The first program that shows a document. Raises ServiceError when none does."""
        for program, _ in self._texts_showing(document):
            return program
        raise ServiceError(f"'{document}' belongs to no application; it is not compiled")

    def texts_showing(self, document: str) -> list[Text]:
        """The texts that show a document, those of the first program first."""
        return [text for _, text in self._texts_showing(document)]

    def _texts_showing(self, document: str) -> list[tuple[Program, Text]]:
        if self._showing is None:
            self._showing = {}
            for program in self.programs():
                for text in program.texts:
                    for shown in dict.fromkeys(segment.document for segment in text.segments):
                        self._showing.setdefault(shown, []).append((program, text))
        return self._showing.get(document, [])

    def is_drawn(self, document: str) -> bool:
        """Whether a document is drawn: its lines are those of its listing, not those of what is stored."""
        return any(text.map.is_drawn(document) for text in self.texts_showing(document))

    def snapshot(self, document: str) -> Snapshot:
        """The analysis of the program that shows a document, of the texts as they are now."""
        return self._analyse(self.program_of(document))

    def snapshots(self) -> list[Snapshot]:
        """The analyses of all programs."""
        return [self._analyse(program) for program in self.programs()]

    def first_snapshots(self, documents: Collection[str]) -> list[Snapshot]:
        """Analyses of all programs that may leave other texts than these for later, and those of libraries
        that they do not reach (`Snapshot.is_waiting`)."""
        return [self._analyse(program, documents) for program in self.programs()]

    def in_texts_of(self, documents: Collection[str]) -> set[str]:
        """Documents and those that are parts of the same texts, as declaration and implementation are."""
        texts = [text for document in documents for text in self.texts_showing(document)]
        return {*documents, *(segment.document for text in texts for segment in text.segments)}

    def resume(self, seconds: float) -> bool:
        """Work on what `first_snapshots` has left, for so long; whether nothing is left. Libraries that were
        left out are analysed in one go."""
        if any(snapshot.is_reduced for snapshot in self._snapshots.values()):
            self.snapshots()
        return all(resume(snapshot.analysis, seconds) for snapshot in self._snapshots.values())

    def prepare(self) -> None:
        """Do what the first edit of declarations would have to do for every text, and what makes the first
        messages of the next process quick."""
        for snapshot in self._snapshots.values():
            prepare(snapshot.analysis)
            if self._index is not None and snapshot.libraries is not None and not snapshot.is_reduced:
                self._index.make(_libraries_of(snapshot.program))

    def quick_view(self, document: str, position: Position) -> View:
        """What stands at a position now, with symbols of the last analysis if a new one would take long."""
        program = self.program_of(document)
        last = self._snapshots.get(program.name)
        slow = self._seconds.get(program.name, 0.0) > SLOW_S
        if last is None or not slow or self._analysed.get(program.name) == self.generation:
            return self._analyse(program).view(document, position)
        for index, text in enumerate(program.texts):
            inside = text.position(document, position)
            if inside is not None:
                (result,) = parse_sources([text.source])
                return View(last, index, text, result, inside)
        raise AssertionError(document)

    def trial_view(self, document: str, position: Position, trial: str) -> View:
        """What would stand at a position if `trial` were the text of the document, with the present symbols.

        For a text that is only being tried, such as a cell of a table that is still open. Nothing is kept.
        Raises ServiceError when no program shows the document.
        """
        snapshot = self.snapshot(document)
        for program in self._programs({**self._unsaved, document: trial}):
            for index, text in enumerate(program.texts):
                inside = text.position(document, position)
                if inside is not None and program.name == snapshot.program.name:
                    (result,) = parse_sources([text.source])
                    return View(snapshot, index, text, result, inside)
        raise ServiceError(f"'{document}' belongs to no application; it is not compiled")

    def _analyse(self, program: Program, documents: Collection[str] | None = None) -> Snapshot:
        """The analysis of a program; `documents` come first and the others may wait."""
        last = self._snapshots.get(program.name)
        fresh = last is not None and self._analysed.get(program.name) == self.generation
        if last is not None and fresh and (documents is not None or not last.is_waiting):
            return last
        started = time.perf_counter()
        settings = AnalysisOptions(static=program.static)
        whole = program
        if documents is not None and not fresh:
            program = self._reduced(program, settings)
        if last is not None and fresh and not last.is_reduced:
            results, libraries = last.results, last.libraries
        else:
            sources = [text.source for text in program.texts]
            plain = self._parsed.get(program.name, {})
            options = ParseOptions(defines=program.defines, tasks=program.tasks)
            results, libraries = read_program(sources, settings, options, plain)
            self._parsed[program.name] = {r.unit.source: r for r in own_results(results, libraries)}
        previous = last.analysis if last is not None else None
        first = None if documents is None else _sources_of(program, documents)
        own = [result.unit for result in own_results(results, libraries)]
        analysis = analyse(own, settings, previous, first, libraries)
        self.whole_analyses += not analysis.continued
        snapshot = Snapshot(program, results, analysis, libraries, is_reduced=program is not whole)
        if last is not None:
            snapshot.published = last.published
        self._snapshots[program.name] = snapshot
        self._analysed[program.name] = self.generation
        self._seconds[program.name] = time.perf_counter() - started
        return snapshot

    def _reduced(self, program: Program, settings: AnalysisOptions) -> Program:
        """A program with the library texts that it reaches, while its libraries are not analysed."""
        libraries = _libraries_of(program)
        if self._index is None or are_analysed(libraries, settings):
            return program
        own = [text.source for text in program.texts if text.source.scope is not Scope.LIBRARY]
        reached = self._index.reached(libraries, own)
        if reached is None:
            return program
        kept = set(reached)
        texts = [t for t in program.texts if t.source.scope is not Scope.LIBRARY or t.source in kept]
        return replace(program, texts=texts) if len(texts) < len(program.texts) else program


def _libraries_of(program: Program) -> list[Source]:
    return [text.source for text in program.texts if text.source.scope is Scope.LIBRARY]


def _sources_of(program: Program, documents: Collection[str]) -> frozenset[str]:
    """Uris of the texts that show documents."""
    return frozenset(
        text.source.uri for text in program.texts if any(s.document in documents for s in text.segments)
    )
