"""REST routes of the wire operations that declare one: arguments, role, audit and answer follow from that.

The types of the operation check the request; a wrong field is named as in any other refusal of the API.
Routes that need more than the runtime knows (expressions, places in the editors) stand in `routes`.
"""

from __future__ import annotations

import re
from collections.abc import Awaitable, Callable, Iterable
from typing import Any, TypeVar, get_type_hints

import msgspec
from fastapi import Depends, Request
from starlette.responses import Response

from tappet.runtime.operations import registry
from tappet.runtime.operations.declaration import Rest, WireOperation, reply_type
from tappet.runtime.protocol import place_and_reason
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.identity import Identity
from tappet.server.auth.roles import Role
from tappet.server.dependencies import RequireRole, link_of, services_of
from tappet.server.problems import Problem, invalid_request
from tappet.server.routing import Router
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.runtimes.shapes import RuntimeState
from tappet.server.shapes import InvalidField
from tappet.server.spoken import LanguageDep, in_language

T = TypeVar("T")
REF = "#/components/schemas/{name}"
_BRACES = re.compile(r"\{(\w+)\}")


def router(kinds: Iterable[type[WireOperation[Any]]]) -> Router:
    """The routes of those operations that have one."""
    routes = Router(prefix="/runtimes/{runtime_id}")
    for kind in kinds:
        rest = kind.rest
        if rest is None:
            continue
        answer = answer_type(kind, rest)
        routes.add_api_route(
            rest.path,
            _endpoint(kind, rest),
            methods=[rest.method],
            name=kind.op,
            description=(kind.__doc__ or "").strip(),
            tags=[rest.tag],
            status_code=204 if answer is None else 200,
            response_model=RuntimeState if answer is RuntimeState else None,
            openapi_extra=_document(kind, rest, answer),
        )
    return routes


def answer_type(kind: type[WireOperation[Any]], rest: Rest) -> Any:
    """The type of what a route answers; None for nothing."""
    if rest.answer == "state":
        return RuntimeState
    found = reply_type(kind) if rest.answer == "reply" else get_type_hints(rest.answer)["return"]
    return None if found is type(None) else found


def schemas() -> dict[str, Any]:
    """JSON schemas of the shapes of all such routes, by name, for the API document."""
    shapes: list[Any] = []
    for kind in registry.known().values():
        if kind.rest is not None:
            answer = answer_type(kind, kind.rest)
            shapes += [] if answer in (None, RuntimeState) else [answer]
            shapes += [kind] if _in_body(kind, kind.rest) else []
    _, components = msgspec.json.schema_components(shapes, ref_template=REF)
    for kind in registry.known().values():
        if kind.rest is not None and _in_body(kind, kind.rest):
            _leave_out(components[kind.__name__], _BRACES.findall(kind.rest.path))
    return components


def _leave_out(schema: dict[str, Any], names: Iterable[str]) -> None:
    """What stands in the path is no part of the body."""
    for name in names:
        schema["properties"].pop(name, None)
        if name in schema.get("required", ()):
            schema["required"].remove(name)


def _endpoint(kind: type[WireOperation[Any]], rest: Rest) -> Callable[..., Awaitable[Any]]:
    role, facts = Role(rest.role), rest.audit
    action = kind.op.replace("_", "-")
    guard = (
        Depends(RequireRole(role))
        if facts is None
        else audited(action, role, quoted=True, always=rest.always)
    )
    shape = rest.answer if callable(rest.answer) else None

    async def endpoint(
        request: Request,
        language: LanguageDep,
        who: ActRecord | Identity = guard,
        link: RuntimeLink = Depends(link_of),  # noqa: B008 - how FastAPI declares dependencies
    ) -> Any:
        operation = await _read(request, kind, rest)
        if rest.variant:
            await (await services_of(request)).debug.prepare(link)
        async with link.client() as client:
            if facts is not None and isinstance(who, ActRecord):
                fact = facts(operation)
                subject = fact.subject or link.name
                await who.begin_async(Act(fact.action, subject, None, fact.new_value, None, link.id))
            reply = await client.call(operation)
        if rest.answer == "state":
            await link.refresh()
        if rest.answer == "state":
            return in_language(link.state(), language)
        if reply is None and answer_type(kind, rest) is None:
            return Response(status_code=204)
        content = msgspec.json.encode(in_language(shape(reply) if shape is not None else reply, language))
        return Response(content, media_type="application/json")

    return endpoint


async def _read(request: Request, kind: type[WireOperation[Any]], rest: Rest) -> WireOperation[Any]:
    """The operation a request asks for; raises a 422 problem that names the field."""
    where = "body" if rest.method in ("POST", "PUT") else "query"
    given: dict[str, Any] = dict(request.query_params)
    if where == "body":
        body = await request.body()
        given = _checked(where, lambda: msgspec.json.decode(body, type=dict[str, Any])) if body else {}
    for field in msgspec.structs.fields(kind):
        if field.name in _BRACES.findall(rest.path):
            if field.name in given:
                raise _invalid(f"{where}.{field.name}", "stands in the path, not here")
            given[field.name] = _from_path(request, field)
    return _checked(where, lambda: msgspec.convert(given, kind, strict=where == "body"))


def _from_path(request: Request, field: msgspec.structs.FieldInfo) -> Any:
    text = request.path_params[field.name]
    return _checked(f"path.{field.name}", lambda: msgspec.convert(text, field.type, strict=False))


def _checked(where: str, read: Callable[[], T]) -> T:
    try:
        return read()
    except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
        field, reason = place_and_reason(error)
        raise _invalid(f"{where}.{field}" if field else where, reason) from None


def _invalid(location: str, reason: str) -> Problem:
    return invalid_request([InvalidField(location=location, message=reason)])


# -- the API document ----------------------------------------------------------------------------------


def _in_body(kind: type[WireOperation[Any]], rest: Rest) -> bool:
    return rest.method in ("POST", "PUT") and len(kind.__struct_fields__) > len(_BRACES.findall(rest.path))


def _document(kind: type[WireOperation[Any]], rest: Rest, answer: Any) -> dict[str, Any]:
    document: dict[str, Any] = {}
    in_path = _BRACES.findall(rest.path)
    fields = msgspec.structs.fields(kind)
    parameters = [
        {
            "name": field.name,
            "in": "path" if field.name in in_path else "query",
            "required": field.name in in_path or field.required,
            "schema": _schema(str if field.name in in_path else field.type),
        }
        for field in fields
        if field.name in in_path or not _in_body(kind, rest)
    ]
    if parameters:
        document["parameters"] = parameters
    if _in_body(kind, rest):
        content = {"application/json": {"schema": _schema(kind)}}
        document["requestBody"] = {"required": any(field.required for field in fields), "content": content}
    if answer not in (None, RuntimeState):
        content = {"application/json": {"schema": _schema(answer)}}
        document["responses"] = {"200": {"description": "Successful Response", "content": content}}
    return document


def _schema(shape: Any) -> dict[str, Any]:
    (schema,), _ = msgspec.json.schema_components([shape], ref_template=REF)
    return schema
