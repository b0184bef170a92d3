"""What a request says of printing, over what the page setup of the project says, over the defaults."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field, StrictBool, ValidationError

from tappet.documentation.words import Language
from tappet.project.errors import InvalidDataError, ProjectError
from tappet.project.kinds.page_setup import PAGE_SETUP
from tappet.project.model import Project
from tappet.project.objects import describe
from tappet.project.page_setup import PageSetupData
from tappet.project.papers import Orientation, Paper
from tappet.project.running_text import PlainLine, RunningText

_OVERRIDES = (
    "paper",
    "orientation",
    "title_page",
    "contents",
    "variables",
    "cross_references",
    "author",
)


class Printing(BaseModel):
    """What is printed, and how; None is as the page setup of the project has it."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    language: Language = "en"
    objects: frozenset[str] | None = Field(
        default=None, max_length=100_000, description="Ids of the objects that are printed; null: all."
    )
    paper: Paper | None = None
    orientation: Orientation | None = None
    title_page: StrictBool | None = None
    contents: StrictBool | None = None
    variables: StrictBool | None = None
    cross_references: StrictBool | None = None
    author: PlainLine | None = None
    footer: RunningText | None = Field(default=None, description="At the left of the foot of each page.")
    printed_by: str = Field(default="", description="The author where neither names one.")


def page_setup_of(project: Project) -> PageSetupData:
    """The page setup of a project, or the one that holds without."""
    found = project.find_kind(PAGE_SETUP.name)
    if not found:
        return PageSetupData()
    data = found[0].data
    if not isinstance(data, PageSetupData):
        raise ProjectError(
            f"The data of '{found[0].name}' do not fit this version of Tappet; delete it or mend it"
        )
    return data


def setup_for(project: Project, printing: Printing) -> PageSetupData:
    """The page setup with what the request says instead.

    Raises InvalidDataError where they do not go together.
    """
    setup = page_setup_of(project)
    given = {name: value for name in _OVERRIDES if (value := getattr(printing, name)) is not None}
    changed: dict[str, Any] = {name: getattr(setup, name) for name in PageSetupData.model_fields} | given
    if printing.footer is not None:
        changed["footer"] = setup.footer.model_copy(update={"left": printing.footer})
    if not changed["author"]:
        changed["author"] = printing.printed_by
    try:
        return PageSetupData.model_validate(changed)
    except ValidationError as error:
        raise InvalidDataError(f"This cannot be printed: {describe(error)}") from error
