"""Whether the body that begins at a token is IL: by the standard the first instruction decides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.languages.il.operators import ALONE, INSTRUCTIONS
from tappet.lang.lexer import ADDRESS, END, ID, INT, NUMBER, STRING
from tappet.lang.parser_core import BODY_END

if TYPE_CHECKING:
    from tappet.lang.parser_core import Core

_OPERANDS = frozenset([ID, INT, NUMBER, STRING, ADDRESS, "TRUE", "FALSE", "THIS", "SUPER"])


def is_instruction_list(core: Core) -> bool:
    """Whether the next token begins a row of IL. What can be a statement of ST is one."""
    i = core.i
    for bare_function in (False, True):  # the first row may be a function name alone, such as TIME
        while core.kinds[i] is ID and core.kinds[i + 1] == ":":
            i += 2
        if core.kinds[i] in BODY_END:
            return False
        if _is_row(core, i, bare_function):
            return True
        if core.kinds[i] is not ID or not _line_ends(core, i):
            return False
        i += 1
    return False


def _line_ends(core: Core, i: int) -> bool:
    return core.lines[i + 1] != core.lines[i] or core.kinds[i + 1] is END


def _is_row(core: Core, i: int, has_value: bool) -> bool:
    """Whether an instruction of IL with an operand, and no statement, stands at token `i`.

    `has_value`: there is a row before, so that the accumulator may be stored or combined.
    """
    word = core.texts[i].upper()
    instruction = INSTRUCTIONS.get(word)
    if instruction is None:
        return False
    if _line_ends(core, i):
        return word in ALONE
    following = core.kinds[i + 1]
    if core.kinds[i + 2] == "=":  # a variable may have the name of an operator: CAL REF= a;
        return False
    if instruction.action == "call":
        return following in _OPERANDS
    if instruction.action == "jump":
        return following is ID and core.kinds[i + 2] != ";"
    if instruction.action == "load":
        return following in _OPERANDS or following in ("-", "+")
    return has_value and following in _OPERANDS and core.kinds[i + 2] != ";"
