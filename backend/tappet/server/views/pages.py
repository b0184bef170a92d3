"""The files of a 3D view's page, fetched from its server on loopback."""

from __future__ import annotations

from dataclasses import dataclass

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


class Pages:
    """`close` must be called."""

    def __init__(self) -> None:
        self._http = httpx.AsyncClient(timeout=30.0, trust_env=False)

    async def fetch(self, port: int, path: str, accept_encoding: str) -> File:
        """A file of the server at a port of this machine. Raises UnreachableError."""
        url = httpx.URL(f"http://127.0.0.1:{port}").copy_with(path=f"/{path}")
        request = self._http.build_request("GET", url, headers={"Accept-Encoding": accept_encoding})
        try:
            response = await self._http.send(request, stream=True)
            try:
                content = b"".join([chunk async for chunk in response.aiter_raw()])
            finally:
                await response.aclose()
        except httpx.HTTPError as error:
            raise UnreachableError(str(error)) from error
        headers = {name: response.headers[name] for name in _PASSED_ON if name in response.headers}
        return File(response.status_code, headers, content)

    async def close(self) -> None:
        """Ends the connections."""
        await self._http.aclose()
