"""The description of the REST interface."""

from __future__ import annotations

from functools import cache
from typing import Any

from fastapi import FastAPI, Request
from starlette.responses import HTMLResponse, JSONResponse

from tappet.server.dependencies import Viewer
from tappet.server.docs import page as docs_page
from tappet.server.routing import Router

router = Router(prefix="/api", include_in_schema=False)


@cache
def _page(app: FastAPI) -> str:
    return docs_page.render(_document(app))


def _document(app: FastAPI) -> dict[str, Any]:
    return app.openapi()


@router.get("/docs")
def docs(who: Viewer, request: Request) -> HTMLResponse:
    """A page to read."""
    return HTMLResponse(_page(request.app))


@router.get("/v1/openapi.json")
def openapi(who: Viewer, request: Request) -> JSONResponse:
    """The OpenAPI document."""
    return JSONResponse(_document(request.app))
