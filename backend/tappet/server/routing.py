"""Routes that ask who sends before they read what is sent.

The framework reads and parses the body of a request before it asks the dependencies of its route; strangers
could so make the server take uploads and parse what they like.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Iterator
from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute

from tappet.server.audited import Audited
from tappet.server.auth import identity as identities
from tappet.server.auth.roles import Role
from tappet.server.dependencies import RequireRole, identify


def _dependants(dependant: Dependant) -> Iterator[Dependant]:
    yield dependant
    for inner in dependant.dependencies:
        yield from _dependants(inner)


def least_role(dependant: Dependant) -> Role | None:
    """The role that a route asks for; None when anybody may come in."""
    guards = [inner.call for inner in _dependants(dependant)]
    roles = [guard.role for guard in guards if isinstance(guard, RequireRole | Audited)]
    return max(roles, key=lambda role: role.rank, default=None)


class GuardedRoute(APIRoute):
    """Strangers get 401 before a byte of their body is read. Roles are checked by the dependencies."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """The handler of a request."""
        handler = super().get_route_handler()
        if self.body_field is None or least_role(self.dependant) is None:
            return handler

        async def guarded(request: Request) -> Response:
            if await identify(request) is None:
                raise identities.unauthenticated()
            return await handler(request)

        return guarded


class Router(APIRouter):
    """What every room of the server makes its routes with."""

    def __init__(self, **options: Any) -> None:
        super().__init__(route_class=GuardedRoute, **options)
