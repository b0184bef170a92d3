"""What the language server changes: mends of messages, declarations, names, the look of a text."""

from __future__ import annotations

import json
import re
from contextlib import AbstractContextManager

import pytest
from playwright.sync_api import Locator, Page, Request, Route, expect

from .workbench import (
    add_line,
    choose_menu,
    implementation,
    objects_stored,
    open_object,
    open_panel,
    open_project,
    plc_prg,
    text_of,
    tree_item,
)

pytestmark = pytest.mark.e2e


def declaration(page: Page) -> Locator:
    return page.locator(".monaco-editor:visible").first


def settings_stored(page: Page) -> AbstractContextManager[object]:
    """Until what was chosen last is stored: the account keeps it, and the next test has the same account."""
    return page.expect_response(
        lambda answer: "/me/settings/editors" in answer.url and answer.request.method == "PUT"
    )


def quick_fix(page: Page, title: str, *, go_to_problem: bool = False) -> None:
    """Ctrl+. at the cursor, or at the next problem, and the action of this title.

    Asked again until it is offered: messages follow the typing, and those of half a line name another place.
    """
    entry = page.locator(".action-widget .monaco-list-row").filter(has_text=title)
    for _ in range(20):
        if go_to_problem:
            page.keyboard.press("Alt+PageDown")
            page.keyboard.press("Escape")
        page.keyboard.press("Control+.")
        try:
            expect(entry).to_be_visible(timeout=2_000)
        except AssertionError:
            page.keyboard.press("Escape")
        else:
            break
    entry.click()


def test_a_quick_fix_declares_an_unknown_name_while_the_table_is_shown(page: Page) -> None:
    editor = plc_prg(page)
    page.get_by_role("button", name="Declaration as table").click()
    add_line(page, editor, "xBrandNew := iLoaded > 3;")
    expect(editor.locator(".squiggly-error").first).to_be_visible()
    page.keyboard.press("Home")
    quick_fix(page, "Declare 'xBrandNew' as BOOL")
    expect(page.get_by_role("row", name="VAR xBrandNew BOOL")).to_be_visible()
    expect(editor.locator(".squiggly-error")).to_have_count(0)
    with settings_stored(page):
        page.get_by_role("button", name="Declaration as text").click()


def test_a_quick_fix_asks_for_a_declaration(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "iBrandNew := iLoaded;")
    expect(editor.locator(".squiggly-error").first).to_be_visible()
    page.keyboard.press("Home")
    quick_fix(page, "Declare 'iBrandNew'…")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_label("Name", exact=True)).to_have_value("iBrandNew")
    expect(dialog.get_by_label("Data type", exact=True)).to_have_value("INT")
    page.keyboard.press("Enter")
    expect(editor.locator(".squiggly-error")).to_have_count(0)


@pytest.mark.parametrize(
    ("written", "title", "mended"),
    [
        ("iLoadde := 3;", "Replace by 'iLoaded'", "iLoaded := 3;"),
        ("iLoaded := xRun;", "Convert with BOOL_TO_INT", "iLoaded := BOOL_TO_INT(xRun);"),
        ("fbHorn(PT := 3s);", "Insert 'T#'", "fbHorn(PT := T#3s);"),
    ],
)
def test_a_quick_fix_mends_the_line(page: Page, written: str, title: str, mended: str) -> None:
    editor = plc_prg(page)
    add_line(page, editor, written)
    expect(editor.locator(".squiggly-error").first).to_be_visible()
    quick_fix(page, title, go_to_problem=True)
    expect(editor).to_contain_text(mended.replace(" ", "\xa0"))
    expect(editor.locator(".squiggly-error")).to_have_count(0)


def test_a_quick_fix_is_chosen_in_the_table_of_messages(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "iLoadde := 3;")
    panel = open_panel(page, "Messages")
    row = panel.get_by_role("row").filter(has_text="'iLoadde' not defined")
    expect(row).to_be_visible()
    # By keys: a click goes to the place, where Ctrl+. is the editor's.
    panel.get_by_role("grid").focus()
    page.keyboard.press("Home")
    expect(row).to_have_attribute("aria-selected", "true")
    page.keyboard.press("Control+.")
    fix = page.get_by_role("menuitem", name="Replace by 'iLoaded'")
    expect(fix).to_be_visible()
    page.keyboard.press("Escape")
    expect(fix).to_have_count(0)
    row.click(button="right")
    expect(page.get_by_role("menuitem", name="Go to place")).to_be_visible()
    fix.click()
    expect(editor).to_contain_text("iLoaded\xa0:=\xa03;")
    expect(row).to_have_count(0)


