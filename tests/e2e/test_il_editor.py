"""The table of Instruction List: one instruction a row, kept as the text it is (IL-01 .. IL-08)."""

from __future__ import annotations

import re
from contextlib import AbstractContextManager

import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import Server
from .workbench import choose_menu, log_in, message_rows, open_object, open_project, tree_item

pytestmark = pytest.mark.e2e

DECLARATION = """PROGRAM IL_Fill
VAR
    bStart AT %IX0.6 : BOOL; // Start button
    bRun : BOOL; // Machine runs
    iCount : INT; // Bottles so far
    aLimit : ARRAY[0..3] OF INT := [5, 10, 15, 20];
    tDelay : TON; // Start delay
END_VAR"""
BODY = """        LD      bStart          // Pressed?
        ANDN    bRun
        JMPC    mark

        LD      iCount
        ADD(    2
        MUL     3
        )
        ST      iCount
        CAL     tDelay(
                    IN := bRun,
                    PT := T#2s
                )
(* Not
   reached always *)
mark:   LDN     bRun
        ST      bRun
"""
MAKE = """async ([declaration, implementation]) => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const [project] = await (await fetch('/api/v1/projects')).json();
    const path = `/api/v1/projects/${project.id}/objects`;
    const application = (await (await fetch(path)).json()).find((o) => o.kind === 'application');
    const made = await fetch(path, {method: 'POST', headers, body: JSON.stringify({
        parent_id: application.id, kind: 'pou', name: 'IL_Fill',
        data: {declaration, implementation, language: 'IL'}})});
    return made.status;
}"""
STORED = """async () => {
    const [project] = await (await fetch('/api/v1/projects')).json();
    const path = `/api/v1/projects/${project.id}/objects`;
    const found = (await (await fetch(path)).json()).find((o) => o.name === 'IL_Fill');
    return (await (await fetch(`${path}/${found.id}`)).json()).data.implementation;
}"""


@pytest.fixture
def table(page: Page) -> Locator:
    """The table of a program in IL that has just been opened."""
    open_project(page)
    assert page.evaluate(MAKE, [DECLARATION, BODY]) == 201
    open_object(page, "IL_Fill")
    grid = page.get_by_role("grid", name="Instructions of IL_Fill")
    expect(grid).to_be_visible()
    return grid


COLUMNS = ["", "Operator", "Operand", "Address", "Symbol comment", "Operand comment"]


def cell(table: Locator, line: int, column: str) -> Locator:
    """A cell by its row, from 1, and the title of its column."""
    return table.get_by_role("row").nth(line).get_by_role("gridcell").nth(COLUMNS.index(column))


def cursor(table: Locator) -> Locator:
    return table.locator("[data-cursor]")


def has_stored(page: Page, body: str) -> None:
    """What was changed in the table has reached the server, and nothing else was."""
    page.keyboard.press("Control+S")
    for _ in range(300):
        found = page.evaluate(STORED)
        if found == body:
            return
        page.wait_for_timeout(100)
    assert found == body


def test_five_columns_of_which_three_are_options(page: Page, table: Locator) -> None:
    """IL-01, FBD-41: operator, operand, address, symbol comment, operand comment."""
    expect(table.get_by_role("columnheader")).to_have_text(COLUMNS)
    expect(cell(table, 1, "Operator")).to_have_text("LD")
    expect(cell(table, 1, "Operand")).to_have_text("bStart")
    expect(cell(table, 1, "Address")).to_have_text("%IX0.6")
    expect(cell(table, 1, "Symbol comment")).to_have_text("Start button")
    expect(cell(table, 1, "Operand comment")).to_have_text("Pressed?")
    for column in ("Address", "Symbol comment"):
        cell(table, 1, column).dblclick()
        expect(table.get_by_role("textbox")).to_have_count(0)
    choose_menu(page, "Tools", "Options")
    dialog = page.get_by_role("dialog")
    for option in ("Show symbol address", "Show symbol comment", "Show operand comment"):
        dialog.get_by_label(option).click()
    dialog.get_by_role("button", name="Close").last.click()
    expect(table.get_by_role("columnheader")).to_have_text(COLUMNS[:3])
    choose_menu(page, "Tools", "Options")
    for option in ("Show symbol address", "Show symbol comment"):
        dialog.get_by_label(option).click()
    with settings_stored(page):
        dialog.get_by_label("Show operand comment").click()
    dialog.get_by_role("button", name="Close").last.click()
    expect(table.get_by_role("columnheader")).to_have_text(COLUMNS)


