"""A counter of pieces: a kind that gives the compiler a function block and needs a library."""

from __future__ import annotations

from pydantic import Field, StrictInt

from tappet.project.data import CodeData
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import CODE_PLACES, Compiled, Naming, ObjectKind, Placement
from tappet.project.source_text import SourceWriter


class PieceCounterData(CodeData):
    """How many pieces fill a box."""

    box: StrictInt = Field(default=10, ge=1, le=1000)


def _source(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    box = item.data_as(PieceCounterData).box
    writer.part(
        item.id,
        "declaration",
        f"""FUNCTION_BLOCK {item.name}
VAR_INPUT
    bPiece : BOOL;
END_VAR
VAR_OUTPUT
    nPieces : INT;
    nBoxes : INT;
END_VAR
VAR
    fbEdge : R_TRIG;
END_VAR""",
    )
    writer.keyword(f"""fbEdge(CLK := bPiece);
IF fbEdge.Q THEN
    nPieces := nPieces + 1;
    nBoxes := nPieces / {box};
END_IF
END_FUNCTION_BLOCK""")


PIECE_COUNTER = ObjectKind(
    name="piece_counter",
    words="piece counter",
    description="A counter of pieces; it is a function block of its name.",
    data=PieceCounterData,
    placement=Placement(parents=CODE_PLACES),
    naming=Naming(proposal="Counter"),
    compiled=Compiled(
        source=_source,
        in_library=True,
        libraries=lambda data, path: [LibraryReference(name="Standard", place=path)],
    ),
    reported=True,
)
