"""Looking at a halted debuggee: call stack, scopes, variables, expressions, and writing them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from msgspec import json

from tappet.server.dap import messages as m
from tappet.server.dap.connection import Handler
from tappet.server.dap.debuggee import Frame, Refused, Variable
from tappet.server.dap.handles import Below, FrameScope, Nested
from tappet.server.dap.view import View

_ASSIGNMENT = re.compile(r"\s*(?P<target>[^:=]+?)\s*:=\s*(?P<value>.+?)\s*;?\s*$", re.DOTALL)
_LAST_STEP = re.compile(r"\[[^\]]*\]|[^.\[\]]+|^$")
_THIS = re.compile(r"THIS\^?\.", re.IGNORECASE)


class Inspection:
    """Reads and writes variables of frames, and of the image."""

    def __init__(self, view: View) -> None:
        self._view = view

    def handlers(self) -> dict[str, Handler]:
        """The requests that are carried out here."""
        return {
            "stackTrace": self._stack_trace,
            "scopes": self._scopes,
            "variables": self._variables,
            "setVariable": self._set_variable,
            "evaluate": self._evaluate,
            "setExpression": self._set_expression,
            "exceptionInfo": self._exception_info,
            "dataBreakpointInfo": self._data_breakpoint_info,
            "source": self._source,
        }

    async def _stack_trace(self, request: m.Request) -> Any:
        given = m.arguments_as(m.StackTrace, request)
        task = self._view.task(given.thread_id)
        if self._view.at is not None:
            frame = {
                "id": self._view.handles.frame(task, 0, None),
                "name": self._view.say(f"cycle {self._view.cycle}"),
                "line": 0,
                "column": 0,
            }
            return {"stackFrames": [frame | {"presentationHint": "label"}], "totalFrames": 1}
        frames = await self._view.need().stack(task)
        end = given.start_frame + given.levels if given.levels else len(frames)
        shown = [self._frame(task, frame) for frame in frames[given.start_frame : end]]
        return {"stackFrames": shown, "totalFrames": len(frames)}

    def _frame(self, task: str, frame: Frame) -> dict[str, Any]:
        name = frame.pou if frame.instance in (None, frame.pou) else f"{frame.pou} ({frame.instance})"
        shown: dict[str, Any] = {
            "id": self._view.handles.frame(task, frame.index, frame.instance),
            "name": name,
        }
        if frame.location is None:
            return shown | {"line": 0, "column": 0, "presentationHint": "subtle"}
        return shown | {
            "source": self._view.source(frame.location),
            "line": self._view.line_out(frame.location.line),
            "column": 1 if self._view.initialize.columns_start_at1 else 0,
        }

    async def _scopes(self, request: m.Request) -> Any:
        given = m.arguments_as(m.OfFrame, request)
        frame = self._view.handles.frame_of(given.frame_id)
        if frame is None:
            raise Refused("The debuggee has moved since: ask for the stack again")
        task, index, _ = frame
        scopes: list[dict[str, Any]] = []
        if self._view.at is None:
            local = FrameScope(task, index)
            scopes.append(_scope("Locals", self._view.handles.container(local), "locals"))
        scopes.append(_scope("Application", self._view.handles.container(Below("")), "globals"))
        return {"scopes": scopes}

    async def _variables(self, request: m.Request) -> Any:
        given = m.arguments_as(m.Variables, request)
        container = self._view.handles.find(given.variables_reference)
        if container is None:
            raise Refused("The debuggee has moved since: ask for the scopes again")
        scope: FrameScope | None = None
        found: Sequence[Variable]
        if isinstance(container, Below):
            found = await self._view.need().children(
                container.path, given.start, given.count, self._view.cycle
            )
        elif isinstance(container, FrameScope):
            scope = container
            found = await self._view.need().frame_variables(container.task, container.frame)
        else:
            scope = container.scope
            found = _parts(container)
        if given.count and not isinstance(container, Below):
            found = found[given.start : given.start + given.count]
        return {"variables": [self._variable(variable, scope) for variable in found]}

    def _variable(self, variable: Variable, scope: FrameScope | None) -> dict[str, Any]:
        shown: dict[str, Any] = {
            "name": variable.name if scope is None else _LAST_STEP.findall(variable.name)[-1],
            "value": variable.literal,
            "type": variable.type,
            "variablesReference": self._view.handles.below(variable, scope),
        }
        if variable.path is not None:
            shown["evaluateName"] = variable.path
            if variable.type.upper().startswith("ARRAY"):
                shown["indexedVariables"] = variable.children
        elif scope is not None:
            shown["evaluateName"] = variable.name
        if not variable.writable or self._view.at is not None:
            shown["presentationHint"] = {"attributes": ["readOnly"]}
        return shown

    async def _set_variable(self, request: m.Request) -> Any:
        given = m.arguments_as(m.SetVariable, request)
        self._view.refuse_past()
        container = self._view.handles.find(given.variables_reference)
        if container is None:
            raise Refused("The debuggee has moved since: ask for the scopes again")
        if isinstance(container, Below):
            written = await self._view.need().write(_joined(container.path, given.name), given.value)
            return self._written(written, None)
        scope = container if isinstance(container, FrameScope) else container.scope
        name = given.name if isinstance(container, FrameScope) else _joined(container.name, given.name)
        written = await self._write_local(scope, name, given.value)
        return self._written(written, scope)

    async def _write_local(self, scope: FrameScope, name: str, value: str) -> Variable:
        found = await self._frame_variable(scope, name)
        if found is not None and found.path is not None:
            return await self._view.need().write(found.path, value)
        return await self._view.need().write_frame(scope.task, scope.frame, name, value)

    def _written(self, variable: Variable, scope: FrameScope | None) -> dict[str, Any]:
        shown = self._variable(variable, scope)
        return {key: shown[key] for key in ("value", "type", "variablesReference")}

    async def _frame_variable(self, scope: FrameScope, name: str) -> Variable | None:
        variables = await self._view.need().frame_variables(scope.task, scope.frame)
        return next((v for v in variables if v.name.casefold() == name.casefold()), None)

    # -- expressions -------------------------------------------------------------------------------------

    async def _evaluate(self, request: m.Request) -> Any:
        given = m.arguments_as(m.Evaluate, request)
        assigned = _ASSIGNMENT.match(given.expression) if given.context == "repl" else None
        if assigned is not None:
            variable = await self._assign(assigned["target"], assigned["value"], given.frame_id)
        else:
            variable = await self._evaluated(given.expression, given.frame_id)
        shown = self._variable(variable, self._scope(given.frame_id) if variable.path is None else None)
        return {
            "result": shown.pop("value"),
            **{k: v for k, v in shown.items() if k not in ("name", "evaluateName")},
        }

    async def _set_expression(self, request: m.Request) -> Any:
        given = m.arguments_as(m.SetExpression, request)
        variable = await self._assign(given.expression, given.value, given.frame_id)
        return self._written(variable, self._scope(given.frame_id) if variable.path is None else None)

    def _scope(self, frame_id: int | None) -> FrameScope | None:
        frame = self._view.handles.frame_of(frame_id)
        return FrameScope(frame[0], frame[1]) if frame is not None and self._view.at is None else None

    async def _assign(self, target: str, value: str, frame_id: int | None) -> Variable:
        self._view.refuse_past()
        variable = await self._evaluated(target, frame_id)
        if variable.path is not None:
            return await self._view.need().write(variable.path, value)
        scope = self._scope(frame_id)
        if scope is None:
            raise Refused(f"'{target}' cannot be written")
        return await self._view.need().write_frame(scope.task, scope.frame, variable.name, value)

    async def _evaluated(self, expression: str, frame_id: int | None) -> Variable:
        """A variable, looked for where a statement of the frame would look: in the frame, its instance,
        globally.
        """
        text = expression.strip()
        frame = self._view.handles.frame_of(frame_id)
        if frame is not None and self._view.at is None:
            scope = FrameScope(frame[0], frame[1])
            local = await self._frame_variable(scope, re.split(r"[.\[]", text, maxsplit=1)[0])
            if local is not None:
                if local.path is not None:
                    return await self._view.need().read(local.path + text[len(local.name) :], None)
                return _inside(local, text)
        candidates = [text]
        if frame is not None and frame[2] is not None:
            candidates.insert(0, f"{frame[2]}.{_THIS.sub('', text, count=1)}")
        refusal: Refused | None = None
        for path in candidates:
            try:
                return await self._view.need().read(path, self._view.cycle)
            except Refused as error:
                refusal = error
        raise refusal or Refused(f"'{text}' names no variable")

    async def _exception_info(self, request: m.Request) -> Any:
        m.arguments_as(m.OfThread, request)
        reason = await self._view.need().exception()
        if reason is None:
            raise Refused("The application is in no exception")
        return {"exceptionId": "Exception", "description": self._view.say(reason), "breakMode": "always"}

    async def _data_breakpoint_info(self, request: m.Request) -> Any:
        given = m.arguments_as(m.DataBreakpointInfo, request)
        path = await self._path_of(given)
        if path is None:
            return {
                "dataId": None,
                "description": self._view.say(
                    f"{given.name} is a local variable: only variables that stay can be watched"
                ),
            }
        return {"dataId": path, "description": path, "accessTypes": ["write"], "canPersist": True}

    async def _path_of(self, given: m.DataBreakpointInfo) -> str | None:
        if given.variables_reference:
            container = self._view.handles.find(given.variables_reference)
            if isinstance(container, Below):
                return _joined(container.path, given.name)
            if isinstance(container, FrameScope):
                found = await self._frame_variable(container, given.name)
                return found.path if found is not None else None
            return None
        variable = await self._evaluated(given.name, given.frame_id)
        return variable.path

    async def _source(self, request: m.Request) -> Any:
        given = m.arguments_as(m.SourceText, request)
        number = given.source_reference or (given.source.source_reference if given.source else 0)
        return {"content": await self._view.need().text(self._view.reference(number))}


def _scope(name: str, reference: int, hint: str | None) -> dict[str, Any]:
    shown: dict[str, Any] = {"name": name, "variablesReference": reference, "expensive": False}
    return shown | {"presentationHint": hint} if hint else shown


def _joined(path: str, name: str) -> str:
    if name.startswith("["):
        return f"{path}{name}"
    return f"{path}.{name}" if path else name


def _parts(container: Nested) -> list[Variable]:
    """The parts of a structured value of a frame."""
    value = container.value
    rows = value.items() if isinstance(value, dict) else ((f"[{i}]", each) for i, each in enumerate(value))
    return [Variable(_joined(container.name, name), "", _literal(each), each) for name, each in rows]


def _literal(value: Any) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return value if isinstance(value, str) else json.encode(value).decode()


def _inside(variable: Variable, text: str) -> Variable:
    """The part of a structured value of a frame that `text` names. Raises Refused."""
    value: Any = variable.value
    name = variable.name
    for step in re.findall(r"\.[^.\[\]]+|\[[^\]]*\]|[^.\[\]]+", text)[1:]:
        try:
            if step.startswith("["):
                value = value[int(step[1:-1])]
            else:
                members = {key.casefold(): key for key in value}
                value = value[members[step[1:].casefold()]]
        except (LookupError, TypeError, ValueError, AttributeError) as error:
            raise Refused(f"'{name}' has no '{step}'") from error
        name += step
    if name == variable.name:
        return variable
    return Variable(name, "", _literal(value), value, writable=variable.writable)
