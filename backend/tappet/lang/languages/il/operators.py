"""The instructions of IL and the modifiers each one takes (IL-20..IL-52)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal

Action = Literal["load", "store", "set", "reset", "not", "combine", "jump", "call", "return"]


@dataclass(frozen=True, slots=True)
class Instruction:
    """One word of the operator column."""

    name: str
    action: Action
    meaning: str
    operator: str = ""
    """For `combine`: the operator of the tree, as in `ast.Binary.op`."""
    negated: bool = False
    """Modifier N: the operand (LDN, ANDN), the stored value (STN) or the condition (JMPCN) is negated."""
    conditional: bool = False
    """Modifier C: executed only if the accumulator is TRUE, with N only if it is FALSE (IL-20, IL-21)."""


def _instructions() -> dict[str, Instruction]:
    found = [
        Instruction("LD", "load", "Loads the operand into the accumulator."),
        Instruction("LDN", "load", "Loads the negated operand into the accumulator.", negated=True),
        Instruction("ST", "store", "Stores the accumulator in the operand."),
        Instruction("STN", "store", "Stores the negated accumulator in the operand.", negated=True),
        Instruction("S", "set", "Sets the BOOL operand to TRUE if the accumulator is TRUE."),
        Instruction("R", "reset", "Sets the BOOL operand to FALSE if the accumulator is TRUE."),
        Instruction("NOT", "not", "Bitwise complement of the accumulator."),
        Instruction("JMP", "jump", "Continues at the label."),
        Instruction("CAL", "call", "Calls a function block instance, a program or an action."),
        Instruction("RET", "return", "Leaves the POU."),
    ]
    for name, text in (("JMP", "Continues at the label"), ("CAL", "Calls"), ("RET", "Leaves the POU")):
        action: Action = {"JMP": "jump", "CAL": "call", "RET": "return"}[name]  # type: ignore[assignment]
        found.append(Instruction(name + "C", action, f"{text} if the accumulator is TRUE.", conditional=True))
        found.append(
            Instruction(
                name + "CN", action, f"{text} if the accumulator is FALSE.", negated=True, conditional=True
            )
        )
    found.append(Instruction("JMPN", "jump", "The same as JMPCN.", negated=True, conditional=True))
    for name in ("AND", "OR", "XOR"):
        text = f"Bitwise {name} of accumulator and"
        found.append(Instruction(name, "combine", f"{text} operand.", operator=name))
        found.append(
            Instruction(name + "N", "combine", f"{text} negated operand.", operator=name, negated=True)
        )
    found.append(Instruction("&", "combine", "Bitwise AND of accumulator and operand.", operator="AND"))
    for name, operator, text in (
        ("ADD", "+", "Adds the operand to the accumulator."),
        ("SUB", "-", "Subtracts the operand from the accumulator."),
        ("MUL", "*", "Multiplies the accumulator by the operand."),
        ("DIV", "/", "Divides the accumulator by the operand."),
        ("MOD", "MOD", "Remainder of the accumulator divided by the operand."),
        ("GT", ">", "TRUE if the accumulator is greater than the operand."),
        ("GE", ">=", "TRUE if the accumulator is greater than or equal to the operand."),
        ("EQ", "=", "TRUE if the accumulator equals the operand."),
        ("NE", "<>", "TRUE if the accumulator does not equal the operand."),
        ("LE", "<=", "TRUE if the accumulator is less than or equal to the operand."),
        ("LT", "<", "TRUE if the accumulator is less than the operand."),
    ):
        found.append(Instruction(name, "combine", text, operator=operator))
    return {item.name: item for item in found}


INSTRUCTIONS: Final = _instructions()
"""Every instruction by its name in upper case."""

ALONE: Final = frozenset(name for name, item in INSTRUCTIONS.items() if item.action in ("return", "not"))
"""Instructions that stand without an operand."""

FRESH: Final = frozenset({"LD", "LDN", "JMP", "RET"})
"""Instructions behind which the accumulator of before is not needed any more."""

WITHOUT_OPERAND: Final = frozenset({"TIME", "LTIME"})
"""Functions that take no operand: the accumulator is not passed to them (language_st.md 4.1, TIME)."""


def _wrong_modifiers() -> dict[str, tuple[str, str]]:
    found = {}
    for name, modifiers in (
        ("LD", ("C", "CN")), ("ST", ("C", "CN")), ("AND", ("C", "CN")), ("OR", ("C", "CN")),
        ("XOR", ("C", "CN")), ("ADD", ("N", "C")), ("SUB", ("N", "C")), ("MUL", ("N", "C")),
        ("DIV", ("N", "C")), ("MOD", ("N", "C")), ("GT", ("N", "C")), ("GE", ("N", "C")),
        ("EQ", ("N", "C")), ("NE", ("N", "C")), ("LE", ("C",)), ("LT", ("N", "C")),
        ("NOT", ("N", "C")), ("CAL", ("N",)), ("RET", ("N",)),
    ):  # fmt: skip
        for modifier in modifiers:
            found[name + modifier] = (name, modifier)
    return found


WRONG_MODIFIERS: Final = _wrong_modifiers()
"""Operators with a modifier they do not take: (operator, modifier) by the word as written."""
