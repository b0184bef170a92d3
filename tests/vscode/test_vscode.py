"""The extension in a real VS Code: a program is checked, halts, is stepped through, looked into, written."""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect, sync_playwright
from vscode_server import installed, packed, serving

pytestmark = pytest.mark.slow
expect.set_options(timeout=60_000)
PROGRAM = """\
FUNCTION_BLOCK FB_Counter
VAR_INPUT nStep : INT; END_VAR
VAR_OUTPUT nCount : INT; END_VAR
VAR_TEMP nBefore : INT; END_VAR
nBefore := nCount;
nCount := nBefore + nStep;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
    fbCounter : FB_Counter;
    fTotal : LREAL;
END_VAR
fbCounter(nStep := 2);
fTotal := fTotal + fbCounter.nCount * 0.5;
END_PROGRAM
"""
CALL, TOTAL, ADD = 14, 15, 6
"""Lines."""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """VS Code in a browser, with a folder that holds one program."""
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "tappet-tests" / "vscode"
    folder = tmp_path_factory.mktemp("vscode")
    machine = folder / "machine"
    (machine / ".vscode").mkdir(parents=True)
    (machine / "Main.st").write_text(PROGRAM)
    (machine / ".vscode" / "settings.json").write_text(json.dumps({"editor.minimap.enabled": False}))
    code, extension = installed(cache), packed(folder)
    tappet = [str(Path(sys.executable).parent / "tappet")]
    chromium = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "google-chrome"))))
    with serving(code, extension, folder / "data", tappet) as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.set_default_timeout(60_000)
        page.goto(f"{url}/?folder={machine}")
        page.get_by_role("button", name="Yes, I trust the authors").click()
        page.get_by_role("treeitem", name="Main.st").dblclick()
        expect(page.locator(".monaco-editor .view-lines")).to_contain_text("FUNCTION_BLOCK")
        yield page
        browser.close()


def picture(page: Page, name: str) -> None:
    folder = os.environ.get("TAPPET_PICTURES")
    if folder:
        page.screenshot(path=str(Path(folder) / f"vscode-{name}.png"))


def go_to(page: Page, line: int) -> None:
    page.locator(".monaco-editor .view-lines").first.click()
    page.keyboard.press("Control+g")
    page.locator(".quick-input-widget input").fill(f":{line}")
    page.keyboard.press("Enter")


def stands_at(page: Page, line: int, frame: str) -> None:
    """The top of the call stack, and the editor, are at a line."""
    top = page.locator(".debug-call-stack .monaco-list-row .stack-frame").first
    expect(top).to_contain_text(frame)
    expect(top).to_contain_text(re.compile(rf"{line}(:\d+)?$"))


def variable(page: Page, name: str) -> str:
    row = page.locator(".debug-variables .monaco-list-row").filter(has_text=re.compile(rf"^{name}\b")).first
    expect(row).to_be_visible()
    return row.inner_text().partition("=")[2].strip()


def test_errors_are_shown_while_typing(page: Page) -> None:
    go_to(page, TOTAL)
    page.keyboard.press("Home")
    page.keyboard.type("x")
    expect(page.locator(".monaco-editor .squiggly-error").first).to_be_visible()
    page.keyboard.press("Control+z")
    expect(page.locator(".monaco-editor .squiggly-error")).to_have_count(0)
    page.keyboard.press("Control+s")


def test_a_program_halts_is_stepped_through_looked_into_and_written(page: Page) -> None:
    go_to(page, CALL)
    page.keyboard.press("F9")
    expect(page.locator(".codicon-debug-breakpoint").first).to_be_visible()
    page.keyboard.press("F5")
    stands_at(page, CALL, "Main")
    picture(page, "halted")
    page.keyboard.press("F11")
    stands_at(page, ADD - 1, "FB_Counter")
    assert variable(page, "nStep") == "2"
    page.keyboard.press("F10")
    stands_at(page, ADD, "FB_Counter")
    page.keyboard.press("Shift+F11")
    stands_at(page, TOTAL, "Main")
    picture(page, "stepped")
    page.keyboard.press("Control+Shift+Y")
    console = page.locator(".repl-input-wrapper .monaco-editor").first
    console.click()
    page.keyboard.type("fbCounter.nCount := 40\n")
    expect(page.locator(".repl .monaco-list-row", has_text=re.compile(r"^40$"))).to_be_visible()
    page.keyboard.type("fbCounter.nCount\n")
    expect(page.locator(".repl .monaco-list-row", has_text=re.compile(r"^40$"))).to_have_count(2)
    page.locator(".monaco-editor .view-lines").first.click()
    page.keyboard.press("F5")
    stands_at(page, CALL, "Main")
    page.keyboard.press("Shift+F5")
    expect(page.locator(".debug-toolbar")).to_be_hidden()
