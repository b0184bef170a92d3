"""A chart to declarations and statements: the model of language_sfc.md, section 6, phase by phase."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.languages.sfc import timeouts
from tappet.lang.languages.sfc.build import both, call, declared, flag, literal, name, negated, put, when
from tappet.lang.languages.sfc.chart import Association, Chart, Step, Transition
from tappet.lang.languages.sfc.context import Context
from tappet.lang.source import NOWHERE, Span
from tappet.lang.walk import expressions

if TYPE_CHECKING:
    from tappet.lang.languages.reader import Lowering

_RESET = ("SFCInit", "SFCReset")
_BOOL_FLAGS = ("SFCError", "SFCQuitError", "SFCPause", "SFCTrans", "SFCTipMode", "SFCTip")
_TEXT_FLAGS = ("SFCErrorStep", "SFCErrorPOU", "SFCErrorAnalyzation")


def translate(pou: ast.Pou, chart: Chart, lowering: Lowering) -> tuple[list[ast.VarBlock], list[ast.Stmt]]:
    """Implicit variables and body of a POU with a chart."""
    head = chart.steps[0].name_span if chart.steps else pou.name_span
    c = Context(pou.name, chart, lowering, head)
    if pou.extends is not None:
        c.kept += pou.name  # the base may have a chart of its own (LSFC-26)
    initial = _check(c)
    if pou.kind == "ACTION":
        _check_recursion(c)
    for step in chart.steps:
        for item in step.associations:
            if item.action.upper() in c.actions:
                c.mentions.append((item.action, item.action_span))
            elif item.action:
                c.actions[item.action.upper()] = (item.action, item.action_span)
    # a chart of an action or method has variables of its own in each instance
    section = "VAR_INST" if pou.kind in ("ACTION", "METHOD") else "VAR"
    implicit = _variables(c)
    free = _without_own_names(c, pou, implicit)
    block = ast.VarBlock(section=section, flags=set(), variables=free, span=head)
    if initial is None or len(free) < len(implicit):
        return [block], []
    return [block], [
        *_begin(c, initial),
        *_flags(c, initial),
        *_update_steps(c),
        *_own_actions(c, "EXIT", "Left"),
        *_halt_points(c),
        *_own_actions(c, "ENTRY", "Entered"),
        *timeouts.checks(c),
        *_own_actions(c, "STEP", "x"),
        *_associations(c),
        *_run_actions(c),
        *_transitions(c),
    ]


def control_of(action: str) -> str:
    """Name of the implicit variable of an action (LSFC-55)."""
    return f"_{action}"


# -- checks -----------------------------------------------------------------------------------------


def _check(c: Context) -> Step | None:
    """LSFC-80, LSFC-82, LSFC-01: the initial step, the ends of transitions, ways out of every step."""
    steps = {}
    for step in c.chart.steps:
        if step.name.upper() in steps:
            c.lowering.report("E0823", step.name_span, name=step.name)
        else:
            steps[step.name.upper()] = step
    c.chart.steps = list(steps.values())
    initial = [step for step in c.chart.steps if step.initial]
    if len(initial) != 1:
        place = initial[1].name_span if initial else c.head
        count = "no" if not initial else str(len(initial))
        c.lowering.report("E0821", place, count=count)
    left = set()
    for transition in c.chart.transitions:
        for step_name, span in [*transition.sources, *transition.targets]:
            if step_name and step_name.upper() not in steps:
                c.lowering.report(
                    "E0822", span, name=step_name, known=", ".join(s.name for s in c.chart.steps)
                )
        left |= {step_name.upper() for step_name, _ in transition.sources}
        _check_condition(c, transition)
    c.chart.transitions = [
        t
        for t in c.chart.transitions
        if all(n.upper() in steps for n, _ in [*t.sources, *t.targets]) and t.sources and t.targets
    ]
    for step in c.chart.steps:
        if step.name.upper() not in left:
            c.lowering.report("E0827", step.name_span, name=step.name)
    return initial[0] if initial else None


def _check_recursion(c: Context) -> None:
    """LSFC-85: no step of the chart of an action has this very action, which would never end."""
    own = c.pou.upper()
    for step in c.chart.steps:
        places = [item.action_span for item in step.associations if item.action.upper() == own]
        places += [span for name, span in step.roles.values() if name.upper() == own]
        for place in places:
            c.lowering.report("E0829", place, name=c.pou, step=step.name)
        step.associations = [item for item in step.associations if item.action.upper() != own]
        step.roles = {role: entry for role, entry in step.roles.items() if entry[0].upper() != own}


def _check_condition(c: Context, transition: Transition) -> None:
    """LSFC-13, LSFC-14: no assignment inside a condition; what it calls must have a value."""
    held = [row for row in transition.rows if isinstance(row, ast.Hold)]
    for row in transition.rows:
        if not isinstance(row, ast.Hold):
            c.lowering.report("E0828", row.span)
    transition.rows = [*held]
    for node in expressions(*(row.value for row in held), transition.condition):
        if isinstance(node, ast.AssignExpr):
            c.lowering.report("E0828", node.span)
            return


# -- declarations -----------------------------------------------------------------------------------


def _variables(c: Context) -> list[ast.VarDecl]:
    """LSFC-57: steps and actions are instances of their types."""
    found = [_variable(step.name, "SFCStepType", step.name_span) for step in c.chart.steps]
    found += [_variable(control_of(spelling), "SFCActionType", NOWHERE) for spelling, _ in c.actions.values()]
    return [*found, _variable(c.kept, "SFCChartType", NOWHERE)]


def _without_own_names(c: Context, pou: ast.Pou, implicit: list[ast.VarDecl]) -> list[ast.VarDecl]:
    """LSFC-57: reports own variables with such a name; the implicit ones that remain."""
    taken = {own.name.upper() for block in pou.blocks for own in block.variables}
    places = {control_of(spelling).upper(): span for spelling, span in c.actions.values()}
    for variable in implicit:
        if variable.name.upper() in taken:
            place = places.get(variable.name.upper(), variable.name_span)
            c.lowering.report("E0205", place, what="variable", name=variable.name)
    return [variable for variable in implicit if variable.name.upper() not in taken]


def _variable(variable: str, type_: str, span: Span) -> ast.VarDecl:
    return ast.VarDecl(name=variable, name_span=span, span=span, type_ref=ast.NamedType(name=type_))


# -- phase 1: start and flags -----------------------------------------------------------------------


def _begin(c: Context, initial: Step) -> list[ast.Stmt]:
    time = ast.Call(callee=name("TIME"), args=[])
    first = [put(f"{c.kept}.Started", True, c.head), *_activate(initial.name, c.head)]
    return [
        put(f"{c.kept}.Now", time, c.head),
        when(negated(name(f"{c.kept}.Started")), first, c.head),
    ]


def _activate(step: str, span: Span, at: Span = NOWHERE) -> list[ast.Stmt]:
    return [put(f"{step}._x", True, span, at), put(f"{step}.Enter", True, span)]


def _flags(c: Context, initial: Step) -> list[ast.Stmt]:
    head = c.head
    quit_ = f"{c.kept}.Quit"
    acknowledge = [
        put("SFCError", False, head),
        *_without_timeout(c),
        put(quit_, True, head),
        ast.Return(span=head),
    ]
    restart = [put(f"{step.name}._t", f"{c.kept}.Now", head) for step in c.chart.steps]
    tip_edge = both(name("SFCTip"), negated(name(f"{c.kept}.TipOld")))
    tip = [put(f"{c.kept}.Tip", tip_edge, head), put(f"{c.kept}.TipOld", "SFCTip", head)]
    stop = [*_initialise(c, initial, "SFCInit"), *_wait(c, initial)]
    return [
        declared(["SFCTrans"], [put("SFCTrans", False, head)], head),
        declared(["SFCInit"], [when("SFCInit", stop, head)], head),
        declared(["SFCReset"], [when("SFCReset", _initialise(c, initial, "SFCReset"), head)], head),
        declared(["SFCError", "SFCQuitError"], [when("SFCQuitError", acknowledge, head)], head),
        when(quit_, [put(quit_, False, head), *restart], head),
        declared(["SFCPause"], [when("SFCPause", [ast.Return(span=head)], head)], head),
        declared(["SFCTip"], tip, head),
    ]


def _initialise(c: Context, initial: Step, reason: str) -> list[ast.Stmt]:
    """LSFC-60, LSFC-61: back to the initial step; the other flags and all action controls are reset."""
    head = c.head
    found = [call(step.name, head, Clear=True) for step in c.chart.steps]
    for spelling, span in c.actions.values():
        found.append(call(control_of(spelling), head, Clear=True))
        found.append(
            ast.WhenDeclared(names=[spelling], body=[put(spelling, False, span)], otherwise=[], span=span)
        )
    flags = [f for f in (*_RESET, *_BOOL_FLAGS) if f != reason]
    found += [declared([f], [put(f, False, head)], head) for f in flags]
    found += _without_timeout(c)
    found.append(put(f"{c.kept}.TipOld", False, head))
    return [*found, *_activate(initial.name, head)]


def _without_timeout(c: Context) -> list[ast.Stmt]:
    """What was written of a timeout is taken back."""
    found = [declared([f], [put(f, literal(""), c.head)], c.head) for f in _TEXT_FLAGS]
    return [*found, timeouts.clear_table(c)]


def _wait(c: Context, initial: Step) -> list[ast.Stmt]:
    """The initial step is shown as active but not executed while SFCInit is TRUE."""
    head = c.head
    return [
        call(initial.name, head, Now=f"{c.kept}.Now"),
        put(f"{initial.name}.Enter", True, head),
        *_current_step(c),
        ast.Return(span=head),
    ]


# -- phases 2 to 6: steps ---------------------------------------------------------------------------


def _update_steps(c: Context) -> list[ast.Stmt]:
    found = [call(step.name, step.name_span, Now=f"{c.kept}.Now") for step in c.chart.steps]
    return [*found, *_current_step(c)]


def _current_step(c: Context) -> list[ast.Stmt]:
    """LSFC-69: the name of the active step, of the rightmost line where several are active."""
    body = [
        when(f"{step.name}.x", [put("SFCCurrentStep", literal(step.name), c.head)], c.head)
        for step in c.chart.steps
    ]
    return [declared(["SFCCurrentStep"], body, c.head)]


def _halt_points(c: Context) -> list[ast.Stmt]:
    """LSFC-25: a breakpoint on a step halts where the step is active, before what it does in this call."""
    return [
        when(f"{step.name}.x", [ast.HaltPoint(span=step.name_span)], step.name_span) for step in c.chart.steps
    ]


def _own_actions(c: Context, role: str, member: str) -> list[ast.Stmt]:
    """Exit, entry and step actions (LSFC-11, LSFC-12)."""
    found: list[ast.Stmt] = []
    for step in c.chart.steps:
        if role in step.roles:
            action, span = step.roles[role]
            run = when(f"{step.name}.{member}", [call(action, span, span)], span)
            found.append(
                ast.WhenDeclared(
                    names=[action], step=step.name, role=role, body=[], otherwise=[run], span=span
                )
            )
    return found


# -- phase 7: actions -------------------------------------------------------------------------------


def _associations(c: Context) -> list[ast.Stmt]:
    return [_association(step, item) for step in c.chart.steps for item in step.associations if item.action]


def _association(step: Step, item: Association) -> ast.Stmt:
    control = control_of(item.action)
    body = [put(f"{control}.q{item.qualifier}", True, item.span)]
    if item.time is not None:
        body.append(put(f"{control}.t{item.qualifier}", item.time, item.span))
    active = {"P0": "Left", "P1": "Entered"}.get(item.qualifier, "x")
    return when(f"{step.name}.{active}", body, item.span)


def _run_actions(c: Context) -> list[ast.Stmt]:
    """In alphabetical order: last executions, then what is active; BOOL variables are set (LSFC-40, -41)."""
    ordered = [c.actions[key] for key in sorted(c.actions)]
    owner = {item.action.upper(): s.name for s in reversed(c.chart.steps) for item in s.associations}
    found = [call(control_of(spelling), span, Now=f"{c.kept}.Now") for spelling, span in ordered]
    for member in ("Last", "Run"):
        for spelling, span in ordered:
            control = control_of(spelling)
            at = span if member == "Run" else NOWHERE
            run = when(f"{control}.{member}", [call(spelling, span, at)], span)
            write = [put(spelling, f"{control}.Run", span, span)] if member == "Run" else []
            found.append(
                ast.WhenDeclared(
                    names=[spelling],
                    step=owner[spelling.upper()] if member == "Last" else "",
                    body=write,
                    otherwise=[run],
                    span=span,
                )
            )
    for spelling, span in c.mentions:  # so that every place is found; `Clear` is never TRUE here
        control = control_of(c.actions[spelling.upper()][0])
        never = when(f"{control}.Clear", [call(spelling, span, span)], span)
        write = [put(spelling, f"{control}.Run", span, span)]
        found.append(ast.WhenDeclared(names=[spelling], body=write, otherwise=[never], span=span))
    return found


# -- phase 8: transitions ---------------------------------------------------------------------------


def _transitions(c: Context) -> list[ast.Stmt]:
    return [_transition(c, item) for item in c.chart.in_order()]


def _transition(c: Context, item: Transition) -> ast.Stmt:
    """LSFC-17, LSFC-19, LSFC-24, LSFC-74: evaluated while its steps are active and have not been left."""
    steps = {step.name.upper(): step for step in c.chart.steps}
    span = item.span
    ready: list[ast.Expr] = []
    for step_name, place in item.sources:
        ready += [name(f"{step_name}.x", place), negated(name(f"{step_name}.Done"))]
        minimum = steps[step_name.upper()].minimum
        if minimum is not None:
            elapsed = ast.Binary(
                op=">=", left=name(f"{step_name}.t"), right=copy.deepcopy(minimum), span=minimum.span
            )
            ready.append(elapsed)
    go = f"{c.kept}.Go"
    tip = when("SFCTipMode", [put(go, f"{c.kept}.Tip", span)], span)
    fire: list[ast.Stmt] = []
    for step_name, _ in item.sources:
        # another transition of this call may have activated it again
        fire += [put(f"{step_name}._x", f"{step_name}.Enter", span), put(f"{step_name}.Done", True, span)]
    for step_name, place in item.targets:
        fire += _activate(step_name, span, place)
    fire.append(declared(["SFCTrans"], [put("SFCTrans", flag(True), span)], span))
    condition = ast.Assign(op=":=", target=name(go), value=item.condition, span=item.condition.span)
    body = [*item.rows, condition, declared(["SFCTipMode"], [tip], span), when(go, fire, span)]
    return when(both(*ready), body, span)
