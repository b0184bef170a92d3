"""The files of a 3D view's page, fetched from its server."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import httpx

_PASSED_ON = ("content-type", "content-encoding", "etag", "last-modified")


class UnreachableError(RuntimeError):
    """The server of a view does not answer."""


@dataclass(frozen=True, slots=True)
class File:
    """An answer as it came, compressed or not."""

    status: int
    headers: dict[str, str]
    content: bytes


async def fetch(socket: Path, path: str, accept_encoding: str) -> File:
    """A file of the server on a UNIX socket. Raises UnreachableError."""
    transport = httpx.AsyncHTTPTransport(uds=str(socket), verify=False)
    async with httpx.AsyncClient(transport=transport, timeout=30.0, trust_env=False) as http:
        request = http.build_request("GET", httpx.URL("http://localhost").copy_with(path=f"/{path}"))
        request.headers["Accept-Encoding"] = accept_encoding
        try:
            response = await http.send(request, stream=True)
            try:
                content = b"".join([chunk async for chunk in response.aiter_raw()])
            finally:
                await response.aclose()
        except httpx.HTTPError as error:
            raise UnreachableError(str(error)) from error
    headers = {name: response.headers[name] for name in _PASSED_ON if name in response.headers}
    return File(response.status_code, headers, content)
