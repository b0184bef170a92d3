"""Chromium with its optimising compilers, which the other tests switch off: as a user has it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Playwright

from .conftest import CHROMIUM_FLAGS, launched, new_profile


@pytest.fixture(scope="module")
def browser(playwright: Playwright) -> Iterator[Browser]:
    """In place of the browser of all tests."""
    flags = [flag for flag in CHROMIUM_FLAGS if not flag.startswith("--js-flags")]
    with launched(playwright, flags) as chromium:
        yield chromium


@pytest.fixture(scope="module")
def profile(browser: Browser) -> Iterator[BrowserContext]:
    """Its storage."""
    with new_profile(browser) as fresh:
        yield fresh
