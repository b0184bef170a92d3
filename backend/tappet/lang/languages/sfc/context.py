"""What the phases of translating one chart share."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang.languages.reader import Lowering
from tappet.lang.languages.sfc.chart import Chart
from tappet.lang.source import Span


@dataclass(slots=True)
class Context:
    """One chart that is being translated."""

    pou: str
    chart: Chart
    lowering: Lowering
    head: Span
    actions: dict[str, tuple[str, Span]] = field(default_factory=dict)
    """Actions and BOOL variables by upper-case name, with their spelling and first place."""
    mentions: list[tuple[str, Span]] = field(default_factory=list)
    """Further places that name one of them."""
    kept: str = "_SFC"
    """The implicit variable with what the chart keeps besides steps and actions."""
