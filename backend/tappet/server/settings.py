"""What an installation may configure."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from datetime import timedelta
from pathlib import Path

from tappet.server.auth.passwords import HashCost
from tappet.server.connection_limits import ConnectionLimits

LOCAL_RUNTIME = "local"
"""Id of the runtime that the server starts itself."""


@dataclass(frozen=True, slots=True)
class ServerSettings:
    """Settings of one server process; the defaults are those of a single engineer's machine."""

    data_dir: Path = Path("data")
    """Database, boot application of the local runtime, packages of downloaded applications."""
    database_url: str | None = None
    """SQLAlchemy URL; None: SQLite in `data_dir`."""
    host: str = "127.0.0.1"
    port: int = 8080
    https: bool = False
    """Browsers reach the server by https (here or at a proxy): cookies are then marked Secure."""
    allowed_hosts: tuple[str, ...] = ()
    """Further names a request may carry in its Host header; on loopback the loopback names always pass."""
    public_origins: tuple[str, ...] = ()
    """Origins besides the server's own whose pages may use the session cookie, e.g. `https://ide.plant`."""
    static_dir: Path | None = None
    """Built front end; None: found in the package or the checkout."""
    session_idle: timedelta = timedelta(hours=12)
    """A session ends when nothing was asked for this long: a shift."""
    session_lifetime: timedelta = timedelta(days=7)
    """A session ends this long after login whatever happens."""
    connections: ConnectionLimits = field(default_factory=ConnectionLimits)
    """How many connections are taken, in all and from one address."""
    max_body_bytes: int = 8 * 1024 * 1024
    """Largest JSON request; imports state their own limit."""
    password_cost: HashCost = field(default_factory=HashCost)
    local_runtime: bool = False
    """Start a runtime on this machine, with its data in `data_dir`."""
    local_runtime_options: tuple[str, ...] = ()
    """Further arguments of `tappet runtime`."""
    build_workers: int = 1
    """Compiler processes; each keeps the caches of the projects it serves."""
    analysis_memory_mib: int = 4096
    """Address space of the process that analyses a project; it starts again when it needs more."""
    analysis_seconds: float = 120.0
    """Longest time of one request to it, or of one step of a check; it starts again when that is exceeded."""
    analysis_idle_seconds: float = 300.0
    """It ends so long after the last editor of the project was closed."""
    recordings_gib: int = 20
    """Room that stored recordings of traces may take, in `data_dir`."""
    recordings_keep: timedelta | None = None
    """Older recordings are deleted, and older samples of those that go on; None: kept until somebody deletes
    them, as measurements may be evidence."""
    reconnect_seconds: float = 1.0
    """First pause before a lost runtime is tried again; doubles up to 15 s. So does that before a local one
    which did not start is started again, up to 30 s."""

    @property
    def url(self) -> str:
        """SQLAlchemy URL of the database."""
        return self.database_url or f"sqlite:///{(self.data_dir / 'tappet.sqlite').resolve()}"

    @property
    def loopback_only(self) -> bool:
        """Whether the server is bound to an address that only this machine reaches."""
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False

    @property
    def host_names(self) -> frozenset[str] | None:
        """Names accepted in a Host header; None: any (bound to the network and none configured)."""
        names = {name.lower() for name in self.allowed_hosts}
        if self.loopback_only:
            return frozenset(names | {"localhost", "127.0.0.1", "[::1]"})
        return frozenset(names | {"localhost", "127.0.0.1", "[::1]", self.host.lower()}) if names else None
