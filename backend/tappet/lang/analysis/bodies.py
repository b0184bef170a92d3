"""Third pass: the statements of every POU, each with a record of its own, then the checks of the whole."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf
from time import monotonic
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.analysis import program
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Body, Record, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.result import Analysis
from tappet.lang.analysis.statements import check_jumps, statements
from tappet.lang.analysis.suppression import kept
from tappet.lang.analysis.variable_checks import VariableChecks
from tappet.lang.diagnostics import Diagnostic, with_severity
from tappet.lang.rules import LIBRARY_POU_RULES, POU_RULES, coding_checks
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol

if TYPE_CHECKING:
    from tappet.lang.analysis.edits.identifiers import Identifiers


@dataclass(slots=True)
class State:
    """What an analysis keeps so that the next one can reuse it."""

    units: tuple[ast.Unit, ...]
    session: Session
    found: Collected
    declarations: Declarations
    records: dict[int, Record] = field(default_factory=dict)
    """Of each body, by id() of its symbol."""
    texts: dict[int, list[Diagnostic]] = field(default_factory=dict)
    """What coding rules report about the declarations and comments of a text, by id() of its unit."""
    identifiers: dict[str, Identifiers] = field(default_factory=dict)
    """Of the texts, by uri, where an edit of declarations has asked for them."""
    waiting: dict[int, PouSymbol] = field(default_factory=dict)
    """Bodies that have to be analysed still, by id() of their symbol; their records are those of before."""

    outer: frozenset[int] = frozenset()
    """id() of the POUs of a library snapshot: what concerns them alone has been checked."""
    variable_checks: VariableChecks = field(default_factory=VariableChecks)
    coding_waiting: dict[int, PouSymbol] = field(default_factory=dict)
    """Bodies that have to be looked at by the coding rules only."""

    def analyse_waiting(self, seconds: float = inf, first: frozenset[str] | None = None) -> None:
        """Analyses bodies that wait, of the texts `first` only when it is given, until the time is up."""
        end = monotonic() + seconds
        for key, pou in list(self.waiting.items()):
            if first is None or (pou.source is not None and pou.source.uri in first):
                del self.waiting[key]
                self.records[key] = analyse_body(self.session, pou, self.declarations.bodies[key])
                if monotonic() > end:
                    return
        for key, pou in list(self.coding_waiting.items()):
            if first is None or (pou.source is not None and pou.source.uri in first):
                del self.coding_waiting[key]
                coding_rules(self.session, self.declarations.bodies[key], self.records[key])
                if monotonic() > end:
                    return

    @property
    def is_waiting(self) -> bool:
        """Whether something has to be done still."""
        return bool(self.waiting or self.coding_waiting)


def analyse_body(session: Session, pou: PouSymbol, body: Body) -> Record:
    """Resolves and checks the statements of one POU, method, action or accessor."""
    record = Record()
    body.begin()
    session.named.pop(id(pou), None)
    session.aggregates = False
    session.diagnostics, session.accounted = record.messages, None
    session.count_in(record)
    node = pou.pou
    if node is None:
        return record
    try:
        statements(body, node.body)
    except RecursionError:
        body.report("E0812", node.name_span, name=pou.name)
    check_jumps(body)
    session.calls[id(pou)] = body.called
    library = body.source.scope is Scope.LIBRARY
    for check in LIBRARY_POU_RULES if library else POU_RULES:
        check(body)
    if not library:
        coding_rules(session, body, record)
    for e in body.unreadable:
        body.report("E0424", e.span, name=e.name, what="Get", verb="read")
    body.unreadable.clear()
    if len(record.messages) + len(record.coding) > 1:  # a lowered body may hold an expression twice
        record.messages[:] = dict.fromkeys(record.messages)
        record.coding[:] = dict.fromkeys(record.coding)
    record.aggregates = session.aggregates
    return record


def coding_rules(session: Session, body: Body, record: Record) -> None:
    """The optional rules that look at one body; its statements are resolved."""
    chosen = session.options.static.codes
    if not chosen:
        return
    record.coding = []
    others, session.diagnostics, session.accounted = session.diagnostics, record.coding, None
    session.count_in(record)
    for check in coding_checks("check_pou", chosen):
        check(body, chosen)
    session.diagnostics = others


def _coding_rules(state: State) -> None:
    """The optional rules that look at whole texts or at the whole program."""
    session = state.session
    chosen = session.options.static.codes
    if not chosen:
        return
    state.texts = {id(unit): _of_text(state, unit) for unit in state.units if not _is_library(unit)}
    for messages in state.texts.values():
        session.diagnostics += messages
    for check in coding_checks("check_program", chosen):
        check(session, chosen)


def _is_library(unit: ast.Unit) -> bool:
    return unit.source.scope is Scope.LIBRARY


def _of_text(state: State, unit: ast.Unit) -> list[Diagnostic]:
    """Messages about a whole text; they stay while the text does, as its declarations mean the same then."""
    found = state.texts.get(id(unit))
    if found is None:
        session = state.session
        found, others = [], session.diagnostics
        session.diagnostics = found
        for check in coding_checks("check_unit", session.options.static.codes):
            check(session, unit)
        session.diagnostics = others
    return found


def finish(state: State) -> Analysis:
    """Checks the whole program and puts all messages together, in the order of the sources."""
    session = state.session
    records = [*session.declared.values(), *state.records.values()]
    session.used = set().union(*(record.used for record in records))
    session.written = set().union(*(record.written for record in records))
    session.called = set().union(*(record.called for record in records))
    session.operands = set().union(*(record.operands for record in records))
    session.diagnostics = []
    program.check(session, state.found, state.declarations, state.outer)
    state.variable_checks.report(session)
    _coding_rules(state)
    found = session.diagnostics
    for record in records:
        found += record.messages
        found += record.coding
    order: dict[str, int] = {}
    for number, unit in enumerate(state.units):
        order.setdefault(unit.source.uri, number)
    last = len(order)
    found.sort(key=lambda d: (order.get(d.uri, last), d.span.line, d.span.column, d.code, d.message))
    if any(unit.copied for unit in state.units):  # of a generic block each copy says the same
        found = list({(d.code, d.uri, d.span): d for d in reversed(found)}.values())[::-1]
    analysis = session.analysis
    analysis.diagnostics = with_severity(kept(found, state.units), session.options.static.errors)
    analysis.called = session.called
    analysis.is_waiting = state.is_waiting
    analysis.state = state
    return analysis
