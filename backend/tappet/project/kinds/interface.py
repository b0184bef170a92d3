"""An interface; its methods and properties are its children."""

from __future__ import annotations

from tappet.project.data import DeclarationData
from tappet.project.declared_kind import declared_kind
from tappet.project.object_kind import CODE_PLACES, Codesys, Naming, ObjectKind, Placement, Plcopen, TwinCat


class InterfaceData(DeclarationData):
    """INTERFACE and what it extends."""


INTERFACE = declared_kind(
    ObjectKind(
        name="interface",
        words="interface",
        description="An interface; its methods and properties are its children.",
        data=InterfaceData,
        placement=Placement(parents=CODE_PLACES),
        naming=Naming(proposal="ITF"),
        order=60,
        new=lambda name: InterfaceData(declaration=f"INTERFACE {name}"),
        plcopen=Plcopen(
            tags=("Interface",),
            read=lambda reader, element: reader.interface(element),
            write=lambda writer, item: writer.interface(item),
            data="interface",
        ),
        twincat=TwinCat(tag="Itf"),
        codesys=Codesys(type_ids=("6654496c404d479aaad28551054e5f1e",)),
    ),
    declared_as=("interface",),
    end="END_INTERFACE",
    members="inside",
    in_library=True,
)
