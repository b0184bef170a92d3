"""The list of persistent variables of an application (PERS-02)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tappet.iec.tokens import words
from tappet.project.data import DeclarationData
from tappet.project.declared_kind import declared_kind
from tappet.project.object_kind import Codesys, Merging, Naming, ObjectKind, Placement, Plcopen


class PersistentData(DeclarationData):
    """VAR_GLOBAL PERSISTENT RETAIN ... END_VAR."""


def _claims(text: str) -> bool:
    """Whether the first section of a list is persistent."""
    for word in words(text):
        if word.text == "PERSISTENT":
            return True
        if word.text not in ("VAR_GLOBAL", "RETAIN", "CONSTANT"):
            break
    return False


def _joined(old: PersistentData, new: Mapping[str, Any]) -> dict[str, Any]:
    return {"declaration": "\n".join([old.declaration.rstrip("\n"), new.get("declaration", "")])}


PERSISTENT = declared_kind(
    ObjectKind(
        name="persistent",
        words="persistent",
        description="The list of persistent variables of an application.",
        data=PersistentData,
        placement=Placement(parents=("application",), once=True),
        naming=Naming(proposal="PersistentVars", from_imports="adapted"),
        order=90,
        new=lambda name: PersistentData(declaration="VAR_GLOBAL PERSISTENT RETAIN\nEND_VAR"),
        merging=Merging(
            join=_joined, note="its variables stand in the persistent list '{name}', which was there already"
        ),
        plcopen=Plcopen(write=lambda writer, item: writer.variable_list(item), data="globalvars"),
        codesys=Codesys(type_ids=("261bd6e6249c4232bb6f84c2fbeef430",)),
    ),
    declared_as=("gvl",),
    claims=_claims,
    names_itself=False,
)
