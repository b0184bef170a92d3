"""Instruction List to the tree: messages with their rows, recovery, recognition, spans (fbd_ld_il.md)."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.lang.il_texts import CORPUS, corpus
from tests.lang.resolved import codes

from tappet.lang import ast
from tappet.lang.analysis import analyse
from tappet.lang.languages.il.typescript import FILE, module
from tappet.lang.parser import parse
from tappet.lang.source import BodyText, Source, split_lines

_DECLARATION = """PROGRAM P
VAR
    a, b, c : INT; x, y : BOOL; w : WORD; t1 : FB_Timer; text : STRING; arr : ARRAY[0..3] OF INT;
END_VAR
"""
_TIMER = "FUNCTION_BLOCK FB_Timer VAR_INPUT IN : BOOL; PT : TIME; END_VAR END_FUNCTION_BLOCK"
_HEAD = _DECLARATION.count("\n")


def test_the_operators_of_the_table_are_up_to_date() -> None:
    assert (Path(__file__).parents[2] / FILE).read_text(encoding="utf-8") == module(), "run 'make generate'"


def test_the_texts_of_the_table_are_up_to_date() -> None:
    assert CORPUS.read_text(encoding="utf-8") == corpus(), "run 'make generate'"


def in_language(name: str | None) -> tuple[BodyText, ...]:
    return () if name is None else (BodyText(0, name),)


def messages(body: str, language: str | None = "IL") -> list[tuple[str, int, str]]:
    """Code, row (from 1) and message of everything that is reported about a body."""
    result = parse(Source("P", f"{_DECLARATION}{body}\nEND_PROGRAM\n{_TIMER}", bodies=in_language(language)))
    found = result.diagnostics or analyse([result.unit]).diagnostics
    return [
        (d.code, d.span.line - _HEAD + 1, d.message)
        for d in found
        if d.code not in ("W1103", "W1206", "W1116")
    ]


@pytest.mark.parametrize(
    ("body", "code", "row"),
    [
        ("LD", "E0120", 1),  # IL-60: missing operand
        ("LD a\nADD 2,\nST b", "E0120", 2),  # IL-11: the comma goes on, but an instruction follows
        ("LD a\nADD(\n)\nST b", "E0120", 3),
        ("JMP", "E0120", 1),
        ("CAL", "E0120", 1),
        ("LD a b\nST c", "E0121", 1),
        ("LD a + b\nST c", "E0121", 1),
        ("ADD 2\nST b", "E0122", 1),  # IL-61: each network starts undefined
        ("LD a\nST b\nl: ADD 2\nST b\nJMP l", "E0122", 3),
        ("LD a\nMUL( 2\nADD 3\nST b", "E0123", 2),  # IL-60: missing )
        ("LD a\n)\nST b", "E0106", 2),
        ("CAL t1(IN := x AND y)", "E0124", 1),  # IL-14: no complex expressions
        ("LD (a)\nST b", "E0124", 1),
        ("LD a\nADD LEN(text)\nST b", "E0124", 2),
        ("l: LD a\nJMP l", "W1149", 2),  # IL-17, IL-63, fbd_ld_il EX-16
        ("LD a\nST b\nLD b\nRET", "W1149", 4),
        ("LDC a\nST b", "E0126", 1),
        ("LD a\nADDN 2\nST b", "E0126", 2),
        ("LD a\nADD( b\nJMP l\n)\nST c\nl: LD a\nST b", "E0127", 3),
        ("LD a\nADD( b\nl: LD a\nST b\nJMP l", "E0127", 3),
        ("LD a\n3 ADD\nST b", "E0128", 2),
        ("IF x THEN\nLD a\nST b", "E0128", 1),
        ("LD a;\nST b;", "E0129", 1),
        ("LD a\nADD b\nLD c\nST b", "W1118", 1),
        ("LD a\nST b\nLD b", "W1118", 3),
    ],
)
def test_rows_are_reported(body: str, code: str, row: int) -> None:
    """IL-60..IL-63: the message names the row, and what follows is read on."""
    found = messages(body)
    assert (code, row) in [(c, r) for c, r, _ in found]
    assert all(r == row or c == code for c, r, _ in found), found


@pytest.mark.parametrize(
    ("body", "code", "words"),
    [
        ("LD a\nST x", "E0301", "BOOL"),  # the accumulator is an INT
        ("LD x\nADD 1\nST a", "E0304", "BOOL"),
        ("LD a\nJMPC l\nl: LD a\nST b", "E0307", "INT"),
        ("LD a\nS x", "E0322", "INT"),  # IL-62: the accumulator must be BOOL
        ("LD x\nS a", "E0322", "INT"),  # IL-62: and the operand
        ("LD text\nGT 3\nST x", "E0304", "STRING"),
        ("LD x\nJMPC nowhere", "E0802", "nowhere"),  # ELEM-03: unknown label
        ("l: LD a\nST b\nl: LD a\nST b\nJMP l", "E0803", "l"),  # NET-06: labels are unique
        ("l: LD a\nST b", "W1115", "l"),
        ("LDD a\nST b", "E0201", "LDD"),  # IL-60: unknown operator
        ("LD 3\nST 4", "E0305", ""),
        ("RET\nLD a\nST b", "W1102", ""),
    ],
)
def test_checks_of_the_tree_hold_for_rows(body: str, code: str, words: str) -> None:
    found = messages(body)
    assert code in [c for c, _, _ in found], found
    assert any(words in message for c, _, message in found if c == code)


def test_message_tells_network_and_row() -> None:
    """IL-60."""
    assert messages("LD a\nST\nLD b\nST a") == [("E0120", 2, "Network 1, row 2: ST needs an operand")]
    assert messages("LD a\nST b\nLD c\nADD 1\nLD b\nST a")[0][2].startswith("Network 1, row 3: the value")
    found = messages("LD a\nST b\nJMP next\nnext:\nLD a\nSUB\nST b")
    assert [(c, r) for c, r, _ in found] == [("E0120", 6)]
    assert "Network 2, row 2" in found[0][2]


@pytest.mark.parametrize(
    "body",
    [
        "LD a\nST b",
        "LDN x\nST y",
        "LD -3\nST b",
        "(* a comment *)\nstart:\n\nLD a // and one at the end of the row (IL-10)\nST b\nLD x\nJMPC start",
        "CAL t1(IN := x)",
        "JMP l\nl: LD a\nST b",
        "RET",
        "TIME\nST t1.PT",
        "mark: CAL t1()\nJMP mark",
    ],
)
def test_first_instruction_tells_the_language(body: str) -> None:
    assert [c for c, _, _ in messages(body, language=None) if c[0] == "E"] == []
    unit = parse(Source("P", f"{_DECLARATION}{body}\nEND_PROGRAM")).unit
    assert isinstance(unit.declarations[0], ast.Pou)
    assert unit.declarations[0].language == "IL"


@pytest.mark.parametrize(
    "body",
    [
        "", ";", "a := 1;", "LD := 3;", "ST(3);", "LD.x := 3;", "LD[1] := 2;", "R REF= a;", "S S= x;",
        "JMP l;\nl: a := 1;", "RETURN;", "TIME();", "a\n:= 3;", "l:\nCAL := 1;", "S\nR := 1;", "AND := 3;",
    ],
)  # fmt: skip
def test_statements_are_no_rows(body: str) -> None:
    unit = parse(Source("P", f"{_DECLARATION}{body}\nEND_PROGRAM")).unit
    assert isinstance(unit.declarations[0], ast.Pou)
    assert unit.declarations[0].language == "ST"


@pytest.mark.parametrize("word", ["LD", "ST", "JMP", "CAL", "AND", "RET", "TIME"])
def test_a_text_may_end_behind_any_word(word: str) -> None:
    result = parse(Source("P", f"PROGRAM P {word}"))
    assert [d.code for d in result.diagnostics if d.severity == "error"]


def test_language_of_the_object_wins() -> None:
    """A body that says what it is needs no instruction to tell."""
    text = f"{_DECLARATION}a := 1;\nEND_PROGRAM"
    assert [d.code for d in parse(Source("P", text, bodies=in_language("IL"))).diagnostics] == ["E0104"]
    rows = f"{_DECLARATION}LD a\nST b\nEND_PROGRAM"
    assert parse(Source("P", rows, bodies=in_language("ST"))).diagnostics
    assert parse(Source("P", rows, bodies=in_language("IL"))).diagnostics == []


def test_children_have_their_own_language() -> None:
    text = """FUNCTION_BLOCK FB
