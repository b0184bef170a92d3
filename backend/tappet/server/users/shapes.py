"""Accounts as administrators see them, and the audit log."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from tappet.server.audit import Result
from tappet.server.auth.roles import Role
from tappet.server.auth.shapes import Password, Username
from tappet.server.shapes import Reply, Request


class User(Reply):
    """An account, as administrators see it."""

    id: str
    username: str
    role: Role
    disabled: bool
    has_password: bool
    created_at: datetime
    last_login_at: datetime | None


class NewUser(Request):
    """An account to be made."""

    username: Username
    password: Password
    role: Role


class UserChange(Request):
    """What to change of an account; fields left out stay."""

    role: Role | None = None
    disabled: bool | None = None
    password: Password | None = None


class AuditEntry(Reply):
    """Who did what, when and from where."""

    id: int
    at: datetime
    username: str
    address: str
    action: str
    subject: str
    project_id: str | None
    runtime_id: str | None
    old_value: str | None
    new_value: str | None
    result: Result = Field(description="`begun`: the server ended before the result was known.")
    reason: str | None = Field(description="Why it was refused or has failed.")
    count: int = Field(description="How often the same was refused, until `last_at`.")
    last_at: datetime | None
