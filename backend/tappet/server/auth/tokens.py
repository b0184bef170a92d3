"""Bearer tokens for scripts: made by a user, never more powerful than that user."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import Connection, delete, insert, select, update

from tappet.server.auth.roles import Role
from tappet.server.auth.secret_keys import digest, new_secret
from tappet.server.problems import not_found
from tappet.server.tables import api_tokens, users

PREFIX = "tappet_"
"""Lets secret scanners recognise a token that was committed by mistake."""
USED_STEP = timedelta(minutes=1)


@dataclass(frozen=True, slots=True)
class ApiToken:
    """A token without its secret."""

    id: str
    user_id: str
    name: str
    role: Role
    created_at: datetime
    used_at: datetime | None
    expires_at: datetime | None


@dataclass(frozen=True, slots=True)
class TokenUse:
    """The identity that a presented token proves."""

    id: str
    user_id: str
    username: str
    role: Role
    touch_due: bool
    """Whether the last use has to be written down again."""


def issue(
    db: Connection, user_id: str, name: str, role: Role, expires_at: datetime | None, now: datetime
) -> tuple[ApiToken, str]:
    """A new token and its secret, which is kept nowhere."""
    secret = PREFIX + new_secret()
    token = ApiToken(uuid.uuid4().hex, user_id, name, role, now, None, expires_at)
    db.execute(
        insert(api_tokens).values(
            id=token.id,
            secret_digest=digest(secret),
            user_id=user_id,
            name=name,
            role=role.value,
            created_at=now,
            expires_at=expires_at,
        )
    )
    return token, secret


def of_user(db: Connection, user_id: str) -> list[ApiToken]:
    """The tokens of a user, oldest first."""
    c = api_tokens.c
    query = select(c.id, c.user_id, c.name, c.role, c.created_at, c.used_at, c.expires_at)
    rows = db.execute(query.where(c.user_id == user_id).order_by(c.created_at))
    return [ApiToken(r[0], r[1], r[2], Role(r[3]), r[4], r[5], r[6]) for r in rows]


def revoke(db: Connection, user_id: str, token_id: str) -> str:
    """Ends a token of the user and returns its name; raises a 404 problem."""
    mine = (api_tokens.c.id == token_id) & (api_tokens.c.user_id == user_id)
    name: str | None = db.scalar(select(api_tokens.c.name).where(mine))
    if name is None:
        raise not_found("token", token_id)
    db.execute(delete(api_tokens).where(mine))
    return name


def find(db: Connection, secret: str, now: datetime) -> TokenUse | None:
    """Who presents `secret`; None when unknown, expired or the user is disabled. Only reads."""
    c = api_tokens.c
    row = db.execute(
        select(c.id, c.role, c.used_at, c.expires_at, users.c.id, users.c.username, users.c.role)
        .join(users, users.c.id == c.user_id)
        .where(c.secret_digest == digest(secret), users.c.disabled.is_(False))
    ).first()
    if row is None:
        return None
    token_id, role, used_at, expires_at, user_id, username, user_role = row
    if expires_at is not None and expires_at < now:
        return None
    touch_due = used_at is None or now - used_at > USED_STEP
    return TokenUse(token_id, user_id, username, Role(role).at_most(Role(user_role)), touch_due)


def touch(db: Connection, token_id: str, now: datetime) -> None:
    """Writes down that the token was used."""
    db.execute(update(api_tokens).where(api_tokens.c.id == token_id).values(used_at=now))
