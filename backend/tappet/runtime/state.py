"""The states of a soft PLC, and who it is: what clients know of it without having one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

State = Literal["empty", "stop", "run", "exception"]
ResetKind = Literal["warm", "cold", "origin"]


@dataclass(frozen=True, slots=True)
class RuntimeInfo:
    """Who a runtime is and what it runs."""

    version: str
    instance_id: str
    state: State
    application: str | None
    code_id: str | None
    data_id: str | None
    scheduling: tuple[str, ...]
    """What has to be known about real-time behaviour on this host, one sentence each."""
    cycle_ns: int = 0
    """Interval of the bus cycle task."""
    halted: tuple[str, ...] = ()
    """Tasks that stand at a statement."""
    debug_sequence: int = 0
    """Grows with every change of the debugger's state."""


@dataclass(frozen=True, slots=True)
class Event:
    """An event that clients get at once: kind `state`, `exception`, `application`, `forces` or `debug`."""

    kind: str
    state: State
