"""The loop of a process that answers orders of the web server (`worker_process`), one after the other."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable
from typing import Any

from tappet.server.frames import pack_frame, read_frame

BEHIND_TYPING = 5
"""Niceness."""


def serve(outcome: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
    """Reads orders from the input and writes what `outcome` makes of each, until the input ends."""
    os.nice(BEHIND_TYPING)
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints in here must not get between the frames
    gc.freeze()
    while (order := read_frame(sys.stdin.buffer)) is not None:
        try:
            output.write(pack_frame(outcome(order)))
            output.flush()
        except BrokenPipeError:
            os._exit(0)  # the server was killed: there is nobody to answer
        del order
