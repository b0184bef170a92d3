"""The workbench in one of its languages: texts by their keys, commands by their titles, what is seen."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from playwright.sync_api import Locator, Page, expect

SOURCES = Path(__file__).parents[2] / "frontend/src"
VALUE = re.compile(r"\\{\\{\w+\\}\\}")

SEEN = """() => {
    const seen = new Map();
    const add = (text, node) => {
        const short = text.replace(/\\s+/g, ' ').trim();
        if (short !== '' && !seen.has(short)) seen.set(short, node.outerHTML.slice(0, 160));
    };
    const shown = (node) => node.getClientRects().length > 0;
    // Programs and what the server documents are in the language of whoever wrote them.
    const code = '.view-lines, .view-zones, [lang], iframe, script, style';
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const parent = walker.currentNode.parentElement;
        if (parent.closest(code) === null && shown(parent)) add(walker.currentNode.data, parent);
    }
    for (const node of document.body.querySelectorAll('*')) {
        if (node.closest(code) !== null || !shown(node)) continue;
        for (const name of ['aria-label', 'title', 'placeholder', 'alt', 'aria-description',
            'aria-roledescription', 'aria-valuetext']) {
            if (node.hasAttribute(name)) add(node.getAttribute(name), node);
        }
    }
    add(document.title, document.head);
    return [...seen];
}"""
"""Texts on the screen, also those that only a pointer or a screen reader finds, each with where it stands."""

AREA = """() => {
    const area = document.activeElement.closest(
        '[role=dialog], [role=menubar], [role=toolbar], [data-panel-id], footer[role=status]');
    return area === null ? '' : area.dataset.panelId ?? area.getAttribute('role');
}"""
"""Where the keyboard is."""


@cache
def texts(language: str) -> Mapping[str, str]:
    """All texts of a language by their keys."""
    found: dict[str, str] = {}
    for path in (*SOURCES.glob(f"i18n/{language}/*.json"), *SOURCES.glob(f"*/*/{language}.json")):
        found |= json.loads(path.read_text(encoding="utf-8"))
    return found


def pattern(language: str, key: str) -> str:
    """What matches a text whatever values it is given; without the ellipsis that menu entries end in."""
    text = texts(language)
    known = text.get(key) or text.get(f"{key}_other") or ""
    assert known, f"no text has the key {key}"
    return VALUE.sub(".*", re.escape(known.removesuffix("…")))


@dataclass
class Ui:
    """A page of the workbench in a language."""

    page: Page
    language: str

    def text(self, key: str, **values: str) -> str:
        """A text with its values."""
        known = texts(self.language)[key]
        return re.sub(r"\{\{(\w+)\}\}", lambda value: values[value[1]], known)

    def name(self, key: str) -> re.Pattern[str]:
        """The whole of a name, whatever values stand in it."""
        return re.compile(f"^{pattern(self.language, key)}…?$", re.DOTALL)

    def command(self, key: str, query: str | None = None) -> None:
        """Runs a command from the palette."""
        self.page.keyboard.press("Control+Shift+P")
        palette = self.page.get_by_role("combobox").and_(
            self.page.get_by_label(self.text("palette.commands"))
        )
        title = self.text(key)
        palette.fill(query or title)
        entry = self.page.get_by_role("option").filter(has=self.page.get_by_text(title, exact=True)).first
        entry.click()

    def dialog(self, key: str | None = None) -> Locator:
        """The dialog in front, by the key of its title."""
        found = (
            self.page.get_by_role("dialog", name=self.name(key)) if key else self.page.get_by_role("dialog")
        )
        return found.last

    def button(self, key: str, inside: Locator | None = None, **values: Any) -> Locator:
        place = inside if inside is not None else self.page
        return place.get_by_role("button", name=self.name(key)).last

    def panel(self) -> Locator:
        """The editor in front."""
        return self.page.locator(".dv-active-group [data-panel-id]:visible").last

    def closed(self) -> None:
        """Waits until no dialog is there."""
        expect(self.page.get_by_role("dialog")).to_have_count(0)

    def area(self) -> str:
        """The area, panel or dialog that has the keyboard; empty when nothing has it."""
        found: str = self.page.evaluate(AREA)
        return found

    def seen(self) -> dict[str, str]:
        """Texts on the screen and the elements they stand in."""
        found: list[tuple[str, str]] = self.page.evaluate(SEEN)
        return dict(found)
