"""An action: a further body that works on the variables of its POU (POU-08)."""

from __future__ import annotations

from tappet.project.data import CodeData, LanguageName, Text
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import (
    Codesys,
    Compiled,
    IecText,
    Naming,
    ObjectKind,
    Placement,
    Plcopen,
    TwinCat,
)
from tappet.project.source_text import SourceWriter


class ActionData(CodeData):
    """ACTION: a further body that works on the variables of its POU (POU-08)."""

    implementation: Text = ""
    language: LanguageName = "ST"


def _source(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    data = item.data_as(ActionData)
    writer.name = item.name
    writer.keyword(f"ACTION {item.name}")
    writer.body(item, data.implementation, data.language)
    writer.keyword("END_ACTION")


ACTION = ObjectKind(
    name="action",
    words="action",
    description="An action.",
    data=ActionData,
    placement=Placement(parents=("pou",), parent_subkinds=("program", "function_block")),
    naming=Naming(proposal="Act"),
    order=120,
    written=True,
    compiled=Compiled(source=_source),
    folder=IecText(
        declaration=False,
        implementation=True,
        opening=lambda name: f"ACTION {name}",
        end=lambda name, declaration: "END_ACTION",
        declared_as=("action",),
    ),
    reported=True,
    plcopen=Plcopen(),
    twincat=TwinCat(tag="Action", member=True),
    codesys=Codesys(type_ids=("8ac092e531284e269e7e11016c6684f2",)),
)
