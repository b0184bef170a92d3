"""Reads one set of files of other systems, in a process of its own: `python -m` with an order on its input.

Such files come from outside and may be made to need any memory or time.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys

from tappet.limited_process import within_limits
from tappet.project.errors import ProjectError
from tappet.project.exchange.importing import Imported
from tappet.server.exchange.import_order import ImportOrder, Refused


def main() -> None:
    """`memory in MiB` and `processor time in s` are the arguments."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints in here must not get into the answer
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly when the server was killed
    with within_limits(*sys.argv[1:3]):
        order: ImportOrder = pickle.load(sys.stdin.buffer)  # noqa: S301 - from the server itself
        try:
            answer: Imported | Refused = order.read()
        except ProjectError as error:
            answer = Refused(error.code, str(error))
        pickle.dump(answer, output)
        output.flush()


if __name__ == "__main__":
    main()
