"""The text file of an object with code: one plain IEC text, split again when it is read.

A file is the declaration, the implementation and the closing keyword, each from its own line. Where the
implementation begins is found by reading the declaration; where that would give another split (a declaration
that is not finished, say), the number of lines of the declaration is kept in the index beside the file.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tappet.project.declaration_text import declaration_end, end_keyword, words

TEXT_KINDS = frozenset(
    ["pou", "method", "action", "property", "accessor", "interface", "dut", "gvl", "persistent"]
)
"""Kinds whose data are text, kept in `<name>.st`."""

_WITH_BODY = frozenset(["pou", "method", "accessor"])
_POU_ENDS = frozenset(["END_PROGRAM", "END_FUNCTION_BLOCK", "END_FUNCTION"])
_ENDS = {
    "method": "END_METHOD",
    "action": "END_ACTION",
    "property": "END_PROPERTY",
    "interface": "END_INTERFACE",
}


@dataclass(frozen=True, slots=True)
class Parts:
    """The two texts of an object; None for a part that its kind does not have."""

    declaration: str | None
    implementation: str | None


def write_text(kind: str, name: str, parts: Parts) -> tuple[str, int | None]:
    """The file of an object, and the number of lines of its declaration where reading would not find it."""
    declaration = parts.declaration or ""
    text = _joined(kind, name, parts)
    if read_text(kind, name, text) == parts:
        return text, None
    split = declaration.count("\n") + 1 if declaration else 0
    return text, split


def read_text(kind: str, name: str, text: str, split: int | None = None) -> Parts:
    """The parts of a file; `split` is the number of lines of the declaration where the index has it."""
    body = _without_opening(kind, name, text)
    if kind not in _WITH_BODY:
        content = _without_newline(_without_end(body, _end(kind, name, body)))
        return Parts(None, content) if kind == "action" else Parts(content, None)
    if split is None:
        content = _without_newline(_without_end(body, _end(kind, name, body)))
        cut = declaration_end(content)
        return Parts(content[:cut], content[cut:].removeprefix("\n"))
    lines = body.split("\n")
    declaration = "\n".join(lines[:split])
    rest = "\n".join(lines[split:])
    return Parts(declaration, _without_newline(_without_end(rest, _end(kind, name, declaration))))


def _joined(kind: str, name: str, parts: Parts) -> str:
    pieces = []
    opening = _opening(kind, name)
    if opening:
        pieces.append(opening)
    if parts.declaration is not None and (parts.declaration or kind not in _WITH_BODY):
        pieces.append(parts.declaration)
    if parts.implementation:
        pieces.append(parts.implementation)
    end = _end(kind, name, parts.declaration or "")
    if end:
        pieces.append(end)
    return "".join(f"{piece}\n" for piece in pieces)


def _opening(kind: str, name: str) -> str | None:
    """The line that begins the file of an object whose declaration does not name it."""
    if kind == "action":
        return f"ACTION {name}"
    return name.upper() if kind == "accessor" else None


def _end(kind: str, name: str, declaration: str) -> str | None:
    """The line that ends the file."""
    if kind == "pou":
        end = end_keyword(declaration)
        return end if end in _POU_ENDS else None
    return f"END_{name.upper()}" if kind == "accessor" else _ENDS.get(kind)


def _without_opening(kind: str, name: str, text: str) -> str:
    opening = _opening(kind, name)
    if opening is None or text.startswith(f"{opening}\n"):
        return text if opening is None else text[len(opening) + 1 :]
    scan = words(text)
    first = next(scan, None)
    if first is None or first.text != opening.split()[0]:
        return text
    end = first.end
    if kind == "action":
        named = next(scan, None)
        end = named.end if named is not None else end
        colon = next(scan, None)
        if colon is not None and colon.text == ":" and "\n" not in text[end : colon.start]:
            end = colon.end
    line, newline, rest = text[end:].partition("\n")
    return text[: first.start].lstrip() + (line.strip() and line.lstrip() + newline) + rest


def _without_end(body: str, end: str | None) -> str:
    """The text before the closing keyword: empty, or whole lines."""
    if end is not None:
        if body == f"{end}\n":
            return ""
        if body.endswith(f"\n{end}\n"):
            return body[: -len(end) - 1]
        found = re.search(rf"(?:^|(?<=\n)|(?<=[\s;])){end}[ \t]*;?\s*\Z", body, re.IGNORECASE)
        if found is not None:
            body = body[: found.start()].rstrip(" \t")
    return body if not body or body.endswith("\n") else f"{body}\n"


def _without_newline(content: str) -> str:
    return content.removesuffix("\n")
