"""The editor benchmark edits what it says, and hears of it; its numbers are looked at, never asserted."""

from __future__ import annotations

import asyncio

import pytest

from tappet.bench import editor
from tappet.codegen.build import build_application
from tappet.project import sources


def test_the_stored_project_is_that_of_the_build_benchmark_with_a_recipe():
    project, ids = editor.project(4)
    texts = sources.application_sources(project, project.applications()[0].id)
    own = {"GVL_Plant", "FB_Counter", "FB_Recipe", "FB_Recipe.Load"}
    assert {text.uri for text in texts} == own | {"FB_Unit1", "FB_Unit2", "FB_Unit3", "Main"}
    assert len(texts) == len(ids)
    assert [str(d) for d in build_application(texts).diagnostics if d.severity == "error"] == []


@pytest.mark.parametrize("edit", editor.EDITED, ids=lambda edit: edit.name)
def test_messages_come_and_go_with_the_edits(edit: editor.Edit, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(editor, "EDITS", 2)
    heard: dict[str, list[int]] = {}
    messages = editor.Editor.messages

    async def counted(self: editor.Editor, document: str) -> list[object]:
        found = await messages(self, document)
        heard.setdefault(document, []).append(len(found))
        return found

    monkeypatch.setattr(editor.Editor, "messages", counted)
    _, seconds = asyncio.run(editor.measure(edit, 4))
    assert len(seconds) == 2
    assert len(heard) == (2 if edit.last else 1)
    for counts in heard.values():
        assert counts[0] == counts[2] > counts[1] == 0
