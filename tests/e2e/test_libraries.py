"""Library manager and repository: files installed, two versions in one application, placeholders, saving."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import FilePayload, Locator, Page, expect

from tappet.libraries import archive

from .workbench import (
    add_line,
    answer_to,
    choose_menu,
    delete_line,
    implementation,
    message_rows,
    open_object,
    open_panel,
    open_project,
    tree_item,
)

pytestmark = pytest.mark.e2e


def library_file(version: str, **facts: object) -> FilePayload:
    """A library 'Plant' with one function, documented, and one parameter."""
    text = (
        "(* Number of pallets for so many bottles. *)\nFUNCTION Pallets : INT\n"
        "VAR_INPUT\n    nBottles : INT; (* bottles to pack *)\nEND_VAR\n"
        "Pallets := nBottles / GVL_Pallets.cBottles;\nEND_FUNCTION\n"
    )
    parameters = (
        "{attribute 'qualified_only'}\n{attribute 'parameter_list'}\nVAR_GLOBAL CONSTANT\n"
        "    cBottles : INT := 40; // Bottles on a pallet\nEND_VAR\n"
    )
    described = {**archive.manifest("Plant", version, company="Works", description="Packing"), **facts}
    return {
        "name": f"plant-{version}.tappetlib",
        "mimeType": "application/zip",
        "buffer": archive.pack(described, {"Pallets": text, "GVL_Pallets": parameters}),
    }


@pytest.fixture(autouse=True)
def as_before(page: Page) -> Iterator[None]:
    """The account's server has no libraries of these tests, before and after."""
    forget = """async () => {
        const headers = {'X-Tappet-Client': '1'};
        for (const {name, version, removable} of await (await fetch('/api/v1/libraries')).json())
            if (removable) await fetch(`/api/v1/libraries/${name}/${version}`, {method: 'DELETE', headers});
    }"""
    page.evaluate(forget)
    yield
    page.evaluate(forget)


def repository(page: Page) -> Locator:
    choose_menu(page, "Tools", "Library Repository")
    dialog = page.get_by_role("dialog", name="Library Repository")
    expect(dialog.get_by_role("row", name="Standard").first).to_be_visible()
    return dialog


def install(page: Page, *files: FilePayload) -> None:
    dialog = repository(page)
    dialog.locator("input[type=file]").set_input_files(list(files))
    for file in files:
        version = file["name"].removeprefix("plant-").removesuffix(".tappetlib")
        expect(dialog.get_by_role("row").filter(has_text="Plant").filter(has_text=version)).to_be_visible()
    dialog.get_by_role("button", name="Close").last.click()


def manager(page: Page) -> Locator:
    """The editor with the libraries in use."""
    open_object(page, "Library Manager")
    table = page.get_by_role("grid", name="Libraries in use")
    expect(table.get_by_role("row", name="Standard").first).to_be_visible()
    return table


def add_library(page: Page, name: str) -> Locator:
    page.get_by_role("button", name="Add library").click()
    dialog = page.get_by_role("dialog", name="Add library")
    dialog.get_by_label("Search libraries").fill(name)
    dialog.get_by_role("row").filter(has_text=name).last.click()
    return dialog


def choose(page: Page, dialog: Locator, label: str, option: str) -> None:
    dialog.get_by_label(label, exact=True).click()
    page.get_by_role("option", name=option, exact=True).click()


def stored(page: Page) -> list[tuple[str, str, str]]:
    """Name, version and namespace of the references as the server has them."""
    found = page.evaluate(
        """async () => {
            const read = async (path) => (await fetch('/api/v1' + path)).json();
            const [project] = await read('/projects');
            const objects = await read(`/projects/${project.id}/objects`);
            const manager = objects.find((object) => object.kind === 'library_manager');
            return (await read(`/projects/${project.id}/objects/${manager.id}`)).data.references;
        }"""
    )
    return [(one["name"], one["version"], one["namespace"]) for one in found]


def wait_for_stored(page: Page, expected: tuple[str, str, str]) -> None:
    for _ in range(300):
        if expected in stored(page):
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"{expected} is not in {stored(page)}")


