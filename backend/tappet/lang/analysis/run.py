"""The order of the passes.

1. `collect`: a symbol for everything declared. 2. `heads`: bases, interfaces, the view of each text.
3. `declarations`: types, layout, constants, initial values (`declare` runs 2 and 3). 4. bodies
(`statements`). 5. `program`: what concerns the whole (recursion, interfaces, VAR_CONFIG, unused variables).
"""

from __future__ import annotations

from collections.abc import Sequence

from tappet.lang import ast
from tappet.lang.analysis import handlers
from tappet.lang.analysis.bodies import State, analyse_body, finish
from tappet.lang.analysis.collect import collect
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.declare import all_pous, declare
from tappet.lang.analysis.generic import expand
from tappet.lang.analysis.libraries import LibrarySnapshot
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.languages.support import with_libraries

handlers.install()


def analyse(
    units: Sequence[ast.Unit],
    options: AnalysisOptions | None = None,
    previous: Analysis | None = None,
    first: frozenset[str] | None = None,
    libraries: LibrarySnapshot | None = None,
) -> Analysis:
    """Resolves and checks a program; every message is in `Analysis.diagnostics`. Never raises.

    The trees of `units` are filled in place: one tree takes part in one analysis at a time.
    When the units are those of `previous` but for bodies, only these are analysed (`Analysis.changed`). When
    they declare the same objects, what depends on the edited declarations is analysed. `previous` is used up
    then, its symbols live on in the result (`Analysis.continued`). Where many bodies have to be analysed
    again, those of texts that are not among the uris `first` may wait (`Analysis.is_waiting`): the next
    analysis, of the same or other units, takes them up. `libraries` stand around the program: `units` are
    then those of the application alone.
    """
    options = options or AnalysisOptions()
    earlier = previous.state.units if previous is not None and isinstance(previous.state, State) else ()
    units = with_libraries([*units, *libraries.units] if libraries is not None else units, earlier)
    plain, units = units, expand(units)
    if previous is not None and units is plain:
        from tappet.lang.analysis.edits.body_edits import reanalyse
        from tappet.lang.analysis.edits.declaration_edits import redeclare

        again = reanalyse(previous, units, options, first) or redeclare(previous, units, options, first)
        if again is not None:
            return again
    if libraries is not None:
        own = [unit for unit in units if id(unit) not in libraries.unit_ids]
        state, found = libraries.surround(own, options)
    else:
        session = Session(options, Analysis(options))
        found = collect(session, units)
        state = State(tuple(units), session, found, Declarations(session, found))
    session, declarations = state.session, state.declarations
    declare(session, found, declarations, state.found)
    for pou in all_pous(found):
        state.records[id(pou)] = analyse_body(session, pou, declarations.bodies[id(pou)])
    return finish(state)


def resume(analysis: Analysis, seconds: float) -> bool:
    """Analyses bodies that wait, for about so many seconds; whether none waits any more."""
    state = analysis.state
    if isinstance(state, State):
        state.analyse_waiting(seconds)
        return not state.is_waiting
    return True


def prepare(analysis: Analysis) -> None:
    """Reads what the first edit of declarations would have to read of every text."""
    if isinstance(analysis.state, State):
        from tappet.lang.analysis.edits.declaration_edits import read_identifiers

        read_identifiers(analysis.state)
