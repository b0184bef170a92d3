"""The parameters of the call that is being written."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.services import describe
from tappet.lang.services.cursor import cursor_at, enclosing_call
from tappet.lang.services.documents import Position
from tappet.lang.services.operators import head_of
from tappet.lang.services.resolution import callable_pou, resolve, scope_at
from tappet.lang.services.results import Parameter, Signature
from tappet.lang.services.workspace import View, Workspace
from tappet.lang.symbols import PouSymbol


def signature(workspace: Workspace, document: str, position: Position) -> Signature | None:
    """The call around a position; None outside of calls."""
    view = workspace.quick_view(document, position)
    cursor = cursor_at(view.lexed, view.position)
    if cursor.inside in ("comment", "pragma"):
        return None
    last = cursor.previous + 1 if cursor.word else cursor.previous
    call = enclosing_call(view.lexed, view.source, last)
    if call is None:
        return None
    pou = callable_pou(resolve(scope_at(view), call.callee))
    if pou is not None:
        return _of_pou(view, pou, call.count, call.named)
    if isinstance(call.callee, ast.Name):
        head = head_of(call.callee.name)
        if head is not None:
            return _of_head(*head, call.count)
    return None


def _of_pou(view: View, pou: PouSymbol, count: int, named: str) -> Signature:
    label = f"{pou.name}("
    parameters: list[Parameter] = []
    active: int | None = None
    inputs = 0
    for variable in describe.pins(pou):
        if parameters:
            label += ", "
        arrow = " =>" if variable.section == "VAR_OUTPUT" else ""
        initial = describe.initial_text(variable)
        start = len(label)
        value = f" := {initial}" if initial else ""
        label += f"{variable.name}{arrow} : {describe.type_as_written(variable)}{value}"
        if named:
            if variable.name.upper() == named.upper():
                active = len(parameters)
        elif variable.section != "VAR_OUTPUT":
            if inputs == count:
                active = len(parameters)
            inputs += 1
        parameters.append(Parameter(start, len(label), variable.comment, describe.library_of(variable)))
    result = f" : {pou.return_type}" if pou.return_type is not None else ""
    return Signature(f"{label}){result}", pou.comment, parameters, active, describe.library_of(pou))


def _of_head(label: str, comment: str, count: int) -> Signature:
    inner = label[label.index("(") + 1 : label.rindex(")")]
    parameters: list[Parameter] = []
    start = label.index("(") + 1
    for part in inner.split(", ") if inner else []:
        parameters.append(Parameter(start, start + len(part), ""))
        start += len(part) + 2
    active = min(count, len(parameters) - 1) if parameters else None
    return Signature(label, comment, parameters, active)
