"""The order of the passes.

1. `collect`: a symbol for everything declared. 2. `heads`: bases, interfaces, the view of each text.
3. `declarations`: types, layout, constants, initial values (`declare` runs 2 and 3). 4. bodies
(`statements`). 5. `program`: what concerns the whole (recursion, interfaces, VAR_CONFIG, unused variables).
"""

from __future__ import annotations

from collections.abc import Sequence

from tappet.lang import ast
from tappet.lang.analysis import (
    calls,
    conditional_calls,
    intrinsics,
    members,
    selection,
    whereabouts,
)
from tappet.lang.analysis.bodies import State, analyse_body, finish
from tappet.lang.analysis.collect import collect
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.declare import all_pous, declare
from tappet.lang.analysis.generic import expand
from tappet.lang.analysis.incremental import reanalyse
from tappet.lang.analysis.redeclare import read_words, redeclare
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.sfc.library import with_types

REGISTERED = (calls, conditional_calls, members, intrinsics, selection, whereabouts)
"""Modules that enter their handlers into the tables when they are imported."""


def analyse(
    units: Sequence[ast.Unit],
    options: AnalysisOptions | None = None,
    previous: Analysis | None = None,
    first: frozenset[str] | None = None,
) -> Analysis:
    """Resolves and checks a program; every message is in `Analysis.diagnostics`. Never raises.

    The trees of `units` are filled in place: one tree takes part in one analysis at a time.
    When the units are those of `previous` but for bodies, only these are analysed (`Analysis.changed`). When
    they declare the same objects, what depends on the edited declarations is analysed. `previous` is used up
    then, its symbols live on in the result (`Analysis.continued`). Where many bodies have to be analysed
    again, those of texts that are not among the uris `first` may wait (`Analysis.is_waiting`): the next
    analysis, of the same or other units, takes them up.
    """
    options = options or AnalysisOptions()
    earlier = previous.state.units if previous is not None and isinstance(previous.state, State) else ()
    units = with_types(units, earlier)
    plain, units = units, expand(units)
    if previous is not None and units is plain:
        again = reanalyse(previous, units, options, first) or redeclare(previous, units, options, first)
        if again is not None:
            return again
    analysis = Analysis(options)
    session = Session(options, analysis)
    found = collect(session, units)
    declarations = Declarations(session, found)
    session.resolve = declarations.resolve
    session.type_of = declarations.type_of
    session.complete = declarations.complete
    declare(session, found, declarations, found)
    state = State(tuple(units), session, found, declarations)
    for pou in all_pous(found):
        state.records[id(pou)] = analyse_body(session, pou, declarations.bodies[id(pou)])
    return finish(state)


def go_on(analysis: Analysis, seconds: float) -> bool:
    """Analyses bodies that wait, for about so many seconds; whether none waits any more."""
    state = analysis.state
    if isinstance(state, State):
        state.analyse_waiting(seconds)
        return not state.is_waiting
    return True


def prepare(analysis: Analysis) -> None:
    """Reads what the first edit of declarations would have to read of every text."""
    if isinstance(analysis.state, State):
        read_words(analysis.state)
