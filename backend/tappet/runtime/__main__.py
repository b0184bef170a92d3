"""`python -m tappet.runtime`: a soft PLC as a process of its own."""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import secrets
import signal
import sys
from contextlib import suppress
from functools import partial
from pathlib import Path

from tappet.iec.system_events import EXTERNAL_EVENTS
from tappet.runtime.contexts import STUCK_LIMIT_S
from tappet.runtime.flight import FlightSettings
from tappet.runtime.logbook import Logbook, LogEntry
from tappet.runtime.owned_folder import owned
from tappet.runtime.plc import SoftPlc
from tappet.runtime.posix import lock_memory
from tappet.runtime.service import RuntimeService
from tappet.runtime.threads import NORMAL, Scheduling, real_time_scheduling
from tappet.whole_file import PRIVATE, remove_unfinished, replace_file

DEFAULT_PORT = 11740


def parser() -> argparse.ArgumentParser:
    """Command line of the runtime process."""
    p = argparse.ArgumentParser(
        "tappet runtime", description="A soft PLC: loads, runs and serves an application."
    )
    p.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine only)")
    p.add_argument(
        "--port", type=int, default=DEFAULT_PORT, help="port, 0 for a free one (default: %(default)s)"
    )
    p.add_argument(
        "--data", type=Path, default=Path("runtime-data"), help="folder of boot application and retain"
    )
    p.add_argument(
        "--token-file", type=Path, help="file with the access token (default: DATA/token, made if missing)"
    )
    p.add_argument(
        "--no-realtime", action="store_true", help="normal priority even where real time is permitted"
    )
    p.add_argument("--all-cpus", action="store_true", help="let tasks run on all processors, not on one")
    text = "longest cycle, in seconds, of tasks without watchdog (default: %(default)s)"
    p.add_argument("--stuck-limit", type=float, default=STUCK_LIMIT_S, metavar="S", help=text)
    kept = FlightSettings()
    text = "memory of the flight recorder in MiB, 0 turns it off (default: %(default)s)"
    p.add_argument("--flight-memory", type=int, default=kept.memory >> 20, metavar="MIB", help=text)
    text = "how far the flight recorder reaches back, in seconds (default: %(default)s)"
    p.add_argument("--flight-seconds", type=float, default=kept.seconds, metavar="S", help=text)
    text = "take an entry of the flight recorder every N cycles (default: %(default)s)"
    p.add_argument("--flight-divider", type=int, default=kept.divider, metavar="N", help=text)
    p.add_argument("--ready-fd", type=int, help=argparse.SUPPRESS)
    p.add_argument("--lifeline-fd", type=int, help=argparse.SUPPRESS)
    return p


def read_token(path: Path) -> str:
    """The access token; a new one is made, readable by the owner only, when there is none.

    Raises OSError, and ValueError for a token that is too short to be safe.
    """
    try:
        token = path.read_text(encoding="ascii").strip()
    except FileNotFoundError:
        token = secrets.token_urlsafe(32)
        replace_file(path, token.encode() + b"\n", mode=PRIVATE, to_disk=True)
    if len(token) < 16:
        raise ValueError(f"{path}: a token has at least 16 characters")
    return token


def _echo(entry: LogEntry) -> None:
    with suppress(OSError):  # of a full disk, say: what is logged goes on
        print(f"{entry.severity}: {entry.component}: {entry.message}", file=sys.stderr, flush=True)


def _scheduling(arguments: argparse.Namespace, log: Logbook) -> Scheduling:
    if arguments.no_realtime:
        return Scheduling(False, notes=("tasks run at normal priority, as asked",))
    scheduling = real_time_scheduling(pin=not arguments.all_cpus)
    if scheduling.realtime:
        refused = lock_memory()
        if refused is not None:
            log.add("warning", "scheduler", f"memory is not locked, a cycle may wait for a page: {refused}")
    return scheduling or NORMAL


def _raise_event(loop: asyncio.AbstractEventLoop, plc: SoftPlc, name: str) -> None:
    """A signal is a system event; what hangs on it runs on a thread."""
    loop.run_in_executor(None, plc.happen, name)


async def serve(arguments: argparse.Namespace) -> None:
    """Run until SIGTERM or SIGINT, or the process at the lifeline is gone; then stop the application and save
    its remanent values."""
    log = Logbook(_echo)
    token = read_token(arguments.token_file or arguments.data / "token")
    plc = SoftPlc(
        arguments.data,
        scheduling=_scheduling(arguments, log),
        stuck_limit_s=arguments.stuck_limit,
        logbook=log,
        flight=FlightSettings(
            arguments.flight_memory << 20, arguments.flight_seconds, arguments.flight_divider
        ),
    )
    service = RuntimeService(plc, token)
    plc.boot()
    port = await service.start(arguments.host, arguments.port)
    log.add("info", "service", f"listening on ws://{arguments.host}:{port}")
    if arguments.ready_fd is not None:
        ready = {"port": port, "token": token, "instance_id": plc.instance_id}
        with os.fdopen(arguments.ready_fd, "w") as pipe:
            json.dump(ready, pipe)
    ended = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, ended.set)
    for name in EXTERNAL_EVENTS:
        if name.startswith("SIG"):
            loop.add_signal_handler(signal.Signals[name], partial(_raise_event, loop, plc, name))
    if arguments.lifeline_fd is not None:
        loop.add_reader(arguments.lifeline_fd, ended.set)  # nothing comes but its end
    await ended.wait()
    if arguments.lifeline_fd is not None:
        loop.remove_reader(arguments.lifeline_fd)
    log.add("info", "service", "shutting down")
    await service.close()
    await asyncio.to_thread(plc.close)


def main(argv: list[str] | None = None) -> int:
    """Entry point; 0 after a proper end, 1 when the runtime could not start."""
    arguments = parser().parse_args(argv)
    try:
        arguments.data.mkdir(parents=True, exist_ok=True, mode=0o700)
        with owned(arguments.data):
            remove_unfinished(arguments.data)
            asyncio.run(serve(arguments))
    except (OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
