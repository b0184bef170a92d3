"""The place in the program of what LLVM complains about, by the debug information of the module's text."""

from __future__ import annotations

import re

from tappet.core.internal_error import At

_POSITION = re.compile(r":(\d+):\d+: error:")
_DEBUG = re.compile(r"!dbg !(\d+)")
_LOCATION = re.compile(r"!DILocation\(line: (\d+)")
_SUBPROGRAM = re.compile(r'!DISubprogram\(name: "([^"]*)".*? file: !(\d+), line: (\d+)')
_FILE = re.compile(r'!DIFile\(filename: "([^"]*)"')
_ESCAPE = re.compile(r"\\([0-9A-Fa-f]{2})")


def place_in(text: str, message: str) -> At | None:
    """The POU and line that a message with a position in the LLVM text `text` is about."""
    position = _POSITION.search(message)
    if position is None:
        return None
    lines = text.splitlines()
    at = min(int(position[1]), len(lines)) - 1
    start = next((n for n in range(at, -1, -1) if lines[n].startswith("define ")), None)
    if start is None:
        return None
    nodes = dict(line.split(" = ", 1) for line in lines if line.startswith("!") and " = " in line)
    head = _node(nodes, lines[start])
    found = _SUBPROGRAM.search(head) if head else None
    if found is None:
        return None
    file = _FILE.search(nodes.get(f"!{found[2]}", ""))
    return At(
        _unquoted(found[1]), _unquoted(file[1]) if file else "", _line(nodes, lines, at) or int(found[3])
    )


def _line(nodes: dict[str, str], lines: list[str], at: int) -> int:
    """Line of the first instruction from `at` on that has one: instructions that cannot fault carry none."""
    for line in lines[at:]:
        if line == "}":
            return 0
        node = _node(nodes, line)
        found = _LOCATION.search(node) if node else None
        if found is not None:
            return int(found[1])
    return 0


def _node(nodes: dict[str, str], line: str) -> str:
    found = _DEBUG.search(line)
    return nodes.get(f"!{found[1]}", "") if found is not None else ""


def _unquoted(text: str) -> str:
    """A string of LLVM's text."""
    raw = _ESCAPE.sub(lambda m: chr(int(m[1], 16)), text)
    return raw.encode("latin-1", "replace").decode("utf-8", "replace")