def test_a_warning_is_not_reported_any_more(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "{warning 'look here'}")
    panel = open_panel(page, "Messages")
    row = panel.get_by_role("row").filter(has_text="W1208")
    expect(row).to_be_visible()
    row.click(button="right")
    with objects_stored(page) as saved:
        page.get_by_role("menuitem", name="Do not report W1208 in this application").click()
    assert saved.value.json()["data"]["disabled_warnings"] == ["W1208"]
    expect(row).to_have_count(0)
    add_line(page, editor, "nope := 1;")
    expect(panel.get_by_role("row").filter(has_text="'nope' not defined")).to_be_visible()
    expect(row).to_have_count(0)


def add_declaration(page: Page, text: str) -> Locator:
    """A line behind the first VAR of the declaration, shown as text."""
    page.get_by_role("button", name="Declaration as text").click()
    head = declaration(page)
    expect(head).to_contain_text("VAR")
    head.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.type(text)
    page.keyboard.press("Escape")
    expect(head).to_contain_text(text.replace(" ", "\xa0"))
    return head


def test_a_quick_fix_is_chosen_in_the_declaration_table(page: Page) -> None:
    plc_prg(page)
    add_declaration(page, "iWrong : INTT;")
    page.get_by_role("button", name="Declaration as table").click()
    wrong = page.get_by_role("row").filter(has_text="iWrong")
    cell = wrong.get_by_role("gridcell", name="INTT", exact=True)
    cell.click(button="right")
    fix = page.get_by_role("menuitem", name="Replace by 'INT'", exact=True)
    expect(fix).to_be_visible()
    page.keyboard.press("Escape")
    expect(fix).to_have_count(0)
    cell.click()
    expect(page.get_by_label("Declaration of PLC_PRG as table")).to_be_focused()
    page.keyboard.press("Control+.")
    fix.click()
    expect(wrong.get_by_role("gridcell", name="INT", exact=True)).to_be_visible()


def test_a_short_declaration_is_expanded(page: Page) -> None:
    plc_prg(page)
    head = add_declaration(page, "nParts nRejected I 2; counts")
    page.keyboard.press("Control+Enter")
    expect(head).to_contain_text("nParts, nRejected: INT := 2; (* counts *)".replace(" ", "\xa0"))


def test_auto_declare_puts_a_variable_into_the_declaration(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "rBrandNew := 1.5;")
    page.keyboard.press("Home")
    page.keyboard.press("Shift+F2")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_label("Name", exact=True)).to_have_value("rBrandNew")
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(editor.locator(".squiggly-error")).to_have_count(0)


def test_rename_shows_every_place_changes_all_of_them_and_is_undone_at_once(page: Page) -> None:
    editor = plc_prg(page)
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Control+F2")
    dialog = page.get_by_role("dialog")
    places = dialog.get_by_role("listitem")
    expect(places).to_have_count(6)
    page.keyboard.type("xRun")
    page.keyboard.press("Enter")
    expect(dialog.get_by_role("alert")).to_contain_text("exists already")
    page.keyboard.press("Control+A")
    page.keyboard.type("xAllSafe")
    expect(places.filter(has_text="IF NOT xAllSafe THEN")).to_have_count(1)
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(editor).to_contain_text("xAllSafe")
    tree_item(page, "PLC_PRG").click()
    page.keyboard.press("ArrowRight")
    open_object(page, "Stations")
    expect(implementation(page)).to_contain_text("fbFiller")
    renamed = page.evaluate(NEWEST_CHANGE)
    assert renamed["comment"] == "Rename xSafe to xAllSafe"
    assert renamed["object_count"] > 1
    page.get_by_role("button", name="Undo", exact=True).last.click()
    page.locator(".dv-tab").filter(has_text="PLC_PRG").first.click()
    expect(implementation(page)).to_contain_text("IF NOT xSafe THEN".replace(" ", "\xa0"))
    expect(implementation(page)).not_to_contain_text("xAllSafe")
    undone = page.evaluate(NEWEST_CHANGE)
    assert undone["comment"] == "Rename xAllSafe to xSafe"
    assert undone["object_count"] == renamed["object_count"]


