"""An object of every kind, every template and every language that the server offers, and its editor."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import Any

from playwright.sync_api import Locator, Page, expect

from .api import example, fetch
from .conftest import Server
from .ui import SOURCES, Ui

WITHOUT_EDITOR = frozenset({"folder", "plc_logic"})
"""Rows of the tree that only hold others."""

CONTENT: dict[tuple[str, str | None, str | None], dict[str, str]] = {
    ("pou", "program", "IL"): {
        "declaration": "PROGRAM {name}\nVAR\n    xRun : BOOL; // Machine runs\n    iCount : INT;\nEND_VAR",
        "implementation": "        LD      iCount\n        ADD     1\n        ST      iCount\n",
    },
    ("pou", "function", "ST"): {
        "declaration": "FUNCTION {name} : INT\nVAR_INPUT\n    iLeft : INT;\n    iRight : INT;\nEND_VAR",
        "implementation": "{name} := iLeft + iRight; // Sum",
    },
    ("interface", None, None): {"declaration": "INTERFACE {name}"},
}
"""What new objects hold where the template is too bare to show anything."""


@dataclass(frozen=True)
class Made:
    """An object in the tree that is to be opened."""

    id: str
    name: str
    owner: str
    """Name of the object above it."""
    kind: str
    shape: str
    """Kind, template and language: what makes its editor another one."""


def every_object(page: Page, server: Server) -> list[Made]:
    """One object of each kind, template and language in the example; what it lacks is added to it."""
    project = _Example(page, server, example(page, server))
    found = []
    for rule in project.rules:
        for subkind, language in product(rule["subkinds"] or [None], rule["languages"] or [None]):
            item = project.item(rule, subkind, language)
            shape = " ".join(filter(None, (rule["kind"], subkind, language)))
            owner = project.name(item["parent_id"])
            found.append(Made(item["id"], item["name"], owner, rule["kind"], shape))
    assert len(found) >= 20
    return found


class _Example:
    """The example project, to be asked for objects of a shape."""

    def __init__(self, page: Page, server: Server, path: str) -> None:
        self.path = f"{path}/objects"
        self.fetch = partial(fetch, page, server)
        self.rules: list[Any] = self.fetch("GET", "/placement")

    def item(self, rule: Any, subkind: str | None, language: str | None) -> Any:
        """One that is there, or a new one."""
        for item in self.objects(rule["kind"]):
            if subkind in (None, item["subkind"]) and language in (None, self.language(item)):
                return item
        if rule["naming"] == "fixed" and language is not None:
            return self._converted(rule, language)
        order = {"kind": rule["kind"], "subkind": subkind, "language": language, "name": None}
        made = self.fetch("POST", self.path, data=order | {"parent_id": self._place(rule)})
        content = CONTENT.get((rule["kind"], subkind, language), {})
        return self._changed(
            made, {part: text.replace("{name}", made["name"]) for part, text in content.items()}
        )

    def objects(self, kind: str | None = None) -> list[Any]:
        return [one for one in self.fetch("GET", self.path) if kind in (None, one["kind"])]

    def name(self, object_id: str | None) -> str:
        return next((str(one["name"]) for one in self.objects() if one["id"] == object_id), "")

    def language(self, item: Any) -> str | None:
        data = self.fetch("GET", f"{self.path}/{item['id']}")["data"]
        return str(data["language"]) if "language" in data else None

    def _converted(self, rule: Any, language: str | None) -> Any:
        """What comes along with a new parent, in another language: no two of its kind fit below one."""
        parent = rule["places"][0].partition(".")[0]
        owner = next(one for one in self.rules if one["kind"] == parent)
        order = {"kind": parent, "subkind": None, "language": None, "name": None}
        above = self.fetch("POST", self.path, data=order | {"parent_id": self._place(owner)})
        child = next(one for one in self.objects(rule["kind"]) if one["parent_id"] == above["id"])
        return self._changed(self.fetch("GET", f"{self.path}/{child['id']}"), {"language": language})

    def _changed(self, item: Any, change: dict[str, Any]) -> Any:
        if not change:
            return item
        body = {"base_revision": item["revision"], "data": item["data"] | change}
        return self.fetch("PUT", f"{self.path}/{item['id']}", data=body)

    def _place(self, rule: Any) -> str | None:
        """An object that one of the kind may be below; null for a root."""
        for place in sorted(rule["places"]):
            parent, _, subkind = place.rstrip("/").partition(".")
            for item in self.objects(parent):
                if subkind in ("*", item["subkind"] or ""):
                    return str(item["id"])
        return None


def shown_name(ui: Ui, item: Made) -> str:
    """As the tree shows it: names that the system gives are in the language of the user."""
    descriptor = (SOURCES / "kinds" / item.kind / "index.tsx").read_text(encoding="utf-8")
    return ui.text(f"kind.{item.kind}") if "fixedName" in descriptor else item.name


def open_editors(ui: Ui, objects: list[Made]) -> Iterator[tuple[Made, Locator]]:
    """Opens the editor of one after the other by its name."""
    page = ui.page
    for item in objects:
        if item.kind in WITHOUT_EDITOR:
            continue
        name = shown_name(ui, item)
        page.keyboard.press("Control+p")
        page.get_by_role("combobox", name=ui.name("palette.objects")).fill(name)
        options = page.get_by_role("option").filter(has=page.get_by_text(name, exact=True))
        options.first.wait_for()
        several = options.count() > 1
        (options.filter(has_text=re.compile(rf"\b{item.owner}\b")) if several else options).first.click()
        panel = page.locator(f"[data-panel-id*='{item.id}']:visible")
        expect(panel).to_be_visible()
        expect(panel.locator("[aria-busy]")).to_have_count(0)
        page.wait_for_timeout(250)
        yield item, panel
