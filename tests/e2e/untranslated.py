"""Texts of the workbench that are not in the language of its user."""

from __future__ import annotations

import re
from functools import cache

from playwright.sync_api import Page

from .api import example, fetch
from .conftest import Server
from .ui import Ui, texts

CHINESE = re.compile(r"[\u3400-\u9fff]")
WORD = re.compile(r"[A-Za-z][A-Za-z_]+")
LANGUAGE_NAMES = {"English", "简体中文"}
ALLOWED = frozenset({"Tappet", "local", "ms", "KB", "MB", "Ln", "Col", "PRG", "FB", "FUN", "IX", "QX"})
"""Names, units and abbreviations that are the same in every language."""


@cache
def chinese_words() -> frozenset[str]:
    """Latin words of the Chinese texts themselves: keys, languages, formats."""
    return frozenset(word for text in texts("zh").values() for word in WORD.findall(text))


def words_of_project(page: Page, server: Server) -> set[str]:
    """Words of the program, of its comments and of names of libraries: whatever their authors wrote."""
    project = example(page, server)
    found = str(fetch(page, server, "GET", project))
    for item in fetch(page, server, "GET", f"{project}/objects"):
        found += str(fetch(page, server, "GET", f"{project}/objects/{item['id']}"))
    for library in fetch(page, server, "GET", "/libraries"):
        found += " ".join(str(library[part]) for part in ("name", "company", "namespace", "version"))
    found += str(fetch(page, server, "GET", "/runtimes"))
    return set(WORD.findall(found))


@cache
def translated() -> frozenset[str]:
    """English texts that are others in Chinese."""
    chinese = texts("zh")
    return frozenset(text for key, text in texts("en").items() if chinese.get(key, text) != text)


def still_english(page: Page, words: set[str]) -> list[str]:
    """Texts that have a translation, and those with words that are no names and not in Chinese texts."""
    known = words | chinese_words() | ALLOWED
    return [
        f"{text!r} in {where}"
        for text, where in Ui(page, "zh").seen().items()
        if text not in LANGUAGE_NAMES
        and (
            (text in translated() and text not in words)
            or any(word not in known for word in WORD.findall(text))
        )
    ]


def still_chinese(page: Page) -> list[str]:
    return [f"{text!r} in {where}" for text, where in Ui(page, "en").seen().items() if CHINESE.search(text)]
