"""JSON shapes of CNC info and of the editor of CNC settings."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import ConfigDict, Field

from tappet.project.cnc.code import LIBRARY
from tappet.project.cnc.program import CncProgramData
from tappet.project.data import MAX_TEXT
from tappet.server.shapes import Reply, Request
from tappet.translation.language import Language
from tappet.translation.library_comments import comment

ObjectId = Annotated[str, Field(max_length=100)]


class CncOrder(Request):
    """A program as its editor has it."""

    model_config = ConfigDict(extra="forbid", str_max_length=MAX_TEXT)

    object_id: ObjectId = Field(description="The CNC object; its application has the settings.")
    program: CncProgramData


class CncFault(Reply):
    """Why a path ends early."""

    SENTENCES: ClassVar[tuple[str, ...]] = ("message",)

    message: str
    line: int | None = Field(description="Of the text, from 0.")
    column: int
    length: int = Field(description="0: the whole line.")


class CncPathFacts(Reply):
    """A path in numbers."""

    objects: int
    length: float = Field(description="[u]")
    duration: float | None = Field(description="[s]; none where the interpolator cannot go the path.")
    fault: CncFault | None


class CncInfo(Reply):
    """What the dialog CNC info shows (CNC-20)."""

    name: str = Field(description="Of the program.")
    library: str = Field(description="Version of the function blocks.")
    lines: int
    errors: int = Field(description="Errors of the text.")
    path: CncPathFacts
    preprocessed: CncPathFacts | None = Field(description="None where the settings have no preprocessing.")


class CncCode(Reply):
    """The ST of the variables that a program is (CNC-21)."""

    text: str


class CncBlockParameter(Reply):
    """An input of a preprocessing block."""

    name: str
    type: str
    initial: str
    comment: str
    values: list[str] = Field(description="Those of a BOOL or an enumeration; empty for a number.")


class CncBlock(Reply):
    """A block of path preprocessing that the library offers (CNCS-08)."""

    name: str
    comment: str
    parameters: list[CncBlockParameter]

    def in_language(self, language: Language) -> Self:
        """The block with the comments of the library in a language, as far as there are words for them."""

        def said(english: str) -> str:
            return comment(english, LIBRARY, language)

        inputs = [one.model_copy(update={"comment": said(one.comment)}) for one in self.parameters]
        return self.model_copy(update={"comment": said(self.comment), "parameters": inputs})


class CncBlocks(Reply):
    """All of them."""

    blocks: list[CncBlock]
