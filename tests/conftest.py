"""What holds for all tests."""

from __future__ import annotations

import gc

from hypothesis import HealthCheck, settings

settings.register_profile("tappet", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("tappet")
"""On a busy machine any example may take long: no test is about how long something takes."""


def pytest_collection_finish() -> None:
    """Modules and test items are no garbage; walking them again and again is a fifteenth of the time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 50, 100)