def test_two_versions_are_installed_used_side_by_side_and_uninstalled(page: Page) -> None:
    open_project(page)
    install(page, library_file("1.0.0.0"), library_file("2.0.0.0"))
    table = manager(page)
    dialog = add_library(page, "Plant")
    dialog.get_by_role("button", name="Add", exact=True).click()
    dialog = add_library(page, "Plant")
    expect(dialog.get_by_label("Namespace")).to_have_value("Plant2")
    choose(page, dialog, "Version", "1.0.0.0")
    dialog.get_by_role("button", name="Add", exact=True).click()
    rows = table.get_by_role("row").filter(has_text="Plant")
    expect(rows).to_have_count(2)
    expect(rows.nth(0)).to_contain_text("2.0.0.0")
    expect(rows.nth(1)).to_contain_text("1.0.0.0")
    wait_for_stored(page, ("Plant", "1.0.0.0", "Plant2"))
    namespace = rows.nth(1).get_by_label("Namespace of Plant")
    namespace.fill("Plant")
    expect(namespace).to_have_attribute("aria-invalid", "true")
    namespace.fill("OldPlant")
    namespace.press("Enter")
    wait_for_stored(page, ("Plant", "1.0.0.0", "OldPlant"))
    page.get_by_role("tree", name="Contents of Plant").get_by_text("Functions").dblclick()
    page.get_by_role("treeitem", name="Pallets").click()
    expect(page.get_by_role("article")).to_contain_text("bottles to pack")
    open_object(page, "PLC_PRG")
    add_line(page, implementation(page), "iLoaded := Plant.Pallets(80) + OldPlant.Pallets(40);")
    page.keyboard.press("Control+s")
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    report = built.value.json()
    assert [d["message"] for d in report["diagnostics"] if d["severity"] == "error"] == []
    dialog = repository(page)
    dialog.get_by_role("row").filter(has_text="Plant").filter(has_text="1.0.0.0").click()
    dialog.get_by_role("button", name="Uninstall").click()
    warning = page.get_by_role("dialog", name="Uninstall Plant 1.0.0.0?")
    expect(warning).to_contain_text("Bottling line")
    warning.get_by_role("button", name="Uninstall").click()
    expect(dialog.get_by_role("row").filter(has_text="Plant").filter(has_text="1.0.0.0")).to_have_count(0)
    dialog.get_by_role("row").filter(has_text="Standard").first.click()
    expect(dialog.get_by_role("button", name="Uninstall")).to_have_attribute("aria-disabled", "true")
    dialog.get_by_role("button", name="Close").last.click()
    page.locator(".dv-tab").filter(has_text="Library Manager").click()
    expect(rows.nth(1).get_by_label("This library is not installed")).to_be_visible()


def test_a_version_is_changed_and_what_a_library_needs_is_shown(page: Page) -> None:
    open_project(page)
    needs = [{"name": "Util", "version": "*"}]
    install(page, library_file("1.0.0.0", requires=needs), library_file("2.0.0.0", requires=needs))
    table = manager(page)
    add_library(page, "Plant").get_by_role("button", name="Add", exact=True).click()
    row = table.get_by_role("row").filter(has_text="Plant")
    row.get_by_label("Version of Plant").click()
    page.get_by_role("option", name="1.0.0.0").click()
    wait_for_stored(page, ("Plant", "1.0.0.0", ""))
    table.get_by_role("button", name="What Plant requires").click()
    brought = table.get_by_role("row").filter(has_text="Util").last
    expect(brought).to_be_visible()
    row.get_by_text("Works").click()
    page.get_by_role("button", name="Remove library").click()
    expect(row).to_have_count(0)
    for _ in range(300):
        if "Plant" not in {name for name, _, _ in stored(page)}:
            return
        page.wait_for_timeout(100)
    raise AssertionError("the reference is still stored")


