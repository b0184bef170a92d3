"""The compiled library for the tests of the room."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tappet.motion.cam_program import CamProgram


@pytest.fixture(scope="session")
def program() -> Iterator[CamProgram]:
    with CamProgram() as made:
        yield made
