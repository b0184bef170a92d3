"""What holds for all tests."""

from __future__ import annotations

import faulthandler
import gc
import os
from collections.abc import Generator

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("tappet", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("tappet")
"""On a busy machine any example may take long: no test is about how long something takes."""


def pytest_collection_finish() -> None:
    """Modules and test items are no garbage; walking them again and again is a fifteenth of the time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 50, 100)


HANGS_S = 1200
"""No fast test takes a twentieth of that. One that hangs says where, and keeps no other from running."""
_STDERR = pytest.StashKey[int]()


def pytest_configure(config: pytest.Config) -> None:
    """Output is not captured yet."""
    config.stash[_STDERR] = os.dup(2)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """Ends a process whose test hangs, with the stacks of all its threads."""
    if item.get_closest_marker("slow") is None:
        faulthandler.dump_traceback_later(HANGS_S, exit=True, file=item.config.stash[_STDERR])
    try:
        return (yield)
    finally:
        faulthandler.cancel_dump_traceback_later()
