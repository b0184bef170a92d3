"""Errors as RFC 9457 problem details: one shape for every refusal of the API."""

from __future__ import annotations

import logging
import secrets
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI
from fastapi.encoders import jsonable_encoder
from fastapi.exceptions import RequestValidationError, WebSocketRequestValidationError
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse
from starlette.websockets import WebSocket

from tappet.project.errors import ProjectError
from tappet.project.store import StaleRevision
from tappet.server.objects.replies import object_detail

MEDIA_TYPE = "application/problem+json"
log = logging.getLogger(__name__)


class Problem(Exception):  # noqa: N818 - the term of RFC 9457
    """A request that cannot be served, with what the client needs to know about it.

    `kind` is a stable slug clients may test for; `detail` says what is wrong and what would be right.
    """

    def __init__(
        self,
        status: int,
        kind: str,
        detail: str,
        *,
        title: str | None = None,
        headers: dict[str, str] | None = None,
        **fields: Any,
    ) -> None:
        super().__init__(detail)
        self.status = status
        self.kind = kind
        self.detail = detail
        self.title = title or HTTPStatus(status).phrase
        self.headers = headers
        self.fields = fields

    def body(self) -> dict[str, Any]:
        """The JSON object sent to the client."""
        return {
            "type": f"urn:tappet:problem:{self.kind}",
            "title": self.title,
            "status": self.status,
            "detail": self.detail,
            **self.fields,
        }

    def response(self) -> JSONResponse:
        """The HTTP response."""
        return JSONResponse(jsonable_encoder(self.body()), self.status, self.headers, MEDIA_TYPE)


def not_found(what: str, name: str) -> Problem:
    """A 404 that names what is missing."""
    return Problem(404, "not-found", f"There is no {what} '{name}'.")


async def _answer(connection: HTTPConnection, problem: Problem) -> JSONResponse | None:
    """Sends a problem also as the refusal of a WebSocket that is not yet open."""
    response = problem.response()
    if isinstance(connection, WebSocket):
        if "websocket.http.response" in connection.scope.get("extensions", {}):
            await connection.send_denial_response(response)
        else:
            await connection.close(1008, problem.detail[:120])
        return None
    return response


async def _on_problem(connection: HTTPConnection, error: Exception) -> Any:
    assert isinstance(error, Problem)
    return await _answer(connection, error)


async def _on_http_exception(connection: HTTPConnection, error: Exception) -> Any:
    assert isinstance(error, HTTPException)
    phrase = HTTPStatus(error.status_code).phrase
    kind = phrase.lower().replace(" ", "-").replace("'", "")
    detail = str(error.detail) if error.detail != phrase else f"{phrase}: {connection.url.path}"
    headers = dict(error.headers) if error.headers else None
    return await _answer(connection, Problem(error.status_code, kind, detail, headers=headers))


async def _on_invalid(connection: HTTPConnection, error: Exception) -> Any:
    assert isinstance(error, RequestValidationError | WebSocketRequestValidationError)
    errors = [
        {"location": ".".join(str(part) for part in item["loc"]), "message": item["msg"]}
        for item in error.errors()
    ]
    first = errors[0] if errors else {"location": "request", "message": "invalid"}
    detail = f"{first['location']}: {first['message']}"
    return await _answer(connection, Problem(422, "invalid-request", detail, errors=errors))


PROJECT_STATUS = {
    "unknown_object": 404,
    "unknown_project": 404,
    "unknown_revision": 404,
    "name_taken": 409,
    "stale_revision": 409,
    "store": 503,
}
"""HTTP status of errors of the project room by their code; all others are 422."""


async def _on_project_error(connection: HTTPConnection, error: Exception) -> Any:
    assert isinstance(error, ProjectError)
    fields: dict[str, Any] = {}
    if isinstance(error, StaleRevision):
        fields = {
            "current": object_detail(error.current) if error.current is not None else None,
            "yours": {"base_revision": error.base_revision, **error.yours},
            "author": error.author,
            "object_id": error.object_id,
        }
    status = PROJECT_STATUS.get(error.code, 422)
    return await _answer(connection, Problem(status, error.code.replace("_", "-"), str(error), **fields))


async def _on_no_text(connection: HTTPConnection, error: Exception) -> Any:
    """JSON can carry halves of characters (surrogates), which no text file and no database can."""
    detail = "The request contains half of a character (a lone surrogate), which no text can hold."
    return await _answer(connection, Problem(422, "invalid-request", detail))


async def _on_crash(request: Request, error: Exception) -> JSONResponse:
    reference = secrets.token_hex(4)
    log.error("request %s %s failed (%s)", request.method, request.url.path, reference, exc_info=error)
    return Problem(
        500,
        "internal-error",
        f"The server failed to handle this request; its log has the cause under reference {reference}.",
        reference=reference,
    ).response()


def install(app: FastAPI) -> None:
    """Makes every error of `app` a problem."""
    app.add_exception_handler(Problem, _on_problem)
    app.add_exception_handler(ProjectError, _on_project_error)
    app.add_exception_handler(HTTPException, _on_http_exception)
    app.add_exception_handler(RequestValidationError, _on_invalid)
    app.add_exception_handler(UnicodeEncodeError, _on_no_text)
    app.add_exception_handler(WebSocketRequestValidationError, _on_invalid)
    app.add_exception_handler(Exception, _on_crash)
