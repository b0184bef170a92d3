"""How a benchmark's numbers are shown: a table for people, JSON for machines."""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field


@dataclass(frozen=True, slots=True)
class Row:
    """One measurement beside its baseline, both in `unit`."""

    name: str
    ours: float
    baseline: float | None
    unit: str
    note: str = ""

    @property
    def ratio(self) -> float | None:
        """ours / baseline; None without a baseline."""
        return self.ours / self.baseline if self.baseline else None


@dataclass(frozen=True, slots=True)
class Report:
    """Rows of one benchmark with what they were measured against and on."""

    benchmark: str
    baseline: str
    rows: Sequence[Row]
    bar: str = ""
    """The quality bar the ratio is held against."""
    remarks: Sequence[str] = field(default_factory=tuple)

    def text(self) -> str:
        """A table, the geometric mean of the ratios, the bar and the machine."""
        width = max([len(row.name) for row in self.rows] + [8])
        lines = [f"{self.benchmark}: baseline {self.baseline}"]
        lines.append(f"  {'':{width}}  {'Tappet':>12}  {'baseline':>12}  {'unit':8} {'ratio':>6}")
        for row in self.rows:
            base = f"{row.baseline:12.3f}" if row.baseline is not None else f"{'-':>12}"
            ratio = f"{row.ratio:6.2f}" if row.ratio is not None else f"{'-':>6}"
            lines.append(
                f"  {row.name:{width}}  {row.ours:12.3f}  {base}  {row.unit:8} {ratio}  {row.note}".rstrip()
            )
        ratios = [row.ratio for row in self.rows if row.ratio]
        if len(ratios) > 1:
            mean = math.exp(sum(math.log(ratio) for ratio in ratios) / len(ratios))
            lines.append(f"  {'geometric mean':{width}}  {'':12}  {'':12}  {'':8} {mean:6.2f}")
        if self.bar:
            lines.append(f"  bar: {self.bar}")
        lines += [f"  {remark}" for remark in self.remarks]
        lines.append(f"  machine: {platform.machine()}, {platform.system()} {platform.release()}")
        return "\n".join(lines)

    def json(self) -> str:
        """The same as one JSON object."""
        rows = [asdict(row) | {"ratio": row.ratio} for row in self.rows]
        body = {"benchmark": self.benchmark, "baseline": self.baseline, "bar": self.bar, "rows": rows}
        return json.dumps(body | {"remarks": list(self.remarks)}, indent=2)
