"""How the documentation of a project is printed: paper, margins, head and foot of the pages, its parts."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool, model_validator

from tappet.project.data import ENCODED, Data
from tappet.project.papers import PAPERS, Orientation, Paper
from tappet.project.picture import Base64Picture
from tappet.project.running_text import PlainLine, RunningText

LEAST_TEXT_MM = 60
"""Width and height of the text; less holds no table."""

Margin = Annotated[float, Field(strict=True, ge=5, le=100, allow_inf_nan=False)]


class Margins(Data):
    """Paper around the text, in mm; head and foot of the pages stand in them. Printers reach to 5 mm."""

    top: Margin = 22.0
    right: Margin = 17.0
    bottom: Margin = 20.0
    left: Margin = 17.0


class Running(Data):
    """What stands at the head or foot of each page, as plain text with placeholders such as {project}."""

    left: RunningText = ""
    centre: RunningText = ""
    right: RunningText = ""


class PageSetupData(Data):
    """How the documentation of a project is printed, as HTML and PDF."""

    paper: Paper = "a4"
    orientation: Orientation = "portrait"
    margins: Margins = Margins()
    title_page: StrictBool = True
    contents: StrictBool = Field(default=True, description="With a table of contents.")
    variables: StrictBool = Field(default=True, description="With tables of the variables that are declared.")
    cross_references: StrictBool = Field(
        default=False, description="With the places of all names of the project."
    )
    author: PlainLine = Field(default="", description="Empty: who prints.")
    company: PlainLine = ""
    logo: Base64Picture | None = Field(
        default=None,
        description="PNG or JPEG in base64, at most 256 KiB and 4,000 pixels a side.",
        json_schema_extra={ENCODED: "base64"},
    )
    logo_on_title_page: StrictBool = True
    logo_in_header: Literal["none", "left", "right"] = "none"
    header: Running = Field(
        default=Running(left="{project}"),
        description="Not on the title page, of which it would say the same.",
    )
    footer: Running = Running(right="{page_of_pages}")

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the sheet in mm, as it is oriented."""
        width, height = PAPERS[self.paper]
        return (width, height) if self.orientation == "portrait" else (height, width)

    @model_validator(mode="after")
    def _has_room_for_text(self) -> PageSetupData:
        width, height = self.size
        sides = (
            ("left and right", self.margins.left + self.margins.right, width),
            ("top and bottom", self.margins.top + self.margins.bottom, height),
        )
        for names, taken, whole in sides:
            if whole - taken < LEAST_TEXT_MM:
                raise ValueError(
                    f"the margins {names} leave {max(0, whole - taken):g} mm of {whole:g} mm to the text, "
                    f"which needs {LEAST_TEXT_MM} mm: together they may have {whole - LEAST_TEXT_MM:g} mm"
                )
        return self
