"""The ways in: password, first account, one-time link."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from sqlalchemy import Connection

from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.auth import accounts, lockout, sessions
from tappet.server.auth.accounts import Account
from tappet.server.auth.identity import Identity
from tappet.server.auth.one_time import OneTimeSecrets
from tappet.server.auth.passwords import Passwords
from tappet.server.auth.roles import Role
from tappet.server.database import Database
from tappet.server.problems import Problem

FIRST_ACCOUNT = "first-account"
LOCAL_LINK = "local-link"


@dataclass(frozen=True, slots=True)
class Client:
    """Where a login comes from."""

    address: str
    browser: str
    old_secret: str | None = None
    """Session the browser had before; it ends, so that a planted cookie is never logged in."""


@dataclass(frozen=True, slots=True)
class LoggedIn:
    """A fresh session."""

    account: Account
    secret: str


class Login:
    """Checks who asks and starts sessions; every attempt is in the audit log."""

    def __init__(self, database: Database, passwords: Passwords, secrets: OneTimeSecrets) -> None:
        self._database = database
        self._passwords = passwords
        self._secrets = secrets

    def by_password(self, username: str, password: str, client: Client) -> LoggedIn:
        """Blocks for one hash. Raises 401 and 429 problems; neither shows whether the account exists."""
        keys = self._attempt(username, client)
        account = self._database.read(lambda db: accounts.by_name(db, username))
        matches = self._passwords.verify(account.password_hash if account else None, password)
        if account is None or account.disabled or not matches:
            problem = Problem(401, "login-failed", "User name or password is wrong.")
            raise self._refused("login-failed", username, client, problem)
        renewed = self._passwords.hash(password) if self._passwords.outdated(account.password_hash) else None

        def start(db: Connection) -> LoggedIn:
            lockout.succeeded(db, keys)
            if renewed is not None:
                accounts.set_password(db, account.id, renewed, end_sessions=False)
            return self._start(db, account, client, "password")

        return self._database.write(start)

    def create_first(self, token: str, username: str, password: str, client: Client) -> LoggedIn:
        """The first administrator. Raises 403 for a wrong or used token, 422 for an unfit password."""
        if not self._secrets.matches(FIRST_ACCOUNT, token):
            detail = "This is not the open token for the first account; the console shows it."
            problem = Problem(403, "wrong-token", detail)
            raise self._refused("first-account-refused", username, client, problem)
        accounts.check_password(password, username)
        encoded = self._passwords.hash(password)
        if not self._secrets.redeem(FIRST_ACCOUNT, token):
            raise Problem(403, "wrong-token", "The token for the first account has been used.")

        def create(db: Connection) -> LoggedIn:
            if accounts.count(db):
                raise Problem(409, "accounts-exist", "There already is an account; ask its administrator.")
            account = accounts.create(db, username, encoded, Role.ADMIN, datetime.now(UTC))
            audit.write(db, username, client.address, Act("user-created", username, new_value="admin"))
            return self._start(db, account, client, "first account")

        return self._database.write(create)

    def by_link(self, token: str, client: Client) -> LoggedIn:
        """A login as the local user by a one-time link. Raises a 403 problem."""
        if not self._secrets.redeem(LOCAL_LINK, token):
            detail = "This login link has been used or is too old. Press Enter on the server's console."
            problem = Problem(403, "link-expired", detail)
            raise self._refused("link-refused", accounts.LOCAL_USER, client, problem)

        def start(db: Connection) -> LoggedIn:
            account = accounts.by_name(db, accounts.LOCAL_USER)
            if account is None or account.disabled:
                raise Problem(403, "link-refused", "The local account has been disabled.")
            return self._start(db, account, client, "local link")

        return self._database.write(start)

    def change_own_password(
        self, who: Identity, current: str, new: str, begin: Callable[[Act], None]
    ) -> None:
        """Sets a password after checking the current one, where there is one. Raises a 403 problem.

        `begin` records the act, right before it is done.
        """
        keys = self._attempt(who.username, Client(who.address, ""))
        account = self._database.read(lambda db: accounts.by_id(db, who.user_id))
        if account.has_password and not self._passwords.verify(account.password_hash, current):
            raise Problem(403, "wrong-password", "The current password is wrong.")
        encoded = self._passwords.hash(new)
        begin(Act("password-set", who.username))

        def change(db: Connection) -> None:
            lockout.succeeded(db, keys)
            accounts.set_password(db, who.user_id, encoded, keep_session=who.session_id)

        self._database.write(change)

    def ensure_local_user(self) -> None:
        """Makes the account of local links; whoever starts the server owns its data directory anyway."""

        def ensure(db: Connection) -> None:
            if accounts.by_name(db, accounts.LOCAL_USER) is None:
                accounts.create(db, accounts.LOCAL_USER, None, Role.ADMIN, datetime.now(UTC))
                audit.write(db, accounts.LOCAL_USER, "console", Act("user-created", accounts.LOCAL_USER))

        self._database.write(ensure)

    def _attempt(self, username: str, client: Client) -> list[str]:
        """Counts an attempt; returns what it is counted under. Raises a 429 problem, audited."""
        now = datetime.now(UTC)

        def count(db: Connection) -> tuple[list[str], timedelta]:
            known = sessions.addresses(db, accounts.name_key(username))
            here = lockout.network(client.address)
            is_known = here in map(lockout.network, known)
            keys = lockout.Attempt(username, client.address, is_known).keys()
            return keys, lockout.attempt(db, keys, now)

        keys, pause = self._database.write(count)
        if pause:
            seconds = max(1, round(pause.total_seconds()))
            problem = Problem(
                429,
                "locked-out",
                f"Too many failed attempts; try again in {seconds} s.",
                headers={"Retry-After": str(seconds)},
                retry_after=seconds,
            )
            raise self._refused("login-locked-out", username, client, problem)
        return keys

    def _refused(self, action: str, username: str, client: Client, problem: Problem) -> Problem:
        """The problem, with a row in the audit log that counts equal ones."""
        act = Act(action, username)
        self._database.write(lambda db: audit.refuse(db, username, client.address, act, problem.detail))
        return problem

    def _start(self, db: Connection, account: Account, client: Client, way: str) -> LoggedIn:
        if client.old_secret:
            sessions.end(db, client.old_secret)
        secret = sessions.start(db, account.id, client.address, client.browser, datetime.now(UTC))
        audit.write(db, account.username, client.address, Act("login", account.username, new_value=way))
        return LoggedIn(account, secret)
