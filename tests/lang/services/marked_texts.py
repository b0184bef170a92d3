"""Workspaces from texts in which `|` marks the position that a test asks about."""

from __future__ import annotations

from collections.abc import Mapping

from tappet.lang.services.documents import (
    Place,
    Position,
    Program,
    Segment,
    SourceMap,
    Text,
    library_text,
    whole_file,
)
from tappet.lang.services.workspace import Snapshot, Workspace
from tappet.lang.source import Scope, Source

LIBRARY = """
(* On delay *)
FUNCTION_BLOCK TON
VAR_INPUT
    IN : BOOL; (* Signal *)
    PT : TIME := T#1s; (* Delay *)
END_VAR
VAR_OUTPUT
    Q : BOOL; (* Delayed signal *)
    ET : TIME;
END_VAR
VAR
    M : BOOL;
END_VAR
END_FUNCTION_BLOCK
"""


class Project:
    """Objects of a project, each one file, and the library Standard. One `|` marks a position."""

    def __init__(self, **objects: str) -> None:
        self.objects: dict[str, str] = {}
        self.marked: tuple[str, Position] | None = None
        for name, text in objects.items():
            self.objects[name.replace("__", ".")] = self._marked(name.replace("__", "."), text)
        self.workspace = Workspace(self.programs)

    def _marked(self, name: str, text: str) -> str:
        before, mark, after = text.partition("|")
        if mark:
            lines = before.split("\n")
            self.marked = (name, Position(len(lines) - 1, len(lines[-1])))
        return before + after

    def programs(self, unsaved: Mapping[str, str]) -> list[Program]:
        texts: list[Text] = []
        for name, stored in self.objects.items():
            owner, dot, child = name.rpartition(".")
            source = Source(name, unsaved.get(name, stored), owner=owner or None, name=child if dot else name)
            texts.append(whole_file(name, source))
        standard = Source(
            "Standard/TON", LIBRARY, scope=Scope.LIBRARY, library="Standard", namespace="Standard", name="TON"
        )
        return [Program("App", [*texts, library_text(standard)], tasks=["MainTask"])]

    @property
    def document(self) -> str:
        assert self.marked is not None
        return self.marked[0]

    @property
    def position(self) -> Position:
        assert self.marked is not None
        return self.marked[1]

    @property
    def snapshot(self) -> Snapshot:
        return self.workspace.snapshot(next(iter(self.objects)))

    def at(self, place: Place) -> str:
        """`name:line:column text` of a place, 1-based."""
        text = self.objects.get(place.document, LIBRARY)
        line = text.split("\n")[place.span.line]
        return (
            f"{place.document}:{place.span.line + 1}:{place.span.column + 1} "
            f"{line[place.span.column : place.span.end_column]}"
        )


def split_object(name: str, declaration: str, implementation: str, end: str) -> Text:
    """A text as the project composes it, with the documents `name/declaration` and `name/implementation`."""
    body = declaration.count("\n") + 1
    source = Source(name, f"{declaration}\n{implementation}\n{end}", body_line=body, name=name)
    parts = (("declaration", declaration, 0), ("implementation", implementation, body))
    segments = (
        Segment(line, name, part, 0, text.count("\n") + 1, len(text) - text.rfind("\n") - 1)
        for part, text, line in parts
    )
    return Text(source, SourceMap(tuple(segments)))
