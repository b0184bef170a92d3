"""Dates, 64-bit numbers, byte order, checks and texts of Tc2_Utilities against Python's own."""

import binascii
import random
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from tests.libraries.st_program import run

NUMBERS = random.Random(816)
EPOCH = datetime(1601, 1, 1, tzinfo=UTC)
PARTS = ("wYear", "wMonth", "wDayOfWeek", "wDay", "wHour", "wMinute", "wSecond", "wMilliseconds")


def _values(declared: str, statements: Sequence[str], names: Sequence[str]) -> list[str]:
    text = f"PROGRAM Main\nVAR {declared} END_VAR\n" + "\n".join(statements) + "\nEND_PROGRAM"
    with run(text, 1) as program:
        return [program.literal(f"Main.{name}") for name in names]


def _moments() -> list[datetime]:
    found = [EPOCH, datetime(2000, 2, 29, 23, 59, 59, 999000, UTC), datetime(2100, 12, 31, tzinfo=UTC)]
    found += [datetime(1970, 1, 1, tzinfo=UTC), datetime(1999, 12, 31, 23, 59, 59, tzinfo=UTC)]
    for _ in range(25):
        milliseconds = NUMBERS.randrange(250_000_000_000 * 50)
        found.append(EPOCH + timedelta(milliseconds=milliseconds))
    return found


