"""A property; its accessors are its children."""

from __future__ import annotations

from tappet.iec.sections import end_keyword
from tappet.project.data import DeclarationData
from tappet.project.declared_kind import declared_kind
from tappet.project.kinds.accessor import AccessorData
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import Child, Codesys, Naming, ObjectKind, Placement, Plcopen, TwinCat
from tappet.project.source_text import SourceWriter


class PropertyData(DeclarationData):
    """PROPERTY of a function block, a program or an interface."""


def _source(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    declaration = item.data_as(PropertyData).declaration
    writer.part(item.id, "declaration", declaration)
    for accessor in project.children(item.id):
        data = accessor.data
        if not isinstance(data, AccessorData) or accessor.excluded:
            continue
        keyword = accessor.name.upper()
        writer.keyword(keyword)
        if data.declaration:
            writer.part(accessor.id, "declaration", data.declaration)
        writer.inner_body(accessor, item.name, data.implementation, data.language)
        writer.keyword(f"END_{keyword}")
    writer.keyword(end_keyword(declaration))


PROPERTY = declared_kind(
    ObjectKind(
        name="property",
        words="property",
        description="A property; its accessors are its children.",
        data=PropertyData,
        placement=Placement(parents=("pou", "interface"), parent_subkinds=("program", "function_block")),
        naming=Naming(proposal="Prop"),
        order=110,
        new=lambda name: PropertyData(declaration=f"PROPERTY {name} : BOOL"),
        children=(Child("accessor", "Get"), Child("accessor", "Set")),
        plcopen=Plcopen(write=lambda writer, item: writer.property(item), data="property", member=True),
        twincat=TwinCat(tag="Property", member=True, read=lambda element, draft: element.accessors(draft)),
        codesys=Codesys(type_ids=("5a3b8626d3e94f3798b566420063d91e",)),
    ),
    declared_as=("property",),
    end="END_PROPERTY",
    source=_source,
)
