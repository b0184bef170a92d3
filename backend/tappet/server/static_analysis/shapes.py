"""The coding rules that a project can switch on."""

from __future__ import annotations

from pydantic import Field

from tappet.server.shapes import Reply


class CodingRule(Reply):
    """A rule of the static analysis."""

    code: str = Field(description="Such as S1211; the first three characters are its group.")
    name: str
    numbers: tuple[str, ...] = Field(description="Its numbers in CODESYS Static Analysis, such as SA0041.")
    message: str = Field(description="What it says; fields in braces are filled in.")
    advice: str
    prefixes: dict[str, str] = Field(description="Prefixes that it asks for, with those that are usual.")
    limits: dict[str, int] = Field(description="Limits that it sets, with those that are usual.")
