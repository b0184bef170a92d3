"""Browser sessions: a random secret in a cookie, its digest in the database."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import Connection, delete, insert, select, update
from starlette.responses import Response

from tappet.server.auth.roles import Role
from tappet.server.auth.secret_keys import digest, new_secret
from tappet.server.settings import ServerSettings
from tappet.server.tables import sessions, users

COOKIE = "tappet_session"
SEEN_STEP = timedelta(minutes=1)
"""How exactly the last use of a session is written down."""


@dataclass(frozen=True, slots=True)
class Session:
    """A live session with its user."""

    id: str
    user_id: str
    username: str
    role: Role
    touch_due: bool
    """Whether the last use has to be written down again."""


def start(db: Connection, user_id: str, address: str, browser: str, now: datetime) -> str:
    """A new session; returns the secret for the cookie."""
    secret = new_secret()
    db.execute(
        insert(sessions).values(
            id=uuid.uuid4().hex,
            secret_digest=digest(secret),
            user_id=user_id,
            created_at=now,
            seen_at=now,
            address=address[:64],
            browser=browser[:256],
        )
    )
    db.execute(update(users).where(users.c.id == user_id).values(last_login_at=now))
    return secret


def find(db: Connection, secret: str, settings: ServerSettings, now: datetime) -> Session | None:
    """The live session of a cookie; None when unknown, ended or its user is disabled. Only reads."""
    query = (
        select(
            sessions.c.id,
            sessions.c.created_at,
            sessions.c.seen_at,
            users.c.id,
            users.c.username,
            users.c.role,
        )
        .join(users, users.c.id == sessions.c.user_id)
        .where(sessions.c.secret_digest == digest(secret), users.c.disabled.is_(False))
    )
    row = db.execute(query).first()
    if row is None:
        return None
    session_id, created, seen, user_id, username, role = row
    if now - seen > settings.session_idle or now - created > settings.session_lifetime:
        return None
    return Session(session_id, user_id, username, Role(role), now - seen > SEEN_STEP)


def addresses(db: Connection, username_key: str) -> list[str]:
    """Where the user has sessions from."""
    query = select(sessions.c.address).join(users, users.c.id == sessions.c.user_id)
    return list(db.scalars(query.where(users.c.username_key == username_key).distinct()))


def touch(db: Connection, session_id: str, now: datetime) -> None:
    """Writes down that the session was used."""
    db.execute(update(sessions).where(sessions.c.id == session_id).values(seen_at=now))


def end(db: Connection, secret: str) -> None:
    """Ends the session of a cookie."""
    db.execute(delete(sessions).where(sessions.c.secret_digest == digest(secret)))


def end_by_id(db: Connection, session_id: str) -> None:
    """Ends a session whose cookie is not known any more."""
    db.execute(delete(sessions).where(sessions.c.id == session_id))


def remove_expired(db: Connection, settings: ServerSettings, now: datetime) -> None:
    """Deletes sessions that can no longer be used."""
    db.execute(
        delete(sessions).where(
            (sessions.c.seen_at < now - settings.session_idle)
            | (sessions.c.created_at < now - settings.session_lifetime)
        )
    )


def set_cookie(response: Response, secret: str, settings: ServerSettings) -> None:
    """Gives the browser its session."""
    response.set_cookie(
        COOKIE,
        secret,
        max_age=int(settings.session_lifetime.total_seconds()),
        path="/",
        httponly=True,
        samesite="strict",
        secure=settings.https,
    )


def clear_cookie(response: Response, settings: ServerSettings) -> None:
    """Takes it away."""
    response.delete_cookie(COOKIE, path="/", httponly=True, samesite="strict", secure=settings.https)
