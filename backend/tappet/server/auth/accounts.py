"""User accounts: making, changing, checking passwords."""

from __future__ import annotations

import unicodedata
import uuid
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Connection, Row, delete, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from tappet.server.auth import passwords
from tappet.server.auth.confusables import look_alike
from tappet.server.auth.passwords import WeakPasswordError
from tappet.server.auth.roles import Role
from tappet.server.problems import Problem, not_found
from tappet.server.tables import api_tokens, sessions, users

LOCAL_USER = "local"
"""Account of one-time local links; it has no password until its user sets one."""


@dataclass(frozen=True, slots=True)
class Account:
    """A user account."""

    id: str
    username: str
    role: Role
    disabled: bool
    password_hash: str | None
    created_at: datetime
    last_login_at: datetime | None

    @property
    def has_password(self) -> bool:
        """False: only a local link logs in."""
        return self.password_hash is not None


def name_key(username: str) -> str:
    """Equal for names that look the same or differ in case only."""
    return unicodedata.normalize("NFKC", username).casefold()


def _account(row: Row[tuple[object, ...]]) -> Account:
    m = row._mapping
    return Account(
        m[users.c.id],
        m[users.c.username],
        Role(m[users.c.role]),
        m[users.c.disabled],
        m[users.c.password_hash],
        m[users.c.created_at],
        m[users.c.last_login_at],
    )


def count(db: Connection) -> int:
    """Number of accounts."""
    return db.scalar(select(func.count()).select_from(users)) or 0


def all_accounts(db: Connection) -> list[Account]:
    """All accounts by name."""
    return [_account(row) for row in db.execute(select(users).order_by(users.c.username_key))]


def by_id(db: Connection, user_id: str) -> Account:
    """The account; raises a 404 problem."""
    row = db.execute(select(users).where(users.c.id == user_id)).first()
    if row is None:
        raise not_found("user", user_id)
    return _account(row)


def by_name(db: Connection, username: str) -> Account | None:
    """The account of that name in any case."""
    row = db.execute(select(users).where(users.c.username_key == name_key(username))).first()
    return _account(row) if row is not None else None


def check_password(password: str, username: str) -> None:
    """Raises a 422 problem for a password that must not be set."""
    try:
        passwords.check(password, username)
    except WeakPasswordError as error:
        raise Problem(422, "weak-password", str(error)) from None


def create(db: Connection, username: str, password_hash: str | None, role: Role, now: datetime) -> Account:
    """A new account; raises a 409 problem when the name is taken, or looks like that of another account."""
    for other in db.scalars(select(users.c.username)):
        if look_alike(username, other):
            raise Problem(409, "name-taken", f"There already is a user '{other}', which looks the same.")
    user_id = uuid.uuid4().hex
    try:
        with db.begin_nested():
            db.execute(
                insert(users).values(
                    id=user_id,
                    username=username,
                    username_key=name_key(username),
                    password_hash=password_hash,
                    role=role.value,
                    disabled=False,
                    created_at=now,
                )
            )
    except IntegrityError:
        raise Problem(409, "name-taken", f"There already is a user '{username}'.") from None
    return by_id(db, user_id)


def set_password(
    db: Connection,
    user_id: str,
    password_hash: str,
    *,
    keep_session: str | None = None,
    end_sessions: bool = True,
) -> None:
    """Stores a hash; tokens and other sessions of the user end."""
    db.execute(update(users).where(users.c.id == user_id).values(password_hash=password_hash))
    if end_sessions:
        sign_out(db, user_id, keep_session=keep_session)


def sign_out(db: Connection, user_id: str, *, keep_session: str | None = None) -> None:
    """Ends the tokens and the sessions of a user, but for one session."""
    others = sessions.c.user_id == user_id
    if keep_session is not None:
        others &= sessions.c.id != keep_session
    db.execute(delete(sessions).where(others))
    db.execute(delete(api_tokens).where(api_tokens.c.user_id == user_id))


def change(db: Connection, account: Account, role: Role | None, disabled: bool | None) -> Account:
    """Changes role and whether the account may be used; never leaves the server without an administrator."""
    new_role = role or account.role
    new_disabled = account.disabled if disabled is None else disabled
    if new_role is not Role.ADMIN or new_disabled:
        _keep_an_admin(db, account)
    db.execute(
        update(users).where(users.c.id == account.id).values(role=new_role.value, disabled=new_disabled)
    )
    if new_disabled:
        sign_out(db, account.id)
    elif new_role is not account.role:
        db.execute(delete(sessions).where(sessions.c.user_id == account.id))
    return by_id(db, account.id)


def remove(db: Connection, account: Account) -> None:
    """Deletes the account with its sessions, tokens and settings."""
    _keep_an_admin(db, account)
    sign_out(db, account.id)
    db.execute(delete(users).where(users.c.id == account.id))


def _keep_an_admin(db: Connection, account: Account) -> None:
    others = select(func.count()).where(
        users.c.role == Role.ADMIN.value, users.c.disabled.is_(False), users.c.id != account.id
    )
    if account.role is Role.ADMIN and not account.disabled and not db.scalar(others):
        raise Problem(
            409, "last-admin", f"'{account.username}' is the last administrator; make another one first."
        )
