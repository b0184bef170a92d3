"""Libraries, analysed once: the outer scope of every application that refers to them.

Contract: a `LibrarySnapshot` holds the trees of all library texts of an application with their symbols,
types, layouts, checked bodies and messages. An application is analysed around it and changes nothing in it:
any number of analyses, also in other threads, use one at the same time. Snapshots are kept by content for the
process.

An application can matter to a library in two ways, which are part of the key: a block without methods that
it extends gets a method table, and objects named like its own are linked under another name. Libraries with
conditional pragmas, with generic blocks, with variables at addresses, or with parameters whose values name
what a project declares depend on the application as a whole: they have no snapshot and are analysed with it.
"""

from __future__ import annotations

import re
import threading
from collections import OrderedDict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

from tappet.lang import ast
from tappet.lang.analysis.bodies import State, analyse_body
from tappet.lang.analysis.collect import collect
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Record, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.declare import all_pous, declare
from tappet.lang.analysis.generic import generic_constants
from tappet.lang.analysis.program import check_pous
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.conditional.directives import has_directives
from tappet.lang.languages.support import with_libraries
from tappet.lang.parser import ParseResult, parse
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage

KEPT = 8
"""Snapshots that a process keeps: applications with other libraries take turns."""
_LITERAL = re.compile(
    r"\s*(?:'[^']*'|\"[^\"]*\"|TRUE|FALSE|[-+]?(?:[A-Za-z_]+#)?[-+]?\d[\w.#:+-]*)\s*", re.IGNORECASE
)
"""Values of parameters that mean the same in every project."""


@dataclass(frozen=True, slots=True)
class Influence:
    """What an application changes in its libraries; names are upper case."""

    names: frozenset[str] = frozenset()
    """Objects of libraries whose name the application has, too."""
    extended: frozenset[str] = frozenset()
    """Blocks without methods that the application extends."""


@dataclass(frozen=True, slots=True, eq=False)
class LibrarySnapshot:
    """The libraries of an application, analysed."""

    results: Mapping[Source, ParseResult]
    units: tuple[ast.Unit, ...]
    state: State
    pous: frozenset[int]
    """id() of all POUs, methods, actions and accessors."""
    names: frozenset[str]
    """Names of POUs and lists, upper case."""
    plain_blocks: frozenset[str]
    """Function blocks without a method table, upper case."""
    unit_ids: frozenset[int] = field(default_factory=frozenset)
    """id() of the units."""

    def own(self, results: Iterable[ParseResult]) -> list[ParseResult]:
        """Those of texts that are not of these libraries."""
        return [result for result in results if id(result.unit) not in self.unit_ids]

    def influence(self, units: Iterable[ast.Unit]) -> Influence:
        """What an application of these texts changes."""
        objects = [d for unit in units if unit.source.owner is None for d in unit.declarations]
        names = {d.name.upper() for d in objects if isinstance(d, (ast.Pou, ast.GlobalList))}
        bases = {
            d.extends.rpartition(".")[2].upper() for d in objects if isinstance(d, ast.Pou) and d.extends
        }
        return Influence(self.names & names, self.plain_blocks & bases)

    def surround(self, units: Sequence[ast.Unit], options: AnalysisOptions) -> tuple[State, Collected]:
        """A new analysis inside this scope, with the symbols of `units`, those of the application.

        The second part is what the application alone declares.
        """
        outer = self.state
        foreign = any(unit.source.scope is Scope.LIBRARY for unit in units)
        session = Session(options, Analysis(options), levels=outer.session.levels.around(shared=not foreign))
        session.declared = {  # a message about a library text is one of this analysis
            uri: replace(record, messages=[*record.messages])
            for uri, record in outer.session.declared.items()
        }
        session.calls = dict(outer.session.calls)
        own = collect(session, units)
        whole = _joined(own, outer.found)
        declarations = Declarations(
            session, whole, declared=dict(outer.declarations.declared), bodies=dict(outer.declarations.bodies)
        )
        state = State((*units, *self.units), session, whole, declarations, dict(outer.records))
        state.outer = self.pous
        return state, own


def own_results(results: Sequence[ParseResult], libraries: LibrarySnapshot | None) -> Sequence[ParseResult]:
    """The trees that an analysis around the libraries may fill: all of them where there is no snapshot."""
    return results if libraries is None else libraries.own(results)


class _Kept:
    """The snapshots of this process."""

    lock = threading.Lock()
    by_content: ClassVar[OrderedDict[object, LibrarySnapshot | None]] = OrderedDict()


