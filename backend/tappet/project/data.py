"""What the data of object kinds are made of: what an object holds besides its place and name.

Each kind defines its own data with these in `kinds`.
"""

from __future__ import annotations

import json
from typing import Annotated

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StrictBool,
    model_validator,
)
from pydantic.fields import FieldInfo

from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError

ENCODED = "contentEncoding"
"""In the JSON schema of a field: its text is other content, which is not searched or printed as text."""
MAX_TEXT = 16 * 1024 * 1024
"""Characters in one text of an object; more is no source but a data file."""


def _clean_text(text: str) -> str:
    """The text without byte order mark and with line feeds as the only line breaks.

    NUL is refused: no database keeps it.
    """
    text = text.lstrip("\ufeff")
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    position = text.find("\x00")
    if position >= 0:
        line = text.count("\n", 0, position) + 1
        raise ValueError(f"line {line} contains the character U+0000, which no text can hold")
    return text


def _clean_time(text: str) -> str:
    try:
        duration_ns(text)
    except InvalidTimeError as error:
        raise ValueError(str(error)) from None
    return text.strip()


def _microseconds_as_text(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) and value >= 0 else value


Text = Annotated[str, Field(max_length=MAX_TEXT), AfterValidator(_clean_text)]
Line = Annotated[str, Field(max_length=4000), AfterValidator(_clean_text)]
Duration = Annotated[str, BeforeValidator(_microseconds_as_text), AfterValidator(_clean_time)]
"""A TIME literal (`T#20ms`) or a number of microseconds as text (`300`); TASK-17."""
LanguageName = Annotated[str, Field(pattern=r"^[A-Z][A-Z0-9_]{0,19}$")]
"""One of `iec.languages`, or of a plug-in that is not installed here; what is in it is kept then."""


class Data(BaseModel):
    """Base of the data of all object kinds: frozen, and nothing unknown is swallowed.

    What is read has every field, those with defaults too, and the API document says so.
    """

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        ser_json_inf_nan="null",
        json_schema_serialization_defaults_required=True,
    )

    @property
    def subkind(self) -> str | None:
        """What the declaration text says this is (`program`, `struct` ...), None where the kind says it
        all."""
        return None


def encoded_fields(model: type[BaseModel]) -> frozenset[str]:
    """The fields whose texts are encoded content, such as a picture."""
    return frozenset(name for name, field in model.model_fields.items() if _is_encoded(field))


def _is_encoded(field: FieldInfo) -> bool:
    extra = field.json_schema_extra
    return isinstance(extra, dict) and ENCODED in extra


class NoData(Data):
    """Data of objects that are nothing but a place in the tree."""


class CodeData(Data):
    """Base of what is compiled."""

    exclude_from_build: StrictBool = Field(
        default=False,
        description="The compiler does not get this object, nor what is below it.",
        exclude_if=lambda excluded: not excluded,
    )


class BodyData(CodeData):
    """A declaration and its implementation, edited apart and compiled together."""

    declaration: Text = ""
    implementation: Text = ""
    language: LanguageName = "ST"


class DeclarationData(CodeData):
    """Base of what is only declaration text: property, interface, DUT, variable list."""

    declaration: Text = ""


SPLIT_TEXTS = "$texts"
"""Stands in the data of an object whose plug-in is missing: which fields are text files of their own in a
folder, and their endings."""


class UnknownData(Data):
    """Data of a kind whose plug-in is missing: kept as they are (CON-03)."""

    model_config = ConfigDict(extra="allow")

    @model_validator(mode="before")
    @classmethod
    def _is_json(cls, value: object) -> object:
        try:
            json.dumps(value, allow_nan=False, ensure_ascii=False).encode()
        except (TypeError, ValueError, RecursionError) as error:
            if isinstance(value, UnknownData):
                return value
            raise ValueError(f"the data of a plug-in must be JSON ({error})") from None
        return value
