"""Which objects of a project a request is about: those that are named with all below them, or all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends, Query

from tappet.project.exchange.parts import chosen_ids, part_of
from tappet.project.model import Project


@dataclass(frozen=True, slots=True)
class Part:
    """Ids of objects; without any the whole project is meant."""

    objects: list[str]
    without: list[str]

    def ids(self, project: Project) -> frozenset[str] | None:
        """Those of all objects that are meant; None: all. Raises UnknownObjectError."""
        return chosen_ids(project, self.objects, self.without) if self.objects or self.without else None

    def of(self, project: Project) -> Project:
        """The part with what it stands in. Raises UnknownObjectError."""
        return part_of(project, self.objects, self.without) if self.objects or self.without else project


def _part(
    objects: Annotated[
        list[str],
        Query(alias="object", description="Only these objects with all below them; none: everything."),
    ] = [],  # noqa: B006
    without: Annotated[
        list[str],
        Query(description="Not these objects with all below them, but for what `object` names of it."),
    ] = [],  # noqa: B006
) -> Part:
    return Part(objects, without)


PartDep = Annotated[Part, Depends(_part)]
