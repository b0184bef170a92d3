"""Kinds of objects whose data are a declaration, or a declaration and a body.

They share how their text is written for the compiler, kept in a folder and renamed; `declared_kind` completes
a descriptor with that.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Literal, TypeVar

from tappet.iec.sections import end_keyword
from tappet.project.data import BodyData, DeclarationData
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import Compiled, IecText, ObjectKind, with_header_name
from tappet.project.source_text import SourceWriter

_Declared = TypeVar("_Declared", bound=BodyData | DeclarationData)
_Source = Callable[[Project, ProjectObject, SourceWriter], None]


def declared_kind(
    kind: ObjectKind[_Declared],
    *,
    declared_as: tuple[str, ...],
    end: Callable[[str, str], str | None] | str | None = None,
    source: _Source | None = None,
    names_itself: bool = True,
    members: Literal["none", "beside", "inside"] = "none",
    in_library: bool = False,
    claims: Callable[[str], bool] | None = None,
) -> ObjectKind[_Declared]:
    """`kind` with what follows from its having a declaration.

    `end` is the keyword that ends a text of the kind, or tells it from the name and the declaration.
    `names_itself` says whether the object's name stands in the declaration. `source` writes the text where it
    is more than declaration and body; the other arguments are those of `Compiled` and `IecText`.
    """
    with_body = issubclass(kind.data, BodyData)
    if with_body:
        usual = _declaration_and_body
    elif end is not None:
        usual = _declaration_and_end
    else:
        usual = _declaration if names_itself else _variables
    return replace(
        kind,
        written=with_body,
        compiled=Compiled(source=source or usual, members=members, in_library=in_library),
        renamed=with_header_name if names_itself else None,
        folder=IecText(
            implementation=with_body,
            end=(lambda name, declaration: end) if isinstance(end, str) else end,
            declared_as=declared_as,
            claims=claims,
        ),
        reported=True,
    )


def _declaration(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    writer.part(item.id, "declaration", item.data_as(DeclarationData).declaration)


def _variables(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    writer.name = item.name
    _declaration(project, item, writer)


def _declaration_and_end(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    _declaration(project, item, writer)
    writer.keyword(end_keyword(item.data_as(DeclarationData).declaration))


def _declaration_and_body(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    writer.declared_body(item, item.data_as(BodyData))
