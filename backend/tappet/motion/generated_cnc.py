"""The ST of a CNC program as a person reads it: declaration and initial values (CNC-21)."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.cnc.checks import check
from tappet.cnc.letters import ADDRESSES, END_OF_BLOCK
from tappet.cnc.parser import parse
from tappet.cnc.queue_file import FIELDS
from tappet.cnc.word_list import CodeWord, real_text
from tappet.cnc.writer import number_text
from tappet.motion.path_program import Rows
from tappet.motion.path_service import PathService
from tappet.project.cnc.code import queue_variable, reference_variable, used_words
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData

MOST_SHOWN = 5000
"""Words or objects that are written; of more the number is."""


class FaultyProgramError(ValueError):
    """There is no code of a program with errors."""


def generated_code(name: str, data: CncProgramData, settings: CncSettingsData, paths: PathService) -> str:
    """The variables of a program, in the mode that it is compiled in.

    Raises FaultyProgramError, and PathSettingsError for settings that the library does not have.
    """
    program = parse(data.implementation)
    wrong = next((one for one in check(program.lines) if one.severity == "error"), None)
    if wrong is not None:
        raise FaultyProgramError(f"Line {wrong.line + 1}: {wrong.message}")
    if data.compile_mode == "out_queue":
        path = paths.preprocessed(data, settings)
        if path.fault is not None:
            raise FaultyProgramError(path.fault.message)
        content = _array(name, "SMC_GEOINFO", map(_object, path.rows[:MOST_SHOWN]), len(path.rows))
        variable = queue_variable(name, data, len(path.rows))
    else:
        words = [word for _, word in used_words(data, program)]
        content = _array(name, "SMC_GCODE_WORD", map(_word, words[:MOST_SHOWN]), len(words))
        variable = reference_variable(name, data, len(words))
    return f"VAR_GLOBAL\n{content}\n    {variable}\nEND_VAR"


def _array(name: str, kind: str, rows: Iterable[str], count: int) -> str:
    shown = ",\n        ".join(rows)
    more = f"\n        (* and {count - MOST_SHOWN} more *)" if count > MOST_SHOWN else ""
    return f"    {name}_A : ARRAY[0..{max(count - 1, 0)}] OF SM3_CNC.{kind} := [\n        {shown}{more}];"


def _word(word: CodeWord) -> str:
    if word.letter == END_OF_BLOCK:
        return f"(byLetter := 0, diValue := {word.value:.0f})"
    comment = f" (* {ADDRESSES.get(word.letter, '/')} *)"
    if word.variable is not None:
        return f"(byLetter := {word.letter}, pAdr := ADR({word.variable})){comment}"
    value = f"fValue := {real_text(word.value)}, diValue := {round(word.value)}"
    return f"(byLetter := {word.letter}, {value}){comment}"


def _object(row: Rows) -> str:
    """Members that are not 0, but for nested ones in their own names."""
    values = ((field, float(row[field])) for field in FIELDS)
    return "(" + ", ".join(f"{field} := {number_text(value)}" for field, value in values if value) + ")"
