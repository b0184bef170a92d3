"""What all CNC programs of an application share: the columns of their tables (views_watch.md CNCS-11)."""

from __future__ import annotations

from typing import Literal, get_args

from pydantic import Field, StrictBool, model_validator

from tappet.project.data import Data

ColumnName = Literal[
    "n", "x", "y", "z", "i", "j", "k", "r", "t", "f", "acceleration", "deceleration", "d", "s",
    "a", "b", "c", "p", "q", "u", "v", "w", "ff", "ef", "l", "o", "h", "comment",
]  # fmt: skip
COLUMN_NAMES: tuple[ColumnName, ...] = get_args(ColumnName)
USUALLY_HIDDEN: frozenset[ColumnName] = frozenset(
    {"t", "s", "a", "b", "c", "q", "u", "v", "w", "ff", "ef", "l", "o", "h"}
)


class TableColumn(Data):
    """A column of the table editor."""

    name: ColumnName
    visible: StrictBool = True


def usual_columns() -> tuple[TableColumn, ...]:
    """All columns in their usual order."""
    return tuple(TableColumn(name=name, visible=name not in USUALLY_HIDDEN) for name in COLUMN_NAMES)


class CncSettingsData(Data):
    """Settings of the CNC programs of an application."""

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
