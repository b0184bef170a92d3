"""Random texts for what reads IEC texts: pieces that need not fit, closed and unclosed."""

import json
from pathlib import Path
from random import Random

from hypothesis import strategies as st

from tappet.iec.tokens import pieces

WORDS = [
    "VAR", "END_VAR", "VAR_GENERIC", "VAR_INPUT", "PROGRAM P", "FUNCTION_BLOCK FB", "EXTENDS", "TYPE T :",
    "END_TYPE", "if", "x", "_y1", "é", "𝒳", "²", "٣", "Ω1", "REF",
]  # fmt: skip
LITERALS = [
    "T#1s500ms", "LT#-5", "16#FF", "INT#5", "é#1", "X#Red", "x#", "1.5e-3", "1e+5", "0..9", "1.", "x.1",
    "DT#1996-05-06-15:36:30.5", "%IX0.1", "%Q*", "%", "%MW", "STRING#'a'", "STRING#'", 'WSTRING#"b"',
]  # fmt: skip
STRINGS = [
    "'a'", "'$''", "'$$'", "'$'", "'", '"b"', '"', '"$""', "'//'", "'(*'", "'END_VAR'", "'{'", "$", "'a\nb';",
    "'a\r\nb')",
]  # fmt: skip
TRIVIA = [
    "(*", "*)", "(**)", "(* END_VAR *)", "(* (* *) *)", "//", "// VAR (*", "/*", "*/", "/**/", "/* ' */",
    "{", "}",
    "{attribute 'a'}", "{attribute '}'}", '{attribute "}"}', "{attribute 'a' :=\n'b'}", "{x '", "{x 'a}b'}",
    "{IF defined (x)}", "{{c}}", "{attribute 'a' := 'it$'s'}",
]  # fmt: skip
SIGNS = [
    "[", "]", ":", ":=", "=>", "=", "<>", "<=", "..", ".", "**", "*", "/", ";", ",", "(", ")", "?=", "?", "#",
    "#", "-", "&", "^", "!", "\\", "‘", "，",
]  # fmt: skip
BLANKS = [
    " ", "\t", "\n", "\r\n", "\r", "\u2028", "\x85", "\x0b", "\x0c", "\x1c", "\ufeff", "\xa0", "\u200b",
    "\u3000",
]  # fmt: skip

PIECES = [*WORDS, *LITERALS, *STRINGS, *TRIVIA, *SIGNS, *BLANKS]
TEXTS = st.lists(st.sampled_from(PIECES), max_size=12).map("".join) | st.lists(
    st.sampled_from([*PIECES, *BLANKS, " ", " ", " "]), max_size=40
).map(" ".join)
"""Texts whose pieces touch, and longer ones with blanks between most."""

CORPUS = Path(__file__).parents[2] / "frontend/src/iec/texts.json"
"""Texts with their pieces and sections, on which the scanner of the editors is held against this one."""


def corpus() -> str:
    """Random texts of a fixed seed, and each piece alone."""
    random = Random(61131)
    texts = list(PIECES)
    texts += ["".join(random.choices(PIECES, k=random.randint(2, 6))) for _ in range(300)]
    texts += [" ".join(random.choices(PIECES, k=random.randint(5, 20))) for _ in range(60)]
    rows = ({"text": text, "pieces": [piece[:2] for piece in pieces(text)]} for text in dict.fromkeys(texts))
    return "[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]\n"


if __name__ == "__main__":
    CORPUS.write_text(corpus(), encoding="utf-8")
