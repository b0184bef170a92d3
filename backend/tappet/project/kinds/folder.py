"""A folder: groups objects and says nothing to the compiler."""

from __future__ import annotations

from tappet.project.data import NoData
from tappet.project.object_kind import (
    CODE_PLACES,
    Codesys,
    JsonFile,
    Merging,
    Naming,
    ObjectKind,
    Placement,
    Plcopen,
)

FOLDER = ObjectKind(
    name="folder",
    words="folder",
    description="Groups objects; says nothing to the compiler.",
    data=NoData,
    placement=Placement(
        parents=(*CODE_PLACES, "folder", "pou", "interface"), parent_subkinds=("program", "function_block")
    ),
    naming=Naming(style="free", proposal="Folder", unique="place"),
    order=10,
    folder=JsonFile(optional=True),
    merging=Merging(by_name=True),
    plcopen=Plcopen(),
    codesys=Codesys(type_ids=("738bea1e99bb4f0490bba7a567e74e3a",)),
)
