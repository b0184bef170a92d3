"""Unsaved texts, caching, documents of several programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pytest
from marked_texts import Project, split_object

from tappet.lang.services.documents import Position, Program, library_text, whole_file
from tappet.lang.services.hover import hover
from tappet.lang.services.navigation import definition, references
from tappet.lang.services.reports import reports
from tappet.lang.services.results import ServiceError
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.lang.source import Scope, Source, Span


def test_unsaved_text_counts_until_it_is_closed() -> None:
    project = Project(P="PROGRAM P\na := 1;\nEND_PROGRAM")
    workspace = project.workspace
    assert [r.code for r in reports(workspace.snapshot("P"))["P"]] == ["E0201"]
    workspace.open("P", "PROGRAM P\nVAR a : INT; END_VAR\na := 1;\nEND_PROGRAM")
    assert "P" not in reports(workspace.snapshot("P"))
    assert workspace.unsaved("P") is not None
    workspace.close("P")
    assert [r.code for r in reports(workspace.snapshot("P"))["P"]] == ["E0201"]


def test_the_same_text_is_not_analysed_again() -> None:
    workspace = Project(P="PROGRAM P END_PROGRAM").workspace
    first = workspace.snapshot("P")
    assert workspace.snapshot("P") is first
    workspace.open("P", "PROGRAM P\nEND_PROGRAM")
    second = workspace.snapshot("P")
    assert second is not first
    workspace.open("P", "PROGRAM P\nEND_PROGRAM")
    assert workspace.snapshot("P") is second


def test_unchanged_texts_are_not_parsed_again() -> None:
    project = Project(P="PROGRAM P END_PROGRAM", Q="PROGRAM Q END_PROGRAM")
    first = {t.source.uri: unit for t, unit in project.workspace.snapshot("P").units()}
    project.workspace.open("P", "PROGRAM P\nEND_PROGRAM")
    second = {t.source.uri: unit for t, unit in project.workspace.snapshot("P").units()}
    assert second["Q"] is first["Q"]
    assert second["P"] is not first["P"]


def test_a_document_belongs_to_the_first_program_that_shows_it() -> None:
    shared = whole_file("F", Source("F", "FUNCTION F : INT END_FUNCTION"))
    only = whole_file("P", Source("P", "PROGRAM P END_PROGRAM"))
    workspace = Workspace(lambda unsaved: [Program("App1", [shared]), Program("App2", [shared, only])])
    assert workspace.program_of("F").name == "App1"
    assert workspace.program_of("P").name == "App2"
    assert [s.program.name for s in workspace.snapshots()] == ["App1", "App2"]


def test_unknown_document_is_refused_by_name() -> None:
    workspace = Project(P="").workspace
    with pytest.raises(ServiceError, match="'X' belongs to no application"):
        workspace.snapshot("X")
    with pytest.raises(ServiceError, match="'X' is no document of App"):
        workspace.snapshot("P").view("X", Position(0, 0))


def test_positions_go_to_and_from_the_documents_of_an_object() -> None:
    text = split_object("P", "a\nb", "c\nd\ne", "END")
    assert text.position("P/declaration", Position(1, 5)) == Position(1, 5)
    assert text.position("P/implementation", Position(2, 3)) == Position(4, 3)
    assert text.position("Q", Position(0, 0)) is None
    assert text.place(Span(3, 1, 3, 2)).span == Span(1, 1, 1, 2)
    assert text.place(Span(1, 0, 2, 1)).document == "P/declaration"
    assert text.place(Span(1, 0, 2, 1)).span.end_line == 1  # cut to the document it begins in
    assert text.place(Span(5, 0, 5, 3)).span.line == 2  # the keyword of the compiler
    assert text.lines_of("P/declaration") == (0, 2)
    assert text.lines_of("P/implementation") == (2, 5)
    assert text.lines_of("Q") is None


def test_places_and_comments_follow_an_edit_that_changes_no_declaration() -> None:
    project = Project(
        P="PROGRAM P\nVAR\n  a : INT; // old\nEND_VAR\na := 1;\nEND_PROGRAM",
        Q="PROGRAM Q\nVAR b : INT; END_VAR\nb := P.a;\nEND_PROGRAM",
    )
    workspace = project.workspace
    workspace.snapshot("P")
    workspace.open("P", "\n\nPROGRAM P\nVAR\n  a : INT; // new\nEND_VAR\na := 1 + 1;\nEND_PROGRAM")
    snapshot = workspace.snapshot("P")
    found = definition(snapshot, "Q", Position(2, 7))
    assert found is not None
    assert (found.document, found.span[:2]) == ("P", (4, 2))
    explained = hover(snapshot, "P", Position(6, 0))
    assert explained is not None
    assert explained.text.startswith("new")
    assert [r.place.span.line for r in references(snapshot, "Q", Position(2, 7))] == [4, 6, 2]


class FakeIndex:
    """Says that a program reaches the library texts whose names it holds."""

    def __init__(self) -> None:
        self.made: list[list[str]] = []

    def reached(self, libraries: Sequence[Source], own: Sequence[Source]) -> list[Source]:
        return [source for source in libraries if any(source.uri in text.text for text in own)]

    def make(self, libraries: Sequence[Source]) -> None:
        self.made.append([source.uri for source in libraries])


class Libraries:
    """A program on a library that no other test has analysed."""

    def __init__(self, name: str, text: str) -> None:
        self.texts = {"P": text}
        self.library = [
            library_text(Source(f"{name}_{n}", block, scope=Scope.LIBRARY, library=name, namespace=name))
            for n in ("Near", "Far")
            for block in [f"FUNCTION_BLOCK {name}_{n}\nVAR_OUTPUT q : BOOL; END_VAR\nEND_FUNCTION_BLOCK"]
        ]
        self.index = FakeIndex()
        self.workspace = Workspace(self.programs, self.index)

    def programs(self, unsaved: Mapping[str, str]) -> list[Program]:
        own = [whole_file(k, Source(k, v)) for k, v in {**self.texts, **unsaved}.items()]
        return [Program("App", [*own, *self.library])]

    def first(self) -> tuple[Snapshot, list[str]]:
        """The first snapshot and the messages in it."""
        (snapshot,) = self.workspace.first_snapshots(())
        return snapshot, [report.message for report in reports(snapshot).get("P", [])]


def test_first_messages_come_before_the_libraries_that_a_program_does_not_reach() -> None:
    project = Libraries("Ahead", "PROGRAM P\nVAR a : Ahead_Near; b : Ahead_Fat; END_VAR\na();\nEND_PROGRAM")
    first, messages = project.first()
    assert first.is_waiting
    assert not first.shows("tappet-library:/Ahead_Far")
    assert [m for m in messages if "Ahead_Fat" in m] == ["Unknown type: 'Ahead_Fat'"]
    assert project.first()[0] is first
    project.workspace.prepare()
    assert project.index.made == []
    assert project.workspace.resume(1.0)
    whole, messages = project.first()
    assert not whole.is_waiting
    assert whole.shows("tappet-library:/Ahead_Far")
    assert any("Ahead_Far" in (r.advice or "") for r in reports(whole)["P"])
    project.workspace.prepare()
    assert project.index.made == [["Ahead_Near", "Ahead_Far"]]


def test_a_request_sees_all_texts_of_libraries() -> None:
    project = Libraries("Asked", "PROGRAM P\nVAR a : Asked_Near; END_VAR\na();\nEND_PROGRAM")
    assert project.first()[0].is_waiting
    assert not project.workspace.snapshot("P").is_waiting
    assert project.workspace.snapshot("tappet-library:/Asked_Far").shows("P")


def test_an_edit_before_the_libraries_are_analysed_may_reach_another_text() -> None:
    project = Libraries("Edited", "PROGRAM P\nVAR a : Edited_Near; END_VAR\na();\nEND_PROGRAM")
    assert project.first()[1] == []
    project.workspace.open("P", "PROGRAM P\nVAR a : Edited_Far; END_VAR\na();\nx;\nEND_PROGRAM")
    first, messages = project.first()
    assert first.is_waiting
    assert first.shows("tappet-library:/Edited_Far")
    assert not first.shows("tappet-library:/Edited_Near")
    assert [m for m in messages if "Edited" in m] == []
    assert any("'x'" in m for m in messages)
    assert project.workspace.resume(1.0)
    assert project.first()[1] == messages
    project.workspace.open("P", "PROGRAM P\nVAR a : Edited_Near; END_VAR\na();\nEND_PROGRAM")
    assert not project.first()[0].is_waiting  # the libraries are analysed: nothing is left out any more
