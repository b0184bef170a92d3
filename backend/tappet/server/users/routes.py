"""User accounts and the audit log."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated

from fastapi import APIRouter, Query
from sqlalchemy import Connection

from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.auth import accounts
from tappet.server.auth.accounts import Account
from tappet.server.dependencies import Admin, DatabaseDep, Engineer, ServicesDep
from tappet.server.problems import Problem
from tappet.server.users.shapes import AuditEntry, NewUser, User, UserChange

router = APIRouter(tags=["users"])


@router.get("/users")
def list_users(who: Admin, database: DatabaseDep) -> list[User]:
    """All accounts by name."""
    return [User.of(account) for account in database.read(accounts.all_accounts)]


@router.post("/users", status_code=201)
def create_user(body: NewUser, who: Admin, services: ServicesDep) -> User:
    """Make an account."""
    accounts.check_password(body.password, body.username)
    encoded = services.passwords.hash(body.password)

    def create(db: Connection) -> User:
        account = accounts.create(db, body.username, encoded, body.role, datetime.now(UTC))
        audit.record(db, who, Act("user-created", account.username, new_value=account.role.value))
        return User.of(account)

    return services.database.write(create)


@router.patch("/users/{user_id}")
def change_user(user_id: str, body: UserChange, who: Admin, services: ServicesDep) -> User:
    """Change role or password, or disable an account; its sessions end."""
    encoded = None
    if body.password is not None:
        account = services.database.read(lambda db: accounts.by_id(db, user_id))
        accounts.check_password(body.password, account.username)
        encoded = services.passwords.hash(body.password)

    def change(db: Connection) -> User:
        old = accounts.by_id(db, user_id)
        new = accounts.change(db, old, body.role, body.disabled)
        if encoded is not None:
            accounts.set_password(db, user_id, encoded, keep_session=who.session_id)
            audit.record(db, who, Act("password-set", old.username))
        if (old.role, old.disabled) != (new.role, new.disabled):
            audit.record(db, who, Act("user-changed", old.username, _summary(old), _summary(new)))
        return User.of(accounts.by_id(db, user_id))

    return services.database.write(change)


@router.delete("/users/{user_id}", status_code=204)
def delete_user(user_id: str, who: Admin, database: DatabaseDep) -> None:
    """Delete an account with its sessions, tokens and settings; the audit log keeps its name."""
    if user_id == who.user_id:
        raise Problem(
            409, "own-account", "Nobody deletes the account they are using; another administrator can."
        )

    def delete(db: Connection) -> None:
        account = accounts.by_id(db, user_id)
        accounts.remove(db, account)
        audit.record(db, who, Act("user-deleted", account.username, old_value=account.role.value))

    database.write(delete)


@router.get("/audit")
def read_audit(
    who: Engineer,
    database: DatabaseDep,
    limit: Annotated[int, Query(ge=1, le=1000)] = 100,
    before: Annotated[int | None, Query(description="Only entries older than the one with this id.")] = None,
    action: Annotated[str | None, Query(max_length=40)] = None,
) -> list[AuditEntry]:
    """What was done by whom, newest first."""
    rows = database.read(lambda db: audit.read(db, limit, before, action))
    return [AuditEntry.model_validate(row) for row in rows]


def _summary(account: Account) -> str:
    return account.role.value + (", disabled" if account.disabled else "")
