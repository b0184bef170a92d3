"""Serves the built front end: one page for every address of the workbench, files with a long life."""

from __future__ import annotations

import gzip
from pathlib import Path

from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import FileResponse, HTMLResponse, Response
from starlette.routing import Match, Mount
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

import tappet

HASHED = "assets/"
"""Files below it carry a hash of their content in their names."""
SCRIPT_WORKER = "assets/scriptWorker-"
"""The worker in which scripts of users run (docs/scripts.md)."""
SCRIPT_POLICY = "default-src 'none'; script-src blob:"
"""Of that worker: the module that it is given, no other code, no connections, no workers of its own."""
METHODS = ("GET", "POST", "PUT", "PATCH", "DELETE")
FOREVER = "public, max-age=31536000, immutable"
NOT_BUILT = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Tappet</title>
<body style="font-family: sans-serif; max-width: 40em; margin: 4em auto">
<h1>The front end is not built</h1>
<p>The server works, but there is no page to show. In a checkout, <code>make run</code> builds it; by hand:
<code>cd frontend &amp;&amp; npm ci &amp;&amp; npm run build</code>.</p></body></html>"""


def find_static(configured: Path | None) -> Path | None:
    """The folder of the built front end: as configured, in the package, or in the checkout."""
    package = Path(tappet.__file__).resolve().parent
    candidates = (
        [configured] if configured else [package / "frontend", package.parents[1] / "frontend" / "dist"]
    )
    return next((folder for folder in candidates if (folder / "index.html").is_file()), None)


class FrontEnd(StaticFiles):
    """The files of the front end; addresses of the workbench, which are no files, get its page."""

    def __init__(self, folder: Path | None) -> None:
        super().__init__(directory=folder, check_dir=False)
        self._folder = folder
        self._packed: dict[str, bytes] = {}
        """Files with hashed names never change, so there is one entry a file of one build."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        """The file, the page, or a 404 problem."""
        if path.startswith(("api/", "views/")) or path in ("api", "views"):
            methods = _methods(scope)
            raise HTTPException(405, headers={"Allow": ", ".join(methods)}) if methods else HTTPException(404)
        if self._folder is None:
            return HTMLResponse(NOT_BUILT, headers={"Cache-Control": "no-store"})
        try:
            response = await super().get_response("index.html" if path == "." else path, scope)
        except HTTPException as error:
            if error.status_code != 404 or "." in path.rpartition("/")[2]:
                raise
            path = "."
            response = await super().get_response("index.html", scope)
        hashed = path.startswith(HASHED)
        if hashed and isinstance(response, FileResponse) and response.status_code == 200:
            response = await self._compressed(response, Headers(scope=scope))
        response.headers["Cache-Control"] = FOREVER if hashed else "no-cache"
        if path.startswith(SCRIPT_WORKER):
            response.headers["Content-Security-Policy"] = SCRIPT_POLICY
        return response

    async def _compressed(self, response: FileResponse, asked: Headers) -> Response:
        """Texts as gzip, packed once: the code editor alone is several megabytes."""
        if "gzip" not in asked.get("accept-encoding", "") or not _is_text(response.media_type or ""):
            return response
        packed = self._packed.get(str(response.path))
        if packed is None:
            packed = await run_in_threadpool(lambda: gzip.compress(Path(response.path).read_bytes(), 6))
            self._packed[str(response.path)] = packed
        headers = {"Content-Encoding": "gzip", "Vary": "Accept-Encoding", "ETag": response.headers["etag"]}
        return Response(packed, headers=headers, media_type=response.media_type)


def _methods(scope: Scope) -> list[str]:
    """What the routes of the app take at this address; none of them took the method of the request."""
    routes = scope["app"].routes
    return [
        method
        for method in METHODS
        if any(
            route.matches({**scope, "method": method})[0] is Match.FULL
            for route in routes
            if not isinstance(route, Mount)
        )
    ]


def _is_text(media_type: str) -> bool:
    return media_type.startswith("text/") or media_type in ("application/json", "image/svg+xml")
