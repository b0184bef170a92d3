"""Reads one set of files of other systems, in a process of its own: `python -m` with an order on its input.

Such files come from outside and may be made to need any memory or time. The process has limits of both; what
it exceeds ends it, and nothing else.
"""

from __future__ import annotations

import os
import pickle
import resource
import signal
import sys
from contextlib import suppress

from tappet.project.errors import ProjectError
from tappet.project.exchange.importing import Imported
from tappet.server.exchange.import_order import ImportOrder, Refused

OUT_OF_MEMORY = 71
"""Exit code."""
BEHIND_OTHERS = 5
"""Niceness: the server, its compilers and the soft PLC come first."""


def main() -> None:
    """`memory in MiB` and `processor time in s` are the arguments."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints in here must not get into the answer
    memory, seconds = int(sys.argv[1]) << 20, int(sys.argv[2])
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly when the server was killed
    with suppress(OSError, ValueError):
        os.nice(BEHIND_OTHERS)
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    try:
        order: ImportOrder = pickle.load(sys.stdin.buffer)  # noqa: S301 - from the server itself
        try:
            answer: Imported | Refused = order.read()
        except ProjectError as error:
            answer = Refused(error.code, str(error))
        pickle.dump(answer, output)
        output.flush()
    except MemoryError:
        os._exit(OUT_OF_MEMORY)


if __name__ == "__main__":
    main()
