"""Whether a page of this very server sent a request: the defence against cross-site requests."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.requests import HTTPConnection

from tappet.server.problems import Problem
from tappet.server.settings import ServerSettings

CLIENT_HEADER = "x-tappet-client"
"""Sent by the front end with every request; a foreign page cannot set it without a CORS preflight,
which this server never grants."""
SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS", "TRACE"})
_PORTS = {"http": 80, "ws": 80, "https": 443, "wss": 443}


def _host_and_port(netloc: str, scheme: str) -> tuple[str, int | None] | None:
    try:
        parts = urlsplit(f"//{netloc}")
        return (parts.hostname or "", parts.port or _PORTS.get(scheme))
    except ValueError:
        return None


def is_same_origin(connection: HTTPConnection, settings: ServerSettings) -> bool:
    """Whether the Origin header names the host the request was sent to, or a configured origin."""
    origin = connection.headers.get("origin")
    if origin is None:
        return False
    if origin in settings.public_origins:
        return True
    try:
        parts = urlsplit(origin)
    except ValueError:
        return False
    if parts.scheme not in ("http", "https") or (settings.https and parts.scheme != "https"):
        return False
    host = connection.headers.get("host", "")
    # Behind a TLS proxy the request arrives as http: a Host without port means the default of the origin.
    mine = _host_and_port(host, parts.scheme)
    return mine is not None and mine[0] != "" and _host_and_port(parts.netloc, parts.scheme) == mine


def check_cookie_use(connection: HTTPConnection, settings: ServerSettings) -> None:
    """Raises a 403 problem when a request that acts by cookie may come from a foreign page."""
    socket = connection.scope["type"] == "websocket"
    if not socket and connection.scope["method"] in SAFE_METHODS:
        return
    if not is_same_origin(connection, settings):
        raise Problem(
            403,
            "foreign-origin",
            "This request does not come from a page of this server (Origin and Host differ). "
            "Scripts use a bearer token instead of the session cookie.",
        )
    if not socket and connection.headers.get(CLIENT_HEADER) is None:
        raise Problem(
            403,
            "client-header-missing",
            "Requests that change something by session cookie carry the header 'X-Tappet-Client: 1'. "
            "Scripts use a bearer token instead.",
        )