def test_labels_comments_calls_and_parentheses_have_their_rows(page: Page, table: Locator) -> None:
    """IL-09, IL-10, IL-12, IL-14: every line of the text is a row, a label has one of its own."""
    expect(cell(table, 4, "Operator")).to_have_text("")
    expect(cell(table, 6, "Operator")).to_have_text("ADD(")
    expect(cell(table, 8, "Operator")).to_have_text(")")
    expect(cell(table, 11, "Operator")).to_have_text("IN :=")
    expect(cell(table, 11, "Operand")).to_have_text("bRun,")
    expect(cell(table, 13, "Operand")).to_have_text(")")
    table.focus()
    page.keyboard.press("Control+End")
    expect(cell(table, 14, "Operator")).to_have_text("Not ↵ reached always")
    expect(cell(table, 15, "Operator")).to_have_text("mark:")
    expect(cell(table, 15, "Operand")).to_have_text("Network 2")
    expect(cell(table, 16, "Operator")).to_have_text("LDN")


def test_arrows_and_tab_move_the_cursor(page: Page, table: Locator) -> None:
    """IL-02: Up and Down change the row. IL-03: Tab and Shift+Tab change the cell in the row."""
    cell(table, 1, "Operator").click()
    expect(cursor(table)).to_have_text("LD")
    page.keyboard.press("ArrowDown")
    expect(cursor(table)).to_have_text("ANDN")
    page.keyboard.press("Tab")
    expect(cursor(table)).to_have_text("bRun")
    page.keyboard.press("ArrowUp")
    expect(cursor(table)).to_have_text("bStart")
    page.keyboard.press("Tab")
    expect(cursor(table)).to_have_text("%IX0.6")
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Shift+Tab")
    expect(cursor(table)).to_have_text("LD")
    has_stored(page, BODY)


def test_scroll_keys(page: Page, table: Locator) -> None:
    """IL-08: the beginning, the end, a page up and down."""
    cell(table, 2, "Operator").click()
    page.keyboard.press("Control+End")
    expect(table.get_by_role("row").last).to_have_attribute("aria-selected", "true")
    page.keyboard.press("PageUp")
    expect(table.get_by_role("row").last).to_have_attribute("aria-selected", "false")
    page.keyboard.press("Control+Home")
    expect(table.get_by_role("row").nth(1)).to_have_attribute("aria-selected", "true")
    page.keyboard.press("PageDown")
    expect(table.get_by_role("row").nth(1)).to_have_attribute("aria-selected", "false")


def test_a_cell_is_edited_in_place(page: Page, table: Locator) -> None:
    """IL-04: Space or a click opens the field, Enter takes the entry, Esc does not; F2 assists."""
    field = table.get_by_role("textbox")
    cell(table, 2, "Operand").click()
    page.keyboard.press("Space")
    expect(field).to_have_value("bRun")
    page.keyboard.type("iCount")
    page.keyboard.press("Escape")
    if field.count():  # the first Esc closes the proposals
        page.keyboard.press("Escape")
    expect(cell(table, 2, "Operand")).to_have_text("bRun")
    cell(table, 2, "Operand").click()
    expect(field).to_have_value("bRun")
    field.fill("bRunning")
    page.keyboard.press("Enter")
    expect(cell(table, 2, "Operand")).to_have_text("bRunning")
    body = BODY.replace("ANDN    bRun\n", "ANDN    bRunning\n", 1)
    has_stored(page, body)
    page.keyboard.press("Space")
    table.get_by_role("button", name="Input assistant").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("textbox").fill("bStart")
    expect(dialog.get_by_role("row").nth(1)).to_contain_text("bStart")
    page.keyboard.press("Enter")
    expect(cell(table, 2, "Operand")).to_have_text("bStart")
    page.keyboard.press("F2")
    expect(dialog.get_by_role("textbox")).to_have_value("bStart")
    page.keyboard.press("Escape")
    cell(table, 1, "Operand comment").dblclick()
    page.get_by_role("textbox", name="Edit Operand comment").fill("Held down?")
    page.keyboard.press("Enter")
    body = body.replace("bRunning", "bStart", 1).replace("Pressed?", "Held down?")
    has_stored(page, body)


