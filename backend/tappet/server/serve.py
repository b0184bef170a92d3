"""`tappet serve`: the IDE server as a process, with a local runtime and, if wanted, an example that runs."""

from __future__ import annotations

import asyncio
import fcntl
import logging
import os
import signal
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from datetime import timedelta
from pathlib import Path

import uvicorn

from tappet.libraries.repository import LOCATION_VARIABLE
from tappet.log_rate import RateLimit
from tappet.project.errors import ProjectError
from tappet.project.store import Store
from tappet.server.app import create_app
from tappet.server.auth.login import LOCAL_LINK
from tappet.server.connection_limits import raise_descriptor_limit
from tappet.server.connections import limited_protocol
from tappet.server.example import load_example, run_example
from tappet.server.projects.examples import find_example
from tappet.server.services import Services
from tappet.server.settings import ServerSettings

LINK_LIFE = timedelta(minutes=15)
"""How long a login link works: time to fetch a coffee while the first start compiles."""
LARGEST_SOCKET_MESSAGE = 4 * 1024 * 1024
GRACE_S = 5
"""How long a stopping server waits for its answers to be fetched."""
log = logging.getLogger(__name__)


class ServeError(RuntimeError):
    """The server cannot start; the message says why and what to do."""


@dataclass(frozen=True, slots=True)
class ServeOptions:
    """What the command line says beyond `ServerSettings`."""

    settings: ServerSettings
    example: str | None = None
    """Name of an example project to load, and to run on an empty local runtime."""
    local_link: bool = False
    """Print a one-time link that logs in on this machine."""


def serve(options: ServeOptions) -> int:
    """Serves until SIGINT or SIGTERM; 0 after a proper end, 1 when the server could not start."""
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(name)s: %(message)s", stream=sys.stderr)
    for handler in logging.getLogger().handlers:
        handler.addFilter(RateLimit())
    for noisy in ("httpx", "httpcore", "websockets", "alembic", "uvicorn"):
        logging.getLogger(noisy).setLevel(logging.WARNING)
    try:
        if options.example is not None:
            find_example(options.example)
        os.environ.setdefault(LOCATION_VARIABLE, str(options.settings.data_dir.resolve() / "libraries"))
        with _owned(options.settings.data_dir), _listening(options.settings) as listener:
            Store(options.settings.url).close()  # an unusable database is one sentence, not a trace
            return asyncio.run(_serve(options, listener))
    except (ServeError, ProjectError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


class _Server(uvicorn.Server):
    """uvicorn that says when it is up and leaves signals to us: its own handling ends the process by the
    signal it got, before the data folder is released."""

    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self.up = asyncio.Event()

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        try:
            await super().startup(sockets)
        except SystemExit:  # would end the event loop before anybody could say what to do
            self.should_exit = True
        self.up.set()

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        yield


async def _serve(options: ServeOptions, listener: socket.socket) -> int:
    settings = options.settings
    app = create_app(settings)
    limits = settings.connections.within(raise_descriptor_limit())
    if settings.https:  # all connections are those of the proxy
        limits = replace(limits, of_address=limits.total)
    server = _Server(
        uvicorn.Config(
            app,
            http=limited_protocol(limits),
            log_config=None,
            access_log=False,
            server_header=False,
            ws_max_size=LARGEST_SOCKET_MESSAGE,
            ws_per_message_deflate=False,  # frames of live values: not worth the time
            proxy_headers=settings.https,  # only then is there a proxy whose word counts
            timeout_graceful_shutdown=GRACE_S,
        )
    )
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, server.handle_exit, number, None)
    running = asyncio.create_task(server.serve(sockets=[listener]))
    up = asyncio.create_task(server.up.wait())
    await asyncio.wait({running, up}, return_when=asyncio.FIRST_COMPLETED)
    up.cancel()
    if not server.started:
        await running
        raise ServeError("the server did not start; the messages above say why")
    services: Services = app.state.services
    example = None if options.example is None else await _loaded(services, options.example)
    console = Console(services, _address(settings, listener))
    console.greet(local_link=options.local_link)
    if options.local_link:
        console.offer_links()
    await asyncio.gather(services.commissioning.builder.warm(), services.analysis.warm())
    machine = None if example is None else asyncio.create_task(_run(services, example))
    try:
        await running
    finally:
        if machine is not None:
            machine.cancel()
    return 0


