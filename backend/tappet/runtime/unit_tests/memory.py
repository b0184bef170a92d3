"""How much memory tests may take: what they take without end must not take the memory of the whole host.

`__NEW` takes from the arena of the application, which is bounded by itself; this bounds everything else.
"""

from __future__ import annotations

import resource
from pathlib import Path

MIB = 1 << 20
USED_UP = 0.9
"""Part of the room from which on tests are taken to have used it up."""


class MemoryLimitReachedError(RuntimeError):
    """What the tests took is not given back before the process ends; the rest needs a new one."""


class MemoryLimit:
    """Room for the data of this process beyond what it has when the tests begin; then __NEW gives 0."""

    def __init__(self, mib: int) -> None:
        self.mib = mib
        self._before = 0
        self._former = resource.getrlimit(resource.RLIMIT_DATA)

    def begin(self) -> None:
        """From now on, with what is there already: the loaded application and the arena of __NEW."""
        self._before = _data_bytes()
        self._former = resource.getrlimit(resource.RLIMIT_DATA)
        soft, hard = self._before + self.mib * MIB, self._former[1]
        if hard != resource.RLIM_INFINITY:
            soft = min(soft, hard)
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))

    def lift(self) -> None:
        """No limit any more, so that the results of the tests can be reported."""
        resource.setrlimit(resource.RLIMIT_DATA, self._former)

    @property
    def used_up(self) -> bool:
        """Whether there is hardly any room left."""
        return _data_bytes() - self._before > USED_UP * self.mib * MIB


def _data_bytes() -> int:
    """Private writable memory of this process as the limit counts it: VmData."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmData:"):
            return int(line.split()[1]) * 1024
    return 0
