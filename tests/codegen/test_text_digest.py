"""What counts of a text for the code id: a scanner that goes from character to character is the reference."""

from __future__ import annotations

import re
from random import Random

import pytest

from tappet.codegen.identity import text_digest, without_comments
from tappet.lang.source import Source

PIECES = ("'", '"', "$", "\n", "\r\n", " ", "  ", "\t", "//", "/", "(*", "*)", "(", "*", "{", "}", "a", "b")


def reference(text: str) -> str:
    """The text without comments and blanks at the ends of lines."""
    out = ""
    at = 0
    while at < len(text):
        rest = text[at:]
        blanks = len(rest) - len(rest.lstrip(" \t"))
        behind = rest[blanks:]
        if behind.startswith("//"):
            at += blanks + len(behind.split("\n", 1)[0])
        elif behind.startswith("(*") and "*)" in behind[2:]:
            end = behind.index("*)", 2) + 2
            out += "\n" * behind[:end].count("\n")
            at += blanks + end
        elif blanks and re.match(r"\r?\n", behind):
            at += blanks
        elif blanks:
            out += rest[:blanks]
            at += blanks
        else:
            size = _string(rest) or _pragma(rest) or 1
            out += rest[:size]
            at += size
    return out


def _string(rest: str) -> int:
    """Length of the string that a text begins with; 0: none, or it does not end in its line."""
    quote, at = rest[0], 1
    while quote in "'\"" and at < len(rest):
        if rest[at] == quote:
            return at + 1
        if rest[at] == "\n" or rest[at:] == "$":
            return 0
        at += 2 if rest[at] == "$" else 1
    return 0


def _pragma(rest: str) -> int:
    return rest.index("}") + 1 if rest[0] == "{" and "}" in rest else 0


@pytest.mark.parametrize("seed", range(20))
def test_random_texts(seed: int) -> None:
    random = Random(seed)
    for _ in range(500):
        text = "".join(random.choices(PIECES, k=random.randint(1, 18)))
        assert without_comments(text) == reference(text), repr(text)


def test_comments_do_not_count_but_lines_do() -> None:
    plain = "PROGRAM P\n\ta := '// b';\n\nEND_PROGRAM"
    same = "PROGRAM P // says\n\ta := '// b'; (* and\n more *)  \nEND_PROGRAM"
    assert text_digest(Source("p", same)) == text_digest(Source("p", plain))
    for other in (plain.replace("b", "c"), plain.replace("\n\n", "\n"), plain.replace("\ta", "\t a")):
        assert text_digest(Source("p", other)) != text_digest(Source("p", plain))