def test_points_in_time_and_their_steps_of_100_ns() -> None:
    moments = _moments()
    steps = [(moment - EPOCH) // timedelta(microseconds=1) * 10 for moment in moments]
    lines = []
    for n, value in enumerate(steps):
        lines.append(f"f.dwHighDateTime := {value >> 32}; f.dwLowDateTime := {value & 0xFFFFFFFF};")
        lines.append(f"t[{n}] := FILETIME_TO_SYSTEMTIME(f); back[{n}] := SYSTEMTIME_TO_FILETIME(t[{n}]);")
        lines.append(f"s[{n}] := SYSTEMTIME_TO_STRING(t[{n}]); f := back[{n}];")
        lines.append(f"again[{n}] := SYSTEMTIME_TO_STRING(STRING_TO_SYSTEMTIME(s[{n}]));")
    last = len(moments) - 1
    declared = f"f : T_FILETIME; t : ARRAY[0..{last}] OF TIMESTRUCT; back : ARRAY[0..{last}] OF T_FILETIME; "
    declared += f"s, again : ARRAY[0..{last}] OF STRING(24);"
    names = [f"{name}[{n}]" for n in range(len(moments)) for name in ("s", "again")]
    names += [
        f"back[{n}].{part}" for n in range(len(moments)) for part in ("dwHighDateTime", "dwLowDateTime")
    ]
    names += [f"t[{n}].wDayOfWeek" for n in range(len(moments))]
    found = _values(declared, lines, names)
    expected = [f"'{m:%Y-%m-%d-%H:%M:%S}.{m.microsecond // 1000:03}'" for m in moments for _ in "12"]
    expected += [str(part) for value in steps for part in (value >> 32, value & 0xFFFFFFFF)]
    expected += [str(moment.isoweekday() % 7) for moment in moments]
    assert found == expected


def test_dt_and_its_parts() -> None:
    seconds = [0, 1, 2**32 - 1, *(NUMBERS.randrange(2**32) for _ in range(12))]
    lines = []
    for n, second in enumerate(seconds):
        lines.append(
            f"d := UDINT_TO_DT({second}); t[{n}] := DT_TO_SYSTEMTIME(d); w[{n}] := F_GetDayOfWeek(d);"
        )
        lines.append(f"b[{n}] := SYSTEMTIME_TO_DT(t[{n}]) = d AND FILETIME_TO_DT(DT_TO_FILETIME(d)) = d;")
        lines.append(f"k[{n}] := F_GetWeekOfTheYear(t[{n}]);")
    last = len(seconds) - 1
    declared = f"d : DT; t : ARRAY[0..{last}] OF TIMESTRUCT; w, k : ARRAY[0..{last}] OF WORD; "
    declared += f"b : ARRAY[0..{last}] OF BOOL;"
    names = [f"t[{n}].{part}" for n in range(len(seconds)) for part in PARTS]
    found = _values(declared, lines, [*names, "w", "k", "b"])
    moments = [datetime.fromtimestamp(second, UTC) for second in seconds]
    expected: list[str] = []
    for m in moments:
        parts = (m.year, m.month, m.isoweekday() % 7, m.day, m.hour, m.minute, m.second, 0)
        expected += [str(part) for part in parts]
    assert found[: len(expected)] == expected
    assert found[-3] == str([m.isoweekday() for m in moments])
    assert found[-2] == str([m.isocalendar().week for m in moments])
    assert set(found[-1].strip("[]").split(", ")) == {"TRUE"}


def test_what_is_no_point_in_time() -> None:
    declared = "t : TIMESTRUCT; d : DT := DT#2000-01-01-00:00:00; f : T_FILETIME; y : ARRAY[0..2] OF WORD;"
    lines = [
        "t.wYear := 2023; t.wMonth := 2; t.wDay := 29;",
        "d := SYSTEMTIME_TO_DT(t); f := SYSTEMTIME_TO_FILETIME(t);",
        "t := STRING_TO_SYSTEMTIME('2023-02-29-00:00:00.000'); y[0] := t.wYear;",
        "t := STRING_TO_SYSTEMTIME('2024-02-29 00:00:00.000'); y[1] := t.wYear;",
        "t := STRING_TO_SYSTEMTIME('2024-02-29-00:00:00.000'); y[2] := t.wYear;",
    ]
    found = _values(declared, lines, ["d", "f.dwLowDateTime", "f.dwHighDateTime", "y"])
    assert found == ["DT#1970-01-01-00:00:00", "0", "0", "[0, 0, 2024]"]


def test_days_and_months_of_years() -> None:
    lines, expected = [], []
    for n in range(40):
        year, day = NUMBERS.randint(1601, 2400), NUMBERS.randint(0, 367)
        month, wom, dow = NUMBERS.randint(1, 12), NUMBERS.randint(1, 5), NUMBERS.randint(0, 6)
        leap = (datetime(year, 3, 1) - datetime(year, 2, 1)).days == 29
        date = datetime(year, 1, 1) + timedelta(days=day - 1)
        in_year = 1 <= day <= 365 + leap
        lines.append(f"l[{n}] := F_YearIsLeapYear({year}); m[{n}] := F_GetMonthOfDOY({year}, {day});")
        lines.append(f"y[{n}] := F_GetDOYOfYearMonthDay({date.year}, {date.month}, {date.day});")
        lines.append(f"x[{n}] := F_GetDayOfMonthEx({year}, {month}, {wom}, {dow});")
        fitting = [
            first.day
            for first in (datetime(year, month, 1) + timedelta(days=k) for k in range(31))
            if first.month == month and first.isoweekday() % 7 == dow
        ]
        expected.append(
            (leap, date.month if in_year else 0, date.timetuple().tm_yday, (fitting + fitting[-1:])[wom - 1])
        )
    declared = "l : ARRAY[0..39] OF BOOL; m, y, x : ARRAY[0..39] OF WORD;"
    found = _values(declared, lines, ["l", "m", "y", "x"])
    columns = [list(column) for column in zip(*expected, strict=True)]
    assert found == [str(columns[0]).upper(), *(str(column) for column in columns[1:])]


def test_durations_by_their_parts() -> None:
    lines = [
        "o := TIME_TO_OTSTRUCT(T#3w2d5h7m11s13ms); t := OTSTRUCT_TO_TIME(o);",
        "o2.wWeek := 8; u := T#1s;",
    ]
    lines = [line.replace("3w2d", "23d") for line in lines] + ["u := OTSTRUCT_TO_TIME(o2);"]
    parts = ("wWeek", "wDay", "wHour", "wMinute", "wSecond", "wMilliseconds")
    found = _values("o, o2 : OTSTRUCT; t, u : TIME;", lines, [*(f"o.{part}" for part in parts), "t", "u"])
    assert found == ["3", "2", "5", "7", "11", "13", "T#23d5h7m11s13ms", "T#0ms"]


def test_unsigned_numbers_of_64_bits() -> None:
    mask = 2**64 - 1
    operations = {
        "UInt64Add64(a, b)": lambda a, b, n: a + b,
        "UInt64Sub64(a, b)": lambda a, b, n: a - b,
        "UInt64Mul64(a, b)": lambda a, b, n: a * b,
        "UInt64And(a, b)": lambda a, b, n: a & b,
        "UInt64Or(a, b)": lambda a, b, n: a | b,
        "UInt64Xor(a, b)": lambda a, b, n: a ^ b,
        "UInt64Not(a)": lambda a, b, n: ~a,
        "UInt64Max(a, b)": lambda a, b, n: max(a, b),
        "UInt64Min(a, b)": lambda a, b, n: min(a, b),
        "UInt64Mod64(a, b)": lambda a, b, n: a % b,
        "UInt64Div64(a, b)": lambda a, b, n: a // b,
        "UInt64Div64Ex(a, b, rest)": lambda a, b, n: a // b,
        "rest": lambda a, b, n: a % b,
        "UInt64Div16Ex(a, UDINT_TO_WORD(n), rest)": lambda a, b, n: a // n,
        "UInt64Add64(rest, rest)": lambda a, b, n: 2 * (a % n),
        "UInt64Shl(a, n)": lambda a, b, n: a << n,
        "UInt64Shr(a, n)": lambda a, b, n: a >> n,
        "UInt64Rol(a, n)": lambda a, b, n: a << n | a >> (64 - n),
        "UInt64Ror(a, n)": lambda a, b, n: a >> n | a << (64 - n),
        "UInt32x32To64(a.dwLowPart, b.dwLowPart)": lambda a, b, n: (a & 0xFFFFFFFF) * (b & 0xFFFFFFFF),
        "BE64_TO_HOST(a)": lambda a, b, n: int.from_bytes(a.to_bytes(8, "little"), "big"),
        "STRING_TO_UINT64(UINT64_TO_STRING(a))": lambda a, b, n: a,
    }
    lines, expected = [], []
    for _ in range(2):
        a, b, n = (
            NUMBERS.getrandbits(64),
            NUMBERS.getrandbits(NUMBERS.choice([32, 64])),
            NUMBERS.randrange(1, 64),
        )
        lines.append(f"a := ULARGE_INTEGER({a >> 32}, {a & 0xFFFFFFFF}); n := {n};")
        lines.append(f"b := ULARGE_INTEGER({b >> 32}, {b & 0xFFFFFFFF});")
        for call, meaning in operations.items():
            lines.append(f"c := {call}; s[{len(expected)}] := UINT64_TO_STRING(c);")
            expected.append(f"'{meaning(a, b, n) & mask}'")
    declared = (
        f"a, b, c, rest : T_ULARGE_INTEGER; n : UDINT; s : ARRAY[0..{len(expected) - 1}] OF STRING(21);"
    )
    assert _values(declared, lines, [f"s[{k}]" for k in range(len(expected))]) == expected


def test_signed_numbers_and_the_order_of_numbers() -> None:
    declared = "a, b, c : T_LARGE_INTEGER; u, v : T_ULARGE_INTEGER; d : ARRAY[0..4] OF DINT; z, y : BOOL;"
    lines = [
        "a := LARGE_INTEGER(-1, 16#FFFF_FFFE); b := LARGE_INTEGER(0, 5); c := Int64Add64(a, b);",
        "d[0] := Int64Cmp64(a, b); d[1] := DWORD_TO_DINT(c.dwLowPart); c := Int64Negate(a);",
        "d[2] := DWORD_TO_DINT(c.dwLowPart); c := Int64Sub64(a, b); d[3] := DWORD_TO_DINT(c.dwLowPart);",
        "u := LargeToULarge(a); v := ULARGE_INTEGER(0, 5); d[4] := UInt64Cmp64(u, v);",
        "z := UInt64isZero(UInt64Sub64(v, v)); y := Int64isZero(a);",
    ]
    assert _values(declared, lines, ["d", "z", "y"]) == ["[-1, 3, 2, -7, 1]", "TRUE", "FALSE"]


def test_checks_of_bytes() -> None:
    data = NUMBERS.randbytes(60)
    text = ", ".join(str(byte) for byte in data)
    declared = f"a : ARRAY[0..59] OF BYTE := [{text}]; c, d, e : WORD;"
    lines = [
        "c := F_DATA_TO_CRC16_CCITT(ADR(a), 60, 16#FFFF); d := F_DATA_TO_CRC16_CCITT(ADR(a), 20, 0);",
        "e := F_DATA_TO_CRC16_CCITT(ADR(a[20]), 40, d);",
    ]
    expected = [str(binascii.crc_hqx(data, 0xFFFF)), str(binascii.crc_hqx(data, 0))]
    assert _values(declared, lines, ["c", "e"]) == expected


def test_byte_order_texts_and_hexadecimal_digits() -> None:
    declared = "s : ARRAY[0..9] OF STRING(255); w : WORD; d : DWORD; r1 : REAL := 1.0; p : POINTER TO DWORD; "
    declared += (
        "a : ARRAY[0..3] OF BYTE; n : ARRAY[0..3] OF UDINT; x : DWORD; f : ARRAY[0..1] OF BOOL; z : LREAL;"
    )
    lines = [
        "w := BE16_TO_HOST(16#1234); d := HOST_TO_BE32(16#1234_5678);",
        "r1 := F_SwapReal(r1); p := ADR(r1); x := p^;",
        "s[0] := F_ToUCase('aZ[`{z1'); s[1] := F_ToLCase('AZ[`@z1'); s[2] := F_LTrim('  a b '); ",
        "s[3] := F_RTrim(' a b  '); s[4] := F_RTrim('   ');",
        "n[0] := HEXSTR_TO_DATA('DE adBE 0f', ADR(a), 4); s[5] := DATA_TO_HEXSTR(ADR(a), 4, FALSE);",
        "n[1] := HEXSTR_TO_DATA('DEA', ADR(a), 4); n[2] := HEXSTR_TO_DATA('0102030405', ADR(a), 4);",
        "n[3] := HEXSTR_TO_DATA('G0', ADR(a), 4);",
        "s[6] := BYTEARR_TO_MAXSTRING(MAXSTRING_TO_BYTEARR('both ways'));",
        "f[0] := IsFinite(F_LREAL(z)); z := 1.0E308; z := z * 10.0; f[1] := IsFinite(F_LREAL(z));",
    ]
    found = _values(declared, lines, ["w", "d", "x", *(f"s[{k}]" for k in range(7)), "n", "f"])
    assert found == [
        str(0x3412), str(0x78563412), str(0x00003F80), "'AZ[`{Z1'", "'az[`@z1'", "'a b '", "' a b'", "''",
        "'DEADBE0F'", "'both ways'", "[4, 0, 0, 0]", "[TRUE, FALSE]",
    ]  # fmt: skip
