"""Pages of the help."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from tappet.server.shapes import Reply

HelpKind = Literal["word", "message", "view", "library"]


class HelpEntry(Reply):
    """A page in the list of all."""

    kind: HelpKind
    name: str = Field(description="Of the page among those of its kind: `IF`, `E0204`, `messages`.")
    title: str
    summary: str
    words: list[str] = Field(description="What is found here: keywords, signs, codes.")
    library: str | None = Field(description="The library that documents an item of this name.")


class HelpSection(Reply):
    """A part of a page."""

    heading: str | None
    text: str
    code: str | None = Field(description="An example in ST.")


class HelpPage(Reply):
    """A page."""

    kind: HelpKind
    name: str
    title: str
    sections: list[HelpSection]
