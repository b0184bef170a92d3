"""An accessor: Get or Set of a property."""

from __future__ import annotations

from tappet.project.data import BodyData
from tappet.project.object_kind import Codesys, Compiled, IecText, Naming, ObjectKind, Placement, Plcopen


class AccessorData(BodyData):
    """Get or Set of a property; the declaration holds local variables only."""


ACCESSOR = ObjectKind(
    name="accessor",
    words="accessor",
    description="Get or Set of a property.",
    data=AccessorData,
    placement=Placement(parents=("property",), in_folders=False),
    naming=Naming(style="fixed", names=("Get", "Set")),
    order=130,
    written=True,
    compiled=Compiled(in_parent=True),
    folder=IecText(
        implementation=True,
        opening=str.upper,
        end=lambda name, declaration: f"END_{name.upper()}",
        declared_as=("get", "set"),
    ),
    plcopen=Plcopen(),
    codesys=Codesys(type_ids=("792f2eb6721e4e64ba20bc98351056db",)),
)
