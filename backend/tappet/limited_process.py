"""Programs of our own in processes with limits of memory and processor time.

They work on what comes from outside; what exceeds a limit ends its process, and nothing else. The program is
a module run by `python -m`, with the limits as its first arguments; what it does stands in `within_limits`.
"""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress

OUT_OF_MEMORY = 71
"""Exit code."""
BEHIND_OTHERS = 5
"""Niceness: the server, its compilers and the soft PLC come first."""
_CRASHED = (-signal.SIGSEGV, -signal.SIGABRT)
"""How native code ends that is refused memory."""
_ENDED_BY_TIME = (-signal.SIGXCPU, -signal.SIGKILL)


class LimitExceededError(Exception):
    """What a process needs more than, such as `120 s`."""


def run_limited(
    module: str,
    *arguments: str,
    memory_mib: int,
    seconds: int,
    given: bytes = b"",
    environment: Mapping[str, str] | None = None,
) -> subprocess.CompletedProcess[bytes]:
    """Runs the module with `given` as its input and returns its end with its output; blocks.

    `seconds` are processor time of all its threads; it ends after twice that, too, as the machine may be
    busy with other things. Raises LimitExceededError.
    """
    command = [sys.executable, "-m", module, str(memory_mib), str(seconds), *arguments]
    try:
        done = subprocess.run(  # noqa: S603 - our own program
            command,
            input=given,
            stdout=subprocess.PIPE,
            timeout=2 * seconds,
            check=False,
            env={**os.environ, **(environment or {})},
        )
    except subprocess.TimeoutExpired:
        raise LimitExceededError(f"{seconds} s") from None
    if done.returncode == OUT_OF_MEMORY or (done.returncode in _CRASHED and not done.stdout):
        raise LimitExceededError(f"{memory_mib} MiB of memory")
    if done.returncode in _ENDED_BY_TIME:
        raise LimitExceededError(f"{seconds} s")
    return done


@contextmanager
def within_limits(memory_mib: str, seconds: str) -> Iterator[None]:
    """Around all that such a process does; the arguments are its first two."""
    memory, time = int(memory_mib) << 20, int(seconds)
    with suppress(OSError, ValueError):
        os.nice(BEHIND_OTHERS)
        # not the address space: allocators and stacks of threads reserve much that they never use
        resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CPU, (time, time))
    try:
        yield
    except MemoryError:
        os._exit(OUT_OF_MEMORY)
