"""SMC_ReadNCFile2 and SMC_NCInterpreter: random programs against a reference in Python; any text."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from nc_interpreter import OBJECTS, Interpreter
from nc_reference import (
    VARIABLES,
    NoNumberError,
    Player,
    Step,
    Subprogram,
    Tree,
    conditions,
    files,
    numbers,
    programs,
)

SCOPE = {"#A": 2.5, "#B": -7.0}
DECLARED = "LET #a : LREAL := 2.5\nLET #b : LREAL := -7\n"


TEXTS_OF_LINE = 16


def fits(tree: Tree) -> bool:
    """A line has room for so many texts."""
    return tree.text().count("'") <= 2 * TEXTS_OF_LINE


def known(tree: Tree) -> float | None:
    try:
        value = float(tree.compute(SCOPE))
    except NoNumberError:
        return None
    return value if abs(value) < 1e8 else None


@settings(
    max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large]
)
@given(st.lists(st.one_of(numbers(VARIABLES), conditions(VARIABLES)), min_size=20, max_size=60))
def test_any_expression_has_the_value_of_the_reference(
    tmp_path_factory: pytest.TempPathFactory, trees: list[Tree]
) -> None:
    """Spec VAR-06, VAR-07: word K of M functions, whose objects keep it."""
    cases = [(tree, value) for tree in trees if fits(tree) and (value := known(tree)) is not None]
    assume(cases)
    with Interpreter.running(tmp_path_factory.mktemp("nc")) as program:
        found = program.run(DECLARED + "".join(f"M1 K {tree.text()}\n" for tree, _ in cases))
        assert found.done, found
        for value, (tree, wanted) in zip(found.parameters, cases, strict=True):
            assert value == pytest.approx(wanted, rel=1e-9, abs=1e-9), tree.text()


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large]
)
@given(programs())
def test_any_program_goes_where_the_reference_goes(
    tmp_path_factory: pytest.TempPathFactory,
    made: tuple[tuple[Step, ...], list[Subprogram]],
) -> None:
    """Spec VAR-04, VAR-05, VAR-08: assignments, loops, conditions, calls, modes; all ends."""
    main, subprograms = made
    player = Player(subprograms)
    try:
        player.play(main, {"#A": 0.0, "#B": 0.0})
    except NoNumberError:
        assume(False)
    assume(len(player.machine.ends) < OBJECTS)
    with Interpreter.running(tmp_path_factory.mktemp("nc")) as program:
        found = program.run(files(main, subprograms))
        assert found.done, (found, files(main, subprograms))
        assert distinct(found.plane) == pytest.approx(distinct(player.machine.ends), rel=1e-9, abs=1e-7)


def distinct(ends: list[tuple[float, ...]]) -> list[float]:
    """X and Y of the ends without those that move nothing, one behind the other."""
    at: tuple[float, ...] = (0.0, 0.0)
    kept: list[float] = []
    for end in ends:
        if max(abs(new - old) for new, old in zip(end, at, strict=True)) > 1e-6 * (1 + max(map(abs, end))):
            kept += end
            at = end
    return kept


PARTS = st.sampled_from(
    [
        *"GXYZNFEMKLOHDPR0123456789{}()#$+-*/=<>,: \n%?",
        *("#a", "$g_lr$", "'", "'a'", ":=", "LET", "SUBPROGRAM ", "RETURN", "SIN ", "MOD ", "TRUE", "PROBE"),
        *("ä", "1E999"),
    ]
)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.lists(PARTS, max_size=25).map("".join), min_size=20, max_size=20), st.booleans())
def test_any_text_is_read_or_refused_with_its_place(
    tmp_path_factory: pytest.TempPathFactory, texts: list[str], parentheses: bool
) -> None:
    """Spec line 8: no crash, no hang; an error names the file and the line."""
    with Interpreter.running(tmp_path_factory.mktemp("nc")) as program:
        program.runtime.write("PLC_PRG.rf.bParenthesesAsComments", parentheses)
        for text in texts:
            found = program.run(text, cycles=400)
            for number, said in zip((found.reader, found.interpreter), found.messages, strict=True):
                if number != "SMC_NO_ERROR":
                    assert said.startswith("main.cnc, line "), (text, found)


def test_a_long_program_in_bounded_memory(tmp_path: Path) -> None:
    """10,000 blocks through queues of 64 sentences and 50 objects; a loop with 200 calls."""
    with Interpreter.running(tmp_path) as program:
        count = 10_000
        lines = [f"N{n} G1 X#n + {n} Y{n % 7}\n" for n in range(1, count + 1)]
        text = "LET #n : LREAL := 0\n" + "".join(lines)
        found = program.run(text, cycles=20_000)
        assert found.done
        assert program.literal("nTaken") == str(count)
        assert float(program.literal("fSum")) == sum(n * n for n in range(1, count + 1))
        found = program.run(
            {
                "main.cnc": "LET #n : LREAL := 200\nN1 ONE{#n}\nG37 O#n D-1\nG20 L1 K#n > 0",
                "one.cnc": "SUBPROGRAM One{#x : LREAL}\nG1 X#x\nEND_SUBPROGRAM",
            },
            cycles=20_000,
        )
        assert found.done
        assert found.xs == list(range(200, 0, -1))
