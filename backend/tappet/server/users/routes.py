"""User accounts and the audit log."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from typing import Annotated

from fastapi import Query
from sqlalchemy import Connection

from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth import accounts
from tappet.server.auth.accounts import Account
from tappet.server.auth.roles import Role
from tappet.server.dependencies import Admin, DatabaseDep, Engineer, ServicesDep
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.shapes import Number
from tappet.server.users.shapes import AuditEntry, NewUser, User, UserChange

router = Router(tags=["users"])


@router.get("/users")
def list_users(who: Admin, database: DatabaseDep) -> list[User]:
    """All accounts by name."""
    return [User.of(account) for account in database.read(accounts.all_accounts)]


@router.post("/users", status_code=201)
def create_user(
    act: Annotated[ActRecord, audited("user-created", Role.ADMIN)],
    body: NewUser,
    services: ServicesDep,
) -> User:
    """Make an account."""
    accounts.check_password(body.password, body.username)
    encoded = services.passwords.hash(body.password)

    act.begin(Act("user-created", body.username, new_value=body.role.value))
    now = datetime.now(UTC)
    return User.of(
        services.database.write(lambda db: accounts.create(db, body.username, encoded, body.role, now))
    )


@router.patch("/users/{user_id}")
def change_user(
    act: Annotated[ActRecord, audited("user-changed", Role.ADMIN)],
    user_id: str,
    body: UserChange,
    services: ServicesDep,
) -> User:
    """Change role or password, or disable an account; its sessions end."""
    encoded = None
    account = services.database.read(lambda db: accounts.by_id(db, user_id))
    if body.password is not None:
        accounts.check_password(body.password, account.username)
        encoded = services.passwords.hash(body.password)

    def change(db: Connection) -> User:
        old = accounts.by_id(db, user_id)
        new = accounts.change(db, old, body.role, body.disabled)
        if encoded is not None:
            accounts.set_password(db, user_id, encoded, keep_session=act.who.session_id)
        return User.of(new)

    wanted = replace(
        account,
        role=body.role or account.role,
        disabled=account.disabled if body.disabled is None else body.disabled,
    )
    acts = [Act("password-set", account.username)] if encoded is not None else []
    if wanted != account or not acts:
        acts.append(Act("user-changed", account.username, _summary(account), _summary(wanted)))
    act.begin(*acts)
    changed = services.database.write(change)
    services.ended_sessions.tell()
    return changed


@router.post("/users/{user_id}/sign-out", status_code=204)
def sign_out_user(
    act: Annotated[ActRecord, audited("user-signed-out", Role.ADMIN)], user_id: str, services: ServicesDep
) -> None:
    """End all sessions and tokens of a user, their open sockets too; of oneself, all but this session."""
    account = services.database.read(lambda db: accounts.by_id(db, user_id))
    act.begin(Act("user-signed-out", account.username))
    keep = act.who.session_id
    services.database.write(lambda db: accounts.sign_out(db, user_id, keep_session=keep))
    services.ended_sessions.tell()


@router.delete("/users/{user_id}", status_code=204)
def delete_user(
    act: Annotated[ActRecord, audited("user-deleted", Role.ADMIN)],
    user_id: str,
    services: ServicesDep,
) -> None:
    """Delete an account with its sessions, tokens and settings; the audit log keeps its name."""
    if user_id == act.who.user_id:
        raise Problem(
            409, "own-account", "Nobody deletes the account they are using; another administrator can."
        )
    account = services.database.read(lambda db: accounts.by_id(db, user_id))
    act.begin(Act("user-deleted", account.username, old_value=account.role.value))
    services.database.write(lambda db: accounts.remove(db, accounts.by_id(db, user_id)))
    services.ended_sessions.tell()


@router.get("/audit")
def read_audit(
    who: Engineer,
    services: ServicesDep,
    limit: Annotated[int, Query(ge=1, le=1000)] = 100,
    before: Annotated[
        Number | None, Query(description="Only entries older than the one with this id.")
    ] = None,
    action: Annotated[str | None, Query(max_length=40)] = None,
) -> list[AuditEntry]:
    """What was done by whom, newest first."""
    services.audit_reserve.try_move(services.database)
    rows = services.database.read(lambda db: audit.read(db, limit, before, action))
    return [AuditEntry.model_validate(row) for row in rows]


def _summary(account: Account) -> str:
    return account.role.value + (", disabled" if account.disabled else "")
