"""A global variable list (GVL-01), or the parameter list of a library."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tappet.iec.parameter_list import PARAMETER_LIST, as_parameter_list, is_parameter_list
from tappet.project.data import DeclarationData
from tappet.project.declared_kind import declared_kind
from tappet.project.object_kind import CODE_PLACES, Codesys, Naming, ObjectKind, Placement, Plcopen, TwinCat


class GvlData(DeclarationData):
    """VAR_GLOBAL ... END_VAR."""

    @property
    def subkind(self) -> str | None:
        """Of parameter_list; None for other lists."""
        return "parameter_list" if is_parameter_list(self.declaration) else None


def _variable_list(name: str) -> GvlData:
    return GvlData(declaration="VAR_GLOBAL\nEND_VAR")


def _parameter_list(name: str) -> GvlData:
    sections = "VAR_GLOBAL CONSTANT\nEND_VAR"
    return GvlData(declaration=f"{{attribute 'qualified_only'}}\n{PARAMETER_LIST}\n{sections}")


def _mark(flag: Callable[[Any], str]) -> Callable[[Any, Any], None]:
    """Reads the flag that says that a list is one of parameters, which the text does not say."""

    def read(element: Any, draft: Any) -> None:
        if flag(element).casefold() == "true":
            draft.data["declaration"] = as_parameter_list(draft.data["declaration"])

    return read


GVL = declared_kind(
    ObjectKind(
        name="gvl",
        words="GVL",
        description="A global variable list, or the parameter list of a library.",
        data=GvlData,
        placement=Placement(parents=CODE_PLACES),
        naming=Naming(proposal="GVL", from_imports="adapted"),
        order=80,
        templates={"variable_list": _variable_list, "parameter_list": _parameter_list},
        plcopen=Plcopen(
            tags=("globalVars",),
            read=lambda reader, element: reader.variable_list(element),
            write=lambda writer, item: writer.variable_list(item),
            data="globalvars",
        ),
        twincat=TwinCat(tag="GVL", read=_mark(lambda element: element.item.get("ParameterList"))),
        codesys=Codesys(
            type_ids=("ffbfa93ab94d45fca329229860183b1d",),
            read=lambda reader, entry, draft: _mark(lambda one: one.value("IsParameterList"))(entry, draft),
        ),
    ),
    declared_as=("gvl",),
    names_itself=False,
    in_library=True,
)
