"""What a project, an editor and the compiler have to know of a language before anything is read."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

Form = Literal["text", "drawn", "kept"]
"""How a body is stored: text of the language; elements as JSON; what another tool has written, kept
unchanged."""

_NAME = re.compile(r"[A-Z][A-Z0-9_]{0,19}")
_EXTENSION = re.compile(r"[a-z][a-z0-9]{0,9}")


@dataclass(frozen=True, slots=True)
class Language:
    """A language of bodies."""

    name: str
    """Short name in capitals, as projects store it: `ST`."""
    title: str
    """Name in full, in English."""
    reader: str = ""
    """`module:name` of its `lang.languages.reader.BodyReader`; empty: bodies are kept but cannot be compiled.
    """
    rank: int = 100
    """Place in lists, lowest first."""
    text: bool = True
    """Bodies can be text, compiled where it stands between the declaration and its end."""
    named: bool = False
    """A body stored under this name is in this language whatever it looks like; otherwise its first words
    tell."""
    begins: str = ""
    """Regular expression of how a text in it begins, where bodies stored under the name can be something
    else."""
    extension: str = ""
    """Ending of the file that holds a drawn body; empty: bodies are never drawn."""
    offered: bool = False
    """New objects can be written in it."""
    implicit_names: str = ""
    """How upper-case names begin that bodies refer to although they do not stand in their text; empty: none.
    """
    call_modifier: str = ""
    """Upper-case ending that makes the name of a function a conditional call of it; empty: there is none."""

    def __post_init__(self) -> None:
        if self.extension and (not _EXTENSION.fullmatch(self.extension) or self.extension in ("st", "json")):
            raise ValueError(f"language {self.name}: '{self.extension}' is no extension of its own")
        if self.extension and not self.reader:
            raise ValueError(f"language {self.name}: drawn bodies need a reader")
        if self.reader and not _NAME.fullmatch(self.name):
            raise ValueError(f"'{self.name}' is no name of a language: capitals, digits, underscores")

    @property
    def drawn(self) -> bool:
        """Whether bodies can be elements instead of text."""
        return bool(self.extension)

    def form_of(self, body: str) -> Form:
        """How a stored body is written."""
        begin = body.lstrip()[:1]
        if self.drawn and begin != "<" and (begin == "{" or not self.text):
            return "drawn"
        if not begin:
            return "text"
        if not self.text or not self.reader:
            return "kept"
        return "text" if not self.begins or re.match(self.begins, body, re.IGNORECASE) else "kept"