def test_a_rename_that_somebody_else_came_before_changes_nothing(page: Page) -> None:
    editor = plc_prg(page)

    def somebody_else_first(route: Route, request: Request) -> None:
        body = request.post_data_json
        body["objects"][0]["base_revision"] = 0
        route.continue_(post_data=json.dumps(body))

    page.route(re.compile(r"/objects$"), somebody_else_first)
    editor.locator(".view-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Control+F2")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("listitem")).to_have_count(6)
    before = page.evaluate(NEWEST_CHANGE)
    page.keyboard.type("xAllSafe")
    page.keyboard.press("Enter")
    expect(dialog.get_by_role("alert")).to_contain_text("changed by somebody else")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    expect(editor).to_contain_text("IF NOT xSafe THEN".replace(" ", "\xa0"))
    expect(editor).not_to_contain_text("xAllSafe")
    assert page.evaluate(NEWEST_CHANGE) == before


def test_formatting_follows_the_options_and_changes_nothing_twice(page: Page) -> None:
    editor = plc_prg(page)
    add_line(page, editor, "if iLoaded=1 then iLoaded:=2;end_if")
    page.keyboard.press("Shift+Alt+F")
    neat = "IF iLoaded = 1 THEN iLoaded := 2; END_IF"
    expect(editor).to_contain_text(neat.replace(" ", "\xa0"))
    once = text_of(editor)
    page.keyboard.press("Shift+Alt+F")
    page.wait_for_timeout(300)
    assert text_of(editor) == once
    choose_menu(page, "Tools", "Options")
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Keywords").click()
    page.get_by_role("option", name="Lower case").click()
    dialog.get_by_label("Around operators").click()
    dialog.get_by_role("button", name="Close").last.click()
    editor.locator(".view-line").first.click()
    page.keyboard.press("Shift+Alt+F")
    expect(editor).to_contain_text("if iLoaded=1 then iLoaded := 2; end_if".replace(" ", "\xa0"))
    choose_menu(page, "Tools", "Options")
    dialog.get_by_label("Keywords").click()
    page.get_by_role("option", name="Upper case").click()
    with settings_stored(page):
        dialog.get_by_label("Around operators").click()
    dialog.get_by_role("button", name="Close").last.click()


def test_the_members_of_an_interface_become_objects_below_the_block(page: Page) -> None:
    open_project(page)
    page.evaluate(INTERFACE)
    open_object(page, "FB_LsAxis")
    head = declaration(page)
    expect(head.locator(".squiggly-error").first).to_be_visible()
    head.locator(".view-line").first.click()
    quick_fix(page, "Implement LsHalt, LsSpeed of I_LsAxis", go_to_problem=True)
    expect(head.locator(".squiggly-error")).to_have_count(0)
    page.keyboard.press("Control+P")
    for name in ("LsHalt", "LsSpeed"):
        page.get_by_role("combobox").last.fill(name)
        made = page.get_by_role("option").filter(has_text=name).filter(has_text="FB_LsAxis")
        expect(made.first).to_be_visible()


NEWEST_CHANGE = """async () => {
    const [project] = await (await fetch('/api/v1/projects')).json();
    const [newest] = await (await fetch(`/api/v1/projects/${project.id}/revisions?limit=1`)).json();
    return newest;
}"""
"""What the history of the project shows on top."""

INTERFACE = """async () => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const [project] = await (await fetch('/api/v1/projects')).json();
    const path = `/api/v1/projects/${project.id}/objects`;
    const application = (await (await fetch(path)).json()).find((o) => o.kind === 'application');
    const add = async (body) =>
        (await fetch(path, {method: 'POST', headers, body: JSON.stringify(body)})).json();
    const face = await add({parent_id: application.id, kind: 'interface', name: 'I_LsAxis'});
    await add({parent_id: face.id, kind: 'method', name: 'LsHalt',
               data: {declaration: 'METHOD LsHalt : BOOL', implementation: ''}});
    await add({parent_id: face.id, kind: 'property', name: 'LsSpeed',
               data: {declaration: 'PROPERTY LsSpeed : REAL'}});
    await add({parent_id: application.id, kind: 'pou', name: 'FB_LsAxis',
               data: {declaration: 'FUNCTION_BLOCK FB_LsAxis IMPLEMENTS I_LsAxis\\nVAR\\nEND_VAR',
                      implementation: ''}});
}"""
"""An interface with a method and a property, and a block that implements neither."""
