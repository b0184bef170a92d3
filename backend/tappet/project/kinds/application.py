"""An application: what is compiled and downloaded as one (CON-05)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field, StrictBool, StrictInt

from tappet.iec.heap import DEFAULT_HEAP, KIB, LARGEST_HEAP_KIB, HeapSettings
from tappet.iec.memory import DEFAULT_RESERVE, LARGEST_RESERVE_KIB, ChangeReserve
from tappet.project.data import Data, Line
from tappet.project.object_kind import Child, Codesys, JsonFile, Naming, ObjectKind, Placement, Plcopen

RuleCode = Annotated[str, Field(pattern=r"^S[0-9]{4}$")]
WarningCode = Annotated[str, Field(pattern=r"^W[0-9]{4}$")]
Prefix = Annotated[str, Field(pattern=r"^[A-Za-z0-9_]{0,20}$")]


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


class HeapData(Data):
    """The memory that `__NEW` of an application takes from (docs/memory.md)."""

    limit_kib: Annotated[StrictInt, Field(ge=0, le=LARGEST_HEAP_KIB)] = Field(
        default=DEFAULT_HEAP.limit // KIB,
        description="KiB that __NEW may take in all, guards included; with 0 it gives nothing.",
    )
    poison: StrictBool = Field(
        default=DEFAULT_HEAP.poison, description="Memory is filled when __DELETE gives it back."
    )

    @property
    def settings(self) -> HeapSettings:
        """As a build takes them."""
        return HeapSettings(self.limit_kib * KIB, self.poison)


USUAL_HEAP = HeapData()


class ChangeReserveData(Data):
    """The memory that a download sets aside for online changes."""

    percent: Annotated[StrictInt, Field(ge=0, le=1000)] = Field(
        default=DEFAULT_RESERVE.percent, description="Percent of the data of the application."
    )
    least_kib: Annotated[StrictInt, Field(ge=0, le=LARGEST_RESERVE_KIB)] = Field(
        default=DEFAULT_RESERVE.least // KIB, description="KiB at least."
    )

    @property
    def settings(self) -> ChangeReserve:
        """As a build takes them."""
        return ChangeReserve(self.percent, self.least_kib * KIB)


USUAL_RESERVE = ChangeReserveData()


SourceDownload = Literal["never", "on_demand", "prompt", "download"]


def _sorted(codes: tuple[str, ...]) -> tuple[str, ...]:
    """Each once, in one order: two people who switch the same ones off store the same file."""
    return tuple(sorted(set(codes)))


class ApplicationData(Data):
    """An application: how it is checked, and the memory that it may take."""

    static_analysis: StaticAnalysisData = Field(
        default=NO_RULES, exclude_if=lambda chosen: chosen == NO_RULES
    )
    heap: HeapData = Field(default=USUAL_HEAP, exclude_if=lambda chosen: chosen == USUAL_HEAP)
    change_reserve: ChangeReserveData = Field(
        default=USUAL_RESERVE, exclude_if=lambda chosen: chosen == USUAL_RESERVE
    )
    disabled_warnings: Annotated[tuple[WarningCode, ...], AfterValidator(_sorted)] = Field(
        default=(),
        max_length=10_000,
        description="Codes of the compiler's warnings and notes that are not reported.",
        exclude_if=lambda codes: not codes,
    )
    source_download: SourceDownload = Field(
        default="on_demand",
        description="When the source of the project goes into the controller: never, by a command only, when "
        "the user agrees at a download, or with each download and online change.",
        exclude_if=lambda when: when == "on_demand",
    )


APPLICATION = ObjectKind(
    name="application",
    words="application",
    description="An application: what is compiled and downloaded as one.",
    data=ApplicationData,
    placement=Placement(parents=("plc_logic", "application"), in_folders=False),
    naming=Naming(proposal="Application", from_imports="adapted"),
    order=40,
    children=(
        Child("library_manager", "Library Manager"),
        Child("task_configuration", "Task Configuration"),
    ),
    folder=JsonFile(optional=True),
    plcopen=Plcopen(),
    codesys=Codesys(type_ids=("639b491f5557464caf911471bac9f549",)),
)
