"""Help with rows of IL: where they are, what may be written in them, their networks and columns (IL-01)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from typing import Final

from tappet.lang import ast
from tappet.lang.languages.il.operators import INSTRUCTIONS
from tappet.lang.languages.il.recognise import is_instruction_list
from tappet.lang.lexer import END, ID, Lexed, lex
from tappet.lang.parser_core import Core
from tappet.lang.services.results import Completion, ItemKind
from tappet.lang.source import Source

JUMPS: Final = frozenset(name for name, item in INSTRUCTIONS.items() if item.action == "jump")
"""Instructions whose operand is a label."""
LABEL_WIDTH: Final = 8
"""Columns that the labels take."""
OPERATOR_WIDTH: Final = 8
_LABEL = re.compile(r"\s*([^\W\d]\w*)\s*:(?!=)\s*(.*)", re.DOTALL)
_WORD = re.compile(r"([^\W\d][\w.^]*|[&)])\s*((?:\((?!\*))?)\s*(.*)", re.DOTALL)
_PARAMETER = re.compile(r"[^\W\d]\w*\s*(?::=|=>)")


def bodies(unit: ast.Unit) -> Iterator[tuple[int, int, list[ast.Stmt]]]:
    """First line, line behind and statements of every body in IL."""
    named = any(body.language == "IL" for body in unit.source.bodies)
    for declaration in unit.declarations:
        if isinstance(declaration, ast.Pou):
            for pou in (declaration, *declaration.methods, *declaration.actions):
                if pou.language == "IL" or (named and not pou.body):
                    first = max((block.span.end_line for block in pou.blocks), default=pou.name_span.line)
                    yield first + 1, pou.span.end_line + 1, pou.body


def in_rows(unit: ast.Unit, line: int) -> bool:
    """Whether a line is one of a body in IL."""
    return any(first <= line < behind for first, behind, _ in bodies(unit))


def begins_row(lexed: Lexed, index: int) -> bool:
    """Whether a token is the first of its row, its label left out."""
    line = lexed.lines[index]
    if index == 0 or lexed.lines[index - 1] != line:
        return True
    if lexed.kinds[index - 1] != ":":
        return False
    return index == 2 or lexed.lines[index - 3] != line


def is_operator(lexed: Lexed, index: int) -> bool:
    """Whether a token of a row is its instruction."""
    return begins_row(lexed, index) and lexed.texts[index].upper() in INSTRUCTIONS


def operator_proposals() -> Iterator[Completion]:
    """What the operator column may hold, functions apart."""
    for number, item in enumerate(INSTRUCTIONS.values()):
        if item.name not in ("&", "JMPN"):
            yield Completion(item.name, ItemKind.KEYWORD, "IL", item.meaning, rank=0 if number < 5 else 1)


def label_proposals(unit: ast.Unit, line: int) -> Iterator[Completion]:
    """Labels of the body, for JMP."""
    for first, behind, body in bodies(unit):
        if first <= line < behind:
            for statement in body:
                if statement.label is not None:
                    yield Completion(statement.label, ItemKind.LABEL, "label", rank=0)


def networks(unit: ast.Unit) -> Iterator[tuple[int, int]]:
    """First and last line of each network that has a label (NET-06)."""
    for _, behind, body in bodies(unit):
        starts = [statement.span.line for statement in body if statement.label is not None]
        for start, following in pairwise([*starts, behind - 1]):
            yield start, following - 1


# -- columns ----------------------------------------------------------------------------------------


def holds_rows(lexed: Lexed) -> bool:
    """Whether a text is a body in IL and nothing else."""
    return lexed.kinds[0] is not END and is_instruction_list(Core(Source("", ""), lexed))


def format_rows(text: str) -> str:
    """A body with its columns aligned: label, operator in upper case, operand. Comments stay."""
    lexed = lex(text, "")
    commented = {
        line
        for trivia in lexed.trivia.values()
        for item in trivia
        for line in range(item.span.line + 1, item.span.end_line + 1)
    }
    starts: dict[int, int] = {}
    for at, column in zip(lexed.lines, lexed.columns, strict=True):
        starts.setdefault(at, column)
    depth = 0
    found = []
    for number, line in enumerate(text.split("\n")):
        if number in commented or number not in starts or not line.strip() or not line[starts[number] :]:
            found.append(line.rstrip() if number not in commented else line)
            continue
        found.append(_row(line.rstrip(), starts[number], depth))
        depth = max(0, depth + _parentheses(lexed, number))
    shaped = "\n".join(found)
    return shaped if _words(lex(shaped, "")) == _words(lexed) else text


def _words(lexed: Lexed) -> list[str]:
    """What a text says: formatting must not change it."""
    comments = [item.text for items in lexed.trivia.values() for item in items]
    return [*map(str.upper, lexed.texts), *comments]


def _row(line: str, start: int, depth: int) -> str:
    lead = line[:start].strip()  # a comment before the row
    code = line[start:]
    label = ""
    match = _LABEL.match(code)
    if match is not None and "=" not in code[match.start(2) - 1 : match.start(2)]:
        label, code = f"{match[1]}:", match[2]
    head = f"{lead} {label}".strip() if lead else label
    if not code or code.startswith(("(*", "//", "/*")):
        return f"{head} {code}".rstrip() if head else code
    indent = head.ljust(LABEL_WIDTH) if len(head) < LABEL_WIDTH else f"{head} "
    if _PARAMETER.match(code):
        return f"{' ' * (LABEL_WIDTH + OPERATOR_WIDTH)}{code}"
    match = _WORD.match(code)
    if match is None:
        return f"{' ' * (LABEL_WIDTH + OPERATOR_WIDTH)}{code}" if not head else indent + code
    word, opening, operand = match[1], match[2], match[3]
    operator = word.upper() if word.upper() in INSTRUCTIONS else word
    operator += opening
    level = "  " * max(0, depth - (1 if operator == ")" else 0))
    if not operand:
        return f"{indent}{level}{operator}"
    return f"{indent}{level}{operator.ljust(OPERATOR_WIDTH - 1)} {operand}"


def _parentheses(lexed: Lexed, line: int) -> int:
    level = 0
    for index, kind in enumerate(lexed.kinds):
        if lexed.lines[index] == line and kind is not ID:
            level += (kind == "(") - (kind == ")")
    return level
