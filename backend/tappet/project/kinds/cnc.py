"""A CNC program: a path for several axes; it is a global variable of its name (CNC-01, DAT-01)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.project.cnc.code import LIBRARY, VARIABLES, write_list, write_program
from tappet.project.cnc.program import CncProgramData, new_program
from tappet.project.library_reference import LibraryReference
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import Compiled, JsonFile, Naming, ObjectKind, Placement
from tappet.project.source_text import SourceWriter


def _source(project: Project, item: ProjectObject, writer: SourceWriter) -> None:
    write_program(item, writer)


def _list(project: Project, items: Sequence[ProjectObject], writer: SourceWriter) -> None:
    write_list(items, writer)


CNC = ObjectKind(
    name="cnc",
    words="CNC program",
    description="A CNC program: a path for several axes, as DIN 66025 text or table.",
    data=CncProgramData,
    placement=Placement(parents=("application",)),
    naming=Naming(proposal="CNC"),
    order=158,
    new=new_program,
    companion="cnc_settings",
    compiled=Compiled(
        source=_source,
        together=_list,
        variable_in=(VARIABLES,),
        variable_endings=("", "_A", "_V"),
        libraries=lambda data, path: [LibraryReference(name=LIBRARY, place=path)],
    ),
    folder=JsonFile(optional=True, texts={"implementation": "cnc"}),
    reported=True,
)
