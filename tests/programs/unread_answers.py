"""Processes whose answers nobody reads any more: what started them was killed."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Sequence


def ends_quietly(command: Sequence[str], order: bytes, pass_fds: Sequence[int] = ()) -> None:
    """Starts a process, gives it an order and does not read: it must end, and must print nothing."""
    unread, output = os.pipe()
    os.close(unread)
    started = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=output, stderr=subprocess.PIPE, pass_fds=pass_fds
    )
    os.close(output)
    _, printed = started.communicate(order)
    assert printed == b""
    assert started.returncode in (0, -signal.SIGPIPE)
