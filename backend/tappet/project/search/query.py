"""What is searched for, and where."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from tappet.project.errors import ProjectError

MAX_TEXT = 1000
"""Characters of what is searched for."""


class Area(StrEnum):
    """A part of what objects consist of; every place of an object is in one of them."""

    DECLARATIONS = "declarations"
    IMPLEMENTATIONS = "implementations"
    COMMENTS = "comments"
    NAMES = "names"
    TABLES = "tables"


@dataclass(frozen=True, slots=True)
class Query:
    """What is searched for."""

    text: str
    match_case: bool = False
    whole_words: bool = False
    regular_expression: bool = False
    areas: frozenset[Area] = frozenset(Area)


class InvalidPatternError(ProjectError):
    """What is searched for is no text or no regular expression that can be searched for."""

    code = "invalid_pattern"


class InvalidReplacementError(ProjectError):
    """What shall replace refers to a group that the regular expression does not have."""

    code = "invalid_replacement"
