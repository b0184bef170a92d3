"""What routes ask for: the services, the database, and who is asking in which role.

Every route names its minimum role by taking `Viewer`, `Operator`, `Engineer` or `Admin` (or by
`dependencies=[Depends(require_viewer)]`); a test walks all routes and fails for one that does not.
"""

from __future__ import annotations

from typing import Annotated, cast

from fastapi import Depends
from starlette.concurrency import run_in_threadpool
from starlette.requests import HTTPConnection

from tappet.project.store import Store
from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.auth import identity as identities
from tappet.server.auth import origin
from tappet.server.auth.identity import Credential, Identity
from tappet.server.auth.roles import Role
from tappet.server.builds.commissioning import Commissioning
from tappet.server.database import Database
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink, RuntimeRegistry
from tappet.server.services import Services
from tappet.server.settings import ServerSettings
from tappet.server.sockets import SessionWatch

_IDENTITY = "tappet.identity"
"""Where a request keeps who sent it, once that is known."""


async def services_of(connection: HTTPConnection) -> Services:
    """The services of the running server."""
    services: Services = connection.app.state.services
    return services


async def settings_of(connection: HTTPConnection) -> ServerSettings:
    """The settings of the running server."""
    return (await services_of(connection)).settings


async def database_of(connection: HTTPConnection) -> Database:
    """The server's database."""
    return (await services_of(connection)).database


async def optional_identity(connection: HTTPConnection) -> Identity | None:
    """Who asks, or None; for the few routes open to everybody."""
    services: Services = connection.app.state.services
    credential = identities.credential_of(connection)
    if credential is None:
        return None
    address = identities.client_address(connection)
    return await _resolved(services, credential, address, touch=True)


async def _resolved(
    services: Services, credential: Credential, address: str, *, touch: bool = False
) -> Identity | None:
    found = await run_in_threadpool(
        identities.resolve, services.database, credential, address, services.settings, touch=touch
    )
    if found is not None and services.audit_reserve.has_ended(found.session_id):
        return None  # logged out, which the database could not be told yet
    return found


async def session_watch(connection: HTTPConnection) -> SessionWatch:
    """For sockets, which outlive the check at their opening: when the session or token ends."""
    services: Services = connection.app.state.services
    credential = identities.credential_of(connection)
    address = identities.client_address(connection)

    async def still_allowed() -> bool:
        if credential is None:
            return False
        return await _resolved(services, credential, address) is not None

    return SessionWatch(still_allowed, services.ended_sessions)


async def identify(connection: HTTPConnection) -> Identity | None:
    """Who asks, or None. Raises 401 problems for what is no credential, 403 for cookies of foreign pages."""
    if (known := connection.scope.get(_IDENTITY)) is not None:
        return cast(Identity, known)
    services: Services = connection.app.state.services
    credential = identities.credential_of(connection)
    if credential is not None:
        identities.check_request(connection, credential, services.settings)
    who = connection.scope[_IDENTITY] = await optional_identity(connection)
    return who


class RequireRole:
    """Dependency of routes and sockets: who asks, having at least `role`; also refuses foreign pages.

    Routes that change something take `audited` instead, or are refused in the audit log here.
    """

    def __init__(self, role: Role) -> None:
        self.role = role

    async def __call__(self, connection: HTTPConnection) -> Identity:
        """Raises 401 and 403 problems."""
        who = await identify(connection)
        try:
            return identities.require(who, self.role)
        except Problem as problem:
            if who is not None and connection.scope.get("method") not in origin.SAFE_METHODS:
                act = Act("no-right", f"{connection.scope.get('method', 'SOCKET')} {connection.url.path}")
                database = await database_of(connection)
                await run_in_threadpool(audit.note_refusal, database, who, act, problem.detail)
            raise


require_viewer = RequireRole(Role.VIEWER)
require_operator = RequireRole(Role.OPERATOR)
require_engineer = RequireRole(Role.ENGINEER)
require_admin = RequireRole(Role.ADMIN)


async def store_of(connection: HTTPConnection) -> Store:
    """The project store; its methods block, so routes that use it are plain functions."""
    return (await services_of(connection)).store


async def runtimes_of(connection: HTTPConnection) -> RuntimeRegistry:
    """The runtimes of the running server."""
    return (await services_of(connection)).runtimes


async def commissioning_of(connection: HTTPConnection) -> Commissioning:
    """Build, login and download."""
    return (await services_of(connection)).commissioning


async def link_of(runtime_id: str, connection: HTTPConnection) -> RuntimeLink:
    """The runtime that the path names; raises a 404 problem."""
    return (await runtimes_of(connection)).get(runtime_id)


ServicesDep = Annotated[Services, Depends(services_of)]
SettingsDep = Annotated[ServerSettings, Depends(settings_of)]
DatabaseDep = Annotated[Database, Depends(database_of)]
StoreDep = Annotated[Store, Depends(store_of)]
RuntimesDep = Annotated[RuntimeRegistry, Depends(runtimes_of)]
CommissioningDep = Annotated[Commissioning, Depends(commissioning_of)]
LinkDep = Annotated[RuntimeLink, Depends(link_of)]
MaybeIdentity = Annotated[Identity | None, Depends(optional_identity)]
SessionDep = Annotated[SessionWatch, Depends(session_watch)]
Viewer = Annotated[Identity, Depends(require_viewer)]
Operator = Annotated[Identity, Depends(require_operator)]
Engineer = Annotated[Identity, Depends(require_engineer)]
Admin = Annotated[Identity, Depends(require_admin)]
