"""What all CNC programs of an application share: path preprocessing, interpolation, columns of their tables.

Spec views_watch.md CNCS-01 to CNCS-11.
"""

from __future__ import annotations

from typing import Annotated, Literal, get_args

from pydantic import Field, StrictBool, StrictInt, model_validator

from tappet.project.data import Data
from tappet.project.naming import name_key

MOST_BLOCKS = 100
LONGEST_INTERPOLATION_US = 1_000_000

ColumnName = Literal[
    "n", "x", "y", "z", "i", "j", "k", "r", "t", "f", "acceleration", "deceleration", "d", "s",
    "a", "b", "c", "p", "q", "u", "v", "w", "ff", "ef", "l", "o", "h", "comment",
]  # fmt: skip
COLUMN_NAMES: tuple[ColumnName, ...] = get_args(ColumnName)
USUALLY_HIDDEN: frozenset[ColumnName] = frozenset(
    {"t", "s", "a", "b", "c", "q", "u", "v", "w", "ff", "ef", "l", "o", "h"}
)


Identifier = Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_]*$", max_length=80)]
Pin = Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z_][A-Za-z0-9_]*)*$", max_length=160)]
LiteralText = Annotated[
    str,
    Field(
        pattern=r"^([+-]?[0-9]+(\.[0-9]*)?([eE][+-]?[0-9]+)?|[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z_][A-Za-z0-9_]*)?)$",
        max_length=160,
    ),
]


class BlockParameter(Data):
    """An input of a block that does not have its initial value (CNCS-09)."""

    name: Pin = Field(description="The input; `vec.dX` for a member of one that is a structure.")
    value: LiteralText = Field(description="A number, TRUE, FALSE, or a value of an enumeration.")


class PreprocessingBlock(Data):
    """An instance of a function block that reads a path queue and writes another one (CNCS-03)."""

    block: Identifier = Field(description="Name of the block in the library SM3_CNC.")
    parameters: tuple[BlockParameter, ...] = Field(default=(), max_length=100)

    @model_validator(mode="after")
    def _each_input_once(self) -> PreprocessingBlock:
        names = [name_key(one.name) for one in self.parameters]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise ValueError(f"the input {twice} has two values; remove one")
        return self


class TableColumn(Data):
    """A column of the table editor."""

    name: ColumnName
    visible: StrictBool = True


def usual_columns() -> tuple[TableColumn, ...]:
    """All columns in their usual order."""
    return tuple(TableColumn(name=name, visible=name not in USUALLY_HIDDEN) for name in COLUMN_NAMES)


class CncSettingsData(Data):
    """Settings of the CNC programs of an application."""

    preprocessing: tuple[PreprocessingBlock, ...] = Field(
        default=(),
        max_length=MOST_BLOCKS,
        description="What changes paths between decoder and velocity check, in the order of execution.",
    )
    interpolation_time_us: StrictInt = Field(
        default=20_000,
        ge=1,
        le=LONGEST_INTERPOLATION_US,
        description="Cycle time of the interpolator [us]; that of its task, or drawn and real motion differ.",
    )
    columns: tuple[TableColumn, ...] = Field(
        default_factory=usual_columns,
        description="Columns of the table editor in their order; the type of an element is always the first.",
    )

    @model_validator(mode="after")
    def _each_column_once(self) -> CncSettingsData:
        names = [column.name for column in self.columns]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise ValueError(f"the column {twice} stands there twice; remove one")
        return self
