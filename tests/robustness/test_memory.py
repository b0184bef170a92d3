"""Memory does not grow with the number of rebuilds: bodies, declarations and errors come and go."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("rebuild_memory.py")
LIMIT_KIB = 30 << 10


def grown_kib(builds: int) -> int:
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(builds)], check=True, capture_output=True, text=True
    )
    warm, last = (int(line) for line in done.stdout.split())
    return last - warm


@pytest.mark.slow
def test_a_thousand_rebuilds() -> None:
    assert grown_kib(1000) < LIMIT_KIB
