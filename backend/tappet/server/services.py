"""What one server process holds: opened at start-up, closed at the end, reached through dependencies."""

from __future__ import annotations

from dataclasses import dataclass, field

from sqlalchemy import Engine

from tappet.server.auth import accounts
from tappet.server.auth.login import FIRST_ACCOUNT, Login
from tappet.server.auth.one_time import OneTimeSecrets
from tappet.server.auth.passwords import Passwords
from tappet.server.database import Database
from tappet.server.settings import ServerSettings


@dataclass(slots=True)
class Services:
    """Everything that lives as long as the server."""

    settings: ServerSettings
    database: Database
    passwords: Passwords
    one_time: OneTimeSecrets
    login: Login
    first_account_token: str | None = field(default=None, repr=False)
    """Shown on the console at start-up while there is no account."""


def open_services(settings: ServerSettings, engine: Engine) -> Services:
    """Puts the parts together; blocks for the database."""
    database = Database(engine)
    passwords = Passwords(settings.password_cost)
    one_time = OneTimeSecrets()
    services = Services(settings, database, passwords, one_time, Login(database, passwords, one_time))
    if database.run(accounts.count) == 0:
        services.first_account_token = one_time.issue(FIRST_ACCOUNT)
    return services
