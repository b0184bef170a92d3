"""Random texts for what reads IEC texts: pieces that need not fit, closed and unclosed."""

import json
from pathlib import Path
from random import Random

from hypothesis import strategies as st

from tappet.iec.sections import declaration_end, read_header
from tappet.iec.tokens import pieces, words
from tappet.iec.words import SECTIONS

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


HEADS = [
    "PROGRAM P", "FUNCTION F : INT", "FUNCTION_BLOCK ABSTRACT FB EXTENDS Base\n  IMPLEMENTS A, B",
    "METHOD m : BOOL;", "METHOD PRIVATE FINAL m", "PROPERTY p : REAL", "GET", "ACTION A :",
    "FUNCTIONBLOCK fb", "INTERFACE I EXTENDS J, K",
    "{attribute 'x'}\n(* PROGRAM *) program p // VAR",
    "FUNCTION_BLOCK G\nVAR_GENERIC CONSTANT\n  n : INT;\nEND_VAR\nEXTENDS B",
    "", "(* VAR *)", "PROGRAM", "PROGRAM 1", "TRANSITION t", "x := 1;", ";", "END_VAR", "TYPE T :",
    "FUNCTION F : ARRAY[0..3] OF\nINT", "PROGRAM\nP", "METHOD PRIVATE\n\n m : BOOL",
    "FUNCTION_BLOCK // below\nFINAL FB\nEXTENDS B", "METHOD PRIVATE",
]  # fmt: skip
BLOCKS = [
    "VAR\nEND_VAR", "VAR x : INT; END_VAR",
    "VAR_INPUT CONSTANT\n  a, b : INT := 3; // END_VAR\nEND_VAR // last",
    "VAR (* END_VAR *)\n  s : STRING := 'END_VAR';\nEND_VAR (* goes\non *)",
    "var_temp\nend_var", "VAR {x} END_VAR;",
    "VAR RETAIN PERSISTENT\n  x AT %MX0.1 : BOOL;\nEND_VAR", "VAR_GLOBAL\n  x : INT;",
    "VAR PUBLIC p : INT; END_VAR", "VAR x : ARRAY[0..3] OF STRUCT END_VAR",
    "VAR_CONFIG\n  a.b.c AT %IX0.0 : BOOL;\nEND_VAR", "VAR 'a END_VAR\nEND_VAR",
    "VAR x#END_VAR END_VAR", "VAR END_VAR# END_VAR", "VAR_EXTERNAL _END_VAR : INT; END_VARS : INT; END_VAR",
]  # fmt: skip
BODIES = ["", "x := 1;", "IF x THEN VAR := 1; END_IF", "END_PROGRAM", "(* c *) y();", "END_VAR", "'"]


def declared(random: Random) -> str:
    """A text of an object: a head, sections and a body; not all of them right."""
    sections = random.choices(BLOCKS, k=random.choice([0, 1, 1, 2, 3]))
    between = random.choice(["\n", "\r\n", "\n\n", " "])
    return between.join([random.choice(HEADS), *sections, random.choice(BODIES)])


def sections_of(text: str) -> dict[str, object]:
    """What a text declares, where its declaration ends, and its sections: keyword, where each begins, where
    its `END_VAR` ends; null where another section begins, or the declaration ends, before it.
    """
    header = read_header(text)
    end = declaration_end(text)
    found: list[list[object]] = []
    is_open = False
    for word in words(text[:end]):
        if word.text in SECTIONS:
            found.append([word.text, word.start, None])
            is_open = True
        elif word.text == "END_VAR" and is_open:
            found[-1][2] = word.end
            is_open = False
    head = None if header is None else [header.keyword, header.name, header.name_start]
    return {"header": head, "end": end, "sections": found}


def corpus() -> str:
    """Random texts of a fixed seed, and each piece alone."""
    random = Random(61131)
    texts = list(PIECES)
    texts += ["".join(random.choices(PIECES, k=random.randint(2, 6))) for _ in range(300)]
    texts += [" ".join(random.choices(PIECES, k=random.randint(5, 20))) for _ in range(60)]
    texts += [declared(random) for _ in range(400)]
    rows = (
        {"text": text, "pieces": [piece[:2] for piece in pieces(text)], **sections_of(text)}
        for text in dict.fromkeys(texts)
    )
    return "[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]\n"


if __name__ == "__main__":
    CORPUS.write_text(corpus(), encoding="utf-8")
