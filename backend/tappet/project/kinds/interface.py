"""An interface; its methods and properties are its children."""

from __future__ import annotations

from tappet.iec.sections import end_keyword
from tappet.project.data import DeclarationData
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import (
    CODE_PLACES,
    Codesys,
    Compiled,
    IecText,
    Naming,
    ObjectKind,
    Placement,
    Plcopen,
    TwinCat,
    with_header_name,
)
from tappet.project.source_text import SourceWriter


class InterfaceData(DeclarationData):
    """INTERFACE and what it extends."""


def _source(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    declaration = item.data_as(InterfaceData).declaration
    writer.part(item.id, "declaration", declaration)
    writer.keyword(end_keyword(declaration))


INTERFACE = ObjectKind(
    name="interface",
    words="interface",
    description="An interface; its methods and properties are its children.",
    data=InterfaceData,
    placement=Placement(parents=CODE_PLACES),
    naming=Naming(proposal="ITF"),
    order=60,
    new=lambda name: InterfaceData(declaration=f"INTERFACE {name}"),
    compiled=Compiled(source=_source, members="inside", in_library=True),
    renamed=with_header_name,
    folder=IecText(end=lambda name, declaration: "END_INTERFACE", declared_as=("interface",)),
    reported=True,
    plcopen=Plcopen(
        tags=("Interface",),
        read=lambda reader, element: reader.interface(element),
        write=lambda writer, item: writer.interface(item),
        data="interface",
    ),
    twincat=TwinCat(tag="Itf"),
    codesys=Codesys(type_ids=("6654496c404d479aaad28551054e5f1e",)),
)
