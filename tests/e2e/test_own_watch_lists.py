"""Watch lists of the user, and variables dragged to them from editors, the search and the symbol list."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import FloatRect, Locator, Page, expect

from .workbench import (
    answer_to,
    choose_menu,
    implementation,
    log_in,
    open_panel,
    open_project,
    plc_prg,
    tree_item,
    watch,
)

pytestmark = pytest.mark.e2e


@pytest.fixture
def table(page: Page) -> Locator:
    """Watch 1 beside the editor of PLC_PRG, offline."""
    plc_prg(page)
    return open_panel(page, "Watch 1").get_by_role("treegrid")


def rows(table: Locator) -> list[str]:
    """Expressions of the lines, without the empty one at the end."""
    return [
        row.get_by_role("gridcell").first.inner_text().strip() for row in table.get_by_role("row").all()[1:-1]
    ]


def box_of(item: Locator) -> FloatRect:
    box = item.bounding_box()
    assert box is not None
    return box


def drag(page: Page, source: tuple[float, float], box: FloatRect) -> None:
    """As a hand does it: press, move in steps, let go over the middle of the target."""
    page.mouse.move(*source)
    page.mouse.down()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.move(source[0] + 8, source[1] + 4)
    page.mouse.move(*middle, steps=12)
    page.mouse.up()


def place_of(page: Page, editor: Locator, word: str) -> tuple[float, float]:
    """The middle of a word in the text, selected by a double click."""
    expect(editor).to_contain_text(word)
    box = page.wait_for_function(
        """([editor, word]) => {
            const lines = editor.querySelector('.view-lines');
            const walker = document.createTreeWalker(lines, NodeFilter.SHOW_TEXT);
            while (walker.nextNode()) {
                const at = walker.currentNode.data.indexOf(word);
                if (at < 0) continue;
                const range = document.createRange();
                range.setStart(walker.currentNode, at);
                range.setEnd(walker.currentNode, at + word.length);
                const { left, top, width, height } = range.getBoundingClientRect();
                // Lines are drawn anew when the colours of names come.
                return width > 0 && [left + width / 2, top + height / 2];
            }
        }""",
        arg=[editor.element_handle(), word],
    ).json_value()
    page.mouse.dblclick(*box)
    return box[0], box[1]


def test_lists_are_made_named_copied_and_deleted(page: Page) -> None:
    open_project(page)
    watch(page, "GVL_IO.xStartButton")
    choose_menu(page, "View", "Watch", "New Watch List")
    dialog = page.get_by_role("dialog", name="New watch list")
    field = dialog.get_by_label("Name")
    expect(field).to_have_value("My list")
    field.fill("watch 1")
    expect(dialog.get_by_text("There is a list 'watch 1' already.")).to_be_visible()
    field.fill("Pumps & valves <1>")
    page.keyboard.press("Enter")
    own = open_panel(page, "Pumps & valves <1>")
    expect(own.get_by_text("Nothing is watched yet").first).to_be_visible()

    page.locator(".dv-tab").filter(has_text="Watch 1").click(button="right")
    expect(page.get_by_role("menuitem", name="Rename Watch List")).to_have_attribute("aria-disabled", "true")
    page.get_by_role("menuitem", name="Duplicate Watch List").click()
    page.get_by_role("dialog").get_by_label("Name").fill("Buttons")
    page.keyboard.press("Enter")
    copy = open_panel(page, "Buttons").get_by_role("treegrid")
    expect(copy.get_by_role("row").nth(1)).to_contain_text("GVL_IO.xStartButton")

    page.locator(".dv-tab").filter(has_text="Buttons").click(button="right")
    page.get_by_role("menuitem", name="Rename Watch List").click()
    page.get_by_role("dialog").get_by_label("Name").fill("Keys")
    page.keyboard.press("Enter")
    with page.expect_response(lambda answer: "/settings/watch." in answer.url and answer.ok):
        expect(page.locator(".dv-tab").filter(has_text="Keys")).to_be_visible()

    page.reload()
    expect(tree_item(page, "Application")).to_be_visible()
    again = open_panel(page, "Keys").get_by_role("treegrid")
    expect(again.get_by_role("row").nth(1)).to_contain_text("GVL_IO.xStartButton")
    open_panel(page, "Keys").get_by_role("button", name="Watch lists").click()
    page.get_by_role("menuitem", name="Delete Watch List").click()
    page.get_by_role("dialog", name="Delete the watch list 'Keys'?").get_by_role(
        "button", name="Delete"
    ).click()
    expect(page.locator(".dv-tab").filter(has_text="Keys")).to_have_count(0)
    expect(page.locator(".dv-tab").filter(has_text="Pumps & valves <1>")).to_be_visible()


def test_a_selected_variable_is_dragged_out_of_the_text(page: Page, table: Locator) -> None:
    """Offline and online; the text stays as it was."""
    editor = implementation(page)
    drag(page, place_of(page, editor, "xSafe"), box_of(table))
    expect(table.get_by_role("row").nth(1)).to_contain_text("PLC_PRG.xSafe")
    expect(page.locator(".dv-tab").filter(has_text="PLC_PRG").locator("[data-dirty]")).to_have_count(0)
    expect(editor).to_contain_text("//\xa0Mode")
    log_in(page)
    # The values move the text.
    expect(editor.locator("[class*=pill]").nth(10)).to_have_text(re.compile("TRUE|FALSE|[A-Za-z]+"))
    drag(page, place_of(page, editor, "xStarted"), box_of(table))
    expect(table.get_by_role("row").nth(2)).to_contain_text("PLC_PRG.xStarted")
    expect(table.get_by_role("row").nth(2).get_by_role("gridcell").nth(2)).to_have_text(
        re.compile("TRUE|FALSE")
    )
    expect(editor.locator(".view-lines")).to_contain_text("xSafe")


def test_escape_ends_a_drag(page: Page, table: Locator) -> None:
    editor = implementation(page)
    place = place_of(page, editor, "xSafe")
    box = box_of(table)
    page.mouse.move(*place)
    page.mouse.down()
    page.mouse.move(box["x"] + 100, box["y"] + 40, steps=8)
    label = page.get_by_text("PLC_PRG.xSafe", exact=True)
    expect(label).to_be_visible()
    page.keyboard.press("Escape")
    expect(label).to_have_count(0)
    page.mouse.up()
    assert rows(table) == []


def test_rows_of_the_declaration_are_dragged(page: Page, table: Locator) -> None:
    """Of the table offline and of the one with values, and lines of the declaration as text."""
    page.get_by_role("button", name="Declaration as table").click()
    declaration = page.get_by_role("grid", name=re.compile("PLC_PRG"))
    declaration.get_by_role("row").filter(has_text="xRun").first.drag_to(table)
    expect(table.get_by_role("row").nth(1)).to_contain_text("PLC_PRG.xRun")
    log_in(page)
    online = page.get_by_role("treegrid", name=re.compile("PLC_PRG"))
    online.get_by_role("row").filter(has_text="iLoaded").first.drag_to(table)
    expect(table.get_by_role("row").nth(2)).to_contain_text("PLC_PRG.iLoaded")


def test_a_place_found_by_the_search_is_dragged(page: Page, table: Locator) -> None:
    """The variable at the hit: one of the program, and one of a global list where it is declared."""
    for text, line, expression in (
        ("xReset", re.compile(r"^\s*\d+\s*xReset := GVL"), "PLC_PRG.xReset"),
        ("xStartButton", re.compile("xStartButton.*: BOOL|xStartButton.*AT"), "GVL_IO.xStartButton"),
    ):
        page.keyboard.press("Control+Shift+F")
        panel = page.locator("[data-panel-id=search]")
        with answer_to(page, "/search"):
            panel.get_by_label("Search for").fill(text)
        hit = panel.get_by_role("treeitem").filter(has_text=line).first
        expect(hit).to_be_visible()
        box = box_of(hit)
        drag(page, (box["x"] + 60, box["y"] + 10), box_of(table))
        expect(table.get_by_role("row").filter(has_text=expression)).to_be_visible()


def test_a_symbol_is_dragged_out_of_the_list(page: Page, table: Locator) -> None:
    below = box_of(table)
    page.keyboard.press("Control+Alt+T")
    page.keyboard.type("xGuardOpen")
    entry = page.get_by_role("option").filter(has_text="GVL_IO").first
    expect(entry).to_be_visible()
    box = box_of(entry)
    drag(page, (box["x"] + 60, box["y"] + 10), below)
    expect(page.get_by_role("listbox")).to_have_count(0)
    expect(table.get_by_role("row").nth(1)).to_contain_text("GVL_IO.xGuardOpen")


def test_the_menu_of_an_editor_names_the_list(page: Page, table: Locator) -> None:
    editor = implementation(page)
    place = place_of(page, editor, "xSafe")
    page.mouse.click(*place, button="right")
    page.get_by_role("menuitem", name="Add to watch list").hover()
    page.get_by_role("menuitemcheckbox", name="Watch 3").click()
    third = open_panel(page, "Watch 3").get_by_role("treegrid")
    expect(third.get_by_role("row").nth(1)).to_contain_text("PLC_PRG.xSafe")
    page.mouse.click(*place_of(page, editor, "xStarted"), button="right")
    page.get_by_role("menuitem", name="Add to watch list").hover()
    page.get_by_role("menuitem", name="New Watch List").click()
    page.get_by_role("dialog").get_by_label("Name").fill("Started")
    page.keyboard.press("Enter")
    own = open_panel(page, "Started").get_by_role("treegrid")
    expect(own.get_by_role("row").nth(1)).to_contain_text("PLC_PRG.xStarted")
    open_panel(page, "Watch 1")
    assert rows(table) == []
