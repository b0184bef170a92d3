"""The tables of words that Python and SM3_CNC share: numbers of letters, and what commands may have."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from tests.libraries.cnc_decoder import decode

import tappet.libraries
from tappet.cnc import letters
from tappet.cnc.checks import check
from tappet.cnc.commands import COMMANDS, Command
from tappet.cnc.parser import parse
from tappet.cnc.word_list import VARIABLE_TYPES

LIBRARY = Path(tappet.libraries.__file__).parent / "SM3_CNC"


def values(name: str) -> dict[str, int]:
    """Names and numbers of an enumeration of the library."""
    text = (LIBRARY / f"{name}.st").read_text()
    return {name: int(number) for name, number in re.findall(r"(\w+)\s*:= (\d+)", text)}


def test_letters() -> None:
    """docs/cnc-data.md: the numbers of SMC_GCODE_WORD.byLetter."""
    ours = {
        "EndOfBlock": letters.END_OF_BLOCK,
        "Skip": letters.SKIP,
        "FirstVelocity": letters.FIRST_VELOCITY,
        "FirstAcceleration": letters.FIRST_ACCELERATION,
        "Probe": letters.LETTERS["PROBE"],
        "Refused": letters.REFUSED,
        "EndOfProgram": letters.END_OF_PROGRAM,
    }
    theirs = values("GCodeLetter")
    for name, number in theirs.items():
        assert ours.get(name, letters.LETTERS.get(name)) == number
    assert len({*letters.LETTERS.values()}) == len(letters.LETTERS)


def test_types_of_variables() -> None:
    theirs = values("SMC_VARTYPE")
    for name, number in VARIABLE_TYPES.items():
        if name != "SMC_M_PARAMETERS":
            assert theirs[f"SMC_TYPE_{name}"] == number


@pytest.mark.parametrize("number", range(100))
def test_commands_and_their_words(number: int) -> None:
    """The checks and the decoder know the same commands and the same words of each."""
    command = COMMANDS.get(number, Command())
    for letter in "IJKLORTXZPHA":
        if number == 20 and letter in "KL":
            continue  # It jumps to a line that is not there
        others = sorted(command.needs - {letter})
        if len(command.needs) > 1:  # One of them will do
            others = [] if letter in command.needs else ["I"]
        text = " ".join([f"N0 G{number}", f"{letter}1", *(f"{other}0.5" for other in others), "F9"])
        refused = any(problem.severity == "error" for problem in check(parse(text).lines))
        assert (decode(text).error == 1204) == refused, text


@pytest.mark.parametrize("extra", ["H1 O0.5", "PROBE2", "PROBE2 H1 O0.5"])
@pytest.mark.parametrize("number", sorted(COMMANDS))
def test_commands_with_switch_points_and_probes(number: int, extra: str) -> None:
    """The checks and the decoder know the same commands with a switch point, and with a probe."""
    needs = [f"{letter}5" for letter in sorted(COMMANDS[number].needs)[:1]]
    axes = ["X7"] if "X" in COMMANDS[number].words else []
    text = " ".join([f"N5 G{number}", *needs, *axes, extra, "F9"])
    refused = any(problem.severity == "error" for problem in check(parse(text).lines))
    assert (decode(text).error == 1204) == refused, text
