"""axe-core in the page: what is serious or critical by WCAG 2.2 A and AA."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal

from playwright.sync_api import Page, expect

AXE = Path(__file__).parents[2] / "frontend/node_modules/axe-core/axe.min.js"
LEVELS = {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]}
OF_COLOURS = {"type": "rule", "values": ["color-contrast", "link-in-text-block"]}
"""The rules of these levels whose answer another theme can change."""
RUN = """async ([part, runOnly]) => {
    const options = {
        runOnly,
        resultTypes: ['violations'],
    };
    // The 3D scene is a page of its own and not ours.
    const here = part !== null && document.querySelector(part) !== null ? {include: [[part]]} : {};
    const found = await axe.run({...here, exclude: [['iframe']]}, options);
    return found.violations
        .filter(({impact}) => impact === 'serious' || impact === 'critical')
        .flatMap(({id, help, nodes}) => nodes.map((node) => `${id}: ${help}: ${node.html.slice(0, 160)} `
            + `${node.any.map(({message}) => message).join('; ').slice(0, 200)}`));
}"""


def serious(page: Page, part: str | None = None, rules: Mapping[str, object] = LEVELS) -> list[str]:
    """What axe finds in the page, or in the part of it that a selector names, where there is one."""
    # Evaluated from outside: the policy of the page lets no foreign script in.
    if not page.evaluate("() => 'axe' in window"):
        page.evaluate(f"() => {{ {AXE.read_text(encoding='utf-8')} }}")
    found: list[str] = page.evaluate(RUN, [part, rules])
    return found


THEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
SETTLE = """() => document.getAnimations()
    .filter((animation) => animation.effect.getComputedTiming().endTime !== Infinity)
    .forEach((animation) => animation.finish())"""
"""Colours on the way from one theme to the other, or of a dialog that appears, are none of either."""


def serious_in_both_themes(
    page: Page, part: str | None = None, seen: Callable[[str], object] = lambda theme: None
) -> list[str]:
    """What axe finds in light colours, and of colours in dark ones; `seen` is called in both."""
    found = []
    for theme in THEMES:
        page.emulate_media(color_scheme=theme)
        expect(page.locator(f"html[data-theme={theme}]")).to_have_count(1)
        page.evaluate(SETTLE)
        rules = LEVELS if theme == "light" else OF_COLOURS
        found += [f"{theme}: {line}" for line in serious(page, part, rules)]
        seen(theme)
    page.emulate_media(color_scheme="light")
    return found