VAR n : INT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
METHOD Twice : INT
LD n
MUL 2
ST Twice
END_METHOD
ACTION Clear
LD 0
ST n
END_ACTION
PROPERTY Count : INT
GET
LD n
ST Count
END_GET
SET
n := Count;
END_SET
END_PROPERTY"""
    result = parse(Source("FB", text))
    assert result.diagnostics == []
    block = result.unit.declarations[0]
    assert isinstance(block, ast.Pou)
    assert block.language == "ST"
    assert [block.methods[0].language, block.actions[0].language] == ["IL", "IL"]
    assert codes(analyse([result.unit])) == []


def _nodes(value: object) -> list[ast.Node]:
    found: list[ast.Node] = []
    stack = [value]
    while stack:
        item = stack.pop()
        if isinstance(item, ast.Node):
            found.append(item)
            stack += [getattr(item, name) for name in item.__slots__] if hasattr(item, "__slots__") else []
            for kind in type(item).__mro__:
                stack += [getattr(item, name) for name in getattr(kind, "__slots__", ())]
        elif isinstance(item, (list, tuple)):
            stack += item
    return found


def test_names_stand_where_they_are_written() -> None:
    """Spans are those of the source: hover, references and live values find the operands in their rows."""
    body = "LD a\nADD b\nMUL( c\nSUB a\n)\nST b\nST c\nLD x\nJMPC far\nCAL t1(IN := y)\nfar:\nLD 1\nST a"
    text = f"{_DECLARATION}{body}\nEND_PROGRAM"
    lines = split_lines(text)
    pou = parse(Source("P", text)).unit.declarations[0]
    assert isinstance(pou, ast.Pou)
    names = {id(n): n for n in _nodes(pou.body) if isinstance(n, ast.Name)}
    for name in names.values():
        line = lines[name.span.line]
        assert line[name.span.column : name.span.end_column] == name.name
    rows = sorted((n.span.line - _HEAD, n.name) for n in names.values())
    assert rows == [
        (0, "a"), (1, "b"), (2, "c"), (3, "a"), (5, "b"), (6, "c"), (7, "x"), (9, "t1"), (9, "y"), (12, "a"),
    ]  # fmt: skip
    jump = next(n for n in _nodes(pou.body) if isinstance(n, ast.Jump))
    assert lines[jump.target_span.line][jump.target_span.column :] == "far"


def test_statements_begin_at_their_load() -> None:
    """ONL-11, LST-83: a step stops at LD, CAL and JMP."""
    body = "LD a\nADD b\nST c\nCAL t1()\nLD x\nJMPC l\nl:\nLD a\nST b\nST c"
    pou = parse(Source("P", f"{_DECLARATION}{body}\nEND_PROGRAM")).unit.declarations[0]
    assert isinstance(pou, ast.Pou)
    rows = [s.span.line - _HEAD for s in pou.body if not isinstance(s, ast.Empty)]
    assert {0, 3, 5, 7} <= set(rows)
    assert not {1, 4} & set(rows)


_WORDS = """
    LD ST ADD MUL( ) AND( JMP JMPC CAL RET RETC S R NOT a b x l l: 1 2 , ( ) := => t1 t1( IN := SEL LEN ; + -
    THIS^ . [ ] ' (* *) {x} IF END_IF VAR END_VAR TRUE %MX0.0 N
"""
_PIECES = st.sampled_from([*_WORDS.split(), *["\n"] * 4])


@given(st.lists(_PIECES, max_size=40))
@settings(max_examples=150, deadline=None)
def test_any_rows_are_read(pieces: list[str]) -> None:
    """The reader never raises, and what parses is analysed."""
    result = parse(Source("P", f"{_DECLARATION}{' '.join(pieces)}\nEND_PROGRAM", bodies=in_language("IL")))
    analyse([result.unit])
