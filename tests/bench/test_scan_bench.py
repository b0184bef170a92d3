"""Every workload gives in ST what it gives in C; how fast they are is looked at, never asserted."""

from __future__ import annotations

from pathlib import Path

import pytest

from tappet.bench import instrumented, scan
from tappet.bench.native import gcc_version


@pytest.mark.skipif(gcc_version() is None, reason="the C versions need gcc")
@pytest.mark.parametrize("name", scan.names())
def test_both_versions_agree(name: str, tmp_path: Path):
    ours, base = scan.compare(name, 300, tmp_path)
    assert ours == pytest.approx(base, rel=1e-12)
    assert ours != 0.0, "nothing was worked out"


def test_five_more_than_the_ten_of_the_design():
    assert len(scan.names()) >= 15


def test_the_instrumented_variant_has_a_figure():
    assert instrumented.ratio(scan.WORKLOADS / "sequencers.st") > 0
