"""Which dialogs the front end has, read from its sources: the keys of the titles that it gives them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from .ui import SOURCES, texts

OPENING = re.compile(
    r"<(?:Form|TextImport|ListName)?Dialog\s[^>]*?\btitle=\{|\bconfirm\(\{\s*title: ", re.DOTALL
)
KEY = re.compile(r"['`]([a-z]\w*(?:\.[\w${}]+)+)['`]")


def dialog_titles() -> dict[str, Path]:
    """Keys of the titles of all dialogs and the file of each.

    A title is an expression beside `<Dialog`, a component that is one, or `confirm(`, or a constant of the
    same file. Where it is a property of the component, those that use that say it.
    """
    found: dict[str, Path] = {}
    for path in sorted(SOURCES.rglob("*.ts*")):
        if path.is_relative_to(SOURCES / "ui") or ".test." in path.name:
            continue
        source = path.read_text(encoding="utf-8")
        for opening in OPENING.finditer(source):
            expression = _expression(source, opening.end())
            if re.search(rf"\b{re.escape(expression)}: string;", source):
                continue
            titles = list(_keys(expression, source))
            assert titles, f"{path}: which text is the title behind {opening[0]!r}?"
            found |= dict.fromkeys(titles, path)
    return found


def _expression(source: str, start: int) -> str:
    """From there to the end of the attribute or of the member of an object."""
    depth = 0
    for at in range(start, len(source)):
        if source[at] in "([{":
            depth += 1
        elif source[at] in ")]}":
            depth -= 1
        if depth < 0 or (depth == 0 and source[at] == ","):
            return source[start:at]
    return source[start:]


def _keys(expression: str, source: str) -> Iterator[str]:
    if re.fullmatch(r"\w+", expression):
        constant = re.search(rf"const {expression} = ([^;]+);", source)
        expression = constant[1] if constant else ""
    for key in KEY.findall(expression):
        if "${" in key:
            wanted = re.compile(re.sub(r"\\\$\\\{\w+\\\}", r"\\w+", re.escape(key)))
            yield from (one for one in texts("en") if wanted.fullmatch(one))
        elif {key, f"{key}_other"} & texts("en").keys():
            yield key
