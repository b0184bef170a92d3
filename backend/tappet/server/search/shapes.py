"""What is searched for, what was found, what is to be replaced."""

from __future__ import annotations

from pydantic import Field

from tappet.project.search.query import Area, Query
from tappet.server.builds.shapes import Part
from tappet.server.shapes import Number, Reply, Request


class SearchQuery(Request):
    """What is searched for."""

    text: str = Field(description="At most 1000 characters.")
    match_case: bool = False
    whole_words: bool = False
    regular_expression: bool = Field(
        default=False, description="RE2 syntax: no look-around, no back references."
    )
    areas: list[Area] = Field(default=list(Area), description="Which parts of objects.")

    def query(self) -> Query:
        """For the project room."""
        return Query(
            self.text, self.match_case, self.whole_words, self.regular_expression, frozenset(self.areas)
        )


class SearchOrder(SearchQuery):
    """What is searched for, and in which objects."""

    within: list[str] | None = Field(
        default=None, max_length=10_000, description="Ids of objects; null is the whole project."
    )
    children: bool = Field(default=True, description="Also what is below these objects.")
    libraries: bool = Field(
        default=False, description="Instead of the project the texts of the libraries it refers to."
    )
    replacement: str | None = Field(
        default=None, max_length=10_000, description="For a preview: what would replace each hit."
    )
    after: str | None = Field(default=None, description="Go on: `next` of the answer before.")
    limit: int = Field(default=2000, ge=1, le=20_000, description="Hits in one answer.")


class SearchHit(Reply):
    """A place where something was found; lines and columns count from 1, columns in code points."""

    number: int = Field(description="Of this hit in its object, from 0.")
    area: Area
    part: Part | None = Field(description="Null for names and tables.")
    element: str | None = Field(description="Id of the element in a drawn part.")
    field: str = Field(description="Which text of the data, such as `watchdog.time`; empty in parts.")
    line: int
    column: int
    end_line: int
    end_column: int
    before: str = Field(description="The line before the hit, cut on the left.")
    match: str
    after: str = Field(description="The line behind the hit, cut on the right.")
    replacement: str | None = Field(description="What would replace it, if that was asked for.")
    writable: bool = Field(description="Numbers and fixed names are found, but cannot be replaced.")


class SearchObject(Reply):
    """An object, or an item of a library, in which something was found."""

    object_id: str | None = Field(description="Null for an item of a library.")
    library: str | None = Field(description="Name of the library, else null.")
    name: str
    path: str
    kind: str
    subkind: str | None
    revision: int
    hits: list[SearchHit]
    total: int = Field(description="More than `hits` where the limit has cut them.")


class SearchReport(Reply):
    """What was found, in the order of the tree."""

    objects: list[SearchObject]
    next: str | None = Field(description="To go on with as `after`; null when everything was searched.")
    searched: int = Field(description="Number of objects that were searched for this answer.")


class ReplaceChoice(Request):
    """Hits of one object, which must be as it was when they were found."""

    object_id: str
    base_revision: Number
    hits: list[Number] = Field(max_length=20_000, description="Numbers of hits.")


class ReplaceOrder(Request):
    """What replaces the chosen hits of a search."""

    query: SearchQuery
    replacement: str = Field(
        max_length=10_000,
        description="With a regular expression `$1` is a group, `$0` the hit, `$$` a dollar sign, `\\n` "
        "a line break.",
    )
    objects: list[ReplaceChoice] = Field(max_length=10_000)


class ReplaceReport(Reply):
    """What was replaced."""

    hits: int
    objects: int = Field(description="Number of objects that are not as they were.")
    revision: int | None = Field(
        description="The change of the project, which can be taken back; null when nothing differs."
    )


class UndoReport(Reply):
    """A change was taken back."""

    revision: int = Field(description="The change of the project that it is.")
