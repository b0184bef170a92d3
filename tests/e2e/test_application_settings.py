"""The settings of an application in its editor: the limit of dynamic memory."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, Response, expect

from .workbench import open_object, open_project

pytestmark = pytest.mark.e2e


def saves_poison(answer: Response) -> bool:
    return answer.request.method == "PUT" and '"poison":true' in (answer.request.post_data or "")


def test_the_limit_of_dynamic_memory_is_stored_and_checked(page: Page) -> None:
    open_project(page)
    open_object(page, "Application")
    limit = page.get_by_label("Limit", exact=True)
    expect(limit).to_have_value("65536")
    expect(page.get_by_text("Another limit needs a download")).to_be_visible()

    limit.fill("2000000")
    expect(page.get_by_role("alert").filter(has_text="from 0 to 1048576")).to_be_visible()
    with page.expect_response(saves_poison) as answer:
        limit.fill("128")
        page.get_by_label("Fill released memory").check()
    assert answer.value.json()["data"]["heap"] == {"limit_kib": 128, "poison": True}
    expect(page.get_by_role("alert").filter(has_text="from 0 to")).to_have_count(0)

    page.reload()
    open_object(page, "Application")
    expect(page.get_by_label("Limit", exact=True)).to_have_value("128")
    expect(page.get_by_label("Fill released memory")).to_be_checked()
