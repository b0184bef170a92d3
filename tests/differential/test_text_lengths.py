"""Texts at the bounds of their variables: every function and conversion, with the neighbours watched.

Source: LTYP-13, LTYP-14, LOPR-70..79; the string functions take and give 255 characters.
"""

from __future__ import annotations

from random import Random

import pytest
from linked_application import LoadedApplication
from seeds import seeds
from text_lengths import GUARD, LENGTHS, Texts, content, program, quoted, word

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.lang.source import Source

SESSION = BuildSession()
LIBRARIES = (LibraryReference("Standard"), LibraryReference("Standard64"))
VALUES = {
    "LREAL": "-1.2345678901234567E-300", "REAL": "-1.234567E-30", "LINT": "-9223372036854775808",
    "ULINT": "18446744073709551615", "LWORD": "16#FFFFFFFFFFFFFFFF", "DINT": "-2147483648", "SINT": "-128",
    "BOOL": "FALSE", "TIME": "T#49d17h2m47s295ms", "LTIME": "LTIME#213503d23h34m33s709ms551us615ns",
    "DATE": "D#2106-02-07", "TOD": "TOD#23:59:59.999", "DT": "DT#2106-02-07-06:28:15",
    "LDATE": "LDATE#2554-07-20", "LTOD": "LTOD#23:59:59.999999999",
    "LDT": "LDT#2554-07-21-23:34:33.709551615",
}  # fmt: skip
"""Types with a value whose text is long."""


def run(text: str, level: int) -> LoadedApplication:
    result = build_application(
        [Source("a.st", text)], (), BuildOptions(level=level, libraries=LIBRARIES), session=SESSION
    )
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    application = LoadedApplication(result.package)
    application.start()
    application.cycle()
    return application


def guards(application: LoadedApplication, name: str) -> list[str]:
    """Where the neighbours of a result were written."""
    return [
        f"{part}[{i}]"
        for part in ("before", "after")
        for i in range(16)
        if application.read(f"PLC_PRG.{name}.{part}[{i}]") != GUARD
    ]


def check(seed: int, level: int, count: int = 40) -> None:
    made = Texts(Random(seed))
    while len(made.cases) < count:
        made.case()
    application = run(program(made), level)
    try:
        wrong = []
        for i, case in enumerate(made.cases):
            value, written = application.read(f"PLC_PRG.r{i}.t"), guards(application, f"r{i}")
            if value != case.value or written:
                wrong.append(f"{case.statement}: {len(case.value)} of {case.length}, got {len(value)}")
                wrong += [f"  expected {case.value!r}", f"       got {value!r}", f"  written {written}"]
    finally:
        application.close()
    used = [line for line in made.sources if any(line.split()[0] + c in w for w in wrong for c in ",)")]
    assert not wrong, "\n".join([f"seed {seed}", *used, *wrong])


@seeds(4, range(100, 300))
def test_texts_at_their_bounds(seed: int, level: int) -> None:
    check(seed, level)


def test_numbers_and_times_as_short_texts() -> None:
    """The text of a value is cut where its variable ends."""
    lines, variables = [], []
    for number, (type_, value) in enumerate(VALUES.items()):
        variables.append(f"v{number} : {type_} := {value};")
        for wide in (False, True):
            name = f"{'w' if wide else 's'}{number}"
            kind = word(wide)
            variables.append(f"{name} : {kind};")
            lines.append(f"{name} := {type_}_TO_{kind}(v{number});")
            for length in (1, 2, 5, 8, 10):
                variables.append(f"{name}_{length} : G{kind}{length};")
                lines.append(f"{name}_{length}.t := TO_{kind}(v{number});")
    guard = f"ARRAY[0..15] OF BYTE := [16({GUARD})]"
    types = "".join(
        f"TYPE G{word(wide)}{n} : STRUCT before : {guard}; t : {word(wide)}({n}); "
        f"after : {guard}; END_STRUCT END_TYPE\n"
        for wide in (False, True)
        for n in (1, 2, 5, 8, 10)
    )
    own, body = "\n".join(variables), "\n".join(lines)
    application = run(f"{types}PROGRAM PLC_PRG\nVAR\n{own}\nEND_VAR\n{body}\nEND_PROGRAM", 2)
    try:
        for number in range(len(VALUES)):
            whole = application.read(f"PLC_PRG.s{number}")
            assert len(whole) > 3
            for name in (f"s{number}", f"w{number}"):
                assert application.read(f"PLC_PRG.{name}") == whole
                for length in (1, 2, 5, 8, 10):
                    assert application.read(f"PLC_PRG.{name}_{length}.t") == whole[:length]
                    assert guards(application, f"{name}_{length}") == []
    finally:
        application.close()


@pytest.mark.parametrize("length", LENGTHS)
def test_values_of_long_texts(length: int) -> None:
    """A text of any length is read as a value: what does not fit the 255 characters taken is left out."""
    digits = "0" * (length - 1) + "7" if length <= 255 else "0" * 254 + "77"
    letters = content(Random(length), length)
    names = ["INT", "ULINT", "REAL", "LREAL", "BOOL", "TIME", "LDT", "DATE", "TOD"]
    body = "".join(f"a{n} := TO_{n}(s); b{n} := TO_{n}(x); c{n} := TO_{n}(w);\n" for n in names)
    own = "".join(f"{v}{n} : {n}; " for n in names for v in "abc")
    text = f"""PROGRAM PLC_PRG
VAR
    s : STRING({length}) := {quoted(digits, False)}; w : WSTRING({length}) := {quoted(digits, True)};
    x : STRING({length}) := {quoted(letters, False)}; {own}
END_VAR
{body}
END_PROGRAM"""
    application = run(text, 0)
    try:
        assert application.read("PLC_PRG.aLREAL") == application.read("PLC_PRG.cLREAL") == 7.0
        assert application.read("PLC_PRG.aULINT") == application.read("PLC_PRG.cULINT") == 7
        assert application.read("PLC_PRG.aTIME") == application.read("PLC_PRG.cTIME") == 0
    finally:
        application.close()
