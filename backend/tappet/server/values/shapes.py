"""Values of the running application."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, ClassVar

from pydantic import Field, JsonValue, StringConstraints

from tappet.server.shapes import Reply, Request

Expression = Annotated[str, StringConstraints(min_length=1, max_length=500)]
"""Path of a variable, such as `PLC_PRG.fbFiller1.aLevel[3]`, `GVL.x`, `PLC_PRG.w.3` or `%QW2`."""
MAX_EXPRESSIONS = 5000


class ReadOrder(Request):
    """What to read; all values are of one moment."""

    expressions: Annotated[list[Expression], Field(max_length=MAX_EXPRESSIONS)]


class Value(Reply):
    """A value, or why there is none."""

    SENTENCES: ClassVar = ("error",)

    expression: str
    type: str | None = None
    kind: str | None = Field(
        default=None, description="bool bits int uint real time date ... enum string wstring."
    )
    size: int | None = Field(default=None, description="Bytes of the variable.")
    enum: dict[str, int] | None = Field(default=None, description="Numbers of an enumeration by name.")
    base: str | None = Field(default=None, description="int, uint or bits below an enumeration.")
    value: Any = None
    literal: str | None = Field(
        default=None,
        description="As IEC literal: `TRUE`, `T#1s500ms`, `'abc'`; a number in the format of attribute "
        "'displaymode'.",
    )
    forced: bool = False
    error: str | None = None


class Values(Reply):
    """Values in the order asked for."""

    values: list[Value]


class NewValue(Request):
    """A value to write or force: JSON of the fitting kind, or an IEC literal as text."""

    expression: Expression
    value: JsonValue


class WriteOrder(Request):
    """Values to write or force; all or none, together at the beginning of a cycle."""

    values: Annotated[list[NewValue], Field(min_length=1, max_length=MAX_EXPRESSIONS)]


class UnforceOrder(Request):
    """Forced variables to release; null: all."""

    expressions: Annotated[list[Expression], Field(max_length=MAX_EXPRESSIONS)] | None
    restore: bool = Field(default=False, description="Give the variables back what they held before.")


class ForcedValue(Value):
    """A forced variable with the value it is held at, and where the force comes from."""

    before: str | None = Field(default=None, description="What it held before, as IEC literal.")
    user: str = Field(default="", description="Who has forced it.")
    source: str = Field(
        default="",
        description="workbench, api, or wire (a client of the runtime itself); empty where it is not known.",
    )
    program: str = Field(default="", description="What a script calls itself, such as `curl/8.5.0`.")
    address: str = Field(default="", description="Network address of the browser or script.")
    at: datetime | None = Field(default=None, description="When it got this value.")


class Forces(Reply):
    """The forced variables with the values that are forced."""

    values: list[ForcedValue]
