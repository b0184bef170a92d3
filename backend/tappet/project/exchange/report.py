"""What an import did: one entry for each object and for each thing that could not be read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Field

from tappet.project.errors import ProjectError

Outcome = Literal["imported", "changed", "refused", "kept", "overwritten", "merged", "skipped"]

MAX_ENTRIES = 20_000
"""Entries of one report; what comes after is counted in the last one."""


class ExchangeError(ProjectError):
    """A file cannot be read at all; the message begins with its path and, where known, the line."""

    code = "exchange"

    def __init__(self, source: str, message: str, line: int | None = None) -> None:
        place = source if line is None else f"{source}:{line}"
        super().__init__(f"{place}: {message}")
        self.source = source
        self.line = line


class Entry(BaseModel):
    """One line of a report."""

    SENTENCES: ClassVar = ("text",)

    model_config = ConfigDict(frozen=True, json_schema_serialization_defaults_required=True)

    source: str = Field(description="The file, by the name it was given under.")
    line: int | None = Field(default=None, description="Line in the file, from 1; null: the file as a whole.")
    object: str = Field(default="", description="The object, such as FB_Motor.Start; empty: none.")
    outcome: Outcome = Field(
        description="imported: as it was; changed: with a difference that the text describes; kept: stored "
        "unchanged but not compiled; refused: not in the project; overwritten, merged, skipped: what was "
        "decided for an object that exists already."
    )
    text: str = Field(default="", description="What was changed or why it could not be read.")
    object_id: str | None = Field(default=None, description="The object in the project; null: none.")

    def __str__(self) -> str:
        place = self.source if self.line is None else f"{self.source}:{self.line}"
        name = f" {self.object}" if self.object else ""
        return f"{place}: {self.outcome}{name}{': ' + self.text if self.text else ''}"


class ImportReport(BaseModel):
    """Everything an import has to say."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=True)

    entries: list[Entry] = Field(default_factory=list)

    def add(
        self,
        outcome: Outcome,
        source: str,
        text: str = "",
        *,
        name: str = "",
        line: int | None = None,
        object_id: str | None = None,
    ) -> None:
        """Append an entry; past the limit only the last entry counts on."""
        if len(self.entries) < MAX_ENTRIES:
            self.entries.append(
                Entry(source=source, line=line, object=name, outcome=outcome, text=text, object_id=object_id)
            )
        else:
            note = f"more than {MAX_ENTRIES} entries; the further ones are left out"
            self.entries[-1] = Entry(source=source, outcome=outcome, text=note)

    def add_objects(self, placed: Mapping[tuple[str, int | None], str]) -> None:
        """Give the entries whose object is known by its file and line the id it has in the project."""
        self.entries = [
            entry
            if entry.object_id is not None or entry.outcome == "refused" or entry.line is None
            else entry.model_copy(update={"object_id": placed.get((entry.source, entry.line))})
            for entry in self.entries
        ]

    def counts(self) -> dict[Outcome, int]:
        """Number of entries of each outcome that occurs."""
        return dict(Counter(entry.outcome for entry in self.entries))

    def noteworthy(self) -> Iterable[Entry]:
        """The entries a person should read: all but plain imports."""
        return (entry for entry in self.entries if entry.outcome != "imported")

    def summary(self) -> str:
        """One line such as `212 imported, 3 changed, 1 refused`."""
        counts = self.counts()
        order: tuple[Outcome, ...] = (
            "imported",
            "changed",
            "overwritten",
            "merged",
            "kept",
            "skipped",
            "refused",
        )
        return ", ".join(f"{counts[key]} {key}" for key in order if key in counts) or "nothing imported"
