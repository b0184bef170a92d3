"""The coding rules that a project can switch on, and the warnings that it can switch off."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from tappet.server.shapes import Reply


class CompilerWarning(Reply):
    """A warning or note of the compiler that a project can switch off."""

    code: str = Field(description="Such as W1122.")
    severity: Literal["warning", "info"]
    numbers: tuple[str, ...] = Field(description="Its numbers in CODESYS, such as C0195 or SA0054.")
    message: str = Field(description="What it says; fields in braces are filled in.")
    advice: str


class CodingRule(Reply):
    """A rule of the static analysis."""

    code: str = Field(description="Such as S1211; the first three characters are its group.")
    name: str
    numbers: tuple[str, ...] = Field(description="Its numbers in CODESYS Static Analysis, such as SA0041.")
    message: str = Field(description="What it says; fields in braces are filled in.")
    advice: str
    prefixes: dict[str, str] = Field(description="Prefixes that it asks for, with those that are usual.")
    limits: dict[str, int] = Field(description="Limits that it sets, with those that are usual.")
