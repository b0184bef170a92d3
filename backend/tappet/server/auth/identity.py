"""What a request proves about its sender."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime

from sqlalchemy import Connection
from sqlalchemy.exc import DBAPIError
from starlette.requests import HTTPConnection

from tappet.disk_full import is_disk_full
from tappet.server.auth import origin, sessions, tokens
from tappet.server.auth.roles import Role
from tappet.server.database import Database
from tappet.server.problems import Problem
from tappet.server.settings import ServerSettings


@dataclass(frozen=True, slots=True)
class Identity:
    """The user behind a request or socket."""

    user_id: str
    username: str
    role: Role
    address: str
    session_id: str | None = None
    """Set when a browser session proved it."""
    token_id: str | None = None
    """Set when a bearer token proved it."""


@dataclass(frozen=True, slots=True)
class Credential:
    """The secret a request carries, so that a long-lived socket can be checked again later."""

    secret: str
    bearer: bool


def client_address(connection: HTTPConnection) -> str:
    """Address of the client as the ASGI server knows it (behind a trusted proxy: the forwarded one)."""
    return connection.client.host if connection.client else ""


def credential_of(connection: HTTPConnection) -> Credential | None:
    """The bearer token, else the session cookie; raises a 401 problem on a malformed Authorization."""
    header = connection.headers.get("authorization")
    if header is not None:
        scheme, _, secret = header.partition(" ")
        if scheme.lower() != "bearer" or not secret.strip():
            raise unauthenticated("The Authorization header must read 'Bearer <token>'.")
        return Credential(secret.strip(), True)
    cookie = connection.cookies.get(sessions.COOKIE)
    return Credential(cookie, False) if cookie else None


def resolve(
    database: Database,
    credential: Credential,
    address: str,
    settings: ServerSettings,
    *,
    touch: bool = False,
) -> Identity | None:
    """The identity that the credential proves now; None when it no longer does. Blocks for the database.

    With `touch` this counts as a use. An open socket alone does not, or a session would never be idle.
    """
    now = datetime.now(UTC)
    if credential.bearer:
        token = database.read(lambda db: tokens.find(db, credential.secret, now))
        if token is None:
            return None
        if touch and token.touch_due:
            _touch(database, lambda db: tokens.touch(db, token.id, now))
        return Identity(token.user_id, token.username, token.role, address, token_id=token.id)
    session = database.read(lambda db: sessions.find(db, credential.secret, settings, now))
    if session is None:
        return None
    if touch and session.touch_due:
        _touch(database, lambda db: sessions.touch(db, session.id, now))
    return Identity(session.user_id, session.username, session.role, address, session_id=session.id)


def _touch(database: Database, write: Callable[[Connection], None]) -> None:
    """Notes a use, unless the disk is full: reading goes on then."""
    try:
        database.write(write)
    except DBAPIError as error:
        if not is_disk_full(error):
            raise


def unauthenticated(detail: str = "Log in, or send 'Authorization: Bearer <token>'.") -> Problem:
    """A 401 problem."""
    return Problem(401, "unauthenticated", detail, headers={"WWW-Authenticate": "Bearer"})


def require(identity: Identity | None, role: Role) -> Identity:
    """The identity when it has `role`; raises 401 and 403 problems."""
    if identity is None:
        raise unauthenticated()
    if not identity.role.includes(role):
        raise Problem(
            403,
            "role-too-low",
            f"This needs the role '{role.value}'; '{identity.username}' has '{identity.role.value}'.",
            required_role=role.value,
        )
    return identity


def check_request(connection: HTTPConnection, credential: Credential, settings: ServerSettings) -> None:
    """Raises a 403 problem when a cookie is used by what may be a foreign page."""
    if not credential.bearer:
        origin.check_cookie_use(connection, settings)
