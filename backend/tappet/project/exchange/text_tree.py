"""Trees of texts with one object a file, as our own export and tools for version control write them.

Folders of the files are folders of the project. Tools that sync with CODESYS go further: methods, properties
and actions stand in files of their own, named `Block.Member.st` and beside `Block.st`; objects have no
closing keyword; lines such as `// === IMPLEMENTATION ===` part declaration and body.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection
from dataclasses import dataclass

from tappet.iec.tokens import NAME, words
from tappet.project.exchange.drafts import Draft, body
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.split_text import split_text
from tappet.project.exchange.text_parts import trimmed

_MARK = re.compile(
    r"^[ \t]*//[ \t]*(?:=+|-+)[ \t]*(IMPLEMENTATION|GET|SET)[ \t]*(?:=+|-+)[ \t]*$", re.MULTILINE
)
_CLOSED = re.compile(
    r"\bEND_(?:PROGRAM|FUNCTION(?:_?BLOCK)?|METHOD|PROPERTY|ACTION|TRANSITION|INTERFACE)\b", re.IGNORECASE
)
_MEMBERS = ("METHOD", "PROPERTY", "ACTION", "TRANSITION")
_OTHER_HEADS = ("PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "INTERFACE", "TYPE", "VAR_GLOBAL", "CONFIGURATION")


@dataclass(frozen=True, slots=True)
class MarkedText:
    """A text without the lines that part it; line numbers are those of the file."""

    text: str
    declaration_ends: tuple[int, ...]
    marked: bool
    """Whether there were such lines: then the object ends with the file."""


def unmarked(text: str) -> MarkedText:
    """Take the lines out that part a text: accessors get their keywords instead.

    In a text with closing keywords such lines are comments, and stay.
    """
    if not any(match[1] == "IMPLEMENTATION" for match in _MARK.finditer(text)) or _CLOSED.search(text):
        return MarkedText(text, (), False)
    ends: list[int] = []
    seen: list[str] = []
    pieces: list[str] = []
    at = length = 0
    for match in _MARK.finditer(text):
        mark = match[1]
        put = "" if mark == "IMPLEMENTATION" else f"END_GET {mark}" if "GET" in seen else mark
        pieces += [text[at : match.start()], put]
        length += match.start() - at
        if mark == "IMPLEMENTATION":
            ends.append(length)
        length += len(put)
        at = match.end()
        seen.append(mark)
    pieces.append(text[at:])
    return MarkedText("".join(pieces), tuple(ends[:1]), True)


def folders_of(paths: Collection[str]) -> dict[str, tuple[str, ...]]:
    """The folder in the project for each text: that of its path, without what all of them share.

    The levels down to an application (`Device/PLC Logic/Application`) are no folders.
    """
    parts = {path: _below_application([p for p in path.split("/")[:-1] if p.strip(". ")]) for path in paths}
    shared = len(posixpath.commonprefix(list(parts.values())))
    return {path: tuple(names[shared:]) for path, names in parts.items()}


def _below_application(names: list[str]) -> list[str]:
    folded = [name.casefold() for name in names]
    return names[folded.index("plc logic") + 2 :] if "plc logic" in folded else names


def owner_paths(paths: Collection[str]) -> dict[str, str]:
    """The files that are named `Block.Member.st`, and the file of the block, in the same folder."""
    known = {path.lower(): path for path in paths if path.lower().endswith(".st")}
    found: dict[str, str] = {}
    for low, path in known.items():
        stem, dot, member = posixpath.splitext(path)[0].rpartition(".")
        owner = known.get(low[: len(stem)] + ".st")
        if dot and owner is not None and NAME.fullmatch(member):
            found[path] = owner
    return found


def is_member(text: str) -> bool:
    """Whether a text is a member of a block, and no object that is complete by itself."""
    heads = [word.text for word in words(text)]
    return not heads or heads[0] in _MEMBERS or not any(head in heads for head in _OTHER_HEADS)


def read_member(path: str, text: str, owner: Draft, report: ImportReport) -> None:
    """Read the file of a member into its block. What begins with no keyword is an action."""
    parted = unmarked(text)
    first = next(words(parted.text), None)
    if first is not None and first.text in _MEMBERS:
        ends = parted.declaration_ends
        split_text(path, parted.text, report, declaration_ends=ends, owner=owner, open_ended=True)
        return
    name = posixpath.splitext(posixpath.basename(path))[0].rpartition(".")[2]
    owner.children.append(Draft("action", name, body("ST", trimmed(parted.text)), path, 1))
