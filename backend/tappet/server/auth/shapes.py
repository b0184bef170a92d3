"""Login, one's own account and tokens for scripts."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import Field, StringConstraints

from tappet.server.auth.roles import Role
from tappet.server.shapes import Line, Reply, Request

Username = Annotated[str, StringConstraints(min_length=1, max_length=64, pattern=r"^[\w.@+-]+$")]
"""Letters of any script, digits and `_ . @ + -`; two names that differ only in case are the same."""
Password = Annotated[str, StringConstraints(max_length=1024)]
Secret = Annotated[str, StringConstraints(max_length=200)]


class Credentials(Request):
    """User name and password."""

    username: Annotated[Line, StringConstraints(max_length=64)]
    password: Password


class FirstAccount(Request):
    """The first administrator, allowed by the one-time token on the server's console."""

    token: Secret
    username: Username
    password: Password


class PasswordChange(Request):
    """A new password for oneself. `current` may be empty where none was set yet."""

    current: Password
    new: Password


class Me(Reply):
    """The user behind a request."""

    id: str
    username: str
    role: Role = Field(description="What this session or token may do.")
    language: str | None = Field(description="`en` or `zh`; null: as the browser prefers.")
    theme: str | None = Field(description="`light` or `dark`; null: as the system prefers.")
    has_password: bool = Field(description="False for the account of a local link until it sets one.")


class AuthStatus(Reply):
    """What a browser needs to choose between first account, login and workbench."""

    first_account_needed: bool
    authenticated: bool
    user: Me | None


class Token(Reply):
    """A token for scripts; its secret is shown only when it is made."""

    id: str
    name: str
    role: Role
    created_at: datetime
    used_at: datetime | None
    expires_at: datetime | None


class NewToken(Request):
    """A token to be made; it never may do more than its owner."""

    name: Annotated[Line, StringConstraints(min_length=1, max_length=100)]
    role: Role
    expires_in_days: Annotated[int, Field(ge=1, le=3650)] | None = None


class IssuedToken(Token):
    """A new token with its secret, shown this once."""

    secret: str
