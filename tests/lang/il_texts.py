"""Random texts that are rows of IL, statements of ST, or something between them."""

import json
from pathlib import Path
from random import Random

from tappet.lang.languages.il.operators import INSTRUCTIONS
from tappet.lang.lexer import lex
from tappet.lang.services.instruction_list import holds_rows

OPERATORS = [*(name for name in INSTRUCTIONS if name.isalpha()), *["LD", "LDN", "CAL", "JMPC", "ST"] * 6]
OPERANDS = [
    "a", "a.b", "arr[1]", "3", "-3", "+3", "- 3", "1.5", "16#FF", "T#1s", "INT#5", "'s'", '"w"', "%IX0.1",
    "TRUE", "false", "THIS^.x", "SUPER^", "NULL", "IF", "VAR", "TON", "(", "t1(IN := x)", ":= 3",
    "= 3", "REF= a",
]  # fmt: skip
ENDS = ["", "", "", ";", " ;", " = 3", " // c", " (* c *)", " {p}", ", b", " b", ":", "."]
FIRSTS = ["TIME", "LEN", "l:", "m: n:", "LD:", "JMP", "IF", "END_IF", "// c", "(* c\nd *)", "{p}", "x"]
BREAKS = ["\n", "\n", "\r\n", "\r", "\n\n", " "]
WRITTEN = [
    "NOT", "RET", "retc", "RET x", "RETCN;", "NOT a", "LD +3", "LD -3\nST a", "LD a;", "LD := 3;", "CAL x;",
    "CAL", "R REF= a;", "CAL REF= a;", "JMPC REF= a;",
    "S S= x;", "JMP l;\nl: a := 1;", "JMP l\nl: LD a", "a\n:= 3;", "ST(3);", "LD a\n= 3",
    "LD\na", "TIME\nST t", "l:\nTIME\nl2: ADD 3", "IF\nLD a", "END_IF\nLD a", "LD IF", "LD TRUE", "VAR\nLD a",
    "TIME\nNOT", "TIME\nLEN\nST a", "",
]  # fmt: skip

CORPUS = Path(__file__).parents[2] / "frontend/src/editors/il/texts.json"
"""Texts with whether they are IL, on which the editor is held against the compiler."""


def body(random: Random) -> str:
    """Some rows, one of them hardly right."""
    rows = [random.choice(FIRSTS)] if random.random() < 0.5 else []
    for _ in range(random.choice([1, 1, 2, 3])):
        operand = random.choice(OPERANDS) if random.random() < 0.8 else ""
        rows.append(f"{random.choice(OPERATORS)} {operand}{random.choice(ENDS)}")
    return random.choice(BREAKS).join(rows)


def corpus() -> str:
    """Random texts of a fixed seed, and those written here; each with whether it is IL."""
    random = Random(61131)
    texts = dict.fromkeys([*WRITTEN, *(body(random) for _ in range(500))])
    rows = (json.dumps([text, holds_rows(lex(text, "text"))]) for text in texts)
    return "[\n" + ",\n".join(rows) + "\n]\n"


if __name__ == "__main__":
    CORPUS.write_text(corpus(), encoding="utf-8")
