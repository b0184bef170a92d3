"""Fixtures of the tests of code generation."""

from __future__ import annotations

import pytest

from tappet.codegen import partition


@pytest.fixture
def small_modules(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small applications in several modules; each would be one."""
    monkeypatch.setattr(partition, "WHOLE", 0)
    monkeypatch.setattr(partition, "PART", 2)
    monkeypatch.setattr(partition, "SMALL", 5)
