"""Formatted texts of Tc2_Utilities against Python's % operator, which follows C."""

import random
import struct
from collections.abc import Sequence
from decimal import ROUND_DOWN, Context, Decimal

from tests.libraries.st_program import run

NUMBERS = random.Random(4711)


def _quoted(text: str) -> str:
    return "'" + text.replace("$", "$$").replace("'", "$'") + "'"


def _formatted(cases: Sequence[tuple[str, str, str]]) -> list[str]:
    """What FB_FormatString makes of (format, type, literal), one after the other in one program."""
    lines = []
    for number, (layout, type_name, literal) in enumerate(cases):
        variable = f"v{type_name}"
        lines.append(
            f"{variable} := {literal}; fb(sFormat := {_quoted(layout)}, arg1 := F_{type_name}({variable}));"
        )
        lines.append(f"aOut[{number}] := fb.sOut; IF fb.bError THEN aOut[{number}] := ")
        lines.append("CONCAT('error ', UDINT_TO_STRING(fb.nErrId)); END_IF")
    types = sorted({type_name for _, type_name, _ in cases})
    declared = " ".join(f"v{t} : {t};" for t in types)
    text = f"PROGRAM Main\nVAR fb : FB_FormatString; {declared}\n"
    text += f"aOut : ARRAY[0..{len(cases) - 1}] OF STRING(255); END_VAR\n"
    text += "\n".join(lines) + "\nEND_PROGRAM"
    with run(text, 1) as program:
        return [program.literal(f"Main.aOut[{number}]")[1:-1] for number in range(len(cases))]


def _flags() -> str:
    chosen = "".join(flag for flag in "-+ 0" if NUMBERS.random() < 0.3)
    return chosen + NUMBERS.choice(["", "", str(NUMBERS.randint(1, 30))])


def _double() -> float:
    if NUMBERS.random() < 0.3:
        return round(NUMBERS.uniform(-1000, 1000) * 8) / 8  # halves that round to even
    while True:
        (value,) = struct.unpack("<d", NUMBERS.randbytes(8))
        if value == value and abs(value) < 1e200:
            return float(value)


def test_numbers_with_a_decimal_point_or_an_exponent() -> None:
    cases, expected = [], []
    for _ in range(60):
        value, kind = _double(), NUMBERS.choice("fffeE")
        layout = f"%{_flags()}{NUMBERS.choice(['', '.0', '.1', '.3', '.15', '.40'])}{kind}"
        wanted = layout % value
        cases.append((layout, "LREAL", repr(value)))
        expected.append(wanted if len(wanted.strip().lstrip("+-0")) < 240 else "error 32769")
    assert _formatted(cases) == expected


def test_integers() -> None:
    cases, expected = [], []
    for _ in range(60):
        bits, unsigned = NUMBERS.choice([8, 16, 32, 64]), NUMBERS.random() < 0.5
        type_name = ("U" if unsigned else "") + {8: "SINT", 16: "INT", 32: "DINT", 64: "LINT"}[bits]
        value = (
            NUMBERS.randrange(2**bits)
            if unsigned
            else NUMBERS.randrange(1 - 2 ** (bits - 1), 2 ** (bits - 1))
        )
        if NUMBERS.random() < 0.5:
            precision = NUMBERS.choice(["", "", ".5", ".25"])
            flags = _flags()
            # unlike Python, C fills with zeros only where no precision is given
            layout = f"<%{flags.replace('0', '') if precision else flags}{precision}d>"
            cases.append((layout, type_name, str(value)))
            expected.append(layout % value)
        else:
            layout = f"%{NUMBERS.choice(['', '12', '-12', '012'])}{NUMBERS.choice('xXo')}"
            cases.append((layout, type_name, str(value)))
            expected.append(layout % (value % 2**bits))
    assert _formatted(cases) == expected


def test_texts_bits_and_characters() -> None:
    cases = [
        ("%s", "STRING", "'plain'"),
        ("[%8s]", "STRING", "'left'"),
        ("[%-8s]", "STRING", "'right'"),
        ("[%.3s]", "STRING", "'cut off'"),
        ("100 %% %s", "STRING", "'sure'"),
        ("%c%%", "BYTE", "16#41"),
        ("%b", "BYTE", "16#A5"),
        ("%#.16b", "WORD", "16#ABCD"),
        ("%#x", "DWORD", "16#DEADBEEF"),
        ("%#o", "WORD", "8#777"),
        ("%08X", "REAL", "1.0"),
        ("%s", "BOOL", "TRUE"),
        ("%d", "BOOL", "TRUE"),
        ("%u", "INT", "-1"),
    ]
    assert _formatted(cases) == [
        "plain", "[    left]", "[right   ]", "[cut]", "100 % sure", "A%", "10100101", "2#1010101111001101",
        "16#deadbeef", "8#777", "3F800000", "TRUE", "1", "65535",
    ]  # fmt: skip


