"""Breakpoints and settings of the debugger in the folder of the runtime: they outlive its process.

Contract: what is read back is disabled. A machine that starts by itself, after a power failure, must not halt
because somebody has debugged it before. A file that cannot be read is logged and does no more harm.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct
from msgspec.structs import replace

from tappet.runtime.debugger.breakpoints import MOST
from tappet.runtime.debugger.shapes import BreakpointOrder, Settings
from tappet.runtime.logbook import Logbook
from tappet.whole_file import PRIVATE, replace_file

FILE = "debugger.json"
LARGEST = 16 << 20
"""Bytes of the file: more than so many breakpoints can have."""


class Kept(Struct, frozen=True, forbid_unknown_fields=True):
    """The file."""

    version: Literal[1] = 1
    settings: Settings = Settings()
    breakpoints: Annotated[list[BreakpointOrder], Meta(max_length=MOST)] = []


def load(folder: Path | None, log: Logbook) -> Kept:
    """What was kept, disabled; nothing without a file, or with one that is no such file."""
    if folder is None:
        return Kept()
    try:
        with (folder / FILE).open("rb") as file:
            data = file.read(LARGEST + 1)
        if len(data) > LARGEST:
            raise ValueError(f"it has more than {LARGEST} bytes")
        kept = msgspec.json.decode(data, type=Kept)
    except FileNotFoundError:
        return Kept()
    except (OSError, ValueError, RecursionError) as error:
        log.add("warning", "debugger", f"the breakpoints in {FILE} cannot be read: {error}")
        return Kept()
    return replace(kept, breakpoints=[replace(order, enabled=False) for order in kept.breakpoints])


def save(folder: Path | None, settings: Settings, orders: Iterable[BreakpointOrder], log: Logbook) -> None:
    """Keep them, in place of those before."""
    if folder is None:
        return
    kept = Kept(settings=settings, breakpoints=[order for order in orders if order.kept])
    try:
        replace_file(folder / FILE, msgspec.json.encode(kept), mode=PRIVATE)
    except OSError as error:
        log.add("warning", "debugger", f"the breakpoints could not be kept in {FILE}: {error}")
