"""Files of an application: the folder they lie in, and what is open.

The operations themselves are native (executive/files.st, executive/mailbox.st); decision 13 says why.
"""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from pathlib import Path

from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Arena, Record
from tappet.runtime.posix import libc

FOLDER = "files"
"""Below the data folder of the runtime; no path of an application leads out of it."""
SIZE_LIMIT = 1 << 30
"""Bytes of one file."""
_CLOSE_TIMEOUT_S = 5.0


class ApplicationFiles:
    """FILE_STORE of one application. Without data folder its files go with the application."""

    def __init__(self, executive: Executive, folder: Path | None) -> None:
        self._executive = executive
        self._folder = folder
        self._temporary: str | None = None
        layout = executive.layouts["FILE_STORE"]
        self._memory = Arena(layout.size)
        self._store = Record(layout, self._memory.take(layout.size))
        self._store["root"] = -1
        self._store["flagFolder"] = os.O_DIRECTORY
        self._store["flagNoFollow"] = os.O_NOFOLLOW
        self._store["sizeLimit"] = SIZE_LIMIT
        libc.sem_init(self._store.place("wake"), 0, 0)

    @property
    def address(self) -> int:
        """FILE_STORE."""
        return self._store.address

    @property
    def opened(self) -> bool:
        """Whether there is a folder to work in."""
        return self._store["root"] >= 0

    @property
    def folder(self) -> Path | None:
        """Where paths begin; None before `open`."""
        if self._folder is not None:
            return self._folder / FOLDER
        return Path(self._temporary) if self._temporary else None

    def open(self) -> None:
        """Open the folder, made if it is not there; OSError when that is not possible."""
        if self.opened:
            return
        if self._folder is None and self._temporary is None:
            self._temporary = tempfile.mkdtemp(prefix="tappet-files-")
        folder = self.folder
        assert folder is not None
        folder.mkdir(mode=0o750, parents=True, exist_ok=True)
        self._store["root"] = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)

    def wake(self) -> None:
        """Let the thread look whether it is to end."""
        libc.sem_post(self._store.place("wake"))

    def reset(self) -> bool:
        """Close what is open, forget requests; only while no task runs. False when a request does not end."""
        due = time.monotonic() + _CLOSE_TIMEOUT_S
        while not self._executive.reset_files(self.address):
            if time.monotonic() > due:
                return False
            time.sleep(0.001)
        return True

    def sweep(self) -> None:
        """Behind an online change, while no task runs: what blocks asked for that are gone is not wanted."""
        self._executive.sweep_files(self.address)

    def close(self) -> None:
        """After the end of all threads: close everything, remove what was temporary."""
        self.reset()
        if self.opened:
            os.close(self._store["root"])
            self._store["root"] = -1
        if self._temporary is not None:
            shutil.rmtree(self._temporary, ignore_errors=True)
            self._temporary = None
        self._memory.close()
