"""A data unit type: structure, enumeration, alias, union, subrange (DUT-03)."""

from __future__ import annotations

from collections.abc import Callable

from tappet.iec.sections import subkind_of
from tappet.project.data import DeclarationData
from tappet.project.declared_kind import declared_kind
from tappet.project.object_kind import CODE_PLACES, Codesys, Naming, ObjectKind, Placement, Plcopen, TwinCat


class DutData(DeclarationData):
    """TYPE ... END_TYPE."""

    @property
    def subkind(self) -> str | None:
        """Of struct, enum, union, alias, subrange; None while the declaration says nothing."""
        return subkind_of(self.declaration)


_TEXTS = {
    "struct": "TYPE {name} :\nSTRUCT\nEND_STRUCT\nEND_TYPE",
    "enum": "{{attribute 'qualified_only'}}\nTYPE {name} :\n(\n    enum_member := 0\n);\nEND_TYPE",
    "union": "TYPE {name} :\nUNION\nEND_UNION\nEND_TYPE",
    "alias": "TYPE {name} : INT;\nEND_TYPE",
    "subrange": "TYPE {name} : INT (0..100);\nEND_TYPE",
}


def _template(text: str) -> Callable[[str], DutData]:
    return lambda name: DutData(declaration=text.format(name=name))


DUT = declared_kind(
    ObjectKind(
        name="dut",
        words="DUT",
        description="A data unit type: structure, enumeration, alias, union, subrange.",
        data=DutData,
        placement=Placement(parents=CODE_PLACES),
        naming=Naming(proposal="DUT"),
        order=70,
        templates={subkind: _template(text) for subkind, text in _TEXTS.items()},
        plcopen=Plcopen(
            tags=("dataType", "union"),
            read=lambda reader, element: reader.data_type(element),
            write=lambda writer, item: writer.data_type(item),
            container="dataTypes",
            data="datatype",
        ),
        twincat=TwinCat(
            tag="DUT",
            other_tags=("EnumerationTextList",),
            not_read={
                "XmlArchive": "it became an enumeration; the texts that its text list shows are not read"
            },
        ),
        codesys=Codesys(type_ids=("2db5746dd28444259f7f2663a34b0ebc",)),
    ),
    declared_as=tuple(_TEXTS),
    in_library=True,
)
