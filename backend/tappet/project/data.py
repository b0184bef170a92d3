"""The data of every object kind: what an object holds besides its place and name."""

from __future__ import annotations

import json
from typing import Annotated, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StrictBool,
    StrictInt,
    model_validator,
)

from tappet.project.durations import duration_ns
from tappet.project.errors import InvalidTimeError

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
RuleCode = Annotated[str, Field(pattern=r"^S[0-9]{4}$")]
Prefix = Annotated[str, Field(pattern=r"^[A-Za-z0-9_]{0,20}$")]
Language = Literal["ST", "IL", "LD", "FBD", "CFC", "SFC"]


class Data(BaseModel):
    """Base of the data of all object kinds: frozen, and nothing unknown is swallowed."""

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="null")


class NoData(Data):
    """Data of objects that are nothing but a place in the tree."""


class DeviceData(Data):
    """A device of the Devices view (CON-01)."""

    device_type: Line = Field(
        default="tappet.softplc", description="Device description that this device follows."
    )
    runtime_id: Line | None = Field(
        default=None, description="Runtime that the active path leads to (COM-10)."
    )
    simulated: StrictBool = Field(
        default=False, description="Run in the simulation instead of the runtime (ONL-08)."
    )
    description: Text = ""


class StaticAnalysisData(Data):
    """The coding rules of an application (`tappet check --static`); what is not named is as it is for all."""

    with_build: StrictBool = Field(default=True, description="The rules run with every build.")
    rules: dict[RuleCode, Literal["warning", "error"]] = Field(
        default_factory=dict, description="Rules that are switched on, by code, and what their findings are."
    )
    prefixes: dict[Line, Prefix] = Field(
        default_factory=dict, description="What names begin with, by kind of object or type."
    )
    limits: dict[Line, Annotated[StrictInt, Field(ge=0, le=1_000_000)]] = Field(
        default_factory=dict, description="Limits of sizes, by what they limit."
    )


NO_RULES = StaticAnalysisData()


class ApplicationData(Data):
    """An application: how it is checked."""

    static_analysis: StaticAnalysisData = Field(
        default=NO_RULES, exclude_if=lambda chosen: chosen == NO_RULES
    )


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
    language: Language = "ST"


class PouData(BodyData):
    """PROGRAM, FUNCTION_BLOCK or FUNCTION: the declaration says which (POU-01)."""


class MethodData(BodyData):
    """METHOD of a function block, a program or an interface (POU-09)."""


class AccessorData(BodyData):
    """Get or Set of a property; the declaration holds local variables only."""


class ActionData(CodeData):
    """ACTION: a further body that works on the variables of its POU (POU-08)."""

    implementation: Text = ""
    language: Language = "ST"


class DeclarationData(CodeData):
    """An object that is only declaration text: property, interface, DUT, variable list."""

    declaration: Text = ""


class ProgramCall(Data):
    """A program that a task calls, in the order of the list (TASK-20, TASK-21)."""

    name: Line = Field(min_length=1, description="Name of the program, e.g. PLC_PRG.")
    comment: Line = ""


class WatchdogData(Data):
    """Watchdog of a task (TASK-30..33)."""

    enabled: StrictBool = False
    time: Duration = Field(default="T#100ms", description="Longest allowed duration of a cycle.")
    sensitivity: StrictInt = Field(
        default=1, ge=0, le=1_000_000, description="Number of overruns that are one too many."
    )


class TaskData(Data):
    """A task: when it runs and what it calls (tasks.md, section 2)."""

    priority: StrictInt = Field(
        default=1, ge=0, le=31, description="0 is the highest, 31 the lowest (TASK-11)."
    )
    type: Literal["cyclic", "freewheeling", "event", "status", "external"] = "cyclic"
    interval: Duration = Field(
        default="T#20ms", description="TIME literal or microseconds; cyclic tasks (TASK-12)."
    )
    event: Line = Field(default="", description="Path of the BOOL variable, or the system event (TASK-18).")
    watchdog: WatchdogData = WatchdogData()
    pous: tuple[ProgramCall, ...] = ()

    @model_validator(mode="after")
    def _cyclic_needs_interval(self) -> TaskData:
        if self.type == "cyclic" and duration_ns(self.interval) == 0:
            raise ValueError("a cyclic task needs an interval longer than 0, such as T#20ms")
        return self


class LibraryParameterData(Data):
    """A value that a library reference gives to a parameter of the library, in place of the library's own."""

    list: Line = Field(
        default="", description="The parameter list; empty: the parameter is known by its name alone."
    )
    name: Line = Field(min_length=1)
    value: Line = Field(min_length=1, description="A constant expression of the type of the parameter.")


class LibraryReferenceData(Data):
    """A library that an application uses (LIB-02, LIB-08)."""

    name: Line = Field(min_length=1, description="The library; of a placeholder, what it is resolved by.")
    placeholder: Annotated[Line, Field(min_length=1)] | None = Field(
        default=None,
        description="Name of the placeholder: libraries that ask for it get this library.",
        exclude_if=lambda placeholder: placeholder is None,
    )
    version: Line = Field(
        default="*", min_length=1, description="A version, or * for the newest installed one."
    )
    namespace: Line = Field(
        default="", description="Prefix of the library's names; empty means its own namespace."
    )
    parameters: tuple[LibraryParameterData, ...] = Field(
        default=(),
        description="Parameters of the library that have another value here.",
        exclude_if=lambda parameters: not parameters,
    )

    @model_validator(mode="after")
    def _one_value_each(self) -> LibraryReferenceData:
        seen = set()
        for parameter in self.parameters:
            key = (parameter.list.upper(), parameter.name.upper())
            if key in seen:
                name = f"{parameter.list}.{parameter.name}".strip(".")
                raise ValueError(f"the parameter '{name}' of '{self.name}' has two values; one holds")
            seen.add(key)
        return self


class LibraryManagerData(Data):
    """The libraries of one application or of the POUs view."""

    references: tuple[LibraryReferenceData, ...] = ()


class UnknownData(BaseModel):
    """Data of a kind whose plug-in is missing: kept as they are (CON-03)."""

    model_config = ConfigDict(frozen=True, extra="allow")

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