def test_errors_tell_what_is_wrong_and_in_which_argument() -> None:
    cases = [
        ("%q", "INT", "1"),
        ("%", "INT", "1"),
        ("%s", "INT", "1"),
        ("%f", "INT", "1"),
        ("%d", "LREAL", "1.0"),
        ("%d%d", "INT", "1"),
        ("%300d", "INT", "1"),
        ("%.300d", "INT", "1"),
        ("%*d", "LREAL", "1.0"),
        ("%f", "LREAL", "1.0E250"),
    ]
    found = [int(text.removeprefix("error ")) for text in _formatted(cases)]
    assert found == [
        0x801, 0x11, 0x1001, 0x1001, 0x1001, 0x4002, 0x41, 0x81, 0x21, 0x8001,
    ]  # fmt: skip


def test_a_text_longer_than_255_characters_and_one_that_has_no_room() -> None:
    text = """
        PROGRAM Main
        VAR
            fb : FB_FormatString2; sFormat : STRING(400); sOut : STRING(400); sShort : STRING(5);
            nGuard : DWORD := 7; i : INT; iLength : INT; xShort : BOOL; nShort : UDINT;
        END_VAR
        FOR i := 0 TO 299 DO sFormat[i] := 16#2E; END_FOR
        sFormat[300] := 16#25; sFormat[301] := 16#73; sFormat[302] := 0;
        fb(pFormatString := ADR(sFormat), arg1 := F_STRING('tail'), pDstString := ADR(sOut),
           nDstSize := SIZEOF(sOut));
        WHILE sOut[iLength] <> 0 DO iLength := iLength + 1; END_WHILE
        fb(pFormatString := ADR(sFormat), pDstString := ADR(sShort), nDstSize := SIZEOF(sShort),
           bError => xShort, nErrId => nShort);
        END_PROGRAM"""
    with run(text, 1) as program:
        assert program.literal("Main.iLength") == "304"
        assert [program.literal(f"Main.sOut[{n}]") for n in (299, 300, 303)] == ["46", "116", "108"]
        assert program.literal("Main.sShort") == "''"
        assert program.literal("Main.nGuard") == "7"
        assert (program.literal("Main.xShort"), program.literal("Main.nShort")) == ("TRUE", str(0x8001))


def test_fixed_texts_of_numbers() -> None:
    values = [_double() for _ in range(30)]
    values = [value for value in values if abs(value) < 1e100]
    lines = [
        f"a[{n}] := LREAL_TO_FMTSTR({value!r}, 3, TRUE); b[{n}] := LREAL_TO_FMTSTR({value!r}, 2, FALSE);"
        for n, value in enumerate(values)
    ]
    text = f"PROGRAM Main\nVAR a, b : ARRAY[0..{len(values)}] OF STRING(255); END_VAR\n"
    with run(text + "\n".join(lines) + "\nEND_PROGRAM", 1) as program:
        for n, value in enumerate(values):
            assert program.literal(f"Main.a[{n}]") == f"'{value:.3f}'"
            cut = Decimal(value).quantize(Decimal("0.01"), ROUND_DOWN, Context(prec=400))
            assert program.literal(f"Main.b[{n}]") == f"'{cut}'"


def test_digits_in_a_base() -> None:
    text = """
        PROGRAM Main
        VAR a : ARRAY[0..9] OF STRING(80); END_VAR
        a[0] := DINT_TO_DECSTR(-7, 3); a[1] := DINT_TO_DECSTR(-2147483648, 1);
        a[2] := DWORD_TO_HEXSTR(16#ABCD, 6, FALSE); a[3] := DWORD_TO_HEXSTR(16#ABCD, 1, TRUE);
        a[4] := BYTE_TO_HEXSTR(16#F, 2, FALSE); a[5] := WORD_TO_HEXSTR(0, 4, FALSE);
        a[6] := LWORD_TO_HEXSTR(16#FEDC_BA98_7654_3210, 1, FALSE); a[7] := BYTE_TO_BINSTR(5, 8);
        a[8] := WORD_TO_OCTSTR(8#17, 3); a[9] := DWORD_TO_DECSTR(16#FFFF_FFFF, 1);
        END_PROGRAM"""
    with run(text, 1) as program:
        assert [program.literal(f"Main.a[{n}]")[1:-1] for n in range(10)] == [
            "-007", "-2147483648", "00ABCD", "abcd", "0F", "0000", "FEDCBA9876543210", "00000101", "017",
            "4294967295",
        ]  # fmt: skip
