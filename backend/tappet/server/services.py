"""What one server process holds: opened at start-up, closed at the end, reached through dependencies."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.project.store.engine import migrate, open_engine
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

    async def close(self) -> None:
        """Ends everything."""
        self.database.engine.dispose()


def open_services(settings: ServerSettings) -> Services:
    """Opens the database, brings its schema up to date and puts the parts together. Blocks."""
    if settings.database_url is None:
        settings.data_dir.mkdir(parents=True, exist_ok=True)
    engine = open_engine(settings.url)
    migrate(engine)
    database = Database(engine)
    passwords = Passwords(settings.password_cost)
    one_time = OneTimeSecrets()
    services = Services(settings, database, passwords, one_time, Login(database, passwords, one_time))
    if database.read(accounts.count) == 0:
        services.first_account_token = one_time.issue(FIRST_ACCOUNT)
    return services
