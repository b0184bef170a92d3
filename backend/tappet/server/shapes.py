"""Base classes of all JSON shapes of the API.

Request bodies refuse unknown fields, so that a misspelt one is an error and not silently ignored.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, StringConstraints
from pydantic_core import CoreSchema

Line = Annotated[str, StringConstraints(pattern=r"^[^\x00-\x1f\x7f]*$")]
"""Text without control characters; NUL would not fit into every database."""


Number = Annotated[int, Field(ge=0, le=(1 << 31) - 1)]
"""A row, a revision or a place in a list: what every database takes as an integer."""


SCALARS = ("int", "float", "bool")


def _make_strict(schema: Any) -> None:
    """Lets numbers and truths in a schema be nothing else: pydantic reads true as 1, "1" and 1.0 as 1."""
    if isinstance(schema, dict):
        if schema.get("type") in SCALARS:
            schema["strict"] = True
        for part in schema.values():
            _make_strict(part)
    elif isinstance(schema, list):
        for part in schema:
            _make_strict(part)


class Request(BaseModel):
    """What a client sends; taken by the types that the API document names."""

    model_config = ConfigDict(extra="forbid", str_max_length=4_000_000)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        _make_strict(schema)
        return schema


class Reply(BaseModel):
    """What the server sends; fields with defaults are always present."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=True)

    @classmethod
    def of(cls, item: object) -> Self:
        """What has attributes of the names of the fields, as this shape."""
        return cls.model_validate(item, from_attributes=True)


class InvalidField(Reply):
    """One field of a request that is wrong."""

    SENTENCES: ClassVar = ("message",)

    location: str = Field(description="Path of the field, such as `body.username`.")
    message: str


class ProblemDetails(BaseModel):
    """An error (RFC 9457). Further members depend on `type`."""

    model_config = ConfigDict(extra="allow")

    type: str = Field(description="`urn:tappet:problem:<kind>`; stable, to be tested by programs.")
    title: str
    status: int
    detail: str = Field(description="What is wrong with this request and what would be right.")
    errors: list[InvalidField] | None = Field(default=None, description="With `invalid-request`.")
