"""Errors as RFC 9457 problem details: one shape for every refusal of the API."""

from __future__ import annotations

import logging
import secrets
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI
from fastapi.encoders import jsonable_encoder
from fastapi.exceptions import RequestValidationError, WebSocketRequestValidationError
from sqlalchemy.exc import DBAPIError
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse
from starlette.websockets import WebSocket, WebSocketState

from tappet.disk_full import is_disk_full
from tappet.project.errors import ProjectError
from tappet.project.store import StaleRevision
from tappet.server.objects.replies import object_detail
from tappet.server.shapes import InvalidField
from tappet.server.spoken import in_language, language_of_request
from tappet.translation.language import Language
from tappet.translation.sentences import sentence

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

    def body(self, language: Language = "en") -> dict[str, Any]:
        """The JSON object sent to the client. `type` and names of fields are the same in all languages."""
        return {
            "type": f"urn:tappet:problem:{self.kind}",
            "title": sentence(self.title, language),
            "status": self.status,
            "detail": sentence(self.detail, language),
            **{name: in_language(field, language) for name, field in self.fields.items()},
        }

    def response(self, language: Language = "en") -> JSONResponse:
        """The HTTP response, with its sentences in a language."""
        headers = {**(self.headers or {}), "Content-Language": language}
        return JSONResponse(jsonable_encoder(self.body(language)), self.status, headers, MEDIA_TYPE)


def not_found(what: str, name: str) -> Problem:
    """A 404 that names what is missing."""
    return Problem(404, "not-found", f"There is no {what} '{name}'.")


async def _answer(connection: HTTPConnection, problem: Problem) -> JSONResponse | None:
    """Sends a problem also as the refusal of a WebSocket that is not yet open."""
    language = language_of_request(connection)
    response = problem.response(language)
    if isinstance(connection, WebSocket):
        if "websocket.http.response" in connection.scope.get("extensions", {}):
            await connection.send_denial_response(response)
        else:
            await connection.close(1008, problem.detail[:120])
        return None
    return response


PROJECT_STATUS = {
    "unknown_object": 404,
    "unknown_project": 404,
    "unknown_revision": 404,
    "name_taken": 409,
    "changed_since": 409,
    "stale_revision": 409,
    "not_undoable": 409,
    "unknown_difference": 409,
    "document_too_large": 413,
    "store": 503,
}
"""HTTP status of errors of the project room by their code; all others are 422."""


def disk_full(where: str) -> Problem:
    """A 507 problem; what could not be written is as it was."""
    detail = f"The disk is full: {where}. Nothing was changed; make room there, then try again."
    return Problem(507, "disk-full", detail)


def as_problem(error: Exception) -> Problem:
    """What a client hears of an error; one that no client can help is a 500 with a reference to the log."""
    if isinstance(error, Problem):
        return error
    if is_disk_full(error):
        return disk_full("the server has no room for its database and files")
    if isinstance(error, ProjectError):
        return _of_project(error)
    if isinstance(error, RequestValidationError | WebSocketRequestValidationError):
        return _invalid(error)
    if isinstance(error, UnicodeEncodeError):
        # JSON can carry halves of characters (surrogates), which no text file and no database can.
        detail = "The request contains half of a character (a lone surrogate), which no text can hold."
        return Problem(422, "invalid-request", detail)
    if isinstance(error, HTTPException):
        phrase = HTTPStatus(error.status_code).phrase
        kind = phrase.lower().replace(" ", "-").replace("'", "")
        headers = dict(error.headers) if error.headers else None
        return Problem(error.status_code, kind, str(error.detail), headers=headers)
    reference = secrets.token_hex(4)
    detail = f"The server failed to handle this request; its log has the cause under reference {reference}."
    return Problem(500, "internal-error", detail, reference=reference)


def _of_project(error: ProjectError) -> Problem:
    fields: dict[str, Any] = {}
    if isinstance(error, StaleRevision):
        fields = {
            "current": object_detail(error.current) if error.current is not None else None,
            "yours": {"base_revision": error.base_revision, **error.yours},
            "author": error.author,
            "object_id": error.object_id,
        }
    status = PROJECT_STATUS.get(error.code, 422)
    return Problem(status, error.code.replace("_", "-"), str(error), **fields)


def _invalid(error: RequestValidationError | WebSocketRequestValidationError) -> Problem:
    errors = [
        InvalidField(
            location=".".join(str(part) for part in item["loc"]),
            message=item["msg"].removeprefix("Value error, "),
        )
        for item in error.errors()
    ]
    return invalid_request(errors or [InvalidField(location="request", message="invalid")])


def invalid_request(errors: list[InvalidField], kind: str = "invalid-request") -> Problem:
    """A 422 that names the wrong fields; its sentence is of the first."""
    return Problem(422, kind, f"{errors[0].location}: {errors[0].message}", errors=errors)


async def _on_error(connection: HTTPConnection, error: Exception) -> Any:
    if isinstance(connection, WebSocket) and connection.application_state is not WebSocketState.CONNECTING:
        raise error  # an open socket has no answer to give
    problem = as_problem(error)
    if problem.kind == "internal-error":
        log.error(
            "%s %s failed (%s)",
            connection.scope.get("method", "SOCKET"),
            connection.url.path,
            problem.fields["reference"],
            exc_info=error,
        )
    elif isinstance(error, HTTPException) and error.detail == problem.title:
        problem.detail = f"{problem.title}: {connection.url.path}"
    return await _answer(connection, problem)


def install(app: FastAPI) -> None:
    """Makes every error of `app` a problem."""
    for kind in (
        Problem,
        ProjectError,
        HTTPException,
        RequestValidationError,
        WebSocketRequestValidationError,
        UnicodeEncodeError,
        OSError,
        DBAPIError,
        Exception,
    ):
        app.add_exception_handler(kind, _on_error)
