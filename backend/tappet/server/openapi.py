"""The OpenAPI document, with the shapes of the WebSocket messages too."""

from __future__ import annotations

import re
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from fastapi.routing import iter_route_contexts
from pydantic import TypeAdapter

from tappet.server.events.shapes import EventMessage, OpenObject
from tappet.server.online.shapes import ClientMessage, ServerMessage
from tappet.server.problems import MEDIA_TYPE
from tappet.server.routing import least_role
from tappet.server.runtimes import operations
from tappet.server.shapes import ProblemDetails

_REF = "#/components/schemas/{model}"
_PROBLEM = {
    "description": "The request was refused",
    "content": {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/ProblemDetails"}}},
}
PROBLEM_RESPONSES: dict[int | str, dict[str, Any]] = {"default": _PROBLEM, 422: _PROBLEM}
"""Responses of all routes."""
WAYS_IN = {
    "session": {"type": "apiKey", "in": "cookie", "name": "tappet_session"},
    "token": {"type": "http", "scheme": "bearer"},
}
SOCKET_SHAPES: dict[str, Any] = {
    "ProblemDetails": ProblemDetails,
    "OnlineClientMessage": ClientMessage,
    "OnlineServerMessage": ServerMessage,
    "EventClientMessage": OpenObject,
    "EventServerMessage": EventMessage,
}
"""Shapes that no REST route mentions, by the name the client knows them under."""


_CONVERTER = re.compile(r":\w+(?=})")
"""What a path says of a parameter besides its name: `{word:path}`."""


def _extra_schemas() -> dict[str, Any]:
    schemas: dict[str, Any] = {}
    for name, shape in SOCKET_SHAPES.items():
        schema = TypeAdapter(shape).json_schema(
            ref_template=_REF, mode="validation" if "Client" in name else "serialization"
        )
        schemas.update(schema.pop("$defs", {}))
        schemas.setdefault(name, schema)
    return schemas


def _state_roles(app: FastAPI, paths: dict[str, Any]) -> None:
    """Each operation says which role it needs, by its cookie or token; or that it needs none."""
    for route in iter_route_contexts(app.routes):
        for method in route.methods or ():
            path = _CONVERTER.sub("", route.path or "")
            operation = paths.get(path, {}).get(method.lower())
            if operation is not None:
                role = least_role(route.dependant)
                operation["security"] = [] if role is None else [{way: [role.value]} for way in WAYS_IN]


def document(app: FastAPI) -> dict[str, Any]:
    """The whole document."""
    result = get_openapi(
        title=app.title, version=app.version, summary=app.summary, routes=app.routes, openapi_version="3.1.0"
    )
    components = result.setdefault("components", {})
    schemas = components.setdefault("schemas", {})
    for name, schema in _extra_schemas().items():
        schemas.setdefault(name, schema)
    schemas.update(operations.schemas())  # some are in shapes of the server, which know less of them
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    components["schemas"] = dict(sorted(schemas.items()))
    components["securitySchemes"] = WAYS_IN
    _state_roles(app, result["paths"])
    return result


def install(app: FastAPI) -> None:
    """Makes `app` serve this document."""

    def cached() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = document(app)
        return app.openapi_schema

    app.openapi = cached  # type: ignore[method-assign]
