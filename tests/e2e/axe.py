"""axe-core in the page: what is serious or critical by WCAG 2.2 A and AA."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page

AXE = Path(__file__).parents[2] / "frontend/node_modules/axe-core/axe.min.js"
RUN = """async (part) => {
    const options = {
        runOnly: {type: 'tag', values: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa']},
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


def serious(page: Page, part: str | None = None) -> list[str]:
    """What axe finds in the page, or in the part of it that a selector names, where there is one."""
    # Evaluated from outside: the policy of the page lets no foreign script in.
    if not page.evaluate("() => 'axe' in window"):
        page.evaluate(f"() => {{ {AXE.read_text(encoding='utf-8')} }}")
    found: list[str] = page.evaluate(RUN, part)
    return found
