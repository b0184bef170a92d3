"""Tour of the dialogs of recipe definitions."""

from __future__ import annotations

from collections.abc import Iterator

from playwright.sync_api import expect

from .api import example, fetch
from .conftest import Server
from .every_dialog import tour
from .ui import Ui
from .workbench import log_in, open_object, tree_item


@tour(
    "recipes.addVariables",
    "recipes.addRecipe",
    "recipes.renameRecipe",
    "recipes.import",
    "recipes.files",
    "recipes.deleteFile",
)
def recipes(ui: Ui, server: Server) -> Iterator[str]:
    """What is asked for variables, for names of recipes, and for a file."""
    page = ui.page
    project = example(page, server)
    objects = fetch(page, server, "GET", f"{project}/objects")
    application = next(one for one in objects if one["kind"] == "application")
    manager = {"kind": "recipe_manager", "name": "Recipe Manager", "parent_id": application["id"]}
    made = fetch(page, server, "POST", f"{project}/objects", data=manager)
    data = {"recipes": [{"name": "Light"}]}
    definition = {"kind": "recipe_definition", "name": "RecipeTour", "parent_id": made["id"], "data": data}
    own = fetch(page, server, "POST", f"{project}/objects", data=definition)["id"]
    try:
        tree_item(page, "Recipe Manager").click()
        page.keyboard.press("ArrowRight")
        expect(tree_item(page, "RecipeTour")).to_be_visible()
        page.reload()  # as somebody finds it who has opened the manager before
        open_object(page, "RecipeTour")
        for key in ("recipes.addVariables", "recipes.addRecipe"):
            ui.button(key, ui.panel().get_by_role("toolbar")).click()
            yield key
            page.keyboard.press("Escape")
        for key in ("recipes.renameRecipe", "recipes.import"):
            ui.button("recipes.menu", ui.panel()).click()
            page.get_by_role("menuitem", name=ui.name(key)).click()
            yield key
            page.keyboard.press("Escape")
        log_in(page, ui.text("runtime.state.run"))
        at = f"/runtimes/local/recipes/files/Light?project_id={project.split('/')[-1]}&definition_id={own}"
        fetch(page, server, "PUT", at, data={"text": "PLC_PRG.iLoaded:=1\n"})
        ui.button("recipes.menu", ui.panel()).click()
        page.get_by_role("menuitem", name=ui.name("recipes.files")).click()
        dialog = ui.dialog("recipes.files")
        dialog.get_by_role("row").filter(has_text="Light.RecipeTour").click()
        ui.button("recipes.deleteFileThere", dialog).click()
        yield "recipes.deleteFile"
        yield "recipes.files"
        page.keyboard.press("Escape")
        page.keyboard.press("Control+F8")
    finally:
        fetch(page, server, "DELETE", f"{project}/objects/{made['id']}")