def test_ctrl_enter_makes_a_row_below(page: Page, table: Locator) -> None:
    """IL-05: also from an open cell, so that a list is typed in one go; one undo takes back one change."""
    cell(table, 2, "Operator").click()
    page.keyboard.press("Control+Enter")
    field = table.get_by_role("textbox").or_(table.get_by_role("combobox"))
    for operator, operand in (("ORN", "bStart"), ("OR", "TRUE")):
        expect(field).to_have_value("")
        page.keyboard.type(operator)
        expect(field).to_have_value(operator)
        page.keyboard.press("Tab")
        expect(field).to_have_value("")
        page.keyboard.type(operand)
        expect(field).to_have_value(operand)
        page.keyboard.press("Control+Enter" if operator == "ORN" else "Enter")
    line = "        ANDN    bRun\n"
    made = line + "        ORN     bStart\n        OR      TRUE\n"
    has_stored(page, BODY.replace(line, made, 1))
    page.keyboard.press("Control+Z")
    has_stored(page, BODY.replace(line, made.replace("      TRUE", ""), 1))
    page.keyboard.press("Control+Y")
    has_stored(page, BODY.replace(line, made, 1))


def test_del_deletes_rows(page: Page, table: Locator) -> None:
    """IL-06: the row with all its cells, or all that are selected with Shift; undo brings them back."""
    lines = BODY.split("\n")
    cell(table, 2, "Operand").click()
    page.keyboard.press("Delete")
    has_stored(page, "\n".join([lines[0], *lines[2:]]))
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Delete")
    has_stored(page, "\n".join([lines[0], *lines[5:]]))
    page.keyboard.press("Control+Z")
    page.keyboard.press("Control+Z")
    has_stored(page, BODY)


def test_rows_are_cut_copied_and_pasted(page: Page, table: Locator) -> None:
    """IL-07: before the selected row, or at the end when nothing is selected."""
    lines = BODY.split("\n")
    cell(table, 1, "Operator").click()
    cell(table, 2, "Operator").click(modifiers=["Shift"])
    page.keyboard.press("Control+C")
    cell(table, 5, "Operand").click()
    page.keyboard.press("Control+V")
    has_stored(page, "\n".join([*lines[:4], *lines[:2], *lines[4:]]))
    page.keyboard.press("Control+X")
    has_stored(page, BODY)
    grid_bottom = table.bounding_box()
    assert grid_bottom is not None
    page.keyboard.press("Control+End")
    table.click(position={"x": 300, "y": grid_bottom["height"] - 12})
    page.keyboard.press("Control+V")
    has_stored(page, BODY + "\n".join(lines[:2]) + "\n")


def test_rows_are_dragged(page: Page, table: Locator) -> None:
    """NET-10, FBD-07: those that are selected move together, with Ctrl they are copied; each is one undo."""
    lines = BODY.split("\n")
    cell(table, 2, "Operator").click()
    cell(table, 3, "Operator").click(modifiers=["Shift"])
    above = {"x": 10, "y": 3}
    cell(table, 3, "Operator").drag_to(cell(table, 1, "Operator"), target_position=above)
    expect(cell(table, 1, "Operator")).to_have_text("ANDN")
    has_stored(page, "\n".join([lines[1], lines[2], lines[0], *lines[3:]]))
    page.keyboard.press("Control+Z")
    has_stored(page, BODY)
    cell(table, 1, "Operator").click()
    page.keyboard.down("Control")
    cell(table, 1, "Operator").drag_to(cell(table, 3, "Operator"), target_position=above)
    page.keyboard.up("Control")
    expect(cell(table, 3, "Operator")).to_have_text("LD")
    has_stored(page, "\n".join([*lines[:2], lines[0], *lines[2:]]))
    page.keyboard.press("Control+Z")
    has_stored(page, BODY)


