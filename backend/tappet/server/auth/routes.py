"""Login, logout, the first account, one-time links, tokens."""

from __future__ import annotations

import ipaddress
from datetime import UTC, datetime, timedelta
from typing import Annotated

from fastapi import Query, Request, Response
from sqlalchemy import Connection
from sqlalchemy.exc import DBAPIError
from starlette.responses import RedirectResponse

from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth import accounts, identity, origin, sessions, tokens
from tappet.server.auth.identity import Identity
from tappet.server.auth.login import Client, LoggedIn
from tappet.server.auth.roles import Role
from tappet.server.auth.shapes import (
    AuthStatus,
    Credentials,
    FirstAccount,
    IssuedToken,
    Me,
    NewToken,
    PasswordChange,
    Token,
)
from tappet.server.dependencies import (
    DatabaseDep,
    MaybeIdentity,
    ServicesDep,
    SettingsDep,
    Viewer,
)
from tappet.server.personal_settings import service as personal_settings
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.services import Services
from tappet.server.settings import ServerSettings

router = Router(prefix="/auth", tags=["auth"])


def _client(request: Request) -> Client:
    return Client(
        identity.client_address(request),
        request.headers.get("user-agent", ""),
        request.cookies.get(sessions.COOKIE),
    )


def _me(db: Connection, who: Identity) -> Me:
    account = accounts.by_id(db, who.user_id)
    language, theme = (personal_settings.get(db, who.user_id, key) for key in ("language", "theme"))
    return Me(
        id=who.user_id,
        username=account.username,
        role=who.role,
        language=language if isinstance(language, str) else None,
        theme=theme if isinstance(theme, str) else None,
        has_password=account.has_password,
    )


def _welcome(services: Services, response: Response, logged_in: LoggedIn, address: str) -> Me:
    sessions.set_cookie(response, logged_in.secret, services.settings)
    services.ended_sessions.tell()  # the one that the browser had before
    account = logged_in.account
    who = Identity(account.id, account.username, account.role, address)
    return services.database.read(lambda db: _me(db, who))


def _refuse_foreign_page(request: Request, settings: ServerSettings) -> None:
    """A foreign page must not log the browser in as somebody else."""
    if request.headers.get("origin") is not None and not origin.is_same_origin(request, settings):
        raise Problem(403, "foreign-origin", "Log in from a page of this server.")


@router.get("/status")
def status(services: ServicesDep, who: MaybeIdentity) -> AuthStatus:
    """Whether anybody is logged in, and whether the server waits for its first account. Open to all."""

    def read(db: Connection) -> AuthStatus:
        me = _me(db, who) if who is not None else None
        return AuthStatus(first_account_needed=accounts.count(db) == 0, authenticated=me is not None, user=me)

    return services.database.read(read)


@router.post("/login")
def login(
    body: Credentials, request: Request, response: Response, services: ServicesDep, settings: SettingsDep
) -> Me:
    """Log in with user name and password; sets the session cookie. Repeated failures lock out for a while."""
    _refuse_foreign_page(request, settings)
    client = _client(request)
    return _welcome(
        services, response, services.login.by_password(body.username, body.password, client), client.address
    )


@router.post("/first-account", status_code=201)
def create_first_account(
    body: FirstAccount, request: Request, response: Response, services: ServicesDep, settings: SettingsDep
) -> Me:
    """Create the first administrator with the one-time token from the server's console, and log in."""
    _refuse_foreign_page(request, settings)
    client = _client(request)
    logged_in = services.login.create_first(body.token, body.username, body.password, client)
    return _welcome(services, response, logged_in, client.address)


@router.get("/link", status_code=303, response_class=RedirectResponse)
def follow_link(
    token: Annotated[str, Query(max_length=200)],
    request: Request,
    services: ServicesDep,
    settings: SettingsDep,
) -> RedirectResponse:
    """Log in by the one-time link that the server printed; only from the machine it runs on."""
    client = _client(request)
    try:
        local = ipaddress.ip_address(client.address).is_loopback
    except ValueError:
        local = False
    if not local:
        raise Problem(403, "not-local", "A login link works only on the machine that the server runs on.")
    logged_in = services.login.by_link(token, client)
    response = RedirectResponse("/", 303, {"Cache-Control": "no-store", "Referrer-Policy": "no-referrer"})
    sessions.set_cookie(response, logged_in.secret, settings)
    return response


@router.post("/logout", status_code=204)
def logout(
    act: Annotated[ActRecord, audited("logout", Role.VIEWER, always=True)],
    request: Request,
    response: Response,
    services: ServicesDep,
    settings: SettingsDep,
) -> None:
    """End this session; its open sockets are closed."""
    act.begin(Act("logout", act.who.username))
    secret = request.cookies.get(sessions.COOKIE)
    if secret and act.who.session_id:
        try:
            services.database.write(lambda db: sessions.end(db, secret))
        except DBAPIError:
            services.audit_reserve.end_session(act.who.session_id)
        services.ended_sessions.tell()
    sessions.clear_cookie(response, settings)


@router.get("/me")
def me(who: Viewer, database: DatabaseDep) -> Me:
    """The user behind this request."""
    return database.read(lambda db: _me(db, who))


@router.post("/password", status_code=204)
def change_password(
    act: Annotated[ActRecord, audited("password-set", Role.VIEWER)],
    body: PasswordChange,
    services: ServicesDep,
) -> None:
    """Set a new password for oneself; all tokens and all other sessions end."""
    who = act.who
    if who.session_id is None:
        raise Problem(403, "session-needed", "A token cannot change a password; log in.")
    accounts.check_password(body.new, who.username)
    services.login.change_own_password(who, body.current, body.new, act.begin)
    services.ended_sessions.tell()


@router.get("/tokens")
def list_tokens(who: Viewer, database: DatabaseDep) -> list[Token]:
    """One's own tokens, without their secrets."""
    return [Token.of(t) for t in database.read(lambda db: tokens.of_user(db, who.user_id))]


@router.post("/tokens", status_code=201)
def create_token(
    act: Annotated[ActRecord, audited("token-created", Role.VIEWER)],
    body: NewToken,
    database: DatabaseDep,
) -> IssuedToken:
    """Make a token for scripts. The secret is in this answer only."""
    who = act.who
    if not who.role.includes(body.role):
        raise Problem(403, "role-too-low", f"A token of '{who.username}' cannot have the role '{body.role}'.")
    if who.token_id is not None:
        raise Problem(403, "session-needed", "A token cannot make tokens; log in.")
    now = datetime.now(UTC)
    expires = now + timedelta(days=body.expires_in_days) if body.expires_in_days else None
    act.begin(Act("token-created", body.name, new_value=body.role.value))
    token, secret = database.write(
        lambda db: tokens.issue(db, who.user_id, body.name, body.role, expires, now)
    )
    return IssuedToken(**Token.of(token).model_dump(), secret=secret)


@router.delete("/tokens/{token_id}", status_code=204)
def revoke_token(
    act: Annotated[ActRecord, audited("token-revoked", Role.VIEWER)],
    token_id: str,
    services: ServicesDep,
) -> None:
    """End one of one's own tokens at once."""
    act.begin(Act("token-revoked", token_id))
    name = services.database.write(lambda db: tokens.revoke(db, act.who.user_id, token_id))
    act.resulted(subject=name)
    services.ended_sessions.tell()
