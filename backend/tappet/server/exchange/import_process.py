"""Imports as the server starts them: small ones at once, others in a process with limits."""

from __future__ import annotations

import pickle
import threading

from tappet.limited_process import LimitExceededError, run_limited
from tappet.project.errors import ProjectError
from tappet.project.exchange.importing import Imported
from tappet.server.exchange.import_order import ImportOrder, Refused
from tappet.server.problems import Problem

SMALL_BYTES = 128 * 1024
"""Of all files: so much cannot take long, and a process takes half a second to start."""
MEMORY_MIB = 2048
SECONDS = 120
MOST_AT_ONCE = 2
PATIENCE_S = 60.0
"""For one of the processes to become free."""
_PLACES = threading.BoundedSemaphore(MOST_AT_ONCE)
WORKER = "tappet.server.exchange.import_worker"


class ImportRefusedError(ProjectError):
    """What the process has found wrong with the files."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


def run_import(order: ImportOrder) -> Imported:
    """Reads the files; blocks. Raises ProjectError, a 413 problem beyond the limits, 503 for too many."""
    if sum(map(len, order.files.values())) <= SMALL_BYTES:
        return order.read()
    if not _PLACES.acquire(timeout=PATIENCE_S):
        raise Problem(503, "imports-running", "Other imports are being read; try again in a minute.")
    try:
        done = run_limited(WORKER, memory_mib=MEMORY_MIB, seconds=SECONDS, given=pickle.dumps(order))
    except LimitExceededError as error:
        raise Problem(
            413, "import-too-large", f"These files need more than {error} to be read; import them in parts."
        ) from None
    finally:
        _PLACES.release()
    if done.returncode:
        raise RuntimeError(f"the import ended with exit code {done.returncode}; its error is above")
    answer: Imported | Refused = pickle.loads(done.stdout)  # noqa: S301 - from our own program
    if isinstance(answer, Refused):
        raise ImportRefusedError(answer.code, answer.message)
    return answer