def test_negation_network_comments_and_names_from_a_cell(page: Page, table: Locator) -> None:
    """CMD-21, NET-07, DECL-20: Alt+N, Ctrl+O; Shift+F12 and Ctrl+F2 are about the operand at the cursor."""
    cell(table, 2, "Operator").click()
    page.keyboard.press("Alt+n")
    expect(cell(table, 2, "Operator")).to_have_text("AND")
    has_stored(page, BODY.replace("ANDN ", "AND  "))
    page.keyboard.press("Alt+n")
    page.keyboard.press("Control+o")
    row = table.get_by_role("row").nth(2)
    expect(row).to_have_attribute("data-state", "excluded")
    first, second = BODY.split("mark:")
    out = [f"//| {line}" if line else "//|" for line in first.rstrip("\n").split("\n")]
    has_stored(page, "\n".join([*out, f"mark:{second}"]))
    page.keyboard.press("Control+o")
    expect(row).not_to_have_attribute("data-state", "excluded")
    has_stored(page, BODY)
    cell(table, 5, "Operand").click()
    page.keyboard.press("Shift+F12")
    found = page.get_by_role("grid", name="Cross References").get_by_role("row")
    expect(found.filter(has_text="IL_Fill.iCount")).to_have_count(3)
    cell(table, 5, "Operand").click()  # where the cursor is already: the cell opens
    expect(table.get_by_role("textbox")).to_have_value("iCount")
    page.keyboard.press("Control+F2")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("listitem")).to_have_count(3)
    page.keyboard.type("iBottles")
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(cell(table, 5, "Operand")).to_have_text("iBottles")
    has_stored(page, BODY.replace("iCount", "iBottles"))


def test_proposals_and_definitions(page: Page, table: Locator) -> None:
    """IL-01, IL-04: the language server helps in the cells; F12 leads to the declaration."""
    cell(table, 2, "Operator").click()
    page.keyboard.type("LI")
    proposals = page.get_by_role("listbox")
    expect(proposals.get_by_role("option", name="LIMIT LIMIT")).to_be_visible()
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    cell(table, 9, "Operand").click()
    page.keyboard.type("tDelay.")
    expect(proposals.get_by_role("option", name="ET TIME")).to_be_visible()
    page.keyboard.type("E")
    expect(proposals.get_by_role("option", name="ET TIME")).to_have_attribute("aria-selected", "true")
    page.keyboard.press("Enter")
    expect(table.get_by_role("textbox")).to_have_value("tDelay.ET")
    page.keyboard.press("Enter")
    expect(cell(table, 9, "Operand")).to_have_text("tDelay.ET")
    cell(table, 5, "Operand").click()
    page.keyboard.press("F12")
    expect(page.get_by_role("status").filter(has_text="Ln 5")).to_be_visible()


def test_messages_mark_their_row_and_lead_to_it(page: Page, table: Locator) -> None:
    """A row with an error has a mark that shows it; the message window leads to the row."""
    cell(table, 2, "Operand").click()
    page.keyboard.type("bNowhere")
    expect(table.get_by_role("textbox")).to_have_value("bNowhere")
    page.keyboard.press("Enter")
    mark = table.get_by_role("row").nth(2).get_by_role("img")
    expect(mark).to_have_attribute("aria-label", re.compile("bNowhere"))
    page.keyboard.press("Control+Home")
    message_rows(page).filter(has_text="bNowhere").first.dblclick()
    expect(table.get_by_role("row").nth(2)).to_have_attribute("aria-selected", "true")
    expect(cursor(table)).to_have_text("bNowhere")


def test_the_same_body_as_text(page: Page, table: Locator) -> None:
    """Text and table are two views of one text; Ctrl+F searches in the text; the choice is remembered."""
    cell(table, 5, "Operand").click()
    page.keyboard.press("Control+F")
    expect(page.locator(".find-widget.visible")).to_be_visible()
    page.get_by_role("button", name="Instructions as table").click()
    expect(table).to_be_visible()
    with settings_stored(page):
        page.get_by_role("button", name="Instructions as text").click()
    page.reload()
    editor = page.locator(".monaco-editor:visible").last
    expect(editor).to_contain_text("ANDN")
    with settings_stored(page):
        page.get_by_role("button", name="Instructions as table").click()
    expect(table).to_be_visible()


