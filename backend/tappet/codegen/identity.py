"""The code id: equal for equal programs, however they were built.

It is taken from the texts, not from the objects: a build after an edit splits and orders code differently
than a build of everything, and that is no difference to the machine. Comments do not count, lines do.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from functools import lru_cache

from tappet import __version__
from tappet.codegen.package import CodePackage
from tappet.lang.source import Scope, Source

_BLANKS = r"(?<![ \t]{2}) [ \t]*+ (?: (?= \r?\n ) | //[^\n]* | \(\*.*?\*\) )"
"""Behind the first one: up to the end of the line, or up to a comment and with it."""
_PARTS = re.compile(
    rf"""
    ' (?: [^'$\n] | \$. )* ' | " (?: [^"$\n] | \$. )* " | \{{ [^}}]* \}}
    | //[^\n]* | \(\*.*?\*\)
    | \x20 {_BLANKS} | \t {_BLANKS}
    """,
    re.VERBOSE | re.DOTALL,
)
"""Strings and pragmas, which stay, and what does not count. Each alternative begins with a character of its
own, so that the search goes from one of these to the next."""
_STAYS = frozenset("'\"{")


def text_digest(source: Source) -> bytes:
    """Digest of what the compiler reads of a text: comments left out, line by line."""
    return _library_digest(source) if source.scope is Scope.LIBRARY else _digest(source)


@lru_cache(maxsize=8192)
def _library_digest(source: Source) -> bytes:
    """Libraries are the same for all builds of a process."""
    return _digest(source)


def _digest(source: Source) -> bytes:
    text = without_comments(source.text)
    if "*)" in text:  # nested comments: count all of it
        text = source.text
    place = (source.uri, source.scope, source.owner, source.name, source.library, source.namespace)
    given = [(item.name, item.value) for item in source.given]  # where the values stand is no difference
    seen = (source.uses, source.private, source.qualified_only)
    head = repr((*place, *seen, source.body_line, source.bodies, given))
    return hashlib.blake2b(f"{head}\n{text}".encode("utf-8", "surrogatepass"), digest_size=16).digest()


def without_comments(text: str) -> str:
    """A text without comments and blanks at the ends of lines; its lines stay."""
    return _PARTS.sub(lambda m: m[0] if m[0][0] in _STAYS else "\n" * m[0].count("\n"), text)


def program_digest(texts: Iterable[bytes], settings: object) -> bytes:
    """Digest of a program: its texts by `text_digest`, and what else its code depends on."""
    digest = hashlib.blake2b(f"{__version__}|{settings!r}|".encode(), digest_size=16)
    for text in texts:
        digest.update(text)
    return digest.digest()


def code_id(package: CodePackage, program: bytes) -> str:
    """Identity of the code in `package`, made from the program with this digest."""
    digest = hashlib.blake2b(program + package.data_id.encode(), digest_size=12)
    for task in package.tasks:
        digest.update(repr(task).encode())
    digest.update(package.initial_image)
    return digest.hexdigest()
