"""A 3D scene of the machine, bound to variables of the application."""

from __future__ import annotations

from tappet.project.object_kind import Naming, ObjectKind, Placement
from tappet.project.scene import Scene

SCENE = ObjectKind(
    name="scene",
    words="scene",
    description="A 3D scene of the machine, bound to variables of the application.",
    data=Scene,
    placement=Placement(parents=("application",)),
    naming=Naming(proposal="Scene3D"),
    order=170,
    reported=True,
)
