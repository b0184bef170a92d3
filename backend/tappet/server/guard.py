"""What every HTTP answer and every request must satisfy, whatever route it meets."""

from __future__ import annotations

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket

from tappet.server.problems import Problem
from tappet.server.settings import ServerSettings
from tappet.server.spoken import language_of_request

PAGE_POLICY = (
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self'; worker-src 'self' blob:; frame-src 'self'; "
    "object-src 'none'; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'self'"
)
"""Content security policy of the workbench. Styles may be inline (Monaco, dockview), scripts not."""
SECURITY_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "X-Frame-Options": "SAMEORIGIN",
}


_TOO_LARGE = Problem(413, "too-large", "The body of this request is larger than the route accepts.")


def _is_plain_413(message: Message) -> bool:
    """Whether the framework's own limit answers, which knows no problem details."""
    if message["type"] != "http.response.start" or message["status"] != 413:
        return False
    return Headers(raw=message["headers"]).get("content-type", "").startswith("text/plain")


def host_name(header: str) -> str:
    """Host header without the port, in lower case."""
    host = header.strip().lower()
    if host.startswith("["):
        return host[: host.find("]") + 1]
    return host.rpartition(":")[0] if ":" in host else host


class RequestGuard:
    """Refuses foreign Host headers (DNS rebinding) and adds the security headers to every answer."""

    def __init__(self, app: ASGIApp, settings: ServerSettings) -> None:
        self._app = app
        self._names = settings.host_names
        self._https = settings.https

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One HTTP request or WebSocket."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] in ("http.response.start", "websocket.http.response.start"):
                self._add_headers(scope["path"], MutableHeaders(scope=message))
                services = getattr(scope["app"].state, "services", None)
                if services is not None:
                    method = scope.get("method", "SOCKET")
                    services.metrics.requests[method, message["status"]] += 1
            await send(message)

        replaced = False

        async def send_guarded(message: Message) -> None:
            nonlocal replaced
            if not replaced and _is_plain_413(message):
                replaced = True
                await _TOO_LARGE.response(language_of_request(HTTPConnection(scope)))(
                    scope, receive, send_with_headers
                )
            elif not replaced:
                await send_with_headers(message)

        name = host_name(Headers(scope=scope).get("host", ""))
        if self._names is not None and name not in self._names:
            await self._refuse(name, scope, receive, send_guarded)
            return
        await self._app(scope, receive, send_guarded)

    async def _refuse(self, name: str, scope: Scope, receive: Receive, send: Send) -> None:
        problem = Problem(
            421,
            "unknown-host",
            f"This server does not answer for '{name[:100]}'. If that is its name, start it with "
            f"--allowed-host {name[:100]}.",
        )
        response = problem.response(language_of_request(HTTPConnection(scope)))
        if scope["type"] == "http":
            await response(scope, receive, send)
            return
        socket = WebSocket(scope, receive, send)
        if "websocket.http.response" in scope.get("extensions", {}):
            await socket.send_denial_response(response)
        else:
            await socket.close(1008, "unknown host")

    def _add_headers(self, path: str, headers: MutableHeaders) -> None:
        for key, value in SECURITY_HEADERS.items():
            headers.setdefault(key, value)
        headers.setdefault("Content-Security-Policy", PAGE_POLICY)
        if path.startswith("/api/"):
            headers.setdefault("Cache-Control", "no-store")
        if self._https:
            headers.setdefault("Strict-Transport-Security", "max-age=31536000")
