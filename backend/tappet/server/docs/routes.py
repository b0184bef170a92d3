"""The description of the REST interface."""

from __future__ import annotations

import json
from functools import cache

from fastapi import FastAPI, Request
from starlette.responses import HTMLResponse, Response

from tappet.server.dependencies import Viewer
from tappet.server.docs import page as docs_page
from tappet.server.routing import Router

router = Router(prefix="/api", include_in_schema=False)


@cache
def _page(app: FastAPI) -> str:
    return docs_page.render(app.openapi())


@cache
def _text(app: FastAPI) -> str:
    return json.dumps(app.openapi(), ensure_ascii=False, separators=(",", ":"))


@router.get("/docs")
def docs(who: Viewer, request: Request) -> HTMLResponse:
    """A page to read."""
    return HTMLResponse(_page(request.app))


@router.get("/v1/openapi.json")
def openapi(who: Viewer, request: Request) -> Response:
    """The OpenAPI document."""
    return Response(_text(request.app), media_type="application/json")
