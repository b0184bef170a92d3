"""A note about an object of the application: a kind of data alone."""

from __future__ import annotations

from tappet.project.data import Data, Line, Text
from tappet.project.naming import name_key
from tappet.project.object_kind import JsonFile, Naming, ObjectKind, Placement, Renaming


class MachineNoteData(Data):
    """What is noted, and about which object."""

    about: Line = ""
    text: Text = ""


def _about_renamed(data: MachineNoteData, renaming: Renaming) -> MachineNoteData:
    if name_key(data.about) != name_key(renaming.old):
        return data
    return data.model_copy(update={"about": renaming.new})


MACHINE_NOTE = ObjectKind(
    name="machine_note",
    words="note",
    description="A note about an object of the application.",
    data=MachineNoteData,
    placement=Placement(parents=("application",)),
    naming=Naming(style="free", proposal="Note", unique="place"),
    follow=_about_renamed,
    folder=JsonFile(texts={"text": "md"}),
    reported=True,
)
