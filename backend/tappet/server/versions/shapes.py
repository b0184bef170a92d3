"""Versions of an application that a runtime had."""

from __future__ import annotations

from datetime import datetime
from typing import Literal

from pydantic import Field

from tappet.server.shapes import Reply


class Version(Reply):
    """One that was brought into the runtime."""

    code_id: str
    at: datetime
    username: str
    how: Literal["download", "online-change"]
    runs: bool = Field(description="Whether it is the one that the runtime has now.")
    kept: bool = Field(description="Whether the server still has its source, so that it can be brought back.")
