"""Comments and pragmas: where they end, and what an attribute pragma says (LST-02, LPRG-01).

The patterns are parts of the one expression of `iec.tokens`, which finds where they begin. They match in
possessive steps, so that reading is linear in the length of any text.
"""

from __future__ import annotations

import re
from typing import Final, NamedTuple

LINE_COMMENT: Final = r"//[^\r\n]*+"
BLOCK_COMMENT: Final = r"\(\*(?:[^*(]++|\*(?!\))|\((?!\*))*+\*\)"
"""A comment without another one inside; behind any other `(*` goes `block_comment_end`."""
C_COMMENT: Final = r"/\*[^*]*+(?:\*(?!/)[^*]*+)*+(?:\*/)?+"
PRAGMA: Final = (
    r"""\{(?:[^{}'"\r\n]|'[^'\r\n]*+'|"[^"\r\n]*+")*+\}"""
    r"""|\{\s*+(?i:attribute)\b(?:[^{}'"\r\n]|[\r\n]\s*+(?=['":}])|'[^']*+'|"[^"]*+")*+\}"""
    r"""|\{\s*+(?i:attribute)\s*+'[^'\r\n]*+'\s*+:=\s*+'[^{}]*+(?<=['\s])\}"""
    r"""|\{[^}\r\n]*+\}?+"""
)
"""A pragma ends in its line, braces in quotes do not count; an attribute may go on in the next line."""

_ESCAPED = re.compile(r"\$(['\"$])")
_BLOCK_COMMENT_MARK = re.compile(r"\(\*|\*\)")


def block_comment_end(text: str, start: int) -> int | None:
    """Where the comment ends whose `(*` is at `start`; comments nest. None if it is not closed."""
    depth = 0
    for mark in _BLOCK_COMMENT_MARK.finditer(text, start):
        depth += 1 if mark[0] == "(*" else -1
        if depth == 0:
            return mark.end()
    return None


def unnested(comment: str) -> str:
    """A comment of a dialect whose comments do not nest, as one that begins no other inside."""
    if not comment.startswith("(*"):
        return comment
    closed = comment.endswith("*)") and len(comment) > 3
    inner = (comment[2:-2] if closed else comment[2:]).replace("(*", "( *")
    if not closed:
        return f"(*{inner}"
    return f"(*{inner} *)" if inner.endswith("(") else f"(*{inner}*)"


class Attribute(NamedTuple):
    """What `{attribute 'name' := 'value'}` says."""

    name: str
    value: str | None


def attribute_of(pragma: str) -> Attribute | None:
    """Name and value of an attribute pragma, braces included; None for other pragmas."""
    text = pragma[1:].removesuffix("}").strip()
    if text[:9].lower() != "attribute":
        return None
    name, mark, value = text[9:].partition(":=")
    return Attribute(_unquoted(name.strip()), _unquoted(value.strip()) if mark else None)


def _unquoted(text: str) -> str:
    if len(text) < 2 or text[0] != text[-1] or text[0] not in "'\"":
        return text.strip("'\"")
    return _ESCAPED.sub(r"\1", text[1:-1])
