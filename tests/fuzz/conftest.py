"""What the targets of a run share."""

from __future__ import annotations

from collections.abc import Iterator

import door_targets
import pytest


@pytest.fixture(scope="session", autouse=True)
def attacked_server() -> Iterator[None]:
    """Ends the server that the doors belong to."""
    yield
    door_targets.close()