def test_a_placeholder_has_a_name_and_a_resolution(page: Page) -> None:
    open_project(page)
    install(page, library_file("1.0.0.0"))
    table = manager(page)
    dialog = add_library(page, "Plant")
    dialog.get_by_label("As placeholder").click()
    dialog.get_by_label("Name of the placeholder").fill("Packing")
    expect(dialog.get_by_label("Resolved by")).to_contain_text("Plant")
    dialog.get_by_role("button", name="Add", exact=True).click()
    row = table.get_by_role("row").filter(has_text="Packing = Plant")
    expect(row).to_be_visible()
    expect(row.get_by_label("Namespace of Plant")).to_have_value("Packing")
    open_object(page, "PLC_PRG")
    add_line(page, implementation(page), "iLoaded := Packing.Pallets(80);")
    page.keyboard.press("Control+s")
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    assert built.value.json()["ok"]


def test_a_project_is_saved_as_library_unless_it_has_errors(page: Page, tmp_path: Path) -> None:
    open_project(page)
    tree_item(page, "Alarms").click()
    page.keyboard.press("ArrowRight")
    open_object(page, "FB_Alarm")
    add_line(page, implementation(page), "nNowhere := 1;")
    page.keyboard.press("Control+s")
    for _ in range(2):
        choose_menu(page, "File", "Save Project as Library")
        dialog = page.get_by_role("dialog", name="Save Project as Library")
        expect(dialog.get_by_label("Name", exact=True)).to_have_value("Bottling line")
        dialog.get_by_label("Version").fill("one")
        expect(dialog.get_by_label("Version")).to_have_attribute("aria-invalid", "true")
        dialog.get_by_label("Version").fill("1.0.0.0")
        dialog.get_by_label("Company").fill("Works")
        with answer_to(page, "/library") as answered:
            dialog.get_by_role("button", name="Save library").click()
        if answered.value.ok:
            break
        messages = open_panel(page, "Messages")
        expect(messages.get_by_role("row").filter(has_text="nNowhere").first).to_be_visible()
        page.locator(".dv-tab").filter(has_text="FB_Alarm").click()
        delete_line(page, implementation(page), 2)
        expect(implementation(page)).not_to_contain_text("nNowhere")
        page.keyboard.press("Control+s")
    else:
        raise AssertionError("the project was not saved as library: " + answered.value.text())
    dialog = repository(page)
    dialog.get_by_role("row").filter(has_text="Bottling line").click()
    with page.expect_download() as download:
        dialog.get_by_role("button", name=re.compile("Save file")).click()
    facts, texts = archive.read(Path(download.value.path()).rename(tmp_path / "x.tappetlib"))
    assert (facts["name"], facts["version"], facts["company"]) == ("Bottling line", "1.0.0.0", "Works")
    assert "FB_Alarm" in texts
    assert "PLC_PRG" not in texts


def errors_of_build(page: Page) -> list[str]:
    with answer_to(page, "/build") as built:
        page.keyboard.press("F11")
    return [d["message"] for d in built.value.json()["diagnostics"] if d["severity"] == "error"]


def test_a_parameter_of_a_library_gets_a_value_and_loses_it(page: Page) -> None:
    open_project(page)
    install(page, library_file("1.0.0.0"))
    manager(page)
    add_library(page, "Plant").get_by_role("button", name="Add", exact=True).click()
    page.get_by_role("tab", name="Library parameters").click()
    table = page.get_by_role("grid", name="Library parameters")
    row = table.get_by_role("row").filter(has_text="cBottles")
    expect(row).to_contain_text("Bottles on a pallet")
    row.get_by_text("cBottles").click()
    table.focus()
    page.keyboard.press("Enter")
    value = row.get_by_role("textbox", name="Value of GVL_Pallets.cBottles")
    expect(value).to_be_focused()
    expect(value).to_have_attribute("placeholder", "40")
    value.fill("'many'")
    value.press("Enter")
    expect(table).to_be_focused()
    (message,) = errors_of_build(page)
    assert "the value ''many'' does not suit the parameter 'cBottles' of type 'INT'" in message
    expect(message_rows(page).filter(has_text="does not suit the parameter")).to_be_visible()
    value.fill("2 * 12")
    value.press("Enter")
    assert errors_of_build(page) == []
    table.focus()
    page.keyboard.press("Delete")
    expect(value).to_have_value("")
    page.keyboard.press("Control+z")
    expect(value).to_have_value("2 * 12")
    page.keyboard.press("Control+y")
    expect(value).to_have_value("")
    assert errors_of_build(page) == []
