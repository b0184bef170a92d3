"""A POU: program, function block or function (POU-01)."""

from __future__ import annotations

from tappet.iec.sections import end_keyword, subkind_of
from tappet.project.data import BodyData
from tappet.project.declared_kind import declared_kind
from tappet.project.object_kind import CODE_PLACES, Codesys, Naming, ObjectKind, Placement, Plcopen, TwinCat


class PouData(BodyData):
    """PROGRAM, FUNCTION_BLOCK or FUNCTION: the declaration says which (POU-01)."""

    @property
    def subkind(self) -> str | None:
        """Of program, function_block, function; None while the declaration says nothing."""
        return subkind_of(self.declaration)


_ENDS = frozenset(["END_PROGRAM", "END_FUNCTION_BLOCK", "END_FUNCTION"])


def _end(name: str, declaration: str) -> str | None:
    end = end_keyword(declaration)
    return end if end in _ENDS else None


def _program(name: str) -> PouData:
    return PouData(declaration=f"PROGRAM {name}\nVAR\nEND_VAR")


def _function_block(name: str) -> PouData:
    sections = "VAR_INPUT\nEND_VAR\nVAR_OUTPUT\nEND_VAR\nVAR\nEND_VAR"
    return PouData(declaration=f"FUNCTION_BLOCK {name}\n{sections}")


def _function(name: str) -> PouData:
    return PouData(declaration=f"FUNCTION {name} : BOOL\nVAR_INPUT\nEND_VAR\nVAR\nEND_VAR")


POU = declared_kind(
    ObjectKind(
        name="pou",
        words="POU",
        description="A program, function block or function.",
        data=PouData,
        placement=Placement(parents=CODE_PLACES),
        naming=Naming(proposal="POU", first="PLC_PRG"),
        order=50,
        templates={"program": _program, "function_block": _function_block, "function": _function},
        plcopen=Plcopen(
            tags=("pou",),
            read=lambda reader, element: reader.pou(element),
            write=lambda writer, item: writer.pou(item),
            container="pous",
            data="pou",
        ),
        twincat=TwinCat(tag="POU"),
        codesys=Codesys(type_ids=("6f9dac998de14efc846568ac443b7d08",)),
    ),
    declared_as=("program", "function_block", "function"),
    end=_end,
    members="beside",
    in_library=True,
)
