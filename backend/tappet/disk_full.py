"""Whether an error means that a disk has no room left. May be imported by every room."""

from __future__ import annotations

import errno
from collections.abc import Iterator

_NUMBERS = {errno.ENOSPC, errno.EDQUOT}
_SQLITE_CODES = {13, 4874}
"""SQLITE_FULL, and SQLITE_IOERR_SHMSIZE: no room for the index of the write-ahead log."""
_POSTGRES_STATE = "53100"
"""SQLSTATE `disk_full`."""


def is_disk_full(error: BaseException) -> bool:
    """Whether `error`, or one that it was raised from, says so: of a file, of SQLite or of PostgreSQL."""
    return any(_says_so(one) for one in _chain(error))


def _says_so(error: BaseException) -> bool:
    return (
        (isinstance(error, OSError) and error.errno in _NUMBERS)
        or getattr(error, "sqlite_errorcode", None) in _SQLITE_CODES
        or getattr(error, "sqlstate", None) == _POSTGRES_STATE
    )


def _chain(error: BaseException) -> Iterator[BaseException]:
    seen: set[int] = set()
    found: BaseException | None = error
    while found is not None and id(found) not in seen:
        seen.add(id(found))
        yield found
        found = found.__cause__ or found.__context__
