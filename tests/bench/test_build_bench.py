"""The build benchmark measures what the server does; its numbers are looked at, never asserted."""

from __future__ import annotations

import json

from tappet.bench import build
from tappet.codegen.build import build_application


def test_the_project_is_what_the_bar_speaks_of():
    sources = build.project()
    assert len(sources) == build.POUS
    assert sum(source.text.count("\n") for source in sources) > 30_000
    found = build_application(build.project(3), (), None).diagnostics
    assert [str(d) for d in found if d.severity == "error"] == []


def test_report_has_the_cold_build_the_edit_and_their_own_stages():
    report = build.run(12)
    names = [row.name for row in report.rows]
    assert names == [
        "cold build",
        "one POU edited",
        "program of all calls edited",
        "variable added to one POU",
        "variable added to the program",
    ]
    cold, edit, declared = report.remarks
    assert cold.startswith("cold build by stage: parse ")
    assert all(
        stage in cold for stage in ("analyse", "lower", "layout", "passes", "emit", "compile", "package")
    )
    assert "layout" not in edit, "an edited body is no build of everything"
    assert "layout" in declared, "a new variable moves others"
    assert json.loads(report.json())["remarks"] == [cold, edit, declared]
