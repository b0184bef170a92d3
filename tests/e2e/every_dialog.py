"""The way to every dialog: each tour opens some, gives the key of the title, and finds it closed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

from playwright.sync_api import FilePayload, Locator, Page, Route, expect

from .api import example, fetch, write
from .conftest import Server
from .test_libraries import library_file
from .ui import Ui
from .workbench import log_in, open_object, open_project, tree_item

Act = Callable[[Ui, Server], Iterator[str]]


@dataclass(frozen=True)
class Tour:
    """Opens one dialog after the other."""

    name: str
    opens: frozenset[str]
    """Keys of the titles it gives."""
    start: Act


TOURS: list[Tour] = []


def tour(*opens: str) -> Callable[[Act], Act]:
    """Makes an act one of the tours."""

    def add(act: Act) -> Act:
        TOURS.append(Tour(act.__name__, frozenset(opens), act))
        return act

    return add


@tour("systemEvent.add")
def system_events(ui: Ui, server: Server) -> Iterator[str]:
    """A function for an event of the controller."""
    open_object(ui.page, "Task Configuration")
    ui.page.get_by_role("tab", name=ui.name("taskConfiguration.systemEvents")).click()
    ui.button("systemEvent.add").click()
    yield "systemEvent.add"


@tour(
    "command.options",
    "command.password",
    "command.shortcuts",
    "command.about",
    "users.add",
    "users.deleteTitle",
    "users.signOutTitle",
    "command.users",
)
def accounts(ui: Ui, server: Server) -> Iterator[str]:
    """What is set for people, and what administrators do with others."""
    other = fetch(ui.page, server, "POST", "/users", data=NEW_USER)
    try:
        tree_item(ui.page, "PLC_PRG").click()
        for key in ("command.options", "command.password", "command.shortcuts", "command.about"):
            ui.command(key)
            yield key
        ui.command("command.users")
        dialog = ui.dialog("command.users")
        ui.button("users.add", dialog).click()
        yield "users.add"
        for act, title in (("users.delete", "users.deleteTitle"), ("users.signOut", "users.signOutTitle")):
            dialog.get_by_role("button", name=ui.text(act, name=NEW_USER["username"])).click()
            yield title
        yield "command.users"
    finally:
        fetch(ui.page, server, "DELETE", f"/users/{other['id']}")


NEW_USER = {"username": "grace", "password": "a long enough secret", "role": "operator"}


@tour(
    "libraries.uninstallTitle",
    "command.libraryRepository",
    "command.saveLibrary",
    "library.add",
    "library.propertiesOf",
)
def libraries(ui: Ui, server: Server) -> Iterator[str]:
    """The repository, a project as a library, and the references of an application."""
    page = ui.page
    upload = {"file": dict(library_file("1.0.0"))}
    fetch(page, server, "POST", "/libraries", multipart=upload)
    page.reload()  # it is not told of what others install
    tree_item(page, "PLC_PRG").click()
    ui.command("command.libraryRepository")
    dialog = ui.dialog("command.libraryRepository")
    dialog.get_by_role("row").filter(has_text="Packing").click()
    ui.button("libraries.uninstall", dialog).click()
    yield "libraries.uninstallTitle"
    yield "command.libraryRepository"
    fetch(page, server, "DELETE", "/libraries/Plant/1.0.0")
    ui.command("command.saveLibrary")
    yield "command.saveLibrary"
    tree_item(page, ui.text("kind.library_manager")).dblclick()
    panel = ui.panel()
    ui.button("library.add", panel).click()
    yield "library.add"
    panel.get_by_role("row").nth(1).click()
    ui.button("library.properties", panel).click()
    yield "library.propertiesOf"


@tour(
    "addObject.titleAt",
    "addObject.title",
    "properties.title",
    "command.projectInformation",
    "command.projectSettings",
    "history.titleObject",
    "history.title",
    "command.print",
    "command.export",
    "command.staticAnalysisSettings",
    "command.sourceUpload",
    "clean.title",
    "clean.all.title",
    "command.newProject",
    "delete.title",
    "delete.titleMany",
)
def project(ui: Ui, server: Server) -> Iterator[str]:
    """The project as a whole and the objects of its tree."""
    page = ui.page
    path = example(page, server)
    fetch(
        page, server, "POST", f"{path}/objects", data={"parent_id": None, "kind": "gvl", "name": "GVL_Shared"}
    )
    tree_item(page, "PLC_PRG").click()
    for command, key in (
        ("command.addObject", "addObject.titleAt"),
        ("command.properties", "properties.title"),
        ("command.projectInformation", "command.projectInformation"),
        ("command.projectSettings", "command.projectSettings"),
        ("command.history", "history.titleObject"),
        ("command.deletedObjects", "history.title"),
        ("command.print", "command.print"),
        ("command.export", "command.export"),
        ("command.staticAnalysisSettings", "command.staticAnalysisSettings"),
        ("command.sourceUpload", "command.sourceUpload"),
        ("command.clean", "clean.title"),
        ("command.cleanAll", "clean.all.title"),
        ("command.newProject", "command.newProject"),
    ):
        ui.command(command)
        yield key
    page.keyboard.press("Delete")
    yield "delete.title"
    tree_item(page, "GVL_IO").click(modifiers=["Control"])
    page.keyboard.press("Delete")
    yield "delete.titleMany"
    page.locator(".dv-tab").filter(has_text=ui.name("panel.pous")).click()
    tree_item(page, "GVL_Shared").click()
    ui.command("command.addObject")
    yield "addObject.title"


@tour("scripts.trustTitle")
def scripts(ui: Ui, server: Server) -> Iterator[str]:
    """A text that somebody else may have written, before it runs."""
    page = ui.page
    path = f"{example(page, server)}/objects"
    text = {"text": "tappet.log('mine')"}
    own = fetch(
        page, server, "POST", path, data={"parent_id": None, "kind": "script", "name": "Own", "data": text}
    )
    copied = fetch(page, server, "POST", f"{path}/{own['id']}/copy", data={"parent_id": None})
    tree_item(page, "PLC_PRG").click()
    title = ui.text("scripts.run", name=copied["name"])
    page.keyboard.press("Control+Shift+P")
    page.get_by_role("combobox").and_(page.get_by_label(ui.text("palette.commands"))).fill(title)
    page.get_by_role("option").filter(has=page.get_by_text(title, exact=True)).first.click()
    yield "scripts.trustTitle"


@tour(
    "runtime.removeTitle",
    "runtime.add",
    "task.addProgram",
    "task.replaceProgram",
    "unsaved.title",
    "conflict.title",
)
def forms(ui: Ui, server: Server) -> Iterator[str]:
    """Dialogs of forms, and what comes when two people change one."""
    page = ui.page
    _forget_runtimes(page, server)
    tree_item(page, "Tappet Soft PLC").dblclick()
    fetch(page, server, "POST", "/runtimes", data=NO_RUNTIME)
    remove = page.get_by_role("button", name=ui.text("runtime.remove", name=NO_RUNTIME["name"]))
    remove.click()
    yield "runtime.removeTitle"
    ui.button("runtime.add").click()
    yield "runtime.add"
    _forget_runtimes(page, server)
    open_object(page, "MainTask")
    panel = ui.panel()
    ui.button("task.addProgram", panel).click()
    yield "task.addProgram"
    ui.button("task.replaceProgram", panel).click()
    yield "task.replaceProgram"
    with held_saves(page) as held:
        field = panel.get_by_role("spinbutton").or_(panel.get_by_role("textbox")).first
        field.click()
        page.keyboard.press("End")
        page.keyboard.type("0")
        _until(page, lambda: bool(held))
        page.keyboard.press("Alt+w")
        yield "unsaved.title"
        _change(page, server, "MainTask", {"priority": 5})
        held.pop().continue_()
        yield "conflict.title"


NO_RUNTIME = {"name": "Hall 2", "url": "ws://127.0.0.1:9", "token": "none"}


@tour(
    "st.renameTitle",
    "st.autoDeclareTitle",
    "assistant.title",
    "doc.conflictTitle",
    "decl.attributesTitle",
    "decl.editHeader",
    "decl.arrayWizard",
    "decl.initialTitle",
)
def texts(ui: Ui, server: Server) -> Iterator[str]:
    """Dialogs of texts and of tables of declarations."""
    page = ui.page
    open_object(page, "PLC_PRG")
    editor = page.locator(".monaco-editor:visible").last
    expect(editor).to_contain_text("xSafe")
    editor.locator(".view-line").nth(1).get_by_text("xSafe").first.click()
    for key, title in (
        ("Control+F2", "st.renameTitle"),
        ("Shift+F2", "st.autoDeclareTitle"),
        ("F2", "assistant.title"),
    ):
        page.keyboard.press(key)
        yield title
    with held_saves(page) as held:
        page.keyboard.press("Control+End")
        page.keyboard.type(" ")
        _until(page, lambda: bool(held))
        write(page, server, example(page, server), "PLC_PRG", "// Mode", "// Modes")
        held.pop().continue_()
        ui.button("doc.compare").click()
        yield "doc.conflictTitle"
    ui.button("doc.compare").click()
    ui.button("doc.takeTheirs", ui.dialog()).click()
    ui.closed()
    ui.button("decl.viewTable").click()
    panel = ui.panel()
    panel.get_by_title(ui.text("decl.editHeader")).click()
    ui.button("decl.attributesButton", ui.dialog()).click()
    yield "decl.attributesTitle"
    yield "decl.editHeader"
    _cell(ui, panel, "fbConveyor", "decl.column.type").dblclick()
    ui.button("decl.chooseType", panel).click()
    page.get_by_role("menuitem", name=ui.name("decl.arrayWizard")).click()
    yield "decl.arrayWizard"
    _cell(ui, panel, "fbFiller", "decl.column.initial").dblclick()
    panel.get_by_title(ui.text("decl.initialDialog")).click()
    yield "decl.initialTitle"
    ui.button("decl.viewText").click()


@tour(
    "exchange.compareTitle",
    "command.import",
    "exchange.reportOf",
    "command.compare",
    "compare.title",
    "history.revertTitle",
    "history.titleObject",
)
def comparisons(ui: Ui, server: Server) -> Iterator[str]:
    """Files and other projects beside the present one, and the way back in the history."""
    page = ui.page
    path = example(page, server)
    write(page, server, path, "PLC_PRG", "// Mode", "// Modes")
    fetch(page, server, "POST", "/projects", data={"name": "Another line"})
    tree_item(page, "Alarms").click()
    ui.command("command.import")
    dialog = ui.dialog("command.import")
    dialog.locator("input[type=file]").first.set_input_files([ALARM])
    ui.button("exchange.next", dialog).click()
    ui.button("exchange.compare", dialog).click()
    yield "exchange.compareTitle"
    yield "command.import"
    ui.command("command.import")
    dialog.locator("input[type=file]").first.set_input_files([ALARM])
    ui.button("exchange.next", dialog).click()
    ui.button("exchange.import", dialog).click()
    yield "exchange.reportOf"
    ui.command("command.compare")
    yield "command.compare"
    ui.command("command.compare")
    dialog = ui.dialog("command.compare")
    dialog.get_by_role("combobox").click()
    page.get_by_role("option", name="Another line").click()
    ui.button("compare.compare", dialog).click()
    yield "compare.title"
    tree_item(page, "PLC_PRG").click()
    ui.command("command.history")
    dialog = ui.dialog("history.titleObject")
    dialog.get_by_role("option").last.click()
    ui.button("history.revert", dialog).click()
    yield "history.revertTitle"
    yield "history.titleObject"


ALARM: FilePayload = {
    "name": "Alarm.st",
    "mimeType": "text/plain",
    "buffer": b"FUNCTION_BLOCK FB_Alarm\nVAR_INPUT\n    xCause : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n",
}


@tour(
    "st.instanceTitle",
    "reset.warm.title",
    "reset.cold.title",
    "reset.origin.title",
    "download.title",
    "source.downloadTitle",
    "source.ask",
    "login.title",
    "login.buildErrors",
    "runtime.choose",
    "command.pageSetup",
    "versions.title",
)
def online(ui: Ui, server: Server) -> Iterator[str]:
    """What is asked before something happens to a machine."""
    page = ui.page
    path = example(page, server)
    running = ui.text("runtime.state.run")
    tree_item(page, "PLC_PRG").click()
    log_in(page, running)
    tree_item(page, "Stations").click()
    page.keyboard.press("ArrowRight")
    tree_item(page, "FB_Filler").dblclick()
    yield "st.instanceTitle"
    tree_item(page, "PLC_PRG").click()
    for command, title in (
        ("command.reset.warm", "reset.warm.title"),
        ("command.reset.cold", "reset.cold.title"),
        ("command.reset.origin", "reset.origin.title"),
        ("command.download", "download.title"),
        ("command.sourceDownload", "source.downloadTitle"),
        ("command.versions", "versions.title"),
        ("command.pageSetup", "command.pageSetup"),  # which nobody can make while logged in
    ):
        ui.command(command)
        yield title
    _change(page, server, "Application", {"source_download": "prompt"})
    ui.command("command.download")
    ui.dialog("download.title").locator("button[type=submit]").click()
    yield "source.ask"
    expect(ui.page.get_by_text(ui.text("login.downloaded", name="Application")).first).to_be_visible()
    ui.command("command.logout")
    fetch(page, server, "POST", "/runtimes", data=NO_RUNTIME)
    device = _change(page, server, "Tappet Soft PLC", {"runtime_id": "gone", "simulated": False})
    page.reload()  # else the page may log in before it hears of the change
    tree_item(page, "PLC_PRG").click()
    page.keyboard.press("Alt+F8")
    yield "runtime.choose"
    _forget_runtimes(page, server)
    _change(page, server, device["name"], {"runtime_id": "local"})
    page.reload()
    for old, new, title in (
        ("xStarted := TRUE;", "xStarted := TRUE AND TRUE;", "login.title"),
        ("xStarted := TRUE AND TRUE;", "xStarted := ;", "login.buildErrors"),
    ):
        write(page, server, path, "PLC_PRG", old, new)
        tree_item(page, "PLC_PRG").click()
        page.keyboard.press("Alt+F8")
        yield title


@tour(
    "project.deleteTitle",
    "command.newProject",
)
def start_page(ui: Ui, server: Server) -> Iterator[str]:
    """Dialogs of the page before a project is open."""
    page = ui.page
    fetch(page, server, "POST", "/projects", data={"name": "Another line"})
    ui.command("command.closeProject")
    expect(page.get_by_role("button", name=ui.name("command.newProject")).first).to_be_visible()
    page.reload()
    page.get_by_role("button", name=ui.text("start.more", name="Another line")).click()
    page.get_by_role("menuitem", name=ui.name("action.delete")).click()
    yield "project.deleteTitle"
    page.get_by_role("button", name=ui.name("command.newProject")).first.click()
    yield "command.newProject"
    open_project(page)


@contextmanager
def held_saves(page: Page) -> Iterator[list[Route]]:
    """Saves of objects by the page wait until they are let go on; what waits at the end goes on."""
    held: list[Route] = []

    def hold(route: Route) -> None:
        if route.request.method == "PUT":
            held.append(route)
        else:
            route.continue_()

    page.route("**/objects/*", hold)
    yield held
    page.unroute("**/objects/*")
    for route in held:
        route.continue_()


def _until(page: Page, come: Callable[[], bool]) -> None:
    for _ in range(300):
        if come():
            return
        page.wait_for_timeout(100)
    raise AssertionError("it does not come")


def _change(page: Page, server: Server, name: str, change: dict[str, Any]) -> Any:
    """Data of an object that somebody else changes."""
    path = example(page, server)
    ask = partial(fetch, page, server)
    item = next(one for one in ask("GET", f"{path}/objects") if one["name"] == name)
    where = f"{path}/objects/{item['id']}"
    data = ask("GET", where)["data"] | change
    return ask("PUT", where, data={"base_revision": item["revision"], "data": data})


def _forget_runtimes(page: Page, server: Server) -> None:
    for runtime in fetch(page, server, "GET", "/runtimes"):
        if runtime["name"] == NO_RUNTIME["name"]:
            fetch(page, server, "DELETE", f"/runtimes/{runtime['id']}")


def _cell(ui: Ui, panel: Locator, name: str, column: str) -> Locator:
    """The cell of a variable in the table of declarations."""
    titles = panel.get_by_role("columnheader").all_inner_texts()
    at = [title.strip() for title in titles].index(ui.text(column))
    row = panel.get_by_role("row").filter(has=ui.page.get_by_text(name, exact=True)).first
    return row.get_by_role("gridcell").nth(at)
