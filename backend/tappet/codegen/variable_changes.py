"""What an online change does to variables, as rows: what `change_report` gives, without the compiler."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

Effect = Literal["initialised", "converted", "moved", "kept", "lost", "cleared", "follows"]
Reason = Literal[
    "new", "new_elements", "type_changed", "no_copy", "init_on_change", "constant", "address",
    "string_shortened", "place", "initial_value", "removed", "elements_removed",
    "target_lost", "target_moved",
]  # fmt: skip


class VariableChange(Struct, frozen=True):
    """What happens to one variable."""

    path: str
    effect: Effect
    reason: Reason
    type: str
    """Its type afterwards; before, for a variable that is lost."""
    before: str = ""
    """Its type before, where it has changed."""
    calls: tuple[str, ...] = ()
    """Methods of the block that are called: FB_Exit, FB_Init, FB_Reinit."""
    remanent: bool = False


class ChangeReport(Struct, frozen=True):
    """Rows, and how many more there would be."""

    rows: tuple[VariableChange, ...] = ()
    omitted: int = 0
