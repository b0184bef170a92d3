"""Test texts made ready to run: a test can be switched off, and every assertion knows its place.

`TEST('x'); ... TEST_FINISHED();` becomes `IF TAPPET_TEST('x') THEN ... TEST_FINISHED(); END_IF;`, so that
a test that ended in an exception is left out when the others are run again. `TAPPET_MARK(n);` at the begin
of a test and before assertions records the place. Everything is put in on the line where it belongs, so that
lines stay the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from tappet.lang import ast
from tappet.lang.parser import parse
from tappet.lang.source import Scope, Source, Span
from tappet.runtime.unit_tests.discovery import callee_name
from tappet.runtime.unit_tests.known import Mark

BEGIN, END = "TEST", ("TEST_FINISHED", "TEST_FINISHED_NAMED")
ASSERTION = "ASSERT"
CLOSE = " END_IF;"


@dataclass(frozen=True, slots=True)
class _Insertion:
    line: int
    column: int
    text: str
    removed: int = 0

    @property
    def place(self) -> tuple[int, int, bool]:
        """Sorts insertions; at one place the end of a test stands before the begin of the next."""
        return self.line, self.column, self.text != CLOSE


def instrument(source: Source, marks: list[Mark]) -> Source:
    """The text of `source` with its tests made ready; appends the places that are marked to `marks`."""
    if source.scope is Scope.LIBRARY or BEGIN not in source.text.upper():
        return source
    lines = source.text.split("\n")
    edits: list[_Insertion] = []
    for pou in _bodies(parse(source).unit.declarations):
        qualified = f"{pou.owner.name}.{pou.name}" if pou.owner is not None else pou.name
        if source.owner and pou.owner is None:
            qualified = f"{source.owner}.{pou.name}"
        for statements in _lists(pou.body):
            place = Mark(source.uri, qualified, 0)
            edits += _gates(statements, lines, place, marks)
            edits += _marks(statements, place, marks)
    for edit in sorted(edits, key=lambda e: e.place, reverse=True):
        line = lines[edit.line]
        lines[edit.line] = line[: edit.column] + edit.text + line[edit.column + edit.removed :]
    return replace(source, text="\n".join(lines))


def _bodies(declarations: list[ast.Declaration]) -> Iterator[ast.Pou]:
    for declaration in declarations:
        if isinstance(declaration, ast.Pou) and declaration.language == "ST":
            yield declaration
            yield from declaration.methods
            yield from declaration.actions


def _lists(body: list[ast.Stmt]) -> Iterator[list[ast.Stmt]]:
    """A list of statements and all lists in it."""
    yield body
    for statement in body:
        if isinstance(statement, ast.If):
            for _, branch in statement.branches:
                yield from _lists(branch)
            yield from _lists(statement.otherwise or [])
        elif isinstance(statement, ast.Case):
            for case in statement.branches:
                yield from _lists(case.body)
            yield from _lists(statement.otherwise or [])
        elif isinstance(statement, ast.For | ast.While | ast.RepeatUntil):
            yield from _lists(statement.body)


def _called(statement: ast.Stmt) -> str:
    return callee_name(statement.call) if isinstance(statement, ast.CallStmt) and not statement.label else ""


def _gates(
    statements: list[ast.Stmt], lines: list[str], place: Mark, marks: list[Mark]
) -> Iterator[_Insertion]:
    for index, statement in enumerate(statements):
        if _called(statement) != BEGIN or not isinstance(statement, ast.CallStmt):
            continue
        last = _last_of_test(statements, index)
        callee = statement.call.callee
        name = callee.name_span if isinstance(callee, ast.Member) else callee.span
        end = statement.call.span
        semicolon = _semicolon(lines[end.end_line], end.end_column)
        if last is None or semicolon is None:
            continue
        start = statement.span
        if (start.line, start.column) == (name.line, name.column):
            yield _Insertion(start.line, start.column, "IF TAPPET_")
        else:  # TcUnit.TEST(...)
            yield _Insertion(start.line, start.column, "IF ")
            yield _Insertion(name.line, name.column, "TAPPET_")
        marks.append(replace(place, line=start.line + 1))
        yield _Insertion(end.end_line, semicolon, f" THEN TAPPET_MARK({len(marks)});", removed=1)
        yield _after(last.span, lines)


def _last_of_test(statements: list[ast.Stmt], begin: int) -> ast.Stmt | None:
    """The statement that a test ends with: TEST_FINISHED, or the one before the next test or the end."""
    last = None
    for statement in statements[begin + 1 :]:
        name = _called(statement)
        if name == BEGIN:
            break
        last = statement
        if name in END:
            break
    return last


def _after(span: Span, lines: list[str]) -> _Insertion:
    column = span.end_column
    if not lines[span.end_line][:column].rstrip().endswith(";"):
        semicolon = _semicolon(lines[span.end_line], column)
        column = column if semicolon is None else semicolon + 1
    return _Insertion(span.end_line, column, CLOSE)


def _semicolon(line: str, column: int) -> int | None:
    """Column of the semicolon that follows with nothing but blanks before it."""
    rest = line[column:]
    blanks = len(rest) - len(rest.lstrip())
    return column + blanks if rest[blanks:].startswith(";") else None


def _marks(statements: list[ast.Stmt], place: Mark, marks: list[Mark]) -> Iterator[_Insertion]:
    for statement in statements:
        if _called(statement).startswith(ASSERTION):
            marks.append(replace(place, line=statement.span.line + 1))
            yield _Insertion(statement.span.line, statement.span.column, f"TAPPET_MARK({len(marks)}); ")
