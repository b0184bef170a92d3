"""Textual SFC of IEC 61131-3: STEP, INITIAL_STEP and TRANSITION among the actions of a POU.

Besides the IEC form a step may have step, entry and exit actions, `Act(STEP)`, `Act(ENTRY)`, `Act(EXIT)`,
and `MIN_TIME := T#1s;`, `MAX_TIME := T#5s;`: what a drawn chart has as attributes (LSFC-04, -11, -24).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Final

from tappet.iec.words import OBJECT_HEADS
from tappet.lang import ast
from tappet.lang.diagnostics import report
from tappet.lang.languages.il.reader import read_value
from tappet.lang.languages.reader import GraphReader, TextReader
from tappet.lang.languages.sfc.chart import QUALIFIERS, ROLES, TIMED, Association, Chart, Step, Transition
from tappet.lang.languages.sfc.translate import translate
from tappet.lang.lexer import END, ID, INT
from tappet.lang.parser_core import BODY_END
from tappet.lang.source import Scope, Source, Span

if TYPE_CHECKING:
    from tappet.lang.languages.reader import Lowering
    from tappet.lang.parser_statements import StatementParser

_CHARTED: Final = frozenset(["PROGRAM", "FUNCTION_BLOCK", "ACTION", "METHOD"])
"""Where a chart may stand; GET and SET are read like methods."""
_LIBRARY: Final = "IecSfc"
"""Name and namespace of the library with the types of charts."""
_TIMES: Final = ("MIN_TIME", "MAX_TIME")


class SequentialFunctionChart(TextReader, GraphReader):
    """Steps and transitions are collected in a chart, which is lowered as a whole."""

    name: ClassVar[str] = "SFC"

    def begins(self, parser: StatementParser, pou: ast.Pou) -> bool:
        """A step where no statement has been, or a transition behind a step."""
        if parser.kinds[parser.i] is ID:
            return not pou.body and begins_step(parser)
        return isinstance(pou.graph, Chart) and begins_transition(parser)

    def read(self, parser: StatementParser, pou: ast.Pou) -> None:
        """One step or transition."""
        if pou.graph is None:
            pou.graph = Chart(span=parser.span_at(parser.i))
            if pou.kind in _CHARTED:
                pou.language = self.name
            else:
                hint = "Write the chart in a program, a function block, an action, a method or a property."
                parser.error("E0113", what=f"A chart in a {pou.kind}", hint=hint)
        assert isinstance(pou.graph, Chart)
        if parser.kinds[parser.i] is ID:
            read_step(parser, pou.graph)
        else:
            read_transition(parser, pou.graph)

    def lower(self, pou: ast.Pou, context: Lowering) -> None:
        """The variables of steps and actions, and the phases of a cycle of the chart."""
        if pou.language != self.name:
            return  # in a function, which has been reported
        assert isinstance(pou.graph, Chart)
        blocks, body = translate(pou, pou.graph, context)
        pou.blocks += blocks
        pou.body[:] = body

    def library(self) -> Source:
        """The types of steps, actions and charts (LSFC-06)."""
        text = Path(__file__).with_name("IecSfc.st").read_text(encoding="utf-8")
        return Source(f"{_LIBRARY}/{_LIBRARY}", text, Scope.LIBRARY, None, _LIBRARY, _LIBRARY, _LIBRARY)


READER = SequentialFunctionChart()


def begins_step(parser: StatementParser) -> bool:
    """Whether a step begins at the next token."""
    i = parser.i
    kinds = parser.kinds
    if parser.word() not in ("STEP", "INITIAL_STEP"):
        return False
    return (
        kinds[i + 1] is not END and kinds[i + 2] == ":" and (kinds[i + 1] is ID or kinds[i + 1][0].isalpha())
    )


def begins_transition(parser: StatementParser) -> bool:
    """Whether TRANSITION here belongs to a chart: FROM follows, behind a name and a priority."""
    i = parser.i + 1
    kinds = parser.kinds
    if kinds[i] is ID and parser.texts[i].upper() != "FROM":
        i += 1
    if kinds[i] == "(":
        while kinds[i] != ")" and kinds[i] not in BODY_END and kinds[i] != ";":
            i += 1
        if kinds[i] != ")":
            return False
        i += 1
    return kinds[i] is ID and parser.texts[i].upper() == "FROM"


def read_step(parser: StatementParser, chart: Chart) -> None:
    """`STEP name: associations END_STEP`."""
    p = parser
    start = p.i
    initial = p.word() == "INITIAL_STEP"
    p.i += 1
    name, place = p.name("step")
    p.i = start + 3
    step = Step(name, place, p.span_from(start), initial)
    while p.word() != "END_STEP":
        if p.kinds[p.i] is not ID or begins_step(p):
            if p.kinds[p.i] == ";":
                p.i += 1
                continue
            _missing_end(p, "END_STEP", "STEP", start)
            break
        _step_entry(p, step)
    else:
        p.i += 1
        p.optional_semicolon()
    step.span = p.span_from(start)
    chart.steps.append(step)


def _missing_end(p: StatementParser, end: str, begin: str, start: int) -> None:
    p.missing_end("E0103", end, begin, p.lines[start])
    while p.kinds[p.i] is not END and p.kinds[p.i] not in OBJECT_HEADS and not begins_step(p):
        if p.word() == end or p.kinds[p.i] == end:
            p.i += 1
            p.optional_semicolon()
            return
        if p.kinds[p.i] in BODY_END:
            return
        p.i += 1


def _step_entry(p: StatementParser, step: Step) -> None:
    """`action(qualifier, time);` or a time attribute."""
    start = p.i
    messages = len(p.diagnostics)
    name, name_span = p.texts[start], p.span_at(start)
    p.i += 1
    if p.kinds[p.i] == ":=" and name.upper() in _TIMES:
        p.i += 1
        value = p.expression()
        if name.upper() == "MIN_TIME":
            step.minimum = value
        else:
            step.maximum = value
        p.end_of_statement(messages)
        return
    qualifier, place = "N", name_span
    time: ast.Expr | None = None
    if p.kinds[p.i] == "(":
        p.i += 1
        if p.texts[p.i].upper() in (*QUALIFIERS, *ROLES):
            qualifier, place = p.texts[p.i].upper(), p.span_at(p.i)
            p.i += 1
        elif p.kinds[p.i] != ")":
            known = ", ".join(QUALIFIERS)
            p.error("E0824", found=p.found(), step=step.name, known=known)
        if p.kinds[p.i] == ",":
            p.i += 1
            time = p.expression()
        while p.kinds[p.i] == ",":  # indicator variables of IEC say nothing about the execution
            p.i += 1
            p.expression()
        p.take(")")
    p.end_of_statement(messages)
    if qualifier in ROLES:
        step.roles[qualifier] = (name, name_span)
        return
    if len(p.diagnostics) == messages:
        time = _checked_time(p, step, qualifier, time, place)
    step.associations.append(Association(name, name_span, qualifier, time, p.span_from(start)))


def _checked_time(
    p: StatementParser, step: Step, qualifier: str, time: ast.Expr | None, place: Span
) -> ast.Expr | None:
    """LSFC-39: a time where the qualifier needs one, and only there."""
    if qualifier in TIMED and time is None:
        p.diagnostics.append(report("E0825", p.source.uri, place, qualifier=qualifier, step=step.name))
    if qualifier not in TIMED and time is not None:
        p.diagnostics.append(report("W1119", p.source.uri, time.span, qualifier=qualifier, step=step.name))
        return None
    return time


def read_transition(parser: StatementParser, chart: Chart) -> None:
    """`TRANSITION name (PRIORITY := n) FROM step TO step := condition; END_TRANSITION`, or `:` and IL."""
    p = parser
    start = p.i
    p.i += 1
    if p.word() not in ("", "FROM"):
        p.i += 1
    priority = None
    if p.kinds[p.i] == "(":
        p.i += 1
        p.i += 1 if p.word() == "PRIORITY" else 0
        p.take(":=", hint="Write (PRIORITY := 1).")
        if p.kinds[p.i] is INT:
            priority = int(p.texts[p.i])
            p.i += 1
        else:
            p.expected("A number", "Write (PRIORITY := 1); the lowest number goes first.")
        p.take(")")
    p.i += 1 if p.word() == "FROM" else 0
    sources = _steps(p)
    p.take("TO")
    targets = _steps(p)
    messages = len(p.diagnostics)
    condition: ast.Expr
    rows: list[ast.Stmt] = []
    if p.kinds[p.i] == ":":
        p.i += 1
        rows, condition = read_value(p)
    elif p.take(":=", hint="Write ':=' and the condition behind the steps."):
        condition = p.expression()
        p.end_of_statement(messages)
    else:
        condition = ast.ErrorExpr(span=p.span_at(p.i))
    if p.kinds[p.i] == "END_TRANSITION":
        p.i += 1
        p.optional_semicolon()
    else:
        _missing_end(p, "END_TRANSITION", "TRANSITION", start)
    chart.transitions.append(Transition(sources, targets, condition, p.span_from(start), priority, rows))


def _steps(p: StatementParser) -> list[tuple[str, Span]]:
    """`step` or `(step, step)`."""
    if p.kinds[p.i] != "(":
        return [p.name("step")]
    p.i += 1
    found = [p.name("step")]
    while p.kinds[p.i] == ",":
        p.i += 1
        found.append(p.name("step"))
    p.take(")")
    return found
