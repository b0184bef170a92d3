"""A method of a function block, a program or an interface (POU-09)."""

from __future__ import annotations

from tappet.project.data import BodyData
from tappet.project.declared_kind import declared_kind
from tappet.project.object_kind import Codesys, Naming, ObjectKind, Placement, Plcopen, TwinCat


class MethodData(BodyData):
    """METHOD of a function block, a program or an interface (POU-09)."""


METHOD = declared_kind(
    ObjectKind(
        name="method",
        words="method",
        description="A method.",
        data=MethodData,
        placement=Placement(parents=("pou", "interface"), parent_subkinds=("program", "function_block")),
        naming=Naming(proposal="Meth"),
        order=100,
        new=lambda name: MethodData(declaration=f"METHOD {name} : BOOL\nVAR_INPUT\nEND_VAR"),
        plcopen=Plcopen(write=lambda writer, item: writer.method(item), data="method", member=True),
        twincat=TwinCat(tag="Method", member=True),
        codesys=Codesys(type_ids=("f8a58466d7f6439fbbb8d4600e41d099", "f89f767527f146b38abbb7da8e774ffd")),
    ),
    declared_as=("method",),
    end="END_METHOD",
)
