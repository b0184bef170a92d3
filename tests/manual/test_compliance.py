"""PLCopen's compliance statement says of each pin what the library has."""

from __future__ import annotations

import re
from dataclasses import replace

from tappet.lang.source import Source
from tappet.libraries import load
from tappet.libraries.library import Library
from tappet.manual.compliance import STATES, Block, compared, parameters, statements

BLOCKS = 45
"""Of part 1, version 2.0: 36 of sections 3.1 to 3.34, 9 of sections 4.2 to 4.10."""
PINS = 532


def _changed(name: str, old: str, new: str) -> Library:
    library = load("SM3_Basic")
    assert any(source.name == name and old in source.text for source in library.sources)

    def text(source: Source) -> Source:
        return replace(source, text=source.text.replace(old, new)) if source.name == name else source

    return replace(library, sources=tuple(map(text, library.sources)))


def _block(library: Library, name: str) -> Block:
    return next(block for block in compared(library) if block.name == name)


def test_the_tables_are_whole() -> None:
    blocks = compared(load("SM3_Basic"))
    assert len(blocks) == BLOCKS
    rows = [row for block in blocks for row in block.rows]
    assert len(rows) == PINS
    assert {row.level for row in rows} == {"B", "E"}
    for block in blocks:
        begins = [row for row in block.rows if row.pin in ("Execute", "Enable")]
        assert [row.level for row in begins] == ["B"], block.name
        assert [row.level for row in block.rows if row.pin == "Error"] == ["B"], block.name
        assert len({(row.section, row.pin) for row in block.rows}) == len(block.rows), block.name


def test_what_the_library_has_is_supported() -> None:
    move = _block(load("SM3_Basic"), "MC_MoveAbsolute")
    assert move.count("B") == (7, 7)
    assert move.basic
    assert [row.pin for row in move.rows if row.here is None] == ["ContinuousUpdate"]
    assert [pin.name for _, pin in _block(load("SM3_Basic"), "MC_Power").own] == [
        *("bRegulatorOn", "bDriveStart", "bRegulatorRealState", "bDriveStartRealState", "Busy")
    ]


def test_a_pin_under_another_name_is_found() -> None:
    block = _block(load("SM3_Basic"), "MC_VelocityProfile")
    here = {row.pin: row.here.name for row in block.rows if row.here is not None}
    assert here["ProfileCompleted"] == "Done"
    assert "Done" not in [pin.name for _, pin in block.own]
    assert _block(load("SM3_Basic"), "MC_MoveSuperimposed").here is not None, "MC_MoveSuperImposed here"


def test_a_basic_pin_that_goes_is_missed() -> None:
    library = _changed("MC_MoveAbsolute", "    Position     : LREAL", "    Place        : LREAL")
    block = _block(library, "MC_MoveAbsolute")
    assert (block.count("B"), block.basic) == ((6, 7), False)
    assert "Place" in [pin.name for _, pin in block.own]


def test_a_pin_in_another_section_is_another_pin() -> None:
    library = _changed("MC_Reset", "VAR_OUTPUT\n    Done", "VAR_INPUT\n    Done")
    assert "Done" in [row.pin for row in _block(library, "MC_Reset").rows if row.here is None]


def test_a_block_that_goes_is_missed() -> None:
    library = load("SM3_Basic")
    without = replace(library, sources=tuple(one for one in library.sources if one.name != "MC_Halt"))
    block = _block(without, "MC_Halt")
    assert block.here is None
    assert not block.basic


def test_the_statement_counts_what_it_lists() -> None:
    for text in statements().values():
        levels = [
            (row[1], row[2] in ("yes", "是"))
            for row in re.finditer(r"^\| ([BE]) \| VAR_\w+ \| [^|]+\| [^|]+\| (yes|no|是|否) \|", text, re.M)
        ]
        assert len(levels) == PINS
        for level, line in (("B", 11), ("E", 12)):
            said = sorted(int(number) for number in re.findall(r"\d+", text.splitlines()[line - 1]))
            assert said == sorted([levels.count((level, True)), sum(one == level for one, _ in levels)])


def test_states_and_parameters_are_those_of_the_library() -> None:
    text = statements()["plcopen-compliance.md"]
    assert len(STATES) == 8
    for number, (state, here) in {7: ("Homing", "homing"), 3: ("Standstill", "standstill")}.items():
        assert f"| {state} | `{here}` | {number} |" in text
    found = parameters(load("SM3_Basic"))
    assert found[9] == found[1112] == "fMaxVelocity"
    assert 4 not in found
    assert "| 9 | `MaxVelocityAppl` | B | R/W | yes | `Axis.fMaxVelocity` |" in text
    assert "| 8 | `MaxVelocitySystem` | E | R | no |  |" in text