def test_operators_are_coloured_without_the_language_server(page: Page, server: Server) -> None:
    """The text form has its colours at once, however long the language server takes."""
    page = page.context.new_page()  # which the route ends with
    page.goto(server.address)
    page.route_web_socket(re.compile("/api/v1/lsp"), lambda socket: None)
    open_project(page)
    assert page.evaluate(MAKE, [DECLARATION, BODY]) == 201
    open_object(page, "IL_Fill")
    page.get_by_role("button", name="Instructions as text").click()
    editor = page.locator(".monaco-editor:visible").last
    expect(editor).to_contain_text("ANDN")
    look = "span => getComputedStyle(span).color"
    operator = editor.locator(".view-line span span").filter(has_text=re.compile(r"^\s*ANDN$"))
    operand = editor.locator(".view-line span span").filter(has_text=re.compile(r"^\s*bRun$")).first
    assert operator.evaluate(look) != operand.evaluate(look)
    with settings_stored(page):
        page.get_by_role("button", name="Instructions as table").click()


@pytest.mark.parametrize(("kind", "owner"), [("POU", None), ("Method", "FB_Filler"), ("Action", "PLC_PRG")])
def test_new_objects_can_be_written_in_il(page: Page, kind: str, owner: str | None) -> None:
    """The dialog offers IL; the new body opens as a table with one blank row (FBD-02)."""
    open_project(page)
    if owner == "FB_Filler":
        tree_item(page, "Stations").click()
        page.keyboard.press("ArrowRight")
    tree_item(page, owner or "Application").click(button="right")
    page.get_by_role("menuitem", name=re.compile("^Add object", re.IGNORECASE)).hover()
    page.get_by_role("menuitem", name=re.compile(f"^{kind}")).first.click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Name", exact=True).fill("IlMade")
    dialog.get_by_label("Language of the body").click()
    page.get_by_role("option", name="Instruction list (IL)").click()
    dialog.get_by_role("button", name="Add").click()
    table = page.get_by_role("grid", name="Instructions of IlMade")
    expect(table.get_by_role("row")).to_have_count(2)


def test_values_are_shown_and_prepared_online(page: Page, table: Locator) -> None:
    """ONL-02, ONL-05: a column of values; a click prepares one, F7 forces it."""
    page.evaluate(CALL_IT)
    log_in(page)
    expect(table.get_by_role("columnheader").nth(3)).to_have_text("Value")
    value = table.get_by_role("row").nth(2).get_by_role("button", name="Prepare a value for IL_Fill.bRun")
    expect(value).to_contain_text(re.compile("TRUE|FALSE"))
    number = table.get_by_role("row").nth(5).get_by_role("button", name="Prepare a value for IL_Fill.iCount")
    expect(number).to_have_text(re.compile(r"^-?\d+$"))
    value.dblclick()
    expect(value).to_contain_text("<")
    page.keyboard.press("F7")
    expect(value.get_by_label("Forced")).to_be_visible()
    page.keyboard.press("Alt+F7")
    expect(value.get_by_label("Forced")).to_have_count(0)
    cell(table, 5, "Operand").click()
    page.keyboard.press("Space")
    strip = page.get_by_role("alert").filter(has_text="Edit IL_Fill while logged in?")
    expect(strip).to_be_visible()
    page.keyboard.press("Escape")
    expect(strip).to_have_count(0)
    cell(table, 1, "Operator").click()
    page.keyboard.press("Alt+N")
    expect(strip).to_be_visible()
    page.keyboard.press("Control+Enter")
    expect(cell(table, 1, "Operator")).to_have_text("LDN")
    page.keyboard.press("Control+F8")


CALL_IT = """async () => {
    const headers = {'X-Tappet-Client': '1', 'Content-Type': 'application/json'};
    const [project] = await (await fetch('/api/v1/projects')).json();
    const path = `/api/v1/projects/${project.id}/objects`;
    const objects = await (await fetch(path)).json();
    const task = await (await fetch(`${path}/${objects.find((o) => o.name === 'MainTask').id}`)).json();
    const data = {...task.data, pous: [...task.data.pous, {name: 'IL_Fill', comment: ''}]};
    await fetch(`${path}/${task.id}`, {method: 'PUT', headers,
        body: JSON.stringify({base_revision: task.revision, data})});
}"""
"""The program becomes a call of MainTask."""


def settings_stored(page: Page) -> AbstractContextManager[object]:
    """Until what was chosen last is stored: the account keeps it, and the next test has the same account."""
    return page.expect_response(
        lambda answer: "/me/settings/editors" in answer.url and answer.request.method == "PUT"
    )
