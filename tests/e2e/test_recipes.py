"""Recipes in the browser: a table of variables and recipes, read from and written to the controller."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from .api import fetch
from .conftest import Server
from .workbench import log_in, objects_stored, open_object, open_project

pytestmark = pytest.mark.e2e

PROJECT = "Bakery"
DECLARATION = """PROGRAM PLC_PRG
VAR
    rTemperature : REAL := 180.0; // of the oven
    tBake : TIME := T#25m;
    sLabel : STRING(20) := 'Wheat';
    aStep : ARRAY[1..3] OF INT := [5, 10, 15];
    xSteam : BOOL;
END_VAR"""
VALUES = {"PLC_PRG.rTemperature": "210.5", "PLC_PRG.tBake": "T#40m", "PLC_PRG.sLabel": "'Rye'"}


def made(page: Page, server: Server, definition: dict[str, Any] | None = None) -> str:
    """A project with a recipe definition Bread; its path."""
    project = fetch(page, server, "POST", "/projects", data={"name": PROJECT})
    path = f"/projects/{project['id']}"
    objects = fetch(page, server, "GET", f"{path}/objects")
    application = next(item for item in objects if item["kind"] == "application")

    def add(kind: str, name: str, parent: str, data: Any = None) -> dict[str, Any]:
        body = {"kind": kind, "name": name, "parent_id": parent, "data": data}
        return dict(fetch(page, server, "POST", f"{path}/objects", data=body))

    manager = add("recipe_manager", "Recipe Manager", application["id"])
    add("recipe_definition", "Bread", manager["id"], definition)
    program = next(item for item in objects if item["name"] == "PLC_PRG")
    data = {"declaration": DECLARATION, "implementation": "xSteam := rTemperature > 200;"}
    body = {"base_revision": program["revision"], "data": data}
    fetch(page, server, "PUT", f"{path}/objects/{program['id']}", data=body)
    page.reload()
    open_project(page, PROJECT)
    open_object(page, "Bread")
    return path


def filled() -> dict[str, Any]:
    rows: list[dict[str, Any]] = [{"path": path} for path in VALUES]
    rows[0] |= {"name": "Temperature", "minimum": "20.0", "maximum": "250.0", "comment": "°C"}
    rows[1] |= {"name": "Time", "maximum": "T#2h"}
    light = dict(zip(VALUES, ("900", "T#20m", "'White'"), strict=True))
    recipes = [{"name": "Rye", "values": VALUES}, {"name": "White", "values": light}]
    return {"variables": rows, "recipes": recipes}


def panel(page: Page) -> Locator:
    return page.locator(".dv-active-group [data-panel-id]:visible").last


def cell(page: Page, path: str, column: str) -> Locator:
    """A cell of the table by its row and the title of its column."""
    grid = panel(page).get_by_role("grid")
    titles = [title.strip() for title in grid.get_by_role("columnheader").all_inner_texts()]
    row = grid.get_by_role("row").filter(has=page.get_by_text(path, exact=True))
    return row.get_by_role("gridcell").nth(titles.index(column))


def recipe_of(page: Page, server: Server, project: str, name: str) -> dict[str, str]:
    objects = fetch(page, server, "GET", f"{project}/objects")
    item = next(one for one in objects if one["kind"] == "recipe_definition")
    data = fetch(page, server, "GET", f"{project}/objects/{item['id']}")["data"]
    (found,) = (one["values"] for one in data["recipes"] if one["name"] == name)
    return dict(found)


def test_variables_and_recipes_are_added(page: Page, server: Server) -> None:
    project = made(page, server)
    found = panel(page)
    expect(found.get_by_text("No variables yet")).to_be_visible()
    found.get_by_role("toolbar").get_by_role("button", name="Add Variables").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("textbox").fill("plc step")
    rows = dialog.get_by_role("row").filter(has_text="aStep")
    expect(rows).to_have_count(4)  # the array as a whole, too
    rows.filter(has_text="aStep[1]").click()
    rows.filter(has_text="aStep[3]").click(modifiers=["Control"])
    with objects_stored(page):
        dialog.get_by_role("button", name="Add", exact=True).click()
    expect(cell(page, "PLC_PRG.aStep[3]", "Type")).to_have_text("INT")
    found.get_by_role("button", name="Add Recipe").click()
    page.get_by_role("dialog").get_by_label("Name").fill("Rye")
    with objects_stored(page):
        page.keyboard.press("Enter")
    cell(page, "PLC_PRG.aStep[1]", "Rye").dblclick()
    page.keyboard.type("5 +")
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert").filter(has_text="'5 +' is no value")).to_be_visible()
    page.keyboard.press("Control+A")
    with objects_stored(page):
        page.keyboard.type("17")
        page.keyboard.press("Enter")
    assert recipe_of(page, server, project, "Rye") == {"PLC_PRG.aStep[1]": "17"}
    with objects_stored(page):
        cell(page, "PLC_PRG.aStep[3]", "Variable").click()
        page.keyboard.press("Escape")
        page.keyboard.press("Delete")
    expect(found.get_by_text("PLC_PRG.aStep[3]", exact=True)).to_have_count(0)


def test_recipes_and_the_controller(page: Page, server: Server) -> None:
    project = made(page, server, filled())
    found = panel(page)
    expect(found.get_by_role("button", name="Write", exact=True)).to_have_attribute("aria-disabled", "true")
    log_in(page)
    expect(cell(page, "PLC_PRG.rTemperature", "Current value")).to_have_text("180.0")
    expect(cell(page, "PLC_PRG.rTemperature", "Rye").locator("span[class*=differs]")).to_have_text("210.5")
    cell(page, "PLC_PRG.rTemperature", "Rye").click()
    page.keyboard.press("Escape")
    found.get_by_role("button", name="Write", exact=True).click()
    expect(page.get_by_text("Rye: 3 values written")).to_be_visible()
    expect(cell(page, "PLC_PRG.rTemperature", "Current value")).to_have_text("210.5")
    expect(cell(page, "PLC_PRG.sLabel", "Current value")).to_have_text("'Rye'")
    expect(cell(page, "PLC_PRG.rTemperature", "Rye").locator("span[class*=differs]")).to_have_count(0)
    found.get_by_label("Recipe", exact=True).click()
    page.get_by_role("option", name="White").click()
    found.get_by_role("button", name="Write", exact=True).click()
    expect(page.get_by_text("Beyond their limits, and set to them: PLC_PRG.rTemperature.")).to_be_visible()
    expect(cell(page, "PLC_PRG.rTemperature", "Current value")).to_have_text("250.0")
    found.get_by_role("button", name="Read", exact=True).click()
    expect(cell(page, "PLC_PRG.rTemperature", "White")).to_have_text("250.0")
    assert recipe_of(page, server, project, "White") == {
        "PLC_PRG.rTemperature": "250.0",
        "PLC_PRG.tBake": "T#20m",
        "PLC_PRG.sLabel": "'White'",
    }


def test_files(page: Page, server: Server, tmp_path: Path) -> None:
    project = made(page, server, filled())
    found = panel(page)
    found.get_by_role("button", name="Recipes").click()
    page.get_by_role("menuitem", name="Import Recipe").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_label("Text").fill("PLC_PRG.rTemperature 5")
    dialog.get_by_role("button", name="Import", exact=True).click()
    expect(dialog.get_by_role("alert")).to_contain_text("line 1")
    file = tmp_path / "Oat.Bread.txtrecipe"
    file.write_text("PLC_PRG.rTemperature:=99.5\nPLC_PRG.other:=1\n")
    dialog.locator("input[type=file]").set_input_files(file)
    dialog.get_by_label("Into").click()
    page.get_by_role("option", name="A new recipe").click()
    with objects_stored(page):
        dialog.get_by_role("button", name="Import", exact=True).click()
    expect(page.get_by_text("Not in the definition: PLC_PRG.other.")).to_be_visible()
    assert recipe_of(page, server, project, "Oat") == {"PLC_PRG.rTemperature": "99.5"}
    found.get_by_label("Recipe", exact=True).click()
    page.get_by_role("option", name="Rye").click()
    found.get_by_role("button", name="Recipes").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name="Export Recipe").click()
    assert download.value.suggested_filename == "Rye.Bread.txtrecipe"
    lines = Path(download.value.path()).read_text().splitlines()
    assert lines == [f"{path}:={value}" for path, value in VALUES.items()]


def test_the_manager_shows_a_line_of_its_files(page: Page, server: Server) -> None:
    made(page, server, filled())
    open_object(page, "Recipe Manager")
    found = panel(page)
    expect(found.get_by_text("PLC_PRG.rTemperature:=180.0")).to_be_visible()
    found.get_by_label("Column 3").click()
    with objects_stored(page):
        page.get_by_role("option", name="Comment").click()
    expect(found.get_by_text("PLC_PRG.rTemperature:=180.0:=°C")).to_be_visible()
    found.get_by_label("Folder").fill("../x")
    expect(found.get_by_role("alert")).to_contain_text("below that of the files")
    found.get_by_role("button", name="Bread").click()
    expect(page.locator(".dv-tab").filter(has_text=re.compile("^Bread"))).to_be_visible()


def test_files_of_the_controller_are_saved_changed_loaded_and_deleted(page: Page, server: Server) -> None:
    """Save, load what somebody else has written there, delete."""
    project = made(page, server, filled())
    log_in(page)

    def files() -> Locator:
        page.get_by_role("button", name="Recipes", exact=True).click()
        page.get_by_role("menuitem", name="Recipe Files in the Controller").click()
        return page.get_by_role("dialog", name="Recipe Files in the Controller")

    page.get_by_label("Recipe", exact=True).last.click()
    page.get_by_role("option", name="Rye").click()
    dialog = files()
    expect(dialog.get_by_text("The controller has no file of this definition")).to_be_visible()
    dialog.get_by_role("button", name="Save 'Rye' in the controller").click()
    row = dialog.get_by_role("row").filter(has_text="Rye.Bread.txtrecipe")
    expect(row).to_be_visible()
    objects = fetch(page, server, "GET", f"{project}/objects")
    definition = next(item["id"] for item in objects if item["name"] == "Bread")
    at = f"/runtimes/local/recipes/files/Rye?project_id={project.split('/')[-1]}&definition_id={definition}"
    stored = fetch(page, server, "GET", at).decode()
    assert "PLC_PRG.rTemperature:=210.5" in stored
    fetch(page, server, "PUT", at, data={"text": stored.replace("210.5", "199.5")})
    row.click()
    dialog.get_by_role("button", name="Load into the project").click()
    expect(dialog).to_have_count(0)
    expect(page.get_by_role("gridcell", name="199.5")).to_be_visible()
    dialog = files()
    dialog.get_by_role("row").filter(has_text="Rye.Bread.txtrecipe").click()
    dialog.get_by_role("button", name="Delete the file in the controller").click()
    question = page.get_by_role("dialog", name="Delete 'Rye.Bread.txtrecipe' in the controller?")
    question.get_by_role("button", name="Delete", exact=True).click()
    expect(dialog.get_by_text("The controller has no file of this definition")).to_be_visible()


def test_an_array_is_added_whole(page: Page, server: Server) -> None:
    made(page, server)
    page.get_by_role("button", name="Add Variables").first.click()
    dialog = page.get_by_role("dialog", name="Add Variables")
    dialog.get_by_role("textbox").fill("plc_prg.astep")
    whole = dialog.get_by_role("row").filter(has_text="all members")
    expect(whole).to_contain_text("PLC_PRG.aStep")
    whole.click()
    dialog.get_by_role("button", name="Add", exact=True).click()
    expect(dialog).to_have_count(0)
    for number in (1, 2, 3):
        expect(page.get_by_role("gridcell", name=f"PLC_PRG.aStep[{number}]").first).to_be_visible()