def read_program(
    sources: Sequence[Source],
    options: AnalysisOptions,
    parse_options: ParseOptions | None = None,
    plain: Mapping[Source, ParseResult] | None = None,
) -> tuple[list[ParseResult], LibrarySnapshot | None]:
    """The trees of all texts in their order, and the libraries among them, analysed.

    `plain` as in `parse_sources`. Without a snapshot the libraries are to be analysed with the application.
    """
    libraries = tuple(source for source in sources if source.scope is Scope.LIBRARY)
    first = _snapshot(libraries, options, Influence())
    if first is None:
        return parse_sources(sources, parse_options, plain=plain), None
    own = [source for source in sources if source.scope is not Scope.LIBRARY]
    read = parse_sources(own, parse_options, plain=plain, others=first.units)
    influence = first.influence(result.unit for result in read)
    chosen = first if influence == Influence() else _snapshot(libraries, options, influence)
    assert chosen is not None
    results = iter(read)
    return [chosen.results.get(source) or next(results) for source in sources], chosen


def are_analysed(libraries: Sequence[Source], options: AnalysisOptions) -> bool:
    """Whether an analysis with these libraries finds them analysed."""
    with _Kept.lock:
        return not libraries or _key(tuple(libraries), options, Influence()) in _Kept.by_content


def _key(sources: tuple[Source, ...], options: AnalysisOptions, influence: Influence) -> object:
    limits = tuple(sorted(options.area_limits.items()))
    return sources, options.system, options.byte_addressing, limits, influence


def _snapshot(
    sources: tuple[Source, ...], options: AnalysisOptions, influence: Influence
) -> LibrarySnapshot | None:
    """The snapshot of these texts; None when they depend on more of the application."""
    if not sources:
        return None
    key = _key(sources, options, influence)
    with _Kept.lock:
        if key in _Kept.by_content:
            _Kept.by_content.move_to_end(key)
            return _Kept.by_content[key]
        made = _analysed(sources, options, influence)
        _Kept.by_content[key] = made
        while len(_Kept.by_content) > KEPT:
            _Kept.by_content.popitem(last=False)
        return made


def _analysed(
    sources: tuple[Source, ...], options: AnalysisOptions, influence: Influence
) -> LibrarySnapshot | None:
    if any(has_directives(source.text) or not _means_the_same(source) for source in sources):
        return None
    results = {source: parse(source) for source in sources}
    units = tuple(with_libraries([result.unit for result in results.values()], ()))
    pous = [d for unit in units for d in unit.declarations if isinstance(d, ast.Pou)]
    if len(results) != len(sources) or any(generic_constants(pou) for pou in pous):
        return None
    plain = AnalysisOptions(options.system, options.byte_addressing, options.area_limits)
    session = Session(plain, Analysis(plain))
    session.named_outside, session.extended_outside = influence.names, influence.extended
    found = collect(session, units)
    declarations = Declarations(session, found)
    declare(session, found, declarations, found)
    if any(message.code == "E0904" for message in session.diagnostics):
        return None  # a given value that does not fit is an error of the application
    state = State(units, session, found, declarations)
    for pou in all_pous(found):
        state.records[id(pou)] = analyse_body(session, pou, declarations.bodies[id(pou)])
    if any(variable.home is Storage.DIRECT for gvl, _ in found.gvls for variable in gvl.members.values()):
        return None  # their places are chosen among those of the application
    session.diagnostics = []
    check_pous(session, found, declarations, frozenset())
    for message in session.diagnostics:
        session.declared.setdefault(message.uri, Record()).messages.append(message)
    blocks = [pou for pou, _ in found.pous if pou.kind == "FUNCTION_BLOCK"]
    return LibrarySnapshot(
        results,
        units,
        state,
        frozenset(id(pou) for pou in all_pous(found)),
        frozenset(s.name.rpartition(".")[2].upper() for s in _objects(found)),
        frozenset(pou.name.upper() for pou in blocks if not pou.vtable),
        frozenset(map(id, units)),
    )


def _means_the_same(source: Source) -> bool:
    """Whether the values given to parameters of a text are the same in every project."""
    return all(_LITERAL.fullmatch(given.value) for given in source.given)


def _objects(found: Collected) -> list[PouSymbol | GvlSymbol]:
    return [*(pou for pou, _ in found.pous), *(gvl for gvl, _ in found.gvls)]


def _joined(own: Collected, outer: Collected) -> Collected:
    """What the application and its libraries declare."""
    return Collected(
        own.pous + outer.pous,
        own.types + outer.types,
        own.gvls + outer.gvls,
        own.interfaces + outer.interfaces,
        own.configured + outer.configured,
        own.own | outer.own,
        own.enum_values | outer.enum_values,
        own.local_enums + outer.local_enums,
        own.enum_of_value | outer.enum_of_value,
    )
