"""The CNC settings of an application: what all its CNC programs share (CNC-03, CNCS-01)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.project.cnc.code import write_settings
from tappet.project.cnc.settings import CncSettingsData
from tappet.project.model import Project, ProjectObject
from tappet.project.object_kind import Compiled, JsonFile, Merging, Naming, ObjectKind, Placement
from tappet.project.source_text import SourceWriter


def _settings(project: Project, items: Sequence[ProjectObject], writer: SourceWriter) -> None:
    """Those of the application itself, which come first."""
    write_settings(items[0].data_as(CncSettingsData), writer)


CNC_SETTINGS = ObjectKind(
    name="cnc_settings",
    words="CNC settings",
    description="What all CNC programs of an application share.",
    data=CncSettingsData,
    placement=Placement(parents=("application",), in_folders=False, once=True),
    naming=Naming(style="fixed", names=("CNC settings",)),
    order=159,
    compiled=Compiled(together=_settings),
    folder=JsonFile(optional=True),
    merging=Merging(),
)
