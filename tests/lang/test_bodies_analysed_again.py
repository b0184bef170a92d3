"""A body that is analysed again, because something that it names has changed, starts again."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.lang.services.documents import Program, whole_file
from tappet.lang.services.workspace import Workspace
from tappet.lang.source import Source

BLOCK = "FUNCTION_BLOCK FB\nVAR\nEND_VAR\nagain:\n;\nmissing := 1;\nEND_FUNCTION_BLOCK"
OTHER = "FUNCTION F : INT\nVAR_INPUT\n    a : INT;\nEND_VAR\nF := a;\nEND_FUNCTION"


def programs(unsaved: Mapping[str, str]) -> list[Program]:
    texts = {"FB": BLOCK, "F": OTHER} | dict(unsaved)
    return [Program("App", [whole_file(name, Source(name, text, name=name)) for name, text in texts.items()])]


def test_a_label_is_not_declared_twice_by_a_second_look() -> None:
    workspace = Workspace(programs)
    (first,) = workspace.snapshots()
    assert "E0803" not in {diagnostic.code for diagnostic in first.diagnostics}
    workspace.open(
        "F", OTHER.replace("a : INT;", "a, missing : INT;")
    )  # bodies with errors are looked at again
    (second,) = workspace.snapshots()
    assert second.analysis.continued
    assert {str(d) for d in second.diagnostics if d.uri == "FB"} == {
        str(d) for d in first.diagnostics if d.uri == "FB"
    }
