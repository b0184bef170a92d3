"""G-code text to lines and words: what the dialect allows, places of what is wrong, any text at all."""

from __future__ import annotations

from itertools import islice, repeat

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.cnc.letters import LETTERS
from tappet.cnc.parser import decode, parse, read_lines
from tappet.cnc.words import Line, Program, Word
from tappet.cnc.writer import line_text, program_text


def words(text: str) -> list[tuple[str, float | str]]:
    """Addresses and values of a line without problems."""
    program = parse(text)
    assert program.problems == ()
    return [(word.address, word.variable or word.value) for word in program.lines[0].words]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("G01X10Y-.5", [("G", 1), ("X", 10), ("Y", -0.5)]),
        ("g1 x 10\ty+2.", [("G", 1), ("X", 10), ("Y", 2)]),
        ("G1 X1e2 (far) Y2", [("G", 1), ("X", 100), ("Y", 2)]),
        ("F100 FF200 FZ3 E5 E-6 EF7 EW-8", [
            ("F", 100), ("FF", 200), ("FZ", 3), ("E", 5), ("E", -6), ("EF", 7), ("EW", -8),
        ]),
        ("G$a$ X$GVL.axes[1, 2].pos$", [("G", "a"), ("X", "GVL.axes[1, 2].pos")]),
        ("G1 X1 // Y2", [("G", 1), ("X", 1)]),
        ("G1 PROBE3 X1", [("G", 1), ("PROBE", 3), ("X", 1)]),
        ("G1 P5 R2", [("G", 1), ("P", 5), ("R", 2)]),
    ],
)  # fmt: skip
def test_words(text: str, expected: list[tuple[str, float | str]]) -> None:
    """Spec GC-03, GC-04, GC-09."""
    if "1e2" in text:
        assert parse(text).problems[0].severity == "warning"
        text = text.replace("1e2", "100")
    assert words(text) == expected


def test_program_line_by_line() -> None:
    """Spec GC-01, GC-02, GC-10, GC-13."""
    program = parse("% Part one\n\nN10 G1 X1 (go)\n/N5 G1 Y1 //maybe\n( nothing )\nX2")
    assert program.name == "Part one"
    assert program.problems == ()
    assert [line.number for line in program.lines] == [None, None, 10, 5, None, None]
    assert [line.suppressed for line in program.lines] == [False, False, False, True, False, False]
    assert [line.is_empty for line in program.lines] == [True, True, False, False, True, False]
    assert program.lines[2].comments == ("go",)
    assert program.lines[3].comments == ("maybe",)


@pytest.mark.parametrize(
    ("text", "column", "length", "part"),
    [
        ("G1 X", 3, 1, "'X' has no value; write a number such as X10"),
        ("G1.5", 0, 4, "'G' takes whole numbers, not 1.5"),
        ("G1 X5 (open", 6, 5, "The comment has no ')'"),
        ("G1 X5 ?", 6, 1, "'?' does not begin a word"),
        ("G1 N5", 3, 2, "The block number stands in front of the line, once"),
        ("N-5", 0, 3, "A block number is a whole number without sign"),
        ("N$v$", 0, 4, "A block number is a whole number without sign"),
        ("G1 X1e99", 3, 5, "1e99 is too large"),
        ("G1 X$1a$", 3, 5, "'$1a$' is no name of a variable"),
        ("G1 X#R", 4, 2, "Local variables, expressions and subprograms are read from files"),
        ("ARCS{20}", 4, 4, "Local variables, expressions and subprograms are read from files"),
        ("G1 X10E5", 3, 5, "10E5 is one number; write X10 E5 with a blank"),
        ("G1 %", 3, 1, "'%' does not begin a word"),
        ("G1 / X1", 3, 1, "'/' does not begin a word"),
        ("G1 X١", 3, 1, "'X' has no value"),
    ],
)
def test_problems_have_their_place(text: str, column: int, length: int, part: str) -> None:
    """Spec CNC-37: what is wrong, where, and what would be right."""
    found = [problem for problem in parse("\n" + text).problems if problem.message.startswith(part)]
    assert [(problem.line, problem.column, problem.length) for problem in found] == [(1, column, length)]


@given(st.binary(max_size=300))
def test_any_bytes(data: bytes) -> None:
    """Nothing raises; problems stand inside of the text; a line for a line."""
    text = decode(data)
    program = parse(text)
    texts = text.split("\n")
    assert [line.place for line in program.lines] == [*range(len(texts))]
    for problem in program.problems:
        assert 0 <= problem.column <= len(texts[problem.line])
        assert problem.length >= 1


@given(st.text(st.sampled_from("GXYNFEMHLO0123456789.-+$#{}()/% \t\nabe"), max_size=80))
def test_any_text_of_a_program(text: str) -> None:
    """Words stand where they say, and what is written of them reads the same again."""
    program = parse(text)
    for line, content in zip(program.lines, text.split("\n"), strict=True):
        for word in line.words:
            assert content[word.column : word.column + word.length].upper().startswith(word.address[0])
    if not program.problems:
        assert _meaning(parse(program_text(program))) == _meaning(program)


def _meaning(program: Program) -> list[object]:
    return [
        program.name,
        [
            (line.suppressed, line.number, [(word.address, word.value, word.variable) for word in line.words])
            for line in program.lines
            if not line.is_empty
        ],
    ]


VALUES = st.floats(-2147483647, 2147483647, allow_nan=False)
ADDRESSES = sorted(set(LETTERS) - {"N"})
WORDS = st.one_of(
    st.tuples(st.sampled_from([a for a in ADDRESSES if a not in "GMH"]), VALUES, st.none()),
    st.tuples(st.sampled_from("GMH"), st.integers(-999, 999).map(float), st.none()),
    st.tuples(st.sampled_from(ADDRESSES), st.just(0.0), st.sampled_from(["a", "GVL.b", "c[3]"])),
).map(lambda parts: Word(*parts))


@given(st.lists(WORDS, max_size=8), st.booleans(), st.none() | st.integers(0, 2147483647))
def test_round_trip(words: list[Word], suppressed: bool, number: int | None) -> None:
    """Words to text to words: the same, bit by bit. Spec CNC-92."""
    text = line_text(Line(0, suppressed, number, tuple(words)))
    line = parse(text).lines[0]
    assert [problem for problem in line.problems if problem.severity == "error"] == []
    assert (line.suppressed, line.number) == (suppressed, number)
    shown = [(word.address, repr(word.value), word.variable) for word in line.words]
    assert shown == [(word.address, repr(word.value), word.variable) for word in words]


def test_a_file_is_read_line_by_line() -> None:
    """Lines come out while there are still some to read: here of a file that never ends."""
    lines = list(islice(read_lines(repeat("N1 G1 X1\r\n")), 3))
    assert [line.place for line in lines] == [0, 1, 2]
    assert lines[2].number == 1


def test_encodings() -> None:
    """UTF-8 with and without a mark, Latin 1."""
    assert decode("(ü)".encode("utf-8-sig")) == "(ü)"
    assert decode("(ü)".encode("latin-1")) == "(ü)"
    assert parse("\ufeffG1 X1").lines[0].words[0].address == "G"