async def _loaded(services: Services, name: str) -> str | None:
    """Project of the example, before anybody can open the start page; a broken example stops no server."""
    try:
        return await load_example(services, name)
    except Exception:
        log.exception("the example '%s' could not be loaded", name)
        return None


async def _run(services: Services, project_id: str) -> None:
    try:
        await run_example(services, project_id)
    except Exception:
        log.exception("the example could not be started")


class Console:
    """What the server says to whoever started it."""

    def __init__(self, services: Services, address: str) -> None:
        self._services = services
        self._address = address

    def greet(self, *, local_link: bool) -> None:
        """Address and the way in."""
        print(f"Tappet serves {self._address}", flush=True)
        if local_link:
            self._services.login.ensure_local_user()
            self._services.one_time.cancel("first-account")
            self._services.first_account_token = None
            self.print_link()
        elif self._services.first_account_token is not None:
            print(
                f"There is no account yet. Open {self._address} and create the first one with this token, "
                f"which works once:\n\n    {self._services.first_account_token}\n",
                flush=True,
            )

    def print_link(self) -> None:
        """A fresh one-time link; an older one ends."""
        token = self._services.one_time.issue(LOCAL_LINK, LINK_LIFE)
        minutes = int(LINK_LIFE.total_seconds() // 60)
        print(
            f"Open this link to log in; it works once, on this machine, within {minutes} minutes:\n\n"
            f"    {self._address}/api/v1/auth/link?token={token}\n",
            flush=True,
        )

    def offer_links(self) -> None:
        """SIGUSR1, or Enter on a terminal, prints another link."""
        loop = asyncio.get_running_loop()
        loop.add_signal_handler(signal.SIGUSR1, self.print_link)
        if sys.stdin is not None and sys.stdin.isatty():
            print("Press Enter for another link, Ctrl+C to stop.", flush=True)
            loop.add_reader(sys.stdin.fileno(), self._on_enter)

    def _on_enter(self) -> None:
        if sys.stdin.readline():
            self.print_link()
        else:
            asyncio.get_running_loop().remove_reader(sys.stdin.fileno())


@contextmanager
def _owned(data_dir: Path) -> Iterator[None]:
    """Only one server at a time works on a data folder."""
    try:
        data_dir.mkdir(parents=True, exist_ok=True, mode=0o700)
        lock = os.open(data_dir / "server.lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    except OSError as error:
        raise ServeError(f"the data folder {data_dir} cannot be used: {error.strerror}") from error
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise ServeError(
                f"another server works on {data_dir}; stop it, or choose another folder with --data"
            ) from None
        yield
    finally:
        os.close(lock)


@contextmanager
def _listening(settings: ServerSettings) -> Iterator[socket.socket]:
    """The socket the server listens on, so that a taken port is found before anything is started."""
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    # Asyncio sends small pieces at once on sockets that say they are TCP only; others wait 40 ms for the
    # acknowledgement of the head of an answer before they send its body.
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((settings.host, settings.port))
    except OSError as error:
        listener.close()
        raise ServeError(
            f"{settings.host} port {settings.port} cannot be used: {error.strerror}; "
            "choose another one with --port"
        ) from error
    try:
        yield listener
    finally:
        with suppress(OSError):
            listener.close()


def _address(settings: ServerSettings, listener: socket.socket) -> str:
    """What to type into a browser on this machine."""
    port = listener.getsockname()[1]
    host = "127.0.0.1" if settings.host in ("0.0.0.0", "::", "localhost") else settings.host  # noqa: S104
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
