"""The page setup of the printed documentation, a setting of the project."""

from __future__ import annotations

from tappet.project.object_kind import POUS_VIEW, JsonFile, Merging, Naming, ObjectKind, Placement
from tappet.project.page_setup import PageSetupData

PAGE_SETUP = ObjectKind(
    name="page_setup",
    words="page setup",
    description="How the documentation of the project is printed.",
    data=PageSetupData,
    placement=Placement(parents=(POUS_VIEW,), in_folders=False, once=True),
    naming=Naming(style="fixed", names=("Page Setup",), unique="place"),
    order=190,
    folder=JsonFile(optional=True),
    merging=Merging(),
)
